#!/usr/bin/env python3
"""Each public header compiles alone, as C11 and as C++17, without a warning.

usage: headers.py ROOT C-COMPILER C++-COMPILER
"""
import pathlib
import subprocess
import sys
import tempfile


def compiles(root, header, compiler, language, standard):
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / ("alone." + language)
        source.write_text(f'#include "{header}"\n#include "{header}"\nint ktg_alone;\n')
        run = subprocess.run([*compiler, "-std=" + standard, "-Wall", "-Wextra", "-pedantic", "-Werror",
                              "-fsyntax-only", "-I", str(root), str(source)],
                             capture_output=True, text=True)
    if run.returncode:
        print(f"{header} as {standard}:\n{run.stderr}")
    return run.returncode == 0


def main():
    root = pathlib.Path(sys.argv[1])
    headers = [f"{folder.name}/{folder.name}.h" for folder in sorted(root.iterdir())
               if (folder / (folder.name + ".h")).is_file() and folder.name != "cli"]
    good = all([compiles(root, header, sys.argv[2].split(), "c", "c11") and
                compiles(root, header, sys.argv[3].split(), "cpp", "c++17") for header in headers])
    print(f"{len(headers)} headers")
    return 0 if good and headers else 1


sys.exit(main())
