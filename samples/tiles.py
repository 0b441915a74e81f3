#!/usr/bin/env python3
"""Puts pictures of one size side by side. Usage: tiles.py COLUMNS OUT.png IN.png...   (8 bits a channel, not interlaced)"""
import pathlib
import struct
import sys
import zlib


def read_png(path):
    """The rows, three bytes a pixel; transparency is left away."""
    data, at, packed = pathlib.Path(path).read_bytes(), 8, b""
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if name == b"IHDR":
            width, _, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", body)
        if name == b"IDAT":
            packed += body
        at += length + 12
    if depth != 8 or interlaced or kind not in (2, 6):
        sys.exit(f"{path}: is not of 8 bits a channel in RGB or RGBA")
    step = 3 if kind == 2 else 4
    lines, above, rows = zlib.decompress(packed), bytearray(width * step), []
    for at in range(0, len(lines), 1 + width * step):
        row = bytearray(lines[at + 1:at + 1 + width * step])
        for i, difference in enumerate(row):
            left, corner = (row[i - step], above[i - step]) if i >= step else (0, 0)
            row[i] = difference + predicted(lines[at], left, above[i], corner) & 255
        above = row
        rows.append(bytes(c for i, c in enumerate(row) if i % step < 3))
    return rows


def predicted(filter_type, left, up, corner):
    """What the PNG specification (section 9) predicts for a byte."""
    if filter_type < 4:
        return (0, left, up, (left + up) // 2)[filter_type]
    return min((left, up, corner), key=lambda c: abs(left + up - corner - c))  # the first of equals


def write_png(path, rows):
    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    # Filter 1: every byte as the difference from the pixel on the left.
    lines = b"".join(b"\1" + bytes(c - (row[i - 3] if i >= 3 else 0) & 255 for i, c in enumerate(row)) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def main():
    columns, out, names = int(sys.argv[1]), sys.argv[2], sys.argv[3:]
    tiles = [read_png(name) for name in names]
    rows = []
    for i in range(0, len(tiles), columns):
        rows += [b"".join(parts) for parts in zip(*tiles[i:i + columns])]
    write_png(out, rows)


if __name__ == "__main__":
    main()
