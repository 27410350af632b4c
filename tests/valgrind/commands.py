#!/usr/bin/env python3
"""tests/valgrind/commands.py - the main commands under valgrind: nothing is read that was not written, nothing is lost.

usage: commands.py VALGRIND PROGRAM SAMPLES SUPPRESSIONS
"""
import pathlib
import subprocess
import sys
import tempfile

HANDLES = "hold vertex 1\nvertex 2 by 1 0.5\n"
EDIT = "[fixed ground]\nset = halfspace 0 1 0 0 -1 0\n[handle top]\nset = vertex 1\nmove = 0 1 0\n"

# what is run, in this order, as later ones read what earlier ones write
RUNS = ["unfold {samples}/star.obj --effort quick -o net.pdf -o net.svg -o net.dxf -o net.png -o net.json",
        "unfold {samples}/house.obj --method genetic --restarts 0 --generations 20 --height 30cm --oversize tile -o house.pdf",
        "verify net.json {samples}/star.obj",
        "flatten {samples}/house.obj --unit cm --seams auto --effort quick -o cloth.pdf -o cloth.dxf -o cloth.json",
        "verify cloth.json",
        "warp cloth.json#1 --handles some.handles -o warped.json",
        "deform {samples}/star.obj --edit some.edit -o moved.obj --sets sets.obj --preview moved.png",
        "simplify {samples}/fox.obj --faces 60 -o small.stl",
        "info small.stl"]


def main():
    valgrind, program, samples, suppressions = sys.argv[1:]
    program = str(pathlib.Path(program).resolve())
    words = [valgrind, "-q", "--leak-check=full", "--errors-for-leak-kinds=definite", "--show-leak-kinds=definite",
             "--error-exitcode=99", "--suppressions=" + suppressions, program]
    print("1..%d" % len(RUNS))
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "some.handles").write_text(HANDLES)
        (pathlib.Path(folder) / "some.edit").write_text(EDIT)
        for number, text in enumerate(RUNS, 1):
            run = subprocess.run(words + text.format(samples=samples).split(), cwd=folder, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
            print("%s %d - %s" % ("not ok" if run.returncode else "ok", number, text), flush=True)
            if run.returncode:
                failed += 1
                print("\n".join("# " + line for line in run.stdout.splitlines()[:60]))
    return 1 if failed else 0


sys.exit(main())
