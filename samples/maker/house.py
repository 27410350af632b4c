"""A cottage of planar polygons: walls, roof, chimney, porch and windows.

All numbers are short decimals on purpose: every polygon is planar to the
last bit, also in the written file.
"""

from .mesh import Mesh

HALF_WIDTH, BACK, FRONT = 6.0, -8.0, 8.0
EAVES_WALL, EAVES_X, EAVES_Y, RIDGE = 7.0, 7.5, 6.5, 14.0
PORCH_HALF, PORCH_FRONT, PORCH_WALL, PORCH_RIDGE = 3.0, 11.5, 4.0, 6.4
DOOR_HALF, DOOR_TOP, DOOR_BACK = 1.2, 3.4, 11.0
CHIMNEY = (-1.2, 1.2, -5.5, -3.1, 16.8)


def build():
    house = Mesh("house")
    add_gables(house)
    add_side_walls(house)
    add_roof(house)
    add_chimney(house)
    add_porch(house)
    add_base(house)
    merge_equal_points(house)
    return house


def polygon(house, *places):
    house.face(*house.ring(places))


def both_sides(house, *places):
    """A polygon given for x > 0, and its mirror image."""
    polygon(house, *places)
    polygon(house, *((-x, y, z) for x, y, z in reversed(places)))


def gable_outline(z):
    right = [(HALF_WIDTH, 0, z), (HALF_WIDTH, EAVES_WALL, z),
             (EAVES_X, EAVES_Y, z)]
    return right + [(0, RIDGE, z)] + mirrored(right)


def mirrored(places):
    return [(-x, y, z) for x, y, z in reversed(places)]


def add_gables(house):
    house.use(material="wall", group="walls")
    polygon(house, *reversed(gable_outline(BACK)))
    right = [(PORCH_HALF, PORCH_WALL, FRONT), (PORCH_HALF, 0, FRONT)]
    recess = mirrored(right) + [(0, PORCH_RIDGE, FRONT)] + right
    polygon(house, *gable_outline(FRONT), *recess)


def add_side_walls(house):
    """Each long wall frames one sunken window."""
    wall = [(HALF_WIDTH, 0, FRONT), (HALF_WIDTH, 0, BACK),
            (HALF_WIDTH, EAVES_WALL, BACK), (HALF_WIDTH, EAVES_WALL, FRONT)]
    window = [(HALF_WIDTH, 2.2, 3.5), (HALF_WIDTH, 2.2, -3.5),
              (HALF_WIDTH, 5.4, -3.5), (HALF_WIDTH, 5.4, 3.5)]
    pane = [(x - 0.6, y, z) for x, y, z in window]
    for outer, inner in ((wall, window), (window, pane)):
        for k in range(4):
            n = (k + 1) % 4
            both_sides(house, outer[k], outer[n], inner[n], inner[k])
    house.use(material="glass")
    both_sides(house, *pane)


def add_roof(house):
    """Two slopes, notched for the chimney, and the soffits under them."""
    _, x1, z0, z1, _ = CHIMNEY
    low = RIDGE - x1
    house.use(material="roof", group="roof")
    both_sides(house, (EAVES_X, EAVES_Y, FRONT), (EAVES_X, EAVES_Y, BACK),
               (0, RIDGE, BACK), (0, RIDGE, z0), (x1, low, z0),
               (x1, low, z1), (0, RIDGE, z1), (0, RIDGE, FRONT))
    house.use(material="wall")
    both_sides(house, (HALF_WIDTH, EAVES_WALL, FRONT),
               (HALF_WIDTH, EAVES_WALL, BACK), (EAVES_X, EAVES_Y, BACK),
               (EAVES_X, EAVES_Y, FRONT))


def add_chimney(house):
    x0, x1, z0, z1, top = CHIMNEY
    low = RIDGE - x1
    house.use(material="brick", group="chimney")
    front = [(x1, low, z1), (x1, top, z1), (x0, top, z1), (x0, low, z1),
             (0, RIDGE, z1)]
    polygon(house, *front)
    polygon(house, *((x, y, z0) for x, y, _ in reversed(front)))
    both_sides(house, (x1, low, z1), (x1, low, z0), (x1, top, z0),
               (x1, top, z1))
    polygon(house, (x0, top, z1), (x1, top, z1), (x1, top, z0), (x0, top, z0))


def add_porch(house):
    """A small gabled porch with a door set back a little."""
    house.use(material="wall", group="porch")
    front = [(DOOR_HALF, 0), (PORCH_HALF, 0), (PORCH_HALF, PORCH_WALL),
             (0, PORCH_RIDGE), (-PORCH_HALF, PORCH_WALL), (-PORCH_HALF, 0),
             (-DOOR_HALF, 0), (-DOOR_HALF, DOOR_TOP), (DOOR_HALF, DOOR_TOP)]
    polygon(house, *((x, y, PORCH_FRONT) for x, y in front))
    both_sides(house, (PORCH_HALF, 0, PORCH_FRONT), (PORCH_HALF, 0, FRONT),
               (PORCH_HALF, PORCH_WALL, FRONT),
               (PORCH_HALF, PORCH_WALL, PORCH_FRONT))
    both_sides(house, (-DOOR_HALF, 0, PORCH_FRONT), (-DOOR_HALF, 0, DOOR_BACK),
               (-DOOR_HALF, DOOR_TOP, DOOR_BACK),
               (-DOOR_HALF, DOOR_TOP, PORCH_FRONT))
    polygon(house, (-DOOR_HALF, DOOR_TOP, PORCH_FRONT),
            (-DOOR_HALF, DOOR_TOP, DOOR_BACK),
            (DOOR_HALF, DOOR_TOP, DOOR_BACK),
            (DOOR_HALF, DOOR_TOP, PORCH_FRONT))
    house.use(material="door")
    polygon(house, (-DOOR_HALF, 0, DOOR_BACK), (DOOR_HALF, 0, DOOR_BACK),
            (DOOR_HALF, DOOR_TOP, DOOR_BACK),
            (-DOOR_HALF, DOOR_TOP, DOOR_BACK))
    house.use(material="roof")
    both_sides(house, (PORCH_HALF, PORCH_WALL, PORCH_FRONT),
               (PORCH_HALF, PORCH_WALL, FRONT), (0, PORCH_RIDGE, FRONT),
               (0, PORCH_RIDGE, PORCH_FRONT))


def add_base(house):
    house.use(material="wall", group="base")
    right = [(HALF_WIDTH, BACK), (HALF_WIDTH, FRONT), (PORCH_HALF, FRONT),
             (PORCH_HALF, PORCH_FRONT), (DOOR_HALF, PORCH_FRONT),
             (DOOR_HALF, DOOR_BACK)]
    outline = right + [(-x, z) for x, z in reversed(right)]
    polygon(house, *((x, 0, z) for x, z in outline))


def merge_equal_points(house):
    """The polygons were drawn one by one; join them where they meet."""
    number = {}
    points = []
    for i, p in enumerate(house.points):
        if p not in number:
            number[p] = len(points)
            points.append(p)
    old = house.points
    house.faces = [tuple(number[old[i]] for i in f) for f in house.faces]
    house.points = points
