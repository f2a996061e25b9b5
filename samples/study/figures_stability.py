"""The maps of the stability laboratory: study `stability`. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator

from style import GREY, INK, heading, read_table

OUTCOMES = {"rest": "#eef2f3", "vibration": "#8cc3cb", "limit cycle": "#f0b44c", "unstable": "#b3262e"}
ABOUT = {"rest": "rest: nothing felt", "vibration": "vibration, as the texture asks", "limit cycle":
         "limit cycle: felt beyond that", "unstable": "unstable: a runaway"}
COLOURS = ListedColormap(list(OUTCOMES.values()))
NORM = BoundaryNorm(np.arange(5) - 0.5, 4)
# The presets' numbers for drawing bounds: b, fc, Delta, delay in ticks, the maker's stiffness.
DEVICES = {"Touch": (0.5, 0.26, 55e-6, 1, 1020), "Falcon": (1.5, 0.5, 60e-6, 2, 3000)}
AXES = {"damping": "device's damping b (N s/m)", "wall damping": "wall's damping B (N s/m)", "delay": "delay (ticks)",
        "rate": "update rate (Hz)"}
ALONE, HELD, QUANTUM = (0, (4, 2)), "-", (0, (1, 1.5))


def edges(values, logarithmic):
    if logarithmic:
        return np.exp(edges(np.log(values), False))
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def draw_map(ax, table, pick, scale=1.0):
    """The outcomes of one map as cells, with the study's spacing of both axes."""
    x, y = np.unique(table["x"][pick]), np.unique(table["y"][pick])
    code = np.array([list(OUTCOMES).index(o) for o in table["outcome"][pick]]).reshape(len(y), len(x))
    linear = np.allclose(np.diff(x), x[1] - x[0])
    ax.pcolormesh(edges(x, not linear), scale * edges(y, True), code, cmap=COLOURS, norm=NORM, rasterized=True)
    ax.set_xscale("linear" if linear else "log")
    ax.set_yscale("log")
    ax.set(xlim=edges(x, not linear)[[0, -1]], ylim=scale * edges(y, True)[[0, -1]])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_minor_locator(NullLocator())
    ax.tick_params(length=2)
    return x, y


def ticks(ax, which, values):
    low, high = ax.get_xlim() if which == "x" else ax.get_ylim()
    shown = [v for v in values if low <= v <= high]
    labels = [f"{v:g}" for v in shown]
    (ax.set_xticks if which == "x" else ax.set_yticks)(shown, labels)


def legend(figure, table, lines, left):
    patches = [Patch(facecolor=colour, edgecolor=GREY, lw=0.4, label=ABOUT[name]) for name, colour in OUTCOMES.items()
               if name in table["outcome"]]
    figure.legend(handles=patches, loc="lower left", bbox_to_anchor=(left, 0.0), ncol=2, frameon=False, fontsize=9,
                  labelcolor=INK, columnspacing=1.6)
    if lines:
        figure.legend(handles=lines, loc="lower right", bbox_to_anchor=(0.985, 0.0), ncol=2, frameon=False, fontsize=9,
                      labelcolor=INK, columnspacing=1.6)


def draw_bounds(ax, name, x, hand, friction):
    b, fc, quantum, delay, _ = DEVICES["Touch"]
    period, wall = 1e-3, 0.0
    x = np.linspace(x[0], x[-1], 400)
    if name == "damping":
        b = x
    elif name == "wall damping":
        wall = x
    elif name == "delay":
        delay = x
    else:
        period = 1 / x
    for damping, style in ((b, ALONE), (b + hand, HELD)):
        ax.plot(x, (damping + wall) / (period * (0.5 + delay)) * np.ones_like(x), color=INK, lw=1.3, ls=style)
    if friction:
        ax.plot(x, 2 * fc / quantum * np.ones_like(x), color=INK, lw=1.3, ls=QUANTUM)


def draw_stability(data, folder):
    table = read_table(folder, data["table"])
    rows = list(dict.fromkeys(zip(table["label"], table["protections"])))
    figure, grid = plt.subplots(len(rows), len(AXES), figsize=(12, 2.6 * len(rows) + 1.7), sharey=True)
    hand = data["grips"][table["grip"][0]][1]
    heading(figure, "How stiff a flat wall may be", "Stiffness that a simulated Touch is pressed into with 1 N, "
            "held loosely; each cell is judged by its signals after 2.5 s", 0.07)
    for i, (row, (label, protections)) in enumerate(zip(grid, rows)):
        for ax, name in zip(row, AXES):
            x, _ = draw_map(ax, table, (table["label"] == label) & (table["protections"] == protections)
                            & (table["map"] == name))
            draw_bounds(ax, name, x, hand, "without" not in label)
            ticks(ax, "y", [100, 200, 500, 1000, 2000, 5000, 10000])
            ticks(ax, "x", {"delay": [0, 2, 4, 6, 8, 10], "rate": [250, 1000, 4000, 10000]}.get(
                name, [0.1, 0.3, 1, 3, 10]))
            if i == len(rows) - 1:
                ax.set_xlabel(AXES[name])
        row[0].set_ylabel("stiffness K (N/m)")
        row[0].set_title(f"{label}, {protections}", fontweight="bold", color=INK)
    lines = [Line2D([], [], color=INK, lw=1.3, ls=ALONE, label="(b + B)/(T/2 + td): the device alone"),
             Line2D([], [], color=INK, lw=1.3, ls=HELD, label=f"with the hand's {hand:g} N s/m"),
             Line2D([], [], color=INK, lw=1.3, ls=QUANTUM, label="2 fc/\N{GREEK CAPITAL LETTER DELTA}: dry friction holds "
                    "what a quantum shakes")]
    legend(figure, table, lines, 0.06)
    height = figure.get_figheight()
    figure.subplots_adjust(left=0.07, right=0.985, top=1 - 1.05 / height, bottom=1.12 / height, hspace=0.28, wspace=0.07)
    return figure


def cells(table, label, grip, method, protections):
    return ((table["label"] == label) & (table["grip"] == grip) & (table["method"] == method)
            & (table["protections"] == protections))


def draw_stopped(ax, table, raw, protected, scale):
    """Marks the runaways of a raw map that the protections stop; returns how many these are, and how many there are."""
    before, after = table["outcome"][raw], table["outcome"][protected]
    x, y = table["x"][raw], scale * table["y"][raw]
    stopped = (before == "unstable") & (after != "unstable")
    ax.plot(x[stopped], y[stopped], "o", color="white", ms=4.5, mew=0, clip_on=False)
    return np.array([np.count_nonzero(stopped), np.count_nonzero(before == "unstable")])


def draw_methods(data, folder, amplitudes):
    """Only devices and grips with a runaway; the others are calm. Returns the figure, its left margin, and a sentence
    about the protections."""
    table = read_table(folder, data["table"])
    methods = list(dict.fromkeys(table["method"]))
    every = list(dict.fromkeys(zip(table["label"], table["grip"])))
    rows = [(label, grip) for label, grip in every
            if np.any(table["outcome"][(table["label"] == label) & (table["grip"] == grip)] == "unstable")]
    scale = 1e3 if amplitudes else 1.0
    stopped = np.zeros(2, int)
    figure, grid = plt.subplots(len(rows), len(methods), figsize=(10.5, 2.0 * len(rows) + 2.6), sharex=True, squeeze=False)
    for i, (row, (label, grip)) in enumerate(zip(grid, rows)):
        b, fc, _, delay, promised = DEVICES[label]
        for j, (ax, method) in enumerate(zip(row, methods)):
            raw = cells(table, label, grip, method, "raw")
            x, _ = draw_map(ax, table, raw, scale)
            stopped += draw_stopped(ax, table, raw, cells(table, label, grip, method, "protected"), scale)
            if not amplitudes:
                ax.axhline(promised, color=INK, lw=1, ls=QUANTUM)
                fine = np.geomspace(x[0], x[-1], 200)
                low, high = ax.get_ylim()
                ax.plot(fine, (b + fc / fine + data["grips"][grip][1]) / (1e-3 * (0.5 + delay)), color=INK, lw=1.1)
                ax.set_ylim(low, high)
            ticks(ax, "x", [0.01, 0.03, 0.1, 0.25])
            ticks(ax, "y", [0.02, 0.1, 0.5, 2] if amplitudes else [100, 300, 1000, 3000])
            ax.tick_params(labelsize=8.5, labelleft=j == 0)
            if i == 0:
                ax.set_title(method if method != "flat" else "flat wall", fontsize=10.5, fontweight="bold", color=INK)
            if i == len(rows) - 1:
                ax.set_xticklabels(["10", "30", "100", "250"])
        row[0].set_ylabel(f"{label}, {grip} grip\n{'A (mm)' if amplitudes else 'K (N/m)'}", fontsize=9.5)
    height = figure.get_figheight()
    left = 0.95 / figure.get_figwidth()
    figure.subplots_adjust(left=left, right=0.985, top=1 - 1.2 / height, bottom=1.4 / height, hspace=0.12, wspace=0.08)
    figure.text((left + 0.985) / 2, 0.98 / height, "speed along the surface (mm/s)", ha="center", color=INK)
    calm = [f"{label} {grip}" for label, grip in every if (label, grip) not in rows]
    figure.text(left, 0.72 / height, f"no runaway at all: {', '.join(calm)}", color=GREY, fontsize=9)
    lines = [Line2D([], [], marker="o", ls="", color="white", mec=OUTCOMES["unstable"], mew=2.5, ms=7,
                    label="a runaway that the protections stop")] if stopped[0] else []
    lines += [] if amplitudes else [
        Line2D([], [], color=INK, lw=1.1, label="(b + fc/v + hand's)/(T/2 + td)"),
        Line2D([], [], color=INK, lw=1, ls=QUANTUM, label="what its maker promises")]
    legend(figure, table, lines, 0.04)
    return figure, left, (f"without protections, which stop {stopped[0] or 'none'} of the {stopped[1]} runaways" +
                          (" (dots)" if stopped[0] else ""))


def draw_stiffnesses(data, folder):
    figure, left, told = draw_methods(data, folder, False)
    heading(figure, "Stiffness against speed, by method",
            f"Gratings of 2 mm and A = 0.2 mm, 1 N at 1 kHz, after 2.25 s; {told}", left)
    return figure


def draw_amplitudes(data, folder):
    figure, left, told = draw_methods(data, folder, True)
    heading(figure, "Amplitude against speed, by method",
            f"Gratings of 2 mm at half the maker's stiffness, up to all of the motors' force; {told}", left)
    return figure


def draw_effects(data, folder):
    """Each effect and device a row, each hand a column."""
    table = read_table(folder, data["table"])
    grips = list(dict.fromkeys(table["grip"]))
    rows = list(dict.fromkeys(zip(table["method"], table["label"])))
    figure, grid = plt.subplots(len(rows), len(grips), figsize=(10.5, 2.0 * len(rows) + 2.4), sharex=True, sharey=True)
    for i, (row, (effect, label)) in enumerate(zip(grid, rows)):
        b, _, _, delay, _ = DEVICES[label]
        for j, (ax, grip) in enumerate(zip(row, grips)):
            raw = cells(table, label, grip, effect, "raw")
            draw_map(ax, table, raw)
            draw_stopped(ax, table, raw, cells(table, label, grip, effect, "protected"), 1.0)
            ax.axhline(0.8 * (b + 0.5) / (1e-3 * (0.5 + delay)), color=INK, lw=1.2)
            ticks(ax, "x", [0.1, 1, 10])
            ticks(ax, "y", [100, 300, 1000, 3000, 10000])
            ax.tick_params(labelsize=8.5)
            if i == 0:
                ax.set_title(f"{grip} hand", fontsize=10.5, fontweight="bold", color=INK)
        row[0].set_ylabel(f"{label}, {effect}\nK (N/m)", fontsize=9.5)
    height = figure.get_figheight()
    left = 0.95 / figure.get_figwidth()
    figure.subplots_adjust(left=left, right=0.985, top=1 - 1.2 / height, bottom=1.2 / height, hspace=0.12, wspace=0.06)
    figure.text((left + 0.985) / 2, 0.78 / height, "damping B (N s/m), of the velocity that is estimated from the encoders",
                ha="center", color=INK)
    heading(figure, "How stiff springs and notches may be", "Raw, at 1 kHz, judged after 2.25 s; notches are 10 mm apart",
            left)
    legend(figure, table, [
        Line2D([], [], marker="o", ls="", color="white", mec=OUTCOMES["unstable"], mew=2.5, ms=7,
               label="a runaway that the limit stops"),
        Line2D([], [], color=INK, lw=1.2, label="the limit: 0.8 (b + 0.5)/(T/2 + td)")], 0.04)
    return figure


FIGURES = {"stability_effects": draw_effects, "stability": draw_stability, "stability_methods": draw_stiffnesses, "stability_amplitudes": draw_amplitudes}
