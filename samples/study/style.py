"""Shared by the pictures: palette, typeface, saving.

SPDX-License-Identifier: MIT
"""
import csv
import os
import secrets
import signal
import stat
import sys

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patheffects import withStroke

INK, GREY, RULE, PALE, ACCENT, SOFT, ASKED = "#1c2b33", "#77858c", "#c3ccd0", "#e9eef0", "#0f6e84", "#8cc3cb", "#d9662b"
# One colour per method in every figure; S1 and S2 have colours like T1 and T3.
METHODS = {"T1": "#b9962f", "T2": "#8a7fb5", "T3": "#4f8a5b", "S1": ASKED, "S2": ACCENT, "bandlimited": "#a03c78"}
SHADES = LinearSegmentedColormap.from_list("shades", ["#f6fafa", "#b9dde0", "#5fb0bb", "#0f6e84", "#093a4a"])
HALO = [withStroke(linewidth=3, foreground="white")]  # of a label on top of lines
STYLE = {"font.family": "DejaVu Sans", "font.size": 9.5, "text.color": INK, "axes.labelcolor": INK,
         "axes.edgecolor": RULE, "axes.spines.top": False, "axes.spines.right": False, "xtick.color": GREY,
         "ytick.color": GREY, "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "axes.labelsize": 9.5,
         "axes.titlesize": 9.5, "axes.titlelocation": "left", "axes.formatter.useoffset": False, "figure.dpi": 160,
         "path.simplify": False}


class BadInput(Exception):
    """One line for the user: file, expected and found value. Paths and cells in it cannot send escapes to a
    terminal."""

    def __str__(self):
        return "".join(character if character.isprintable() else "?" for character in super().__str__())


INPUTS = []  # the files that were read: (device, inode)


def open_input(path, **how):
    """open() for reading; save() does not replace a file that was read, under any name."""
    file = open(path, encoding="utf-8", **how)
    found = os.fstat(file.fileno())
    INPUTS.append((found.st_dev, found.st_ino))
    return file


def say(ax, text, x=0.5, y=0.5, ha="center", va="center", size=8.5, color=GREY, dx=0, dy=0, within="axes fraction",
        halo=False):
    ax.annotate(text, (x, y), xycoords=within, xytext=(dx, dy), textcoords="offset points", ha=ha, va=va, fontsize=size,
                color=color, path_effects=HALO if halo else None)


def read_table(folder, name):
    """FOLDER/NAME as {column: array}: of floats if every cell is one (an empty cell is NaN), otherwise of text."""
    path = os.path.join(folder, name)
    try:
        with open_input(path, newline="") as file:
            header, *rows = csv.reader(file)
    except (OSError, UnicodeDecodeError, csv.Error, ValueError) as error:
        raise BadInput(f"{path}: expected a CSV file, found: {getattr(error, 'strerror', None) or error}") from None
    if any(len(row) != len(header) for row in rows):
        raise BadInput(f"{path}: expected {len(header)} cells in every row")
    return {column: numbers(cells) for column, cells in zip(header, zip(*rows))}


def numbers(cells):
    try:
        return np.array([float(cell or "nan") for cell in cells])
    except ValueError:
        return np.array(cells, object)


def heading(figure, title, words, left=0.065):
    """The title, and below it a grey subtitle."""
    height = figure.get_figheight()
    figure.text(left, 1 - 0.30 / height, title, fontsize=16, fontweight="bold", va="center")
    figure.text(left, 1 - 0.57 / height, words, color=GREY, va="center")


def write_png(figure, file):
    figure.savefig(file, format="png", metadata={"Software": None})


def save(figure, out):
    """Writes under an unpredictable name in the same folder and renames, so that `out` is never half a picture. Writes
    directly if `out` is not a regular file (a FIFO), or /dev/stdout, a link that leads nowhere if that is closed."""
    try:
        found = os.stat(out) if os.path.exists(out) else None
        if found and (found.st_dev, found.st_ino) in INPUTS:
            raise BadInput(f"{out}: expected an output of its own, found a file that is read: it would be replaced")
        if out.startswith(("/dev/", "/proc/")) or (found and not stat.S_ISREG(found.st_mode)):
            with open(out, "wb") as file:
                write_png(figure, file)
        else:
            replace(figure, out)
    except OSError as error:
        raise BadInput(f"{out}: expected a place to write a PNG to, found: {error.strerror or error}") from None


def replace(figure, out):
    folder, name = os.path.split(out)
    part = os.path.join(folder, f"{name[:200]}.{secrets.token_hex(8)}.part")
    handler = signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))  # so that `finally` is run
    handle = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o666)
    try:
        with open(handle, "wb") as file:
            write_png(figure, file)
        os.replace(part, out)
    finally:
        if os.path.exists(part):
            os.remove(part)
        signal.signal(signal.SIGTERM, handler)
