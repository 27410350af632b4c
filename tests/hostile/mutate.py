#!/usr/bin/env python3
"""Breaks the code line by line, in a copy, and tells which breaks a room's tests do not notice.

usage: mutate.py ROOT FOLDER ROOM [--count N] [--seed N] [--minutes M] [FILE...]

FOLDER gets a clone of ROOT's last commit and a build of it, which are used again. N lines (40) of the
room, or of the named files, are chosen by the seed (1); each is changed in one place: a comparison
turned or shifted, a sum made a difference, "and" made "or", a constant changed, a checked call dropped.
What the tests let pass is printed: a test is missing, or the change makes no difference. After M minutes
no further one is begun. Quick tests are asked first. Not run by CI; it takes minutes.
"""
import argparse
import json
import pathlib
import random
import re
import subprocess
import sys
import time

SECONDS = 120  # a test that takes longer has noticed

# what is looked for, and what stands in its place
BREAKS = [(r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "), (r" == ", " != "), (r" != ", " == "),
          (r" \+ ", " - "), (r" - ", " + "), (r" && ", " || "), (r" \|\| ", " && "), (r"\b0\.5\b", "0.51"), (r" \* ", " / "),
          (r"\bfmin\(", "fmax("), (r"\bfmax\(", "fmin("), (r"\+\+;", "--;"), (r" \+= ", " -= "), (r"\btrue;", "false;"),
          (r"\bfalse;", "true;"), (r"^(\s+)KTG_TRY\((.*)\);$", r"\1(void)!(\2);"), (r"^(\s+)(ktg_\w+\(.*\);)$", r"\1;")]


def is_code(line):
    text = line.strip()
    return text and not text.startswith(("#", "/*", "*", "//", "static const", "typedef", "}")) and "/*" not in text


def possible(path):
    """(line number, broken line) of all breaks of a file."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines()):
        if not is_code(line) or not line.startswith("    "):
            continue
        for pattern, instead in BREAKS:
            for match in re.finditer(pattern, line):
                broken = line[:match.start()] + match.expand(instead) + line[match.end():]
                yield number, line, broken


def run(words, **options):
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, **options)


def prepare(root, folder):
    copy, build = folder / "copy", folder / "build"
    if not copy.exists():
        subprocess.run(["git", "clone", "-q", root, copy], check=True)
    else:
        subprocess.run(["git", "-C", copy, "fetch", "-q", "origin", "HEAD"], check=True)
        subprocess.run(["git", "-C", copy, "checkout", "-q", "-f", "--detach", "FETCH_HEAD"], check=True)
    if not (build / "build.ninja").exists():
        subprocess.run(["meson", "setup", build, copy, "-Doptimization=1"], stdout=subprocess.DEVNULL, check=True)
    return copy, build


def tests_of(build, room):
    run(["ninja", "-C", build, "build.ninja"])  # tests may have come since it was made
    said = json.loads(run(["meson", "introspect", "--tests", build]).stdout)
    return [test for test in said if test["name"].startswith(room + "/") and test["cmd"][0].startswith(str(build))]


def build_tests(build, tests):
    return run(["ninja", "-C", build, *(str(pathlib.Path(test["cmd"][0]).relative_to(build)) for test in tests)])


def notices(test, build):
    try:
        return run(test["cmd"], cwd=build, timeout=SECONDS).returncode != 0
    except subprocess.TimeoutExpired:
        return True


def quick_first(tests, build):
    """The tests by the time they take; all have to pass while nothing is broken."""
    taken = []
    for number, test in enumerate(tests):
        began = time.monotonic()
        if notices(test, build):
            sys.exit(f"{test['name']} fails before anything is broken")
        taken.append((time.monotonic() - began, number, test))
    return [test for _, _, test in sorted(taken, key=lambda one: one[:2])]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root")
    parser.add_argument("folder", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("room")
    parser.add_argument("files", nargs="*")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=float("inf"))
    given = parser.parse_args()
    end = time.monotonic() + 60 * given.minutes
    copy, build = prepare(given.root, given.folder)
    tests = tests_of(build, given.room)
    done = build_tests(build, tests)
    if done.returncode or not tests:
        sys.exit(done.stdout.decode())
    tests = quick_first(tests, build)
    files = [copy / name for name in given.files] or sorted((copy / given.room).glob("*.c"))
    breaks = [(path, *found) for path in files for found in possible(path)]
    chosen = random.Random(given.seed).sample(breaks, min(given.count, len(breaks)))
    noticed, survivors, invalid = 0, [], 0
    for path, number, line, broken in chosen:
        if time.monotonic() > end:
            break
        text = path.read_text(encoding="utf-8")
        lines = text.splitlines(keepends=True)
        lines[number] = broken + "\n"
        path.write_text("".join(lines), encoding="utf-8")
        if build_tests(build, tests).returncode:
            invalid += 1
        elif any(notices(test, build) for test in tests):
            noticed += 1
        else:
            survivors.append(f"{path.relative_to(copy)}:{number + 1}: {line.strip()}\n    {broken.strip()}")
            print(survivors[-1], flush=True)
        path.write_text(text, encoding="utf-8")
    print(f"{noticed} noticed, {len(survivors)} not, {invalid} could not be built; of {len(breaks)} possible")


main()
