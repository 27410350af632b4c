"""A sleeve as one curved panel, in centimetres, open under the arm.

It hangs down from the shoulder.  Rows run around the arm from one side of
the seam to the other, columns from the cuff to the cap.
"""

import math

from .mesh import Mesh

COLUMNS = 24
ROWS = 32

LENGTH = 44.0               # from the cuff to the underarm
CAP = 12.0                  # how far the cap rises above that
CUFF_RADIUS, ARM_RADIUS = 3.9, 5.6
OPEN = 6.0                  # degrees of the ring that are missing


def build():
    panel = Mesh("sleeve")
    rows = [panel.ring([place(c, r) for c in range(COLUMNS + 1)])
            for r in range(ROWS + 1)]
    for lower, upper in zip(rows, rows[1:]):
        panel.strip(lower, upper)
    panel.triangulate()
    return panel


def place(column, row):
    turn = math.radians((360.0 - OPEN) * (column / COLUMNS - 0.5))
    # Rows are level at the cuff and follow the armhole at the cap.
    t = row / ROWS
    height = t * (LENGTH + CAP * (0.5 + 0.5 * math.cos(turn)) * t * t)
    radius = CUFF_RADIUS + (ARM_RADIUS - CUFF_RADIUS) * min(
        1.0, height / LENGTH)
    return (radius * math.sin(turn), height - LENGTH,
            radius * math.cos(turn))
