"""Events that are interrupted by a change: study `transitions`. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import csv
import os

import matplotlib.pyplot as plt
import numpy as np

from style import INK, METHODS, RULE, heading, open_input


def draw_transitions(data, folder):
    series = {}
    with open_input(os.path.join(folder, data["table"]), newline="") as stream:
        for row in csv.DictReader(stream):
            ticks, heights = series.setdefault((row["transition"], row["method"]), ([], []))
            ticks.append(int(row["tick"]))
            heights.append(float(row["height"]))
    names = list(dict.fromkeys(name for name, _ in series))
    methods = list(dict.fromkeys(method for _, method in series))
    figure, grid = plt.subplots(len(names), len(methods), figsize=(11, 1.55 * len(names) + 1.3), sharex=True, sharey=True)
    heading(figure, "What becomes of an event", "height over time at 1 kHz and 200 Hz, until something happens at 0")
    for line, name in zip(grid, names):
        for ax, method in zip(line, methods):
            ticks, heights = series[name, method]
            at = np.array(ticks + [ticks[-1] + 1])
            held = np.array(heights + heights[-1:])
            ax.fill_between(at, 0, held, step="post", color=METHODS[method], alpha=0.2, lw=0)
            ax.step(at, held, where="post", color=METHODS[method], lw=1.2)
            ax.axhline(0, color=RULE, lw=0.7, zorder=0)
            ax.axvline(0, color=INK, lw=0.9, ls=":")
            ax.set_title(f"{method}: {name}", fontsize=9, pad=3)
            ax.tick_params(length=2)
    for ax in grid[-1]:
        ax.set_xlabel("ms after it happens")
    for line in grid:
        line[0].set_ylabel("height (A)")
    figure.subplots_adjust(left=0.07, right=0.985, top=1 - 1.05 / figure.get_figheight(), bottom=0.6 / figure.get_figheight(), hspace=0.45,
                           wspace=0.08)
    return figure


FIGURES = {"transitions": draw_transitions}
