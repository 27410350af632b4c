"""Do any two triangles of a mesh touch that have no right to?"""

import math

from . import vec


def clashes(points, triangles, clearance):
    """Pairs of triangles that cross, or come nearer than `clearance`.

    Triangles that share an edge or a corner touch there, of course; they
    are only tested with the parts that do not meet.
    """
    found = []
    for one, other in near_pairs(points, triangles, clearance):
        if clash(points, triangles[one], triangles[other], clearance):
            found.append((one, other))
    return found


def near_pairs(points, triangles, margin):
    """Pairs whose boxes overlap, found through a grid of cells."""
    boxes = [box_of([points[i] for i in t], margin) for t in triangles]
    size = sum(max(hi[k] - lo[k] for k in range(3))
               for lo, hi in boxes) / len(boxes)
    cells = {}
    for number, (lo, hi) in enumerate(boxes):
        for cell in cells_under(lo, hi, size):
            cells.setdefault(cell, []).append(number)
    pairs = set()
    for members in cells.values():
        for k, one in enumerate(members):
            for other in members[k + 1:]:
                if boxes_overlap(boxes[one], boxes[other]):
                    pairs.add((one, other))
    return sorted(pairs)


def box_of(corners, margin):
    return (tuple(min(p[k] for p in corners) - margin for k in range(3)),
            tuple(max(p[k] for p in corners) + margin for k in range(3)))


def boxes_overlap(a, b):
    return all(a[0][k] <= b[1][k] and b[0][k] <= a[1][k] for k in range(3))


def cells_under(lo, hi, size):
    low = [math.floor(c / size) for c in lo]
    high = [math.floor(c / size) for c in hi]
    for x in range(low[0], high[0] + 1):
        for y in range(low[1], high[1] + 1):
            for z in range(low[2], high[2] + 1):
                yield (x, y, z)


def clash(points, t, u, clearance):
    shared = set(t) & set(u)
    if len(shared) == 3:
        return True
    if len(shared) == 2:
        return folded_flat(points, t, u, shared)
    p = [points[i] for i in t]
    q = [points[i] for i in u]
    if len(shared) == 1:
        corner = shared.pop()
        return (pierces(opposite_edge(points, t, corner), q) or
                pierces(opposite_edge(points, u, corner), p))
    return (any(pierces(edge, q) for edge in edges_of(p)) or
            any(pierces(edge, p) for edge in edges_of(q)) or
            gap(p, q) < clearance)


def folded_flat(points, t, u, shared):
    """Two neighbours lie on each other when their free corners do."""
    a, b = sorted(shared)
    axis = vec.unit(vec.sub(points[b], points[a]))
    wings = []
    for face in (t, u):
        free = points[(set(face) - shared).pop()]
        wing = vec.sub(free, points[a])
        wings.append(vec.sub(wing, vec.scale(axis, vec.dot(wing, axis))))
    return vec.angle_between(*wings) < 3.0


def opposite_edge(points, face, corner):
    k = face.index(corner)
    return points[face[(k + 1) % 3]], points[face[(k + 2) % 3]]


def edges_of(corners):
    return [(corners[i], corners[(i + 1) % 3]) for i in range(3)]


def pierces(edge, triangle):
    """Does the segment pass through the triangle (its rim included)?"""
    a, b, c = triangle
    start, end = edge
    normal = vec.cross(vec.sub(b, a), vec.sub(c, a))
    s = vec.dot(vec.sub(start, a), normal)
    e = vec.dot(vec.sub(end, a), normal)
    if s * e > 0 or s == e:
        return False
    hit = vec.mix(start, end, s / (s - e))
    return all(vec.dot(vec.cross(vec.sub(q, p), vec.sub(hit, p)), normal) >= 0
               for p, q in edges_of(triangle))


def gap(p, q):
    """Distance of two triangles that do not cross."""
    return min(
        min(segment_gap(e, f) for e in edges_of(p) for f in edges_of(q)),
        min(point_gap(a, q) for a in p), min(point_gap(a, p) for a in q))


def point_gap(point, triangle):
    """Distance to the inside of a triangle; its rim is segment_gap's."""
    a, b, c = triangle
    normal = vec.unit(vec.cross(vec.sub(b, a), vec.sub(c, a)))
    inside = all(
        vec.dot(vec.cross(vec.sub(q, p), vec.sub(point, p)), normal) >= 0
        for p, q in edges_of(triangle))
    return abs(vec.dot(vec.sub(point, a), normal)) if inside else math.inf


def segment_gap(e, f):
    (a, b), (c, d) = e, f
    u, v, w = vec.sub(b, a), vec.sub(d, c), vec.sub(a, c)
    uu, uv, vv = vec.dot(u, u), vec.dot(u, v), vec.dot(v, v)
    uw, vw = vec.dot(u, w), vec.dot(v, w)
    det = uu * vv - uv * uv
    s = clamp((uv * vw - vv * uw) / det) if det > 1e-12 * uu * vv else 0.0
    t = clamp((uv * s + vw) / vv)
    s = clamp((uv * t - uw) / uu)
    return vec.distance(vec.mix(a, b, s), vec.mix(c, d, t))


def clamp(value):
    return min(1.0, max(0.0, value))
