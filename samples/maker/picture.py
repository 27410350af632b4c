"""Pictures in a few colours, painted by code and written as PNG."""

import struct
import zlib


class Picture:
    """A square of pixels; x runs to the right and y downwards."""

    def __init__(self, size, palette):
        """The palette maps names to red, green and blue from 0 to 255."""
        self.size = size
        self.palette = list(palette.values())
        self.number = {name: k for k, name in enumerate(palette)}
        self.rows = [bytearray(size) for _ in range(size)]

    def box(self, x0, y0, x1, y1, colour):
        x0, y0 = max(0, round(x0)), max(0, round(y0))
        x1, y1 = min(self.size, round(x1)), min(self.size, round(y1))
        filling = bytes([self.number[colour]]) * max(0, x1 - x0)
        for y in range(y0, y1):
            self.rows[y][x0:x1] = filling

    def disc(self, x, y, radius, colour):
        for row in range(round(y - radius), round(y + radius) + 1):
            half = (radius * radius - (row - y) ** 2)
            if half > 0:
                half **= 0.5
                self.box(x - half, row, x + half, row + 1, colour)

    def arch(self, x, y0, y1, width, colour):
        """An upright shape around x whose top is half a disc."""
        self.disc(x, y0 + width / 2, width / 2, colour)
        self.box(x - width / 2, y0 + width / 2, x + width / 2, y1, colour)

    def each(self, x0, y0, x1, y1, choose):
        """Give each pixel the colour choose(x, y), unless that is None."""
        for y in range(max(0, round(y0)), min(self.size, round(y1))):
            row = self.rows[y]
            for x in range(max(0, round(x0)), min(self.size, round(x1))):
                colour = choose(x, y)
                if colour is not None:
                    row[x] = self.number[colour]

    def write(self, text, x, y, pixel, colour):
        """Digits, five pixels high and three wide, from their upper left."""
        for digit in text:
            for k, bit in enumerate(DIGITS[int(digit)]):
                if bit == "#":
                    px, py = x + k % 3 * pixel, y + k // 3 * pixel
                    self.box(px, py, px + pixel, py + pixel, colour)
            x += 4 * pixel

    def png(self):
        head = struct.pack(">IIBBBBB", self.size, self.size, 8, 3, 0, 0, 0)
        colours = b"".join(bytes(colour) for colour in self.palette)
        body = zlib.compress(b"".join(b"\0" + bytes(r) for r in self.rows), 9)
        return b"\x89PNG\r\n\x1a\n" + b"".join(
            chunk(kind, data) for kind, data in
            ((b"IHDR", head), (b"PLTE", colours), (b"IDAT", body),
             (b"IEND", b"")))


DIGITS = ["####.##.##.####", ".#.##..#..#.###", "##...#.#.#..###",
          "##...#.#...###.", "#.##.####..#..#", "####..##...###.",
          ".###..####.####", "###..#.#..#..#.", "####.#####.####",
          "####.####..###."]


def chunk(kind, data):
    return (struct.pack(">I", len(data)) + kind + data
            + struct.pack(">I", zlib.crc32(kind + data)))


class Noise:
    """Smooth noise between 0 and 1 on a lattice of `cell` pixels."""

    def __init__(self, random, cell, turns=64):
        self.cell, self.turns = cell, turns
        self.values = [[random.next() for _ in range(turns)]
                       for _ in range(turns)]

    def at(self, x, y):
        x, y = x / self.cell, y / self.cell
        i, j = int(x), int(y)
        s, t = x - i, y - j
        s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
        rows = (self.values[(j + k) % self.turns] for k in (0, 1))
        low, high = (r[i % self.turns] * (1 - s)
                     + r[(i + 1) % self.turns] * s for r in rows)
        return low * (1 - t) + high * t
