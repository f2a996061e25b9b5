"""Even sensation, the felt strength over f_t without and with gains: study `even`. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import csv
import os

import matplotlib.pyplot as plt

from style import ACCENT, GREY, RULE, SOFT, heading, open_input

TICKS = [25, 50, 100, 200, 300, 400]


def draw_even(data, folder):
    with open_input(os.path.join(folder, data["table"]), newline="") as stream:
        rows = [{key: float(cell) for key, cell in row.items()} for row in csv.DictReader(stream)]
    hz = [row["hz"] for row in rows]
    level = next(row["felt_even_db"] for row in rows if row["hz"] > 100)
    figure, (top, low) = plt.subplots(2, 1, figsize=(11, 5.8), sharex=True, height_ratios=(2.2, 1))
    heading(figure, "Even sensation: ridges equally strong from 25 to 300 Hz",
            "felt strength of bandlimited at 1 kHz, by a model of a Touch in a hand and of a fingertip's threshold")
    top.axvspan(25, 300, color=SOFT, lw=0, alpha=0.35)
    for key, colour, name, place in (("felt_db", GREY, "without gains", -14), ("felt_even_db", ACCENT, "with gains", -14)):
        line = [row[key] - level for row in rows]
        top.plot(hz, line, color=colour, lw=2.2)
        at = min(range(len(hz)), key=lambda i: abs(hz[i] - 120))
        top.annotate(name, (hz[at], line[at]), (0, place), textcoords="offset points", color=colour)
    top.set_ylabel("felt (dB)")
    low.plot(hz, [row["gain"] for row in rows], color=ACCENT, lw=2.2)
    low.axvspan(25, 300, color=SOFT, lw=0, alpha=0.35)
    low.set_ylim(0, 1.08)
    low.set_ylabel("gain on A")
    low.set_xscale("log")
    low.set_xticks(TICKS, [str(tick) for tick in TICKS])
    low.minorticks_off()
    low.set_xlabel("f_t (Hz): ridges crossed per second")
    for ax in (top, low):
        ax.grid(axis="y", color=RULE, lw=0.6)
    figure.subplots_adjust(left=0.07, right=0.985, top=1 - 1.05 / figure.get_figheight(), bottom=0.6 / figure.get_figheight(), hspace=0.12)
    return figure


FIGURES = {"even": draw_even}
