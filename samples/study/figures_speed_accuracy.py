"""Which method, at which rate, what does it cost, why does it fail: one panel of study `tradeoff`. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from style import HALO, INK, METHODS, read_table

# What is wrong, where in the table, the size at which a hand notices it (README.md beside this file has the sources),
# and what it is called at a line. Each is that of the worst of 40 speeds.
ERRORS = {"push_worst": (0.10, "pushes"), "frequency_worst": (0.18, "off frequency"),
          "folded_worst": (0.04, "false tones"), "unevenness_worst": (0.20, "wavers"), "strokes": (0.05, "loses step")}
ABOUT = {"S1": "the surface at a point", "S2": "events, by the speed", "locked": "events, in step",
         "area": "mean of what was passed"}
PLACES = {"S1": (-8, -30), "S2": (26, 16), "locked": (26, 28)}  # of names, in points from the line
LOW, HIGH = 0.25, 40


def errors(table, row):
    """[(error in sizes at which a hand notices it, its name)], the largest first."""
    return sorted(((table[key][row] / size, name) for key, (size, name) in ERRORS.items()), reverse=True)


def lines(table):
    """{(method, velocity): [(millions of instructions a second, errors, kHz)]} of what real encoders give."""
    found = {}
    for row, method in enumerate(table["method"]):
        if table["positions"][row] == "0.055mm" and table["velocity"][row] != "ideal":
            x = table["instructions_tick"][row] * table["rate_hz"][row] / 1e6
            found.setdefault((method, table["velocity"][row]), []).append(
                (x, errors(table, row), table["rate_hz"][row] / 1e3))
    return found


def draw_line(ax, method, points, colour):
    xs, found, rates = zip(*points)
    ys = [first[0] for first, *_ in found]
    ax.plot(xs, ys, color=colour, lw=2.6, zorder=4, solid_capstyle="round")
    ax.plot(xs, ys, "o", color=colour, ms=7, zorder=5)
    for x, y, rate in zip(xs, ys, rates):
        right = method == "S1" and rate > 2  # there other methods' lines are below
        under = (method, rate) in (("S1", 1), ("S1", 2), ("area", 5))
        ax.annotate(f"{rate:g}" + (" kHz" if rate in (1, 10) else ""), (x, y),
                    xytext=(9, 4) if right else (0, -16 if under else 8), textcoords="offset points",
                    ha="left" if right else "center", fontsize=9.5, color=colour, zorder=6, path_effects=None if method == "area" else HALO)
    noticed = [f"{name} {size:.2g}×" for size, name in found[0] if size >= 0.995]
    place = PLACES.get(method, (26, 6))
    at = (xs[0], ys[0]) if method == "S1" else (xs[-1], ys[-1])
    for text, style, below in ((method, {"fontsize": 14, "fontweight": "bold"}, 0),
                               ("\n".join(noticed), {"fontsize": 10.5, "linespacing": 1.1}, 11)):
        ax.annotate(text, at, xytext=(place[0], place[1] - below), textcoords="offset points", color=colour, zorder=6,
                    va="top" if below else "center", path_effects=None if method == "area" else HALO, **style)


def draw_shape(ax, heights, colour):
    ticks = range(len(heights) + 1)
    ax.fill_between(ticks, 0, [*heights, heights[-1]], step="post", color=colour, alpha=0.25, lw=0)
    ax.step(ticks, [*heights, heights[-1]], where="post", color=colour, lw=1.6)
    ax.axhline(0, color=INK, lw=0.6, alpha=0.5)
    ax.set(ylim=(-1.9, 1.7), xlim=(0, len(heights)), xticks=[], yticks=[])
    for side in ("left", "bottom"):
        ax.spines[side].set_visible(False)


def draw_speed_accuracy(data, folder):
    table = read_table(folder, data["table"])
    figure = plt.figure(figsize=(11, 6.4))
    ax = figure.add_axes((0.075, 0.105, 0.645, 0.715))
    found = lines(table)
    ax.axhspan(LOW, 1, color="#3fa66b", alpha=0.16, lw=0, zorder=0)
    ax.text(0.985, 0.03, "not noticed", transform=ax.transAxes, ha="right", fontsize=13, color="#3fa66b")
    for (method, velocity), points in found.items():
        colour = METHODS[method]
        if velocity in ("none", "foaw"):
            draw_line(ax, method, points, colour)
        else:
            dashes = (0, (4, 2)) if velocity == "lowpass" else (0, (1, 1.5))
            ax.plot([x for x, *_ in points], [sizes[0][0] for _, sizes, _ in points], color=colour, lw=1, alpha=0.4,
                    ls=dashes, zorder=2)
    ax.set(xscale="log", yscale="log", ylim=(LOW, HIGH), xlim=(0.16, 18))
    for axis, marks in ((ax.xaxis, (0.2, 0.5, 1, 2, 5, 10)), (ax.yaxis, (0.3, 1, 3, 10, 30))):
        axis.set_major_locator(FixedLocator(marks))
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.tick_params(labelsize=11)
    ax.set_xlabel("millions of instructions for a second of rendering", fontsize=12)
    ax.set_ylabel("its worst error ÷ the least that a hand notices", fontsize=12)
    figure.text(0.02, 0.945, "Which method, at which rate, for what cost, and how it fails", fontsize=17,
                fontweight="bold", va="center")
    figure.text(0.02, 0.882, "ridges of 1 mm through an encoder of 0.055 mm, the worst of 20 to 480 Hz and of "
                "strokes from rest;\nbelow a name: its errors at 1 kHz that a hand notices · faint: the speed by "
                "a low pass (dashed) or by differences (dotted)", fontsize=10.5, color=INK, alpha=0.75, va="center")
    shapes = data["shapes"]
    figure.text(0.755, 0.815, f"20 ms at {shapes['hz']:g} Hz and 1 kHz", fontsize=11, color=INK, alpha=0.75)
    for place, method in enumerate(name for name in ABOUT if name in shapes):
        small = figure.add_axes((0.755, 0.645 - 0.186 * place, 0.23, 0.125))
        colour = METHODS[method]
        draw_shape(small, shapes[method], colour)
        small.set_title(f"{method}: {ABOUT[method]}", fontsize=10.5, color=colour, pad=2)
    return figure


FIGURES = {"speed_accuracy": draw_speed_accuracy}
