"""A sun hat in centimetres: six gores meet at the top, and a sloping brim.

The wearer's left half is made, and mirrored.  Turns are in degrees round
the head, from the front over the left to the back.
"""

import math

from .curves import spaced
from .mesh import Mesh

HALF_WIDTH, HALF_LENGTH = 8.5, 9.9     # of the oval where crown meets brim
HEIGHT = 11.0
SHOULDER = 0.92        # 1 an ellipsoid, less a flatter top and steeper sides
BRIM, BRIM_DROP = 7.0, 3.2
ROWS, SEGMENTS, BRIM_ROWS = 13, 8, 5
GORES = ["front_left", "side_left", "back_left"]


def build():
    hat = Mesh("hat")
    profile = spaced([(math.sin(t) ** SHOULDER, math.cos(t) ** SHOULDER)
                      for t in (0.005 * math.pi * k for k in range(100))]
                     + [(1.0, 0.0)], ROWS)
    top = hat.point((0.0, HEIGHT, 0.0))
    rows = [[[top] for _ in GORES]]
    for k in range(1, ROWS + 1):
        rows.append(gore_rows(hat, profile[k], min(k, SEGMENTS)))
    for upper, lower in zip(rows, rows[1:]):
        for name, above, below in zip(GORES, upper, lower):
            hat.use(group=name)
            add_lattice(hat, above, below)
    add_brim(hat, joined(rows[-1]))
    hat.mirror_x(rename=lambda name: name.replace("left", "right"))
    hat.sort_groups(GORES + ["back_right", "side_right", "front_right",
                             "brim_front", "brim_back"])
    return hat


def gore_rows(hat, reach, segments):
    """One level of the crown, as a row of points for each gore."""
    size, height = reach
    ids = hat.ring([oval(60.0 * n / segments, size, 0.0, HEIGHT * height)
                    for n in range(3 * segments + 1)])
    return [ids[g * segments:(g + 1) * segments + 1] for g in range(3)]


def oval(turn, size, out, y):
    angle = math.radians(turn)
    x = 0.0 if turn in (0.0, 180.0) else math.sin(angle)
    return ((HALF_WIDTH * size + out) * x, y,
            (HALF_LENGTH * size + out) * math.cos(angle))


def joined(parts):
    return parts[0] + [i for part in parts[1:] for i in part[1:]]


def add_lattice(hat, above, below):
    """Triangles between two rows; the lower may be longer by one."""
    if len(above) == len(below):
        hat.strip(below, above)
        hat.triangulate()
        return
    for a, b, c in zip(below, below[1:], above):
        hat.face(a, b, c)
    for a, b, c in zip(above, below[1:], above[1:]):
        hat.face(a, b, c)


def add_brim(hat, inner):
    half = (len(inner) - 1) // 2
    for k in range(1, BRIM_ROWS + 1):
        share = k / BRIM_ROWS
        outer = hat.ring([oval(180.0 * n / (len(inner) - 1), 1.0,
                               BRIM * share, -BRIM_DROP * share)
                          for n in range(len(inner))])
        hat.use(group="brim_front")
        hat.strip(outer[:half + 1], inner[:half + 1])
        hat.use(group="brim_back")
        hat.strip(outer[half:], inner[half:])
        inner = outer
    hat.triangulate()
