"""A low-poly ring, felt as triangles and as smooth as it looks: study `smooth`. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
import numpy as np

from style import ACCENT, ASKED, GREY, INK, PALE, heading, read_table, say

KINDS = {"triangles": ("triangles", ASKED), "smooth": ("smooth", ACCENT)}


def draw_smooth(data, folder):
    table = read_table(folder, data["table"])
    figure, (along, across, cost) = plt.subplots(1, 3, figsize=(11, 3.7), gridspec_kw={"width_ratios": [1.25, 1.25, 1]})
    heading(figure, "A low-poly model, felt as its triangles and as it looks",
            f"a stroke 1 mm deep over a ring of {data['drawn']:.0f} triangles, 800 N/m, 100 mm/s; "
            "dashed: 0.8 N, the force of the ring itself")
    for ax in (along, across, cost):
        ax.set_axisbelow(True)
    for kind, (name, colour) in KINDS.items():
        pick = table["kind"] == kind
        order = 4 if kind == "smooth" else 3
        along.plot(table["mm"][pick], table["along"][pick], color=colour, lw=1.3, label=name, zorder=order)
        across.plot(table["mm"][pick], table["across"][pick], color=colour, lw=1.3, zorder=order)
        rows = [row for row in data["rows"] if row["kind"] == kind]
        cost.plot([row["triangles"] for row in rows], [row["step"] for row in rows], "o-", color=colour, ms=4, lw=1.2)
        for row in (rows[0], rows[-1]):
            say(cost, f"{row['degrees']:.2g}\N{DEGREE SIGN}", row["triangles"], row["step"], "center", "bottom", 8.5, colour, 0, 5,
                "data")
    along.axhline(0.8, color=INK, lw=0.8, ls=(0, (4, 3)), zorder=5)
    along.set_title("Force along the ring's normal (N)")
    across.set_title("Force across it (N): felt as edges")
    cost.set_title("Largest step between two ticks (N)")
    cost.set(xscale="log", yscale="log", xlabel="triangles; marks: mean angle off", xlim=(300, 4e4), ylim=(1e-3, 2))
    along.legend(loc="lower right", frameon=False, fontsize=9, labelcolor=INK)
    for ax in (along, across):
        ax.set(xlim=(0, np.nanmax(table["mm"])), xlabel="distance (mm)")
    for ax in (along, across, cost):
        ax.grid(True, color=PALE, lw=0.8, zorder=0)
        ax.tick_params(length=2, colors=GREY)
    along.set_ylim(0, None)
    across.set_ylim(0, None)
    figure.subplots_adjust(left=0.045, right=0.985, top=0.73, bottom=0.14, wspace=0.2)
    return figure


FIGURES = {"smooth": draw_smooth}
