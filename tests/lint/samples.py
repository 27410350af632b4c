#!/usr/bin/env python3
"""The committed sample models are what their generator makes. usage: samples.py ROOT"""
import pathlib
import subprocess
import sys
import tempfile
import zlib


def content(path):
    """A file's bytes; of a PNG what is packed in it, for zlib packs as its version does."""
    data = path.read_bytes()
    if path.suffix != ".png":
        return data
    at, parts, packed = 8, [data[:8]], b""
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], "big")
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        packed += body if kind == b"IDAT" else b""
        parts += [] if kind == b"IDAT" else [kind, body]
        at += 12 + size
    return b"".join(parts) + zlib.decompress(packed)


def main():
    samples = pathlib.Path(sys.argv[1]) / "samples"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", str(samples / "make-samples.py"), folder], check=True,
                       stdout=subprocess.DEVNULL)
        made = sorted(pathlib.Path(folder).iterdir())
        different = [path.name for path in made
                     if not (samples / path.name).is_file()
                     or content(path) != content(samples / path.name)]
    print("differ from what the generator makes: " + ", ".join(different) if different
          else f"{len(made)} files as generated")
    return 1 if different or not made else 0


sys.exit(main())
