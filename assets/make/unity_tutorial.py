#!/usr/bin/env python3
"""Draws a frame that unity_tutorial.cs has written, by the rules of the stripes' shader, and the controls of inspectors.
usage: unity_tutorial.py FRAME FOLDER     SPDX-License-Identifier: MIT"""
import base64
import sys
from pathlib import Path

import numpy
from matplotlib import font_manager
from PIL import Image, ImageDraw, ImageFont

WIDTH, HEIGHT = 960, 540  # pixels
FIELD = numpy.radians(60)  # vertical field of view: Unity's default
SKY = numpy.array([0.09, 0.1, 0.13])  # the scene's
LIGHT = numpy.array([0.32, 0.77, -0.55])  # towards Unity's default light, turned by (50, -30, 0) degrees
AMBIENT = 0.45
PANEL, ROW, FIELD_INK, INK, HINT = "#383838", 24, "#2a2a2a", "#d2d2d2", "#505050"


def read(path):
    """The lines of a frame: kind and fields."""
    lines = [line.split("\t") for line in Path(path).read_text(encoding="utf-8").splitlines()]
    return [(line[0], line[1:]) for line in lines]


def matrix(fields):
    """Of an object to the world: 3 by 4."""
    return numpy.array([float(field) for field in fields[:12]]).reshape(3, 4)


def font(size):
    return ImageFont.truetype(font_manager.findfont("DejaVu Sans"), size)


class Frame:
    """An image with the nearest distance so far at each pixel."""

    def __init__(self, eye):
        x, y = numpy.meshgrid(numpy.arange(WIDTH + 1), numpy.arange(HEIGHT + 1))  # one more, for differences
        height = numpy.tan(FIELD / 2)
        right = (2 * (x + 0.5) / WIDTH - 1) * height * WIDTH / HEIGHT
        up = (1 - 2 * (y + 0.5) / HEIGHT) * height
        local = numpy.stack([right, up, numpy.ones_like(right)], -1)
        self.rays = local @ eye[:, :3].T
        self.eye = eye[:, 3]
        self.image = numpy.broadcast_to(SKY, (HEIGHT, WIDTH, 3)).copy()
        self.depth = numpy.full((HEIGHT, WIDTH), numpy.inf)

    def shade(self, normal):
        return AMBIENT + (1 - AMBIENT) * numpy.clip(normal @ LIGHT / numpy.linalg.norm(LIGHT), 0, 1)

    def cross(self, origin, a, b):
        """Where rays meet the plane of two vectors: coordinates along these, and the distance."""
        inverse = numpy.linalg.inv(numpy.stack([a, b, numpy.cross(a, b)], -1))
        start, step = inverse @ (self.eye - origin), self.rays @ inverse.T
        with numpy.errstate(divide="ignore", invalid="ignore"):
            t = -start[2] / step[..., 2]
            return start[0] + t * step[..., 0], start[1] + t * step[..., 1], numpy.where(t > 0, t, numpy.inf)

    def plate(self, place, color):
        a, b, centre = place[:, 0], place[:, 1], place[:, 3]
        u, v, t = (each[:-1, :-1] for each in self.cross(centre, a, b))
        hit = (abs(u) <= 0.5) & (abs(v) <= 0.5) & (t < self.depth)
        normal = -numpy.cross(a, b) / numpy.linalg.norm(numpy.cross(a, b))
        self.image[hit] = color * self.shade(abs(normal))
        self.depth[hit] = t[hit]

    def stripes(self, corners, ridge, groove):
        """A triangle, over what it lies on; as KnurlStripes.hlsl does."""
        places, cycles = corners[:, :3], corners[:, 3:]
        s, t, far = self.cross(places[0], places[1] - places[0], places[2] - places[0])
        phase = (1 - s - t)[..., None] * cycles[0] + s[..., None] * cycles[1] + t[..., None] * cycles[2]
        width = abs(phase[:-1, 1:] - phase[:-1, :-1]) + abs(phase[1:, :-1] - phase[:-1, :-1])
        height = wave(phase[:-1, :-1], numpy.maximum(width, 0.001)).prod(-1)
        s, t, far = s[:-1, :-1], t[:-1, :-1], far[:-1, :-1]
        hit = (s >= 0) & (t >= 0) & (s + t <= 1) & (far < self.depth * 1.0001)
        mixed = groove + (0.5 + 0.5 * height[hit])[:, None] * (ridge - groove)
        self.image[hit] += mixed[:, 3:] * (mixed[:, :3] - self.image[hit])

    def ball(self, place, color):
        centre, radius = place[:, 3], numpy.linalg.norm(place[:, 0]) / 2
        rays = self.rays[:-1, :-1]
        a, b = (rays * rays).sum(-1), rays @ (self.eye - centre)
        inside = b * b - a * ((self.eye - centre) @ (self.eye - centre) - radius * radius)
        t = (-b - numpy.sqrt(numpy.maximum(inside, 0))) / a
        hit = (inside > 0) & (t < self.depth)
        normal = (self.eye + t[hit][:, None] * rays[hit] - centre) / radius
        self.image[hit] = color * self.shade(normal)[:, None]
        self.depth[hit] = t[hit]


def wave(cycles, width):
    """KnurlWave of the shader: a square wave, averaged over a pixel."""
    def integral(x):
        return 0.5 - abs(x % 1 - 0.5)
    phase = cycles % 1 + 0.25
    return (integral(phase + width / 2) - integral(phase - width / 2)) / width


def draw_scene(lines):
    frame = Frame(matrix(next(fields for kind, fields in lines if kind == "eye")))
    for kind, fields in lines:
        if kind == "plate":
            frame.plate(matrix(fields), numpy.array(fields[12:], float))
    corners, colors = [], None
    for kind, fields in lines:
        if kind == "stripes":
            colors = numpy.array(fields, float).reshape(2, 4)
        elif kind == "corner":
            corners.append(numpy.array(fields, float))
            if len(corners) == 3:
                frame.stripes(numpy.array(corners), *colors)
                corners = []
    for kind, fields in lines:
        if kind == "ball":
            frame.ball(matrix(fields), numpy.array(fields[12:], float))
    image = Image.fromarray((255 * numpy.clip(frame.image, 0, 1)).round().astype(numpy.uint8))
    draw_gui(image, lines)
    return image


def draw_gui(image, lines):
    pen = ImageDraw.Draw(image)
    for kind, fields in lines:
        if kind not in ("label", "texture"):
            continue
        x, y, width, height = (int(float(field)) for field in fields[:4])
        y += HEIGHT if y < 0 else 0
        if kind == "label":
            pen.text((x + 3, y + 3), fields[4], fill="white", font=font(12))
            continue
        pixels = numpy.frombuffer(base64.b64decode(fields[4]), numpy.uint8).reshape(height, width, 4)[::-1]  # its rows go up
        picture = Image.fromarray(pixels, "RGBA")
        image.paste(picture, (x, y), picture)


def draw_inspector(title, rows):
    """One row for each control, in the order in which the inspector's code asks for them."""
    width, side = 440, 14
    image = Image.new("RGB", (width, 44 + ROW * 30), PANEL)
    pen = ImageDraw.Draw(image)
    pen.text((side, 12), title, fill="white", font=font(15))
    y = 42
    for control, value in rows:
        kind, _, rest = control.partition(" ")
        if kind == "property":
            field, _, label = rest.partition(" as ")
            pen.text((side, y + 4), label or field, fill=INK, font=font(12))
            pen.rectangle((width // 2 - 20, y + 2, width - side, y + ROW - 3), fill=FIELD_INK)
            pen.text((width // 2 - 14, y + 4), value, fill=INK, font=font(12))
        elif kind in ("Info:", "Warning:", "Error:"):
            y = draw_help(pen, (side, y, width - side), rest)
            continue
        elif kind in ("drop-down", "button"):
            pen.rectangle((side, y + 1, width - side, y + ROW - 3), fill=HINT)
            pen.text((side + 8, y + 4), rest + ("  \u25be" if kind == "drop-down" else ""), fill=INK, font=font(12))
        else:
            pen.text((side, y + 4), ("\u25b8 " if kind == "field" else "") + rest.partition(" = ")[0], fill=INK, font=font(12))
        y += ROW
    return image.crop((0, 0, width, y + 10))


def draw_help(pen, box, text):
    left, y, right = box
    lines, line = [], ""
    for word in text.split():
        if pen.textlength(line + " " + word, font=font(11)) > right - left - 20:
            lines.append(line)
            line = ""
        line = (line + " " + word).strip()
    lines.append(line)
    pen.rectangle((left, y + 3, right, y + 13 + 16 * len(lines)), fill=HINT)
    for i, each in enumerate(lines):
        pen.text((left + 10, y + 8 + 16 * i), each, fill=INK, font=font(11))
    return y + 20 + 16 * len(lines)


def draw_inspectors(lines):
    """Side by side."""
    pages = []
    for kind, fields in lines:
        if kind == "inspector":
            pages.append((fields[0], []))
        elif kind == "row":
            pages[-1][1].append((fields[0], fields[1]))
    images = [draw_inspector(title, rows) for title, rows in pages]
    both = Image.new("RGB", (sum(each.width for each in images) + 12, max(each.height for each in images)), "#191919")
    x = 0
    for each in images:
        both.paste(each, (x, 0))
        x += each.width + 12
    return both


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    lines, folder = read(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    draw_scene(lines).save(folder / "three_plates.png", optimize=True)
    draw_inspectors(lines).save(folder / "inspectors.png", optimize=True)


if __name__ == "__main__":
    main()
