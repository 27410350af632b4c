"""A carnival mask with two eye holes, half placed by hand and mirrored.

Rows run from the crown to below the chin, each from the middle (x = 0)
outward to the rim of the mask.
"""

from .mesh import Mesh

ROWS = [
    [(0, 13.4, 3.4), (2.8, 12.2, 3.2), (5.2, 10.4, 2.0), (7.0, 8.0, 0.4),
     (8.0, 5.6, -1.8)],
    [(0, 8.8, 6.6), (2.6, 8.6, 6.0), (5.0, 7.4, 4.6), (7.0, 5.4, 2.2),
     (8.4, 3.4, -1.6)],
    [(0, 5.0, 6.8), (1.7, 4.5, 7.6), (4.2, 5.2, 7.0), (6.7, 4.2, 4.2),
     (8.5, 1.4, -1.0)],
    [(0, 2.2, 8.4), (1.4, 1.2, 7.4), (3.8, 0.0, 6.6), (6.8, 0.6, 4.6),
     (8.4, -1.0, -0.8)],
    [(0, -1.8, 11.0), (1.8, -2.2, 8.3), (4.0, -2.4, 7.3), (6.4, -2.6, 4.8),
     (8.0, -3.8, -0.8)],
    [(0, -4.6, 8.9), (1.4, -4.3, 8.6), (3.7, -5.0, 6.9), (5.9, -5.4, 3.8),
     (7.2, -6.4, -0.9)],
    [(0, -5.9, 8.8), (1.4, -5.9, 8.5), (3.3, -6.1, 7.2), (5.2, -7.8, 3.6),
     (6.1, -8.8, -0.8)],
    [(0, -7.6, 8.8), (1.3, -7.4, 8.4), (3.0, -8.0, 6.7), (4.3, -9.8, 3.4),
     (4.7, -10.8, -0.4)],
    [(0, -10.4, 8.4), (1.5, -10.5, 7.9), (2.6, -10.9, 6.0), (3.2, -11.8, 3.2),
     (3.3, -12.2, 0.2)],
    [(0, -12.6, 6.8), (1.2, -12.5, 6.4), (1.9, -12.7, 4.8), (1.9, -13.0, 3.0),
     (1.8, -13.0, 0.9)],
]

EYE = [(2.2, 2.6, 7.0), (3.8, 1.5, 6.5), (5.7, 2.0, 5.1),
       (5.9, 3.0, 5.0), (4.2, 3.8, 6.6), (2.4, 3.5, 7.1)]


def build():
    mask = Mesh("mask")
    mask.use(material="paper")
    rows = [mask.ring(r) for r in ROWS]
    for upper, lower in zip(rows, rows[1:]):
        mask.strip(lower, upper)
    add_lips(mask, *rows[5:8])
    mask.paint_between("red", set(rows[0][:2] + rows[1][:2] + rows[2][:1]))
    mask.use(material="gold")
    add_eye_hole(mask, rows[2], rows[3])
    mask.mirror_x()
    mask.triangulate()
    return mask


def add_eye_hole(mask, brow, cheek):
    """A gold frame that leads from two cells into an almond-shaped hole."""
    rim = [cheek[1], cheek[2], cheek[3], brow[3], brow[2], brow[1]]
    mask.open_hole([(cheek[j], cheek[j + 1], brow[j + 1], brow[j])
                    for j in (1, 2)])
    mask.tube(rim, mask.ring(EYE))


def add_lips(mask, upper, middle, lower):
    """Red cells, drawn out to the corner of the mouth by two creases."""
    mask.crease(middle[2], upper[2], upper[1], middle[1])
    mask.crease(lower[1], lower[2], middle[2], middle[1])
    mask.paint_between("red", set(upper[:2] + middle[:3] + lower[:2]))
