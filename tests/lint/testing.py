#!/usr/bin/env python3
"""docs/testing.md names every public function once, every fuzz target, and nothing that is not there.

usage: testing.py ROOT
"""
import pathlib
import re
import sys


def main():
    root = pathlib.Path(sys.argv[1])
    page = (root / "docs" / "testing.md").read_text(encoding="utf-8")
    functions, complaints = [], []
    for header in sorted(root.glob("*/*.h")):
        functions += re.findall(r"^KTG_API [^;]*?\b(ktg_\w+)\(", header.read_text(encoding="utf-8"), re.MULTILINE)
    told = re.findall(r"^\| `(ktg_\w+)` \| ([^|]*) \| ([^|]*) \|$", page, re.MULTILINE)
    names = [name for name, _, _ in told]
    complaints += ["%s is not in the table" % name for name in functions if name not in names]
    complaints += ["%s is no public function, or there twice" % name for name in names
                   if name not in functions or names.count(name) > 1]
    targets = {path.name for path in (root / "tests" / "fuzz" / "corpus").iterdir()}
    tests = {"%s/%s" % (path.parent.name, path.stem[5:]) for path in (root / "tests").glob("*/test_*.c")}
    for name, fuzzed, tested in told:
        for kind, known, cell in (("fuzz target", targets, fuzzed), ("test", tests, tested)):
            words = re.sub(r" and \d+ more$", "", cell).split(", ")
            complaints += ["%s: there is no %s %s" % (name, kind, word) for word in words
                           if word != "–" and word not in known]
    complaints += ["the fuzz target %s is not told of" % name for name in sorted(targets) if "`%s`" % name not in page]
    complaints += ["tests/fuzz/%s.c is not there" % name for name in sorted(targets)
                   if not (root / "tests" / "fuzz" / (name + ".c")).is_file()]
    print("\n".join(complaints) or "%d functions, %d fuzz targets" % (len(functions), len(targets)))
    return 1 if complaints or not functions else 0


sys.exit(main())
