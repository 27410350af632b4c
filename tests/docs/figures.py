#!/usr/bin/env python3
"""docs/report.md names every figure --report writes, and no other. usage: figures.py PROGRAM ROOT"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile


def figures(program, root, command, model, *options):
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        subprocess.run([program, command, root / "samples" / model, "--quiet", "-o", pathlib.Path(folder) / "net.json",
                        "--report", report, *options], check=True)
        return set(json.loads(report.read_text(encoding="utf-8")))


def main():
    program, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    written = figures(
        program, root, "unfold", "doll.obj", "--faces", "100", "--edit", root / "samples" / "doll-wave.edit") | figures(
        program, root, "flatten", "blouse-front.obj", "--unit", "cm", "--paper", "a0")
    table = [line.split("|")[1] for line in (root / "docs" / "report.md").read_text(encoding="utf-8").splitlines()
             if line.startswith("| `")]
    told = {key for cell in table for key in re.findall(r"`(\w+)`", cell)}
    for key in sorted(written ^ told):
        print(f"{key} is written and not told" if key in written else f"{key} is told and not written")
    print(f"{len(written)} figures")
    return 1 if written != told or len(written) < 20 else 0


sys.exit(main())
