#!/usr/bin/env python3
"""The nesting benchmark reads instances, tells densities, and says what is none.
usage: nest.py BENCH"""
import json
import pathlib
import subprocess
import sys
import tempfile

TRIANGLES = {"name": "triangles", "strip_height": 10.01,
             "items": [{"demand": 6, "allowed_orientations": [0.0, 180.0],
                        "shape": {"type": "simple_polygon", "data": [[0, 0], [10, 0], [0, 10], [0, 0]]}}]}
FREE = {"name": "fu", "strip_height": 20, "items": [{"demand": 3, "shape": {"data": [[0, 0], [9, 0], [0, 9]]}}]}


def main():
    bench, wrong = pathlib.Path(sys.argv[1]).resolve(), []

    def run(*words):
        return subprocess.run([str(word) for word in (bench, *words)], capture_output=True, text=True, check=False)

    def expect(true, text):
        if not true:
            wrong.append(text)

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for file, data in (("a.json", TRIANGLES), ("b.json", FREE), ("bad.json", {"items": 3})):
            (folder / file).write_text(json.dumps(data))
        done = run("--work", 20000000, folder / "a.json", folder / "b.json")
        rows = {line.split()[0]: line.split()[1:] for line in done.stdout.splitlines()}
        expect(done.returncode == 0 and set(rows) == {"instance", "triangles", "fu", "mean"}, done)
        expect(95 < float(rows["triangles"][2]) <= 100 and rows["triangles"][3] == "-", rows)
        expect(0 < float(rows["fu"][3]) < 1.1 and rows["fu"][3] == rows["mean"][1], rows)
        again = run("--work", 20000000, folder / "a.json", folder / "b.json")
        expect([line[:70] for line in done.stdout.splitlines()] == [line[:70] for line in again.stdout.splitlines()],
               "another run, another result")
        done = run("--work", 1000, folder / "bad.json", folder / "none.json", folder / "a.json")
        expect(done.returncode == 1 and "bad.json" in done.stderr and "none.json" in done.stderr, done)
        expect("triangles" in done.stdout, done)
        for words in ([], ["--what", "x", "y"], ["--seconds", "1"]):
            expect(run(*words).returncode == 2, words)
    print("\n".join(str(text) for text in wrong) or "good")
    return 1 if wrong else 0


sys.exit(main())
