#!/usr/bin/env python3
"""tests/valgrind/commands.py - the main commands under valgrind: nothing is read that was not written, nothing is lost.

usage: commands.py VALGRIND PROGRAM SAMPLES SUPPRESSIONS
"""
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile

HANDLES = "hold vertex 1\nvertex 2 by 1 0.5\n"
EDIT = "[fixed ground]\nset = halfspace 0 1 0 0 -1 0\n[handle top]\nset = vertex 1\nmove = 0 1 0\n"

# what is run, each list in a folder of its own and in this order, as later ones read what earlier ones write
RUNS = [["unfold {samples}/star.obj --effort quick -o net.pdf -o net.svg -o net.dxf -o net.png -o net.json",
         "verify net.json {samples}/star.obj",
         "unfold {samples}/star.obj --method genetic --restarts 0 --height 30cm --oversize tile -o poster.pdf",
         "deform {samples}/star.obj --edit some.edit -o moved.obj --sets sets.obj --preview moved.png",
         "simplify {samples}/fox.obj --faces 60 -o small.stl",
         "info small.stl"],
        ["flatten {samples}/house.obj --unit cm --seams auto --effort quick -o cloth.pdf -o cloth.dxf -o cloth.json",
         "verify cloth.json",
         "warp cloth.json#1 --handles some.handles -o warped.json"]]


def run(words, texts, samples):
    """(command, exit status, what it said) of each."""
    done = []
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "some.handles").write_text(HANDLES)
        (pathlib.Path(folder) / "some.edit").write_text(EDIT)
        for text in texts:
            process = subprocess.run(words + text.format(samples=samples).split(), cwd=folder, stdin=subprocess.DEVNULL,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
            done.append((text, process.returncode, process.stdout))
    return done


def main():
    valgrind, program, samples, suppressions = sys.argv[1:]
    program = str(pathlib.Path(program).resolve())
    words = [valgrind, "-q", "--leak-check=full", "--errors-for-leak-kinds=definite", "--show-leak-kinds=definite",
             "--error-exitcode=99", "--suppressions=" + suppressions, program]
    with concurrent.futures.ThreadPoolExecutor() as pool:
        done = sum(pool.map(lambda texts: run(words, texts, samples), RUNS), [])
    print("1..%d" % len(done))
    for number, (text, status, said) in enumerate(done, 1):
        print("%s %d - %s" % ("not ok" if status else "ok", number, text))
        if status:
            print("\n".join("# " + line for line in said.splitlines()[:60]))
    return 1 if any(status for _, status, _ in done) else 0


sys.exit(main())
