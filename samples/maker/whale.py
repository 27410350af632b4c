"""A humpback whale, half placed by hand and mirrored.

Open rings run from the snout to the tail, each from the back (x = 0) down
the left side to the belly (x = 0).  Flippers, flukes and the eye grow out
of single cells between the rings.
"""

from .mesh import Mesh

SNOUT = (0, 1.6, 21.6)

RINGS = [
    [(0, 4.2, 18.6), (2.2, 3.6, 18.8), (3.3, 1.5, 19.0), (3.1, -0.5, 19.0),
     (1.8, -2.4, 18.4), (0, -3.0, 18.2)],
    [(0, 5.8, 13.6), (3.2, 5.2, 13.8), (4.9, 1.6, 14.2), (4.9, -1.4, 14.4),
     (3.0, -4.8, 13.8), (0, -5.7, 13.4)],
    [(0, 6.6, 8.4), (3.9, 5.7, 8.4), (6.2, 0.9, 8.8), (6.0, -2.6, 9.2),
     (3.6, -6.3, 8.6), (0, -7.4, 8.2)],
    [(0, 6.8, 2.6), (4.1, 5.8, 2.6), (6.6, 1.0, 3.0), (6.2, -3.0, 3.4),
     (3.7, -6.4, 3.0), (0, -7.4, 2.6)],
    [(0, 6.7, -3.4), (3.8, 5.6, -3.4), (5.9, 1.6, -3.2), (5.4, -2.2, -3.0),
     (3.2, -5.0, -3.2), (0, -5.8, -3.4)],
    [(0, 6.6, -9.0), (2.9, 5.6, -9.0), (4.4, 2.6, -9.0), (3.9, -0.4, -9.0),
     (2.2, -2.6, -9.2), (0, -3.2, -9.4)],
    [(0, 6.6, -14.0), (1.9, 5.9, -14.0), (2.8, 4.0, -14.2), (2.4, 2.0, -14.4),
     (1.6, 0.8, -14.6), (0, 0.4, -14.6)],
    [(0, 7.3, -18.4), (1.4, 7.0, -18.4), (2.1, 5.9, -18.6), (1.5, 4.5, -18.8),
     (0, 4.0, -18.8)],
    [(0, 8.5, -21.6), (1.4, 8.4, -21.6), (2.2, 7.6, -21.8), (1.4, 6.7, -22.0),
     (0, 6.4, -22.0)],
]

# From this point of each ring on, down to the belly, the skin is pale.
PALE_FROM = (3, 3, 3, 3, 4, 4, 5, 9, 9)


def build():
    whale = Mesh("whale")
    whale.use(material="sea")
    rings = [whale.ring(r) for r in RINGS]
    for front, rear in zip(rings, rings[1:]):
        whale.zip_rows(front, rear)
    snout = whale.point(SNOUT)
    for upper, lower in zip(rings[0], rings[0][1:]):
        whale.face(snout, lower, upper)
    # Creases where the pale belly narrows towards the tail.
    for front, rear, j in ((rings[3], rings[4], 3), (rings[5], rings[6], 4)):
        whale.crease(front[j], front[j + 1], rear[j + 1], rear[j])
    pale = {p for ring, first in zip(rings, PALE_FROM) for p in ring[first:]}
    whale.paint_between("cream", pale | {snout})
    add_eye(whale, rings[1], rings[2])
    add_flipper(whale, rings[2], rings[3])
    add_back_fin(whale, rings[4], rings[5])
    add_fluke(whale, rings[7], rings[8])
    close_tail(whale, rings[8])
    whale.mirror_x()
    whale.triangulate()
    return whale


def add_eye(whale, front, rear):
    """A dark diamond set into the cell above the corner of the mouth."""
    rim = [front[2], front[3], rear[3], rear[2]]
    whale.open_hole([rim])
    eye = whale.ring([(5.5, 0.3, 12.4), (5.5, -0.9, 12.5),
                      (5.95, -1.2, 10.8), (5.95, 0.1, 10.6)])
    whale.tube(rim, eye)
    whale.use(material="dark")
    whale.face(*eye)
    whale.use(material="sea")


def add_flipper(whale, front, rear):
    """A long flat arm that reaches sideways, down and back.

    Its sections are diamonds with sharp front and rear edges, turned an
    eighth against the opened cell, which spares it slivers of a rim.
    """
    rim = [front[3], front[4], rear[4], rear[3]]
    whale.open_hole([rim])
    for level in (
            [(8.4, -5.4, 8.2), (7.6, -6.6, 5.4),
             (7.6, -5.8, 2.4), (8.2, -4.9, 5.2)],
            [(13.0, -8.0, 4.8), (12.2, -8.8, 2.2),
             (11.6, -8.0, -0.8), (12.4, -7.2, 2.0)]):
        ring = whale.ring(level)
        whale.tube(rim, ring)
        rim = ring
    whale.fan(rim, whale.point((15.0, -9.6, -4.4)))


def add_back_fin(whale, front, rear):
    rim = [front[0], front[1], rear[1], rear[0]]
    whale.open_hole([rim])
    tip = whale.point((0, 9.2, -9.6))
    for a, b in zip(rim, rim[1:]):
        whale.face(a, b, tip)


def add_fluke(whale, front, rear):
    """One wing of the tail fin, swept back to a point."""
    rim = [front[2], front[3], rear[3], rear[2]]
    whale.open_hole([rim])
    ring = whale.ring([(6.2, 7.6, -19.4), (5.8, 7.0, -22.2),
                       (5.2, 8.0, -24.8), (5.8, 8.4, -22.0)])
    whale.tube(rim, ring)
    whale.fan(ring, whale.point((12.0, 10.2, -26.4)))


def close_tail(whale, ring):
    """The notch between the flukes."""
    for upper, lower in zip(ring[1:], ring[2:]):
        whale.face(ring[0], upper, lower)
