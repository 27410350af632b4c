"""A toucan, half placed by hand and mirrored.

Open rings run from the bill over head and body to the end of the tail,
each from the back (x = 0) down the left side to the breast (x = 0).  It
stands on its two feet and the tail.
"""

from . import vec
from .mesh import Mesh

BILL_TIP = (0, 16.6, 17.6)

BILL = [
    [(0, 21.0, 14.6), (1.2, 20.0, 14.2), (1.1, 18.3, 13.8), (0, 17.4, 13.6)],
    [(0, 23.4, 9.8), (1.8, 21.8, 9.4), (1.7, 18.8, 9.2), (0, 17.6, 9.0)],
    [(0, 24.0, 5.4), (2.3, 22.2, 4.8), (2.2, 18.6, 4.8), (0, 17.2, 5.0)],
]
BODY = [
    [(0, 25.4, 3.0), (2.2, 24.6, 2.4), (3.6, 21.4, 1.8), (3.2, 17.8, 2.6),
     (0, 15.8, 4.6)],
    [(0, 25.2, -1.0), (2.4, 24.2, -1.2), (4.0, 20.6, -1.2), (3.8, 16.4, 2.2),
     (0, 13.6, 5.4)],
    [(0, 21.4, -3.8), (2.7, 20.2, -3.6), (4.5, 16.4, -2.4), (4.4, 12.4, 2.2),
     (0, 9.8, 5.6)],
    [(0, 16.4, -6.0), (3.4, 15.2, -5.8), (5.2, 11.4, -3.4), (4.7, 8.4, 1.0),
     (0, 6.4, 3.6)],
    [(0, 11.2, -8.6), (3.2, 10.2, -8.2), (4.6, 7.4, -5.4), (3.8, 5.4, -2.0),
     (0, 4.2, -0.4)],
    [(0, 7.4, -11.2), (2.2, 6.8, -10.8), (2.9, 5.2, -9.2), (2.2, 4.0, -7.2),
     (0, 3.4, -6.4)],
    [(0, 4.4, -14.4), (1.7, 4.0, -14.2), (1.9, 3.0, -13.4), (0, 2.2, -12.8)],
    [(0, 1.9, -20.6), (2.6, 1.5, -20.2), (2.5, 0.0, -19.6), (0, 0, -19.8)],
]

# From this point of each body ring on, down to the breast, feathers are cream.
PALE_FROM = (3, 3, 3, 9)


def build():
    bird = Mesh("bird")
    bill, body = [[bird.ring(r) for r in part] for part in (BILL, BODY)]
    add_bill(bird, bill, body[0])
    bird.use(material="night")
    for front, rear in zip(body, body[1:]):
        bird.zip_rows(front, rear)
    pale = {p for ring, first in zip(body, PALE_FROM) for p in ring[first:]}
    bird.paint_between("cream", pale)
    for lower, upper in zip(body[-1][1:], body[-1][2:]):
        bird.face(body[-1][0], lower, upper)
    add_eye(bird, body[0], body[1])
    add_wing(bird, body[2:5])
    add_foot(bird, body[3], body[4])
    bird.mirror_x()
    bird.triangulate()
    return bird


def add_bill(bird, bill, face):
    tip = bird.point(BILL_TIP)
    bird.use(material="night")
    for upper, lower in zip(bill[0], bill[0][1:]):
        bird.face(tip, lower, upper)
    bird.use(material="fur")
    for front, rear in zip(bill, bill[1:]):
        bird.zip_rows(front, rear)
    bird.use(material="cream")
    bird.zip_rows(bill[-1], face)


def add_eye(bird, front, rear):
    rim = [front[1], front[2], rear[2], rear[1]]
    bird.open_hole([rim])
    eye = bird.ring([(3.15, 23.5, 1.5), (3.6, 22.1, 1.3),
                     (3.75, 22.1, -0.1), (3.3, 23.5, 0.1)])
    bird.use(material="sky")
    bird.tube(rim, eye)
    bird.use(material="night")
    bird.face(*eye)


def add_wing(bird, rings):
    """A raised plate over four cells, drawn out into a wing tip."""
    rim = bird.open_hole([
        (front[j], front[j + 1], rear[j + 1], rear[j])
        for front, rear in zip(rings, rings[1:]) for j in (1, 2)])
    middle = vec.mean([bird.points[i] for i in rim])
    ring = []
    for i in rim:
        p = vec.mix(bird.points[i], middle, 0.16)
        hangs_over = i in rings[2]
        ring.append(bird.point(vec.add(
            p, (0.8, -1.0, -2.4) if hangs_over else (1.3, 0, 0))))
    bird.use(material="slate")
    bird.tube(rim, ring)
    bird.fan(ring, bird.point(vec.add(middle, (1.9, 0, 0))))


def add_foot(bird, front, rear):
    """A leg out of the cell beside the belly; both stay off the middle."""
    rim = [front[3], front[4], rear[4], rear[3]]
    bird.open_hole([rim])
    levels = [
        [(3.7, 5.4, 1.0), (1.2, 4.6, 2.2), (1.2, 3.6, 0.0), (3.3, 4.2, -1.2)],
        [(3.0, 1.6, 1.9), (1.3, 1.5, 2.1), (1.3, 1.3, 0.3), (2.9, 1.4, 0.1)],
        [(3.6, 0, 4.6), (0.9, 0, 5.0), (1.2, 0, -0.6), (3.1, 0, -0.8)]]
    for material, level in zip(("night", "sky", "sky"), levels):
        bird.use(material=material)
        ring = bird.ring(level)
        bird.tube(rim, ring)
        rim = ring
    bird.face(*rim)
