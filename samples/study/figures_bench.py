"""What a tick takes against triangles: the JSON of `knurl bench --json`, kept as bench.json. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator

from style import ACCENT, GREY, INK, METHODS, PALE, RULE, heading, say

MESHES = ("mesh_1k", "mesh_10k", "mesh_100k", "mesh_1m")
FEELS = (("", "with grating", ACCENT, "o"), ("_smooth", "smooth", METHODS["T3"], "s"),
         ("_friction", "grating and friction", METHODS["locked"], "D"))
PLANE_AT = 150  # where the log axis has its planes
# CHAI3D 3.3, measured elsewhere (2 vCPUs at 2.5 GHz, -O2 -march=native, SCHED_FIFO, pinned, device I/O excluded, two runs
# of 1e6 ticks; paced: 20,000 ticks), not here: triangles, then the ranges that were noted, ns.
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


def warm(ax, cases, key, end):
    for suffix, _, colour, mark in FEELS:
        found = [cases[name + suffix] for name in MESHES if name + suffix in cases]
        if found:
            ax.plot([case["triangles"] for case in found], [case[key] for case in found], color=colour, lw=1.4,
                    marker=mark, ms=5, mew=0, zorder=4)
        if "plane" + suffix in cases:
            ax.plot(PLANE_AT, cases["plane" + suffix][key], mark, color=colour, ms=5, mew=0, zorder=4)
    if all(name in cases for name in ("mesh_1k", "mesh_1m")):
        for name, side in (("mesh_1k", -11), ("mesh_1m", 10)):
            say(ax, f"{cases[name][key]:,.0f}", cases[name]["triangles"], cases[name][key], "center", "center", 8.5, INK,
                0, side * end, "data")


def paced(ax, cases, key):
    points = [(PLANE_AT, cases["paced_plane"][key])] if "paced_plane" in cases else []
    if "paced_mesh_100k" in cases:
        points.append((cases["paced_mesh_100k"]["triangles"], cases["paced_mesh_100k"][key]))
    for x, y in points:
        ax.plot(x, y, "o", mfc="white", mec=ACCENT, mew=1.4, ms=6.5, zorder=5)
        say(ax, f"{y / 1e3:.1f} µs", x, y, "left", "center", 8.5, INK, 8, 0, "data")


def others(ax, cases, key):
    """Scenes that are no single mesh: marks on the axis of planes."""
    for name, label, mark in (("moving", "10 that move", "^"), ("surfaces_10k", "10,000 surfaces", "P")):
        if name in cases:
            y = cases[name][key]
            ax.plot(PLANE_AT, y, mark, color=INK, ms=5.5, mew=0, zorder=4)
            say(ax, label, PLANE_AT, y, "left", "center", 8, INK, 8, 0, "data")


def frame(ax, title, about):
    ax.set(xscale="log", yscale="log", xlim=(90, 4.2e6), ylim=(80, 3e5))
    ax.set_xticks([PLANE_AT, 1e3, 1e4, 1e5, 1e6], ["plane", "1k", "10k", "100k", "1M"])
    ax.set_yticks([1e2, 1e3, 1e4, 1e5], ["100 ns", "1 µs", "10 µs", "100 µs"])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_minor_locator(NullLocator())
    ax.tick_params(length=2)
    ax.grid(True, which="major", color=PALE, lw=0.8, zorder=0)
    ax.set_xlabel("triangles")
    ax.set_title(f"{title}\n", fontsize=11, fontweight="bold", color=INK)
    ax.text(0, 1.02, about, transform=ax.transAxes, color=GREY, fontsize=8.5)


def draw_bench(data, folder):
    del folder
    cases = {case["case"]: case for case in data["cases"]}
    figure, axes = plt.subplots(1, 2, figsize=(10, 6.2), sharey=True)
    heading(figure, "What a tick takes, from a plane to a million triangles",
            f"{data['machine']}, shared; the timer's {data['timer_ns']:g} ns taken off each sample; "
            "a stroke of 40 mm, up to 250 mm/s, 1 mm deep", 0.07)
    for ax, key, title, reference, cold in ((axes[0], "p50_ns", "Median", CHAI3D_MEDIAN, CHAI3D_PACED_MEDIAN),
                                            (axes[1], "p99_ns", "99th percentile", CHAI3D_P99, CHAI3D_PACED_P99)):
        frame(ax, title, "of up to a million ticks warm, 5,000 ticks paced")
        band(ax, reference, "warm")
        band(ax, cold, "paced", ls=(0, (2, 2)))
        warm(ax, cases, key, 1)
        paced(ax, cases, key)
        others(ax, cases, key)
    axes[1].tick_params(labelleft=False)
    shown = [feel for feel in FEELS if "mesh_1k" + feel[0] in cases]
    handles = [Line2D([], [], color=colour, marker=mark, ms=5, mew=0, lw=1.4, label=f"{label}, warm")
               for _, label, colour, mark in shown]
    handles += [Line2D([], [], ls="", marker="o", mfc="white", mec=ACCENT, mew=1.4, ms=6.5,
                       label="with grating, once a millisecond: cold caches"),
                Patch(color=RULE, label="CHAI3D 3.3, with and without texture")]
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.06, 0.06), ncol=len(handles), frameon=False,
                  fontsize=8.5, labelcolor=INK, handlelength=1.8, columnspacing=1.6)
    figure.text(0.07, 0.028, "CHAI3D 3.3: measured elsewhere, on 2 vCPUs at 2.5 GHz, meshes and hardware not these; "
                "reference lines, no ratio is claimed.", color=GREY, fontsize=8.5)
    figure.subplots_adjust(left=0.07, right=0.985, top=0.82, bottom=0.2, wspace=0.05)
    return figure


FIGURES = {"bench": draw_bench}
