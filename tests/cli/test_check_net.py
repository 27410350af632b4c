#!/usr/bin/env python3
"""tests/cli/test_check_net.py - the checker itself: sound nets pass, each kind of damage is seen.

    test_check_net.py PROGRAM SAMPLES"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_net  # noqa: E402


def move_vertex(d):
    d['pieces'][0]['vertices'][5][0] += 1e-4


def mirror(d):
    for v in d['pieces'][0]['vertices']:
        v[0] = -v[0]


def lose_a_face(d):
    d['pieces'][0]['faces'].pop()


def show_a_face_twice(d):
    d['pieces'][0]['faces'].append(d['pieces'][0]['faces'][3])


def call_a_cut_a_fold(d):
    next(e for e in d['edges'] if e['kind'] == 'cut')['kind'] = 'mountain'


def call_a_cut_a_border(d):
    next(e for e in d['edges'] if e['kind'] == 'cut')['kind'] = 'border'


def call_a_fold_a_cut(d):
    next(e for e in d['edges'] if e['kind'] == 'mountain')['kind'] = 'cut'


def name_an_edge_twice(d):
    d['edges'].append(d['edges'][0])


def turn_a_tab_inwards(d):
    tab = d['pieces'][0]['tabs'][0]['polygon']
    (ax, ay), (bx, by) = tab[0], tab[-1]
    tab[:] = [[ax + bx - x, ay + by - y] for x, y in tab]


def leave_the_sheet(d):
    d['sheets'][0]['placements'][0]['y'] += 400


def lie_on_two_sheets(d):
    d['sheets'].append(copy.deepcopy(d['sheets'][0]))


def lie_on_two_tiles(d):
    """Halves of the sheet, which share a strip: sound."""
    sheet = d['sheets'][0]
    sheet['kind'] = 'tile'
    d['sheets'].append(copy.deepcopy(sheet))
    sheet['printable'][2], d['sheets'][1]['printable'][0] = 110, 100


def lie_between_two_tiles(d):
    lie_on_two_tiles(d)
    d['sheets'][1]['printable'][0] = 110.1


def lie_on_a_tile_and_a_sheet(d):
    lie_on_two_tiles(d)
    d['sheets'].append(copy.deepcopy(d['sheets'][0]))
    d['sheets'][2]['kind'] = 'sheet'


def cut_an_outline_short(d):
    d['pieces'][0]['outline'].pop(0)


def grow(d):
    """Everything is larger than the model says."""
    d['model']['mm_per_unit'] *= 1 + 1e-6


def turn_the_surface_inside_out(d):
    for face in d['mesh']['faces']:
        face.reverse()
    for piece in d['pieces']:
        for entry in piece['faces']:
            entry['corners'].reverse()
        for v in piece['vertices'] + piece['outline']:
            v[0] = -v[0]
        piece['tabs'] = []
        piece['outline'].reverse()


DAMAGE = [move_vertex, mirror, lose_a_face, show_a_face_twice, call_a_cut_a_fold,
          call_a_cut_a_border, call_a_fold_a_cut, name_an_edge_twice, turn_a_tab_inwards,
          leave_the_sheet, lie_on_two_sheets, lie_between_two_tiles,
          lie_on_a_tile_and_a_sheet, cut_an_outline_short, grow,
          turn_the_surface_inside_out]


def overlap_is_seen():
    """Two triangles that share an edge, one that reaches into them, one far away."""
    a, b = [(0, 0), (4, 0), (0, 3)], [(4, 0), (4, 3), (0, 3)]
    c, far = [(1, 1), (9, 1), (9, 2)], [(20, 0), (24, 0), (20, 3)]
    pairs = lambda *shapes: [(x, y) for x, y, _ in check_net.crowded(
        [(i, s, False) for i, s in enumerate(shapes)], check_net.FACE_MM)]
    return not pairs(a, b, far) and len(pairs(a, b, c, far)) == 2 and len(pairs(a, a)) == 1


def main():
    program, samples = sys.argv[1], pathlib.Path(sys.argv[2])
    model = samples / 'fox.obj'
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / 'net.json'
        subprocess.run([program, 'unfold', model, '-q', '-o', path], check=True)
        sound = json.loads(path.read_text())
    model = check_net.read_model(str(model))
    results = [('a_sound_net_passes', not check_net.check(sound, model)[1]),
               ('overlap_is_seen', overlap_is_seen())]
    tiled = copy.deepcopy(sound)
    lie_on_two_tiles(tiled)
    results.append(('a_sound_net_on_tiles_passes', not check_net.check(tiled, model)[1]))
    for damage in DAMAGE:
        d = copy.deepcopy(sound)
        damage(d)
        results.append((damage.__name__, bool(check_net.check(d, model)[1])))
    print('1..%d' % len(results))
    for number, (name, good) in enumerate(results, 1):
        print('%s %d - %s' % ('ok' if good else 'not ok', number, name))
    sys.exit(not all(good for _, good in results))


if __name__ == '__main__':
    main()
