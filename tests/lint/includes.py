#!/usr/bin/env python3
"""The include table of docs/architecture.md: which room may include what.

usage: includes.py ROOT
"""
import pathlib
import re
import sys

ROOMS = {
    "core": set(),
    "mesh": {"core"},
    "deform": {"core", "mesh"},
    "pattern": {"core"},
    "unfold": {"core", "mesh", "pattern"},
    "flatten": {"core", "mesh", "pattern"},
    "layout": {"core", "pattern"},
    "paint": {"core", "mesh"},
    "render": {"core", "pattern", "layout", "paint"},
    "verify": {"core", "mesh", "pattern"},
    "pipeline": {"core", "mesh", "deform", "pattern", "unfold", "flatten", "layout", "paint", "render", "verify"},
    "cli": {"core", "mesh", "deform", "pattern", "unfold", "flatten", "layout", "paint", "render", "verify", "pipeline"},
}
# core's toolbox: shared between rooms beside its public header
TOOLBOX = {"core/" + name for name in
           ("clock.h", "file.h", "guard.hpp", "memory.h", "parallel.h", "target.h", "predicate.h", "random.h", "sparse.h", "sets.h", "text.h", "vec.h")}
# and the shape of tabs, which the search places too; polygons grown and hulls, which nesting needs
TOOLBOX |= {"pattern/tab_room.h", "pattern/offset.h", "pattern/hull.h"}
# and closest points, from which colours are taken again
TOOLBOX |= {"mesh/closest.h"}
LIBRARIES = {"cairo": {"render"}, "fontconfig": {"render"}, "png": {"paint"}, "jpeglib": {"paint"}, "CGAL": {"core", "mesh"}, "OpenMesh": {"mesh"},
             "suitesparse": {"core"}, "jansson": {"pattern"}}


def check_file(path, room, complaints):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
        if not match:
            continue
        where, what = f"{path}:{number}", match.group(2)
        if match.group(1) == "<":
            for library, users in LIBRARIES.items():
                if what.split("/")[0].split(".")[0] == library and room not in users:
                    complaints.append(f"{where}: {room}/ must not use {library}")
                if library in ("CGAL", "OpenMesh") and what.startswith(library) and path.suffix == ".c":
                    complaints.append(f"{where}: {library} belongs into an adapter")
            continue
        if ".." in what or "/" not in what:
            complaints.append(f"{where}: write includes from the root: {what}")
            continue
        target = what.split("/")[0]
        if target == room:
            continue
        if target not in ROOMS[room]:
            complaints.append(f"{where}: {room}/ must not include {target}/")
        elif what != f"{target}/{target}.h" and what not in TOOLBOX:
            complaints.append(f"{where}: {what} is private to {target}/")


def main():
    root = pathlib.Path(sys.argv[1])
    complaints, count = [], 0
    for room in ROOMS:
        for path in sorted((root / room).iterdir()):
            if path.suffix in (".c", ".h", ".cpp", ".hpp"):
                check_file(path, room, complaints)
                count += 1
    print("\n".join(complaints) or f"{count} files keep the include table")
    return 1 if complaints or not count else 0


sys.exit(main())
