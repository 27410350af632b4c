"""Plain three-dimensional vectors as tuples."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scale(a, 1.0 / length(a))


def distance(a, b):
    return length(sub(a, b))


def mix(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def mean(points):
    n = float(len(points))
    return tuple(sum(p[k] for p in points) / n for k in range(3))


def angle_between(a, b):
    """Angle in degrees, accurate for small and for flat angles alike."""
    return math.degrees(math.atan2(length(cross(a, b)), dot(a, b)))


def polygon_normal(points):
    """Newell's normal; its length is twice the area of a planar polygon."""
    total = (0.0, 0.0, 0.0)
    for i, p in enumerate(points):
        total = add(total, cross(p, points[(i + 1) % len(points)]))
    return total
