#!/usr/bin/env python3
"""bench/flatten measures every method, tells what fails, and writes JSON. usage: flatten.py BENCH ROOT"""
import json
import pathlib
import subprocess
import sys
import tempfile


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)


def main():
    bench, samples = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]) / "samples"
    wrong = []

    def expect(true, text):
        if not true:
            wrong.append(text)

    with tempfile.TemporaryDirectory() as name:
        out = pathlib.Path(name) / "a.json"
        done = run(bench, "--repeats", 2, "--json", out, samples / "blouse-front.obj")
        expect(done.returncode == 0 and len(done.stdout.splitlines()) == 4, done)
        rows = {row["asked"]: row for row in json.loads(out.read_text())}
        expect(list(rows) == ["arap", "injective", "two-step"], rows)
        for row in rows.values():
            expect(row["faces"] == 1440 and row["flipped_faces"] == 0 and row["written"], row)
            expect(row["seconds"] > 0 and row["method"] == row["asked"], row)
        expect(rows["arap"]["arap_energy"] <= min(row["arap_energy"] for row in rows.values()), rows)

        done = run(bench, "--methods", "injective,arap", "--repeats", 1, samples / "blouse-front.obj")
        expect(done.returncode == 0 and len(done.stdout.splitlines()) == 3, done)
        done = run(bench, "--json", out, samples / "blouse-front.obj", samples / "nothing.obj")
        expect(done.returncode == 1 and "nothing.obj" in done.stderr, done)
        expect(len(json.loads(out.read_text())) == 3, "what fails is left out")
        for words in ([], ["--repeats", "0", "x"], ["--methods", "arap,lscm", "x"], ["--what", "x", "x"],
                      ["--json", name, "x"]):
            expect(run(bench, *words).returncode == 2, words)
    print("\n".join(str(text) for text in wrong) or "good")
    return 1 if wrong else 0


sys.exit(main())
