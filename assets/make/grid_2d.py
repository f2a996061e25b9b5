"""Builds assets/grid_2d.glb: a plate with a grid of 1000 x 500 cycles/m.   python3 grid_2d.py OUT.glb

SPDX-License-Identifier: MIT
"""
import sys

import numpy as np

from glb import Glb
from pattern import checker

LENGTH, DEPTH, THICKNESS, CHAMFER = 0.100, 0.060, 0.006, 0.0008  # m
SPATIAL_FREQUENCY = (1000, 500)                                  # cycles/m along x and z
UV_PER_METRE = 500                                               # one tile: two periods along x, one along z


def ring(grow, y):
    """The plate's outline at height y, `grow` larger all round, counter-clockwise seen from above."""
    x, z = LENGTH / 2 + grow, DEPTH / 2 + grow
    return np.array([(-x, y, z), (x, y, z), (x, y, -z), (-x, y, -z)])


def add_top(glb, material):
    corners = ring(0.0, 0.0)
    up = np.tile((0.0, 1.0, 0.0), (4, 1))
    glb.node("grid", material, corners, up, [(0, 1, 2), (0, 2, 3)], uvs=corners[:, (0, 2)] * UV_PER_METRE)


def add_sides(glb, material):
    """The plate's rim and underside, flat shaded: every face has its own four corners."""
    rings = [ring(0.0, 0.0), ring(CHAMFER, -CHAMFER), ring(CHAMFER, -THICKNESS)]
    faces = [(low[i], low[(i + 1) % 4], up[(i + 1) % 4], up[i]) for up, low in zip(rings, rings[1:]) for i in range(4)]
    faces.append(tuple(rings[-1][::-1]))
    positions, normals, triangles = [], [], []
    for a, b, c, d in faces:
        normal = np.cross(b - a, c - a)
        first = len(positions)
        positions += [a, b, c, d]
        normals += [normal / np.linalg.norm(normal)] * 4
        triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    glb.node("plate sides", material, np.array(positions), np.array(normals), triangles)


def main(out):
    glb = Glb()
    tile = checker(cycles=(SPATIAL_FREQUENCY[0] // UV_PER_METRE, SPATIAL_FREQUENCY[1] // UV_PER_METRE),
                   ridge=(226, 232, 222), groove=(74, 116, 108))
    knurl = {"spatial_frequency": list(SPATIAL_FREQUENCY), "amplitude": 0.0002, "stiffness": 400}
    add_top(glb, glb.material("grid 1 x 2 mm", roughness=0.4, metallic=0.4, tile=tile, knurl=knurl))
    add_sides(glb, glb.material("steel", roughness=0.3, metallic=0.9, colour=(0.42, 0.44, 0.47)))
    glb.save(out)


main(sys.argv[1])
