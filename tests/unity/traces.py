#!/usr/bin/env python3
"""Paths over the demo assets, and what `knurl run` makes of them, as doubles that C# reads without rounding:
FOLDER/NAME.trace.bin (t, x, y, z a row; scene axes) and FOLDER/NAME.forces.bin (fx, fy, fz a tick).

usage: traces.py KNURL ASSETS FOLDER"""
import array
import csv
import json
import math
import os
import subprocess
import sys

tool, assets, folder = sys.argv[1:]
os.makedirs(folder, exist_ok=True)


def plate_1d(t):
    """Down onto the first bar, along it, over the crack to the next, up again."""
    y = max(-0.0012, 0.004 - 0.02 * t) if t < 1.8 else -0.0012 + 0.03 * (t - 1.8)
    return 0.04 * math.sin(2.0 * math.pi * 0.7 * t), y, 0.02 * max(0.0, t - 1.0)


def grid_2d(t):
    """Circles that no mirror maps onto themselves: the centre is off the axes."""
    y = max(-0.0010, 0.003 - 0.02 * t) if t < 1.8 else -0.0010 + 0.03 * (t - 1.8)
    a = 2.0 * math.pi * 0.5 * t
    return 0.006 + 0.012 * math.cos(a), y, -0.004 + 0.012 * math.sin(a)


def handle(t, box):
    """Around the handle's barrel, along its axis at the same time: its longest side."""
    low, high = box
    size = [b - a for a, b in zip(low, high)]
    along = size.index(max(size))
    across = [axis for axis in range(3) if axis != along]
    radius = min(size[axis] for axis in across) / 2.0
    depth = 0.0008 if 0.2 < t < 1.9 else -0.004
    a = 0.6 + 1.9 * t
    point = [0.0, 0.0, 0.0]
    for axis, share in zip(across, (math.cos(a), math.sin(a))):
        point[axis] = (low[axis] + high[axis]) / 2.0 + (radius - depth) * share
    point[along] = low[along] + size[along] * (0.35 + 0.12 * t)
    return tuple(point)


def box_of(path):
    """The tagged surfaces' bounds, by the file's own accessors and translations."""
    import struct
    with open(path, "rb") as file:
        data = file.read()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    low, high = [math.inf] * 3, [-math.inf] * 3
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        at = node.get("translation", [0, 0, 0])
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            box = document["accessors"][primitive["attributes"]["POSITION"]]
            for i in range(3):
                low[i] = min(low[i], at[i] + box["min"][i])
                high[i] = max(high[i], at[i] + box["max"][i])
    return low, high


barrel = box_of(f"{assets}/knurled_handle.glb")
for name, path in (("plate_1d", plate_1d), ("grid_2d", grid_2d), ("knurled_handle", lambda t: handle(t, barrel))):
    rows = [(i / 500.0,) + path(i / 500.0) for i in range(1001)]
    with open(f"{folder}/{name}.csv", "w") as file:
        file.write("t,x,y,z\n")
        file.writelines(",".join(repr(value) for value in row) + "\n" for row in rows)
    subprocess.run([tool, "run", f"{assets}/{name}.glb", "--fast", "--trace", f"{folder}/{name}.csv",
                    "--out", f"{folder}/{name}.out.csv"], check=True, stdout=subprocess.DEVNULL)
    with open(f"{folder}/{name}.out.csv") as file:
        forces = [float(row[axis]) for row in csv.DictReader(file) for axis in ("fx", "fy", "fz")]
    for kind, values in (("trace", [value for row in rows for value in row]), ("forces", forces)):
        with open(f"{folder}/{name}.{kind}.bin", "wb") as file:
            array.array("d", values).tofile(file)
