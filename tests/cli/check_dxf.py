#!/usr/bin/env python3
"""tests/cli/check_dxf.py - DXF files as ezdxf reads them, against the pattern's JSON.

    check_dxf.py layers PATTERN.json [dashed] FILE.dxf...     one file for each sheet
    check_dxf.py astm PATTERN.json FILE.dxf                   all pieces, after ASTM D6673

Prints problems; exit status 0, 1, or 77 without ezdxf."""

import collections
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import plots  # noqa: E402

NAMES = {'CUT': 'Cut', 'MOUNTAIN': 'Mountain', 'VALLEY': 'Valley', 'TAB_FOLD': 'Tab folds', 'SEW': 'Sew',
         'GRAIN': 'Grain', 'PLACE_ON_FOLD': 'Place on fold', 'DART': 'Dart', 'NOTCH': 'Notch',
         'INTERNAL': 'Internal'}
ASTM = {'sew': '14', 'dart': '8', 'internal': '8', 'grain': '7', 'fold': '6'}


def read(ezdxf, path, problems):
    document = ezdxf.readfile(path)
    if document.dxfversion != 'AC1009':
        problems.append('version %s' % document.dxfversion)
    problems += ['audit: ' + error.message for error in document.audit().errors]
    return document


def way_of(entity):
    """Points and whether it is closed; None for what is no line."""
    if entity.dxftype() == 'LINE':
        return [tuple(entity.dxf.start)[:2], tuple(entity.dxf.end)[:2]], False
    if entity.dxftype() == 'POLYLINE':
        return [tuple(v.dxf.location)[:2] for v in entity.vertices], bool(entity.is_closed)
    return None


def drawing_of(entities, names):
    drawing, texts = {}, collections.defaultdict(list)
    for entity in entities:
        layer = names.get(entity.dxf.layer, entity.dxf.layer)
        if way_of(entity):
            drawing.setdefault(layer, []).append(way_of(entity))
        elif entity.dxftype() == 'TEXT':
            texts[layer].append(entity)
    return drawing, texts


def middle_of(text):
    return tuple(text.dxf.align_point)[:2]


def check_texts(texts, expected, problems):
    """Each wanted text stands where it should."""
    for text, x, y in expected:
        away = min((math.dist(middle_of(t), (x, y)) for t in texts if t.dxf.text == text), default=math.inf)
        if away > 1e-3:
            problems.append('text %s is %g mm away' % (text, away))


def labels_on(pattern, sheet):
    pieces = {piece['id']: piece for piece in pattern['pieces']}
    for place in sheet['placements']:
        move = plots.mover(place)
        for label in pieces[place['piece']]['labels']:
            if label.get('edge') is not None:
                yield (label['text'], *move((label['x'], label['y'])))


def check_layers(ezdxf, path, pattern, sheet, dashed):
    problems = []
    document = read(ezdxf, path, problems)
    drawing, texts = drawing_of(document.modelspace(), NAMES)
    expected = plots.wanted(pattern, sheet)
    if document.units != 4:
        problems.append('no millimetres')
    problems += plots.check_cuts(drawing.get('Cut', []), expected['Cut'])
    for layer in NAMES.values():
        if layer != 'Cut':
            solid = layer in ('Notch', 'Internal')
            problems += plots.check_lines(layer, drawing.get(layer, []), expected.get(layer, []),
                                          dashed and not solid and bool(expected.get(layer)))
    check_texts(texts['TEXT'], labels_on(pattern, sheet), problems)
    used = {entity.dxf.layer for entity in document.modelspace()}
    colours = [document.layers.get(name).dxf.color for name in used]
    if len(set(colours)) != len(colours):
        problems.append('two layers of one colour')
    return problems


# ---- ASTM ----

def is_corner(before, at, after, degrees=15):
    a = (at[0] - before[0], at[1] - before[1])
    b = (after[0] - at[0], after[1] - at[1])
    return abs(math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])) > math.radians(degrees)


def key(p):
    return (round(p[0], 3), round(p[1], 3))


def check_points(block, outline, problems):
    """Every corner of the outline is a turn point, what lies between a curve point."""
    there = {layer: {key(tuple(e.dxf.location)) for e in block if e.dxftype() == 'POINT' and e.dxf.layer == layer}
             for layer in ('2', '3')}
    for before, at, after in zip(outline[-1:] + outline[:-1], outline, outline[1:] + outline[:1]):
        layer = '2' if is_corner(before, at, after) else '3'
        if key(at) not in there[layer] and min((math.dist(at, p) for p in there[layer]), default=9) > 2e-3:
            problems.append('(%.3f, %.3f) is no point of layer %s' % (*at, layer))
            return


def check_block(block, piece, problems):
    drawing, texts = drawing_of(block, {})
    outline = [tuple(p) for p in piece['outline']]
    boundary = drawing.get('1', [])
    if len(boundary) != 1 or not boundary[0][1] or len(boundary[0][0]) != len(outline) or \
            max(math.dist(a, b) for a, b in zip(boundary[0][0], outline)) > 1e-3:
        problems.append('piece %d: the boundary is another' % piece['id'])
    for layer in sorted(set(ASTM.values())):
        wanted = [([tuple(p) for p in line['points']], False) for line in piece['lines']
                  if ASTM.get(line['kind']) == layer]
        total = sum(plots.length_of(*way) for way in drawing.get(layer, []))
        sum_wanted = sum(plots.length_of(*way) for way in wanted)
        if abs(total - sum_wanted) > 1e-3 * max(1, len(outline)):
            problems.append('layer %s: %.3f mm instead of %.3f' % (layer, total, sum_wanted))
    notches = [e for e in block if e.dxftype() == 'POINT' and e.dxf.layer == '4']
    if len(notches) != sum(line['kind'] == 'notch' for line in piece['lines']):
        problems.append('%d notches' % len(notches))
    check_points(block, outline, problems)
    told = dict(t.dxf.text.split(': ', 1) for t in texts['1'])
    count = '%d,%d' % (piece['cut']['count'], piece['cut']['mirrored'])
    if told.get('Quantity') != count or not told.get('Piece Name') or not told.get('Size'):
        problems.append('told: %s' % told)


def check_astm(ezdxf, path, pattern):
    problems = []
    document = read(ezdxf, path, problems)
    blocks = [block for block in document.blocks if not block.name.startswith('*')]
    wanted = [piece for piece in pattern['pieces'] if piece['cut']['count'] > 0]
    if len(blocks) != len(wanted):
        return problems + ['%d blocks for %d pieces' % (len(blocks), len(wanted))]
    for block, piece in zip(blocks, wanted):
        check_block(block, piece, problems)
    told = [e.dxf.text for e in document.modelspace() if e.dxftype() == 'TEXT']
    if 'Units: METRIC' not in told or not any(text.startswith('Style Name: ') for text in told):
        problems.append('the style tells %s' % told)
    inserts = document.modelspace().query('INSERT')
    if len(inserts) != len(wanted):
        problems.append('%d inserts' % len(inserts))
    first = pattern['sheets'][0]['placements'][0]
    at = [i for i in inserts if i.dxf.name.endswith('_%d' % first['piece'])][0].dxf
    if math.dist(tuple(at.insert)[:2], (first['x'], first['y'])) > 1e-3 or \
            abs((at.rotation - first['rotation_deg'] + 180) % 360 - 180) > 1e-3:
        problems.append('a piece lies elsewhere')
    if pathlib.Path(path).read_bytes().translate(None, bytes(range(32, 127)) + b'\r\n'):
        problems.append('not seven bits')
    return problems


def main():
    try:
        import ezdxf
    except ImportError:
        return 77
    kind, dashed = sys.argv[1], sys.argv[3] == 'dashed'
    pattern = json.loads(pathlib.Path(sys.argv[2]).read_text(encoding='utf-8'))
    paths = sys.argv[4 if dashed else 3:]
    problems = []
    if kind == 'astm':
        problems = check_astm(ezdxf, paths[0], pattern)
    else:
        for path, sheet in zip(paths, pattern['sheets']):
            problems += check_layers(ezdxf, path, pattern, sheet, dashed)
    print('\n'.join(problems[:20]))
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())
