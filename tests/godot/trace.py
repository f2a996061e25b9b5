#!/usr/bin/env python3
# A path over the demo plate, and the forces of `knurl run`, as doubles that a script of the engine reads without
# rounding: FOLDER/trace.bin (t, x, y, z a row) and FOLDER/forces.bin (fx, fy, fz a tick).
# usage: trace.py KNURL PLATE FOLDER
import array
import csv
import math
import subprocess
import sys

tool, plate, folder = sys.argv[1:]
rows = []
for i in range(1001):  # 2 s: down onto the first bar, along it, over the crack to the next, up again
    t = i / 500.0
    x = 0.04 * math.sin(2.0 * math.pi * 0.7 * t)
    y = max(-0.0012, 0.004 - 0.02 * t) if t < 1.8 else -0.0012 + 0.03 * (t - 1.8)
    z = 0.02 * max(0.0, t - 1.0)
    rows.append((t, x, y, z))
with open(f"{folder}/trace.csv", "w") as file:
    file.write("t,x,y,z\n")
    file.writelines(",".join(repr(value) for value in row) + "\n" for row in rows)
subprocess.run([tool, "run", plate, "--fast", "--trace", f"{folder}/trace.csv", "--out", f"{folder}/out.csv"],
               check=True, stdout=subprocess.DEVNULL)
with open(f"{folder}/out.csv") as file:
    forces = [float(row[axis]) for row in csv.DictReader(file) for axis in ("fx", "fy", "fz")]
for name, values in (("trace", [value for row in rows for value in row]), ("forces", forces)):
    with open(f"{folder}/{name}.bin", "wb") as file:
        array.array("d", values).tofile(file)
