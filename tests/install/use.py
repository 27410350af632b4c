#!/usr/bin/env python3
"""What is installed is all a program needs: the README's C example, built by pkg-config against
the installed headers and libraries, shared and static, makes a net.

usage: use.py ROOT BUILD-FOLDER PREFIX MESON C-COMPILER
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile


def run(words, **options):
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode:
        print(" ".join(map(str, words)), done.stdout, sep="\n")
        sys.exit(1)
    return done.stdout


def install(build, prefix, meson, folder):
    """Installs below `folder` and lets the .pc file say so; returns prefix and library folder."""
    run([*meson.split(), "install", "-C", build, "--no-rebuild", "--quiet", "--destdir", folder])
    place = folder / prefix.lstrip("/")
    package = next(place.rglob("katagami.pc"))
    package.write_text(re.sub(r"^prefix=.*", f"prefix={place}", package.read_text(), flags=re.MULTILINE))
    return place, package.parent.parent, package.parent


def main():
    root, build, prefix, meson, compiler = sys.argv[1:]
    example = re.search(r"```c\n(.*?)```", (pathlib.Path(root) / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        place, libraries, packages = install(build, prefix, meson, folder)
        for file in ("bin/katagami", "man1/katagami.1", "doc/katagami/print.md", "katagami/pipeline/pipeline.h"):
            assert list(place.rglob(file)), f"{file} is not installed"
        (folder / "example.c").write_text(example.group(1))
        path = os.pathsep.join(filter(None, [str(packages), os.environ.get("PKG_CONFIG_PATH")]))
        environment = dict(os.environ, PKG_CONFIG_PATH=path, LD_LIBRARY_PATH=str(libraries))
        for kind in ("shared", "static"):
            flags = run(["pkg-config", "--cflags", "--libs", *(["--static"] if kind == "static" else []), "katagami"],
                        env=environment).split()
            if kind == "static":  # only ours: not every library of the system has a static form
                flags = [str(libraries / "libkatagami.a") if flag == "-lkatagami" else flag for flag in flags]
            program = folder / kind
            run([*compiler.split(), "-std=c11", "-Wall", "-Wextra", "-Werror", folder / "example.c", *flags,
                 "-o", program], env=environment)
            said = run([program, pathlib.Path(root) / "samples" / "house.obj"], cwd=folder, env=environment)
            assert "1 pieces on 1 sheets" in said, said
            assert (folder / "net.pdf").read_bytes().startswith(b"%PDF"), "no PDF"
            (folder / "net.pdf").unlink()
    print("the example runs, shared and static")


main()
