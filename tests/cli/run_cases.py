#!/usr/bin/env python3
"""tests/cli/run_cases.py - runs the cases of tests/cli/cases against the built program; TAP.

    run_cases.py PROGRAM SAMPLES CASES [NAME...]

A case is one file. Its first line says what it shows; every other line is a directive and its
words, split as a shell does; {samples} and {here} (the case's own new, empty folder, where the
program runs) are filled in, and "\\e" is the escape character.

what there is before:
  text NAME LINE...       a file of these lines
  bytes NAME EXPRESSION   a file of the bytes a Python expression gives; struct and random are there
  folder NAME             a folder;   locked NAME   one that nobody may write into (not as root)
  link NAME TARGET        a symbolic link
  copy SAMPLE NAME        one of the samples
  damage FILE STATEMENT   changes JSON: a Python statement about d
how to run:
  stdin FILE|never        what it reads; never: a pipe in which nothing comes
  stdout closed|full|none a pipe that nobody reads, a full disk, no standard output at all
  interrupt N             sends SIGINT N times, half a second after the program listens
  run WORDS...            runs the program; what stands below is about this run
what is expected:
  exit N                  must follow every run
  out WORDS / err WORDS   stand on standard output / standard error;   no-err   nothing stands there
  err-last WORDS          are the last line of standard error
  no-out                  nothing on standard output
  keep FILE               has the bytes it had before the run
  only NAME...            these files are in the folder, and no others
  exists NAME... / has FILE WORDS / starts FILE BYTES / same A B / differ A B
  json FILE EXPRESSION    a Python expression about d is true
  net FILE [MODEL]        check_net.py accepts it
  guide PDF JSON          check_guide.py finds all steps; no-guide PDF: there is none
  labels PDF JSON         check_labels.py finds the numbers of the one where the other says

Always expected: exit status 1 or 2 comes with exactly one line that begins "katagami", the last
one; no control character reaches standard error; nothing temporary is left behind."""

import json
import os
import pathlib
import random
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_guide  # noqa: E402
import check_labels  # noqa: E402
import check_net  # noqa: E402

SECONDS = 100


class Failed(Exception):
    pass


class Skipped(Exception):
    pass


def expect(true, text):
    if not true:
        raise Failed(text)


class Case:
    def __init__(self, program, samples, here):
        self.program, self.samples, self.here = program, samples, pathlib.Path(here)
        self.reset()
        self.ran = None  # the words of the last run

    def reset(self):
        self.input, self.output, self.interrupts = None, 'read', 0

    def path(self, name):
        return self.here / name

    # ---- before ----

    def do_text(self, name, *lines):
        self.path(name).write_text('\n'.join(lines) + '\n', encoding='utf-8')

    def do_bytes(self, name, expression):
        self.path(name).write_bytes(eval(expression, {'struct': struct, 'random': random}))

    def do_folder(self, name):
        self.path(name).mkdir()

    def do_locked(self, name):
        if os.geteuid() == 0:
            raise Skipped('root may write everywhere')
        self.path(name).mkdir(mode=0o500)

    def do_link(self, name, target):
        self.path(name).symlink_to(target)

    def do_copy(self, sample, name):
        shutil.copy(pathlib.Path(self.samples) / sample, self.path(name))

    def do_damage(self, name, statement):
        d = json.loads(self.path(name).read_text())
        exec(statement, {'d': d})
        self.path(name).write_text(json.dumps(d))

    # ---- running ----

    def do_stdin(self, name):
        self.input = name

    def do_stdout(self, kind):
        self.output = kind

    def do_interrupt(self, count):
        self.interrupts = int(count)

    def source(self):
        if self.input == 'never':
            reader, self.held = os.pipe()  # whose other end stays open, and silent
            return os.fdopen(reader, 'rb')
        return open(self.path(self.input) if self.input else os.devnull, 'rb')

    def streams(self):
        """What the program gets as standard output, and what is to be closed afterwards."""
        if self.output == 'closed':
            reader, writer = os.pipe()
            os.close(reader)
            return writer
        if self.output == 'full':
            return os.open('/dev/full', os.O_WRONLY)
        return subprocess.PIPE

    def prepare(self):
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # a background shell hands on "ignored"
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
        if self.output == 'none':
            os.close(1)

    def signals(self, process, key):
        """Whether SIGINT is among the process's caught (SigCgt) or pending (ShdPnd) signals."""
        lines = pathlib.Path('/proc/%d/status' % process.pid).read_text().splitlines()
        masks = [int(line.split()[1], 16) for line in lines if line.startswith(key)]
        return bool(masks and masks[0] >> (signal.SIGINT - 1) & 1)

    def bother(self, process):
        """Interrupts, each one after the one before has arrived; the first half a second after the
        program listens."""
        for _ in range(500):
            if self.signals(process, 'SigCgt'):
                break
            time.sleep(0.01)
        time.sleep(0.5)
        for _ in range(self.interrupts):
            process.send_signal(signal.SIGINT)
            while process.poll() is None and self.signals(process, 'ShdPnd'):
                time.sleep(0.001)

    def do_run(self, *words):
        self.known = {p: p.read_bytes() for p in self.here.rglob('*') if p.is_file()}
        output = self.streams()
        with self.source() as source:
            process = subprocess.Popen([self.program, *words], cwd=self.here, stdin=source,
                                       stdout=output, stderr=subprocess.PIPE,
                                       preexec_fn=self.prepare)
            try:
                if self.interrupts:
                    self.bother(process)
                self.stdout, self.stderr = process.communicate(timeout=SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                raise Failed('did not end within %d s' % SECONDS)
        if output != subprocess.PIPE:
            os.close(output)
        if self.input == 'never':
            os.close(self.held)
        self.stdout = (self.stdout or b'').decode('utf-8', 'replace')
        raw = self.stderr
        self.stderr = raw.decode('utf-8', 'replace')
        self.status, self.ran = process.returncode, words
        self.reset()
        expect(not any(b < 32 and b != 10 or b == 127 for b in raw), 'control characters on stderr')
        expect(not list(self.here.glob('**/*.tmp')), 'something temporary was left behind')

    # ---- expectations ----

    def do_exit(self, number):
        expect(self.status == int(number), 'ended with %d, not %s' % (self.status, number))
        if number in ('1', '2') and self.ran:
            lines = self.stderr.splitlines()
            told = [line for line in lines if line.startswith('katagami')]
            expect(len(told) == 1 and lines[-1] == told[0], 'not one sentence at the end')

    def do_out(self, *words):
        expect(' '.join(words) in self.stdout, 'standard output lacks "%s"' % ' '.join(words))

    def do_err(self, *words):
        expect(' '.join(words) in self.stderr, 'standard error lacks "%s"' % ' '.join(words))

    def do_err_last(self, *words):
        lines = self.stderr.splitlines()
        expect(lines and lines[-1] == ' '.join(words),
               'standard error does not end with "%s"' % ' '.join(words))

    def do_no_err(self):
        expect(not self.stderr, 'there are words on standard error')

    def do_no_out(self):
        expect(not self.stdout, 'there is something on standard output')

    def do_keep(self, name):
        expect(self.path(name).read_bytes() == self.known[self.path(name)], name + ' has changed')

    def do_only(self, *names):
        there = sorted(p.name for p in self.here.iterdir())
        expect(there == sorted(names), 'there are: ' + ' '.join(there))

    def do_exists(self, *names):
        for name in names:
            expect(self.path(name).is_file(), name + ' is missing')

    def do_has(self, name, *words):
        text = self.path(name).read_text(encoding='utf-8', errors='replace')
        expect(' '.join(words) in text, '%s lacks "%s"' % (name, ' '.join(words)))

    def do_starts(self, name, text):
        wanted = text.encode('latin-1').decode('unicode_escape').encode('latin-1')
        expect(self.path(name).read_bytes().startswith(wanted), '%s does not start so' % name)

    def do_same(self, a, b):
        expect(self.path(a).read_bytes() == self.path(b).read_bytes(), 'they differ')

    def do_differ(self, a, b):
        expect(self.path(a).read_bytes() != self.path(b).read_bytes(), 'they are the same')

    def do_json(self, name, expression):
        d = json.loads(self.path(name).read_text(encoding='utf-8'))
        expect(eval(expression, {'d': d}), 'not so: ' + expression)

    def do_net(self, name, model=None):
        pattern = json.loads(self.path(name).read_text(encoding='utf-8'))
        _, problems = check_net.check(pattern, check_net.read_model(model) if model else None)
        expect(not problems, '; '.join(problems[:3]))

    def do_guide(self, pdf, name):
        if not shutil.which('pdftotext'):
            raise Skipped('pdftotext is not installed')
        pattern = json.loads(self.path(name).read_text(encoding='utf-8'))
        problems = check_guide.check(check_guide.text_of(self.path(pdf)), pattern)
        expect(not problems, '; '.join(problems))

    def do_no_guide(self, pdf):
        if not shutil.which('pdftotext'):
            raise Skipped('pdftotext is not installed')
        expect('build' not in check_guide.text_of(self.path(pdf)), 'there is a guide')

    def do_labels(self, pdf, name):
        if not shutil.which('pdftotext'):
            raise Skipped('pdftotext is not installed')
        pattern = json.loads(self.path(name).read_text(encoding='utf-8'))
        found, _, problems = check_labels.check(check_labels.words_of(self.path(pdf)), pattern)
        expect(found and not problems, '; '.join(problems[:3]) or 'there are no numbers')


def run_case(path, program, samples):
    lines = path.read_text(encoding='utf-8').splitlines()
    with tempfile.TemporaryDirectory(prefix='ktg-case-') as here:
        case = Case(program, samples, here)
        waiting = False
        for number, line in enumerate(lines[1:], 2):
            words = [w.replace('{samples}', samples).replace('{here}', here)
                     .replace('\\e', '\033') for w in shlex.split(line, comments=True)]
            if not words:
                continue
            try:
                expect(not waiting or words[0] == 'exit', 'a run without its exit status')
                waiting = words[0] == 'run'
                getattr(case, 'do_' + words[0].replace('-', '_'))(*words[1:])
            except Failed as failed:
                told = case.stderr.rstrip().replace('\n', '\n#   ') if case.ran is not None else ''
                raise Failed('line %d, %s: %s\n#   %s' % (number, line, failed, told)) from None
        expect(case.ran is not None and not waiting, 'nothing was run, or its exit status is not expected')


def main():
    program, samples, folder = sys.argv[1:4]
    samples = str(pathlib.Path(samples).resolve())
    program = str(pathlib.Path(program).resolve())
    cases = sorted(p for p in pathlib.Path(folder).glob('*.case')
                   if len(sys.argv) == 4 or p.stem in sys.argv[4:])
    print('1..%d' % len(cases))
    bad = 0
    for number, path in enumerate(cases, 1):
        title = path.stem
        try:
            run_case(path, program, samples)
            print('ok %d - %s' % (number, title))
        except Skipped as reason:
            print('ok %d - %s # SKIP %s' % (number, title, reason))
        except (Failed, OSError, ValueError, KeyError) as failed:
            bad += 1
            print('not ok %d - %s\n# %s' % (number, title, failed))
        sys.stdout.flush()
    sys.exit(bad > 0 or not cases)


if __name__ == '__main__':
    main()
