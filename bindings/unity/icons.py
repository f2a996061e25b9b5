#!/usr/bin/env python3
"""Draws the icons of the Unity package's components, Editor/Icons/*.png. metas.py names them in the metas of scripts.

usage: icons.py
"""
import math
import os
import struct
import zlib

PACKAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "package")
SIDE = 64  # pixels
FINE = 4  # samples a pixel, each way
INK, DARK = (255, 158, 51), (122, 66, 20)  # seen on Unity's light and dark skins


def distance(x, y, a, b):
    """From a point to a line between two others."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = max(0.0, min(1.0, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy)))
    return math.hypot(x - a[0] - t * dx, y - a[1] - t * dy)


# Each returns the colour at a point, 0 to 1 from the top left, or None.


def grating(x, y):
    inside = max(abs(x - 0.5), abs(y - 0.5)) < 0.42
    return (INK if math.cos(2.0 * math.pi * (x - 0.5) / 0.168) > 0.0 else DARK) if inside else None


def surface(x, y):
    """A plate, seen from the front and above."""
    depth = (y - 0.25) / 0.5
    left = 0.28 - 0.22 * depth
    along = (x - left) / (1.0 - 2.0 * left)
    inside = 0.0 < depth < 1.0 and 0.0 < along < 1.0
    return (INK if math.cos(2.0 * math.pi * 4.5 * along) < 0.0 else DARK) if inside else None


def device(x, y):
    """A stylus on ridges."""
    if distance(x, y, (0.42, 0.62), (0.8, 0.12)) < 0.075 or distance(x, y, (0.36, 0.7), (0.42, 0.62)) < 0.035:
        return INK
    height = 0.74 if math.cos(2.0 * math.pi * (x - 0.36) / 0.22) > 0.0 else 0.82
    return DARK if 0.06 < x < 0.94 and height < y < 0.92 else None


def effect(x, y):
    """A spring."""
    turns = [(0.5 + (0.24 if i % 2 else -0.24), 0.2 + 0.1 * i) for i in range(7)]
    points = [(0.5, 0.06), (0.5, 0.16), *turns, (0.5, 0.84), (0.5, 0.94)]
    return INK if min(distance(x, y, a, b) for a, b in zip(points, points[1:])) < 0.04 else None


def pixel(draw, column, row):
    colours = [draw((column + (i % FINE + 0.5) / FINE) / SIDE, (row + (i // FINE + 0.5) / FINE) / SIDE)
               for i in range(FINE * FINE)]
    seen = [colour for colour in colours if colour]
    mean = [round(sum(colour[i] for colour in seen) / len(seen)) for i in range(3)] if seen else [0, 0, 0]
    return bytes(mean + [round(255 * len(seen) / len(colours))])


def png(draw):
    rows = b"".join(b"\0" + b"".join(pixel(draw, column, row) for column in range(SIDE)) for row in range(SIDE))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 8, 6, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def main():
    for draw in (device, effect, grating, surface):
        with open(os.path.join(PACKAGE, "Editor", "Icons", draw.__name__ + ".png"), "wb") as file:
            file.write(png(draw))


if __name__ == "__main__":
    main()
