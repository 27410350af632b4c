#!/usr/bin/env python3
"""The committed sample models are what their generator makes. usage: samples.py ROOT"""
import pathlib
import subprocess
import sys
import tempfile


def main():
    samples = pathlib.Path(sys.argv[1]) / "samples"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", str(samples / "make-samples.py"), folder], check=True,
                       stdout=subprocess.DEVNULL)
        made = sorted(pathlib.Path(folder).iterdir())
        different = [path.name for path in made
                     if not (samples / path.name).is_file()
                     or path.read_bytes() != (samples / path.name).read_bytes()]
    print("differ from what the generator makes: " + ", ".join(different) if different
          else f"{len(made)} files as generated")
    return 1 if different or not made else 0


sys.exit(main())
