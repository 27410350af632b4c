"""A whale to be sewn from plush, 45 cm long.

Half rings run from the forehead to the tail, each from the back (x = 0)
down the left side to the belly (x = 0).  Three gores of each half, back,
side and belly, meet at the forehead; the belly is one with its mirror
image.  Flippers and flukes are flat cushions: a flipper grows out of the
seam between side and belly, the flukes out of the last ring.
"""

import math

from . import vec
from .curves import bezier, coons, spaced
from .mesh import Mesh

HEAD_ROWS, BODY_ROWS = 10, 24
HEAD_Z, HEAD_LENGTH, TAIL_Z = 8.0, 10.5, -19.0
WIDTH, TOP, BOTTOM = 7.1, 6.4, 6.6     # of the ring at HEAD_Z
TAIL_WIDTH, TAIL_THICK = 2.8, 1.5
HEIGHT, TAIL_RISE = 6.8, 3.6           # of the middle line
# Where the seams of back and side, side and belly run: degrees from the
# top, at the head and at the tail.
SEAMS = [(73.0, 45.0), (137.0, 90.0)]
EDGE = 1.3             # how long edges should be
TAIL_SEGMENTS = (3, 3, 6)

FLIPPER_ROWS = (11, 16)                # the rings between which it grows
FLIPPER_OUT = (0.78, -0.42, -0.46)
FLIPPER = [  # front edge, tip, rear edge: (along the seam, outward)
    [(-2.8, 0.0), (-2.5, 3.2), (-0.6, 6.6), (1.2, 8.0)],
    [(1.2, 8.0), (2.0, 8.7), (3.5, 8.5), (3.7, 7.2)],
    [(2.8, 0.0), (1.9, 2.4), (3.9, 5.0), (3.7, 7.2)]]
FLIPPER_THICK = 0.7
FLUKE = [    # notch, trailing edge, leading edge: (sideways, backward)
    [(0.0, 0.0), (0.0, 1.5), (0.0, 3.0), (0.0, 4.4)],
    [(0.0, 4.4), (2.5, 6.6), (7.6, 9.0), (9.8, 6.6)],
    [(2.8, 0.0), (3.4, 2.6), (9.6, 2.4), (9.8, 6.6)]]
CUSHION_ROWS = 7
GROUPS = ["back_left", "back_right", "side_left", "side_right", "belly",
          "fluke_top", "fluke_bottom", "flipper_left_top",
          "flipper_left_bottom", "flipper_right_top", "flipper_right_bottom"]


def build():
    whale = Mesh("plush-whale")
    rows = [body_row(whale, k) for k in range(HEAD_ROWS + BODY_ROWS + 1)]
    base = open_flipper(whale, rows)
    for part, (group, colour) in enumerate((
            ("back_left", "sea"), ("side_left", "sea"), ("belly", "cream"))):
        whale.use(group=group, material=colour)
        for front, rear in zip(rows, rows[1:]):
            whale.zip_rows(front[part], rear[part])
    whale.triangulate()
    add_flipper(whale, *base)
    add_fluke(whale, rows[-1])
    whale.mirror_x(rename=lambda name: name.replace("left", "right"))
    whale.sort_groups(GROUPS)
    return whale


# -- the body ---------------------------------------------------------------

def body_row(whale, k):
    """One half ring as three rows of points, which share their ends."""
    if k == 0:
        return [[whale.point((0.0, HEIGHT, HEAD_Z + HEAD_LENGTH))]] * 3
    last = HEAD_ROWS + BODY_ROWS
    turns = seam_turns(k)
    parts = []
    for part, (low, high) in enumerate(zip(turns, turns[1:])):
        segments = segment_count(k, part)
        if k == last:
            segments = TAIL_SEGMENTS[part]
        first = parts[-1][-1:] if parts else []
        ids = first + whale.ring([
            ring_place(k, low + (high - low) * n / segments)
            for n in range(len(first), segments + 1)])
        parts.append(ids)
    return parts


def segment_count(k, part):
    """As many as keep edges near EDGE; no more than one more each row."""
    last = HEAD_ROWS + BODY_ROWS
    turns = seam_turns(k)
    places = [ring_place(k, turns[part] + (turns[part + 1] - turns[part])
                         * n / 8) for n in range(9)]
    reach = sum(vec.distance(a, b) for a, b in zip(places, places[1:]))
    count = max(1, round(reach / EDGE))
    return max(min(count, k), TAIL_SEGMENTS[part] - (last - k))


def seam_turns(k):
    share = smooth(max(0.0, (k - HEAD_ROWS) / BODY_ROWS))
    return [0.0] + [a + (b - a) * share for a, b in SEAMS] + [180.0]


def ring_place(k, turn):
    """A place on ring k, turned from the top towards the left."""
    if k <= HEAD_ROWS:
        angle = 0.5 * math.pi * k / HEAD_ROWS
        z, share, size = HEAD_Z + HEAD_LENGTH * math.cos(angle), 0.0, \
            math.sin(angle)
    else:
        share, size = (k - HEAD_ROWS) / BODY_ROWS, 1.0
        z = HEAD_Z + (TAIL_Z - HEAD_Z) * share
    taper = smooth(share)
    angle = math.radians(turn)
    tall = TOP if turn < 90.0 else BOTTOM
    x = 0.0 if turn in (0.0, 180.0) else math.sin(angle)
    return (size * (WIDTH + (TAIL_WIDTH - WIDTH) * taper) * x,
            HEIGHT + TAIL_RISE * share ** 2.0
            + size * (tall + (TAIL_THICK - tall) * taper) * math.cos(angle),
            z)


def smooth(share):
    return share * share * (3.0 - 2.0 * share)


# -- cushions ---------------------------------------------------------------

def open_flipper(whale, rows):
    """Open the seam of side and belly; return its two lips, front to rear."""
    first, last = FLIPPER_ROWS
    upper = [rows[k][1][-1] for k in range(first, last + 1)]
    lower = list(upper)
    places = [whale.points[i] for i in upper]
    across = vec.unit(vec.cross(vec.sub(places[-1], places[0]),
                                FLIPPER_OUT))
    if across[1] < 0.0:
        across = vec.scale(across, -1.0)
    for n in range(1, len(upper) - 1):
        lip = vec.scale(across, FLIPPER_THICK
                        * math.sin(math.pi * n / (len(upper) - 1)))
        whale.points[upper[n]] = vec.add(places[n], lip)
        lower[n] = whale.point(vec.sub(places[n], lip))
        rows[first + n][2] = [lower[n]] + rows[first + n][2][1:]
    return upper, lower


def add_flipper(whale, upper, lower):
    front, rear = whale.points[upper[0]], whale.points[upper[-1]]
    middle = vec.mean([front, rear])
    along = vec.unit(vec.sub(rear, front))
    out = vec.sub(FLIPPER_OUT, vec.scale(along, vec.dot(FLIPPER_OUT, along)))
    out = vec.unit(out)

    def place(p):
        return vec.add(middle, vec.add(vec.scale(along, p[0]),
                                       vec.scale(out, p[1])))

    front_edge, tip, rear_edge = [[place(p) for p in bezier(*c)]
                                  for c in FLIPPER]
    # The drawing's corners are put onto the seam as it is.
    front_edge[0], rear_edge[0] = front, rear
    add_cushion(whale, ("flipper_left_top", "flipper_left_bottom"),
                upper, lower, front_edge, tip, rear_edge)


def add_fluke(whale, ring):
    upper = ring[0] + ring[1][1:]
    lower = list(reversed(ring[2]))
    height = whale.points[upper[-1]][1]

    def place(p):
        return (p[0], height, TAIL_Z - p[1])

    notch, trailing, leading = [[place(p) for p in bezier(*c)] for c in FLUKE]
    # These lips run from left to right, so the sheet below comes first.
    add_cushion(whale, ("fluke_bottom", "fluke_top"),
                lower, upper, notch, trailing, leading)


def add_cushion(whale, groups, above, below, left, end, right):
    """Two sheets from the lips of a slit to a common outline.

    The first sheet looks towards its observer when the lips run from the
    bottom to the top and the cushion lies on their right.
    Sheets share the points of the outline, but on the plane x = 0, where
    the cushion goes on in its mirror image.
    """
    columns = len(above) - 1
    middles = [vec.mean([whale.points[a], whale.points[b]])
               for a, b in zip(above, below)]
    swells = [vec.scale(vec.sub(whale.points[a], whale.points[b]), 0.5)
              for a, b in zip(above, below)]
    left, right = spaced(left, CUSHION_ROWS), spaced(right, CUSHION_ROWS)
    end = spaced(end, columns)
    for k in range(1, CUSHION_ROWS + 1):
        t = k / CUSHION_ROWS
        upper, lower = [], []
        for n in range(columns + 1):
            s = n / columns
            at = coons(middles, end, left[k], right[k], n, s, t)
            swell = vec.scale(swells[n], 1.0 - t * t)
            upper.append(whale.point(vec.add(at, swell)))
            shared = vec.length(swell) < 1e-9
            lower.append(upper[-1] if shared else
                         whale.point(vec.sub(at, swell)))
        whale.use(group=groups[0], material="sea")
        whale.strip(upper, above)
        whale.use(group=groups[1], material="sea")
        whale.strip(below, lower)
        above, below = upper, lower
    whale.triangulate()
