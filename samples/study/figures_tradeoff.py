"""Every point of cost against accuracy, one panel per error: study `tradeoff`. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import csv
import os

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from style import GREY, INK, METHODS, open_input

OTHERS = ["#3a3a3a"]  # for methods without a colour in style.py
MARKERS = {"none": "o", "ideal": "D", "difference": "v", "lowpass": "^", "foaw": "s"}
SIZES = {1000.0: 26, 2000.0: 48, 5000.0: 80, 10000.0: 125}
FLOOR = 1e-4  # smaller values and 0 are drawn here
PANELS = [("mean_worst", "net force, worst (A)", "what stays over whole cycles"),
          ("frequency", "frequency error, mean", "strongest line against what the motion asks for"),
          ("false_worst", "false tones, worst", "of the power, farther than {near} from what is the ridges'"),
          ("felt_worst", "felt false tones, worst", "the same, through a device in a hand and over the threshold"),
          ("strokes", "drift in strokes", "cycles played against crossed, 0 to 250 Hz and back; half a cycle: 0.0008")]


def read(folder, table):
    """The rows, each with the worse error of both ridges."""
    text = {"method", "velocity", "positions"}
    found = {}
    with open_input(os.path.join(folder, table), newline="") as stream:
        for row in csv.DictReader(stream):
            row = {key: value if key in text else float(value) for key, value in row.items()}
            first = found.setdefault((row["method"], row["velocity"], row["positions"], row["rate_hz"]), row)
            for key, *_ in PANELS:
                first[key] = max(first[key], row[key])
    return list(found.values())


def draw_panel(axes, rows, colours, key, title, about):
    for row in rows:
        if row[key] != row[key]:
            continue
        colour = colours[row["method"]]
        real = row["positions"] != "ideal"
        axes.scatter(row["ns_second"] / 1e3, max(row[key], FLOOR), marker=MARKERS[row["velocity"]],
                     s=SIZES.get(row["rate_hz"], 60), facecolor=colour if real else "white", edgecolor=colour,
                     linewidth=1.1, alpha=0.9, zorder=3, clip_on=False)
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_yscale("log")
    axes.set_ylim(FLOOR * 0.8, 10)
    axes.set_yticks([FLOOR, 1e-3, 1e-2, 1e-1, 1, 10], ["≤ 0.0001", "0.001", "0.01", "0.1", "1", "10"])
    axes.set_title(f"{title}\n", color=INK, fontsize=10.5)
    axes.text(0, 1.02, about, transform=axes.transAxes, color=GREY, fontsize=8.5)
    axes.grid(True, which="major", color="#eef1f2", lw=0.8, zorder=0)


def legend(figure, rows, colours):
    methods = [Line2D([], [], marker="o", ls="", color=colours[m], label=m) for m in colours
               if any(row["method"] == m for row in rows)]
    shapes = [Line2D([], [], marker=MARKERS[v], ls="", color=GREY, label=label) for v, label in
              (("ideal", "velocity given"), ("difference", "first difference"),
               ("lowpass", "low pass, 20 Hz"), ("foaw", "FOAW"),
               ("none", "needs no velocity"))]
    fills = [Line2D([], [], marker="o", ls="", color=GREY, markerfacecolor="white", label="ideal positions"),
             Line2D([], [], marker="o", ls="", color=GREY, label="from 0.055 mm, or no positions")]
    rates = [Line2D([], [], marker="o", ls="", color=GREY, markersize=SIZES[r] ** 0.5 * 0.8, label=f"{r / 1000:g} kHz")
             for r in SIZES]
    blank = Line2D([], [], ls="", label=" ")
    columns = [methods + [blank] + rates, shapes + [blank] + fills]
    height = max(len(column) for column in columns)
    handles = [handle for column in columns for handle in column + [blank] * (height - len(column))]
    figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.70, 0.40), ncol=len(columns), frameon=False,
                  fontsize=9, labelcolor=INK, handletextpad=0.4, columnspacing=3)


def draw_tradeoff(data, folder):
    rows = read(folder, data["table"])
    later = [m for m in dict.fromkeys(row["method"] for row in rows) if m not in METHODS]
    colours = {**METHODS, **dict(zip(later, OTHERS))}
    near = f"{100 * data['tolerance']:g} %, {data['tolerance_hz']:g} Hz"
    figure, grid = plt.subplots(2, 3, figsize=(14, 8.6), sharex=True, sharey=True)
    for axes, (key, title, about) in zip(grid.flat, PANELS):
        draw_panel(axes, rows, colours, key, title, about.format(near=near))
    grid[1, 2].axis("off")
    for axes in grid.flat[2:5]:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel("µs of one core for a second of rendering", color=INK)
    figure.suptitle("Every method, rate and estimator: cost in time, and each error", x=0.05, ha="left", fontsize=15,
                    weight="bold", color=INK)
    figure.text(0.05, 0.925, f"steady scans, {data['from_hz']:g} to {data['split_hz']:g} Hz, the worse of 1 and 0.5 mm · "
                f"{data['machine']} · empty tick {data['empty_tick_ns']:.1f} ns taken off", color=GREY, fontsize=9)
    legend(figure, rows, colours)
    figure.subplots_adjust(left=0.05, right=0.985, top=0.845, bottom=0.075, hspace=0.32, wspace=0.2)
    return figure


FIGURES = {"tradeoff": draw_tradeoff}
