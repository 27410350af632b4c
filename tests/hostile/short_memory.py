#!/usr/bin/env python3
"""Memory that runs out anywhere, in any library: the program says so, ends with status 1 and leaves nothing; TAP.

usage: short_memory.py PROGRAM SAMPLES SHIM [REQUESTS-TO-FAIL]

Drawing is left out: fontconfig itself crashes where it gets no memory.
"""
import os
import pathlib
import random
import subprocess
import sys
import tempfile

PROGRAM, SAMPLES, SHIM = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:4])
TRIALS = int(sys.argv[4]) if len(sys.argv) > 4 else 24

JOBS = {
    "unfold": ["unfold", SAMPLES + "/house.obj", "-q", "--threads", "1", "--effort", "quick", "-o", "a.json"],
    "unfold_in_threads": ["unfold", SAMPLES + "/robot.obj", "-q", "--threads", "2", "--effort", "quick", "--faces", "150",
                          "-o", "a.json", "--report", "r.json"],
    "flatten": ["flatten", SAMPLES + "/blouse-front.obj", "-q", "--unit", "cm", "-o", "a.json"],
    "simplify": ["simplify", SAMPLES + "/fox.obj", "-q", "--faces", "100", "-o", "a.obj"],
    "deform": ["deform", SAMPLES + "/bracket.obj", "--edit", SAMPLES + "/bracket-bend.edit", "-q", "-o", "a.obj"],
    "warp": ["warp", SAMPLES + "/flat-bar.obj", "--handles", SAMPLES + "/flat-bar.handles", "-q", "-o", "a.obj"],
    "info": ["info", SAMPLES + "/robot.obj"],
}


def run(folder, words, **extra):
    return subprocess.run([PROGRAM, *words], cwd=folder, env=dict(os.environ, LD_PRELOAD=SHIM, **extra),
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=100)


def requests_of(folder, words):
    with tempfile.NamedTemporaryFile() as count:
        run(folder, words, COUNT_INTO=count.name)
        return int(pathlib.Path(count.name).read_text())


def starve(words, folder):
    before = requests_of(folder, ["--version"])  # made by the libraries before the program begins
    after = requests_of(folder, words)
    assert after > before + 100, f"{after} requests, {before} of them before the start"
    choice, failed = random.Random(1), 0
    for number in sorted(choice.sample(range(before + 1, after), min(TRIALS, after - before - 1))):
        for name in os.listdir(folder):
            os.unlink(os.path.join(folder, name))
        done = run(folder, words, FAIL_AT=str(number))
        told = done.stderr.decode().splitlines()
        where = f"request {number}: ended with {done.returncode}: {told}"
        assert done.returncode in (0, 1), where  # 0: a library could do without
        if done.returncode == 1:
            failed += 1
            assert told[-1].startswith("katagami: ") and "memory" in told[-1], where
            assert not os.listdir(folder), f"{where}; left behind: {os.listdir(folder)}"
    assert failed > TRIALS // 4, f"only {failed} failures of {TRIALS}"


def main():
    print(f"1..{len(JOBS)}")
    bad = 0
    for count, (name, words) in enumerate(JOBS.items(), 1):
        with tempfile.TemporaryDirectory(prefix="ktg-memory-") as folder:
            try:
                starve(words, folder)
                print(f"ok {count} - {name}", flush=True)
            except (AssertionError, subprocess.TimeoutExpired) as failure:
                bad += 1
                print(f"not ok {count} - {name}\n# {failure}", flush=True)
    sys.exit(bad > 0)


main()
