#!/usr/bin/env python3
"""Runs a test in a locale whose numbers have decimal commas, which is made for it; TAP.

usage: with_commas.py PROGRAM
"""
import os
import shutil
import subprocess
import sys
import tempfile

NAME = "de_DE.UTF-8"

localedef = shutil.which("localedef", path=os.environ.get("PATH", "") + ":/usr/bin:/usr/sbin")
with tempfile.TemporaryDirectory(prefix="ktg-locale-") as folder:
    made = localedef and subprocess.run([localedef, "-i", "de_DE", "-f", "UTF-8", os.path.join(folder, NAME)],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
    if not made:
        print("1..0 # SKIP there is no locale with decimal commas: the package locales is missing")
        sys.exit(0)
    sys.exit(subprocess.run([sys.argv[1]], env=dict(os.environ, LOCPATH=folder, LC_ALL=NAME)).returncode)
