"""A T-shirt as it hangs on somebody, in centimetres.

Front and back are drawn as a pattern maker draws them, flat: u is the way
round the body from the middle, w the way up from the hem.  A grid over each
drawing is then bent: round an upright oval up to the chest, and from there
over the shoulder by an arch in each upright plane.  The sleeves are spun
from the armholes to the cuffs.  The wearer's left half is made, and
mirrored.
"""

import math
from bisect import bisect_right

from . import vec
from .curves import bezier, coons, relaxed, spaced
from .mesh import Mesh

HALF_WIDTH = 20.2      # of the oval round the body
FRONT_DEPTH, BACK_DEPTH = 10.7, 9.7
ROUNDNESS = 0.85       # 1 an ellipse, less towards a rounded rectangle
ARCH_FROM = 41.0       # where the arch over the shoulder begins
# How steep a roof the arch is, in the middle and at the sides: 1 an ellipse,
# 2 straight, less than 1 square.
ROOF_MIDDLE, ROOF_SIDE = 1.1, 0.85
NECK_X, NECK_Y = 8.0, 68.0
TIP_X, TIP_Y = 19.7, 64.6
ARMPIT = 46.0
FRONT_NECK, BACK_NECK = 8.5, 2.0   # the scoop below the neck point
CUFF_CENTRE = (32.2, 43.6, 0.0)
CUFF_UP, CUFF_WIDE = 6.3, 5.9
ARM_SLOPE = 50.0       # degrees below the horizon
CROWN = 0.7            # how far the sleeve's upper side swells

COLUMNS, NECK_COLUMNS = 12, 6
SIDE_ROWS, ARMHOLE_ROWS = 16, 10
SLEEVE_ROWS = 8
GROUPS = ["front", "back", "sleeve_left", "sleeve_right"]


def build():
    return sewn("tshirt")


def build_plain():
    """The same surface; nothing tells where its seams are."""
    shirt = sewn("tshirt-plain")
    shirt.labels = [l._replace(group=None) for l in shirt.labels]
    shirt.lines = []
    return shirt


def sewn(name):
    shirt = Mesh(name)
    shirt.use(group="front")
    front = Half(FRONT_DEPTH, FRONT_NECK)
    rows = [shirt.ring(row) for row in front.bent()]
    for lower, upper in zip(rows, rows[1:]):
        shirt.strip(lower, upper)
    shirt.use(group="back")
    back = add_back(shirt, rows)
    add_sleeve(shirt, rows, back)
    shirt.triangulate()
    shirt.mirror_x(rename=lambda name: name.replace("left", "right"))
    shirt.sort_groups(GROUPS)
    return shirt


def add_back(shirt, front):
    """The back's rows, sewn to the front at the side and the shoulder."""
    places = Half(-BACK_DEPTH, BACK_NECK).bent()
    rows = []
    for j, row in enumerate(places):
        ids = shirt.ring(row)
        if j <= SIDE_ROWS:
            ids[-1] = front[j][-1]
        if j == len(places) - 1:
            ids[NECK_COLUMNS:] = front[j][NECK_COLUMNS:]
        rows.append(ids)
    for lower, upper in zip(rows, rows[1:]):
        shirt.strip(upper, lower)
    return rows


def add_sleeve(shirt, front, back):
    """Rings from the armhole, which begins at the armpit, to the cuff."""
    shirt.use(group="sleeve_left")
    armhole = [row[-1] for row in front[SIDE_ROWS:]]
    armhole += [row[-1] for row in reversed(back[SIDE_ROWS + 1:-1])]
    rings = [armhole]
    for k in range(1, SLEEVE_ROWS + 1):
        rings.append(shirt.ring([
            sleeve_place(shirt.points[p], 2.0 * math.pi * n / len(armhole),
                         k / SLEEVE_ROWS) for n, p in enumerate(armhole)]))
    for inner, outer in zip(rings, rings[1:]):
        shirt.tube(outer, inner)
    shirt.mark([ring[0] for ring in rings])


def sleeve_place(start, turn, share):
    """On the way from a point of the armhole to the cuff."""
    slope = math.radians(ARM_SLOPE)
    up = (math.sin(slope), math.cos(slope), 0.0)
    end = vec.add(CUFF_CENTRE, vec.add(
        vec.scale(up, -CUFF_UP * math.cos(turn)),
        (0.0, 0.0, CUFF_WIDE * math.sin(turn))))
    swell = (CROWN * 6.75 * share * (1.0 - share) ** 2
             * (0.5 - 0.5 * math.cos(turn)) ** 2)
    return vec.add(vec.mix(start, end, share), vec.scale(up, swell))


class Half:
    """The left half of the front or the back: drawn, gridded, bent."""

    def __init__(self, depth, neck_depth):
        self.depth = depth
        self.neck_depth = neck_depth
        steps = 2000
        self.girth = [0.0]
        places = [self.oval(0.5 * math.pi * k / steps)
                  for k in range(steps + 1)]
        for a, b in zip(places, places[1:]):
            self.girth.append(self.girth[-1] + math.dist(a, b))
        self.arches = {}

    def oval(self, angle):
        return (HALF_WIDTH * math.sin(angle) ** ROUNDNESS,
                self.depth * max(0.0, math.cos(angle)) ** ROUNDNESS)

    def around(self, u):
        """x and z of the oval at the distance u from the middle."""
        k = min(bisect_right(self.girth, u), len(self.girth) - 1) - 1
        share = (u - self.girth[k]) / (self.girth[k + 1] - self.girth[k])
        return self.oval(0.5 * math.pi * (k + share) / (len(self.girth) - 1))

    def distance_to(self, x):
        share = (math.asin((x / HALF_WIDTH) ** (1.0 / ROUNDNESS))
                 / (0.5 * math.pi))
        k = share * (len(self.girth) - 1)
        low = min(int(k), len(self.girth) - 2)
        return (self.girth[low]
                + (k - low) * (self.girth[low + 1] - self.girth[low]))

    def arch(self, u):
        """The slice over the shoulder: places, and how far along they are."""
        if u not in self.arches:
            x, z = self.around(u)
            height = shoulder_height(x) - ARCH_FROM
            roof = ROOF_MIDDLE + (ROOF_SIDE - ROOF_MIDDLE) * (x / TIP_X) ** 2
            places = []
            for k in range(201):
                angle = 0.5 * math.pi * k / 200
                places.append((
                    ARCH_FROM + height * math.sin(angle) ** roof,
                    z * max(0.0, math.cos(angle)) ** roof))
            reach = [ARCH_FROM]
            for a, b in zip(places, places[1:]):
                reach.append(reach[-1] + math.dist(a, b))
            self.arches[u] = places, reach
        return self.arches[u]

    def top(self, u):
        return self.arch(u)[1][-1]

    def place(self, point):
        u, w = point
        x, z = self.around(u)
        if w <= ARCH_FROM:
            return x, w, z
        places, reach = self.arch(u)
        k = min(bisect_right(reach, w), len(reach) - 1) - 1
        y, z = vec.mix(places[k], places[k + 1],
                       (w - reach[k]) / (reach[k + 1] - reach[k]))
        return x, y, z

    # -- the drawing ------------------------------------------------------

    def bent(self):
        return [[self.place(p) for p in row] for row in self.grid()]

    def grid(self):
        side, top = self.right_side(), self.top_line()
        rows = len(side) - 1
        low = [(side[0][0] * i / COLUMNS, 0.0) for i in range(COLUMNS + 1)]
        middle = [(0.0, top[0][1] * j / rows) for j in range(rows + 1)]
        grid = []
        for j in range(rows + 1):
            grid.append([coons(low, top, middle[j], side[j], i, i / COLUMNS,
                               j / rows) for i in range(COLUMNS + 1)])
        grid[0], grid[-1] = low, top
        return relaxed(grid, 7)

    def right_side(self):
        """The side seam, then the armhole up to the shoulder's tip."""
        edge = self.girth[-1]
        seam = [(edge, ARMPIT * j / SIDE_ROWS) for j in range(SIDE_ROWS)]
        tip_u = self.distance_to(TIP_X)
        top = self.top(tip_u)
        hole = bezier((edge, ARMPIT), (edge - 4.6, ARMPIT + 0.8),
                      (tip_u - 3.6, top - 10.0), (tip_u, top))
        return seam + spaced(hole, ARMHOLE_ROWS)

    def top_line(self):
        """The neckline, then the shoulder."""
        u = self.distance_to(NECK_X)
        point = (u, self.top(u))
        bottom = point[1] - self.neck_depth
        neck = bezier((0.0, bottom), (0.6 * u, bottom),
                      (u, point[1] - 0.6 * self.neck_depth), point)
        shoulder = []
        steps = COLUMNS - NECK_COLUMNS
        for i in range(1, steps + 1):
            x = NECK_X + (TIP_X - NECK_X) * i / steps
            at = self.distance_to(x)
            shoulder.append((at, self.top(at)))
        return spaced(neck, NECK_COLUMNS) + shoulder


def shoulder_height(x):
    """The line over both shoulders, level behind the neck."""
    share = (x - NECK_X) / (TIP_X - NECK_X)
    return NECK_Y + (TIP_Y - NECK_Y) * max(share, -0.4)
