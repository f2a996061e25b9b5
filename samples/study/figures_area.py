"""All methods at steady speeds, and `area` on grids over direction: study `area`. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
import numpy as np

from style import GREY, INK, METHODS, RULE, heading, read_table, say

PANELS = (("push", "mean force over 50 ms (A)", (0, 0.2)),
          ("level", "level of the ridges' line (A; 4/\u03c0 is meant)", (0.6, 1.6)),
          ("unevenness", "wavering: CV of the rms in 12.5 ms", (0, 0.15)),
          ("spurious", "false tones: share of the power below $f_h/2$", (0, 0.4)))
CANDIDATES = {"point": ("Eq. 11 at a point (S1)", METHODS["S1"], "-"), "place": ("its mean along the path", GREY, "-"),
              "way": ("mean over Eq. 12's way", METHODS["locked"], "--"),
              "axis": ("mean along an axis (area)", METHODS["area"], "-")}


def draw_area(data, folder):
    table = read_table(folder, data["table"])
    figure, grid = plt.subplots(2, 3, figsize=(12, 7.2))
    heading(figure, "Area, beside the others", "steady speeds at 1 kHz over 1 mm ridges, exact positions, "
            "means of five starts; right: a 1 mm checkerboard at 150 mm/s, over direction", 0.05)
    for ax, (key, title, limits) in zip((grid[0, 0], grid[0, 1], grid[1, 0], grid[1, 1]), PANELS):
        for row in data["steady"]:
            ax.plot(row["hz"], row[key], color=METHODS[row["method"]], lw=1.3, label=row["method"], clip_on=True)
        ax.set(ylim=limits, xlim=(20, 500))
        ax.set_title(title)
        ax.axvline(460, color=RULE, lw=0.8, ls=":")
    grid[0, 1].axhline(4 / np.pi, color=INK, lw=0.7, ls=(0, (4, 3)))
    say(grid[1, 0], "area hands over to events", 460, 0.14, "right", "center", 8, GREY, -4, 0, "data")
    for ax, key, title in ((grid[0, 2], "share", "share of the strongest line"),
                           (grid[1, 2], "push", "mean force over 50 ms (A)")):
        for name, (label, colour, style) in CANDIDATES.items():
            pick = table["candidate"] == name
            angles = np.unique(table["angle_deg"][pick])
            worst = np.min if key == "share" else np.max
            values = [worst(table[key][pick][table["angle_deg"][pick] == angle]) for angle in angles]
            ax.plot(angles, values, color=colour, ls=style, lw=1.4, label=label)
        ax.set(xlim=(0, 180), ylim=(0, None), xticks=range(0, 181, 45))
        ax.set_title(title + ", worst of three starts")
    for ax in grid[1, :2]:
        ax.set_xlabel("temporal frequency (Hz)")
    grid[1, 2].set_xlabel("direction (degrees)")
    for ax, left in ((grid[0, 0], 0.05), (grid[0, 2], 0.52)):  # below: there is room for no legend in the panels
        figure.legend(*ax.get_legend_handles_labels(), frameon=False, loc="lower left", bbox_to_anchor=(left, 0.0), ncols=2 if
                      left > 0.5 else 4, labelcolor=INK, fontsize=10)
    figure.subplots_adjust(left=0.05, right=0.985, top=0.845, bottom=0.175, hspace=0.34, wspace=0.18)
    return figure


FIGURES = {"area": draw_area}
