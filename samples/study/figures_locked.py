"""The method locked beside S1 and S2, and the chart that its crossover is chosen by: study `locked`. Drawn by
figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

from style import ACCENT, GREY, INK, METHODS, PALE, RULE, heading, read_table, say

ORDER = ("S1", "S2", "locked")
POSITIONS = {0.0: "ideal", 0.055: "0.055 mm", 0.01: "0.01 mm"}
LINES = {0.0: (GREY, "-"), 0.055: (METHODS["locked"], "-"), 0.01: (METHODS["locked"], (0, (4, 2)))}


def draw_speeds(ax, table, column, scale, title):
    for name in ORDER:
        rows = (table["part"] == "speed") & (table["method"] == name)
        ax.plot(table["frequency_hz"][rows], scale(table[column][rows]), color=METHODS[name], lw=1.3)
    ax.set(xlim=(20, 480), xlabel="temporal frequency (Hz)")
    ax.set_title(title)
    ax.grid(True, color=PALE, lw=0.8, zorder=0)


def draw_strokes(ax, table):
    """The worst of one way and to and fro, on 1 mm."""
    place = 0
    for name in ORDER:
        for quantum, words in POSITIONS.items():
            rows = ((table["part"] == "stroke") & (table["method"] == name)
                    & np.isclose(table["quantum_mm"], quantum) & np.isclose(table["period_mm"], 1))
            error = table["phase_error_cycles"][rows].max()
            ax.barh(place, max(error, 0.011) - 0.01, left=0.01, color=METHODS[name], height=0.7)
            say(ax, f"{error:.2f}" if error < 10 else f"{error:.0f}", max(error, 0.011), place, "left", "center", 8.5, INK,
                4, 0, "data")
            ax.text(-0.02, place, words, transform=ax.get_yaxis_transform(), ha="right", va="center", fontsize=8.5,
                    color=METHODS[name])
            place += 1
        place += 0.5
    ax.axvline(0.5, color=RULE, lw=1)
    ax.set(xscale="log", xlim=(0.01, 2000), yticks=[])
    ax.set_xticks([0.01, 0.1, 1, 10, 100, 1000], ["0.01", "0.1", "1", "10", "100", "1000"])
    ax.minorticks_off()
    ax.invert_yaxis()
    ax.set_title("0.5 to 2 strokes a second on 1 mm, to 480 Hz: worst phase error (cycles)")


def draw_crossover(ax, table, rate, chosen):
    at = (table["part"] == "crossover") & np.isclose(table["update_rate_hz"], rate)
    for quantum, (colour, dashes) in LINES.items():
        rows = at & np.isclose(table["quantum_mm"], quantum)
        ax.plot(table["crossover_hz"][rows], table["phase_error_cycles"][rows], color=colour, ls=dashes, lw=1.6)
    ax.axvline(chosen, color=ACCENT, lw=1, ls=(0, (4, 3)), zorder=0)
    ax.axhline(0.5, color=RULE, lw=1, zorder=0)
    ax.set(xlim=(40, 300), ylim=(0, 2.1), xlabel="crossover (Hz)")
    ax.set_title(f"{rate / 1000:g} kHz: worst phase error (cycles)")
    say(ax, f"{chosen:g} Hz", chosen, 2.0, "left", "center", 8.5, ACCENT, 4, 0, "data")


def draw_push(ax, table, chosen):
    """The other side of the choice: what pushes below the crossover."""
    for rate, dashes in ((1000, "-"), (10000, (0, (1, 1.2)))):
        rows = ((table["part"] == "crossover") & np.isclose(table["update_rate_hz"], rate) & (table["quantum_mm"] == 0))
        ax.plot(table["crossover_hz"][rows], table["push"][rows], color=INK, ls=dashes, lw=1.6)
        say(ax, f"{rate / 1000:g} kHz", 295, table["push"][rows][-1], "right", "bottom", 8.5, INK, 0, 3, "data")
    ax.axvline(chosen, color=ACCENT, lw=1, ls=(0, (4, 3)), zorder=0)
    ax.set(xlim=(40, 300), ylim=(0, 0.25), xlabel="crossover (Hz)")
    ax.set_title("Push below the crossover (A)")


def draw_locked(data, folder):
    table = read_table(folder, data["table"])
    figure = plt.figure(figsize=(10, 10))
    grid = figure.add_gridspec(3, 6, left=0.065, right=0.985, top=0.905, bottom=0.09, hspace=0.42, wspace=1.1)
    drift, push = (figure.add_subplot(grid[0, columns]) for columns in (slice(0, 3), slice(3, 6)))
    slow, fast, below = (figure.add_subplot(grid[2, 2 * i:2 * i + 2]) for i in range(3))
    strokes = figure.add_axes([0.13, 0.385, 0.80, 0.205])
    heading(figure, "In step with the surface, and balanced", "steady speeds, strokes, and how the crossover "
            "(120 Hz) was chosen; push: the mean force over 50 ms, in K A")
    draw_speeds(drift, table, "played_per_crossed", lambda v: 100 * (v - 1), "Steady: cycles played against crossed (%)")
    draw_speeds(push, table, "push", lambda v: v, "Steady: push (A)")
    for ax in (drift, push):
        ax.axvline(data["crossover_hz"], color=ACCENT, lw=1, ls=(0, (4, 3)), zorder=0)
    draw_strokes(strokes, table)
    draw_push(below, table, data["crossover_hz"])
    for ax, rate in ((slow, 1000), (fast, 10000)):
        draw_crossover(ax, table, rate, data["crossover_hz"])
    handles = [Line2D([], [], color=METHODS[name], lw=2, label=name) for name in ORDER]
    handles += [Line2D([], [], color=colour, ls=dashes, lw=1.6, label=f"locked, {POSITIONS[quantum]}")
                for quantum, (colour, dashes) in LINES.items()]
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.05, 0.0), ncol=7, frameon=False, fontsize=8.5,
                  labelcolor=INK, handlelength=1.8, columnspacing=1.4)
    return figure


FIGURES = {"locked": draw_locked}
