#!/usr/bin/python3
"""Draws a study: the JSON and CSV that `knurl study NAME --out DIR` wrote, as one picture.

The study's name is the JSON's. A figure is a function of the JSON (as a dict) and of its folder, which has the CSV;
further figures are in figures_*.py.

SPDX-License-Identifier: MIT
"""
import argparse
import glob
import importlib
import json
import os
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    from style import (ACCENT, ASKED, GREY, INK, METHODS, PALE, RULE, SOFT, STYLE, BadInput, heading, open_input,
                       read_table, save, say)
except ImportError as missing:
    sys.exit(f"figures.py: {missing} for {sys.executable}; apt-get install python3-matplotlib, "
             "then use /usr/bin/python3")

TEMPORAL = ("T1", "T2", "T3")
ABOUT = {"T1": "sampling", "T2": "weighted mixing", "T3": "balanced impulse"}
IDEAL = 4 / np.pi  # the fundamental of a square wave of amplitude 1


def step(ax, values, colour, fill=True, **style):
    """A held signal, one value per tick."""
    t = np.arange(len(values) + 1)
    held = np.append(values, values[-1])
    if fill:
        ax.fill_between(t, 0, held, step="post", color=colour, alpha=0.22, lw=0)
    ax.step(t, held, where="post", color=colour, lw=1.5, **style)


def bare(ax, ticks, low=-2.35, high=1.75):
    """A signal's frame: zero, and marks at plus and minus the amplitude."""
    ax.set(xlim=(0, ticks), ylim=(low, high), xticks=[], yticks=[-1, 0, 1], yticklabels=[])
    ax.tick_params(length=2)
    ax.axhline(0, color=RULE, lw=0.8, zorder=0)
    ax.spines["bottom"].set_visible(False)


def draw_signal(ax, cell, values, ticks):
    t = np.linspace(0, ticks, 4001)[:-1]
    ax.plot(t, np.where(t / cell["period_ms"] % 1 < 0.5, 1, -1), color=GREY, lw=0.7, ls=(0, (2, 2)))
    step(ax, values[:ticks], METHODS[cell["method"]])
    bare(ax, ticks)
    if abs(cell["net"]) > 1e-6:
        ax.axhline(cell["net"], color=ASKED, lw=1.2)
        say(ax, f"net {cell['net']:.2f} N", 1, 1.0, "right", "top", 8, ASKED)
    period = 1e3 / cell["dominant_hz"]
    off = abs(period / cell["period_ms"] - 1) > 1e-6
    say(ax, f"{cell['dominant_amplitude']:.2f} N at {period:.3g} ms", 0.03, 0.0, "left", "bottom", 8,
        ASKED if off else INK)


def draw_mixing(figure, cell, parts, box, title):
    """The two parts and their sum, one above the other."""
    left, bottom, width, height = box
    gap = 0.012
    each = (width - 2 * 0.032) / 3
    names = [f"{p['amplitude']:.3f} N, {p['period_ms']:g} ms" for p in cell["parts"]]
    shown = [*parts, parts[0] + parts[1]]
    titles = [*names, f"sum: repeats in {cell['actual_period_ms']:g} ms"]
    for i, (values, name) in enumerate(zip(shown, titles)):
        ax = figure.add_axes([left + i * (each + 0.032), bottom, each, height - gap])
        step(ax, values[:12], METHODS[cell["method"]] if i == 2 else SOFT)
        bare(ax, 12, -1.95, 1.6)
        ax.set_title(name, fontsize=8.5, color=INK if i == 2 else GREY, pad=3)
        if i:
            figure.text(left + i * (each + 0.032) - 0.016, bottom + height / 2, "+" if i == 1 else "=", ha="center",
                        va="center", fontsize=13, color=GREY)
    figure.text(left, bottom + height + 0.032, title, fontsize=10, fontweight="bold")


def draw_signals(data, folder):
    """Figure 2."""
    table = read_table(folder, "signals.csv")
    cells = {(cell["method"], cell["period_ms"]): cell for cell in data["cells"]}
    periods = list(dict.fromkeys(cell["period_ms"] for cell in data["cells"]))
    kinds = {"even": "even", "odd": "odd", "mixed": "mixed", "other": "other"}
    figure, ticks, left, width = plt.figure(figsize=(10, 7.8)), 15, 0.108, 0.166
    heading(figure, "What each method plays", "asked for: a square wave of 1 N; shown: 15 ms at 1 kHz; "
            "under each signal: its dominant component", 0.02)

    def rows_of(key, column):
        return table[column][(table["method"] == key[0]) & (table["period_ms"] == key[1])]

    for row, method in enumerate(TEMPORAL):
        bottom = 0.695 - row * 0.178
        figure.text(0.02, bottom + 0.085, method, fontsize=15, fontweight="bold", color=METHODS[method], va="center")
        figure.text(0.02, bottom + 0.055, ABOUT[method].replace(" ", "\n"), fontsize=8.5, color=GREY, va="top")
        for column, period in enumerate(periods):
            ax = figure.add_axes([left + column * (width + 0.014), bottom, width, 0.165])
            draw_signal(ax, cells[method, period], rows_of((method, period), "value"), ticks)
            if row == 0:
                kind = kinds[cells[method, period]["kind"]]
                ax.set_title(f"{period:g} ms, {1e3 / period:.0f} Hz", pad=5, fontsize=9.5, fontweight="bold")
                say(ax, kind, 1, 1, "right", "baseline", 8.5, GREY, -2, 5)
    for column, (method, title) in enumerate((("T2", "T2 mixes its even neighbours"),
                                              ("T3", "T3 mixes 2 and 3 ticks"))):
        key = (method, 2.5)
        draw_mixing(figure, cells[key], [rows_of(key, "part1"), rows_of(key, "part2")],
                    (0.02 + column * 0.495, 0.075, 0.47, 0.135), f"400 Hz: {title}")
    handles = [Line2D([], [], color=GREY, lw=0.9, ls=(0, (2, 2)), label="asked for"),
               Line2D([], [], color=ASKED, lw=1.2, label="net force")]
    figure.text(0.275, 0.025, "in orange: a dominant component that is not at the period asked for", color=ASKED,
                fontsize=8.5, va="center")
    figure.legend(handles=handles, loc="center left", bbox_to_anchor=(0.01, 0.025), ncol=2, frameon=False, fontsize=8.5,
                  labelcolor=GREY, handlelength=1.8)
    return figure


GAP = "#f3c6ac"


def draw_line(ax, table, rate, name, weber, y, height):
    """One set of frequencies at one Weber fraction: within the JND of the next one, and not."""
    pick = (table["update_rate_hz"] == rate) & (table["set"] == name) & (table["weber"] == weber)
    f, neighbour, high = table["frequency_hz"][pick], table["neighbour_hz"][pick], table["band_high_hz"][pick]
    top = np.where(np.isfinite(neighbour), np.minimum(neighbour, high), f)
    for low, up, above, gap in zip(f, top, neighbour, table["gap"][pick]):
        ax.fill_between([low, up], y - height, y + height, color="#d3e7ea" if weber > 0.3 else "#e6eff1", lw=0)
        if gap:
            ax.fill_between([up, above], y - height, y + height, color=GAP, lw=0)
            ax.fill_between([up, max(up, above / (1 + weber))], y - height, y + height, color=ASKED, lw=0)
    if weber > 0.3:  # above the top one, the range that feels the same
        ax.fill_between([f[-1], f[-1] * (1 + weber)], y - height, y + height, facecolor="none", edgecolor=SOFT,
                        hatch="/////", lw=0)
    kinds = table["kind"][pick]
    for kind, colour in (("even", ACCENT), ("odd", METHODS["T2"]), ("mixed", METHODS["bandlimited"])):
        ax.vlines(f[kinds == kind], y - height, y + height, color=colour, lw=1.0 if kind != "mixed" else 2.2)


def draw_rate(ax, data, table, rate):
    names = {"even": "even periods", "odd": "+ odd periods", "mixed": "+ the mixed case"}
    for row, part in enumerate(rate["sets"]):
        y = 2 - row
        draw_line(ax, table, rate["update_rate_hz"], part["set"], 0.38, y + 0.10, 0.20)
        draw_line(ax, table, rate["update_rate_hz"], part["set"], 0.20, y - 0.21, 0.07)
        no_gap = part["haptic"][0]["no_gap_up_to_hz"]
        ax.annotate("", (no_gap, y + 0.30), (no_gap, y + 0.42), arrowprops={"arrowstyle": "-|>", "color": INK,
                                                                             "lw": 0.8, "shrinkA": 0, "shrinkB": 0})
        say(ax, f"no gap up to {no_gap:.0f} Hz", no_gap, y + 0.42, "right", "center", 8.5, INK, -4, 0, "data")
        ax.text(-0.012, y + 0.10, names[part["set"]], transform=ax.get_yaxis_transform(), ha="right", va="center",
                color=INK, fontsize=9)
        ax.text(-0.012, y - 0.21, "WF 0.20", transform=ax.get_yaxis_transform(), ha="right", va="center", color=GREY,
                fontsize=7.5)
    for mark in data["audible"] if rate["update_rate_hz"] == 1000 else ():
        y = {"even": 2, "odd": 1}[mark["set"]]
        say(ax, f"heard from {mark['printed_hz']:g} Hz (printed)", mark["printed_hz"], y + 0.42, "left", "center", 8,
            GREY, 4, 0, "data")
        ax.vlines(mark["printed_hz"], y + 0.30, y + 0.48, color=GREY, lw=0.8)
    ax.set(xscale="log", xlim=(20, 1450), ylim=(-0.42, 2.58), yticks=[])
    ax.set_xticks([20, 30, 50, 100, 200, 333, 500, 1000], ["20", "30", "50", "100", "200", "333", "500", "1000"])
    ax.minorticks_off()
    ax.tick_params(length=2)
    ax.spines["left"].set_visible(False)
    ax.set_title(f"{rate['update_rate_hz'] / 1e3:g} kHz", fontsize=11, fontweight="bold", pad=4)
    say(ax, f"with the JND up to {rate['reach_with_jnd_hz']:.0f} Hz: at {data['speed_mm_s']:g} mm/s periods down to "
        f"{rate['smallest_period_mm']:.2f} mm ({rate['smallest_period_without_jnd_mm']:g} mm without)", 1, 1.0, "right",
        "bottom", 8.5, GREY, 0, 6)


def draw_coverage(data, folder):
    """Figure 3."""
    table = read_table(folder, "coverage.csv")
    figure, axes = plt.subplots(2, 1, figsize=(10, 7.6))
    heading(figure, "Which frequencies can be played, and where a hand feels a step",
            f"{data['rule']}: WF 0.38, as the paper takes it (broad), and 0.20 (narrow)", 0.02)
    for ax, rate in zip(axes, data["rates"]):
        draw_rate(ax, data, table, rate)
    axes[-1].set_xlabel("frequency (Hz)")
    handles = [Line2D([], [], color=ACCENT, lw=1.4, label="even period"),
               Line2D([], [], color=METHODS["T2"], lw=1.4, label="odd period"),
               Line2D([], [], color=METHODS["bandlimited"], lw=2.2, label="2.5 ticks, mixed"),
               Patch(color="#d3e7ea", label="up to f(1 + WF)"), Patch(color=GAP, label="gap"),
               Patch(color=ASKED, label="within WF of neither side"),
               Patch(facecolor="none", edgecolor=SOFT, hatch="/////", lw=0, label="felt as the top one")]
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.01, 0.0), ncol=7, frameon=False, fontsize=8.5,
                  labelcolor=INK, handlelength=1.5, columnspacing=1.4)
    figure.subplots_adjust(left=0.125, right=0.98, top=0.855, bottom=0.125, hspace=0.3)
    return figure


def curve(ax, table, method, column, scale=1.0, **style):
    """Dots at the paper's periods; up to 10 ms a thin line through the tenths of a millisecond in between."""
    pick = table["method"] == method
    x, y, paper = table["period_ms"][pick], table[column][pick] * scale, table["papers_grid"][pick] > 0
    ax.plot(x[x <= DENSE_MS], y[x <= DENSE_MS], color=METHODS[method], lw=0.6, alpha=0.45, zorder=1)
    ax.plot(x[paper], y[paper], MARKS[method], color=METHODS[method], ms=4, mew=0, zorder=3, **style)


DENSE_MS = 10  # above it, lines through tenths of a millisecond are too dense
MARKS = {"T1": "s", "T2": "D", "T3": "o"}


def period_axis(ax, label):
    ax.set(xscale="log", xlim=(1.9, 37))
    ax.set_xticks([2, 2.5, 3, 4, 5, 7, 10, 15, 20, 35], ["2", "2.5", "3", "4", "5", "7", "10", "15", "20", "35"])
    ax.minorticks_off()
    ax.tick_params(length=2)
    ax.grid(True, color=PALE, lw=0.8, zorder=0)
    if label:
        ax.set_xlabel("temporal period asked for (ms)")


def draw_pcc(ax, table):
    for first, other, colour, mark, size in (("T1", "T2", METHODS["T1"], "s", 7.5), ("T2", "T3", METHODS["T2"], "D", 5),
                                             ("T1", "T3", METHODS["T3"], "o", 3.5)):
        pick = (table["method"] == first) & (table["papers_grid"] > 0)
        ax.plot(table["period_ms"][pick], table[f"pcc_{other}"][pick], mark, color=colour, ms=size, mew=0,
                label=f"{first} and {other}", clip_on=False)
    ax.set(ylim=(-0.05, 1.05))
    ax.set_title("Correlation (PCC) at the paper's periods")
    ax.legend(loc="center right", frameon=False, fontsize=8.5, labelcolor=INK, handletextpad=0.2)
    say(ax, "0.46", 2.5, 0.4615, "left", "center", 8.5, METHODS["T2"], 6, 0, "data")


def draw_window(ax, table):
    """Amplitude over the paper's window against ours: the difference is leakage."""
    for method in TEMPORAL:
        pick = (table["method"] == method) & (table["papers_grid"] > 0)
        x, ours, window = (table[c][pick] for c in ("period_ms", "dominant_amplitude", "window_dominant_amplitude"))
        ax.vlines(x, ours, window, color=METHODS[method], lw=1, alpha=0.7)
        ax.plot(x, ours, MARKS[method], color=METHODS[method], ms=3.5, mew=0)
        ax.plot(x, window, MARKS[method], mfc="white", mec=METHODS[method], ms=3.5, mew=0.9)
    ax.axhline(IDEAL, color=INK, lw=0.8, ls=(0, (4, 3)))
    ax.set_title("Dominant amplitude (N): 40 periods of T instead (hollow)")
    ax.set(ylim=(0.6, 1.36))
    say(ax, "a window that the actual period\ndoes not divide leaks", 0.02, 0.03, "left", "bottom")


def draw_temporal(data, folder):
    """Figure 4."""
    table = read_table(folder, "temporal.csv")
    figure, grid = plt.subplots(3, 2, figsize=(10, 9.2))
    found = data["findings"]
    heading(figure, "What each method's signal is worth", "A = 1 N at 1 kHz, held, over whole numbers of the actual "
            "period; dots: the paper's periods, thin lines: tenths of a ms, to 10 ms")
    (amplitude, period), (net, pcc), (spurious, window) = grid
    for method in TEMPORAL:
        curve(amplitude, table, method, "dominant_amplitude")
        curve(net, table, method, "net")
        curve(spurious, table, method, "spurious", 100)
        pick = table["method"] == method
        x, y, paper = table["period_ms"][pick], table["dominant_period_ms"][pick], table["papers_grid"][pick] > 0
        dense = x <= DENSE_MS
        period.plot(x[dense], 100 * (y / x - 1)[dense], color=METHODS[method], lw=0.6, alpha=0.45, zorder=1)
        period.plot(x[paper], 100 * (y / x - 1)[paper], MARKS[method], color=METHODS[method], ms=4, mew=0, zorder=3)
    amplitude.axhline(IDEAL, color=INK, lw=0.8, ls=(0, (4, 3)))
    say(amplitude, "4/\N{GREEK SMALL LETTER PI} N, the ideal", 36, IDEAL, "right", "bottom", 8.5, INK, 0, 4, "data")
    amplitude.set(ylim=(0.8, 1.36))
    amplitude.set_title("Dominant component: amplitude (N)")
    period.set_title("Dominant component: its period against the one asked for (%)")
    period.axhline(0, color=INK, lw=0.8, ls=(0, (4, 3)))
    net.set_title("Net force (N)")
    say(net, f"T1 {found['T1']['largest_net']:.3f} N at {found['T1']['at_ms']:g} ms\nT2 and T3: none, at any period",
        0.98, 0.95, "right", "top", 8.5, INK)
    draw_pcc(pcc, table)
    spurious.set_title("Power outside the dominant line and its odd harmonics (%)")
    draw_window(window, table)
    for ax in grid.flat:
        period_axis(ax, ax in grid[-1])
    handles = [Line2D([], [], ls="", marker=MARKS[m], color=METHODS[m], ms=6, label=f"{m}, {ABOUT[m]}")
               for m in TEMPORAL]
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.055, 0.0), ncol=3, frameon=False, fontsize=9.5,
                  labelcolor=INK, handletextpad=0.2)
    figure.subplots_adjust(left=0.065, right=0.985, top=0.89, bottom=0.1, hspace=0.3, wspace=0.14)
    return figure


FIGURES = {"signals": draw_signals, "coverage": draw_coverage, "temporal": draw_temporal}


def all_figures():
    """Including those of figures_*.py."""
    figures = dict(FIGURES)
    for path in sorted(glob.glob(os.path.join(os.path.dirname(os.path.abspath(__file__)), "figures_*.py"))):
        figures.update(importlib.import_module(os.path.splitext(os.path.basename(path))[0]).FIGURES)
    return figures


def draw(path):
    name, end = os.path.splitext(os.path.basename(path))
    figures = all_figures()
    if end != ".json" or name not in figures:
        raise BadInput(f"{path}: expected a study's JSON, one of {', '.join(f'{n}.json' for n in figures)}")
    try:
        with open_input(path) as file:
            data = json.load(file)
    except (OSError, ValueError) as error:
        raise BadInput(f"{path}: expected JSON, found: {getattr(error, 'strerror', None) or error}") from None
    try:
        return figures[name](data, os.path.dirname(path) or ".")
    except (KeyError, IndexError, TypeError) as error:
        raise BadInput(f"{path}: expected what `knurl study {name}` writes; missing or odd: {error!r}") from None


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("study", metavar="DIR/NAME.json", help="what `knurl study NAME --out DIR` wrote")
    parser.add_argument("--out", metavar="PNG", required=True, help="the picture to write")
    arguments = parser.parse_args()
    matplotlib.rcParams.update({**matplotlib.rcParamsDefault, **STYLE, "backend": "Agg"})
    try:
        save(draw(arguments.study), arguments.out)
    except BadInput as error:
        sys.exit(f"figures.py: {error}")


if __name__ == "__main__":
    main()
