"""A sitting fox: half of it is placed by hand, the other half mirrored.

The half is a row of open rings from the nose over head, neck and back to
the root of the tail.  Each ring starts on the back (x = 0), goes down the
fox's left side and ends under the belly (x = 0 again).  Ears and legs grow
out of single cells between the rings.  The tail follows after mirroring,
since it curls round to one side.
"""

from . import vec
from .mesh import Mesh

NOSE = [(0, 21.56, 10.43), (0.99, 21.22, 10.2), (0.87, 20.08, 9.98),
        (0, 19.62, 9.75)]
MUZZLE = [(0, 22.36, 7.83), (1.39, 21.9, 7.61), (2.03, 20.65, 7.27),
          (1.28, 19.17, 7.27), (0, 18.82, 7.15)]
EYES = [(0, 23.73, 5.46), (1.51, 23.5, 5.12), (3.36, 20.99, 4.78),
        (2.78, 18.82, 4.78), (1.28, 18.03, 5.35), (0, 17.91, 5.46)]
BROW = [(0, 25.55, 3.76), (1.74, 25.78, 2.97), (5.22, 23.16, 2.41),
        (4.87, 19.17, 3.31), (1.86, 17.46, 4.44), (0, 17, 4.67)]
CHEEK = [(0, 26.12, 0.6), (1.97, 26.12, 0.15), (5.45, 23.38, -0.3),
         (6.96, 18.82, 0.6), (2.2, 15.86, 4.67), (0, 15.4, 5.35)]
NAPE = [(0, 24.2, -2.8), (2.1, 23.6, -3.0), (4.1, 20.8, -2.4),
        (4.3, 17.0, -0.2), (2.7, 13.8, 4.6), (0, 12.8, 6.4)]
SHOULDER = [(0, 18.0, -3.8), (2.4, 17.4, -3.8), (4.2, 14.6, -1.8),
            (3.5, 12.0, 2.6), (1.1, 10.4, 4.7), (0, 9.8, 4.9)]
WAIST = [(0, 13.0, -6.0), (3.0, 12.4, -5.8), (4.7, 9.4, -3.2),
         (3.4, 7.2, 0.8), (1.1, 6.4, 2.3), (0, 6.4, 2.3)]
HAUNCH = [(0, 8.4, -8.4), (3.6, 8.0, -8.0), (6.3, 6.2, -4.4),
          (5.9, 2.6, -0.2), (3.2, 2.3, 0.4), (0, 2.6, -0.6)]
SEAT = [(0, 4.8, -10.0), (3.2, 4.4, -9.6), (5.9, 2.4, -7.0),
        (5.6, 0, -4.2), (3.1, 0, -4.0), (0, 0, -4.6)]
TAIL_ROOT = [(0, 3.6, -11.0), (1.7, 2.9, -10.9), (1.9, 0.9, -10.2),
             (0, 0, -9.6)]

# From this point of each ring on, down to the belly, the fur is cream.
PALE_FROM = (2, 2, 2, 3, 3, 4, 4, 6)

EAR_TIP = (5.8, 31.82, 0.6)
EAR_HOLLOW = (3.83, 26.12, 1.73)


def build():
    fox = Mesh("fox")
    fox.use(material="fur")
    rings = [fox.ring(r) for r in (
        NOSE, MUZZLE, EYES, BROW, CHEEK, NAPE, SHOULDER, WAIST, HAUNCH,
        SEAT, TAIL_ROOT)]
    for front, rear in zip(rings, rings[1:]):
        fox.zip_rows(front, rear)
    # The cheek's crease runs where the white of the face ends.
    fox.crease(rings[2][2], rings[2][3], rings[3][3], rings[3][2])
    pale = {p for ring, first in zip(rings, PALE_FROM) for p in ring[first:]}
    fox.paint_between("cream", pale)
    nose, _, eyes, brow, cheek, _, shoulder, waist, haunch, seat, root = rings
    add_nose(fox, nose)
    add_eye(fox, eyes, brow)
    add_ear(fox, brow, cheek)
    add_foreleg(fox, shoulder, waist)
    add_hind_foot(fox, haunch, seat)
    twin = fox.mirror_x()
    add_tail(fox, root + [twin[i] for i in reversed(root[1:-1])])
    fox.triangulate()
    return fox


def add_nose(fox, nose):
    tip = fox.point((0, 20.7, 11.2))
    fox.use(material="dark")
    for upper, lower in zip(nose, nose[1:]):
        fox.face(tip, lower, upper)
    fox.use(material="fur")


def add_eye(fox, eyes, brow):
    """A dark slanting triangle inside the cell beside the nose bridge."""
    inner, cheek, temple, forehead = eyes[1], eyes[2], brow[2], brow[1]
    fox.open_hole([(inner, cheek, temple, forehead)])
    low = fox.point((2.84, 22.3, 4.67))
    outer = fox.point((3.65, 23.84, 3.59))
    fox.face(inner, cheek, low)
    fox.face(cheek, temple, low)
    fox.face(low, temple, outer)
    fox.face(outer, temple, forehead)
    fox.face(inner, outer, forehead)
    fox.use(material="dark")
    fox.face(inner, low, outer)
    fox.use(material="fur")


def add_ear(fox, brow, cheek):
    """A pyramid on the cell above the temple, hollowed in front."""
    inner, outer, back_outer, back_inner = brow[1], brow[2], cheek[2], cheek[1]
    fox.open_hole([(inner, outer, back_outer, back_inner)])
    tip, hollow = fox.point(EAR_TIP), fox.point(EAR_HOLLOW)
    fox.face(outer, back_outer, tip)
    fox.face(back_outer, back_inner, tip)
    fox.face(back_inner, inner, tip)
    fox.use(material="dark")
    fox.face(inner, outer, hollow)
    fox.face(outer, tip, hollow)
    fox.face(tip, inner, hollow)
    fox.use(material="fur")


def grow(mesh, rim, levels):
    """Prolong a rim ring by ring; returns the last ring."""
    for level in levels:
        ring = mesh.ring(level)
        mesh.tube(rim, ring)
        rim = ring
    return rim


def add_foreleg(fox, shoulder, waist):
    rim = [shoulder[3], shoulder[4], waist[4], waist[3]]
    fox.open_hole([rim])
    rim = grow(fox, rim, [
        [(3.3, 6.4, 4.4), (0.9, 6.2, 4.9), (0.9, 5.0, 2.7), (3.2, 5.2, 2.0)]])
    fox.use(material="dark")
    rim = grow(fox, rim, [
        [(2.9, 1.8, 4.9), (1.0, 1.8, 5.1), (1.0, 1.6, 3.1), (2.9, 1.6, 2.9)],
        [(3.1, 0, 6.6), (0.9, 0, 6.8), (0.9, 0, 3.0), (3.1, 0, 2.8)]])
    fox.face(*rim)
    fox.use(material="fur")


def add_hind_foot(fox, haunch, seat):
    rim = [haunch[3], haunch[4], seat[4], seat[3]]
    fox.open_hole([rim])
    fox.use(material="dark")
    rim = grow(fox, rim, [
        [(5.6, 1.7, 2.4), (3.6, 1.7, 2.6), (3.6, 0, 3.8), (5.8, 0, 3.5)]])
    fox.face(*rim)
    fox.use(material="fur")


# Where the tail's rings sit: centre, heading, half width, half height.
TAIL = [((2.4, 2.0, -13.4), (0.75, 0.1, -0.66), 2.0, 2.0),
        ((7.2, 2.9, -14.6), (1.0, 0.0, 0.15), 3.1, 2.9),
        ((12.0, 3.4, -10.4), (0.4, 0.0, 0.9), 3.6, 3.4),
        ((12.9, 3.1, -4.4), (-0.1, 0.0, 1.0), 3.2, 3.1),
        ((11.9, 2.4, 0.6), (-0.35, 0.2, 0.95), 2.2, 2.1)]
TAIL_TIP = (9.2, 3.4, 5.6)
# A ring's corners as shares of those, from the top down the right side.
SECTION = [(0, 1), (0.9, 0.45), (0.8, -0.7),
           (0, -1), (-0.8, -0.7), (-0.9, 0.45)]


def add_tail(fox, rim):
    """Six-sided rings along a path that sweeps forward on the fox's left."""
    for number, (centre, heading, width, height) in enumerate(TAIL):
        side = vec.unit(vec.cross(heading, (0, 1, 0)))
        ring = fox.ring([
            vec.add(vec.add(centre, vec.scale(side, s * width)),
                    (0, u * height, 0)) for s, u in SECTION])
        fox.use(material="cream" if number == len(TAIL) - 1 else "fur")
        fox.tube(rim, ring)
        rim = ring
    fox.fan(rim, fox.point(TAIL_TIP))
