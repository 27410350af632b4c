"""Assemblies of thin plates: a stiffened bracket, and a row of plates.

The bracket is a base with a rib along its middle and two across it, where
three and four faces meet at an edge, and under it, a gap apart, a cover.
Four bolts go through both: the holes have a collar of two rings of faces.
"""

import math

from .mesh import Mesh

CELL = 0.5
LENGTH, HALF_WIDTH, RIB_HEIGHT = 16.0, 2.0, 1.5
GAP = 0.3
RIB_FROM, RIB_TO = 1.0, 15.0
RIBS_ACROSS = (6.0, 10.0)
HOLES = [(3.0, -1.0), (3.0, 1.0), (13.0, -1.0), (13.0, 1.0)]
HOLE_RADIUS = 0.55
HOLE_CELLS = 2              # half the side of the square around a hole

ROW_PLATES, ROW_CELLS, ROW_SIDE, ROW_GAP = 16, 4, 1.6, 0.4


class Builder:
    """A mesh whose points are found again by their place."""

    def __init__(self, name):
        self.mesh = Mesh(name)
        self.known = {}

    def point(self, x, y, z):
        key = (round(x, 6), round(y, 6), round(z, 6))
        if key not in self.known:
            self.known[key] = self.mesh.point((x, y, z))
        return self.known[key]

    def quad(self, *places):
        self.mesh.face(*[self.point(*p) for p in places])


def build_bracket():
    b = Builder("bracket")
    b.mesh.use(object="base", material="steel")
    add_plate(b, 0.0)
    b.mesh.use(group="rib", material="enamel")
    add_ribs(b)
    b.mesh.use(object="cover", group="plate", material="lamp")
    add_plate(b, -GAP)
    b.mesh.triangulate()
    return b.mesh


def steps(low, high, size=CELL):
    count = round((high - low) / size)
    return [low + (high - low) * i / count for i in range(count + 1)]


def pairs(row):
    return list(zip(row, row[1:]))


def add_plate(b, y):
    b.mesh.use(group="plate")
    side = HOLE_CELLS * CELL
    for x0, x1 in pairs(steps(0.0, LENGTH)):
        for z0, z1 in pairs(steps(-HALF_WIDTH, HALF_WIDTH)):
            middle = ((x0 + x1) / 2, (z0 + z1) / 2)
            if any(max(abs(middle[0] - hx), abs(middle[1] - hz)) < side
                   for hx, hz in HOLES):
                continue
            b.quad((x0, y, z0), (x0, y, z1), (x1, y, z1), (x1, y, z0))
    for number, hole in enumerate(HOLES, 1):
        b.mesh.use(group="bolt-%d" % number)
        add_collar(b, y, hole, side)


def add_collar(b, y, hole, side):
    """Two rings of quads between the square of cells and the hole."""
    outer = square(hole, side)
    count = len(outer)
    inner = [(hole[0] + HOLE_RADIUS * math.cos(math.atan2(z - hole[1],
                                                          x - hole[0])),
              hole[1] + HOLE_RADIUS * math.sin(math.atan2(z - hole[1],
                                                          x - hole[0])))
             for x, z in outer]
    middle = [((a + c) / 2, (e + d) / 2)
              for (a, e), (c, d) in zip(outer, inner)]
    for first, second in ((outer, middle), (middle, inner)):
        for i in range(count):
            j = (i + 1) % count
            b.quad(*[(x, y, z) for x, z in (
                first[j], first[i], second[i], second[j])])


def square(hole, side):
    """The grid points on the square around a hole, turning from x to z."""
    n = 2 * HOLE_CELLS
    path = ([(1.0, -1.0 + 2.0 * i / n) for i in range(n)] +
            [(1.0 - 2.0 * i / n, 1.0) for i in range(n)] +
            [(-1.0, 1.0 - 2.0 * i / n) for i in range(n)] +
            [(-1.0 + 2.0 * i / n, -1.0) for i in range(n)])
    return [(hole[0] + side * u, hole[1] + side * v) for u, v in path]


def add_ribs(b):
    for y0, y1 in pairs(steps(0.0, RIB_HEIGHT)):
        for x0, x1 in pairs(steps(RIB_FROM, RIB_TO)):
            b.quad((x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0),
                   (x0, y1, 0.0))
        for x in RIBS_ACROSS:
            for z0, z1 in pairs(steps(-HALF_WIDTH, HALF_WIDTH)):
                b.quad((x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1))


def build_row():
    """Sixteen square plates in a row, a gap apart."""
    mesh = Mesh("plate-1")
    colours = ("sea", "sky")
    for number in range(ROW_PLATES):
        mesh.use(object="plate-%d" % (number + 1),
                 material=colours[number % 2])
        left = number * (ROW_SIDE + ROW_GAP)
        rows = [mesh.ring([(left + ROW_SIDE * i / ROW_CELLS, 0.0,
                            ROW_SIDE * (0.5 - j / ROW_CELLS))
                           for i in range(ROW_CELLS + 1)])
                for j in range(ROW_CELLS + 1)]
        for lower, upper in pairs(rows):
            mesh.strip(lower, upper)
    mesh.triangulate()
    return mesh
