"""The figures of the studies device, gratings and preferences. Drawn by figures.py.

SPDX-License-Identifier: MIT
"""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap, TwoSlopeNorm
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, NullLocator

from style import ACCENT, ASKED, GREY, INK, METHODS, PALE, RULE, SHADES, heading, read_table, say

LOSS = LinearSegmentedColormap.from_list("loss", ["#fbf7f3", "#f3c9ae", "#d9662b", "#7c2f0d"])
DRIFT = LinearSegmentedColormap.from_list("drift", ["#7c2f0d", "#d9662b", "#f8f6f4", "#5fb0bb", "#093a4a"])
PERCENT = FuncFormatter(lambda value, _: f"{100 * value:.0f} %")
SIGNED = FuncFormatter(lambda value, _: f"{100 * value:+.0f} %".replace("+0 ", "0 "))


def panel(figure, left, bottom, width, height, title):
    """Axes at inches from the figure's lower left corner."""
    w, h = figure.get_size_inches()
    ax = figure.add_axes([left / w, bottom / h, width / w, height / h])
    ax.set_title(title, color=INK, pad=7)
    ax.tick_params(length=2)
    return ax


def bar(figure, image, left, bottom, height, formatter, label):
    w, h = figure.get_size_inches()
    axes = figure.add_axes([left / w, bottom / h, 0.09 / w, height / h])
    colours = figure.colorbar(image, cax=axes, format=formatter)
    colours.outline.set_visible(False)
    colours.ax.tick_params(length=0)
    colours.ax.yaxis.set_minor_locator(NullLocator())
    colours.ax.set_title(label, fontsize=8.5, color=GREY, pad=5, loc="center")
    return colours


def values(list_):
    return np.array([np.nan if v is None else v for v in list_], float)


# --- device ---------------------------------------------------------------------------------------------------------

def draw_bench(ax, fixture, data):
    """The bench as a sketch: motor force on a mass, held by spring and damper on a sensor."""
    ax.set_xlim(0, 10)
    ax.set_ylim(0, 4.4)
    ax.set_aspect("equal")
    ax.axis("off")
    line = {"color": INK, "lw": 1.3, "solid_capstyle": "round"}
    ax.add_patch(plt.Rectangle((0.5, 0.15), 4.4, 0.55, fc=RULE, ec="none"))
    ax.text(2.7, 0.42, "force sensor", ha="center", va="center", fontsize=8.5)
    zig = np.linspace(0.7, 2.3, 11)
    ax.plot(1.7 + 0.22 * np.array([0, 0, 1, -1, 1, -1, 1, -1, 1, 0, 0]), zig, **line)
    for xs, ys in (([3.7, 3.7], [0.7, 1.2]), ([3.35, 3.35, 4.05, 4.05], [1.75, 1.2, 1.2, 1.75]), ([3.45, 3.95], [1.55, 1.55]),
                   ([3.7, 3.7], [1.55, 2.3])):
        ax.plot(xs, ys, **line)
    ax.add_patch(plt.Rectangle((1.1, 2.3), 3.2, 0.85, fc=SHADES(0.25), ec=INK, lw=1.2))
    ax.text(2.7, 2.72, f"{1e3 * data['mass_kg']:.0f} g", ha="center", va="center", fontsize=9)
    ax.annotate("", (2.7, 3.15), (2.7, 4.25), arrowprops={"arrowstyle": "-|>", "color": ASKED, "lw": 1.6})
    ax.text(3.0, 3.85, "commanded force, 1 N, held at 1 kHz", fontsize=8.5, color=ASKED, va="center")
    ax.text(4.6, 2.72, f"dry friction {data['coulomb_n']:g} N,\nviscous {fixture['viscous_n_s_per_m']:g} N s/m (fitted)",
            fontsize=8.5, va="center", color=GREY)
    ax.text(5.1, 1.35, f"{1e-3 * fixture['stiffness_n_per_m']:.0f} N/mm, {fixture['damping_n_s_per_m']:.1f} N s/m\n(assumed)",
            fontsize=8.5, va="center", color=GREY)
    ax.text(5.1, 0.42, "40 kHz, no quantisation", fontsize=8.5, va="center", color=GREY)


def periods(ax, last=True):
    ax.set_xlim(1, 36)
    ax.set_xticks([2, 5, 10, 15, 20, 25, 30, 35])
    if last:
        ax.set_xlabel("temporal period T (ms)")


def by_method(ax, fixture, key, period, marks=True):
    for name, marker, size in (("T1", "s", 4.4), ("T2", "^", 4.6), ("T3", "o", 3.4)):
        ax.plot(period, values(fixture[name][key]), color=METHODS[name], lw=1.1, marker=marker if marks else None, ms=size,
                label=name, zorder=3)


def draw_others(ax, data):
    for fixture in data["fixtures"]:
        fitted = fixture is data["fixtures"][0]
        ax.plot(fixture["period_ticks"], values(fixture["T3"]["dominant"]), color=METHODS["T3"] if fitted else GREY,
                lw=1.4 if fitted else 1.0, ls="-" if fitted else "--")
    for fixture in data["fixtures"][1:]: # labelled at its peak
        k = int(np.argmax(values(fixture["T3"]["dominant"])))
        say(ax, f"{fixture['resonance_hz']:.0f} Hz", fixture["period_ticks"][k], fixture["T3"]["dominant"][k], va="bottom", dx=-4, dy=2,
            within="data")
    ax.axhline(4 / np.pi, color=ASKED, lw=0.9, ls=(0, (4, 3)))
    ax.set_ylim(0, 5.8)
    say(ax, "dashed: losing 0.5 N s/m instead, ringing at 75, 150, 300 Hz", 0.99, 1.0, "right", "top", 8)
    ax.set_ylabel("T3 (N)", labelpad=12)


def draw_device(data, _folder):
    """Figure 11 on the simulated bench."""
    figure = plt.figure(figsize=(10, 9.1))
    fixture = data["fixtures"][0]
    period = fixture["period_ticks"]
    heading(figure, "Through a simulated Touch: figure 11",
            "A simulation, not a measurement: the paper fixed a Phantom Omni to a Nano17 force sensor; one mass stands in for"
            " it here.")
    ax = panel(figure, 0.75, 5.35, 4.6, 2.7, "(a) Dominant component of the measured force")
    ax.plot(period, values(fixture["T3"]["commanded"]), color=ASKED, lw=0.9, ls=(0, (4, 3)))
    by_method(ax, fixture, "dominant", period)
    ax.set_ylim(0, 1.4)
    ax.set_ylabel("amplitude (N)")
    say(ax, "T3 as commanded", 0.98, 1.29, "right", "bottom", color=ASKED, within=("axes fraction", "data"))
    ax.legend(frameon=False, ncols=3, loc="lower right", handlelength=1.6, columnspacing=1.2)
    say(ax, "T2's odd periods come\nthrough better than T1's,\nT3's below 6 ms", 0.35, 0.30, "left", "top")
    periods(ax, False)
    ax = panel(figure, 0.75, 1.2, 4.6, 3.2, "(b) Net force")
    by_method(ax, fixture, "net_without_bias_correction", period)
    for name in ("T1", "T2", "T3"):
        ax.plot(period, values(fixture[name]["net"]), color=METHODS[name], lw=0.8, ls=":")
    n = np.linspace(3, 35, 200)
    ax.plot(n, 1 / n, color=ASKED, lw=0.9, ls=(0, (4, 3)), zorder=1)
    say(ax, "A/N, what T1 commands at odd N", 7.0, 0.165, "left", color=ASKED, within="data")
    say(ax, "dotted: less the mean at rest before and after,\nas the paper does (dry friction holds some)", 0.99, 0.97, "right",
        "top")
    ax.axhline(0, color=RULE, lw=0.8, zorder=0)
    ax.set_ylabel("mean force (N)")
    periods(ax)
    ax = panel(figure, 6.05, 3.55, 3.75, 1.75, "(c) Correlation (PCC) of the measured forces")
    for key, colour, mark, size in (("pcc_T1_T3", INK, "o", 6), ("pcc_T2_T3", ACCENT, "D", 3.5)):
        ax.plot(period, values(fixture[key]), mark, color=colour, ms=size, mfc="none" if size > 5 else colour, clip_on=False)
    ax.set_ylim(-0.08, 1.08)
    say(ax, "T1 and T3 (rings): alike, but for 2.5 ms", 0.98, 0.84, "right", "center", 8.5, INK)
    say(ax, "T2 and T3 (diamonds): alike at even periods,\nunrelated at odd ones", 0.98, 0.3, "right", "center", 8.5, ACCENT)
    periods(ax, False)
    draw_others(panel(figure, 6.05, 1.2, 3.75, 1.6, "(d) The same from other benches: dominant component"), data)
    periods(figure.axes[-1])
    draw_bench(panel(figure, 5.75, 5.9, 4.1, 2.2, ""), fixture, data)
    claims = fixture["claims"]
    two, three = claims["pcc_t1_t3_2_and_3_ticks"]
    figure.text(0.075, 0.025, f"PCC of T1 and T3: {two:.4f} at 2 ms, where both command the same numbers, {three:.4f} at 3 ms; the"
                " paper measured less than 1 at both.\nNo device without noise can do that at 2 ms. Drive losses are fitted to the"
                " paper's words (amplitudes \"often well below\"), not to its figure.", fontsize=8.5, color=GREY)
    return figure


# --- gratings -------------------------------------------------------------------------------------------------------

def draw_checkerboard(ax):
    """Figure 6 (a): Eq. 11 at 1000 x 500 cycles/m, three scans."""
    x, y = np.meshgrid(np.linspace(-0.25, 2.75, 600), np.linspace(-0.5, 3.5, 800))
    ax.imshow(np.cos(2 * np.pi * x) * np.cos(np.pi * y) >= 0, extent=(-0.25, 2.75, -0.5, 3.5), origin="lower",
              cmap=LinearSegmentedColormap.from_list("two", [PALE, "#b9dde0"]), interpolation="nearest", aspect="equal")
    for end, colour, words, at in (((2.6, 0.0), INK, "0°", (2.35, 0.12)), ((1.62, 3.24), ASKED, "63.4°: silent", (0.62, 2.75)),
                                   ((2.3, 2.3), INK, "45°", (2.25, 1.72))):
        ax.annotate("", end, (0, 0), arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.4, "shrinkA": 0})
        ax.text(*at, words, color=colour, fontsize=8.5, ha="center")
    ax.set_xlabel("x (mm)")
    ax.set_ylabel("y (mm)", labelpad=1)


def draw_directions(ax, grating, first):
    angle = np.array(grating["angle_deg"])
    ax.plot(angle, 1e-3 * values(grating["eq11"]), color=METHODS["S1"], lw=1.6, label="Eq. 11: what S1 meets")
    ax.plot(angle, 1e-3 * values(grating["eq12"]), color=METHODS["S2"], lw=1.6, label="Eq. 12: what S2 plays")
    ax.plot(angle[4::8], 1e-3 * values(grating["s1_played"])[4::8], "o", color=METHODS["S1"], ms=3.2, label="S1 at 100 mm/s: played")
    silent = int(np.argmin(np.abs(angle - grating["diagonal_deg"])))
    ax.plot([angle[silent]], [1e-3 * grating["s1_played_through_centres"][silent]], "o", mfc="white", mec=ASKED, mew=1.4, ms=6,
            clip_on=False, label="S1 through cells' centres")
    ax.set_ylim(0, 2.15)
    ax.set_xlim(0, 90)
    ax.set_xticks([0, 30, 60, 90], ["0°", "30°", "60°", "90°"])
    ax.set_xlabel("scan direction")
    if first:
        ax.set_ylabel("cycles per mm")
        ax.legend(frameon=False, fontsize=8, loc="lower left", handlelength=1.5, borderaxespad=0.1, labelspacing=0.3)
    else:
        ax.tick_params(labelleft=False)
        say(ax, "silent", angle[silent], 0.1, "left", dx=8, color=ASKED, within="data")


def draw_map(figure, ax, table, key, cmap, norm, place, formatter, label):
    angles, speeds = np.unique(table["angle_deg"]), np.unique(table["speed"])
    grid = table[key].reshape(len(angles), len(speeds))
    image = ax.imshow(grid, extent=(0, 1205, -1, 91), origin="lower", aspect="auto", cmap=cmap, norm=norm,
                      interpolation="nearest")
    ax.set_yticks([0, 30, 60, 90], ["0°", "30°", "60°", "90°"])
    ax.set_xlabel("speed (mm/s)")
    ax.set_ylabel("scan direction", labelpad=2)
    ax.axvline(250, color=INK, lw=0.8, ls=(0, (2, 2)))
    angle = np.linspace(0, 90, 300) * np.pi / 180
    limit = 500 / (np.cos(angle) + 0.5 * np.sin(angle) if key == "s1_dropout" else np.maximum(np.cos(angle), 0.5 * np.sin(angle)))
    ax.plot(limit, angle * 180 / np.pi, color=INK, lw=1.0)
    ax.set_xlim(0, 1205)
    ax.set_ylim(-1, 91)
    bar(figure, image, *place, formatter, label)


def draw_line(ax, speeds):
    ax.plot(np.array(speeds["s1"]["ft"]) / 1e3, values(speeds["s1"]["dropout"]), color=METHODS["S1"], lw=1.3)
    ax.axvspan(0, 0.5, color=PALE, lw=0, zorder=-1)
    ax.set_xlim(0, 2.2)
    ax.set_ylim(0, 1.15)
    ax.yaxis.set_major_formatter(PERCENT)
    ax.set_xlabel("temporal frequency over update rate, $f_t/f_h$")
    ax.set_ylabel("half cycles never played", labelpad=2)
    for n in (1, 2):
        say(ax, "silent", n, 1.0, va="bottom", dy=2, color=ASKED, within="data")
    say(ax, "no loss\nbelow $f_h$/2", 0.25, 0.5, color=GREY, within="data")


def draw_drift(ax, speeds):
    f, drift = np.array(speeds["s2"]["ft"]), values(speeds["s2"]["drift"])
    ax.axhline(0, color=RULE, lw=0.8)
    ax.fill_between(f, drift, 0, color=METHODS["S2"], alpha=0.25, lw=0)
    ax.plot(f, drift, color=METHODS["S2"], lw=1.2)
    ax.set_xlim(20, 500)
    ax.set_ylim(-0.18, 0.215)
    ax.yaxis.set_major_formatter(SIGNED)
    ax.set_xlabel("temporal frequency at 1 kHz (Hz)")
    ax.set_ylabel("played / crossed \N{MINUS SIGN} 1", labelpad=2)
    edge = 1000 / 3.5
    say(ax, f"{100 * speeds['s2_drift_below_3_5_ticks']:+.1f} % just below T = 3.5 ticks", edge, 0.19, "left", "center", dx=-60,
        color=INK, within="data")
    say(ax, f"\N{MINUS SIGN}{-100 * speeds['s2_drift_at_3_5_ticks']:.1f} % at it", edge, -0.128, "right", "center", dx=-8,
        color=INK, within="data")
    say(ax, "6-tick mix, 2.4 cycles", 405, -0.135, color=GREY, within="data")


def draw_freeze(ax, rest):
    t = np.arange(len(rest["crossed"])) * rest["step_s"]
    ax.plot(t, rest["crossed"], color=RULE, lw=4)
    ax.plot(t, rest["s1_played"], color=METHODS["S1"], lw=1.2)
    ax.plot(t, rest["s2_played"], color=METHODS["S2"], lw=1.8)
    ax.set_xlim(0, t[-1])
    ax.set_ylim(-6, 310)
    ax.set_xlabel("time (s)")
    ax.set_ylabel("cycles", labelpad=2)
    say(ax, "crossed (grey); S1 plays them all", 1.3, 205, "right", color=METHODS["S1"], within="data")
    say(ax, f"S2: one event of {rest['first_event_s']:.2f} s,\n{rest['crossed_by_then']:.0f} cycles crossed meanwhile", 1.35, 40,
        "center", color=METHODS["S2"], within="data")


def draw_depths(ax, depths):
    styles = {4.0: ("even", GREY), 5.0: ("5 ticks", "#8cc3cb"), 3.0: ("3 ticks", METHODS["S2"]), 2.5: ("mix (400 Hz)", ASKED)}
    for event in depths["events"]:
        words, colour = styles[event["period_ticks"]]
        ax.plot(depths["depth"], event["net"], color=colour, lw=1.5, label=f"{words}: {event['depth_needed']:.2f} A")
        ax.plot([event["depth_needed"]], [0], "o", color=colour, ms=4.5, clip_on=False, zorder=4)
    ax.set_xlim(0, 2)
    ax.set_ylim(0, 0.52)
    ax.set_xlabel("depth of the HIP below the smooth surface (A)")
    ax.set_ylabel("net force (K A)", labelpad=2)
    ax.legend(frameon=False, fontsize=8.5, handlelength=1.4, title="no net force from", title_fontsize=8.5, borderaxespad=0)


def draw_gratings(data, folder):
    """Figure 6 and section III."""
    figure = plt.figure(figsize=(10, 12.8))
    table = read_table(folder, "gratings.csv")
    heading(figure, "Gratings S1 and S2 over direction, speed and depth",
            "Section III at a 1 kHz update rate, ideal positions and velocities. S1 looks the height up; S2 plays whole events.")
    draw_checkerboard(panel(figure, 0.62, 9.2, 1.85, 2.5, "(a) Eq. 11, 1000 × 500 /m"))
    for left, grating, name, first in ((3.15, data["directions"][0], "(b) 1000 × 500 cycles/m", True),
                                       (6.6, data["directions"][1], "(c) 1000 × 1000 cycles/m", False)):
        draw_directions(panel(figure, left, 9.2, 3.15, 2.5, name), grating, first)
    lost = panel(figure, 0.75, 6.1, 3.45, 2.2, "(d) S1: half cycles never played, 1000 × 500")
    draw_map(figure, lost, table, "s1_dropout", LOSS, plt.Normalize(0, 1), (4.3, 6.1, 2.2), PERCENT, "")
    drift = panel(figure, 5.65, 6.1, 3.45, 2.2, "(e) S2: cycles played against Eq. 12, 1000 × 500")
    draw_map(figure, drift, table, "s2_drift", DRIFT, TwoSlopeNorm(0, -0.6, 0.18), (9.2, 6.1, 2.2), SIGNED, "")
    for ax in (lost, drift):
        say(ax, "scans reach\n250 mm/s", 235, 87, "right", "top", 8, INK, within="data", halo=True)
    say(lost, "crossings above $f_h$/2", 830, 30, color="white", within="data")
    say(drift, "$f_t$ above $f_h$/2", 830, 30, color="white", within="data")
    draw_line(panel(figure, 0.75, 3.4, 3.95, 1.85, "(f) S1, straight across"), data["speeds"])
    draw_drift(panel(figure, 5.65, 3.4, 3.95, 1.85, "(g) S2, straight across"), data["speeds"])
    draw_freeze(panel(figure, 0.75, 0.6, 3.95, 1.85, "(h) From rest to 250 mm/s in 0.5 s on a 2 mm grating"),
                data["strokes"]["from_rest"])
    draw_depths(panel(figure, 5.65, 0.6, 3.95, 1.85, "(i) S2's net force under one-sided contact (Eq. 9)"), data["depths"])
    return figure


# --- preferences ----------------------------------------------------------------------------------------------------

LABELS = {"net_force_n": "net force (N)", "spurious_n": "spurious (N rms)", "spurious_share": "spurious energy (share)",
          "dropout_share": "dropout (share)", "frequency_error": "frequency error (share)"}


def draw_cells(ax, experiment):
    """Figure 8: one row per intensity and sound, one column per period."""
    cells = experiment["cells"]
    period, amplitude = np.array(cells["period_ticks"]), np.array(cells["amplitude"])
    sound, preferred = np.array(cells["sound"]), np.array(cells["preferred"])
    columns, levels = np.unique(period)[::-1], np.unique(amplitude)
    rows = [(level, s) for level in levels for s in (0, 1)]
    for p, a, s, wanted in zip(period, amplitude, sound, preferred):
        x, y = int(np.flatnonzero(columns == p)[0]), rows.index((a, s))
        ax.add_patch(plt.Rectangle((x - 0.44, y - 0.4), 0.88, 0.8, fc=METHODS["T3"] if wanted else PALE, ec="none"))
    ax.set_xlim(-0.6, len(columns) - 0.4)
    ax.set_ylim(-0.6, 3.6)
    ax.set_yticks(range(4), [f"{a:g} N, {'sound' if s else 'no sound'}" for a, s in rows])
    ax.set_xticks(range(len(columns)), [f"{1000 / p:.3g}" for p in columns])
    ax.set_xlabel("temporal frequency (Hz)")
    ax.tick_params(length=0)
    for side in ("left", "bottom"):
        ax.spines[side].set_visible(False)


def is_bare(experiment, key):
    """True if a metric has fewer than three values: then a scatter is not drawn."""
    return len(np.unique(np.round(values(experiment["cells"][key]), 9))) < 3


def bare_words(experiment, key, pair):
    part = experiment["correlation_with_preferred"]["all"][key]
    name = LABELS[key].split(" (")[0]
    if part["spearman"] is None:
        return f"{name}: the same\nof {pair} in every cell"
    return f"{name}: the same of {pair}\nbut at 400 Hz; \u03c1 {part['spearman']:+.2f}"


def draw_metric(ax, experiment, key, label):
    """Cells by metric: preferred ones above, others below, those with sound a little higher."""
    cells = experiment["cells"]
    x, sound, preferred = np.round(values(cells[key]), 12) + 0.0, np.array(cells["sound"]), np.array(cells["preferred"])
    y = preferred + 0.16 * (sound - 0.5) * 2
    for s, face in ((0, "white"), (1, None)):
        for wanted, colour in ((0, GREY), (1, METHODS["T3"])):
            use = (sound == s) & (preferred == wanted)
            ax.scatter(x[use], y[use], s=22, facecolor=face or colour, edgecolor=colour, linewidth=1.1, alpha=0.85, zorder=3,
                       clip_on=False)
    ax.axvline(0, color=RULE, lw=0.8, zorder=0)
    ax.set_ylim(-0.5, 1.5)
    ax.set_xlabel(label, labelpad=2)
    ax.set_yticks([0, 1], ["neither", "T3"])
    ax.spines["left"].set_visible(False)
    ax.tick_params(axis="y", length=0)
    part = experiment["correlation_with_preferred"]["all"][key]
    say(ax, f"ρ {part['spearman']:+.2f}   τ {part['kendall_tau_b']:+.2f}   separates {100 * part['separation']:.1f} %", 0.5, 1.01,
        "center", "bottom", 8.5, INK)


def draw_experiment_3(ax, gratings, key, label):
    counts = gratings["preferred_s2_of_12"]
    x = np.arange(3)
    for name, shift in (("S1", -0.19), ("S2", 0.19)):
        ax.bar(x + shift, values(gratings[name][key]), 0.34, color=METHODS[name])
    ax.set_xticks(x, [f"{p:g} mm\n{c:.0f} of 12" for p, c in zip(gratings["period_mm"], counts)])
    ax.set_title(f"{label}", fontsize=9, pad=5)
    ax.yaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{100 * v:.3g} %"))
    ax.tick_params(axis="x", length=0)


def draw_preferences(data, _folder):
    """Figure 8 and Experiment 3."""
    figure = plt.figure(figsize=(10, 11.0))
    heading(figure, "What subjects preferred, beside these metrics",
            "Published verdicts (significant at 28 of 36 trials; the counts are not in the text) against metrics of the medium"
            " vibration.")
    shown = ("net_force_n", "spurious_share", "dropout_share")
    for experiment, top in zip(data["experiments"], (10.05, 6.5)):
        number, other = experiment["experiment"], experiment["other"]
        ax = panel(figure, 1.45, top - 1.15, 8.3, 1.0, f"Experiment {number}, {other} against T3: T3 preferred in"
                   f" {experiment['preferred_cells']} of 48 cells, {other} in none")
        draw_cells(ax, experiment)
        for i, key in enumerate(shown):
            if is_bare(experiment, key):
                figure.text((0.75 + 3.1 * i) / 10, (top - 2.3) / 11, bare_words(experiment, key, f"{other} and T3"), fontsize=9,
                            color=GREY, va="center")
                continue
            ax = panel(figure, 0.75 + 3.1 * i, top - 2.7, 2.7, 0.75, "")
            draw_metric(ax, experiment, key, f"{other} \N{MINUS SIGN} T3: {LABELS[key]}")
            if i:
                ax.tick_params(labelleft=False)
    handles = [Line2D([], [], marker="o", ls="", mfc=METHODS["T3"], mec=METHODS["T3"], ms=5, label="T3 preferred"),
               Line2D([], [], marker="o", ls="", mfc=GREY, mec=GREY, ms=5, label="neither preferred"),
               Line2D([], [], marker="o", ls="", mfc="white", mec=INK, ms=5, label="hollow: without sound"),
               plt.Rectangle((0, 0), 1, 1, fc=METHODS["S1"], label="S1"), plt.Rectangle((0, 0), 1, 1, fc=METHODS["S2"], label="S2")]
    figure.legend(handles=handles, frameon=False, ncols=5, loc="lower left", bbox_to_anchor=(0.055, 0.002), columnspacing=1.6,
                  handlelength=1.2)
    gratings = data["experiment_3"]
    rho = gratings["spearman_with_preferred"]
    figure.text(0.075, 2.85 / 11.0, "Experiment 3, S1 against S2: S2 preferred by 12, 11 and 7 of 12; means over steady 5 to 250"
                " mm/s", fontsize=9.5)
    for i, (key, words) in enumerate((("push", "net force over 0.1 s (K A)"), ("spurious_share", "spurious energy"),
                                      ("dropout_share", "dropout"))):
        ax = panel(figure, 0.75 + 3.1 * i, 1.05, 2.7, 1.3, "")
        draw_experiment_3(ax, gratings, key, f"{words}: ρ {rho[key]:+.0f} (3 cells)")
    return figure


FIGURES = {"device": draw_device, "gratings": draw_gratings, "preferences": draw_preferences}
