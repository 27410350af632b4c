#!/usr/bin/env python3
"""The benchmark measures files, folders and folders of folders, tells what fails, and its JSON can
be compared. usage: tools.py BENCH ROOT"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)


def main():
    bench, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    compare, wrong = root / "bench" / "compare", []

    def expect(true, text):
        if not true:
            wrong.append(text)

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for part, sample in (("b", "star.obj"), ("a", "house.obj"), ("a", "geodesic.obj")):
            (folder / "models" / part).mkdir(parents=True, exist_ok=True)
            shutil.copy(root / "samples" / sample, folder / "models" / part)
        (folder / "models" / "README").write_text("no model")
        done = run(bench, "--seeds", 2, "--efforts", "quick,normal", "--json", folder / "a.json", folder / "models")
        expect(done.returncode == 0 and "3 of 3 models" in done.stdout, f"folders: {done}")
        data = json.loads((folder / "a.json").read_text())
        expect(list(data["models"]) == ["a/geodesic.obj", "a/house.obj", "b/star.obj"], list(data["models"]))
        house = data["models"]["a/house.obj"]
        expect(house["faces"] == 112 and house["runs_one_piece"] == 2 and house["seconds_median"] > 0, house)
        for effort in ("quick", "normal"):
            sheet = house[effort]
            percent = sheet["full_percent"] + sheet["reduced_percent"] + sheet["none_percent"]
            expect(0 < sheet["fill"] < 1 and 0 < sheet["bare_fill"] < 1 and abs(percent - 100) < 1e-6, sheet)
        expect("best" not in house, house)
        expect(data["worst"]["quick"]["fill"] <= data["median"]["quick"]["fill"], data["worst"])
        done = run(bench, "--seeds", 1, "--effort", "quick", "--faces", 60, "--json", folder / "b.json",
                   folder / "models" / "a", folder / "models" / "b" / "star.obj")
        expect(done.returncode == 0, f"a folder and a file: {done}")
        data = json.loads((folder / "b.json").read_text())
        expect(list(data["models"]) == ["geodesic.obj", "house.obj", "star.obj"], list(data["models"]))
        expect(max(m["faces"] for m in data["models"].values()) <= 112, data)

        done = run(sys.executable, compare, folder / "a.json", folder / "a.json")
        rows = {line.split()[0]: line.split()[1:] for line in done.stdout.splitlines() if line}
        expect(done.returncode == 0 and set(rows["median"]) <= {"1.000", "+0.0"}, done.stdout)
        done = run(sys.executable, compare, folder / "a.json", folder / "b.json")
        expect(done.returncode == 2 and "no model in common" in done.stderr, done)
        expect(run(sys.executable, compare, folder / "a.json").returncode == 2, "one file")
        expect(run(sys.executable, compare, bench, bench).returncode == 2, "no JSON")

        (folder / "empty").mkdir()
        (folder / "bad.obj").write_text("f 1 2 3\n")
        done = run(bench, "--seeds", 1, folder / "empty", folder / "bad.obj", folder / "models" / "b")
        expect(done.returncode == 1 and "1 of 1 models" in done.stdout, done)
        expect("holds no models" in done.stderr and "bad.obj" in done.stderr, done.stderr)
        for words in ([], ["--seeds", "0", "x"], ["--efforts", "quick,lazy", "x"], ["--what", "x"]):
            expect(run(bench, *words).returncode == 2, words)
    print("\n".join(str(text) for text in wrong) or "good")
    return 1 if wrong else 0


sys.exit(main())
