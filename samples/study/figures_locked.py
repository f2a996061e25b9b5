"""The method locked beside S1 and S2, and the chart that its crossover is chosen by: study `locked`. Drawn by
figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

from style import ACCENT, ASKED, GREY, INK, METHODS, PALE, RULE, heading, read_table, say

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
    ax.set_title("Strokes on 1 mm, to 480 Hz: worst phase error (cycles)")


def draw_crossover(ax, table, rate, chosen):
    at = (table["part"] == "crossover") & np.isclose(table["update_rate_hz"], rate)
    for quantum, (colour, dashes) in LINES.items():
        rows = at & np.isclose(table["quantum_mm"], quantum)
        ax.plot(table["crossover_hz"][rows], table["phase_error_cycles"][rows], color=colour, ls=dashes, lw=1.6)
    rows = at & (table["quantum_mm"] == 0)
    push = ax.twinx()
    push.plot(table["crossover_hz"][rows], table["push"][rows], color=ASKED, lw=1.6)
    push.set(ylim=(0, 0.25))
    push.spines["top"].set_visible(False)
    push.tick_params(axis="y", colors=ASKED, length=2)
    ax.axvline(chosen, color=ACCENT, lw=1, ls=(0, (4, 3)), zorder=0)
    ax.axhline(0.5, color=RULE, lw=1, zorder=0)
    ax.set(xlim=(40, 300), ylim=(0, 2.1), xlabel="crossover (Hz)")
    ax.set_title(f"{rate / 1000:g} kHz: phase error (cycles), push below it (A)")
    say(ax, f"{chosen:g} Hz", chosen, 2.0, "left", "center", 8.5, ACCENT, 4, 0, "data")


def draw_locked(data, folder):
    table = read_table(folder, data["table"])
    figure, ((drift, push), (strokes, empty), (slow, fast)) = plt.subplots(3, 2, figsize=(10, 10))
    heading(figure, "In step with the surface, and balanced", "0.5 to 2 strokes a second; on 0.5 mm below; push: "
            "the mean force over 50 ms, in stiffness times amplitude")
    draw_speeds(drift, table, "played_per_crossed", lambda v: 100 * (v - 1), "Steady: cycles played against crossed (%)")
    draw_speeds(push, table, "push", lambda v: v, "Steady: push (A)")
    for ax in (drift, push):
        ax.axvline(data["crossover_hz"], color=ACCENT, lw=1, ls=(0, (4, 3)), zorder=0)
    draw_strokes(strokes, table)
    empty.remove()
    for ax, rate in ((slow, 1000), (fast, 10000)):
        draw_crossover(ax, table, rate, data["crossover_hz"])
    handles = [Line2D([], [], color=METHODS[name], lw=2, label=name) for name in ORDER]
    handles += [Line2D([], [], color=colour, ls=dashes, lw=1.6, label=f"locked, {POSITIONS[quantum]}")
                for quantum, (colour, dashes) in LINES.items()]
    handles.append(Line2D([], [], color=ASKED, lw=1.6, label="push"))
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.05, 0.0), ncol=7, frameon=False, fontsize=8.5,
                  labelcolor=INK, handlelength=1.8, columnspacing=1.4)
    figure.subplots_adjust(left=0.065, right=0.955, top=0.905, bottom=0.09, hspace=0.42, wspace=0.26)
    strokes.set_position([0.13, 0.385, 0.80, 0.205])
    return figure


FIGURES = {"locked": draw_locked}
