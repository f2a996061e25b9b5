"""Cost and felt false tones of each method at each rate: one panel of study `tradeoff`.
Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from style import HALO, INK, METHODS, read_table

OWN = "#3a3a3a"  # of a method that style.py has no colour for
ABOUT = {"S1": "the surface at a point", "S2": "events, by the speed", "bandlimited": "the harmonics that fit"}
# Of labels: the point, the offset from it (in points), and the side.
PLACES = {"S1": (1, -44, -28, "left"), "S2": (3, 14, 34, "left"), "bandlimited": (1, 16, 20, "left")}
LOW, HIGH = 0.00003, 1.7


def lines(table, column):
    """{(method, velocity): [(millions of instructions a second, error, kHz)]}, the worse error of both ridges, with
    real encoders."""
    found = {}
    for row, method in enumerate(table["method"]):
        if table["positions"][row] == "0.055mm" and table["velocity"][row] != "ideal":
            rate = table["rate_hz"][row] / 1e3
            x = table["instructions_tick"][row] * rate / 1e3
            points = found.setdefault((method, table["velocity"][row]), {})
            points[rate] = (x, max(table[column][row], points.get(rate, (0, 0))[1]), rate)
    return {key: list(points.values()) for key, points in found.items()}


def others(table, method):
    """A method's other errors at 1 kHz from 0.055 mm counts by FOAW, the worse of both ridges."""
    rows = [row for row, name in enumerate(table["method"])
            if name == method and table["rate_hz"][row] == 1000 and table["positions"][row] == "0.055mm"
            and table["velocity"][row] in ("none", "foaw")]
    push, step, crest = (max(table[key][row] for row in rows) for key in ("mean_worst", "step", "crest"))
    wrong = ([f"pushes with {push:.2f} A"] if push > 0.01 else []) + ([f"{step:.0f} cycles\nout of step"] if step > 0.5 else [])
    return "\n".join([*wrong, f"crest {crest:.2f} A"])


def draw_line(ax, table, method, points, colour):
    xs, ys, rates = zip(*points)
    ax.plot(xs, ys, color=colour, lw=2.6, zorder=4, solid_capstyle="round")
    ax.plot(xs, ys, "o", color=colour, ms=7, zorder=5)
    for x, y, rate in points:
        under = rate < 10 if method == "S1" else rate > 2
        ax.annotate(f"{rate:g}" + (" kHz" if rate in (1, 10) else ""), (x, y), xytext=(0, -16 if under else 8),
                    textcoords="offset points", ha="center", fontsize=9.5, color=colour, zorder=6, path_effects=HALO)
    place, dx, dy, side = PLACES.get(method, (2, 8, 32, "left"))
    for text, style, below in ((method, {"fontsize": 14, "fontweight": "bold"}, 0),
                               (others(table, method), {"fontsize": 10, "linespacing": 1.1}, 9)):
        ax.annotate(text, (xs[place], ys[place]), xytext=(dx, dy - below), textcoords="offset points", color=colour,
                    zorder=6, ha=side, va="top" if below else "center", path_effects=HALO, **style)


def draw_shape(ax, heights, colour):
    ticks = range(len(heights) + 1)
    ax.fill_between(ticks, 0, [*heights, heights[-1]], step="post", color=colour, alpha=0.25, lw=0)
    ax.step(ticks, [*heights, heights[-1]], where="post", color=colour, lw=1.6)
    ax.axhline(0, color=INK, lw=0.6, alpha=0.5)
    ax.set(ylim=(-1.9, 1.7), xlim=(0, len(heights)), xticks=[], yticks=[])
    for side in ("left", "bottom"):
        ax.spines[side].set_visible(False)


def draw_speed_accuracy(data, folder):
    table = read_table(folder, data["table"])
    figure = plt.figure(figsize=(11, 6.4))
    ax = figure.add_axes((0.095, 0.105, 0.625, 0.7))
    above = lines(table, "felt_above")
    for (method, velocity), points in lines(table, "felt_worst").items():
        colour = METHODS.get(method, OWN)
        if velocity in ("none", "foaw"):
            draw_line(ax, table, method, points, colour)
            ax.plot([x for x, *_ in points], [y for _, y, _ in above[method, velocity]], "o", color=colour, ms=5,
                    mfc="none", alpha=0.7, zorder=3)
        elif velocity == "difference":
            ax.plot([x for x, *_ in points], [y for _, y, _ in points], color=colour, lw=1, alpha=0.5,
                    ls=(0, (1, 1.5)), zorder=2)
    ax.set(xscale="log", yscale="log", ylim=(LOW, HIGH), xlim=(0.17, 12))
    for axis, marks in ((ax.xaxis, (0.2, 0.5, 1, 2, 5, 10)), (ax.yaxis, (0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1))):
        axis.set_major_locator(FixedLocator(marks))
        axis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:g} %"))
    ax.tick_params(labelsize=11)
    ax.grid(True, axis="y", color="#eef1f2", lw=0.8, zorder=0)
    ax.set_xlabel("millions of instructions for a second of rendering", fontsize=12)
    ax.set_ylabel("felt power that is not the ridges', at the worst speed", fontsize=12)
    figure.text(0.02, 0.945, "How much is felt that is not the ridges, and for what cost", fontsize=17,
                fontweight="bold", va="center")
    figure.text(0.02, 0.875, f"not the ridges': farther than {100 * data['tolerance']:g} % of their frequency (at least "
                f"{data['tolerance_hz']:g} Hz) from its odd multiples, through a device in a hand and over the\n"
                "threshold of touch · the worse of ridges of 1 and 0.5 mm through an encoder of 0.055 mm, "
                f"{data['from_hz']:g} to {data['split_hz']:g} Hz; rings: to {data['to_hz']:g} Hz ·\n"
                "below a name: at 1 kHz, its step after 4 s of strokes · dotted: the speed by differences", fontsize=10,
                color=INK, alpha=0.75, va="center")
    shapes = data["shapes"]
    figure.text(0.755, 0.795, f"20 ms at {shapes['hz']:g} Hz and 1 kHz", fontsize=11, color=INK, alpha=0.75)
    names = [name for name in shapes if name != "hz"]
    room = min(1, 3 / len(names))
    for place, method in enumerate(names):
        small = figure.add_axes((0.755, 0.745 - room * (0.15 + 0.235 * place), 0.23, 0.15 * room))
        colour = METHODS.get(method, OWN)
        draw_shape(small, shapes[method], colour)
        small.set_title(f"{method}: {ABOUT.get(method, 'your own')}", fontsize=10.5, color=colour, pad=2)
    return figure


FIGURES = {"speed_accuracy": draw_speed_accuracy}
