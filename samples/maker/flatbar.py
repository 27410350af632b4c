"""A flat bar in the plane z = 0, in centimetres, to be bent by its handles."""

from .mesh import Mesh

LENGTH, WIDTH = 30.0, 6.0
COLUMNS, ROWS = 40, 8


def build():
    """Squares cut along diagonals that take turns."""
    bar = Mesh("flat-bar")
    grid = [[bar.point((LENGTH * c / COLUMNS, WIDTH * r / ROWS, 0.0))
             for c in range(COLUMNS + 1)] for r in range(ROWS + 1)]
    for r in range(ROWS):
        for c in range(COLUMNS):
            a, b = grid[r][c], grid[r][c + 1]
            d, e = grid[r + 1][c + 1], grid[r + 1][c]
            if (r + c) % 2:
                bar.face(a, b, d)
                bar.face(a, d, e)
            else:
                bar.face(a, b, e)
                bar.face(b, d, e)
    return bar
