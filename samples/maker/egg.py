"""A dragon's egg with scales: dense as a scan, made to be simplified.

Each point sits somewhere along its own ray from the middle, and so the
surface cannot cut itself however bumpy it is.
"""

import math

from . import vec
from .lcg import Lcg
from .mesh import Mesh
from .polyhedra import subdivided

ROWS = 11


def build():
    egg = Mesh("dragon-egg")
    points, faces = subdivided(32)
    scales = scale_centres()
    lumps = random_lumps(24)
    for p in points:
        egg.point(vec.scale(p, radius(p, scales, lumps)))
    for face in faces:
        egg.face(*face)
    return egg


def radius(direction, scales, lumps):
    return (egg_radius(direction) + 0.55 * scale_height(direction, scales)
            + lump_height(direction, lumps))


def egg_radius(direction):
    """Blunt below, slender above."""
    up = direction[1]
    return 7.0 + 1.6 * up * up + 1.2 * up ** 3 * (1.0 if up > 0 else 0.25)


def scale_centres():
    """Rows of scales, each row set off by half a scale from the last."""
    centres = []
    for row in range(ROWS):
        tilt = math.pi * (row + 0.5) / ROWS
        count = max(5, int(round(22 * math.sin(tilt))))
        for k in range(count):
            turn = 2.0 * math.pi * (k + 0.5 * (row % 2)) / count
            centres.append((math.sin(tilt) * math.sin(turn), math.cos(tilt),
                            math.sin(tilt) * math.cos(turn)))
    return centres


def scale_height(direction, centres):
    """A scale rises from its lower rim to a keel and dips to the next."""
    near = sorted((2.0 - 2.0 * vec.dot(direction, c), c) for c in centres)[:2]
    first, second = math.sqrt(max(0.0, near[0][0])), math.sqrt(near[1][0])
    rim = min(1.0, (second - first) / 0.12)
    lean = 0.5 + 2.2 * (near[0][1][1] - direction[1])
    return rim * (2.0 - rim) * min(1.0, max(0.15, lean))


def random_lumps(count):
    """Direction, height and sharpness of some smooth unevenness."""
    chance = Lcg(2024)
    lumps = []
    while len(lumps) < count:
        p = tuple(2.0 * chance.next() - 1.0 for _ in range(3))
        if 0.1 < vec.length(p) < 1.0:
            lumps.append((vec.unit(p), 0.5 * chance.next() - 0.25,
                          4.0 + 20.0 * chance.next()))
    return lumps


def lump_height(direction, lumps):
    return sum(height * math.exp(sharp * (vec.dot(direction, p) - 1.0))
               for p, height, sharp in lumps)
