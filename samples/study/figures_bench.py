"""The time of a tick against triangles: the JSON of `knurl bench --json`, kept as bench.json; and by release.
Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import json
import os

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from style import ACCENT, GREY, INK, PALE, SOFT, heading, open_input, say

MESHES = ("mesh_1k", "mesh_10k", "mesh_100k", "mesh_1m")
FEELS = (("", "with grating", ACCENT, "o"), ("_smooth", "smooth", SOFT, "s"),
         ("_friction", "grating and friction", INK, "D"))
PLACES = {"plane": 4, "moving": 25, "surfaces_10k": 160}  # axis positions of scenes that are not one mesh
# Measured on 24 November 2026 on 2 quiet vCPUs AMD EPYC (Zen 5), in one process with Knurl and in turns with it, 9 rounds,
# on the same sheets with the same stroke: CHAI3D 3.3 at -O3 -march=native with texture, and HAPI's god-object on a smooth
# surface. Triangles (a plane: 4), then ns. "fastest" is cAlgorithmFingerProxy::computeForces() alone, which loses ridges and
# moving meshes; the dynamic proxy keeps a grating whole.
FASTEST, WHOLE, HAPI = "CHAI3D, fastest path", "CHAI3D, set-up that keeps the grating whole", "HAPI, smooth"
MEDIAN = ((WHOLE, ((4, 324), (1e3, 1054), (1e4, 1209), (1e5, 2213), (1e6, 7024)), "-", (3, "right", "bottom", 5)),
          (FASTEST, ((4, 186), (1e3, 386), (1e4, 438), (1e5, 1088), (1e6, 2696)), "-", (2, "left", "top", -5)),
          (HAPI, ((4, 173), (1e3, 393), (1e4, 497), (1e5, 641)), (0, (2, 2)), (1, "right", "bottom", 4)))
P99 = ((f"{FASTEST}, in a loop", ((4, 1300), (1e3, 3600), (1e5, 14000), (1e6, 39000)), "-", (2, "right", "bottom", 5)),)


def reference(ax, label, points, dashes, place):
    """A line, and its name at one of its points."""
    x, y = zip(*points)
    at, side, above, dy = place
    ax.plot(x, y, color=GREY, lw=1, ls=dashes, zorder=1)
    say(ax, label, x[at], y[at], side, above, 8, GREY, 4 if side == "left" else -4, dy, "data")


def number(ns):
    return f"{ns:,.0f} ns" if ns < 1000 else f"{ns / 1e3:.1f} µs"


def warm(ax, cases, key):
    for suffix, _, colour, mark in FEELS:
        style = {"color": colour, "marker": mark, "ms": 5, "mew": 0, "zorder": 4}
        found = [cases[name + suffix] for name in MESHES if name + suffix in cases]
        ax.plot([case["triangles"] for case in found], [case[key] for case in found], lw=1.4, **style)
        for name, x in PLACES.items():
            if name + suffix in cases:
                ax.plot(x, cases[name + suffix][key], **style)
    for name, x in (*PLACES.items(), *((name, cases[name]["triangles"]) for name in MESHES if name in cases)):
        if name in cases:
            lowest = min(cases[name + suffix][key] for suffix, *_ in FEELS if name + suffix in cases)
            say(ax, number(cases[name][key]), x, lowest, "center", "top", 8.5, ACCENT, 0, -6, "data", halo=True)


def paced(ax, cases, key):
    for name, vertical, down in (("paced_plane", "center", 0), ("paced_mesh_100k", "top", -4)): # below CHAI3D's line
        if name in cases:
            x, y = cases[name]["triangles"] or PLACES["plane"], cases[name][key]
            ax.plot(x, y, "o", mfc="white", mec=ACCENT, mew=1.4, ms=6.5, zorder=5)
            say(ax, number(y), x, y, "left", vertical, 8.5, ACCENT, 8, down, "data", halo=True)


def frame(ax, title, about):
    ax.set(xscale="log", yscale="log", xlim=(1.5, 2.6e6), ylim=(25, 6e4))
    ax.set_xticks([*PLACES.values(), 1e3, 1e4, 1e5, 1e6],
                  ["plane", "10 that\nmove", "10,000\nsurfaces", "1k", "10k", "100k", "1M"])
    ax.set_yticks([1e2, 1e3, 1e4], ["100 ns", "1 µs", "10 µs"])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_minor_locator(NullLocator())
    ax.tick_params(length=2)
    ax.grid(True, which="major", color=PALE, lw=0.8, zorder=0)
    say(ax, "triangles of one mesh", 3e4, -0.105, "center", "top", 9.5, INK, within=("data", "axes fraction"))
    ax.set_title(f"{title}\n", fontsize=11, fontweight="bold", color=INK)
    ax.text(0, 1.02, about, transform=ax.transAxes, color=GREY, fontsize=8.5)


def shortest(cases):
    return min(case["ticks"] for name, case in cases.items() if not name.startswith("paced_"))


def draw_bench(data, folder):
    del folder
    cases = {case["case"]: case for case in data["cases"]}
    figure, axes = plt.subplots(1, 2, figsize=(10, 6.4), sharey=True)
    heading(figure, "What a tick takes, from a plane to a million triangles",
            f"{data['machine'].replace('(R)', '')}, shared · strokes of 40 mm, up to 250 mm/s, 1 mm deep · "
            f"the timer's {data['timer_ns']:g} ns taken off", 0.07)
    about = f"one HIP, {shortest(cases):,.0f} to {max(case['ticks'] for case in data['cases']):,.0f} ticks warm, " \
            f"{cases.get('paced_plane', {}).get('ticks', 0):,.0f} paced"
    for ax, key, title, references in (
            (axes[0], "p50_ns", "Median", MEDIAN), (axes[1], "p99_ns", "99th percentile", P99)):
        frame(ax, title, about)
        for line in references:
            reference(ax, *line)
        warm(ax, cases, key)
        paced(ax, cases, key)
    axes[1].tick_params(labelleft=False)
    shown = [feel for feel in FEELS if "mesh_1k" + feel[0] in cases]
    handles = [Line2D([], [], color=colour, marker=mark, ms=5, mew=0, lw=1.4,
                      label=f"{label}, warm" + ("" if suffix else " (numbers)")) for suffix, label, colour, mark in shown]
    handles += [Line2D([], [], ls="", marker="o", mfc="white", mec=ACCENT, mew=1.4, ms=6.5,
                       label="with grating, in a loop at 1 kHz")]
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.06, 0.055), ncol=len(handles), frameon=False,
                  fontsize=8.5, labelcolor=INK, handlelength=1.6, columnspacing=1.3, handletextpad=0.5)
    figure.text(0.07, 0.028, "Grey lines: CHAI3D 3.3 with texture, and HAPI without, on 2 vCPUs AMD EPYC (Zen 5), 24 November "
                "2026: of that machine and day.\nNumbers: with grating. In a loop: from the position read to the force written.", color=GREY,
                fontsize=8.5, va="center")
    figure.subplots_adjust(left=0.07, right=0.985, top=0.82, bottom=0.225, wspace=0.05)
    return figure


HISTORY = ("plane", "mesh_1k", "mesh_10k", "mesh_100k", "mesh_1m", "surfaces_10k", "moving",
           "paced_plane_cold", "paced_plane", "paced_mesh_100k_cold", "paced_mesh_100k")


def draw_history(data, folder):
    """The results of each release, one file each, in order of release."""
    results = []
    for name in data["releases"]:
        with open_input(os.path.join(folder, f"{name}.json")) as file:
            results.append(json.load(file))
    figure, axes = plt.subplots(1, 2, figsize=(10, 6.4), sharey=True)
    heading(figure, "What a tick took, release by release", f"{results[-1]['machine']}, shared; {results[-1]['measured']}; "
            "ns, the timer taken off; a name times the same in every release", 0.07)
    tables = [{case["case"]: case for case in result["cases"]} for result in results]
    for ax, key, title in ((axes[0], "p50_ns", "Median"), (axes[1], "p99_ns", "99th percentile")):
        labels = []
        for name in HISTORY:
            points = [(i, table[name][key]) for i, table in enumerate(tables) if name in table]
            paced_row = name.startswith("paced_")
            ax.plot(*zip(*points), marker="o", ms=4, mew=0, lw=1.4, color=ACCENT if paced_row else INK)
            labels.append((points[-1][1], f"{name.replace('_', ' ')}  {number(points[-1][1])}"))
        y = 0.0
        for at, text in sorted(labels):  # each one line above the one below it
            y = max(at, 1.13 * y)
            say(ax, text, len(results) - 1, y, "left", "center", 8, INK, 8, 0, "data")
        ax.set(yscale="log", xlim=(-0.2, len(results) - 0.1), title=title)
        ax.set_xticks(range(len(results)), data["releases"])
        ax.set_yticks([1e2, 1e3, 1e4], ["100 ns", "1 µs", "10 µs"])
        ax.yaxis.set_minor_locator(NullLocator())
        ax.grid(True, axis="y", color=PALE, lw=0.8, zorder=0)
    figure.subplots_adjust(left=0.07, right=0.83, top=0.84, bottom=0.07, wspace=0.5)
    return figure


FIGURES = {"bench": draw_bench, "bench_history": draw_history}
