"""Curves a pattern maker draws: Bezier arcs, and points spaced along them."""

import math

from . import vec


def bezier(p, q, r, s, pieces=64):
    """A cubic from p to s as a row of points."""
    row = []
    for k in range(pieces + 1):
        t = k / pieces
        weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t),
                   t ** 3)
        row.append(tuple(sum(w * c for w, c in zip(weights, places))
                         for places in zip(p, q, r, s)))
    return row


def spaced(row, count):
    """count + 1 points at equal distances along a row of points."""
    reach = [0.0]
    for a, b in zip(row, row[1:]):
        reach.append(reach[-1] + math.dist(a, b))
    result, k = [], 0
    for n in range(count + 1):
        wanted = reach[-1] * n / count
        while k < len(row) - 2 and reach[k + 1] < wanted:
            k += 1
        share = (wanted - reach[k]) / (reach[k + 1] - reach[k])
        result.append(vec.mix(row[k], row[k + 1], share))
    # The ends themselves, free of rounding.
    return [tuple(row[0])] + result[1:-1] + [tuple(row[-1])]


def relaxed(rows, sweeps):
    """A plane grid with its inner points drawn towards their neighbours'
    mean; a few sweeps even out the cells, many would crowd them."""
    rows = [list(row) for row in rows]
    for _ in range(sweeps):
        for j in range(1, len(rows) - 1):
            row = rows[j]
            for i in range(1, len(row) - 1):
                around = (row[i - 1], row[i + 1], rows[j - 1][i],
                          rows[j + 1][i])
                row[i] = (sum(p[0] for p in around) / 4.0,
                          sum(p[1] for p in around) / 4.0)
    return rows


def coons(low, high, left, right, n, s, t):
    """The patch between four curves: its place (s, t).

    `low` and `high` are rows of points, of which the n-th are at s; `left`
    and `right` are the points at t.
    """
    return tuple(
        (1 - t) * low[n][k] + t * high[n][k]
        + (1 - s) * left[k] + s * right[k]
        - (1 - s) * ((1 - t) * low[0][k] + t * high[0][k])
        - s * ((1 - t) * low[-1][k] + t * high[-1][k])
        for k in range(len(left)))
