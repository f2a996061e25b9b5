"""The chart behind the choice of the velocity estimator: study `velocity`. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from style import ACCENT, ASKED, GREY, INK, RULE, heading, read_table, say

COLUMNS = [(0.055, 1000), (0.055, 10000)]  # a Touch; the CSV also has 0.01 mm and 2, 5 kHz
# estimator: colour, width, dashes, above the others
LINES = {"difference": (GREY, 1.2, (0, (1, 1.2)), 2), "low pass, 20 Hz": ("#b9962f", 1.4, "-", 3),
         "FOAW as published": (ASKED, 1.4, (0, (4, 1.5)), 4), "FOAW": (ACCENT, 2.2, "-", 5)}
BAND = ("low pass, 40 Hz", "low pass, 10 Hz")
# column: of 1, label, lowest, highest drawn
ROWS = [("period_mean", 100, "period that is played:\nmean error (%)", 0.2, 500), ("delay_ms", 1, "delay (ms)", 0.04, 60)]


def values(table, name, column, key, scale, low):
    rows = ((table["estimator"] == name) & np.isclose(table["resolution_mm"], column[0])
            & np.isclose(table["rate_hz"], column[1]))
    return table["speed_mm_s"][rows], np.maximum(np.abs(table[key][rows]) * scale, low)


def draw_cell(ax, table, column, row):
    key, scale, _, low, high = row
    xs, above = values(table, BAND[0], column, key, scale, low)
    _, below = values(table, BAND[1], column, key, scale, low)
    ax.fill_between(xs, above, below, color=LINES["low pass, 20 Hz"][0], alpha=0.16, lw=0)
    for name, (colour, width, dashes, order) in LINES.items():
        xs, ys = values(table, name, column, key, scale, low)
        ax.plot(xs, ys, color=colour, lw=width, ls=dashes, zorder=order, marker="o", ms=2.6, clip_on=False)
    ax.set(xscale="log", yscale="log", xlim=(0.9, 560), ylim=(low, high))
    ax.xaxis.set_major_locator(FixedLocator([1, 2, 5, 10, 20, 50, 100, 200, 500]))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_minor_locator(NullLocator())
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.grid(True, color="#eef1f2", lw=0.8, zorder=0)
    if key == "period_mean":
        ax.axhline(38, color=RULE, lw=1, zorder=1)


def draw_velocity(data, folder):
    table = read_table(folder, data["table"])
    figure, grid = plt.subplots(len(ROWS), len(COLUMNS), figsize=(10, 7.2), sharex=True, sharey="row")
    for axes, row in zip(grid, ROWS):
        for ax, column in zip(axes, COLUMNS):
            draw_cell(ax, table, column, row)
        axes[0].set_ylabel(row[2], color=INK)
    for ax, (resolution, rate) in zip(grid[0], COLUMNS):
        ax.set_title(f"{resolution:g} mm counts, {rate / 1000:g} kHz", color=INK)
    for ax in grid[-1]:
        ax.set_xlabel("speed (mm/s)", color=INK)
    say(grid[0][0], "a hand notices 38 %", 0.99, 38, "right", "bottom", 8.5, GREY, within=("axes fraction", "data"))
    heading(figure, "What a velocity estimator gets wrong, and how late it is",
            f"S2 on {1e3 * data['period_m']:g} mm ridges, a hand whose speed wobbles by {100 * data['wobble']:g} %; delay: in strokes to and "
            f"fro at {data['stroke_hz']:g} Hz", 0.085)
    cost = {name: min(ns) for name, ns in data["cost_ns"].items()}
    handles = [Line2D([], [], color=colour, lw=width, ls=dashes, label=name if name not in cost else
                      f"{name}: {cost[name]:.0f} ns a tick") for name, (colour, width, dashes, _) in LINES.items()]
    handles.insert(2, Line2D([], [], color=LINES["low pass, 20 Hz"][0], lw=8, alpha=0.16,
                             label="low pass, 10 to 40 Hz"))
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.06, 0.02), ncol=5, frameon=False, fontsize=8.5,
                  labelcolor=INK, handletextpad=0.5, columnspacing=1.1)
    figure.text(0.067, 0.01, f"errors below the lowest line of a chart are drawn on it · {data['machine']}, shared",
                color=GREY, fontsize=8.5)
    figure.subplots_adjust(left=0.085, right=0.985, top=0.86, bottom=0.15, hspace=0.14, wspace=0.07)
    return figure


FIGURES = {"velocity": draw_velocity}
