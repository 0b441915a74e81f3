#!/usr/bin/env python3
"""The maps of the sample forest: heights, a stream, clearings, shares of species, colours. Usage: maps.py FOLDER"""
import math
import struct
import sys
import zlib

SIDE = 256


def png(path, width, height, channels, depth, rows):
    """rows: bytes of each row from the top; depth in bits."""
    def chunk(name, data):
        body = name + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    kind = {1: 0, 3: 2}[channels]
    data = zlib.compress(b"".join(b"\0" + r for r in rows), 9)
    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0))
                + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def lattice(x, y, seed):
    n = (x * 374761393 + y * 668265263 + seed * 2147483647) & 0xFFFFFFFF
    n = ((n ^ n >> 13) * 1274126177) & 0xFFFFFFFF
    return (n ^ n >> 16) / 0xFFFFFFFF


def noise(x, y, seed):
    """Smooth value noise in [0, 1]."""
    xi, yi = math.floor(x), math.floor(y)
    u, v = x - xi, y - yi
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    a = lattice(xi, yi, seed) * (1 - u) + lattice(xi + 1, yi, seed) * u
    b = lattice(xi, yi + 1, seed) * (1 - u) + lattice(xi + 1, yi + 1, seed) * u
    return a * (1 - v) + b * v


def fractal(x, y, seed):
    return sum(noise(x * 2 ** o, y * 2 ** o, seed + o) / 2 ** (o + 1) for o in range(5)) / (1 - 1 / 32)


def stream(x, y):
    """Distance from the middle of the stream, in shares of the side."""
    return abs(x - 0.42 - 0.09 * math.sin(5.2 * y + 0.4) - 0.03 * math.sin(13 * y))


def height(x, y):
    valley = min(stream(x, y) / 0.35, 1)
    return min(max(0.12 + 0.5 * valley ** 1.4 + 0.45 * (fractal(3 * x, 3 * y, 7) - 0.5) * (0.25 + valley), 0), 1)


def grid(value):
    return [[value((c + 0.5) / SIDE, (r + 0.5) / SIDE) for c in range(SIDE)] for r in range(SIDE)]


def grey(path, values, depth=8):
    top = (1 << depth) - 1
    pack = (lambda v: struct.pack(">H", v)) if depth == 16 else (lambda v: bytes([v]))
    png(path, SIDE, SIDE, 1, depth, [b"".join(pack(round(min(max(v, 0), 1) * top)) for v in row) for row in values])


def colour(path, values):
    png(path, SIDE, SIDE, 3, 8, [bytes(round(min(max(c, 0), 1) * 255) for v in row for c in v) for row in values])


def clearing(x, y):
    return 1.0 if (x - 0.66) ** 2 / 0.02 + (y - 0.62) ** 2 / 0.012 < 1 + 0.6 * (noise(9 * x, 9 * y, 31) - 0.5) else 0.0


def shares(x, y):
    """Red oak and cherry country, green birch, blue spruce and pine: conifers on the heights."""
    h = height(x, y)
    conifer = min(max((h - 0.38) * 5 + 1.4 * (fractal(5 * x, 5 * y, 3) - 0.5), 0), 1)
    birch = (1 - conifer) * min(max(3 * (noise(7 * x, 7 * y, 5) - 0.55), 0), 1)
    return (max(1 - conifer - birch, 0), birch, conifer)


def tint(x, y):
    """From fresh to autumnal."""
    t = fractal(4 * x, 4 * y, 21)
    return (0.80 + 0.20 * t, 0.98 - 0.14 * t, 0.72 - 0.22 * t)


def main(folder):
    grey(f"{folder}/height.png", grid(height), 16)
    grey(f"{folder}/water.png", grid(lambda x, y: 1.0 if stream(x, y) < 0.012 else 0.0))
    grey(f"{folder}/clearing.png", grid(clearing))
    grey(f"{folder}/density.png", grid(lambda x, y: (1 - clearing(x, y)) * (0.15 + 0.85 * fractal(6 * x, 6 * y, 13)) if stream(x, y) > 0.02 else 0))
    colour(f"{folder}/shares.png", grid(shares))
    colour(f"{folder}/tint.png", grid(tint))


if __name__ == "__main__":
    main(sys.argv[1])
