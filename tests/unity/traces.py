#!/usr/bin/env python3
"""Paths over the demo assets, and the forces of `knurl run` on them, as doubles that C# and GDScript read without rounding:
FOLDER/NAME.trace.bin (t, x, y, z a row; scene axes) and FOLDER/NAME.forces.bin (fx, fy, fz a tick); for walls without
ridges FOLDER/NAME.wall.forces.bin. Contact begins between two ticks, not on one: otherwise an amplitude's rounding to
float would decide on which one, and cycles count from there.

usage: traces.py KNURL ASSETS FOLDER"""
import array
import csv
import json
import math
import os
import struct
import subprocess
import sys

tool, assets, folder = sys.argv[1:]
os.makedirs(folder, exist_ok=True)


def plate_1d(t):
    """Down onto the first bar, along it, over the crack to the next, up again."""
    y = max(-0.0012, 0.00401 - 0.02 * t) if t < 1.8 else -0.0012 + 0.03 * (t - 1.8)
    return 0.04 * math.sin(2.0 * math.pi * 0.7 * t), y, 0.02 * max(0.0, t - 1.0)


def grid_2d(t):
    """Circles that no mirror maps onto themselves: the centre is off the axes."""
    y = max(-0.0010, 0.00303 - 0.02 * t) if t < 1.8 else -0.0010 + 0.03 * (t - 1.8)
    a = 2.0 * math.pi * 0.5 * t
    return 0.006 + 0.012 * math.cos(a), y, -0.004 + 0.012 * math.sin(a)


def handle(t, profile):
    """Around the handle and along it (x) at the same time, a little inside its round surface."""
    depth = min(0.0006, -0.00401 + 0.02 * t) if t < 1.8 else 0.0006 - 0.03 * (t - 1.8)
    x = -0.015 + 0.015 * t
    after = next(i for i, (at, _) in enumerate(profile) if at > x)
    (x0, r0), (x1, r1) = profile[after - 1:after + 1]
    radius = r0 + (r1 - r0) * (x - x0) / (x1 - x0) - depth
    a = 0.6 + 1.9 * t
    return x, radius * math.cos(a), radius * math.sin(a)


def profile_of(path):
    """The handle's radius along x, by its vertices, which stand in rings."""
    with open(path, "rb") as file:
        data = file.read()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    accessor = document["accessors"][document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    begin = 28 + length + document["bufferViews"][accessor["bufferView"]]["byteOffset"] + accessor.get("byteOffset", 0)
    rings = {}
    for x, y, z in struct.iter_unpack("<3f", data[begin:begin + 12 * accessor["count"]]):
        rings[x] = max(rings.get(x, 0.0), math.hypot(y, z))
    return sorted(rings.items())


def forces_over(model, name):
    """fx, fy, fz of each tick of the path over a model."""
    subprocess.run([tool, "run", model, "--fast", "--trace", f"{folder}/{name}.csv", "--out", f"{folder}/{name}.out.csv"],
                   check=True, stdout=subprocess.DEVNULL)
    with open(f"{folder}/{name}.out.csv") as file:
        return [float(row[axis]) for row in csv.DictReader(file) for axis in ("fx", "fy", "fz")]


def save(name, values):
    with open(f"{folder}/{name}.bin", "wb") as file:
        array.array("d", values).tofile(file)


profile = profile_of(f"{assets}/knurled_handle.glb")
for name, path in (("plate_1d", plate_1d), ("grid_2d", grid_2d), ("knurled_handle", lambda t: handle(t, profile))):
    rows = [(i / 500.0,) + path(i / 500.0) for i in range(1001)]
    with open(f"{folder}/{name}.csv", "w") as file:
        file.write("t,x,y,z\n")
        file.writelines(",".join(repr(value) for value in row) + "\n" for row in rows)
    save(f"{name}.trace", [value for row in rows for value in row])
    save(f"{name}.forces", forces_over(f"{assets}/{name}.glb", name))
    with open(f"{assets}/{name}.glb", "rb") as model, open(f"{folder}/{name}.wall.glb", "wb") as wall:
        wall.write(model.read().replace(b"0.0002", b"0.0000"))
    save(f"{name}.wall.forces", forces_over(f"{folder}/{name}.wall.glb", name))
