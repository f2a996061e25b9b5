#!/usr/bin/python3
"""Draws the CSV of `knurl run ... --out RUN.csv` as an SVG picture, and prints a summary of the contact. Needs only
Python.

usage: draw_run.py RUN.csv OUT.svg

Three curves over time (the temporal frequency f_t of the stroke, the height map, the force), and a few milliseconds of
the height map at the highest f_t. Grey: no contact. samples/study/plot.py draws more, with matplotlib.

SPDX-License-Identifier: MIT
"""
import csv
import html
import math
import os
import sys

WIDTH, LEFT, RIGHT = 900, 80, 860
INK, GREY, RULE, PALE, CURVE = "#1c2b33", "#66737a", "#c3ccd0", "#eef2f4", "#0f6e84"


COLUMNS = ("t", "ft", "height", "fx", "fy", "fz", "vx", "vy", "surface")
MOST = 1e9  # of any number, in SI units


def one_line(text):
    """Untrusted text as one line without escapes for a terminal."""
    return "".join(character if character.isprintable() else "?" for character in text)


def fail(why):
    sys.exit(one_line(f"draw_run.py: {why}"))


def number(row, name, place):
    """A cell as a number that can be drawn."""
    text = row[name]
    try:
        value = float(text)
    except (TypeError, ValueError):
        fail(f"{place}: expected a number for {name}, found {repr(text[:40]) if text else 'nothing'}")
    least = 0.0 if name == "ft" else -MOST
    if not least <= value <= MOST:  # also true of NaN
        fail(f"{place}: expected {least:g} to {MOST:g} for {name}, found {text[:40]}")
    return value


def read(path):
    """The run's rows as dictionaries of floats; `surface` stays text."""
    rows = []
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file)
        for name in COLUMNS:
            if name not in (reader.fieldnames or ()):
                fail(f"{path}: expected the CSV of `knurl run ... --out`, found no column '{name}'")
        for row in reader:
            place = f"{path}: line {reader.line_num}"
            rows.append({name: row[name] if name == "surface" else number(row, name, place) for name in COLUMNS})
            if len(rows) > 1 and not rows[-1]["t"] > rows[-2]["t"]:
                fail(f"{place}: expected a time after {rows[-2]['t']:g} s, found {row['t'][:40]}")
    if len(rows) < 2:
        fail(f"{path}: expected at least two rows, found {len(rows)}")
    return rows


def surface_name(cell):
    """The name in a cell, which starts with an apostrophe if the name alone would be a formula or the word "none"."""
    return cell[1:] if cell.startswith("'") else cell


def label(x, y, text, size=12, colour=INK, anchor="start"):
    return f'<text x="{x}" y="{y}" font-size="{size}" fill="{colour}" text-anchor="{anchor}">{html.escape(text)}</text>'


def panel(top, height, times, values, low, high, title, unit):
    """One curve: of each pixel the first, lowest, highest and last value, so that no peak is lost."""
    columns = {}
    for t, v in zip(times, values):
        x = round(LEFT + (RIGHT - LEFT) * (t - times[0]) / (times[-1] - times[0]))
        first, least, most, _ = columns.get(x, (v, v, v, v))
        columns[x] = (first, min(least, v), max(most, v), v)

    def y(v):
        return round(top + height - height * (v - low) / (high - low), 1)
    points = " ".join(f"{x},{y(v)}" for x, column in sorted(columns.items()) for v in column)
    parts = [f'<rect x="{LEFT}" y="{top}" width="{RIGHT - LEFT}" height="{height}" fill="none" stroke="{RULE}"/>',
             f'<polyline points="{points}" fill="none" stroke="{CURVE}"/>', label(LEFT, top - 6, f"{title} ({unit})")]
    parts += [label(LEFT - 6, y(v) + 4, f"{v:g}", 10, GREY, "end") for v in (low, high)]
    return parts


def time_axis(top, first, last, unit):
    return [label(x, top, text, 10, GREY, anchor) for x, text, anchor in
            ((LEFT, f"{first:g} {unit}", "start"), (RIGHT, f"{last:g} {unit}", "end"))]


def round_up(value):
    """The next of 1, 2, 5 times a power of ten; 1 for 0."""
    power = 10 ** math.floor(math.log10(value)) if value > 1e-12 else 1.0
    return next(power * step for step in (1, 2, 5, 10) if value <= 1.0001 * power * step)


def draw(rows):
    times = [row["t"] for row in rows]
    forces = [math.hypot(row["fx"], row["fy"], row["fz"]) for row in rows]
    heights = [1e3 * row["height"] for row in rows]
    frequencies = [row["ft"] for row in rows]
    most = round_up(max(map(abs, heights)) or 0.1)
    parts, start = [], None
    for i, row in enumerate(rows + [{"surface": ""}]):  # grey without contact
        if row["surface"] == "none" and start is None:
            start = times[i]
        elif row["surface"] != "none" and start is not None:
            x0, x1 = (LEFT + (RIGHT - LEFT) * (t - times[0]) / (times[-1] - times[0]) for t in (start, times[i - 1]))
            parts.append(f'<rect x="{x0:.1f}" y="40" width="{x1 - x0:.1f}" height="370" fill="{PALE}"/>')
            start = None
    parts += panel(40, 100, times, frequencies, 0, round_up(max(frequencies)), "ridges that the hand crosses per second", "Hz")
    parts += panel(175, 100, times, heights, -most, most, "height of the surface under the finger", "mm")
    parts += panel(310, 100, times, forces, 0, round_up(max(forces)), "force on the hand", "N")
    parts += time_axis(424, times[0], times[-1], "s")
    middle = max(range(len(rows)), key=lambda i: frequencies[i])
    some = slice(max(0, middle - 20), middle + 21)
    ends = times[some][1:] + times[some][-1:]
    held = [(t, h) for begin, end, h in zip(times[some], ends, heights[some]) for t in (begin, end)]
    parts += panel(465, 90, [1e3 * t for t, _ in held], [h for _, h in held], -most, most,
                   f"the same height, tick by tick, where the hand is fastest ({frequencies[middle]:.0f} Hz)", "mm")
    parts += time_axis(569, round(1e3 * held[0][0]), round(1e3 * held[-1][0]), "ms")
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} 580" font-family="sans-serif">'
            f'<rect width="{WIDTH}" height="580" fill="white"/>' + "\n".join(parts) + "</svg>\n")


def say(rows):
    """A one-sentence summary of the contact."""
    touched = [row for row in rows if row["surface"] != "none"]
    if not touched:
        return "Nothing was touched."
    period = rows[1]["t"] - rows[0]["t"]
    ridges = sum(row["ft"] for row in touched) * period
    metres = sum(math.hypot(row["vx"], row["vy"]) for row in touched) * period
    force = max(math.hypot(row["fx"], row["fy"], row["fz"]) for row in touched)
    return (f"In {rows[-1]['t'] + period:.0f} s the hand slid over {100 * metres:.0f} cm of '{surface_name(touched[0]['surface'])}' "
            f"and felt {ridges:.0f} ridges, up to {max(row['ft'] for row in touched):.0f} per second, with up to "
            f"{force:.2f} N.")


def main():
    if len(sys.argv) != 3 or sys.argv[1].startswith("-"):
        print(__doc__)
        sys.exit(0 if {"-h", "--help"} & set(sys.argv[1:]) else 2)
    run, out = sys.argv[1:]
    try:
        rows = read(run)
        picture = draw(rows)
        if os.path.exists(out) and os.path.samefile(run, out):
            fail(f"{out}: expected another file than the run, which would be replaced")
        with open(out, "w", encoding="utf-8") as file:
            file.write(picture)
    except OSError as error:
        fail(f"{error.filename or out}: {error.strerror}")
    except UnicodeDecodeError:
        fail(f"{run}: expected the CSV of `knurl run ... --out`, found no text")
    except csv.Error as error:
        fail(f"{run}: expected the CSV of `knurl run ... --out`, found: {error}")
    print(one_line(say(rows)))


if __name__ == "__main__":
    main()
