#!/usr/bin/env python3
"""Colours come to the right place of a sheet, the right way round, beyond the cuts, and nothing else does: pages are
printed to dots and compared with what the model says, face by face. usage: test_colours.py PROGRAM"""
import json
import math
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import traceback
import zlib

DOTS_PER_MM = 150 / 25.4


# ---- models ----

def write_png(path, size, colour):
    """colour(u, v) from 0 to 1, v upwards."""
    rows = b''
    for y in range(size):
        rows += b'\0' + bytes(c for x in range(size) for c in colour((x + 0.5) / size, 1 - (y + 0.5) / size))

    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    path.write_bytes(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', size, size, 8, 2, 0, 0, 0)) +
                     chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


def fade(u, v):
    return int(40 + 200 * u), int(40 + 200 * v), 128


CORNERS = [(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1), (-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)]
# the cell (column, row from the top, of four by four) of the image, and the corners from its lower left one on
SIDES = {(1, 1): (0, 1, 2, 3), (2, 1): (1, 5, 6, 2), (3, 1): (5, 4, 7, 6), (0, 1): (4, 0, 3, 7), (1, 0): (3, 2, 6, 7),
         (1, 2): (4, 5, 1, 0)}


def side_box(cell):
    return cell[0] / 4, 1 - (cell[1] + 1) / 4, (cell[0] + 1) / 4, 1 - cell[1] / 4


def in_a_side(u, v):
    return any(a <= u <= c and b <= v <= d for a, b, c, d in map(side_box, SIDES))


def write_cube(here, image='skin.png', mtl='cube.mtl'):
    lines, faces, n = ['mtllib ' + mtl] + ['v %g %g %g' % c for c in CORNERS], ['usemtl skin'], 1
    for cell, corners in SIDES.items():
        a, b, c, d = side_box(cell)
        lines += ['vt %g %g' % at for at in ((a, b), (c, b), (c, d), (a, d))]
        faces.append('f ' + ' '.join('%d/%d' % (corner + 1, n + k) for k, corner in enumerate(corners)))
        n += 4
    (here / 'cube.obj').write_text('\n'.join(lines + faces) + '\n')
    (here / 'cube.mtl').write_text('newmtl skin\nKd 0.2 0.5 0.9\nmap_Kd %s\n' % image)


def colour_of_cube(point, normal):
    """What the image has for a point of the cube's surface: from the side that faces `normal`."""
    for cell, corners in SIDES.items():
        low, right, top = (CORNERS[corners[k]] for k in (0, 1, 3))
        along, up = [[b - a for a, b in zip(low, other)] for other in (right, top)]
        out = (along[1] * up[2] - along[2] * up[1], along[2] * up[0] - along[0] * up[2],
               along[0] * up[1] - along[1] * up[0])
        if sum(a * b for a, b in zip(out, normal)) > 0.9 * math.hypot(*out) * math.hypot(*normal):
            s, t = (sum(d * (p - a) for d, p, a in zip(way, point, low)) / 4 for way in (along, up))
            box = side_box(cell)
            return fade(box[0] + s * (box[2] - box[0]), box[1] + t * (box[3] - box[1]))
    raise AssertionError('no side of the cube looks that way')


def colour_of_ball(point, _):
    r = math.hypot(*point)
    return tuple(int(128 + 110 * math.sin(2.5 * c / r)) for c in point)


def write_ball(path, rows):
    """A ball whose vertices have colours."""
    points = [(math.sin(t) * math.cos(p), math.cos(t), -math.sin(t) * math.sin(p))
              for t in (math.pi * i / rows for i in range(1, rows))
              for p in (math.pi * j / rows for j in range(2 * rows))] + [(0, 1, 0), (0, -1, 0)]
    at, last = (lambda i, j: (i - 1) * 2 * rows + j % (2 * rows)), len(points) - 1
    faces = [(last - 1, at(1, j), at(1, j + 1)) for j in range(2 * rows)]
    faces += [(last, at(rows - 1, j + 1), at(rows - 1, j)) for j in range(2 * rows)]
    for i in range(1, rows - 1):
        for j in range(2 * rows):
            faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    head = ['ply', 'format ascii 1.0', 'element vertex %d' % len(points)]
    head += ['property float %s' % c for c in 'xyz'] + ['property uchar %s' % c for c in ('red', 'green', 'blue')]
    head += ['element face %d' % len(faces), 'property list uchar int vertex_indices', 'end_header']
    head += ['%.7f %.7f %.7f %d %d %d' % (p + colour_of_ball(p, None)) for p in points]
    path.write_text('\n'.join(head + ['3 %d %d %d' % f for f in faces]) + '\n')


# ---- sheets ----

class Page:
    """A page as dots."""

    def __init__(self, pdf):
        stem = str(pdf) + '-page'
        subprocess.run(['pdftoppm', '-r', '150', '-f', '1', '-l', '1', '-singlefile', pdf, stem], check=True)
        data = pathlib.Path(stem + '.ppm').read_bytes()
        kind, width, height, most, self.dots = data.split(maxsplit=4)
        assert (kind, most) == (b'P6', b'255')
        self.width, self.height = int(width), int(height)
        self.dots = data[len(data) - 3 * self.width * self.height:]

    def at(self, x, y):
        """The colour at a point of the sheet in mm, y up."""
        column, row = int(x * DOTS_PER_MM), self.height - 1 - int(y * DOTS_PER_MM)
        start = 3 * (row * self.width + column)
        return tuple(self.dots[start:start + 3])


def sides_of(pattern):
    """Each face of each piece that lies on the first sheet: its number, its corners in 3D and on the sheet."""
    mesh = pattern['mesh']
    for placed in pattern['sheets'][0]['placements']:
        piece = pattern['pieces'][placed['piece'] - 1]
        turn = math.radians(placed['rotation_deg'])
        c, s = math.cos(turn), math.sin(turn)
        flat = [(c * x - s * y + placed['x'], s * x + c * y + placed['y']) for x, y in piece['vertices']]
        for face in piece['faces']:
            yield (face['face'], [mesh['vertices'][v] for v in mesh['faces'][face['face']]],
                   [flat[v] for v in face['corners']])


def blend(points, weights):
    return tuple(sum(w * p[k] for w, p in zip(weights, points)) for k in range(len(points[0])))


def normal_of(solid):
    a, b = [[q - p for p, q in zip(solid[0], other)] for other in solid[1:]]
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def near(a, b, tolerance):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b))


def compare_faces(page, pattern, wanted, unit, tolerance):
    """The part of the sample points within faces that have another colour than they should."""
    steps, wrong, count = [1 / 8, 3 / 8, 5 / 8], 0, 0
    for _, solid, flat in sides_of(pattern):
        for s in steps:
            for t in steps:
                weights = (s, (1 - s) * t, (1 - s) * (1 - t))
                point = blend([[c / unit for c in p] for p in solid], weights)
                count += 1
                wrong += not near(page.at(*blend(flat, weights)), wanted(point, normal_of(solid)), tolerance)
    assert count > 100 or len(pattern['mesh']['faces']) < 20
    return wrong / count


def borders_of(pattern):
    """Each edge of a placed face that is not shared with another face of the sheet: its ends, its unit normal outwards,
    and its face's corners in 3D in the order ends, third."""
    def key(a, b):
        return tuple(sorted((tuple(round(c, 3) for c in a), tuple(round(c, 3) for c in b))))
    seen = {}
    for _, solid, flat in sides_of(pattern):
        for k in range(3):
            order = [k, (k + 1) % 3, (k + 2) % 3]
            seen.setdefault(key(flat[order[0]], flat[order[1]]), []).append(
                ([flat[i] for i in order], [solid[i] for i in order]))
    for found in seen.values():
        if len(found) == 1:
            (a, b, _), solid = found[0]
            length = math.hypot(b[0] - a[0], b[1] - a[1])
            yield a, b, ((b[1] - a[1]) / length, (a[0] - b[0]) / length), solid


def distance_to_faces(pattern, x, y):
    least = math.inf
    for _, _, flat in sides_of(pattern):
        inside = True
        for k in range(3):
            a, b = flat[k], flat[(k + 1) % 3]
            along = (b[0] - a[0], b[1] - a[1])
            inside = inside and along[0] * (y - a[1]) - along[1] * (x - a[0]) >= 0
            t = max(0, min(1, ((x - a[0]) * along[0] + (y - a[1]) * along[1]) / (along[0] ** 2 + along[1] ** 2)))
            least = min(least, math.hypot(a[0] + t * along[0] - x, a[1] + t * along[1] - y))
        if inside:
            return 0
    return least


class Bench:
    def __init__(self, program, here):
        self.program, self.here = program, pathlib.Path(here)

    def run(self, model, *options, wanted=0):
        """Unfolds to net.pdf and net.json; what was said."""
        done = subprocess.run([self.program, 'unfold', model, '-o', 'net.pdf', '-o', 'net.json', '--effort', 'quick', '-p', 'a5', '--no-guide',
                               *options], cwd=self.here, capture_output=True, text=True, timeout=120)
        assert done.returncode == wanted, done.stderr
        return done.stderr

    def net(self):
        return Page(self.here / 'net.pdf'), json.loads((self.here / 'net.json').read_text())

    def cube(self):
        write_cube(self.here)
        write_png(self.here / 'skin.png', 256, lambda u, v: fade(u, v) if in_a_side(u, v) else (255, 0, 255))


# ---- tests ----

def an_image_comes_to_its_place_the_right_way_round(bench):
    bench.cube()
    bench.run('cube.obj', '--height', '4cm')
    wrong = compare_faces(*bench.net(), colour_of_cube, 20, 12)
    assert wrong < 0.03, wrong


def colours_reach_beyond_the_cuts_and_not_further(bench):
    bench.cube()
    bench.run('cube.obj', '--height', '4cm', '--tabs', 'none', '--number', 'none')
    page, pattern = bench.net()
    edges = 0
    for a, b, out, solid in borders_of(pattern):
        edges += 1
        for t in (0.1, 0.3, 0.5, 0.7, 0.9):
            x, y = a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])
            wanted = colour_of_cube([c / 20 for c in blend(solid, (1 - t, t, 0))], normal_of(solid))
            for away in (-0.6, 0.6, 1.2):
                at = x + away * out[0], y + away * out[1]
                assert near(page.at(*at), wanted, 14), (away, page.at(*at), wanted)
            beyond = x + 1.9 * out[0], y + 1.9 * out[1]
            if distance_to_faces(pattern, *beyond) > 1.8:
                assert min(page.at(*beyond)) > 245, page.at(*beyond)
    assert edges == 14


def nothing_from_beyond_an_islands_edge_is_mixed_in(bench):
    bench.cube()
    bench.run('cube.obj', '--height', '4cm', '--tabs', 'none', '--number', 'none')
    page, pattern = bench.net()
    for row in range(0, page.height, 3):
        for column in range(0, page.width, 3):
            r, g, b = page.dots[3 * (row * page.width + column):][:3]
            assert not (b > g + 60 and b > 170), 'the image\'s background shows at %d, %d: %r' % (column, row, (r, g, b))


def a_simplified_model_keeps_its_colours(bench):
    write_ball(bench.here / 'ball.ply', 30)
    bench.run('ball.ply', '--faces', '150', '--height', '50')
    page, pattern = bench.net()
    height = max(v[1] for v in pattern['mesh']['vertices']) - min(v[1] for v in pattern['mesh']['vertices'])
    wrong = compare_faces(page, pattern, colour_of_ball, height / 2, 24)
    assert wrong < 0.05, wrong


def colours_are_the_same_for_any_number_of_threads(bench):
    write_ball(bench.here / 'ball.ply', 20)
    pages = set()
    for threads in ('1', '2', '3'):
        bench.run('ball.ply', '--faces', '100', '--threads', threads)
        pages.add((bench.here / 'net.pdf').read_bytes())
    assert len(pages) == 1


def a_poster_has_its_colours_on_every_sheet(bench):
    bench.cube()
    bench.run('cube.obj', '--height', '8cm', '--oversize', 'tile', '--overlap', '12', '--number', 'none')
    stem = str(bench.here / 'sheet')
    subprocess.run(['pdftoppm', '-r', '20', bench.here / 'net.pdf', stem], check=True)
    pages = sorted(bench.here.glob('sheet-*.ppm'))[1:]
    assert len(pages) > 3
    for path in pages:
        data = path.read_bytes()
        dots = data[-3 * 116 * 165:]
        assert any(max(dots[i:i + 3]) - min(dots[i:i + 3]) > 60 for i in range(0, len(dots) - 3, 3)), path


def an_svg_has_the_same_picture(bench):
    if not shutil.which('rsvg-convert'):
        return
    bench.cube()
    for unit in ('mm', 'px96'):
        bench.run('cube.obj', '--height', '4cm', '-o', 'net.svg', '--svg-unit', unit)
        _, pattern = bench.net()
        subprocess.run(['rsvg-convert', '-f', 'pdf', *(['--dpi-x', '96', '--dpi-y', '96'] if unit == 'px96' else []),
                        '-o', bench.here / 'svg.pdf', bench.here / 'net.svg'], check=True)
        page = Page(bench.here / 'svg.pdf')
        wrong = compare_faces(page, pattern, colour_of_cube, 20, 14)
        assert wrong < 0.03, (unit, wrong)


def grey_only(page):
    return all(page.dots[i] == page.dots[i + 1] == page.dots[i + 2] for i in range(0, len(page.dots), 3))


def no_texture_leaves_faces_white(bench):
    bench.cube()
    bench.run('cube.obj', '--no-texture', '--black')
    assert grey_only(bench.net()[0])


def a_missing_image_is_a_warning_with_its_path(bench):
    write_cube(bench.here, 'pictures/gone.png')
    said = bench.run('cube.obj', '--texture')
    assert 'pictures/gone.png' in said and 'is not there' in said, said
    page, pattern = bench.net()
    mean = compare_faces(page, pattern, lambda *_: (51, 128, 230), pattern['model']['mm_per_unit'], 3)
    assert mean < 0.05, mean


def a_missing_material_file_is_a_warning(bench):
    write_cube(bench.here, mtl='none.mtl')
    said = bench.run('cube.obj')
    assert 'none.mtl' in said and grey_only_or_folds(bench.net()[0]), said


def grey_only_or_folds(page):
    coloured = sum(max(page.dots[i:i + 3]) - min(page.dots[i:i + 3]) > 60 for i in range(0, len(page.dots), 3))
    return coloured < 0.01 * len(page.dots) / 3


def images_outside_the_models_folder_are_refused_unless_asked_for(bench):
    write_png(bench.here / 'skin.png', 16, fade)
    inner = bench.here / 'inner'
    inner.mkdir()
    (inner / 'link.png').symlink_to(bench.here / 'skin.png')
    for name in ('../skin.png', str(bench.here / 'skin.png'), 'link.png', '../inner/../skin.png'):
        write_cube(inner, name)
        said = bench.run('inner/cube.obj', '--texture')
        assert 'outside' in said and '--textures-anywhere' in said, (name, said)
        said = bench.run('inner/cube.obj', '--texture', '--textures-anywhere')
        assert 'outside' not in said, (name, said)
    for name in ('/dev/zero', '/dev/stdin', '.', '/proc/self/mem'):
        write_cube(inner, name)
        said = bench.run('inner/cube.obj', '--texture', '--textures-anywhere')
        assert 'warning' in said and 'printed in the material' in said, (name, said)


def paths_of_other_machines_are_found_beside_the_model(bench):
    bench.cube()
    for name in ('C:\\models\\tex\\skin.png', '/home/somebody/skin.png', 'tex/skin.png'):
        write_cube(bench.here, name)
        said = bench.run('cube.obj', '--height', '4cm')
        assert compare_faces(*bench.net(), colour_of_cube, 20, 12) < 0.03, (name, said)


def one_colour_all_over_is_left_to_the_paper(bench):
    bench.cube()
    (bench.here / 'cube.mtl').write_text('newmtl skin\nKd 0.2 0.5 0.9\n')
    bench.run('cube.obj')
    assert grey_only_or_folds(bench.net()[0])
    bench.run('cube.obj', '--texture')
    assert not grey_only_or_folds(bench.net()[0])


def damaged_images_cannot_break_it(bench):
    bench.cube()
    whole = (bench.here / 'skin.png').read_bytes()
    huge = whole[:16] + struct.pack('>II', 60000, 60000) + whole[24:29]
    huge += struct.pack('>I', zlib.crc32(huge[12:29])) + whole[33:]
    for bad in (b'', whole[:40], whole[:len(whole) // 2], whole[:100] + b'\xff' * 50 + whole[150:], huge,
                b'\xff\xd8\xff\xe0' + b'\0' * 50, b'GIF89a'):
        (bench.here / 'skin.png').write_bytes(bad)
        said = bench.run('cube.obj')
        assert 'skin.png' in said, said


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    tests = [
        an_image_comes_to_its_place_the_right_way_round, colours_reach_beyond_the_cuts_and_not_further,
        nothing_from_beyond_an_islands_edge_is_mixed_in, a_simplified_model_keeps_its_colours,
        colours_are_the_same_for_any_number_of_threads, a_poster_has_its_colours_on_every_sheet,
        an_svg_has_the_same_picture, no_texture_leaves_faces_white, a_missing_image_is_a_warning_with_its_path,
        a_missing_material_file_is_a_warning, images_outside_the_models_folder_are_refused_unless_asked_for,
        paths_of_other_machines_are_found_beside_the_model, one_colour_all_over_is_left_to_the_paper,
        damaged_images_cannot_break_it]
    print('1..%d' % len(tests))
    failed = 0
    for number, test in enumerate(tests, 1):
        with tempfile.TemporaryDirectory() as here:
            try:
                test(Bench(program, here))
                print('ok %d - %s' % (number, test.__name__.replace('_', ' ')), flush=True)
            except Exception as reason:
                failed += 1
                print('not ok %d - %s' % (number, test.__name__.replace('_', ' ')), flush=True)
                print('# %r' % (reason,), file=sys.stderr)
                traceback.print_exc()
    return 1 if failed else 0


sys.exit(main())
