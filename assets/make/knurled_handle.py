"""Builds assets/knurled_handle.glb: a round handle along x with a cross knurl.   python3 knurled_handle.py OUT.glb

UVs count periods of the knurl: u follows the arc length along the handle, v runs around it (its seam is underneath).
SPDX-License-Identifier: MIT
"""
import sys

import numpy as np

from glb import Glb
from pattern import checker

FREQUENCY = 800.0        # cycles/m, both ways
CYCLES_AROUND = 70       # whole, so that the knurl is continuous at the seam; sets the mean radius: 13.9 mm
HALF_LENGTH = 0.055      # m
FILLET = 0.006           # m, radius of the rounded ends
BULGE, TAPER = 0.0006, 0.04  # m, 1: small enough for a straight stroke, 1 mm deep, to stay on the handle
AROUND = 64              # faces round the handle; the middle of one is on top
STEP = 0.002             # m, about a ring's width on the handle's long part


def end_cap(x, radius, slope):
    """Fillet and flat face from the long part's end outwards, as (x, r); slope: dr/dx at that end, x > 0 outwards."""
    start = np.arctan(-slope)
    angle = np.linspace(start, np.pi / 2, 9)[1:]
    fillet = np.stack([x + FILLET * (np.sin(angle) - np.sin(start)),
                       radius - FILLET * (np.cos(start) - np.cos(angle))], axis=1)
    face = [(fillet[-1, 0], fillet[-1, 1] * part) for part in (2 / 3, 1 / 3, 0.0)]
    return np.concatenate([fillet, face])


def profile(mean_radius):
    """The handle's outline from one pole to the other, as (x, r)."""
    end = HALF_LENGTH - FILLET
    count = int(round(end / STEP)) * 2 + 1  # odd: one ring is at x = 0
    x = np.linspace(-end, end, count)
    wave = np.pi * x / (2 * HALF_LENGTH)
    r = mean_radius + BULGE * np.cos(wave) - TAPER * x
    slope = -BULGE * np.pi / (2 * HALF_LENGTH) * np.sin(wave) - TAPER
    right = end_cap(end, r[-1], slope[-1])
    left = end_cap(end, r[0], -slope[0]) * (-1, 1)
    return np.concatenate([left[::-1], np.stack([x, r], axis=1), right])


def build(mean_radius):
    """Positions, normals, uvs and triangles. Vertices at the seam and the poles are not shared between faces."""
    outline = profile(mean_radius)
    x, r = outline.T
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(outline, axis=0).T))])
    arc -= np.interp(0.0, x[11:-11], arc[11:-11])  # u = 0 at x = 0; the caps' x does not grow
    tangent = np.gradient(outline, arc, axis=0)
    tangent[[0, -1]] = (0, 1), (0, -1)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)

    turn = np.linspace(0.0, 1.0, AROUND + 1)  # from underneath, counter-clockwise seen from -x
    angle = 2 * np.pi * turn
    sin, cos = np.sin(angle), -np.cos(angle)
    sin[-1], cos[-1] = sin[0], cos[0]
    rings = np.ones_like(turn)
    positions = np.stack([np.outer(x, rings), np.outer(r, cos), np.outer(r, sin)], axis=2)
    outward, axial = tangent[:, 0], -tangent[:, 1]
    normals = np.stack([np.outer(axial, rings), np.outer(outward, cos), np.outer(outward, sin)], axis=2)
    uvs = np.stack([np.outer(arc * FREQUENCY, rings), np.outer(np.ones_like(x), turn * CYCLES_AROUND)], axis=2)
    for pole in (0, -1):
        uvs[pole, :-1, 1] += 0.5 * CYCLES_AROUND / AROUND

    triangles = []
    for i in range(len(x) - 1):
        for j in range(AROUND):
            a, b = i * (AROUND + 1) + j, (i + 1) * (AROUND + 1) + j
            triangles += [(a, b, b + 1)] if i < len(x) - 2 else [(a, b, a + 1)]
            triangles += [(a, b + 1, a + 1)] if 0 < i < len(x) - 2 else []
    return positions.reshape(-1, 3), normals.reshape(-1, 3), uvs.reshape(-1, 2), np.array(triangles)


def mean_period(positions, uvs, triangles):
    """Area-weighted mean of |dP/dv|, m."""
    p, t = positions[triangles], uvs[triangles]
    e1, e2, d1, d2 = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0], t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]
    determinant = d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]
    along_v = (e2 * d1[:, :1] - e1 * d2[:, :1]) / determinant[:, None]
    return np.average(np.linalg.norm(along_v, axis=1), weights=np.linalg.norm(np.cross(e1, e2), axis=1))


def main(out):
    radius = CYCLES_AROUND / FREQUENCY / (2 * np.pi)
    for _ in range(20):  # until the mean periods around and along the handle are equal
        positions, _, uvs, triangles = build(radius)
        radius = round(radius / (mean_period(positions, uvs, triangles) * FREQUENCY), 7)
    positions, normals, uvs, triangles = build(radius)
    glb = Glb()
    tile = checker(cycles=(1, 1), ridge=(214, 196, 170), groove=(84, 64, 48))
    knurl = {"spatial_frequency": [FREQUENCY, FREQUENCY], "amplitude": 0.0002, "stiffness": 400}
    material = glb.material("cross knurl 1.25 mm", roughness=0.45, metallic=0.5, tile=tile, knurl=knurl)
    glb.node("knurled handle", material, positions, normals, triangles, uvs)
    glb.save(out)


main(sys.argv[1])
