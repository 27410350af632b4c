#!/usr/bin/env python3
"""What the documents point at is there, and the README's commands do what they say.

usage: readme.py PROGRAM ROOT
"""
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile


def missing_targets(root):
    for page in [*sorted(root.glob("*.md")), *sorted((root / "docs").glob("*.md"))]:
        for target in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
            if "://" not in target and not (page.parent / target).exists():
                yield f"{page.name}: {target} is not there"


def commands_of(readme):
    for block in re.findall(r"```sh\n(.*?)```", readme, re.DOTALL):
        for line in block.splitlines():
            if line.startswith("katagami "):
                yield shlex.split(line)


def wrong_commands(program, commands, folder):
    for words in commands:
        run = subprocess.run([program, *words[1:]], cwd=folder, capture_output=True, text=True)
        if run.returncode:
            yield f"{shlex.join(words)}: exit status {run.returncode}\n{run.stderr}"
        for i, word in enumerate(words):
            if words[i - 1] not in ("-o", "--report"):
                continue
            name = pathlib.Path(word.replace("%d", "01"))
            if not (folder / name).exists() and not (folder / (name.stem + "-01" + name.suffix)).exists():
                yield f"{shlex.join(words)}: {word} was not written"


def main():
    program, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    commands = list(commands_of((root / "README.md").read_text(encoding="utf-8")))
    complaints = list(missing_targets(root))
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(root / "samples", pathlib.Path(folder) / "samples")
        complaints += wrong_commands(program, commands, pathlib.Path(folder))
    print("\n".join(complaints) or f"{len(commands)} commands")
    return 1 if complaints or len(commands) < 5 else 0


sys.exit(main())
