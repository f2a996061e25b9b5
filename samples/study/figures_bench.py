"""The time of a tick against triangles: the JSON of `knurl bench --json`, kept as bench.json; and by release.
Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import json
import os

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator

from style import ACCENT, GREY, INK, PALE, RULE, SOFT, heading, open_input, say

MESHES = ("mesh_1k", "mesh_10k", "mesh_100k", "mesh_1m")
FEELS = (("", "with grating", ACCENT, "o"), ("_smooth", "smooth", SOFT, "s"),
         ("_friction", "grating and friction", INK, "D"))
PLACES = {"plane": 4, "moving": 25, "surfaces_10k": 160}  # axis positions of scenes that are not one mesh
# CHAI3D 3.3 at -O3 -march=native, measured in November 2026 on 2 shared vCPUs AMD EPYC (Zen 4), in one process with
# Knurl and in turns with it, 5 to 7 rounds, on the same sheets with the same stroke. Triangles (a plane: 2), then ns:
# its fastest textured path (cAlgorithmFingerProxy::computeForces() alone), then the calls of its examples in each tick.
CHAI3D_MEDIAN = ((4, 242, 661), (1e3, 506, 928), (1e4, 595, 1034), (1e5, 1479, 2111), (1e6, 3989, 4478))
CHAI3D_PACED_MEDIAN = ((4, 2600, 5400), (1e3, 5000, 8800), (1e5, 9400, 12100), (1e6, 24000, 27000))
CHAI3D_PACED_P99 = ((4, 5900), (1e3, 9800), (1e5, 36000), (1e6, 284000))  # its fastest path; no p99 of the other

def band(ax, points, label, **style):
    """A line from the fastest path to the other."""
    x, low, *high = zip(*points)
    if high:
        ax.fill_between(x, low, high[0], color=RULE, alpha=0.55, lw=0, zorder=1)
    ax.plot(x, low, color=GREY, lw=1, zorder=1, **style)
    say(ax, label, x[-2], low[-2], "right", "bottom", 8, GREY, -4, 5, "data")


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
    for name, x in PLACES.items():
        if name in cases:
            lowest = min(cases[name + suffix][key] for suffix, *_ in FEELS if name + suffix in cases)
            say(ax, number(cases[name][key]), x, lowest, "center", "top", 8.5, INK, 0, -6, "data")
    for name in MESHES:
        if name in cases:
            lowest = min(cases[name + suffix][key] for suffix, *_ in FEELS if name + suffix in cases)
            say(ax, number(cases[name][key]), cases[name]["triangles"], lowest, "center", "top", 8.5, INK, 0, -6, "data")


def paced(ax, cases, key):
    points = [(PLACES["plane"], cases["paced_plane"][key])] if "paced_plane" in cases else []
    if "paced_mesh_100k" in cases:
        points.append((cases["paced_mesh_100k"]["triangles"], cases["paced_mesh_100k"][key]))
    for x, y in points:
        ax.plot(x, y, "o", mfc="white", mec=ACCENT, mew=1.4, ms=6.5, zorder=5)
        say(ax, number(y), x, y, "left", "center", 8.5, INK, 8, 0, "data")


def frame(ax, title, about):
    ax.set(xscale="log", yscale="log", xlim=(1.5, 2.6e6), ylim=(25, 2e5))
    ax.set_xticks([*PLACES.values(), 1e3, 1e4, 1e5, 1e6],
                  ["plane", "10 that\nmove", "10,000\nsurfaces", "1k", "10k", "100k", "1M"])
    ax.set_yticks([1e2, 1e3, 1e4, 1e5], ["100 ns", "1 µs", "10 µs", "100 µs"])
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
            (axes[0], "p50_ns", "Median", (("warm", CHAI3D_MEDIAN), ("paced", CHAI3D_PACED_MEDIAN))),
            (axes[1], "p99_ns", "99th percentile", (("paced", CHAI3D_PACED_P99),))):
        frame(ax, title, about)
        for label, points in references:
            band(ax, points, label, ls=(0, (2, 2)) if label == "paced" else "-")
        warm(ax, cases, key)
        paced(ax, cases, key)
    axes[1].tick_params(labelleft=False)
    shown = [feel for feel in FEELS if "mesh_1k" + feel[0] in cases]
    handles = [Line2D([], [], color=colour, marker=mark, ms=5, mew=0, lw=1.4, label=f"{label}, warm")
               for _, label, colour, mark in shown]
    handles += [Line2D([], [], ls="", marker="o", mfc="white", mec=ACCENT, mew=1.4, ms=6.5,
                       label="with grating, in a loop at 1 kHz"),
                Patch(color=RULE, label="CHAI3D 3.3, November 2026")]
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.06, 0.055), ncol=len(handles), frameon=False,
                  fontsize=8.5, labelcolor=INK, handlelength=1.6, columnspacing=1.3, handletextpad=0.5)
    figure.text(0.07, 0.028, "CHAI3D 3.3 with texture, from its fastest path (the line) to what its examples do each tick: "
                "2 vCPUs AMD EPYC (Zen 4), November 2026.\nReference lines of that machine and day; in a loop: from the "
                "position read to the force written.", color=GREY, fontsize=8.5, va="center")
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
