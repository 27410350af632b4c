#!/usr/bin/env python3
"""tests/fuzz/damage.py - damages models, and looks whether the program stands it.

    damage.py PROGRAM [--count 5000] [--seed 1] [--keep FOLDER] [--whole BYTES] [MODEL|FOLDER...]

Models are those named, else samples/; each also as a small one in every format. One to three damages a time: cut
short, bits, lines and numbers changed, corners and faces moved about, points rounded so that they coincide. Then the
program is to tell about it (info), simplify, unfold and flatten it, each in 10 seconds of processor time (--limit; a busy
machine gives less for a second); it may refuse, with status 1 and a sentence, and then writes no file. What it accepts is proved, by `katagami verify` and, a net,
by tests/cli/check_net.py, which shares no code with it. What goes wrong is told, and kept in FOLDER. Exit status 0 or 1.

--count and --seed name the same models on every machine."""

import argparse
import collections
import json
import math
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))
import check_net  # noqa: E402

MOST_BYTES = 1 << 20
SMALL_FACES = 90
COMMANDS = {"info": [], "simplify": ["--faces", "40", "-o"],
            "unfold": ["--effort", "quick", "-o"], "flatten": ["--unit", "cm", "--effort", "quick", "-o"]}
ODD_NUMBERS = ["nan", "inf", "-inf", "1e400", "1e308", "-1e300", "1e-320", "0", "-0", "1e30", "999999999999", "4294967296",
               "2147483648", "-1", "1e-9", "0x10", "1,5", "", "1e", "--2", "1.5.2"]
NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")


# ---- damages: bytes to bytes ---------------------------------------------------------------------

def cut_short(data, r):
    return data[:r.randrange(len(data))]


def flip_bits(data, r):
    data = bytearray(data)
    for _ in range(r.choice([1, 1, 3, 20])):
        data[r.randrange(len(data))] ^= 1 << r.randrange(8)
    return bytes(data)


def drop_bytes(data, r):
    at = r.randrange(len(data))
    return data[:at] + data[at + r.choice([1, 2, 4, 50]):]


def change_lines(data, r):
    lines = data.split(b"\n")
    for _ in range(r.choice([1, 1, 5])):
        i, j = r.randrange(len(lines)), r.randrange(len(lines))
        how = r.randrange(4)
        if how == 0 and len(lines) > 1:
            del lines[i]
        elif how == 1:
            lines.insert(j, lines[i])
        elif how == 2:
            lines[i], lines[j] = lines[j], lines[i]
        else:
            lines[i] = lines[i] + b" " + lines[j]
    return b"\n".join(lines)


def change_numbers(data, r):
    """Another number, or one of another place."""
    found = list(NUMBER.finditer(data))
    for match in sorted(r.sample(found, min(len(found), r.choice([1, 2, 10]))), key=lambda m: -m.start()):
        new = r.choice(found).group() if r.random() < 0.5 else r.choice(ODD_NUMBERS).encode()
        data = data[:match.start()] + new + data[match.end():]
    return data


# ---- damages of what is meant: on the lines of an OBJ --------------------------------------------

def lines_of(data, word):
    lines = data.split(b"\n")
    return lines, [i for i, line in enumerate(lines) if line.startswith(word)]


def corner(line, r, count):
    """Another vertex for one corner of a face."""
    words = line.split()
    if len(words) > 1:
        at = r.randrange(1, len(words))
        words[at] = b"%d" % r.choice([r.randint(1, max(1, count)), r.randint(1, max(1, count)), 0, -1, count + 1])
    return b" ".join(words)


def change_faces(data, r):
    """Turned over, twice, missing, with other corners, with a corner twice."""
    lines, faces = lines_of(data, b"f ")
    count = len(lines_of(data, b"v ")[1])
    for i in r.sample(faces, min(len(faces), r.choice([1, 2, 5, 20]))):
        words, how = lines[i].split(), r.randrange(6)
        if how == 0:
            lines[i] = b" ".join([b"f", *reversed(words[1:])])
        elif how == 1:
            lines[i] += b"\n" + lines[i]
        elif how == 2:
            lines[i] = b"#"
        elif how == 3 and len(words) > 2:
            lines[i] = b" ".join([b"f", *words[1:3], words[2], *words[3:]])
        else:
            lines[i] = corner(lines[i], r, count)
    return b"\n".join(lines)


def move_points(data, r, change):
    lines, points = lines_of(data, b"v ")
    for i in points:
        words = lines[i].split()
        try:
            place = [float(w) for w in words[1:4]]
        except ValueError:
            continue
        lines[i] = b" ".join([b"v", *(b"%.17g" % x for x in change(place, r)), *words[4:]])
    return b"\n".join(lines)


def round_points(data, r):
    """Onto a grid so coarse that points coincide, edges lie in a line and faces in a plane."""
    lines, points = lines_of(data, b"v ")
    try:
        reach = max(abs(float(w)) for i in points for w in lines[i].split()[1:4])
    except ValueError:
        return data
    step = reach / r.choice([2, 4, 7, 16]) or 1
    return move_points(data, r, lambda place, _: [round(x / step) * step if math.isfinite(x / step) else x
                                                  for x in place])


def shake_points(data, r):
    part, amount = r.choice([0.02, 0.2]), r.choice([1e-9, 1e-3, 0.3, 1e5])
    return move_points(data, r, lambda place, r: [x * (1 + amount * r.uniform(-1, 1)) if r.random() < part else x
                                                  for x in place])


def squash_points(data, r):
    axis, factor = r.randrange(3), r.choice([0, 1e-12, 1e-6, 1e6, -1])
    return move_points(data, r, lambda place, _: [x * factor if k == axis else x for k, x in enumerate(place)])


def join_points(data, r):
    lines, points = lines_of(data, b"v ")
    for i in r.sample(points, min(len(points), r.choice([1, 3, 10]))):
        lines[i] = lines[r.choice(points)]
    return b"\n".join(lines)


OF_BYTES = [cut_short, flip_bits, drop_bytes, change_lines, change_numbers]
OF_MEANING = [change_faces, change_faces, round_points, shake_points, squash_points, join_points]


def damage(data, ending, r):
    """The damaged model, and what was done to it."""
    done = []
    for _ in range(r.choice([1, 1, 2, 3])):
        kinds = OF_MEANING if ending == ".obj" and r.random() < 0.7 else OF_BYTES
        how = r.choice(kinds)
        data = how(data, r) or b"\n"
        done.append(how.__name__)
    return data[:MOST_BYTES], "+".join(done)


# ---- the program ---------------------------------------------------------------------------------

class Program:
    def __init__(self, path, folder, limit_s):
        self.path, self.folder, self.limit_s = str(pathlib.Path(path).resolve()), folder, limit_s

    def limit(self):
        resource.setrlimit(resource.RLIMIT_CPU, (self.limit_s, self.limit_s + 1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    def run(self, *words):
        """Status and words of a run; None for one that takes too long. A program that only waits may do so for
        twenty times as long."""
        try:
            done = subprocess.run([self.path, *words], cwd=self.folder, preexec_fn=self.limit,
                                  timeout=20 * self.limit_s, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE)
        except subprocess.TimeoutExpired:
            return None, "waits for %d s" % (20 * self.limit_s)
        if done.returncode in (-24, -9):
            return None, "takes longer than %d s" % self.limit_s
        return done.returncode, (done.stdout + done.stderr).decode(errors="replace")


def proof(program, pattern, model):
    """What is wrong with a pattern; None where nothing is."""
    status, words = program.run("verify", pattern.name, model.name)
    if status != 0:
        return "verify: " + words
    with open(pattern, encoding="utf-8") as file:
        pattern = json.load(file)
    if pattern["mode"] != "paper":
        return None
    problems = check_net.check(pattern)[1]
    return "check_net.py: " + "; ".join(problems[:3]) if problems else None


def fault(program, model, command, counts):
    """What is wrong with what the program makes of the model; None where nothing is."""
    options = COMMANDS[command]
    result = program.folder / ("out.obj" if command == "simplify" else "out.json")
    result.unlink(missing_ok=True)
    status, words = program.run(command, model.name, *options, *([result.name] if options else []))
    if status not in (0, 1):
        return words if status is None else "status %d: %s" % (status, words)
    counts[command, "accepted" if status == 0 else "refused"] += 1
    if status == 1 and ("defect" in words or "internal" in words or not words.strip()):
        return "refused without a reason: " + words
    if status == 1:
        return "refused, but wrote a file: " + words if result.exists() else None
    if command == "simplify":
        status, words = program.run("info", result.name)
        return None if status == 0 else "cannot read what it wrote: " + words
    return proof(program, result, model) if options else None


# ---- models --------------------------------------------------------------------------------------

def sources(program, named, whole_bytes):
    """(bytes, ending) of each model that is no larger, and of a small one in each format."""
    paths = []
    for path in map(pathlib.Path, named):
        paths += sorted(path.iterdir()) if path.is_dir() else [path]
    models = []
    for path in paths:
        if path.suffix.lower() not in (".obj", ".stl", ".ply", ".off"):
            continue
        if path.stat().st_size <= whole_bytes:
            models.append((path.read_bytes(), path.suffix.lower()))
        for ending in (".obj", ".obj", ".obj", ".stl", ".ply", ".off"):
            small = program.folder / ("small" + ending)
            if program.run("simplify", str(path.resolve()), "--faces", str(SMALL_FACES), "-o", small.name)[0] == 0:
                models.append((small.read_bytes(), ending))
    return models


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("program")
    words.add_argument("--count", type=int, default=5000)
    words.add_argument("--first", type=int, default=0, help="the number of the first one")
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--limit", type=int, default=10, help="seconds of processor time for a run")
    words.add_argument("--whole", type=int, default=20000, help="bytes of models that are taken as they are, at most")
    words.add_argument("--keep", type=pathlib.Path, help="folder for models that something is wrong with")
    words.add_argument("models", nargs="*", default=[ROOT / "samples"])
    arguments = words.parse_intermixed_args()
    counts, faults = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        program = Program(arguments.program, pathlib.Path(folder), arguments.limit)
        models = sources(program, arguments.models, arguments.whole)
        for number in range(arguments.first, arguments.first + arguments.count):
            r = random.Random("%d %d" % (arguments.seed, number))
            data, ending = r.choice(models)
            data, done = damage(data, ending, r)
            model = program.folder / ("model" + ending)
            model.write_bytes(data)
            for command in COMMANDS:
                wrong = fault(program, model, command, counts)
                if wrong:
                    faults += 1
                    print("%d (%s), %s: %s" % (number, done, command, wrong.strip()[:600]), flush=True)
                if wrong and arguments.keep:
                    arguments.keep.mkdir(parents=True, exist_ok=True)
                    shutil.copy(model, arguments.keep / ("%d-%s%s" % (number, command, ending)))
            if number % 100 == 99:
                print("%d models" % (number + 1), file=sys.stderr, flush=True)
    for (command, what), count in sorted(counts.items()):
        print("%s: %d %s" % (command, count, what))
    print("%d models, %d faults" % (arguments.count, faults))
    return 1 if faults or not counts else 0


if __name__ == "__main__":
    sys.exit(main())
