"""The catalogue of failures: study `failures`, one trace each. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import csv
import os
import textwrap

import matplotlib.pyplot as plt
import numpy as np

from style import ACCENT, ASKED, GREY, INK, METHODS, RULE, heading, open_input

COLUMNS = 3
COLOURS = {"velocity": "#4f6d8a", "wall": "#7c2f0d", "contact": "#3d6b4f"}
# Signals that are not held from tick to tick.
SMOOTH = {"s2_freezes", "s2_loses_step", "wall_runaway", "wall_delay", "contact_crowd", "contact_wedge"}


def read_traces(folder, table):
    """{id: {series: (t, value)}}"""
    traces = {}
    with open_input(os.path.join(folder, table), newline="") as stream:
        for row in csv.DictReader(stream):
            series = traces.setdefault(row["id"], {}).setdefault(row["series"], ([], []))
            series[0].append(float(row["t"]))
            series[1].append(float(row["value"]))
    return {name: {key: (np.array(t), np.array(v)) for key, (t, v) in one.items()} for name, one in traces.items()}


def draw_surface(ax, t, cycle):
    """The true surface of ridges, also between ticks."""
    fine = np.linspace(t[0], t[-1] + (t[1] - t[0]), 4001)[:-1]
    at = np.interp(fine, np.append(t, 2 * t[-1] - t[-2]), np.append(cycle, 2 * cycle[-1] - cycle[-2]))
    ax.plot(fine, np.where(at % 1 < 0.5, 1, -1), color=GREY, lw=0.7, ls=(0, (2, 2)), label="the surface")


def draw_held(ax, t, values, colour, name):
    step = t[1] - t[0]
    at, held = np.append(t, t[-1] + step), np.append(values, values[-1])
    ax.fill_between(at, 0, held, step="post", color=colour, alpha=0.2, lw=0)
    ax.step(at, held, where="post", color=colour, lw=1.2, label=name)


def draw_trace(ax, row, traces):
    colour = METHODS.get(row["group"].split(",")[0], COLOURS.get(row["group"], INK))
    others = iter([GREY, ASKED, ACCENT])
    for name, (t, values) in traces.items():
        if name == "cycle":
            draw_surface(ax, t, values)
        elif name == "height":
            draw_held(ax, t, values, colour, name)
            if row["id"].endswith("pushes"):
                ax.axhline(np.mean(values), color=INK, lw=1, ls=":", label="mean")
        elif len(traces) == 1:
            ax.plot(t, values, color=colour, lw=1.1, label=name)
        elif name == list(traces)[-1]:
            held = "default" if row["id"] in SMOOTH else "steps-post"
            ax.plot(t, values, color=INK if "height" in traces else colour, lw=1.1, drawstyle=held, label=name,
                    marker="o" if len(t) < 10 else None, ms=3.5)
        else:
            held = "default" if row["id"] in SMOOTH else "steps-post"
            ax.plot(t, values, color=next(others), lw=1, ls=(0, (3, 2)), drawstyle=held, label=name)
    ax.axhline(0, color=RULE, lw=0.7, zorder=0)
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.24 * (high - low))  # the legend's
    ax.legend(loc="upper right", fontsize=7.8, frameon=False, ncols=3, borderaxespad=0.1, handlelength=1.4,
              columnspacing=0.9)
    ax.set_xlabel(row["axis"], fontsize=8, labelpad=1)
    ax.tick_params(labelsize=7.5, length=2)


def draw_failures(data, folder):
    traces = read_traces(folder, data["table"])
    rows = data["failures"]
    lines = -(-len(rows) // COLUMNS)
    height = 2.3 * lines + 1.0
    figure = plt.figure(figsize=(10.5, height))
    heading(figure, "Where methods fail", "one trace each at 1 kHz; heights in A; dashed: the surface that is crossed; "
            "failures.md has the conditions that avoid them", 0.035)
    grid = figure.add_gridspec(lines, COLUMNS, left=0.045, right=0.985, top=1 - 1.3 / height, bottom=0.45 / height,
                               hspace=0.85, wspace=0.16)
    for i, row in enumerate(rows):
        ax = figure.add_subplot(grid[i // COLUMNS, i % COLUMNS])
        draw_trace(ax, row, traces[row["id"]])
        words = textwrap.fill(row["text"], 50)
        ax.set_title(f"{row['group']}: {row['name']}", fontsize=8.8, fontweight="bold", pad=8 + 10 * words.count("\n") + 8)
        ax.text(0, 1.03, words, transform=ax.transAxes, fontsize=8.2, color=GREY, va="bottom")
    return figure


FIGURES = {"failures": draw_failures}
