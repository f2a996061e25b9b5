"""What a tick takes against triangles: the JSON of `knurl bench --json`, kept as bench.json. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator

from style import ACCENT, GREY, INK, PALE, RULE, SOFT, heading, say

MESHES = ("mesh_1k", "mesh_10k", "mesh_100k", "mesh_1m")
FEELS = (("", "with grating", ACCENT, "o"), ("_smooth", "smooth", SOFT, "s"),
         ("_friction", "grating and friction", INK, "D"))
PLACES = {"plane": 4, "moving": 25, "surfaces_10k": 160}  # where the log axis has scenes that are no single mesh
# CHAI3D 3.3, measured elsewhere, not here, as noted in November 2026: 2 vCPUs at 2.5 GHz, -O2 -march=native, SCHED_FIFO,
# pinned, device I/O excluded, two runs of 1e6 ticks (paced: 20,000), the same stroke. Triangles, then from the least that
# was noted without texture to the most with it, ns.
CHAI3D_MEDIAN = ((1e3, 2200, 3800), (1e4, 4200, 6800), (1e5, 19000, 23000))
CHAI3D_P99 = ((1e3, 13000, 14000), (1e4, 17000, 24000), (1e5, 63000, 73000))
CHAI3D_PACED_MEDIAN = ((1e3, 11000, 13000), (1e4, 14000, 19000), (1e5, 27000, 31000))
CHAI3D_PACED_P99 = ((1e3, 35000, 36000), (1e4, 43000, 46000), (1e5, 101000, 106000))


def band(ax, points, label, **style):
    x, low, high = zip(*points)
    ax.fill_between(x, low, high, color=RULE, alpha=0.55, lw=0, zorder=1)
    middle = [(a * b) ** 0.5 for a, b in zip(low, high)]
    ax.plot(x, middle, color=GREY, lw=1, zorder=1, **style)
    say(ax, label, x[-1], middle[-1], "left", "center", 8, GREY, 6, 0, "data")


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
    ax.set(xscale="log", yscale="log", xlim=(1.5, 2.6e6), ylim=(80, 2e5))
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
    for ax, key, title, reference, cold in ((axes[0], "p50_ns", "Median", CHAI3D_MEDIAN, CHAI3D_PACED_MEDIAN),
                                            (axes[1], "p99_ns", "99th percentile", CHAI3D_P99, CHAI3D_PACED_P99)):
        frame(ax, title, about)
        band(ax, reference, "warm")
        band(ax, cold, "paced", ls=(0, (2, 2)))
        warm(ax, cases, key)
        paced(ax, cases, key)
    axes[1].tick_params(labelleft=False)
    shown = [feel for feel in FEELS if "mesh_1k" + feel[0] in cases]
    handles = [Line2D([], [], color=colour, marker=mark, ms=5, mew=0, lw=1.4, label=f"{label}, warm")
               for _, label, colour, mark in shown]
    handles += [Line2D([], [], ls="", marker="o", mfc="white", mec=ACCENT, mew=1.4, ms=6.5,
                       label="with grating, paced at 1 kHz: cold caches"),
                Patch(color=RULE, label="CHAI3D 3.3, elsewhere")]
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.06, 0.055), ncol=len(handles), frameon=False,
                  fontsize=8.5, labelcolor=INK, handlelength=1.6, columnspacing=1.3, handletextpad=0.5)
    figure.text(0.07, 0.028, "CHAI3D 3.3 (with and without texture): measured elsewhere, 2 vCPUs at 2.5 GHz, noted in November "
                "2026; reference lines, no ratio is claimed.", color=GREY, fontsize=8.5)
    figure.subplots_adjust(left=0.07, right=0.985, top=0.82, bottom=0.225, wspace=0.05)
    return figure


FIGURES = {"bench": draw_bench}
