"""What every sample model has to prove before it may be written."""

from collections import namedtuple

from . import vec
from .clash import clashes
from .mesh import neighbours
from .panels import mirror_problems, panel_problems

# The promise of one model.  `genus` and `borders` are totals over all
# components; `edge` is the least edge as a share of the model's largest
# dimension, `angle` the least corner angle in degrees, and `clearance` the
# least distance of unrelated triangles in model units.  A model that is
# `starlike` (every face visible from one inner point) cannot intersect
# itself, which is far quicker to prove than testing pairs of triangles.  A
# garment falls into `panels` along its groups and marked edges, each a disk,
# and is its own mirror image.  One with `ribs` has so many edges at which more
# than two faces meet, and no genus or borders to speak of.
Promise = namedtuple(
    "Promise", "faces components genus borders edge angle clearance starlike "
    "panels mirrored ribs",
    defaults=(1, 0, 0, 0.02, 10.0, 0.01, None, None, False, 0))


class Broken(Exception):
    """A model does not keep its promise."""


def check(name, mesh, promise):
    """Raise Broken unless the mesh keeps the promise; return some figures."""
    problems = list(shape_problems(mesh, promise))
    if not problems:
        problems = list(topology_problems(mesh, promise))
    if not problems:
        problems = list(space_problems(mesh, promise))
    if not problems and promise.panels is not None:
        problems = list(panel_problems(mesh, promise.panels))
    if not problems and promise.mirrored:
        problems = list(mirror_problems(mesh))
    if problems:
        raise Broken("%s: %s" % (name, "; ".join(problems)))
    return figures(mesh)


# -- single faces -----------------------------------------------------------

def shape_problems(mesh, promise):
    low, high = promise.faces
    if not low <= len(mesh.faces) <= high:
        yield "%d faces, not %d..%d" % (len(mesh.faces), low, high)
    if any(len(set(f)) < 3 or len(set(f)) < len(f) for f in mesh.faces):
        yield "a face repeats a corner"
        return
    if len(set(mesh.points)) < len(mesh.points):
        yield "two points at one place"
    least = promise.edge * largest_dimension(mesh)
    for a, b in sorted({tuple(sorted(h)) for f in mesh.faces
                        for h in neighbours(f)}):
        if vec.distance(mesh.points[a], mesh.points[b]) < least:
            yield "edge %s-%s shorter than %.3f" % (
                mesh.points[a], mesh.points[b], least)
    for face in mesh.faces:
        if mesh.smallest_angle(face) < promise.angle:
            yield "angle %.1f at %s" % (
                mesh.smallest_angle(face), [mesh.points[i] for i in face])
        if len(face) > 3 and unevenness(mesh, face) > 1e-9:
            yield "polygon not planar at %s" % (mesh.points[face[0]],)


def largest_dimension(mesh):
    return max(max(c) - min(c) for c in zip(*mesh.points))


def unevenness(mesh, face):
    """Greatest distance of a corner from the polygon's plane."""
    corners = [mesh.points[i] for i in face]
    centre = vec.mean(corners)
    normal = vec.unit(vec.polygon_normal(corners))
    return max(abs(vec.dot(vec.sub(p, centre), normal)) for p in corners)


# -- how faces join ---------------------------------------------------------

def topology_problems(mesh, promise):
    if promise.ribs:
        yield from rib_problems(mesh, promise)
        return
    halves = [half for face in mesh.faces for half in neighbours(face)]
    if len(set(halves)) < len(halves):
        yield "faces overlap or turn against each other at an edge"
        return
    rims = border_loops(set(halves))
    if rims is None:
        yield "a point where two borders touch"
        return
    if len(rims) != promise.borders:
        yield "%d borders, not %d" % (len(rims), promise.borders)
    if not every_point_is_one_umbrella(mesh):
        yield "a point where two sheets touch"
    parts = components(mesh)
    if len(parts) != promise.components:
        yield "%d components, not %d" % (len(parts), promise.components)
    genus = len(parts) - (euler(mesh) + len(rims)) / 2
    if genus != promise.genus:
        yield "genus %g, not %d" % (genus, promise.genus)


def rib_problems(mesh, promise):
    beside = {}
    for face in mesh.faces:
        for a, b in neighbours(face):
            edge = (min(a, b), max(a, b))
            beside[edge] = beside.get(edge, 0) + 1
    ribs = sum(1 for count in beside.values() if count > 2)
    if ribs != promise.ribs:
        yield "%d edges of ribs, not %d" % (ribs, promise.ribs)
    parts = components(mesh)
    if len(parts) != promise.components:
        yield "%d components, not %d" % (len(parts), promise.components)


def border_loops(halves):
    """The border cycles, or None where one point begins two of them."""
    following = {}
    for a, b in sorted(halves):
        if (b, a) not in halves:
            if b in following:
                return None
            following[b] = a
    loops = []
    while following:
        start = min(following)
        loop = [start]
        while loop[-1] in following:
            loop.append(following.pop(loop[-1]))
        loops.append(loop[:-1])
    return loops


def every_point_is_one_umbrella(mesh):
    """The faces around each point must form one closed or open fan."""
    spokes = {}
    for face in mesh.faces:
        n = len(face)
        for k, point in enumerate(face):
            spokes.setdefault(point, {})[face[(k + 1) % n]] = face[k - 1]
    for around in spokes.values():
        starts = set(around) - set(around.values())
        if len(starts) > 1:
            return False
        at, count = min(starts or around), 0
        while at in around and count < len(around):
            at, count = around[at], count + 1
        if count < len(around) or (not starts and at != min(around)):
            return False
    return len(spokes) == len(mesh.points)


def components(mesh):
    """Lists of face numbers, one for each connected part."""
    leader = list(range(len(mesh.points)))

    def find(i):
        while leader[i] != i:
            leader[i] = leader[leader[i]]
            i = leader[i]
        return i

    for face in mesh.faces:
        for other in face[1:]:
            leader[find(other)] = find(face[0])
    parts = {}
    for number, face in enumerate(mesh.faces):
        parts.setdefault(find(face[0]), []).append(number)
    return [parts[key] for key in sorted(parts)]


def euler(mesh):
    edges = {tuple(sorted(h)) for f in mesh.faces for h in neighbours(f)}
    return len(mesh.points) - len(edges) + len(mesh.faces)


# -- how faces lie in space -------------------------------------------------

def space_problems(mesh, promise):
    triangles = [t for face in mesh.faces for t in mesh.split(face)]
    if promise.borders == 0 and not promise.ribs:
        for part in components(mesh):
            if volume(mesh, part) <= 0.0:
                yield "a component is inside out"
    if promise.starlike is not None:
        if not seen_from(mesh.points, triangles, promise.starlike):
            yield "not starlike"
        return
    found = clashes(mesh.points, triangles, promise.clearance)
    for one, other in found[:8]:
        yield "triangles clash near %s and %s" % (
            centre(mesh, triangles[one]), centre(mesh, triangles[other]))


def centre(mesh, face):
    return tuple(round(c, 1) for c in vec.mean([mesh.points[i] for i in face]))


def volume(mesh, part):
    total = 0.0
    for number in part:
        for a, b, c in mesh.split(mesh.faces[number]):
            total += vec.dot(mesh.points[a], vec.cross(
                mesh.points[b], mesh.points[c])) / 6.0
    return total


def seen_from(points, triangles, eye):
    """On a closed genus-0 surface this proves it free of intersections."""
    rays = [vec.sub(p, eye) for p in points]
    return all(vec.dot(rays[a], vec.cross(rays[b], rays[c])) > 0.0
               for a, b, c in triangles)


# -- what the summary tells -------------------------------------------------

Figures = namedtuple("Figures", "faces points edge angle size")


def figures(mesh):
    shortest = min(vec.distance(mesh.points[a], mesh.points[b])
                   for f in mesh.faces for a, b in neighbours(f))
    size = [max(c) - min(c) for c in zip(*mesh.points)]
    return Figures(len(mesh.faces), len(mesh.points), shortest,
                   min(mesh.smallest_angle(f) for f in mesh.faces), size)
