"""Models that descend from the icosahedron: geodesic ball and star."""

import math

from . import vec
from .mesh import Mesh, neighbours


def icosahedron():
    """Twelve unit points and twenty faces, one point at the top."""
    ring_height, ring_radius = math.sqrt(0.2), math.sqrt(0.8)
    points = [(0.0, 1.0, 0.0)]
    for height, turn in ((ring_height, 0.0), (-ring_height, 36.0)):
        for k in range(5):
            angle = math.radians(72.0 * k + turn)
            points.append((ring_radius * math.sin(angle), height,
                           ring_radius * math.cos(angle)))
    points.append((0.0, -1.0, 0.0))
    faces = []
    for k in range(5):
        upper, upper_next = 1 + k, 1 + (k + 1) % 5
        lower, lower_next = 6 + k, 6 + (k + 1) % 5
        faces += [(0, upper, upper_next), (upper, lower, upper_next),
                  (upper_next, lower, lower_next), (11, lower_next, lower)]
    return points, faces


def subdivided(frequency):
    """Unit points and faces of the icosahedron split evenly and rounded."""
    corners, faces = icosahedron()
    numbers, points, small = {}, [], []

    def number(weights):
        # The same grid point comes up in several faces: name it by its
        # corners and shares, which are whole numbers and hence exact.
        key = tuple(sorted((c, w) for c, w in weights if w))
        if key not in numbers:
            place = (0.0, 0.0, 0.0)
            for corner, weight in key:
                place = vec.add(place, vec.scale(corners[corner], weight))
            numbers[key] = len(points)
            points.append(vec.unit(place))
        return numbers[key]

    for a, b, c in faces:
        def at(i, j):
            return number(((a, frequency - i - j), (b, i), (c, j)))
        for i in range(frequency):
            for j in range(frequency - i):
                small.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j + 2 <= frequency:
                    small.append((at(i + 1, j), at(i + 1, j + 1),
                                  at(i, j + 1)))
    return points, small


def build_geodesic():
    mesh = Mesh("geodesic")
    points, faces = subdivided(3)
    mesh.ring([vec.scale(p, 10.0) for p in points])
    for face in faces:
        mesh.face(*face)
    return mesh


def build_star():
    """The outer skin of the small stellated dodecahedron.

    Twelve spikes end on an icosahedron; their feet are the corners of the
    inner dodecahedron, which lie under the icosahedron's faces.
    """
    mesh = Mesh("star")
    mesh.use(material="gold")
    tips, faces = icosahedron()
    for tip in tips:
        mesh.point(vec.scale(tip, 12.0))
    foot_radius = 12.0 * 0.562777
    feet = [mesh.point(vec.scale(vec.unit(vec.mean([tips[i] for i in f])),
                                 foot_radius)) for f in faces]
    left_of = {half: feet[k] for k, face in enumerate(faces)
               for half in neighbours(face)}
    for (a, b), foot in sorted(left_of.items()):
        mesh.face(a, left_of[(b, a)], foot)
    return mesh
