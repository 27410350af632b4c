#!/usr/bin/env python3
"""On a terminal there is a line of progress, and it is gone when other words come; TAP.

usage: test_terminal.py PROGRAM SAMPLES
"""
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile

PROGRAM, SAMPLES = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
CLEARED = "\r\033[K"


def words_on_terminal(folder, *words):
    """What the program says where its standard error is a terminal, and its exit status."""
    here, there = pty.openpty()
    process = subprocess.Popen([PROGRAM, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=there)
    os.close(there)
    said = b""
    while True:
        try:
            part = os.read(here, 4096)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        said += part
    os.close(here)
    return said.decode(), process.wait()


def shown(said):
    """What a person sees in the end: the lines that were not taken back."""
    kept = []
    for line in said.replace("\r\n", "\n").split("\n"):
        kept.append(line.split(CLEARED)[-1])
    return "\n".join(kept)


def progress_comes_and_goes(folder):
    said, status = words_on_terminal(folder, "unfold", SAMPLES + "/dragon-egg.obj", "--faces", "600", "-o", "a.json")
    assert status == 0, said
    lines = re.findall(r"\d+ s  (\w+) +(\d+) %", said)
    assert lines, said
    assert all(0 <= int(percent) <= 100 for _, percent in lines), lines
    assert said.count(CLEARED) >= len(lines), said
    assert not re.search(r"\d+ s  \w+ +\d+ %", shown(said)), shown(said)
    assert shown(said).rstrip().endswith("wrote a.json"), shown(said)


def quiet_is_quiet_there_too(folder):
    said, status = words_on_terminal(folder, "unfold", SAMPLES + "/dragon-egg.obj", "--faces", "600", "-q", "-o", "a.json")
    assert status == 0 and said == "", said


def a_failure_stands_alone_on_its_line(folder):
    name = "a\033[2Jb\u202ec.json"  # in the path that is written, and in the progress
    said, status = words_on_terminal(folder, "unfold", SAMPLES + "/dragon-egg.obj", "--faces", "600", "--height", "9m", "--paper",
                                     "a6", "--oversize", "error", "-o", name)
    assert status == 1, said
    last = shown(said).rstrip().splitlines()[-1]
    assert last.startswith("katagami: ") and "\033" not in shown(said), shown(said)
    assert "\033[2J" not in said and "\u202e" not in said, said


TESTS = [progress_comes_and_goes, quiet_is_quiet_there_too, a_failure_stands_alone_on_its_line]


def main():
    print(f"1..{len(TESTS)}")
    bad = 0
    for count, test in enumerate(TESTS, 1):
        with tempfile.TemporaryDirectory(prefix="ktg-terminal-") as folder:
            try:
                test(folder)
                print(f"ok {count} - {test.__name__}", flush=True)
            except (AssertionError, OSError) as failure:
                bad += 1
                told = repr(str(failure))
                print(f"not ok {count} - {test.__name__}\n# {told}", flush=True)
    sys.exit(bad > 0)


main()
