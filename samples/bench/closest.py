#!/usr/bin/python3
"""The closest point of a mesh, and its build: Knurl beside Embree and FCPW, in one process, on one core, warm, in turns.

usage: closest.py [--library build/release/sdk/libknurl.a] [--triangles N ...] [--points N] [--rounds N] [--json]
Needs numpy, embreex and fcpw from PyPI, and a C compiler; if they are missing, it says so and exits with 77. The least of
the rounds counts; on a busy machine take many short ones (--points 500 --rounds 100), so that some are not interrupted.
`alone`: each query by itself, up to 1 m. `followed`: it begins at the last answer, Embree and FCPW with the distance to that
as their radius. If they disagree by more than 1e-6 m (float32's), it says so. `build`: CPU time of a build, in which Knurl
also welds vertices, links neighbours, looks for triangles that touch and measures uvs.

SPDX-License-Identifier: MIT
"""
import argparse
import ctypes
import glob
import json
import os
import subprocess
import sys
import tempfile
import time

os.sched_setaffinity(0, {max(os.sched_getaffinity(0))}) # before any library starts its threads

try:
    import embreex
    import fcpw
    import numpy as np
except ImportError as error:
    print(f"closest.py: SKIPPED, nothing was measured: {error} (pip install numpy embreex fcpw)", file=sys.stderr)
    sys.exit(77)

HERE = os.path.dirname(os.path.abspath(__file__))
RADIUS = 1.0 # m
ALONE, FOLLOWED = 0, 1


def compiled(library):
    """closest_peers.c with the library in it."""
    with tempfile.TemporaryDirectory() as folder:
        made = os.path.join(folder, "closest_peers.so")
        subprocess.run([os.environ.get("CC", "cc"), "-O3", "-march=native", "-fPIC", "-shared", "-fvisibility=hidden", "-o",
                        made, "-I", os.path.join(HERE, "../../sdk/include"), os.path.join(HERE, "closest_peers.c"), library,
                        "-lm", "-lpthread", "-ldl"], check=True)
        return ctypes.CDLL(made)


def sheet(triangles):
    """A wavy sheet, 100 by 50 mm."""
    rows = int((triangles / 4) ** 0.5)
    x, y = np.meshgrid(np.linspace(-0.05, 0.05, 2 * rows + 1), np.linspace(-0.025, 0.025, rows + 1))
    z = 0.002 * np.sin(2 * np.pi * x / 0.02) * np.cos(2 * np.pi * y / 0.02)
    corner = (np.arange(rows)[:, None] * (2 * rows + 1) + np.arange(2 * rows)).ravel()
    up = corner + 2 * rows + 1
    indices = np.concatenate([np.stack([corner, corner + 1, up + 1], 1), np.stack([corner, up + 1, up], 1)])
    return np.stack([x.ravel(), y.ravel(), z.ravel()], 1).astype("f4"), indices.astype("u4")


def ball(triangles):
    """A bumpy closed ball of 60 mm; triangles of very different sizes, thin at the poles."""
    rows = int((triangles / 4) ** 0.5)
    around = 2 * rows
    polar, turn = np.meshgrid(np.linspace(0, np.pi, rows + 1), np.arange(around) * 2 * np.pi / around, indexing="ij")
    r = 0.03 * (1 + 0.08 * np.sin(7 * polar) * np.sin(polar) * np.cos(5 * turn))
    points = np.stack([r * np.sin(polar) * np.cos(turn), r * np.sin(polar) * np.sin(turn), r * np.cos(polar)], 2)
    points[0], points[-1] = points[0, 0], points[-1, 0]
    i, j = (a.ravel() for a in np.meshgrid(np.arange(rows), np.arange(around), indexing="ij"))
    a, b = i * around + j, i * around + (j + 1) % around
    c, d = a + around, b + around
    indices = np.concatenate([np.stack([a, c, d], 1), np.stack([a, d, b], 1)])
    return points.reshape(-1, 3).astype("f4"), indices.astype("u4")


def points_of(kind, positions, indices, count, random):
    """near: within 2 mm of the surface; around: anywhere in a box twice the mesh's; stroke: 0.1 mm from one to the next,
    within 1 mm."""
    low, high = positions.min(0), positions.max(0)
    if kind == "around":
        middle, half = (low + high) / 2, (high - low) + 0.01
        return (middle + random.uniform(-1, 1, (count, 3)) * half).astype("f4").astype("f8")
    if kind == "near":
        at = positions[random.integers(len(positions), size=count)]
        return (at + random.uniform(-0.002, 0.002, (count, 3))).astype("f4").astype("f8")
    t = np.arange(count) * 1e-4
    path = np.stack([0.02 * np.cos(t / 0.02), 0.02 * np.sin(t / 0.02), 0.001 * np.sin(t / 0.003)], 1)
    if low[2] < -0.01: # the ball: along its skin
        path[:, 2] = 0.023 + 0.001 * np.sin(t / 0.003)
    return path.astype("f4").astype("f8")


class Fcpw:
    """Its batch, on one core."""

    def __init__(self, positions, indices):
        self.scene = fcpw.scene_3D()
        self.scene.set_object_count(1)
        self.scene.set_object_vertices(np.asfortranarray(positions), 0)
        self.scene.set_object_triangles(np.asfortranarray(indices.astype("i4")), 0)
        self.scene.build(fcpw.aggregate_type.bvh_surface_area, True)

    def run(self, points, mode, distances):
        radii = np.full(len(points), RADIUS ** 2, "f4")
        rows = np.asfortranarray(points.astype("f4"))
        if mode == FOLLOWED:
            steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
            radii[1:] = ((distances[:-1] + steps) * 1.00001) ** 2
        found = fcpw.interaction_3D_list()
        before = time.perf_counter_ns()
        self.scene.find_closest_points(rows, radii, found, False)
        ns = (time.perf_counter_ns() - before) / len(points)
        distances[:] = [f.d for f in found]
        return ns


BUILDS = 3


def build(name, makers, as_json):
    """Builds a mesh with each library in turns, prints the least CPU time of each, and returns the last of their scenes."""
    least, scenes = dict.fromkeys(makers, 1e30), {}
    for _ in range(BUILDS):
        for who, (make, free) in makers.items():
            if who in scenes:
                free(scenes[who])
            before = time.process_time_ns()
            scenes[who] = make()
            least[who] = min(least[who], 1e-6 * (time.process_time_ns() - before))
    row = {"mesh": name[0], "triangles": name[1], "mode": "build", **{f"{who}_ms": round(ms, 1) for who, ms in least.items()}}
    print(json.dumps(row) if as_json else
          f"{name[0]:6}{name[1]:9}  {'build':17}" + "".join(f"{who:>8} {ms:7.1f} ms" for who, ms in least.items()) +
          f"   embree / knurl {least['embree'] / least['knurl']:.2f}  fcpw / knurl {least['fcpw'] / least['knurl']:.2f}", flush=True)
    return scenes.values()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--library", default="build/release/sdk/libknurl.a")
    parser.add_argument("--triangles", type=int, nargs="+", default=[10000, 100000, 1000000])
    parser.add_argument("--points", type=int, default=20000)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    peers = compiled(arguments.library)
    pointer = ctypes.c_void_p
    for name in ("peer_knurl_make", "peer_embree_make"):
        getattr(peers, name).restype = pointer
    for name in ("peer_knurl_run", "peer_embree_run"):
        getattr(peers, name).restype = ctypes.c_double
    embree = glob.glob(os.path.join(os.path.dirname(embreex.__file__), "../embreex.libs/libembree4*"))
    if not embree or peers.peer_embree_load(embree[0].encode()):
        print("closest.py: SKIPPED, nothing was measured: embreex has no libembree4 of its own", file=sys.stderr)
        return 77
    random = np.random.default_rng(1)
    for make in (sheet, ball):
        for triangles in arguments.triangles:
            positions, indices = make(triangles)
            mesh = (positions.ctypes.data_as(pointer), len(positions), indices.ctypes.data_as(pointer), ctypes.c_uint64(indices.size))
            knurl, other, third = build((make.__name__, len(indices)), {
                "knurl": (lambda: peers.peer_knurl_make(*mesh), lambda scene: peers.peer_knurl_free(pointer(scene))),
                "embree": (lambda: peers.peer_embree_make(*mesh), lambda scene: peers.peer_embree_free(pointer(scene))),
                "fcpw": (lambda: Fcpw(positions, indices), lambda _: None)}, arguments.json)
            for kind in ("around", "near", "stroke"):
                points = points_of(kind, positions, indices, arguments.points, random)
                rows = {}
                for mode, name in ((ALONE, "alone"), (FOLLOWED, "followed")):
                    if mode == FOLLOWED and kind != "stroke":
                        continue
                    distances = {who: np.zeros(len(points)) for who in ("knurl", "embree", "fcpw")}
                    if mode == FOLLOWED:
                        third.run(points, ALONE, distances["fcpw"])
                    least = dict.fromkeys(distances, 1e30)
                    for _ in range(arguments.rounds):
                        for who, run in (("knurl", lambda d: peers.peer_knurl_run(
                                              pointer(knurl), points.ctypes.data_as(pointer), len(points),
                                              ctypes.c_double(RADIUS), mode, d.ctypes.data_as(pointer))),
                                         ("embree", lambda d: peers.peer_embree_run(
                                              pointer(other), points.ctypes.data_as(pointer), len(points),
                                              ctypes.c_double(RADIUS), mode, d.ctypes.data_as(pointer))),
                                         ("fcpw", lambda d: third.run(points, mode, d))):
                            least[who] = min(least[who], run(distances[who]))
                    for who in ("embree", "fcpw"):
                        off = np.abs(distances[who] - distances["knurl"]).max()
                        if off > 1e-6:
                            print(f"closest.py: {who} is {off:g} m off on {make.__name__} {triangles} {kind}", file=sys.stderr)
                    row = {"mesh": make.__name__, "triangles": len(indices), "points": kind, "mode": name,
                           **{f"{who}_ns": round(ns, 1) for who, ns in least.items()}}
                    print(json.dumps(row) if arguments.json else
                          f"{row['mesh']:6}{row['triangles']:9}  {kind:7} {name:9}" +
                          "".join(f"{who:>8} {ns:7.0f} ns" for who, ns in least.items()) +
                          f"   embree / knurl {least['embree'] / least['knurl']:.2f}  fcpw / knurl {least['fcpw'] / least['knurl']:.2f}",
                          flush=True)
            peers.peer_knurl_free(pointer(knurl))
            peers.peer_embree_free(pointer(other))
    return 0


if __name__ == "__main__":
    sys.exit(main())
