#!/usr/bin/env python3
"""tests/fuzz/reach.py - writes the table of public functions in docs/testing.md: which fuzz targets reach a function
with their corpora, by libFuzzer's own counters, and which test files call it.

usage: reach.py FUZZ-BUILD-FOLDER   (tools/fuzz makes build-fuzz)
"""
import collections
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "testing.md"
START, END = "<!-- reach.py: begin -->\n", "<!-- reach.py: end -->\n"


def public_functions():
    """{room: [function]} in the order of the headers."""
    rooms = {}
    for header in sorted(ROOT.glob("*/*.h")):
        text = header.read_text(encoding="utf-8")
        names = re.findall(r"^KTG_API [^;]*?\b(ktg_\w+)\(", text, re.MULTILINE)
        if names:
            rooms[header.parent.name] = names
    return rooms


def reached(build):
    """{function: [target]}"""
    targets = collections.defaultdict(list)
    environment = dict(os.environ, LSAN_OPTIONS="suppressions=%s" % (ROOT / "tests/render/fontconfig.supp"))
    for corpus in sorted((ROOT / "tests" / "fuzz" / "corpus").iterdir()):
        run = subprocess.run([str(build / "tests" / "fuzz" / ("fuzz_" + corpus.name)), "-runs=0", "-print_coverage=1",
                              str(corpus)], capture_output=True, text=True, errors="replace", env=environment)
        names = re.findall(r"^COVERED_FUNC: .*? (\w+) \S+:\d+$", run.stderr, re.MULTILINE)
        if not names:
            sys.exit("%s: no function is reached:\n%s" % (corpus.name, run.stderr[-2000:]))
        for name in names:
            targets[name].append(corpus.name)
    return targets


def tested():
    """{function: [room/test]}"""
    tests = collections.defaultdict(list)
    for path in sorted((ROOT / "tests").glob("*/test_*.c")):
        for name in set(re.findall(r"\bktg_\w+", path.read_text(encoding="utf-8"))):
            tests[name].append("%s/%s" % (path.parent.name, path.stem[5:]))
    return tests


def cell(names, most):
    if not names:
        return "–"
    return ", ".join(names[:most]) + (" and %d more" % (len(names) - most) if len(names) > most else "")


def main():
    rooms, targets, tests = public_functions(), reached(pathlib.Path(sys.argv[1])), tested()
    rows, gaps = [], 0
    for room, names in rooms.items():
        rows += ["", "**%s/**" % room, "", "| function | fuzz targets | tests |", "|---|---|---|"]
        own = "%s/" % room
        for name in names:
            calls = sorted(tests[name], key=lambda test: (not test.startswith(own), test))
            rows.append("| `%s` | %s | %s |" % (name, cell(targets[name], 6), cell(calls, 4)))
            gaps += not targets[name]
    text = PAGE.read_text(encoding="utf-8")
    before, after = text[:text.index(START) + len(START)], text[text.index(END):]
    count = sum(map(len, rooms.values()))
    summary = "%d public functions; %d are reached by no fuzz target.\n" % (count, gaps)
    PAGE.write_text(before + summary + "\n".join(rows) + "\n" + after, encoding="utf-8")
    print(summary, end="")


main()
