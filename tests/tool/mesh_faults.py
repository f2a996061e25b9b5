#!/usr/bin/env python3
"""Common faults of downloaded meshes, each as a glTF file that `knurl inspect --check` is asked about: exit status,
what it warns of, and the numbers that tell. Prints a table. usage: mesh_faults.py KNURL FOLDER
SPDX-License-Identifier: MIT"""
import base64
import json
import math
import pathlib
import struct
import subprocess
import sys

TAG = {"version": 1, "spatial_frequency": [1000, 0], "amplitude": 0.0002, "stiffness": 400}


def sphere(count=32, radius=0.03):
    """Vertices and triangles of a closed sphere of 2 count (count / 2 - 1) triangles."""
    rows = count // 2
    points = [(0.0, 0.0, radius)]
    for row in range(1, rows):
        v = math.pi * row / rows
        points += [(radius * math.sin(v) * math.cos(u), radius * math.sin(v) * math.sin(u), radius * math.cos(v))
                   for u in (2 * math.pi * k / count for k in range(count))]
    points.append((0.0, 0.0, -radius))

    def at(row, k):
        return 0 if row == 0 else len(points) - 1 if row == rows else 1 + (row - 1) * count + k % count

    triangles = []
    for row in range(rows):
        for k in range(count):
            a, b, c, d = at(row, k), at(row + 1, k), at(row + 1, k + 1), at(row, k + 1)
            triangles += ([(a, b, c)] if b != c else []) + ([(a, c, d)] if a != d else [])
    return points, triangles


def bent_sheet(count=20, size=0.1):
    """A sheet, bent so that it is no plane, whose triangles have vertices and uvs of their own."""
    points, triangles, uvs = [], [], []
    for row in range(count):
        for column in range(count):
            corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)]
            for way in ((0, 1, 2), (0, 2, 3)):
                triangles.append(tuple(range(len(points), len(points) + 3)))
                for k in way:
                    u, v = (c / count for c in corners[k])
                    points.append((size * u, size * v, 0.02 * u * u))
                    uvs.append((u, v))
    return points, triangles, uvs


def write(path, points, triangles, uvs=None, normals=None):
    """One mesh of one tagged material."""
    arrays = [("POSITION", "VEC3", points), ("TEXCOORD_0", "VEC2", uvs), ("NORMAL", "VEC3", normals)]
    arrays = [a for a in arrays if a[2]] + [("indices", "SCALAR", triangles)]
    data, views, accessors, attributes = b"", [], [], {}
    for name, kind, values in arrays:
        flat = [x for value in values for x in value]
        packed = struct.pack(f"<{len(flat)}{'I' if name == 'indices' else 'f'}", *flat)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        accessor = {"bufferView": len(views) - 1, "componentType": 5125 if name == "indices" else 5126, "type": kind,
                    "count": len(flat) if name == "indices" else len(values)}
        if name == "POSITION":
            accessor["min"] = [min(p[i] for p in points) for i in range(3)]
            accessor["max"] = [max(p[i] for p in points) for i in range(3)]
        accessors.append(accessor)
        if name != "indices":
            attributes[name] = len(accessors) - 1
        data += packed
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "part"}],
        "materials": [{"name": "m", "extras": {"knurl": TAG}}], "accessors": accessors, "bufferViews": views,
        "buffers": [{"uri": uri, "byteLength": len(data)}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": len(accessors) - 1, "material": 0}]}]}))


def faults():
    """Name, mesh, exit status (3: warnings), expected numbers of `inspect`."""
    points, triangles = sphere()
    count = len(triangles)
    reverse = [(a, c, b) for a, b, c in triangles]
    outwards = [tuple(x / 0.03 for x in p) for p in points]
    flat, quads, uvs = bent_sheet()
    tenth = len(uvs) // 10
    bad = [tuple(-x for x in n) if i % 10 == 0 else n for i, n in enumerate(outwards)]
    yield "none", (points, triangles), 0, {"reversed_twins": 0, "turned_triangles": 0, "double_sided": False}
    yield "one reversed twin", (points, triangles + reverse[:1]), 3, {"reversed_twins": 1, "double_sided": False}
    yield "all have a twin", (points, triangles + reverse), 0, {"reversed_twins": count, "double_sided": True}
    yield "three wound the other way", (points, reverse[:3] + triangles[3:]), 3, {"turned_triangles": 3}
    yield "duplicates and triangles without area", (points, triangles + triangles[:5] + [(0, 1, 1)]), 0, {
        "dropped_triangles": 6}
    yield "a tenth of the uvs collapsed", (flat, quads, [(0.0, 0.0)] * tenth + uvs[tenth:]), 3, {"uneven": 0.1}
    yield "a tenth of the uvs ten times too fine", (flat, quads, [(10 * u, 10 * v) for u, v in uvs[:tenth]]
                                                    + uvs[tenth:]), 3, {"uneven": 0.1}
    yield "uvs of a palette", (flat, quads, [(0.3, 0.7)] * len(uvs)), 3, {"coordinates": "box, for its uvs have no area"}
    yield "neither uvs nor an axis", (flat, quads), 0, {"coordinates": "box"}
    yield "a tenth of the normals inside out", (points, triangles, None, bad), 3, {"bad_normals": None}


def main():
    tool, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    wrong = 0
    print("| fault | --check | numbers | warning |\n|---|---|---|---|")
    for name, mesh, status, numbers in faults():
        path = folder / (name.replace(" ", "_") + ".gltf")
        write(path, *mesh)
        run = subprocess.run([tool, "inspect", "--check", str(path)], capture_output=True, text=True, check=False)
        surface = json.loads(run.stdout)["surfaces"][0]
        warnings = [line for line in run.stderr.splitlines() if line]
        found = {key: surface.get(key) for key in numbers}
        good = run.returncode == status and bool(warnings) == (status != 0)
        for key, value in numbers.items():
            near = isinstance(value, float) and abs(found[key] - value) < 0.01
            good &= near or (found[key] > 0 if value is None else found[key] == value)
        wrong += not good
        print(f"| {name} | {run.returncode} | {found} | {' '.join(warnings)[:160]} |{'' if good else ' UNEXPECTED'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
