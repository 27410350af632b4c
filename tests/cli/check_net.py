#!/usr/bin/env python3
"""tests/cli/check_net.py - proves a paper pattern with nothing of the library: its own readers, its
own adjacency, its own test of overlap. A second opinion on what `katagami verify` says.

    check_net.py PATTERN.json [MODEL.obj|MODEL.off]

Checked: every face once and the right way round; lengths in the plane against the surface; folds
whose two faces share their points, cuts and borders where the surface has them; pieces that hang
together; no two faces, no tab and face, no two tabs that overlap, on the piece and on the sheet;
every piece on one sheet and inside its printable area, or whole on the tiles of a poster; and with the model, that the surface is the
model's triangles, or a triangulation of its polygons, times mm_per_unit (for models that needed no
repair: splitting a neighbour of a sliver makes other triangles). Exit status 0 or 1."""

import collections
import json
import math
import sys

LENGTH = 1e-9     # relative error of an edge's length, ...
SHORT = 1e-12     # ... and, of the largest coordinate, what a chain of a thousand needles may lose
NOISE = 1e-14     # what coordinates cannot tell, of the largest one
POSITION = 1e-9   # of a vertex against the model, over the model's diagonal
FACE_MM = 1e-5    # how deep two faces may lie in each other, ...
FACE = 1e-7       # ... or so much of the surface's diagonal: what unfolding promises
TAB_MM = 1e-3     # a tab and anything
SHEET_MM = 1e-6   # how far anything may leave the printable area


class Problems(list):
    def add(self, text, *values):
        self.append(text % values)


# ---- models ------------------------------------------------------------------------------------

def read_obj(lines):
    points, polygons = [], []
    for line in lines:
        words = line.split('#')[0].split()
        if words[:1] == ['v']:
            points.append(tuple(float(w) for w in words[1:4]))
        elif words[:1] == ['f']:
            numbers = [int(w.split('/')[0]) for w in words[1:]]
            polygons.append([n - 1 if n > 0 else len(points) + n for n in numbers])
    return points, polygons


def read_off(lines):
    words = iter(' '.join(line.split('#')[0] for line in lines).split())
    if next(words) != 'OFF':
        raise ValueError('not an OFF file')
    point_count, face_count, _ = int(next(words)), int(next(words)), next(words)
    points = [tuple(float(next(words)) for _ in range(3)) for _ in range(point_count)]
    return points, [[int(next(words)) for _ in range(int(next(words)))] for _ in range(face_count)]


def read_model(path):
    with open(path, encoding='utf-8', errors='replace') as file:
        lines = file.read().replace('\\\n', ' ').splitlines()
    return read_off(lines) if path.lower().endswith('.off') else read_obj(lines)


# ---- vectors -----------------------------------------------------------------------------------

def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def distance(a, b):
    return math.dist(a, b)


def area_vector(corners):
    total = (0.0, 0.0, 0.0)
    for k in range(1, len(corners) - 1):
        a, b = sub(corners[k], corners[0]), sub(corners[k + 1], corners[0])
        total = tuple(t + c / 2 for t, c in zip(total, (
            a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])))
    return total


def signed_area(corners):
    """From the first corner: of a speck far from the origin nothing would be left."""
    x, y = corners[0]
    corners = [(a - x, b - y) for a, b in corners]
    return sum(a[0] * b[1] - a[1] * b[0]
               for a, b in zip(corners, corners[1:] + corners[:1])) / 2


def diagonal(points):
    return distance(*(tuple(f(p[k] for p in points) for k in range(3)) for f in (min, max)))


# ---- overlap of convex polygons: separating axes -------------------------------------------------

def depth(a, b):
    """How far convex polygon a would have to move along a normal of an edge to be clear of b;
    negative when it is."""
    least = math.inf
    for polygon in (a, b):
        for p, q in zip(polygon, polygon[1:] + polygon[:1]):
            nx, ny = q[1] - p[1], p[0] - q[0]
            length = math.hypot(nx, ny)
            if length == 0:
                continue
            da = [(x * nx + y * ny) / length for x, y in a]
            db = [(x * nx + y * ny) / length for x, y in b]
            least = min(least, max(da) - min(db), max(db) - min(da))
            if least <= 0:
                return least
    return least


def crowded(shapes, least):
    """Pairs of shapes (name, polygon, is_tab) that overlap, by a sweep along x."""
    boxes = sorted((min(p[0] for p in s[1]), max(p[0] for p in s[1]), min(p[1] for p in s[1]),
                    max(p[1] for p in s[1]), i) for i, s in enumerate(shapes))
    active = []
    for box in boxes:
        active = [other for other in active if other[1] > box[0]]
        for other in active:
            if other[2] < box[3] and box[2] < other[3]:
                a, b = shapes[other[4]], shapes[box[4]]
                deep = depth(a[1], b[1])
                if deep > (TAB_MM if a[2] or b[2] else least):
                    yield a[0], b[0], deep
        active.append(box)


# ---- the checks --------------------------------------------------------------------------------

class Net:
    def __init__(self, pattern):
        self.points = [tuple(p) for p in pattern['mesh']['vertices']]
        self.faces = pattern['mesh']['faces']
        self.pieces = {piece['id']: piece for piece in pattern['pieces']}
        self.place = {}  # face: (piece id, its three numbers in the piece)
        self.pattern = pattern

    def flat(self, face):
        piece, corners = self.place[face]
        return [tuple(self.pieces[piece]['vertices'][c]) for c in corners]

    def name(self, face):
        return 'face %d of piece %s' % (face, self.place[face][0])


def check_faces(net, problems):
    for number, piece in net.pieces.items():
        for entry in piece['faces']:
            if entry['face'] in net.place:
                problems.add('face %d lies in a piece twice', entry['face'])
            net.place[entry['face']] = (number, entry['corners'])
    for face in range(len(net.faces)):
        if face not in net.place:
            problems.add('face %d lies in no piece', face)
    if problems or len(net.place) != len(net.faces):
        problems.add('%d faces in pieces, %d in the surface', len(net.place), len(net.faces))
        return
    places = [*net.points, *(p for piece in net.pieces.values() for p in piece['vertices'])]
    noise = NOISE * max(abs(x) for p in places for x in p)
    for face, corners in enumerate(net.faces):
        flat = net.flat(face)
        wanted = [distance(net.points[corners[k]], net.points[corners[(k + 1) % 3]]) for k in range(3)]
        height = math.hypot(*area_vector([net.points[c] for c in corners])) / (max(wanted) or 1)
        if signed_area(flat) <= 0 and height > noise:
            problems.add('%s is mirrored', net.name(face))
        for k, wanted in enumerate(wanted):
            found = distance(flat[k], flat[(k + 1) % 3])
            if abs(found - wanted) > LENGTH * wanted + noise / NOISE * SHORT:
                problems.add('%s, side %d: %.12g long instead of %.12g', net.name(face), k, found,
                             wanted)


def surface_edges(net):
    edges = collections.defaultdict(list)
    for face, corners in enumerate(net.faces):
        for k in range(3):
            a, b = corners[k], corners[(k + 1) % 3]
            edges[min(a, b), max(a, b)].append((face, k, a < b))
    return edges


def check_edges(net, problems):
    """Returns for each face those it is folded to."""
    folds = collections.defaultdict(list)
    kinds = {}
    for edge in net.pattern['edges']:
        pair = tuple(sorted(edge['vertices']))
        if pair in kinds:
            problems.add('edge %s is there twice', edge['id'])
        kinds[pair] = edge['kind']
    edges = surface_edges(net)
    for pair in kinds.keys() - edges.keys():
        problems.add('edge %d-%d is not of the surface', *pair)
    for pair, sides in edges.items():
        kind = kinds.get(pair)
        if len(sides) > 2 or (len(sides) == 2 and sides[0][2] == sides[1][2]):
            problems.add('edge %d-%d: the surface is no oriented manifold there', *pair)
        elif len(sides) == 1 and kind != 'border':
            problems.add('edge %d-%d is a border, not %s', *pair, kind)
        elif len(sides) == 2 and kind not in ('cut', 'mountain', 'valley', 'flat'):
            problems.add('edge %d-%d has two faces and is called %s', *pair, kind)
        elif len(sides) == 2 and kind != 'cut':
            (f, k, _), (g, m, _) = sides
            (p, c), (q, d) = net.place[f], net.place[g]
            if p != q or c[k] != d[(m + 1) % 3] or c[(k + 1) % 3] != d[m]:
                problems.add('edge %d-%d is a fold, but its faces do not share it', *pair)
            folds[f].append(g)
            folds[g].append(f)
    return folds


def reached(start, neighbours):
    seen, todo = {start}, [start]
    while todo:
        for other in neighbours[todo.pop()]:
            if other not in seen:
                seen.add(other)
                todo.append(other)
    return seen


def check_pieces(net, folds, problems):
    for number, piece in net.pieces.items():
        faces = [entry['face'] for entry in piece['faces']]
        if not faces or len(reached(faces[0], folds)) != len(faces):
            problems.add('piece %s does not hang together by its folds', number)


def shapes_of(net, number):
    piece = net.pieces[number]
    for entry in piece['faces']:
        yield net.name(entry['face']), net.flat(entry['face']), False
    for tab in piece['tabs']:
        polygon = [tuple(p) for p in tab['polygon']]
        yield 'the tab on edge %s of piece %s' % (tab['edge'], number), polygon, True


def mover(place):
    turn = math.radians(place['rotation_deg'])
    c, s = math.cos(turn), math.sin(turn)
    return lambda p: (c * p[0] - s * p[1] + place['x'], s * p[0] + c * p[1] + place['y'])


def check_inside(sheet, own, problems):
    x0, y0, x1, y1 = sheet['printable']
    for name, polygon, _ in own:
        if any(p[0] < x0 - SHEET_MM or p[0] > x1 + SHEET_MM or p[1] < y0 - SHEET_MM or
               p[1] > y1 + SHEET_MM for p in polygon):
            problems.add('%s leaves the printable area of sheet %s', name, sheet['id'])


def check_sheets(net, problems):
    placed, tiles = collections.Counter(), collections.defaultdict(list)
    least = max(FACE_MM, FACE * diagonal(net.points))
    for sheet in net.pattern['sheets']:
        shapes = []
        for place in sheet['placements']:
            move = mover(place)
            own = [(name, [move(p) for p in polygon], tab)
                   for name, polygon, tab in shapes_of(net, place['piece'])]
            outline = [move(p) for p in net.pieces[place['piece']]['outline']]
            if sheet['kind'] == 'tile':
                tiles[place['piece']].append((sheet, place))
            else:
                placed[place['piece']] += 1
                check_inside(sheet, own + [('the outline of piece %s' % place['piece'], outline, 0)], problems)
            check_outline(own, outline, place['piece'], problems)
            shapes += own
        for a, b, deep in crowded(shapes, least):
            problems.add('%s and %s lie in each other, %.3g mm deep', a, b, deep)
    for number in net.pieces:
        if number in tiles and not placed[number]:
            check_tiles(net, number, tiles[number], problems)
        elif placed[number] != 1 or number in tiles:
            problems.add('piece %s lies on %d sheets', number, placed[number] + len(tiles[number]))


def clip_to(polygon, cell):
    """The part of a convex polygon within x0, y0, x1, y1."""
    for axis in (0, 1):
        for bound, sign in ((cell[axis], 1), (cell[axis + 2], -1)):
            out = []
            for a, b in zip(polygon, polygon[1:] + polygon[:1]):
                da, db = sign * (a[axis] - bound), sign * (b[axis] - bound)
                if da >= 0:
                    out.append(a)
                if da * db < 0:
                    out.append(tuple(x + da / (da - db) * (y - x) for x, y in zip(a, b)))
            polygon = out
    return polygon


def check_tiles(net, number, tiles, problems):
    """Laid side by side the tiles show all of the piece: their edges cut the poster into cells, and
    the cells that lie on a tile hold the whole area."""
    first = tiles[0][1]
    windows = []
    for sheet, place in tiles:
        if place['rotation_deg'] != first['rotation_deg']:
            problems.add('piece %s is turned differently on its tiles', number)
        dx, dy = first['x'] - place['x'], first['y'] - place['y']
        x0, y0, x1, y1 = sheet['printable']
        windows.append((x0 + dx, y0 + dy, x1 + dx, y1 + dy))
    xs, ys = (sorted({w[k] for w in windows} | {w[k + 2] for w in windows}) for k in (0, 1))
    cells = [(x0, y0, x1, y1) for x0, x1 in zip(xs, xs[1:]) for y0, y1 in zip(ys, ys[1:])
             if any(w[0] <= x0 and w[1] <= y0 and x1 <= w[2] and y1 <= w[3] for w in windows)]
    move, lost = mover(first), 0.0
    for _, polygon, _ in shapes_of(net, number):
        polygon = [move(p) for p in polygon]
        seen = sum(signed_area(part) for cell in cells if len(part := clip_to(polygon, cell)) > 2)
        lost += signed_area(polygon) - seen
    if lost > 1e-4:
        problems.add('%.3g mm2 of piece %s are on none of its tiles', lost, number)


def check_outline(shapes, outline, number, problems):
    """What is cut out is what is there: the outline's area is that of faces and tabs."""
    wanted = sum(signed_area(polygon) for _, polygon, _ in shapes)
    noise = NOISE * max(abs(x) for p in outline for x in p) ** 2
    if abs(signed_area(outline) - wanted) > 1e-6 * wanted + noise:
        problems.add('the outline of piece %s holds %.9g mm2, its faces and tabs %.9g', number,
                     signed_area(outline), wanted)


class Finder:
    """The points of a model by place."""

    def __init__(self, points, reach):
        self.reach, self.cells, self.points = reach, collections.defaultdict(list), points
        for i, p in enumerate(points):
            self.cells[self.cell(p)].append(i)

    def cell(self, p):
        return tuple(math.floor(x / (4 * self.reach)) for x in p)

    def near(self, p):
        low, high = (self.cell(tuple(x + s * self.reach for x in p)) for s in (-1, 1))
        cells = {(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
                 for z in (low[2], high[2])}
        return frozenset(i for c in cells for i in self.cells.get(c, ())
                         if distance(self.points[i], p) <= self.reach)


def check_model(net, points, polygons, problems):
    """Each polygon of n corners is n - 2 triangles of the surface, of the same area and side. Points
    of the model that coincide are one."""
    scale = net.pattern['model']['mm_per_unit']
    points = [tuple(scale * x for x in p) for p in points]
    finder = Finder(points, POSITION * diagonal(points))
    first = [min(finder.near(p)) for p in points]
    place = [min(finder.near(p), default=None) for p in net.points]
    owners = collections.defaultdict(list)
    for i, polygon in enumerate(polygons):
        for corner in {first[c] for c in polygon}:
            owners[corner].append(i)
    count, area = collections.Counter(), collections.defaultdict(lambda: (0.0, 0.0, 0.0))
    for face, corners in enumerate(net.faces):
        of = [place[c] for c in corners]
        polygon = None
        if None not in of:
            common = set(owners[of[0]]) & set(owners[of[1]]) & set(owners[of[2]])
            here = [i for i in common if count[i] < len(polygons[i]) - 2]
            polygon = min(here, key=lambda i: (len(polygons[i]), i), default=None)
        if polygon is None:
            problems.add('face %d is no part of a face of the model', face)
            continue
        count[polygon] += 1
        own = area_vector([net.points[c] for c in corners])
        area[polygon] = tuple(x + y for x, y in zip(area[polygon], own))
    for i, polygon in enumerate(polygons):
        wanted = area_vector([points[c] for c in polygon])
        size = max(distance(points[a], points[b]) for a in polygon for b in polygon)
        if count[i] != len(polygon) - 2:
            problems.add('face %d of the model is %d triangles, not %d', i, count[i],
                         len(polygon) - 2)
        elif distance(area[i], wanted) > 1e-7 * size * size:
            problems.add('face %d of the model has another area, or shows its other side', i)


def check(pattern, model=None):
    problems = Problems()
    net = Net(pattern)
    check_faces(net, problems)
    if problems:
        return net, problems
    check_pieces(net, check_edges(net, problems), problems)
    check_sheets(net, problems)
    if model and not pattern['model']['simplified']:
        check_model(net, *model, problems)
    return net, problems


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    with open(sys.argv[1], encoding='utf-8') as file:
        pattern = json.load(file)
    net, problems = check(pattern, read_model(sys.argv[2]) if len(sys.argv) == 3 else None)
    for problem in problems[:10]:
        print('%s: %s' % (sys.argv[1], problem))
    if problems:
        sys.exit('%d problems' % len(problems))
    print('sound: %d faces in %d pieces' % (len(net.faces), len(net.pieces)))


if __name__ == '__main__':
    main()
