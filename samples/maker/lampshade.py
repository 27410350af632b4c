"""A lampshade: a fluted bell that twists as it rises, open at both ends."""

import math

from .mesh import Mesh

FLUTES = 12
VALLEY = 0.84          # how far a flute's valley draws in
TWIST = 12.0           # degrees from one ring to the next

# Height and ridge radius of each ring.  The first and the last two share a
# radius and do not twist, so the cuffs are upright planar rectangles that
# can be folded around a wire hoop.
PROFILE = [(0.0, 15.0), (1.5, 15.0), (6.0, 14.4), (10.5, 13.0), (15.0, 11.0),
           (19.5, 8.8), (23.5, 7.4), (25.0, 7.4)]


def build():
    shade = Mesh("lampshade")
    last = len(PROFILE) - 1
    rings = [ring(shade, k) for k in range(last + 1)]
    for k in range(last):
        is_cuff = k in (0, last - 1)
        shade.use(material="red" if is_cuff else "paper")
        if is_cuff:
            shade.tube(rings[k], rings[k + 1])
        else:
            add_band(shade, rings[k], rings[k + 1])
    return shade


def ring(shade, k):
    height, ridge = PROFILE[k]
    turns = min(max(k - 1, 0), len(PROFILE) - 3)
    places = []
    for s in range(2 * FLUTES):
        angle = math.radians(180.0 / FLUTES * s + TWIST * turns)
        radius = ridge if s % 2 == 0 else ridge * VALLEY
        places.append((radius * math.sin(angle), height,
                       radius * math.cos(angle)))
    return shade.ring(places)


def add_band(shade, lower, upper):
    """All diagonals lean the way the twist does not: the short way."""
    n = len(lower)
    for s in range(n):
        t = (s + 1) % n
        shade.face(lower[s], lower[t], upper[s])
        shade.face(lower[t], upper[t], upper[s])
