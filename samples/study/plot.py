#!/usr/bin/python3
"""Draws the CSV of `knurl run ... --out RUN.csv` as one picture.

Top left the path, coloured by speed, over the grating if that is coarse enough to draw (a stroke along one line is
unfolded in time); top right a few milliseconds of the height map. Below, over time: height map, force, the temporal
frequency f_t of the motion, and a spectrogram of the force with f_t as a thin line. Grey: no contact.

SPDX-License-Identifier: MIT
"""
import argparse
import csv
import os
import sys
from types import SimpleNamespace

try:
    import matplotlib
    import numpy as np
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection
    from matplotlib.colors import LinearSegmentedColormap

    from style import ACCENT, ASKED, GREY, INK, PALE, RULE, SHADES, SOFT, STYLE, BadInput, open_input, save, say
except ImportError as missing:
    sys.exit(f"plot.py: {missing} for {sys.executable}; apt-get install python3-matplotlib, then use /usr/bin/python3")

COLUMNS = "t,x,y,z,vx,vy,surface,depth,fs,ft,height,fx,fy,fz".split(",")
HAPTIC_RANGE = (20.0, 500.0)  # Hz
TOUCH_MAX_FORCE = 3.3         # N
SPEEDS = LinearSegmentedColormap.from_list("speeds", SHADES([0.25, 0.5, 0.75, 1.0]))
STRIPES = LinearSegmentedColormap.from_list("stripes", ["#e3e9eb", "#ffffff"])


def parse(path, reader):
    """Numbers (rows x 13) and surface names (rows) of a run's CSV."""
    header = next(reader, [])
    if header != COLUMNS:
        raise BadInput(f"{path}: expected the header {','.join(COLUMNS)}, "
                       f"found {repr(','.join(header)[:100]) if header else 'an empty file'}")
    rows, names, surface = [], [], COLUMNS.index("surface")
    for cells in reader:
        if len(cells) != len(COLUMNS):
            raise BadInput(f"{path}: line {reader.line_num}: expected {len(COLUMNS)} cells, found {len(cells)}")
        names.append(cells.pop(surface))  # remove the apostrophe before a formula or the word "none"
        try:
            rows.append([float(cell or "nan") for cell in cells])
        except ValueError as error:
            raise BadInput(f"{path}: line {reader.line_num}: expected numbers, found: {error}") from None
    return np.array(rows, float).reshape(-1, len(COLUMNS) - 1), np.array(names, object)


def read_run(path):
    """Reads and checks a run. Rows without a time are left out; values that are not finite become NaN."""
    try:
        with open_input(path, newline="") as file:
            data, names = parse(path, csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"{path}: expected a CSV file, found: {getattr(error, 'strerror', None) or error}") from None
    data[~np.isfinite(data)] = np.nan
    data, names = data[np.isfinite(data[:, 0])], names[np.isfinite(data[:, 0])]
    if not len(data):
        raise BadInput(f"{path}: expected at least one row with a time, found none")
    steps = np.diff(data[:, 0])
    if np.any(steps <= 0):
        raise BadInput(f"{path}: expected t to ascend, "
                       f"found another step after t = {data[np.argmax(steps <= 0), 0]:g} s")
    run = SimpleNamespace(**dict(zip([c for c in COLUMNS if c != "surface"], data.T)))
    run.name, run.touching = names, names != "none"
    run.position, run.force = data[:, 1:4], np.linalg.norm(data[:, -3:], axis=1)
    run.speed = np.where(run.touching, np.hypot(run.vx, run.vy), np.nan)
    run.ft, run.height = (np.where(run.touching, values, np.nan) for values in (run.ft, run.height))
    run.rate = 1 / np.median(steps) if len(steps) else None
    return run


def most(values, otherwise=0.0):
    """The largest finite value."""
    return float(np.nanmax(values)) if np.isfinite(values).any() else otherwise


def thin(t, y, count=6000):
    """A curve of about `count` points: the lowest and the highest of each stretch, so that no peak is lost."""
    if len(t) <= count:
        return t, y
    size = -(-2 * len(t) // count)
    blocks = y[:len(y) // size * size].reshape(-1, size)
    peaks = np.stack([np.fmin.reduce(blocks, axis=1), np.fmax.reduce(blocks, axis=1)], axis=1)
    return np.repeat(t[:blocks.size:size], 2), peaks.ravel()


def smooth(values, run, seconds):
    """Mean over the time around each tick; NaN are left out, and remain."""
    kernel, there = np.ones(max(1, min(int(seconds * (run.rate or 0)), len(values)))), np.isfinite(values)
    total = np.convolve(np.where(there, values, 0.0), kernel, "same")
    return np.where(there, total / np.maximum(np.convolve(there * 1.0, kernel, "same"), 1.0), np.nan)


def view(run):
    """(axes, unfolded): the two scene axes in which the hand moved most, or only one if it moved along a line."""
    points = run.position[run.touching] if run.touching.any() else run.position
    extent = np.nan_to_num(np.array([most(p) + most(-p) for p in points.T]))
    order = np.argsort(-extent, kind="stable")
    line = extent[order[1]] < max(0.06 * extent[order[0]], 2e-4)
    return (order[:1] if line else np.sort(order[:2])), bool(line)


def gratings(run, axes):
    """[(direction in the view, period in m)] of the grating, as far as it follows from the motion."""
    if len(run.t) < 20:
        return []
    v, surface_v = np.gradient(run.position[:, axes], run.t, axis=0), np.stack([run.vx, run.vy], axis=1)
    use = (run.speed > 0.005) & np.isfinite(v).all(axis=1) & np.isfinite(run.ft)
    v, surface_v, ft, found = v[use], surface_v[use], run.ft[use], []
    if len(v) < 20:
        return []
    for i, direction in enumerate(np.linalg.lstsq(surface_v, v, rcond=1e-6)[0]):
        along, across = np.abs(surface_v[:, i]), np.abs(surface_v[:, 1 - i])
        best = np.argsort(across / np.maximum(along, 1e-9), kind="stable")[:max(20, len(v) // 20)]
        best = best[across[best] < 0.25 * along[best]]  # f_t there is this direction's frequency times its speed
        frequency = np.median(ft[best] / along[best]) if len(best) else 0.0
        if frequency > 0 and 0.9 < np.linalg.norm(direction) < 1.1:
            found.append((direction / np.linalg.norm(direction), 1 / frequency))
    return [(direction, period) for direction, period in found if period < 5 * min(p for _, p in found)]


def draw_grating(ax, found, over_time=False):
    """Stripes behind the path (axes in mm), a ridge at the scene's origin. Returns words for the title."""
    if not found:
        return ""
    box, (left, right), (bottom, top) = ax.get_window_extent(), ax.get_xlim(), ax.get_ylim()
    periods = [period * 1e3 for _, period in found]
    size = box.height / abs(top - bottom) if over_time else box.width / abs(right - left)
    if size * min(periods) >= 4:  # pixels a period
        x, y = np.meshgrid(np.linspace(left, right, int(box.width)), np.linspace(bottom, top, int(box.height)))
        waves = [np.cos(2 * np.pi * sum(p * d for p, d in zip((y, x) if over_time else (x, y), direction)) / period)
                 for (direction, _), period in zip(found, periods)]
        ax.imshow(np.tanh(2.5 * np.prod(waves, axis=0)), extent=(left, right, bottom, top), origin="lower",
                  aspect="auto", cmap=STRIPES, zorder=0)
    return f", over a {' x '.join(f'{p:.3g}' for p in periods)} mm {'grating' if len(found) < 2 else 'grid'}"


def frame(ax, x, y, equal):
    """Limits around the points with a margin, in true proportions if `equal`."""
    low, high = np.array([[-most(-v), most(v)] for v in (x, y)]).T
    half, middle = np.maximum(0.56 * (high - low), 0.05), (high + low) / 2
    if equal:
        box = ax.get_window_extent()
        size = np.array([box.width, box.height])
        half = size * np.max(half / size)
    ax.set_xlim(middle[0] - half[0], middle[0] + half[0])
    ax.set_ylim(middle[1] - half[1], middle[1] + half[1])


def draw_path(ax, bar, run):
    axes, unfolded = view(run)
    x, y = run.t if unfolded else run.position[:, axes[0]] * 1e3, run.position[:, axes[0 if unfolded else 1]] * 1e3
    shown = run.touching if run.touching.any() and not unfolded else np.ones_like(run.touching)
    frame(ax, x[shown], y[shown], equal=not unfolded)
    if list(axes) == [0, 2]:  # z runs down the page, as seen from above
        ax.invert_yaxis()
    felt = f" coloured by speed{draw_grating(ax, gratings(run, axes), unfolded)}" if run.touching.any() else ", free of contact"
    ax.set_title(("Stroke" if unfolded else "Path") + felt)
    ax.plot(x, y, color="#aab5ba", lw=0.8, zorder=1)
    points = np.stack([x, y], axis=1)[::-(-len(x) // 20000)]
    speed = run.speed[::-(-len(x) // 20000)] * 1e3
    lines = LineCollection(np.stack([points[:-1], points[1:]], axis=1), cmap=SPEEDS, array=speed[:-1], lw=2,
                           capstyle="round")
    lines.set_clim(0, max(most(run.speed) * 1e3, 1.0))
    ax.add_collection(lines, autolim=False)
    ax.plot(x[:1], y[:1], "o", ms=5, mfc="white", mec=INK, mew=1.2, zorder=3)
    ax.set_xlabel("time (s)" if unfolded else f"{'xyz'[axes[0]]} (mm)")
    ax.set_ylabel(f"{'xyz'[axes[0 if unfolded else 1]]} (mm)")
    colour_bar(lines, bar, "mm/s")
    bar.set_visible(run.touching.any())


def colour_bar(drawn, ax, label):
    ax.figure.colorbar(drawn, cax=ax).outline.set_visible(False)
    ax.tick_params(length=2, labelsize=8)
    ax.set_title(label, fontsize=8.5, color=GREY, pad=5)


def choose_moment(run):
    """(from, to) in s: about eight periods at the highest sustained f_t, or None."""
    asked = smooth(np.where((run.height != 0) & (run.ft > 0), run.ft, np.nan), run, 0.4)
    if not run.rate or not np.isfinite(asked).any():
        return None
    half = min(max(4 / most(asked), 6 / run.rate, 0.004), 0.1)
    middle = run.t[np.nanargmax(asked)]
    return max(middle - half, run.t[0]), min(middle + half, run.t[-1])


def draw_moment(ax, run, moment):
    if not moment:
        ax.set_axis_off()
        return say(ax, "no height was played", size=9.5)
    inside = (run.t >= moment[0]) & (run.t <= moment[1])
    t, height = (run.t[inside] - moment[0]) * 1e3, run.height[inside] * 1e3
    ax.axhline(0, color=RULE, lw=0.8)
    ax.step(t, height, where="post", color=ACCENT, lw=1.4)
    ax.plot(t, height, "o", color=ACCENT, ms=3 if len(t) < 50 else 0, clip_on=False)
    ax.set_xlim(0, max(t[-1], 1e-3))
    ax.set_ylim(*np.array([-1.15, 1.15]) * max(most(np.abs(height)), 1e-3))
    ax.locator_params(axis="y", nbins=5)
    ax.set_title(f"Height, {t[-1]:.0f} ms at {np.nanmedian(run.ft[inside]):.0f} Hz" + ", a dot a tick" * (len(t) < 50))
    ax.set_xlabel(f"ms after t = {moment[0]:.3f} s")
    ax.set_ylabel("height (mm)")


def draw_height(ax, run, moment):
    ax.plot(*thin(run.t, run.height * 1e3), color=ACCENT, lw=0.5, drawstyle="steps-post")
    ax.set_ylim(*np.array([-1.25, 1.25]) * max(most(np.abs(run.height)) * 1e3, 0.01))
    ax.set_ylabel("height\n(mm)")
    if moment:
        ax.axvspan(*moment, color=RULE, lw=0.8, zorder=-1)
        say(ax, "\N{BLACK UP-POINTING TRIANGLE} seen above", sum(moment) / 2, 1, "left", "bottom", 8, dx=-4, dy=1,
            within=("data", "axes fraction"))


def draw_force(ax, run):
    highest = most(run.force)
    ax.plot(*thin(run.t, run.force), color=SOFT, lw=0.5)
    ax.plot(*thin(run.t, smooth(run.force, run, 0.05)), color=SHADES(1.0), lw=1.3)
    ax.set_ylim(0, max(1.15 * highest, 0.01))
    if highest > 0.7 * TOUCH_MAX_FORCE:
        ax.set_ylim(0, 1.15 * max(highest, TOUCH_MAX_FORCE))
        ax.axhline(TOUCH_MAX_FORCE, color=ASKED, lw=0.9, ls=(0, (4, 3)))
        say(ax, "3.3 N, a Touch's limit", 0.995, TOUCH_MAX_FORCE, "right", "bottom", 8, ASKED,
            within=("axes fraction", "data"))
    ax.set_ylabel("force\n(N)")
    say(ax, "thick: mean of 50 ms", 0.995, 1, "right", "bottom", 8, dy=1)


def draw_frequency(ax, run):
    ax.axhspan(*HAPTIC_RANGE, color="#fdf1ea", lw=0, zorder=-1)
    ax.plot(*thin(run.t, np.where(run.ft > 0, run.ft, np.nan)), color=ASKED, lw=1.3)
    ax.set_yscale("log")
    ax.set_ylim(2, max(3000.0, 1.2 * most(run.ft)))
    ax.set_yticks([20, 100, 500], ["20", "100", "500"])
    ax.minorticks_off()
    say(ax, "20 to 500 Hz: felt as vibration", 0.995, HAPTIC_RANGE[1], "right", "bottom", 8, ASKED, dy=1,
        within=("axes fraction", "data"))
    ax.set_ylabel("$f_t$ asked\n(Hz)")


def spectrogram(t, values, rate):
    """Amplitude in dB re 1 N (frequency x time) from Hann windows of about 0.13 s, and the times of the first
    and the last one; or None."""
    there, size = np.isfinite(values), 2 ** max(4, int(round(np.log2(0.13 * rate)))) if rate else 0
    if there.sum() < 2 or (t[-1] - t[0]) * rate + 1 < size:
        return None
    even = t[0] + np.arange(int((t[-1] - t[0]) * rate + 1.5)) / rate
    windows = np.lib.stride_tricks.sliding_window_view(np.interp(even, t[there], values[there]), size)
    windows, hann = windows[::-(-len(windows) // 1200)], np.hanning(size + 1)[:-1]
    amplitude = np.abs(np.fft.rfft((windows - windows.mean(axis=1, keepdims=True)) * hann, axis=1)) * 2 / hann.sum()
    return 20 * np.log10(np.maximum(amplitude.T, 1e-6)), t[0] + size / 2 / rate, t[-1] - size / 2 / rate


def draw_spectrogram(ax, bar, run):
    ax.set_ylabel("force spectrum\n(Hz)")
    ax.set_xlabel("time (s)")
    found = spectrogram(run.t, run.force, run.rate)
    if not found or found[0].max() <= -119:
        bar.set_visible(False)
        ax.set_yticks([])
        return say(ax, "no force" if found else "too short for a spectrum")
    level, first, last = found
    highest = 5 * np.ceil(level.max() / 5)
    image = ax.imshow(level, extent=(first, last, 0, run.rate / 2), origin="lower", aspect="auto", cmap=SHADES,
                      vmin=highest - 30, vmax=highest, interpolation="bilinear")
    ax.plot(*thin(run.t, run.ft), color=ASKED, lw=0.9)
    ax.set_ylim(0, min(run.rate / 2, max(1000.0, 1.2 * most(run.ft))))
    colour_bar(image, bar, "dB re 1 N")


def facts(run, path):
    """One line of figures under the title."""
    parts = [os.path.basename(path), f"{run.t[-1] - run.t[0]:.3g} s at {run.rate:.0f} Hz" if run.rate else "one tick"]
    parts += [f"{100 * run.touching.mean():.0f} % in contact"]
    if run.touching.any():
        parts += [f"up to {most(run.speed) * 1e3:.0f} mm/s", f"{most(run.ft):.0f} Hz", f"{most(run.force):.2f} N"]
    return " \N{MIDDLE DOT} ".join(parts)


def default_title(run):
    names = [name.removeprefix("'") for name in dict.fromkeys(run.name[run.touching])]
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "") if names else "No contact"


def draw(run, path, title):
    """The page: path and moment above, four signals over time below."""
    figure, left, right = plt.figure(figsize=(10, 9.6)), 0.075, 0.925
    figure.text(left, 0.968, title or default_title(run), fontsize=16, fontweight="bold", va="center", parse_math=False)
    figure.text(left, 0.941, facts(run, path), color=GREY, va="center", parse_math=False)
    moment = choose_moment(run)
    draw_path(figure.add_axes([left, 0.615, 0.5, 0.28]), figure.add_axes([0.583, 0.615, 0.008, 0.26]), run)
    draw_moment(figure.add_axes([0.70, 0.615, right - 0.70, 0.28]), run, moment)
    last = figure.add_axes([left, 0.055, right - left, 0.172])
    upper = [figure.add_axes([left, bottom, right - left, 0.09], sharex=last) for bottom in (0.455, 0.35, 0.245)]
    draw_height(upper[0], run, moment)
    draw_force(upper[1], run)
    draw_frequency(upper[2], run)
    draw_spectrogram(last, figure.add_axes([right + 0.01, 0.055, 0.008, 0.152]), run)
    last.set_xlim(run.t[0], run.t[-1] if run.rate else run.t[0] + 1e-3)
    for ax in (*upper, last):
        ax.fill_between(run.t, 0, 1, where=~run.touching, step="post", transform=ax.get_xaxis_transform(), color=PALE,
                        lw=0, zorder=-2)
        ax.tick_params(length=2, labelbottom=ax is last)
        ax.yaxis.set_label_coords(-0.045, 0.5)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0], epilog=__doc__.split("\n\n")[1])
    parser.add_argument("run", metavar="RUN.csv", help=f"a run, a row a tick, SI units: {','.join(COLUMNS)}")
    parser.add_argument("--out", metavar="PNG", required=True, help="the picture to write")
    parser.add_argument("--title", metavar="T", help="its title (default: the surfaces that were touched)")
    arguments = parser.parse_args()
    matplotlib.rcParams.update({**matplotlib.rcParamsDefault, **STYLE, "backend": "Agg"})
    try:
        save(draw(read_run(arguments.run), arguments.run, arguments.title), arguments.out)
    except BadInput as error:
        sys.exit(f"plot.py: {error}")


if __name__ == "__main__":
    main()
