"""A doll with its arms spread: blocks, made smooth once by Catmull and Clark.

It stands in a grid of cubes; the surface of the blocks is taken, and each
face keeps the name of the part its block belongs to.
"""

from .mesh import Mesh, neighbours
from . import vec

CELL = 2.4

# Name, colour, and the blocks: ranges of cubes in x, y and z, ends excluded.
PARTS = [
    ("foot-left", "dark", (1, 2), (0, 1), (0, 3)),
    ("foot-right", "dark", (-2, -1), (0, 1), (0, 3)),
    ("leg-left", "slate", (1, 2), (1, 5), (0, 2)),
    ("leg-right", "slate", (-2, -1), (1, 5), (0, 2)),
    ("hips", "slate", (-2, 2), (5, 6), (0, 2)),
    ("body", "red", (-2, 2), (6, 9), (0, 2)),
    ("arm-left", "red", (2, 6), (8, 9), (0, 2)),
    ("arm-right", "red", (-6, -2), (8, 9), (0, 2)),
    ("hand-left", "cream", (6, 7), (8, 9), (0, 2)),
    ("hand-right", "cream", (-7, -6), (8, 9), (0, 2)),
    ("head", "cream", (-1, 1), (9, 12), (0, 2)),
]

# The corners of a cube's six sides, counter-clockwise from outside.
SIDES = {
    (1, 0, 0): [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)],
    (-1, 0, 0): [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)],
    (0, 1, 0): [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)],
    (0, -1, 0): [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)],
    (0, 0, 1): [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
    (0, 0, -1): [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)],
}


def build():
    doll = smoothed(blocks())
    doll.triangulate()
    return doll


def blocks():
    """The surface of all blocks together."""
    cubes = {}
    for name, colour, xs, ys, zs in PARTS:
        for x in range(*xs):
            for y in range(*ys):
                for z in range(*zs):
                    cubes[x, y, z] = (name, colour)
    doll, corners = Mesh("doll"), {}
    for (x, y, z), (name, colour) in sorted(cubes.items()):
        doll.use(group=name, material=colour)
        for (dx, dy, dz), side in SIDES.items():
            if (x + dx, y + dy, z + dz) in cubes:
                continue
            face = []
            for i, j, k in side:
                at = (x + i, y + j, z + k)
                if at not in corners:
                    corners[at] = doll.point((CELL * at[0], CELL * at[1],
                                              CELL * (at[2] - 1)))
                face.append(corners[at])
            doll.face(*face)
    return doll


def smoothed(mesh):
    """One step of Catmull and Clark (1978) on a closed mesh of quads."""
    fine = Mesh("doll")
    middles = [vec.mean([mesh.points[i] for i in f]) for f in mesh.faces]
    beside, faces_at, edges_at = {}, {}, {}
    for number, face in enumerate(mesh.faces):
        for a, b in neighbours(face):
            edge = (min(a, b), max(a, b))
            beside.setdefault(edge, []).append(number)
            faces_at.setdefault(a, []).append(number)
            edges_at.setdefault(a, set()).add(edge)
            edges_at.setdefault(b, set()).add(edge)
    fine.ring([rounded(mesh, middles, faces_at[i], sorted(edges_at[i]), i)
               for i in range(len(mesh.points))])
    on_edge = {edge: fine.point(vec.mean(
        [mesh.points[i] for i in edge] + [middles[f] for f in beside[edge]]))
        for edge in sorted(beside)}
    on_face = [fine.point(m) for m in middles]
    for number, (face, label) in enumerate(zip(mesh.faces, mesh.labels)):
        fine.label = label
        for k, corner in enumerate(face):
            after, before = face[(k + 1) % 4], face[k - 1]
            fine.face(corner, on_edge[min(corner, after), max(corner, after)],
                      on_face[number],
                      on_edge[min(corner, before), max(corner, before)])
    return fine


def rounded(mesh, middles, faces, edges, corner):
    """Where a corner moves: (mean face + 2 mean edge + (n - 3) itself) / n."""
    n = len(edges)
    of_faces = vec.mean([middles[f] for f in faces])
    of_edges = vec.mean([vec.mean([mesh.points[i] for i in e])
                         for e in edges])
    return tuple((f + 2.0 * e + (n - 3) * p) / n for f, e, p in zip(
        of_faces, of_edges, mesh.points[corner]))
