"""tests/cli/plots.py - what the files for machines must hold, from the pattern's JSON, and how an SVG
is read and compared with that.

A drawing is a dictionary: layer -> list of (points, closed) in mm from the sheet's lower left corner,
y up. Nothing here is shared with the program."""

import math
import re
import xml.etree.ElementTree as ElementTree

TOGETHER_MM = 0.02  # cuts nearer than this are one
NEAR_MM = 0.021
SVG = '{http://www.w3.org/2000/svg}'
INKSCAPE = '{http://www.inkscape.org/namespaces/inkscape}'
LINES = {'sew': 'Sew', 'grain': 'Grain', 'fold': 'Place on fold', 'dart': 'Dart', 'notch': 'Notch',
         'internal': 'Internal'}
KNOWN = {'Sheet', 'Calibration 50 mm', 'Registration', 'Poster joins', 'Text', 'Edge to edge',
         'Mountain', 'Valley', 'Tab folds', 'Cut', *LINES.values()}


def length_of(points, closed=False):
    ways = list(zip(points, points[1:])) + ([(points[-1], points[0])] if closed else [])
    return sum(math.dist(a, b) for a, b in ways)


def area_of(points):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1])) / 2


def mover(place):
    turn = math.radians(place['rotation_deg'])
    c, s = math.cos(turn), math.sin(turn)
    return lambda p: (c * p[0] - s * p[1] + place['x'], s * p[0] + c * p[1] + place['y'])


def folds_of(pattern, flat_deg=1.0):
    """For each piece its folds and the feet of its tabs: layer, start, end in the piece."""
    pieces = {piece['id']: piece for piece in pattern['pieces']}
    corners = {(p['id'], face['face']): face['corners'] for p in pattern['pieces'] for face in p['faces']}
    angles = {edge['id']: edge['angle_deg'] for edge in pattern['edges']}
    folds = {key: [] for key in pieces}
    for edge in pattern['edges']:
        if edge['kind'] in ('mountain', 'valley') and abs(edge['angle_deg']) >= flat_deg:
            side = edge['sides'][0]
            piece, at = pieces[side['piece']], corners[side['piece'], side['face']]
            ends = [piece['vertices'][at[(side['corner'] + k) % 3]] for k in (0, 1)]
            folds[side['piece']].append((edge['kind'].capitalize(), *ends))
    for key, piece in pieces.items():
        for tab in piece['tabs']:
            if abs(angles[tab['edge']]) >= flat_deg:
                folds[key].append(('Tab folds', tab['polygon'][0], tab['polygon'][-1]))
    return folds


def wanted(pattern, sheet):
    """What a sheet should hold: layer -> list of (points, closed); cuts as they are walked."""
    pieces = {piece['id']: piece for piece in pattern['pieces']}
    folds = folds_of(pattern) if pattern['mode'] == 'paper' else {}
    drawing = {}
    for place in sheet['placements']:
        piece, move = pieces[place['piece']], mover(place)
        drawing.setdefault('Cut', []).append(([move(p) for p in piece['outline']], True))
        for layer, a, b in folds.get(piece['id'], []):
            drawing.setdefault(layer, []).append(([move(a), move(b)], False))
        for line in piece['lines']:
            drawing.setdefault(LINES[line['kind']], []).append(([move(p) for p in line['points']], False))
    return drawing


def texts_wanted(pattern, sheet):
    pieces = {piece['id']: piece for piece in pattern['pieces']}
    return sorted(label['text'] for place in sheet['placements'] for label in pieces[place['piece']]['labels'])


# ---- reading an SVG ----

class Svg:
    def __init__(self, path):
        self.root = ElementTree.parse(path).getroot()
        self.width, self.height = self.root.get('width'), self.root.get('height')
        box = [float(n) for n in self.root.get('viewBox').split()]
        self.units = 1.0 if self.width.endswith('mm') else None
        self.box = box
        self.layers, self.colours, self.texts, self.problems = {}, {}, {}, []

    def read(self, height_mm):
        units = self.box[3] / height_mm
        for group in self.root.findall(SVG + 'g'):
            label = group.get(INKSCAPE + 'label')
            if label == 'Colours':
                self.read_picture(group)
                continue
            if group.get(INKSCAPE + 'groupmode') != 'layer' or label not in KNOWN or label in self.layers:
                self.problems.append('layer %s' % label)
            self.layers[label], self.texts[label], colours = [], [], set()
            for path in group.findall(SVG + 'path'):
                colours.add(path.get('stroke'))
                self.layers[label] += self.ways(path.get('d'), height_mm, units)
            for text in group.findall(SVG + 'text'):
                colours.add(text.get('fill'))
                self.texts[label].append((text.text, float(text.get('font-size')) / units))
            if len(colours) != 1:
                self.problems.append('%s has the colours %s' % (label, colours))
            self.colours[label] = colours.pop() if colours else None
        for element in self.root.iter():
            if element.get('class') or element.get('style'):
                self.problems.append('an element with a class or a style')
        return self

    def read_picture(self, group):
        """A picture lies under all else, within the sheet."""
        pictures = group.findall(SVG + 'image')
        self.picture = pictures[0] if len(pictures) == 1 else None
        if self.layers or self.picture is None or len(group) != 1:
            self.problems.append('the colours are not one picture under all layers')
            return
        x, y, wide, high = (float(self.picture.get(name)) for name in ('x', 'y', 'width', 'height'))
        if x < -0.1 or y < -0.1 or x + wide > self.box[2] + 0.1 or y + high > self.box[3] + 0.1:
            self.problems.append('the picture of the colours lies beyond the sheet')

    @staticmethod
    def ways(d, height_mm, units):
        found = []
        for part in re.findall(r'M[^M]*', d):
            numbers = [float(n) for n in re.findall(r'-?[0-9.]+', part)]
            points = [(x / units, height_mm - y / units) for x, y in zip(numbers[::2], numbers[1::2])]
            found.append((points, part.rstrip().endswith('Z')))
        return found


# ---- comparing ----

class Grid:
    """Segments by cell, to find what is near a point."""

    def __init__(self, ways, cell=2.0):
        self.cell, self.cells = cell, {}
        for points, closed in ways:
            for a, b in zip(points, points[1:] + (points[:1] if closed else [])):
                steps = max(1, int(math.dist(a, b) / cell * 2))
                for k in range(steps + 1):
                    x, y = (a[i] + (b[i] - a[i]) * k / steps for i in (0, 1))
                    for i in (-1, 0, 1):
                        for j in (-1, 0, 1):
                            key = (int(x // cell) + i, int(y // cell) + j)
                            self.cells.setdefault(key, set()).add((tuple(a), tuple(b)))

    def distance(self, p):
        near = self.cells.get((int(p[0] // self.cell), int(p[1] // self.cell)), ())
        return min((self.to_segment(p, a, b) for a, b in near), default=math.inf)

    @staticmethod
    def to_segment(p, a, b):
        d = (b[0] - a[0], b[1] - a[1])
        square = d[0] * d[0] + d[1] * d[1]
        t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / square if square else 0
        t = min(max(t, 0), 1)
        return math.dist(p, (a[0] + t * d[0], a[1] + t * d[1]))


def samples_of(ways):
    for points, closed in ways:
        for a, b in zip(points, points[1:] + (points[:1] if closed else [])):
            yield a
            yield ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)


def far_apart(ways, others):
    """The largest distance from a corner or a middle of one drawing to the other."""
    grid = Grid(others)
    return max((grid.distance(p) for p in samples_of(ways)), default=0)


def shared_length(a, b, c, d):
    """How much of segment ab lies together with cd."""
    way, length = (b[0] - a[0], b[1] - a[1]), math.dist(a, b)
    if length < TOGETHER_MM:
        return 0.0
    along = [(way[0] * (p[0] - a[0]) + way[1] * (p[1] - a[1])) / length for p in (c, d)]
    aside = [(way[0] * (p[1] - a[1]) - way[1] * (p[0] - a[0])) / length for p in (c, d)]
    if along[0] > along[1]:
        along, aside = along[::-1], aside[::-1]
    low, high = max(0.0, along[0]), min(length, along[1])
    if high - low < 10 * TOGETHER_MM:
        return 0.0
    slope = (aside[1] - aside[0]) / (along[1] - along[0])
    apart = max(abs(aside[0] + slope * (t - along[0])) for t in (low, high))
    return high - low if apart < TOGETHER_MM else 0.0


def twice_walked(ways):
    """The length of what lies together with something else, each such pair counted once."""
    ends = [(tuple(a), tuple(b)) for points, closed in ways
            for a, b in zip(points, points[1:] + (points[:1] if closed else []))]
    cells = {}
    for index, (a, b) in enumerate(ends):
        steps = max(1, int(math.dist(a, b)))
        for k in range(steps + 1):
            cell = tuple(int((a[i] + (b[i] - a[i]) * k / steps) // 4) for i in (0, 1))
            cells.setdefault(cell, set()).add(index)
    pairs = {(i, j) for near in cells.values() for i in near for j in near if i < j}
    return sum(shared_length(*ends[i], *ends[j]) for i, j in pairs)


def check_cuts(cuts, walks):
    """The cuts of a file against the outlines of the JSON."""
    problems = []
    away = max(far_apart(cuts, walks), far_apart(walks, cuts))
    if away > NEAR_MM:
        problems.append('cuts are %.4f mm off' % away)
    if twice_walked(cuts) > 0:
        problems.append('%.3f mm are cut twice' % twice_walked(cuts))
    expected = sum(length_of(*way) for way in walks) - twice_walked(walks)
    total = sum(length_of(*way) for way in cuts)
    if abs(total - expected) > 1e-4 * expected + TOGETHER_MM * len(walks):
        problems.append('%.3f mm of cuts instead of %.3f' % (total, expected))
    outer = [closed and area_of(points) > 0 for points, closed in cuts]
    if outer != sorted(outer):
        problems.append('an inner cut comes after an outline')
    areas = [area_of(points) for (points, _), is_outer in zip(cuts, outer) if is_outer]
    if any(a > b * (1 + 1e-4) for a, b in zip(areas, areas[1:])):
        problems.append('a large piece is cut before a small one')
    if sum(outer) != len(walks):
        problems.append('%d closed outlines for %d pieces' % (sum(outer), len(walks)))
    return problems


def check_lines(layer, ways, expected, dashed=False):
    total, sum_expected = (sum(length_of(*way) for way in w) for w in (ways, expected))
    problems = []
    if layer == 'Grain':  # has arrow heads, too
        return problems if far_apart(expected, ways) < 1e-3 else ['the grain lies elsewhere']
    if far_apart(ways, expected) > 1e-3:
        problems.append('%s lies elsewhere' % layer)
    if not dashed and abs(total - sum_expected) > 2e-4 * max(len(ways), len(expected)):
        problems.append('%s: %.3f mm instead of %.3f' % (layer, total, sum_expected))
    if dashed and not 0.4 * sum_expected < total < 0.9 * sum_expected:
        problems.append('%s: dashes of %.3f mm in %.3f' % (layer, total, sum_expected))
    return problems


def check_svg(path, pattern, sheet, dashed=False):
    """Problems of an SVG of that sheet."""
    svg = Svg(path).read(sheet['height'])
    expected, problems = wanted(pattern, sheet), svg.problems
    problems += check_cuts(svg.layers.get('Cut', []), expected['Cut'])
    for layer in ('Mountain', 'Valley', 'Tab folds', *LINES.values()):
        solid = layer in ('Notch', 'Internal')
        problems += check_lines(layer, svg.layers.get(layer, []), expected.get(layer, []),
                                dashed and not solid and bool(expected.get(layer)))
    colours = [c for c in svg.colours.values() if c]
    if len(set(colours)) != len(colours):
        problems.append('two layers of one colour')
    if list(svg.layers)[-1] != 'Cut':
        problems.append('something comes after the cuts')
    found = sorted(text for text, _ in svg.texts.get('Text', []))
    if found != texts_wanted(pattern, sheet):
        problems.append('the texts are others')
    return problems
