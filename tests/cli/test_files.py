#!/usr/bin/env python3
"""Files appear whole or not at all, and what was there is treated with care; TAP.

usage: test_files.py PROGRAM SAMPLES
"""
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

PROGRAM, SAMPLES = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
HOUSE, ROBOT = SAMPLES + "/house.obj", SAMPLES + "/robot.obj"
QUICK = ("-q", "--effort", "quick")


def start(*words, **options):
    def plain():  # a background shell hands on "ignored"
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXFSZ):
            signal.signal(number, signal.SIG_DFL)
        if "most_bytes" in limits:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limits["most_bytes"],) * 2)
        if "most_files" in limits:
            resource.setrlimit(resource.RLIMIT_NOFILE, (limits["most_files"],) * 2)
    limits = {key: options.pop(key) for key in ("most_bytes", "most_files") if key in options}
    return subprocess.Popen([PROGRAM, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            preexec_fn=plain, **options)


def run(*words, expect=0, says="", **options):
    process = start(*words, **options)
    out, err = process.communicate(timeout=100)
    assert process.returncode == expect, f"ended with {process.returncode}: {err.decode()}"
    assert says in err.decode(), err.decode()
    return out


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def whole(path):
    data = path.read_bytes()
    return data.startswith(b"%PDF") and data.rstrip().endswith(b"%%EOF")


def permissions_stay(here):
    for mode in (0o600, 0o664, 0o755):
        (here / "a.pdf").write_text("old")
        (here / "a.pdf").chmod(mode)
        run("unfold", HOUSE, *QUICK, "-o", here / "a.pdf")
        assert whole(here / "a.pdf")
        assert (here / "a.pdf").stat().st_mode & 0o7777 == mode
    mask = os.umask(0o027)
    os.umask(mask)
    run("unfold", HOUSE, *QUICK, "-o", here / "new.pdf")
    assert (here / "new.pdf").stat().st_mode & 0o777 == 0o666 & ~mask


def links_are_followed(here):
    (here / "real").mkdir()
    (here / "real/a.pdf").write_text("old")
    (here / "a.pdf").symlink_to("b.pdf")
    (here / "b.pdf").symlink_to("real/a.pdf")
    (here / "c.obj").symlink_to(here / "real/c.obj")  # to nothing yet
    run("unfold", HOUSE, *QUICK, "-o", here / "a.pdf")
    run("simplify", HOUSE, "-q", "-o", "c.obj", cwd=here)
    assert whole(here / "real/a.pdf") and (here / "real/c.obj").read_text().startswith("#")
    assert (here / "a.pdf").is_symlink() and (here / "b.pdf").is_symlink() and (here / "c.obj").is_symlink()
    assert names(here / "real") == ["a.pdf", "c.obj"] and len(names(here)) == 4


def links_to_nowhere_are_refused(here):
    (here / "a.pdf").symlink_to("no/b.pdf")
    run("unfold", HOUSE, "-o", here / "a.pdf", expect=1, says="a.pdf: cannot be written: No such file or directory")
    (here / "c.obj").symlink_to("d.obj")
    (here / "d.obj").symlink_to("c.obj")
    run("simplify", HOUSE, "-o", here / "c.obj", expect=1, says="Too many levels of symbolic links")
    assert names(here) == ["a.pdf", "c.obj", "d.obj"]


def one_file_by_two_links_is_not_written_twice(here):
    (here / "b.pdf").symlink_to("a.pdf")
    run("unfold", HOUSE, "-o", here / "a.pdf", "-o", here / "b.pdf", expect=2, says="b.pdf: is to be written twice")
    assert names(here) == ["b.pdf"]


def another_hard_link_keeps_the_old_content(here):
    (here / "a.pdf").write_text("old")
    os.link(here / "a.pdf", here / "b.pdf")
    run("unfold", HOUSE, *QUICK, "-o", here / "a.pdf")
    assert whole(here / "a.pdf") and (here / "b.pdf").read_text() == "old"


def files_of_sheets_do_not_replace_what_is_read(here):
    for name, other in (("m-02.svg", "m.svg"), ("m-03.json", "m-%d.dxf")):
        shutil.copy(ROBOT, here / name)
    before = (here / "m-02.svg").read_bytes()
    words = ("--effort", "quick", "--height", "20cm", "--faces", "all")
    run("unfold", here / "m-02.svg", *words, "-o", here / "m.svg", expect=2, says="m-02.svg: is the model itself")
    shutil.copy(ROBOT, here / "n-01.png")
    run("unfold", here / "n-01.png", *words, "-o", here / "n-%d.png", expect=2, says="n-01.png: is the model itself")
    (here / "e.edit").write_text("[fixed a]\nset = halfspace 0 1e9 0  0 -1 0\n")
    (here / "x-01.svg").symlink_to("e.edit")
    run("unfold", ROBOT, "--edit", here / "e.edit", *words, "-o", here / "x.svg", expect=2,
        says="x-01.svg: is the edit file to be read")
    assert (here / "m-02.svg").read_bytes() == before
    assert names(here) == ["e.edit", "m-02.svg", "m-03.json", "n-01.png", "x-01.svg"]


def sheets_spelt_otherwise_are_not_written_twice(here):
    words = ("--effort", "quick", "--height", "20cm")
    run("unfold", ROBOT, *words, "-o", "a.svg", "-o", "./a-%d.svg", expect=2, says="./a-01.svg: is to be written twice",
        cwd=here)
    assert names(here) == []


def a_file_that_may_not_grow_is_told(here):
    for words in (("unfold", HOUSE, *QUICK, "-o", here / "a.pdf"),
                  ("simplify", SAMPLES + "/fox.obj", "-q", "-o", here / "a.obj"),
                  ("deform", SAMPLES + "/doll.obj", "--edit", SAMPLES + "/doll-wave.edit", "-q", "-o", here / "a.obj")):
        run(*words, most_bytes=4096, expect=1, says="cannot be written: File too large")
        assert names(here) == []


def more_sheets_than_files_may_be_open(here):
    words = ("unfold", ROBOT, *QUICK, "--height", "40cm", "--paper", "a6", "-o", here / "a-%d.svg",
             "-o", here / "b-%d.dxf")
    run(*words, most_files=40)
    assert len(names(here)) > 42


def a_fifo_gets_the_bytes(here):
    os.mkfifo(here / "f.pdf")
    got = []
    reader = threading.Thread(target=lambda: got.append((here / "f.pdf").read_bytes()))
    reader.start()
    run("unfold", HOUSE, *QUICK, "-o", here / "f.pdf", "-o", here / "g.pdf")
    reader.join()
    assert got[0] == (here / "g.pdf").read_bytes()
    assert (here / "f.pdf").is_fifo()


def waits_for_its_end(process):
    """Whether it sleeps and has a handler for SIGTERM."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    caught = int(status.split("SigCgt:")[1].split()[0], 16)
    return bool(caught >> (signal.SIGTERM - 1) & 1) and status.split("State:")[1].split()[0] == "S"


def sigterm_ends_waiting_for_a_fifo(here):
    os.mkfifo(here / "f.pdf")
    os.mkfifo(here / "m.obj")
    for words in (("unfold", HOUSE, *QUICK, "--threads", 1, "-o", here / "f.pdf", "-o", here / "g.json"),
                  ("info", here / "m.obj"), ("info", "-")):
        process = start(*words, stdin=subprocess.PIPE)
        calm = 0
        while calm < 5:
            time.sleep(0.1)
            calm = calm + 1 if waits_for_its_end(process) else 0
        process.send_signal(signal.SIGTERM)
        deadline = time.time() + 20
        while process.poll() is None and time.time() < deadline:
            time.sleep(0.01)
        if process.poll() is None:
            process.kill()
        error = process.communicate()[1]
        assert process.returncode == 130, f"{words}: ended with {process.returncode}"
        assert error.endswith(b"katagami: interrupted\n"), error
    assert names(here) == ["f.pdf", "m.obj"]


def seconds_of(words):
    before = time.time()
    run(*words)
    return time.time() - before


def killed_at_any_moment(number, here, allowed, moments):
    """Sends a signal at moments all over the time the job takes; what is there is whole each time."""
    (here / "old.pdf").write_text("old")
    out = here / "out"
    out.mkdir()
    words = ("unfold", HOUSE, *QUICK, "-o", out / "a.pdf", "-o", out / "a.svg", "-o", out / "a.json", "-o", out / "a.png",
             "-o", here / "old.pdf", "-o", out / "a.dxf", "--report", out / "r.json")
    seconds = seconds_of(words)
    complete = names(out)
    assert len(complete) == 6, complete
    for k in range(moments):
        shutil.rmtree(out)
        out.mkdir()
        (here / "old.pdf").write_text("old")
        process = start(*words)
        time.sleep(seconds * (0.4 + 0.7 * k / moments))
        process.send_signal(number)
        process.communicate(timeout=100)
        there = names(out)
        assert process.returncode in allowed, f"ended with {process.returncode}"
        assert not [name for name in there if name.endswith(".tmp")] or number == signal.SIGKILL, there
        assert len([name for name in there if name.endswith(".tmp")]) <= 1, there  # between link and rename
        assert (here / "old.pdf").read_text(errors="replace") == "old" or whole(here / "old.pdf")
        assert not (out / "a.pdf").exists() or whole(out / "a.pdf")
        if number != signal.SIGKILL:
            assert there in ([], complete), there


def sigkill_leaves_whole_files(here):
    killed_at_any_moment(signal.SIGKILL, here, (0, -signal.SIGKILL), 20)


def sigterm_leaves_all_or_nothing(here):
    killed_at_any_moment(signal.SIGTERM, here, (0, 130), 10)


def sighup_leaves_all_or_nothing(here):
    killed_at_any_moment(signal.SIGHUP, here, (0, 130), 5)


def a_closed_pipe_is_told(here):
    process = start("unfold", HOUSE, *QUICK, "-o", "-", "-o", here / "a.pdf")
    process.stdout.close()
    error = process.stderr.read()
    assert process.wait() == 1 and error == b"katagami: standard output: cannot be written: Broken pipe\n", error
    assert names(here) == []


def writing_is_known_to_be_impossible_before_the_work(here):
    (here / "d.obj").mkdir()
    huge = here / "broken.obj"
    huge.write_text("this is not read\n")
    run("simplify", huge, "-o", here / "d.obj", expect=1, says="d.obj: is a folder; name a file in it")
    run("simplify", huge, "-o", here / "no/d.obj", expect=1, says="d.obj: cannot be written: No such file or directory;")
    run("deform", huge, "--edit", SAMPLES + "/doll-wave.edit", "-o", here / "no/d.obj", expect=1, says="make its folder")
    run("warp", huge, "--handles", SAMPLES + "/flat-bar.handles", "-o", here / "no/d.obj", expect=1, says="make its folder")


TESTS = [permissions_stay, links_are_followed, links_to_nowhere_are_refused,
         one_file_by_two_links_is_not_written_twice, another_hard_link_keeps_the_old_content,
         files_of_sheets_do_not_replace_what_is_read, sheets_spelt_otherwise_are_not_written_twice,
         a_file_that_may_not_grow_is_told, more_sheets_than_files_may_be_open, a_fifo_gets_the_bytes,
         sigterm_ends_waiting_for_a_fifo, sigkill_leaves_whole_files, sigterm_leaves_all_or_nothing,
         sighup_leaves_all_or_nothing, a_closed_pipe_is_told, writing_is_known_to_be_impossible_before_the_work]


def main():
    print(f"1..{len(TESTS)}")
    bad = 0
    for count, test in enumerate(TESTS, 1):
        with tempfile.TemporaryDirectory(prefix="ktg-files-") as folder:
            try:
                test(pathlib.Path(folder).resolve())
                print(f"ok {count} - {test.__name__}", flush=True)
            except (AssertionError, OSError, subprocess.TimeoutExpired) as failure:
                bad += 1
                told = str(failure).replace("\n", "\n#   ")
                print(f"not ok {count} - {test.__name__}\n# {told}", flush=True)
    sys.exit(bad > 0)


main()
