#!/usr/bin/env python3
"""tests/cli/test_plots.py - SVG and DXF for machines, measured from the files and opened by other
people's programs (librsvg, Inkscape, ezdxf) where they are installed; TAP.

    test_plots.py PROGRAM SAMPLES"""

import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import plots  # noqa: E402


class Skipped(Exception):
    pass


class Bench:
    def __init__(self, program, samples, here):
        self.program, self.samples, self.here = program, pathlib.Path(samples), pathlib.Path(here)

    def run(self, command, model, *words):
        model = self.samples / model if '/' not in str(model) else model
        subprocess.run([self.program, command, str(model), '-q', *words], cwd=self.here, check=True,
                       stdin=subprocess.DEVNULL)

    def pattern(self, name):
        return json.loads((self.here / name).read_text(encoding='utf-8'))

    def files(self, pattern, name, ending):
        if len(pattern['sheets']) == 1:
            return [self.here / (name + ending)]
        return [self.here / ('%s-%02d%s' % (name, k + 1, ending)) for k in range(len(pattern['sheets']))]

    def need(self, program):
        if not shutil.which(program):
            raise Skipped(program + ' is not installed')

    def check_dxf(self, *words):
        """Runs check_dxf.py with a Python that has ezdxf: Debian's, where this one has not."""
        script = str(pathlib.Path(__file__).parent / 'check_dxf.py')
        for python in (sys.executable, '/usr/bin/python3'):
            if not shutil.which(python):
                continue
            ran = subprocess.run([python, script, *map(str, words)], cwd=self.here, capture_output=True, text=True)
            if ran.returncode != 77:
                expect((ran.stdout + ran.stderr).splitlines() if ran.returncode else [])
                return
        raise Skipped('ezdxf is not installed')

    def make(self, name, command, model, *words, ending='.svg'):
        """Runs it; the pattern, and its files of that kind with their sheets."""
        self.run(command, model, '-o', name + '.json', '-o', name + ending, *words)
        pattern = self.pattern(name + '.json')
        return pattern, list(zip(self.files(pattern, name, ending), pattern['sheets']))


def expect(problems):
    if problems:
        raise AssertionError('; '.join(str(p) for p in problems[:4]))


QUICK = ('--effort', 'quick')


def every_line_of_a_sheet_is_in_its_layer_once(bench):
    for model, words in (('fox.obj', ()), ('robot.obj', ('--height', '20cm')), ('torus.obj', ()),
                         ('house.obj', ('--tabs', 'none', '--pieces', '3'))):
        pattern, files = bench.make('a', 'unfold', model, *QUICK, *words)
        for path, sheet in files:
            expect(['%s: %s' % (path.name, p) for p in plots.check_svg(path, pattern, sheet)])


def cloth_has_its_layers(bench):
    for model, words in (('blouse-front.obj', ()), ('tshirt.obj', ()), ('skirt.obj', ('--fabric-width', '140cm'))):
        pattern, files = bench.make('b', 'flatten', model, '--unit', 'cm', '--paper', 'a0', *words)
        for path, sheet in files:
            expect(['%s: %s' % (model, p) for p in plots.check_svg(path, pattern, sheet)])


def real_dashes_are_paths_of_their_own(bench):
    pattern, files = bench.make('c', 'unfold', 'fox.obj', *QUICK, '--real-dashes')
    expect(plots.check_svg(*files[0][:1], pattern, files[0][1], dashed=True))
    expect(['dash arrays'] if 'dasharray' in files[0][0].read_text() else [])


def units_are_what_was_asked_for(bench):
    for unit, width in (('mm', '210mm'), ('px72', '595.2756'), ('px96', '793.7008')):
        pattern, files = bench.make('d', 'unfold', 'house.obj', *QUICK, '--svg-unit', unit)
        path, sheet = files[0]
        svg = plots.Svg(path)
        expect([svg.width] if svg.width != width else [])
        expect(['viewBox'] if abs(svg.box[2] - float(width.rstrip('m'))) > 1e-3 else [])
        expect(plots.check_svg(path, pattern, sheet))


def marks_have_layers_of_their_own(bench):
    pattern, files = bench.make('e', 'unfold', 'star.obj', '-p', 'a3', '--height', '6cm', '--registration')
    path, sheet = files[0]
    svg = plots.Svg(path).read(sheet['height'])
    square, closed = svg.layers['Calibration 50 mm'][0]
    sides = [abs(a[0] - b[0]) + abs(a[1] - b[1]) for a, b in zip(square, square[1:] + square[:1])]
    expect(['the square is %s' % sides] if not closed or any(abs(s - 50) > 1e-3 for s in sides) else [])
    expect(['%d marks' % len(svg.layers['Registration'])] if len(svg.layers['Registration']) != 9 else [])
    pattern, files = bench.make('e', 'unfold', 'star.obj', *QUICK)
    expect(['marks'] if 'Registration' in plots.Svg(files[0][0]).read(297).layers else [])


def without_colours_all_is_black(bench):
    _, files = bench.make('f', 'unfold', 'star.obj', *QUICK, '--black')
    svg = plots.Svg(files[0][0]).read(297)
    expect([svg.colours] if set(svg.colours.values()) != {'#000000'} else [])


def names_cannot_break_the_xml(bench):
    model = bench.here / '"<&\'>\x01.obj'
    (bench.here / 'n.obj').write_bytes(b'o <b class="x">&\'\x02\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'
                                       b'o \xe9\xa0\xad\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 4 5 6\n')
    shutil.move(bench.here / 'n.obj', model)
    pattern, files = bench.make('g', 'unfold', model, '--height', '40')
    svg = plots.Svg(files[0][0]).read(297)
    title = svg.root.find(plots.SVG + 'title').text
    expect([title] if title != '"<&\'> ' else [])
    texts = ' '.join(text for text, _ in svg.texts['Text'])
    expect([texts] if '<b class="x">&\'' not in texts or '\u982d' not in texts else [])


def a_poster_is_cut_off_at_the_sheets_edges(bench):
    pattern, files = bench.make('h', 'unfold', 'mask.obj', *QUICK, '--width', '30cm', '--oversize', 'tile')
    total = 0
    for path, sheet in files:
        svg = plots.Svg(path).read(sheet['height'])
        x0, y0, x1, y1 = sheet['printable']
        outside = [p for points, _ in svg.layers['Cut'] for p in points
                   if not (x0 - 1e-3 <= p[0] <= x1 + 1e-3 and y0 - 1e-3 <= p[1] <= y1 + 1e-3)]
        expect(outside)
        expect(['no joins'] if 'Poster joins' not in svg.layers else [])
        total += sum(plots.length_of(*way) for way in svg.layers['Cut'])
    whole = plots.length_of(pattern['pieces'][0]['outline'], True)
    expect(['%g of %g mm' % (total, whole)] if not whole < total < 1.5 * whole else [])


def a_path_goes_on_where_it_can(bench):
    """As many paths as pieces and slits; folds in far fewer than there are."""
    pattern, files = bench.make('i', 'unfold', 'geodesic.obj', *QUICK)
    svg = plots.Svg(files[0][0]).read(297)
    folds = sum(1 for layer, *_ in plots.folds_of(pattern)[1] if layer == 'Mountain')
    expect([len(svg.layers['Mountain']), folds] if len(svg.layers['Mountain']) > 0.6 * folds else [])
    expect(['%d cuts' % len(svg.layers['Cut'])] if len(svg.layers['Cut']) > 3 else [])


def librsvg_draws_it_at_its_size(bench):
    bench.need('rsvg-convert')
    _, files = bench.make('j', 'unfold', 'fox.obj', *QUICK)
    png = bench.here / 'j.png'
    subprocess.run(['rsvg-convert', '-d', '25.4', '-p', '25.4', str(files[0][0]), '-o', str(png)], check=True)
    size = struct.unpack('>II', png.read_bytes()[16:24])
    expect(['%s pixels' % (size,)] if size != (210, 297) else [])


def inkscape_finds_layers_and_sizes(bench):
    bench.need('inkscape')
    pattern, files = bench.make('k', 'unfold', 'fox.obj', *QUICK)
    told = subprocess.run(['inkscape', '--query-all', str(files[0][0])], check=True, capture_output=True,
                          text=True).stdout
    boxes = {line.split(',')[0]: [float(n) * 25.4 / 96 for n in line.split(',')[1:]]
             for line in told.splitlines() if line.count(',') == 4}
    outline = plots.wanted(pattern, files[0][1])['Cut'][0][0]
    left, right = min(p[0] for p in outline), max(p[0] for p in outline)
    top, bottom = (297 - f(p[1] for p in outline) for f in (max, min))
    x, y, width, height = boxes['cut']
    off = max(abs(x - left), abs(y - top), abs(x + width - right), abs(y + height - bottom))
    expect(['off by %g mm' % off] if off > 0.2 else [])  # strokes are 0.25 mm wide
    expect(['layers are missing'] if not {'mountain', 'valley', 'tab-folds', 'text'} <= set(boxes) else [])


def a_dxf_of_paper_holds_the_same(bench):
    for model, words in (('fox.obj', ()), ('robot.obj', ('--height', '20cm'))):
        _, files = bench.make('l', 'unfold', model, *QUICK, *words, ending='.dxf')
        bench.check_dxf('layers', 'l.json', *(path for path, _ in files))
    _, files = bench.make('l', 'unfold', 'fox.obj', *QUICK, '--real-dashes', ending='.dxf')
    bench.check_dxf('layers', 'l.json', 'dashed', files[0][0])


def a_dxf_of_cloth_is_one_file_after_astm(bench):
    for model in ('blouse-front.obj', 'tshirt.obj', 'skirt.obj'):
        bench.run('flatten', model, '--unit', 'cm', '-o', 'm.dxf', '-o', 'm.json')
        bench.check_dxf('astm', 'm.json', 'm.dxf')
    expect(['a file for each sheet'] if (bench.here / 'm-01.dxf').exists() else [])
    bench.make('n', 'flatten', 'blouse-front.obj', '--unit', 'cm', '--paper', 'a0', '--plain-dxf', ending='.dxf')
    bench.check_dxf('layers', 'n.json', 'n.dxf')


def a_marker_is_a_page_of_the_fabrics_size(bench):
    bench.need('pdfinfo')
    bench.run('flatten', 'blouse-front.obj', '--unit', 'cm', '--fabric-width', '90cm', '-o', 'o.pdf', '-o', 'o.json',
              '-o', 'o.svg', '--report', 'o-report.json')
    pattern, report = bench.pattern('o.json'), bench.pattern('o-report.json')
    told = subprocess.run(['pdfinfo', 'o.pdf'], cwd=bench.here, check=True, capture_output=True, text=True).stdout
    width, height = (float(told.split('Page size:')[1].split()[k]) * 25.4 / 72 for k in (0, 2))
    expect(['%g x %g mm' % (width, height)] if abs(width - 900) > 0.1 or
           abs(height - report['fabric_length_mm']) > 0.1 else [])
    expect(plots.check_svg(bench.here / 'o.svg', pattern, pattern['sheets'][0]))


TESTS = [every_line_of_a_sheet_is_in_its_layer_once, cloth_has_its_layers,
         real_dashes_are_paths_of_their_own, units_are_what_was_asked_for, marks_have_layers_of_their_own,
         without_colours_all_is_black, names_cannot_break_the_xml, a_poster_is_cut_off_at_the_sheets_edges,
         a_path_goes_on_where_it_can, librsvg_draws_it_at_its_size, inkscape_finds_layers_and_sizes,
         a_dxf_of_paper_holds_the_same, a_dxf_of_cloth_is_one_file_after_astm,
         a_marker_is_a_page_of_the_fabrics_size]


def main():
    program, samples = (str(pathlib.Path(p).resolve()) for p in sys.argv[1:3])
    chosen = [t for t in TESTS if len(sys.argv) == 3 or t.__name__ in sys.argv[3:]]
    print('1..%d' % len(chosen))
    bad = 0
    for number, test in enumerate(chosen, 1):
        title = test.__name__.replace('_', ' ')
        with tempfile.TemporaryDirectory(prefix='ktg-plots-') as here:
            try:
                test(Bench(program, samples, here))
                print('ok %d - %s' % (number, title))
            except Skipped as reason:
                print('ok %d - %s # SKIP %s' % (number, title, reason))
            except (AssertionError, subprocess.CalledProcessError, KeyError, OSError) as failed:
                bad += 1
                print('not ok %d - %s\n# %r' % (number, title, failed))
        sys.stdout.flush()
    sys.exit(bad > 0)


if __name__ == '__main__':
    main()
