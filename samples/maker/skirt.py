"""Two skirts as they are worn, in centimetres: an A-line one and a flared one.

Rings of ovals rise from the hem over the hip to the waist.  Columns of the
grid run from hem to waist, and so do all seams and darts.  The wearer's
left half is made, and mirrored.
"""

import math

from .mesh import Mesh

# Height, half width, depth of the front and of the back of each given ring;
# between the last two of them the skirt hangs straight.
A_LINE = [(58.0, 12.9, 9.3, 9.7), (53.0, 14.4, 10.7, 11.0),
          (46.0, 16.2, 11.8, 12.7), (38.0, 17.4, 12.5, 13.8),
          (0.0, 22.6, 17.4, 19.0)]
FLARED = [(62.0, 12.9, 9.3, 9.7), (56.0, 14.6, 10.8, 11.2),
          (50.0, 16.0, 11.8, 12.5), (42.0, 17.9, 13.3, 14.5),
          (0.0, 28.5, 23.5, 25.0)]
FRONT_DART, BACK_DART = 9.0, 13.0      # about how long darts are
DART_COLUMN = 6        # from the middle, of COLUMNS to the side
WAVE = 0.045           # how far the flared hem swings in and out
COLUMNS = 12           # of a quarter
ROWS = 26


def build():
    """Front and back, with two darts in each."""
    skirt = Mesh("skirt")
    rings = half_rings(skirt, A_LINE, 0.0)
    for name, first, last in (("front", 0, COLUMNS),
                              ("back", COLUMNS, 2 * COLUMNS)):
        add_panel(skirt, name, rings, first, last)
    mark_dart(skirt, rings, DART_COLUMN, FRONT_DART)
    mark_dart(skirt, rings, 2 * COLUMNS - DART_COLUMN, BACK_DART)
    skirt.mirror_x()
    skirt.sort_groups(["front", "back"])
    return skirt


def build_gores():
    """Six gores; those at the sides are named as the wearer sees them."""
    skirt = Mesh("skirt-gores")
    rings = half_rings(skirt, FLARED, WAVE)
    gore = 2 * COLUMNS // 3
    for name, first, last in (("front", 0, gore // 2),
                              ("front_left", gore // 2, COLUMNS),
                              ("back_left", COLUMNS, COLUMNS + gore),
                              ("back", COLUMNS + gore, 2 * COLUMNS)):
        add_panel(skirt, name, rings, first, last)
    skirt.mirror_x(rename=lambda name: name.replace("left", "right"))
    skirt.sort_groups(["front", "front_left", "back_left", "back",
                       "back_right", "front_right"])
    return skirt


def half_rings(skirt, profile, wave):
    """From hem to waist; each from the front's middle round the left side."""
    heights = [profile[0][0] * r / ROWS for r in range(ROWS + 1)]
    return [skirt.ring([place(profile, wave, y, c / (2 * COLUMNS))
                        for c in range(2 * COLUMNS + 1)]) for y in heights]


def place(profile, wave, y, share):
    """A place at height y; share 0 is the front's middle, 1 the back's."""
    width, front, back = (smooth(profile, y, k) for k in (1, 2, 3))
    angle = math.pi * share
    hip = profile[-2][0]
    swing = wave * max(0.0, 1.0 - y / hip) ** 1.5
    out = 1.0 + swing * math.cos(6.0 * angle)
    depth = front if share < 0.5 else back
    x = 0.0 if share in (0.0, 1.0) else width * math.sin(angle)
    return (out * x, y, out * depth * math.cos(angle))


def smooth(profile, y, k):
    """A figure of the profile at height y, without kinks."""
    rings = sorted(profile)
    slopes = slopes_of(rings, k)
    for n, (low, high) in enumerate(zip(rings, rings[1:])):
        if y <= high[0]:
            break
    span = high[0] - low[0]
    t = (y - low[0]) / span
    return (low[k] * (1 + 2 * t) * (1 - t) ** 2
            + high[k] * t * t * (3 - 2 * t)
            + span * (slopes[n] * t * (1 - t) ** 2
                      - slopes[n + 1] * t * t * (1 - t)))


def slopes_of(rings, k):
    chords = [(b[k] - a[k]) / (b[0] - a[0]) for a, b in zip(rings, rings[1:])]
    # The straight part keeps its slope up to the hip.
    return ([chords[0], chords[0]]
            + [0.5 * (p + q) for p, q in zip(chords[1:], chords[2:])]
            + [chords[-1]])


def add_panel(skirt, name, rings, first, last):
    skirt.use(group=name)
    for lower, upper in zip(rings, rings[1:]):
        skirt.strip(lower[first:last + 1], upper[first:last + 1])
    skirt.triangulate()


def mark_dart(skirt, rings, column, length):
    """A slit from the waist down to a point inside the panel."""
    top = skirt.points[rings[-1][column]][1]
    skirt.mark([ring[column] for ring in reversed(rings)
                if skirt.points[ring[column]][1] >= top - length])
