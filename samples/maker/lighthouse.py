"""A lighthouse on its rock, painted: all that is flat on it is in a picture.

The shape is turned around the y axis in twelve sides, of which number 0 looks
to the front.  Each part of it has its place in the picture: bands are rolled
out from the back round to the back again, discs are seen from outside.
"""

import math

from .lcg import Lcg
from .mesh import Mesh
from .picture import Noise, Picture

SIDES = 12
BACK = -5.5                    # the side at which bands are cut open
SIZE = 1024

# Where bands lie in the picture: left, top, right, bottom.
TOWER = (16, 16, 760, 536)
ROCK = (16, 560, 912, 768)
LANTERN = (496, 792, 1000, 872)
RAIL = (496, 888, 1000, 928)
EAVES = (496, 952, 1000, 976)

# Discs: the middle in the picture, and pixels to the centimetre.
ROOF = (120, 896, 62.0)
GRASS = (364, 898, 20.0)
GROUND = (970, 660, 5.0)
FLOOR = (900, 140, 40.0)
BRACKETS = (900, 376, 40.0)

# Height and radius of the rings of the tower.
SHAFT = [(3.6, 2.55), (6.6, 2.15), (10.0, 1.9), (13.6, 1.75)]


def build():
    house = Mesh("lighthouse")
    house.use(material="painted")
    rock = [rock_ring(house, k) for k in range(4)]
    shaft = [ring(house, radius, height) for height, radius in SHAFT]
    edge = [ring(house, 2.55, y) for y in (14.3, 15.0)]
    lamp = [ring(house, 1.35, y) for y in (15.0, 17.2)]
    eaves = ring(house, 1.85, 17.35)
    ground(house, rock[0])
    for k in range(3):
        band(house, rock[k], rock[k + 1], ROCK, k / 3, (k + 1) / 3, True)
    annulus(house, rock[3], shaft[0], GRASS, 1, True)
    low, high = SHAFT[0][0], SHAFT[-1][0]
    for k in range(3):
        band(house, shaft[k], shaft[k + 1], TOWER,
             (SHAFT[k][0] - low) / (high - low),
             (SHAFT[k + 1][0] - low) / (high - low))
    annulus(house, shaft[-1], edge[0], BRACKETS, -1)
    band(house, edge[0], edge[1], RAIL)
    annulus(house, edge[1], lamp[0], FLOOR, 1)
    band(house, lamp[0], lamp[1], LANTERN)
    band(house, lamp[1], eaves, EAVES)
    roof(house, eaves)
    house.picture = paint()
    return house


# -- the shape ---------------------------------------------------------------

def direction(place):
    """Three decimals only: times a radius of two, they fit the file, and the
    sides of the tower stay planar."""
    angle = math.radians(360.0 / SIDES * place)
    return round(math.sin(angle), 3), round(math.cos(angle), 3)


def ring(house, radius, height):
    """Point j lies between the sides j and j + 1."""
    places = []
    for j in range(SIDES):
        x, z = direction(j + 0.5)
        places.append((radius * x, height, radius * z))
    return house.ring(places)


def rock_ring(house, k):
    """Foot, two ledges and the edge of the grass, none of them even."""
    random = Lcg(7001 + k)
    radius = (7.0, 6.6, 5.7, 4.7)[k]
    height = (0.0, 1.3, 2.5, 3.3)[k]
    rough, uneven = ((0.5, 0.0), (0.9, 0.5), (0.8, 0.5), (0.5, 0.3))[k]
    places = []
    for j in range(SIDES):
        x, z = direction(j + 0.5)
        r = radius + rough * (2 * random.next() - 1)
        places.append((r * x, height + uneven * (2 * random.next() - 1),
                       r * z))
    return house.ring(places)


def place_in(area, side, t):
    """Where the start of a side is at the fraction t of a band's height."""
    left, top, right, bottom = area
    along = (side - BACK) / SIDES
    return left + (right - left) * along, bottom + (top - bottom) * t


def band(house, lower, upper, area, low=0.0, high=1.0, uneven=False):
    for step in range(SIDES):
        side = math.ceil(BACK) + step
        a, b = (side - 1) % SIDES, side % SIDES
        corners = (lower[a], lower[b], upper[b], upper[a])
        spots = [place_in(area, side - 0.5, low),
                 place_in(area, side + 0.5, low),
                 place_in(area, side + 0.5, high),
                 place_in(area, side - 0.5, high)]
        add(house, corners, spots, uneven)


def add(house, corners, spots, uneven=False):
    """A face with its corners' places in the picture; an uneven one is cut
    into two triangles."""
    spot_of = dict(zip(corners, spots))
    for part in house.split(corners) if uneven else [corners]:
        house.use(uv=tuple((spot_of[i][0] / SIZE, 1 - spot_of[i][1] / SIZE)
                           for i in part))
        house.face(*part)
    house.use(uv=None)


def seen_in(area, turn, position):
    """Where a point is in a disc seen from above, or (turn -1) from below."""
    x, y, scale = area
    return x + scale * position[0], y + turn * scale * position[2]


def ground(house, rim):
    add(house, rim[::-1],
        [seen_in(GROUND, -1, house.points[i]) for i in rim[::-1]])


def annulus(house, lower, upper, area, turn, uneven=False):
    for j in range(SIDES):
        k = (j + 1) % SIDES
        corners = (lower[j], lower[k], upper[k], upper[j])
        add(house, corners,
            [seen_in(area, turn, house.points[i]) for i in corners], uneven)


def roof(house, rim):
    top = house.point((0.0, 19.6, 0.0))
    for j in range(SIDES):
        corners = (rim[j], rim[(j + 1) % SIDES], top)
        add(house, corners,
            [seen_in(ROOF, 1, house.points[i]) for i in corners])


# -- the picture -------------------------------------------------------------

PALETTE = {
    "white": (248, 244, 232), "shade": (228, 222, 206), "red": (196, 40, 38),
    "dark red": (158, 28, 32), "black": (40, 42, 48), "iron": (84, 90, 100),
    "wood": (126, 76, 42), "dark wood": (92, 54, 30), "glass": (52, 74, 104),
    "light": (255, 222, 108), "glow": (255, 244, 190), "brass": (198, 152, 58),
    "stone 0": (104, 100, 96), "stone 1": (126, 121, 115),
    "stone 2": (148, 142, 134), "stone 3": (170, 164, 155),
    "grass 0": (78, 122, 58), "grass 1": (96, 144, 66),
    "grass 2": (120, 166, 78), "path": (214, 190, 146),
    "foam": (236, 246, 248), "sea": (64, 132, 168), "deep": (40, 100, 142),
    "pink": (232, 128, 160),
}


def paint():
    picture = Picture(SIZE, PALETTE)
    picture.box(0, 0, SIZE, SIZE, "stone 1")
    random = Lcg(2026)
    paint_tower(picture)
    paint_rock(picture, Noise(random, 24), Noise(random, 9))
    paint_crown(picture, Noise(random, 16), random)
    paint_gallery(picture)
    paint_lantern(picture)
    paint_roof(picture)
    return picture


def middle_of(area, side):
    return place_in(area, side, 0.0)[0]


def paint_tower(picture):
    left, top, right, bottom = TOWER
    stripe = (bottom - top) / 5
    for k in range(5):
        y = top + stripe * k
        picture.box(left - 12, y - (12 if k == 0 else 0), right + 12,
                    y + stripe, ("white", "red")[k % 2])
        picture.box(left - 12, y + stripe - 5, right + 12, y + stripe,
                    ("shade", "dark red")[k % 2])
    paint_plinth(picture, left - 12, bottom - 30, right + 12, bottom + 12)
    paint_door(picture, middle_of(TOWER, 0), bottom)
    for side, y in ((0, top + 200), (0, top + 36), (3, top + 300),
                    (-3, top + 140), (5, top + 60), (-5, top + 250)):
        paint_window(picture, middle_of(TOWER, side), y)


def paint_plinth(picture, x0, y0, x1, y1):
    """Two courses of stones and what the edge needs beyond."""
    picture.box(x0, y0, x1, y1, "stone 0")
    for row, y in enumerate(range(y0, y1, 15)):
        for x in range(x0 - 18 + 18 * (row % 2), x1, 36):
            picture.box(max(x0, x + 1), y + 1, min(x1, x + 35),
                        min(y1, y + 14),
                        "stone %d" % (2 + (x // 36 + row) % 2))


def paint_door(picture, x, bottom):
    picture.box(x - 30, bottom - 12, x + 30, bottom + 12, "stone 3")
    picture.arch(x, bottom - 96, bottom - 8, 52, "stone 1")
    picture.arch(x, bottom - 90, bottom - 8, 40, "dark wood")
    for k in range(4):
        picture.box(x - 18 + 9 * k, bottom - 70, x - 11 + 9 * k, bottom - 8,
                    "wood")
    picture.arch(x, bottom - 86, bottom - 74, 22, "light")
    picture.disc(x + 12, bottom - 42, 3, "brass")
    picture.box(x - 28, bottom - 124, x + 28, bottom - 100, "black")
    picture.box(x - 26, bottom - 122, x + 26, bottom - 102, "white")
    picture.write("1907", x - 22, bottom - 120, 3, "black")


def paint_window(picture, x, y):
    picture.arch(x, y, y + 54, 36, "shade")
    picture.arch(x, y + 4, y + 48, 28, "black")
    picture.arch(x, y + 7, y + 45, 22, "glass")
    picture.box(x - 11, y + 26, x, y + 45, "light")
    picture.box(x - 1.5, y + 6, x + 1.5, y + 46, "white")
    picture.box(x - 11, y + 24, x + 11, y + 27, "white")
    picture.box(x - 20, y + 48, x + 20, y + 54, "stone 2")


def paint_rock(picture, coarse, fine):
    left, top, right, bottom = ROCK

    def choose(x, y):
        # The pattern goes on across the cut at the back.
        if x >= right:
            x -= right - left
        rough = 14 * fine.at(x + 900, y)
        if y < top + 6 + 2 * rough:
            return "grass %d" % (3 * fine.at(x, y) * 0.99)
        if y > bottom - 30 + rough:
            return "foam" if y < bottom - 18 + rough else "sea"
        level = 0.7 * coarse.at(x, y * 1.4) + 0.3 * fine.at(x, y)
        return "stone %d" % min(3, max(0, int(8 * level - 2.2)))

    picture.each(left - 12, top - 10, right + 12, bottom + 10, choose)


def paint_crown(picture, noise, random):
    x0, y0, scale = GRASS

    def choose(x, y):
        if abs(x - x0) < 14 + 8 * noise.at(x, y) and y > y0:
            return "path"
        return "grass %d" % (3 * noise.at(x, y) * 0.99)

    reach = 5.6 * scale
    picture.each(x0 - reach, y0 - reach, x0 + reach, y0 + reach, choose)
    for k in range(60):
        x, y = (reach * (1.7 * random.next() - 0.85) for _ in range(2))
        if abs(x) > 28 or y < 0:
            picture.disc(x0 + x, y0 + y, 2.5,
                         ("pink", "light", "white")[k % 3])


def paint_gallery(picture):
    left, top, right, bottom = RAIL
    picture.box(left - 8, top - 7, right + 8, bottom + 7, "white")
    for k in range(-1, 6 * SIDES + 1):
        x = left + (right - left) * k / (6 * SIDES)
        picture.box(x - 1, top, x + 2, bottom, "iron")
    for y in (top - 7, top + 18):
        picture.box(left - 8, y, right + 8, y + (12 if y < top else 4),
                    "black")
    picture.box(left - 8, bottom - 6, right + 8, bottom + 7, "red")
    paint_spokes(picture, BRACKETS, 2, 8, "shade", "dark red")
    paint_spokes(picture, FLOOR, 3, 1.5, "stone 2", "stone 0")


def paint_spokes(picture, area, count, width, ground, colour):
    """So many spokes on each side, as wide at the rim as at the hub."""
    x0, y0, scale = area
    reach = 2.75 * scale
    picture.box(x0 - reach, y0 - reach, x0 + reach, y0 + reach, ground)
    spokes = [direction((j + 0.5) / count)
              for j in range(count * SIDES)]

    def choose(x, y):
        x, y = x - x0, y - y0
        near = any(abs(x * c - y * s) < width / 2 and x * s + y * c > 0
                   for s, c in spokes)
        return colour if near else None

    picture.each(x0 - reach, y0 - reach, x0 + reach, y0 + reach, choose)


def paint_lantern(picture):
    left, top, right, bottom = LANTERN
    picture.box(left - 8, top - 7, right + 8, bottom + 7, "black")
    width = (right - left) / SIDES
    for k in range(SIDES):
        x = left + width * (k + 0.5)
        picture.box(x - width / 2 + 4, top + 8, x + width / 2 - 4, bottom - 18,
                    "light")
        picture.disc(x, (top + bottom) / 2 - 5, 16, "glow")
        picture.box(x - 1, top + 8, x + 1, bottom - 18, "black")
    picture.box(left - 8, bottom - 12, right + 8, bottom + 7, "red")
    left, top, right, bottom = EAVES
    picture.box(left - 8, top - 8, right + 8, bottom + 8, "iron")


def paint_roof(picture):
    x0, y0, scale = ROOF
    ribs = [direction(j + 0.5) for j in range(SIDES)]

    def choose(x, y):
        x, y = x - x0, y - y0
        far = x * x + y * y
        if far < 16 * 16:
            return "brass"
        if any(abs(x * c - y * s) < 2.5 and x * s + y * c > 0
               for s, c in ribs):
            return "black"
        return "dark red" if int(far ** 0.5) % 26 < 5 else "red"

    reach = 1.95 * scale
    picture.each(x0 - reach, y0 - reach, x0 + reach, y0 + reach, choose)
