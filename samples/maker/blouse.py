"""The front of a blouse as one curved panel, in centimetres.

The panel is a bent grid: columns run from hem to shoulder or neckline,
rows from side seam to side seam.
"""

import math

from .mesh import Mesh

HALF_COLUMNS = 12
NECK_COLUMNS = 5       # columns between the middle and the neck point
ROWS = 30
ARMHOLE_ROW = 20       # the row that meets the side seam's upper end

NECK_POINT = (7.6, 60.0)
SHOULDER_TIP = (19.0, 56.4)
NECK_DEPTH = 52.0
ARMHOLE_HEIGHT = 38.0


def build():
    panel = Mesh("blouse-front")
    columns = range(-HALF_COLUMNS, HALF_COLUMNS + 1)
    rows = [panel.ring([place(c, r) for c in columns])
            for r in range(ROWS + 1)]
    for lower, upper in zip(rows, rows[1:]):
        panel.strip(lower, upper)
    panel.triangulate()
    return panel


def place(column, row):
    side = -1.0 if column < 0 else 1.0
    x, y = flat_place(abs(column), row)
    return (side * x, y, depth(x, y))


def flat_place(column, row):
    """Where a grid point lies seen from the front, on the left half."""
    top_x, top_y = top_line(column)
    share = column / HALF_COLUMNS
    if row <= ARMHOLE_ROW:
        t = row / ARMHOLE_ROW
        level = ARMHOLE_HEIGHT - 1.5 * (1.0 - share * share)
        return share * side_seam(t), t * level
    t = (row - ARMHOLE_ROW) / (ROWS - ARMHOLE_ROW)
    low_x, low_y = flat_place(column, ARMHOLE_ROW)
    # The armhole sweeps inward before it climbs to the shoulder tip.
    sweep = 3.4 * math.sin(math.pi * t) * share
    return (low_x + (top_x - low_x) * t - sweep,
            low_y + (top_y - low_y) * t)


def top_line(column):
    """The neckline as a scoop, then the straight slope of the shoulder."""
    if column <= NECK_COLUMNS:
        t = column / NECK_COLUMNS
        return (NECK_POINT[0] * t,
                NECK_DEPTH + (NECK_POINT[1] - NECK_DEPTH) * t ** 2.4)
    t = (column - NECK_COLUMNS) / (HALF_COLUMNS - NECK_COLUMNS)
    return tuple(a + (b - a) * t for a, b in zip(NECK_POINT, SHOULDER_TIP))


def side_seam(t):
    """Half width from hem (t = 0) over the waist to the armhole (t = 1)."""
    return 25.0 - 3.2 * math.sin(math.pi * t) ** 2 + 0.5 * t


def depth(x, y):
    """A bowed body with a gentle bust: curved both ways, but only a little."""
    bow = -x * x / 62.0
    bust = sum(3.0 * math.exp(-((x - middle) / 8.5) ** 2
                              - ((y - 36.0) / 10.0) ** 2)
               for middle in (-9.0, 9.0))
    slope = -0.004 * max(0.0, y - 40.0) ** 2
    return bow + bust + slope
