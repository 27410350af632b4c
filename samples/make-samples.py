#!/usr/bin/env python3
"""Makes Katagami's sample models: make-samples.py [OUTDIR] [--only NAME]

Every model is designed here, checked, and only then written, always to the
same bytes.  Nothing but the Python standard library is needed.
"""

import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from maker.catalogue import MODELS  # noqa: E402
from maker.check import Broken, check  # noqa: E402
from maker.colours import COLOURS  # noqa: E402
from maker.obj import write  # noqa: E402


def make(model, folder):
    mesh = model.build()
    mesh.drop_unused_points()
    mesh.round_points(model.digits)
    facts = check(model.name, mesh, model.promise)
    write(folder, model.name, model.title, mesh, model.digits, COLOURS)
    print("%-14s %6d faces %6d points  edges >= %5.2f  angles >= %4.1f  "
          "%.1f x %.1f x %.1f" % ((model.name, facts.faces, facts.points,
                                   facts.edge, facts.angle)
                                  + tuple(facts.size)))


def main(arguments):
    only = None
    if "--only" in arguments:
        place = arguments.index("--only")
        only = arguments[place + 1]
        arguments = arguments[:place] + arguments[place + 2:]
    folder = arguments[0] if arguments else os.path.dirname(
        os.path.abspath(__file__))
    os.makedirs(folder, exist_ok=True)
    wanted = [m for m in MODELS if only in (None, m.name)]
    if not wanted:
        sys.exit("make-samples: no model is called %s" % only)
    broken = 0
    for model in wanted:
        try:
            make(model, folder)
        except Broken as reason:
            print("make-samples: %s" % reason, file=sys.stderr)
            broken += 1
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
