#!/usr/bin/python3
"""Summarises the data of a picture in a few readable lines, and checks that the code still gives the same data.

usage: drawn.py PICTURE.data DATA...           writes the summary
       drawn.py --check PICTURE.data DATA...   exit 1, and one line for each column that has changed

DATA are the files of a picture: JSON, CSV, or a sound of knurl run --wav. A line of PICTURE.data is a column (or the
values of one key of the JSON, in all rows): the count of numbers, their mean, the mean of their magnitudes, their mean
with weights that change with the row (to detect swapped rows), and a checksum of all other cells. Compared to 1e-4 of
the mean magnitude, so that compilers and libraries do not matter. Timings are left out.

SPDX-License-Identifier: MIT
"""
import array
import csv
import json
import math
import os
import re
import sys
import wave
import zlib

TOLERANCE = 1e-4
LEAST = 1e-7  # single-precision spectra differ this much between libraries
TIMED = re.compile(r"(^|[._])(ns|cost|machine|instructions)([._]|$)")


def walk(value, path, columns):
    """Collects JSON values by their path, with every list index written as []."""
    if isinstance(value, dict):
        for key, inner in value.items():
            walk(inner, f"{path}.{key}" if path else key, columns)
    elif isinstance(value, list):
        for inner in value:
            walk(inner, path + "[]", columns)
    else:
        columns.setdefault(path, []).append(value)


def read(path):
    """The columns of a file, by name."""
    columns = {}
    with open(path, encoding="utf-8", newline="") as file:
        if path.endswith(".wav"):
            with wave.open(path) as sound:
                columns["sample"] = array.array("h", sound.readframes(sound.getnframes()))
        elif path.endswith(".json"):
            walk(json.load(file), "", columns)
        else:
            for row in csv.DictReader(file):
                for key, cell in row.items():
                    columns.setdefault(key, []).append(cell)
    return columns


def number(value):
    """The value as a finite number, or None."""
    try:
        found = float(value) if not isinstance(value, bool) else math.nan
    except (TypeError, ValueError):
        return None
    return found if math.isfinite(found) else None


def summary(values):
    """count, mean, mean magnitude, weighted mean of the numbers; checksum of the other cells and their positions."""
    numbers = [(place, n) for place, value in enumerate(values) if (n := number(value)) is not None]
    others = [f"{place} {value}" for place, value in enumerate(values) if number(value) is None]
    count = max(1, len(numbers))
    return (len(numbers), math.fsum(n for _, n in numbers) / count, math.fsum(abs(n) for _, n in numbers) / count,
            math.fsum(n * math.cos(place) for place, n in numbers) / count, zlib.crc32("\n".join(others).encode()))


def describe(paths):
    """{"file key": summary} of all files."""
    return {f"{os.path.basename(path)} {key}".replace("\n", " "): summary(values)
            for path in paths for key, values in read(path).items() if not TIMED.search(key)}


def parse(path):
    found = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            key, *fields = line.rstrip("\n").split("\t")
            found[key] = (int(fields[0]), *map(float, fields[1:4]), int(fields[4], 16))
    return found


def differ(was, now):
    tolerance = TOLERANCE * max(was[2], now[2]) + LEAST
    return was[0] != now[0] or was[4] != now[4] or any(abs(a - b) > tolerance for a, b in zip(was[1:4], now[1:4]))


def check(path, now):
    """The lines to print; empty if nothing has changed."""
    was = parse(path)
    told = [f"{key}: it was not there" if key not in was else f"{key}: it is gone" for key in sorted(set(was) ^ set(now))]
    return told + [f"{key}: {now[key][0]} numbers, mean {now[key][1]:.6g}, was {was[key][0]}, {was[key][1]:.6g}"
                   for key in sorted(set(was) & set(now)) if differ(was[key], now[key])]


def main(arguments):
    checking = arguments[:1] == ["--check"]
    path, *data = arguments[1 if checking else 0:]
    now = describe(data)
    if not checking:
        with open(path + ".part", "w", encoding="utf-8") as file:
            for key, (count, mean, size, weighted, checksum) in sorted(now.items()):
                file.write(f"{key}\t{count}\t{mean:.8g}\t{size:.8g}\t{weighted:.8g}\t{checksum:08x}\n")
        os.replace(path + ".part", path)
        return 0
    if not os.path.exists(path):
        print(f"{path}: there is none: ./run figures --update makes it with its picture", file=sys.stderr)
        return 1
    told = check(path, now)
    if told:
        picture = re.sub(r"\.data$", ".png", path)
        print(f"{picture} is out of date: ./run figures --update draws it again. What has changed:", file=sys.stderr)
        print("\n".join(f"  {line}" for line in told[:10]), file=sys.stderr)
    return 1 if told else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
