"""Closed tubes: a torus and a trefoil knot."""

import math

from . import vec
from .mesh import Mesh

TURN = 2.0 * math.pi


def build_torus():
    return closed_tube("torus", lambda t: (9.0 * math.sin(t), 0.0,
                                           9.0 * math.cos(t)),
                       lambda t: (math.sin(t), 0.0, math.cos(t)),
                       radius=4.0, rings=16, sides=8)


def build_knot():
    """A trefoil wound on a torus; the torus lends the tube its frame.

    Taking the outward direction from the torus makes the frame come back
    to where it began, so the tube closes without a twist to undo.
    """
    def outward(t):
        return (math.cos(3 * t) * math.sin(2 * t), math.sin(3 * t),
                math.cos(3 * t) * math.cos(2 * t))

    def path(t):
        core = (8.5 * math.sin(2 * t), 0.0, 8.5 * math.cos(2 * t))
        return vec.add(core, vec.scale(outward(t), 3.9))

    knot = closed_tube("knot", path, outward, radius=2.1, rings=54, sides=6)
    knot.move(lambda p: (p[0], -p[2], p[1]))    # its face to the front
    return knot


def closed_tube(name, path, outward, radius, rings, sides):
    """Rings around a closed path, every other one turned by half a side.

    The half turns give well-shaped triangles and a lively surface.
    """
    assert rings % 2 == 0
    mesh = Mesh(name)
    loops = []
    for k in range(rings):
        t = TURN * k / rings
        ahead = vec.unit(vec.sub(path(t + 1e-4), path(t - 1e-4)))
        across = vec.unit(vec.cross(ahead, outward(t)))
        out = vec.cross(across, ahead)
        loop = []
        for s in range(sides):
            angle = TURN * (s + 0.5 * (k % 2)) / sides
            loop.append(vec.add(path(t), vec.add(
                vec.scale(out, radius * math.cos(angle)),
                vec.scale(across, radius * math.sin(angle)))))
        loops.append(mesh.ring(loop))
    for k in range(rings):
        join_staggered(mesh, loops[k], loops[(k + 1) % rings], k % 2)
    return mesh


def join_staggered(mesh, lower, upper, lower_is_turned):
    """Triangles between two loops that are half a side apart."""
    n = len(lower)
    for s in range(n):
        t = (s + 1) % n
        if lower_is_turned:
            mesh.face(lower[s], upper[t], upper[s])
            mesh.face(lower[s], lower[t], upper[t])
        else:
            mesh.face(lower[s], lower[t], upper[s])
            mesh.face(lower[t], upper[t], upper[s])
