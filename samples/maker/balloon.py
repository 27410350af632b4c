"""A hot-air balloon: twelve gores in the colours of the rainbow, and a basket.

All of it is turned around the y axis, so every face of four corners is planar.
"""

import math

from .mesh import Mesh

GORES = 12

# Height and radius of the envelope's rings, from its mouth to near its top.
ENVELOPE = [(9.4, 1.7), (11.4, 3.3), (13.6, 5.0), (16.0, 6.4), (18.6, 7.2),
            (21.2, 7.2), (23.6, 6.4), (25.4, 4.8), (26.5, 2.6)]
TOP = 26.9

# The same of what hangs below: the basket, its rim, and the burner's skirt.
BASKET = [(0.0, 2.1), (0.6, 2.5), (3.6, 2.7), (4.3, 2.9), (4.3, 1.6),
          (6.8, 1.1)]
LOOKS = ["leather", "wicker", "leather", "leather", "rope", "rope"]

RAINBOW = ["red", "orange", "yellow", "green", "blue", "violet"]


def build():
    balloon = Mesh("balloon")
    basket = [ring(balloon, *place) for place in BASKET]
    envelope = [ring(balloon, *place) for place in ENVELOPE]
    balloon.use(material="leather")
    balloon.face(*reversed(basket[0]))
    rings = basket + envelope[:1]
    for k, look in enumerate(LOOKS):
        balloon.use(material=look)
        balloon.tube(rings[k], rings[k + 1])
    for k in range(len(envelope) - 1):
        paint_band(balloon, envelope[k], envelope[k + 1], k)
    top = balloon.point((0.0, TOP, 0.0))
    balloon.use(material="red")
    balloon.fan(envelope[-1], top)
    return balloon


def ring(balloon, height, radius):
    places = []
    for j in range(GORES):
        angle = math.radians(360.0 / GORES * (j + 0.5))
        # Three decimals only: times a radius of one, they fit the file.
        x, z = round(math.sin(angle), 3), round(math.cos(angle), 3)
        places.append((radius * x, height, radius * z))
    return balloon.ring(places)


def paint_band(balloon, lower, upper, k):
    """Zigzags of the rainbow: each gore is one step on from its neighbour, up
    on one side of a ridge and down on the other."""
    if k == 0:
        balloon.use(material="white")
        balloon.tube(lower, upper)
        return
    for j in range(GORES):
        n = (j + 1) % GORES
        step = min(j % 4, 4 - j % 4)
        balloon.use(material=RAINBOW[(7 - k + step) % len(RAINBOW)])
        balloon.face(lower[j], lower[n], upper[n], upper[j])
