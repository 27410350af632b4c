#!/usr/bin/env python3
"""The manual page and --help know the same options, and mandoc (where it is installed) has nothing
to say about the page. usage: manual.py PROGRAM ROOT"""
import pathlib
import re
import shutil
import subprocess
import sys

COMMANDS = ["unfold", "flatten", "deform", "simplify", "info", "verify", "warp"]


def main():
    program, page = sys.argv[1], pathlib.Path(sys.argv[2]) / "docs" / "katagami.1"
    complaints, known = [], {"help", "version"}
    for command in COMMANDS:
        shown = subprocess.run([program, command, "--help"], check=True, capture_output=True, text=True).stdout
        known |= set(re.findall(r"^ +(?:-\w, )?--([a-z-]+)", shown, re.MULTILINE))
    told = set(re.findall(r"Fl Fl ([a-z-]+)", page.read_text(encoding="utf-8")))
    complaints += [f"--{option} is not in {page.name}" for option in sorted(known - told)]
    complaints += [f"--{option} in {page.name} is no option" for option in sorted(told - known)]
    if shutil.which("mandoc"):
        lint = subprocess.run(["mandoc", "-T", "lint", "-W", "style", page], capture_output=True, text=True)
        complaints += lint.stdout.splitlines()
    print("\n".join(complaints) or f"{len(known)} options")
    return 1 if complaints or len(known) < 20 else 0


sys.exit(main())
