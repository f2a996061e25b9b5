"""The ridges that the extension draws, against the library: a HIP enters the surface at points of the lines, and its position
on the grating must be a whole number of cycles there. SPDX-License-Identifier: MIT"""
import math
import os
import subprocess
import sys
import time

import numpy as np

import installed
from installed import NAME, TOOLS, bpy

NEAR = 1e-7  # m, of coordinates: positions are float32
NEAR_SMOOTH = 2e-6  # m: on curved triangles the library looks for the felt point to 1e-6 m
PITCH = 0.001371  # m


def ridges():
    return sys.modules[NAME + ".ridges"]


class Ridges(installed.Case):
    def setUp(self):
        super().setUp()
        self.tag = sys.modules[NAME + ".tag"]
        self.drawn = sys.modules[NAME + ".overlay"]

    def make(self, add, tag, scale=(1.0, 1.0, 1.0), turn=(0.3, -0.4, 0.7), smooth=False, **arguments):
        """Replaces the plane by a tagged mesh at an odd place."""
        bpy.data.objects.remove(self.object)
        add(location=(0.02, -0.3, 0.11), **arguments)
        self.object = bpy.context.object
        self.object.rotation_euler, self.object.scale = turn, scale
        self.object.data.materials.append(self.material)
        for at in self.object.data.uv_layers[0].data: # no line on the edge of a mesh, where two triangles could be meant
            at.uv = at.uv[0] + 0.0131, at.uv[1] + 0.0271
        if smooth:
            self.object.data.polygons.foreach_set("use_smooth", [True] * len(self.object.data.polygons))
        whole = {"spatial_frequency": [1.0 / PITCH, 0.7 / PITCH], "amplitude": 1e-4, "stiffness": 400.0, **tag}
        self.tag.write(self.material, whole)
        bpy.context.view_layer.update()

    def shown(self):
        return self.drawn.shown_of(self.object, bpy.context.evaluated_depsgraph_get())

    def placed(self, rows, direction=False):
        """Rows of the object's space in glTF's scene."""
        linear = np.array(self.object.matrix_world.to_3x3())
        rows = rows @ (np.linalg.inv(linear) if direction else linear.T)
        rows = rows if direction else rows + np.array(self.object.matrix_world.translation)
        rows = rows / np.linalg.norm(rows, axis=-1, keepdims=True) if direction else rows
        return rows @ np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])

    def on_patches(self, points):
        """Points of a smooth mesh's triangles, on the PN triangles that are felt (Vlachos et al. 2001), with normals."""
        mesh = self.object.data
        mesh.calc_loop_triangles()
        at = np.array([triangle.vertices for triangle in mesh.loop_triangles])
        p = self.placed(np.array([vertex.co for vertex in mesh.vertices]))[at]
        n = self.placed(np.array([vertex.normal for vertex in mesh.vertices]), direction=True)[at]
        across = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        for point in self.placed(points):
            w = np.stack([(np.cross(p[:, i - 2] - point, p[:, i - 1] - point) * across).sum(1) for i in range(3)], 1)
            w /= (across * across).sum(1)[:, None]
            off = np.linalg.norm(np.einsum("nk,nki->ni", w, p) - point, axis=1) - np.minimum(0.0, w.min(1))
            t = int(np.argmin(off))
            w, corners, normals = w[t], p[t], n[t]
            control = {(i, j): (2.0 * corners[i] + corners[j] - (corners[j] - corners[i]) @ normals[i] * normals[i]) / 3.0
                       for i in range(3) for j in range(3) if i != j}
            edge = sum(control.values()) / 6.0
            patch = sum(w[i] ** 3 * corners[i] for i in range(3)) + sum(3.0 * w[i] ** 2 * w[j] * b for (i, j), b in control.items())
            patch = patch + 6.0 * w[0] * w[1] * w[2] * (1.5 * edge - 0.5 * corners.mean(axis=0))
            yield (*patch, *(w @ normals / np.linalg.norm(w @ normals)))

    def felt_at(self, points, smooth, warned):
        """(distance, cycles x, cycles y) at points of the object's space."""
        self.export(warned, export_apply=True)
        rows = self.on_patches(points) if smooth else [(*point, 0, 0, 0) for point in self.placed(points)]
        text = "".join("%.12g %.12g %.12g %.12g %.12g %.12g\n" % row for row in rows)
        done = subprocess.run([os.path.join(TOOLS, "cycles"), self.path], input=text, stdout=subprocess.PIPE, text=True, check=True)
        return np.array([line.split() for line in done.stdout.splitlines()], float)

    def check(self, source, smooth=False):
        """Every line must be a whole number of steps, to NEAR; prints the largest difference."""
        worst, count = 0.0, 0
        for part in self.shown().parts:
            self.assertEqual(part.felt.source, source)
            for k, lines in enumerate(part.segments):
                if not self.tag.frequencies(part.tag)[k]:
                    self.assertEqual(len(lines), 0)
                    continue
                self.assertGreater(len(lines), 20)
                some = lines[::max(1, len(lines) // 400)]
                some = some[np.linalg.norm(some[:, 1] - some[:, 0], axis=1) > 2e-5]  # off the corners of triangles
                felt = self.felt_at(some.mean(axis=1), smooth, part.felt.uneven > 0.0)
                self.assertLess(felt[:, 0].max(), 1e-3 if smooth else 2e-6)  # proxies are on the triangles, not the patches
                off = felt[:, 1 + k] / part.step
                error = np.abs(off - np.round(off)) * part.step / self.tag.frequencies(part.tag)[k]
                worst, count = max(worst, error.max()), count + len(error)
        where = self.id().rsplit("felt_", 1)[-1]
        print(f"overlay: {where}: {count} points, largest difference{' if curved' * smooth}: {worst * 1e9:.1f} nm")
        self.assertLess(worst, NEAR_SMOOTH if smooth else NEAR)

    def test_lines_are_where_it_is_felt_on_a_plane(self):
        self.make(bpy.ops.mesh.primitive_plane_add, {}, size=0.1, scale=(1.0, 0.5, 1.0))
        self.check("uvs")

    def test_lines_are_where_it_is_felt_on_a_cylinder(self):
        self.make(bpy.ops.mesh.primitive_cylinder_add, {}, radius=0.02, depth=0.1, scale=(1.0, 0.8, 0.5))
        self.check("uvs")

    def test_lines_are_where_it_is_felt_on_a_smooth_torus(self):
        self.make(bpy.ops.mesh.primitive_torus_add, {}, major_radius=0.04, minor_radius=0.015, smooth=True,
                  scale=(1.0, 0.8, 1.5))
        self.check("uvs", smooth=True)

    def test_lines_are_where_it_is_felt_on_a_turned(self):
        self.make(bpy.ops.mesh.primitive_uv_sphere_add, {"orientation": 0.4}, radius=0.03)
        self.check("uvs")

    def test_lines_are_where_it_is_felt_on_a_mirrored(self):
        self.make(bpy.ops.mesh.primitive_cylinder_add, {"orientation": 0.4}, radius=0.02, depth=0.1, scale=(-1.0, 1.2, 0.7))
        self.check("uvs")

    def test_lines_are_where_it_is_felt_on_a_box(self):
        self.make(bpy.ops.mesh.primitive_uv_sphere_add, {"coordinates": "box", "orientation": 0.4}, radius=0.03, scale=(1.0, 2.0, 0.7))
        self.check("box")

    def test_lines_are_where_it_is_felt_on_a_mirrored_box(self):
        self.make(bpy.ops.mesh.primitive_cube_add, {"coordinates": "box", "orientation": 0.4}, size=0.05, scale=(1.0, -2.0, 0.7))
        self.check("box")

    def test_lines_are_where_it_is_felt_by_an_axis(self):
        self.make(bpy.ops.mesh.primitive_uv_sphere_add, {"axis": [0.2, 1.0, -0.3]}, radius=0.03, scale=(1.0, 2.0, 0.7))
        self.check("axis")

    def test_lines_are_where_it_is_felt_by_the_panels_axis(self):
        self.make(bpy.ops.mesh.primitive_cylinder_add, {"spatial_frequency": 1.0 / PITCH}, radius=0.02, depth=0.1)
        self.material.knurl_across = (0.0, 0.0, 1.0)  # along the cylinder, which stands in Blender
        self.check("axis")
        z = self.shown().parts[0].segments[0][:, :, 2]
        self.assertLess(np.abs(z / PITCH - np.round(z / PITCH)).max() * PITCH, NEAR)

    def test_lines_are_where_it_is_felt_under_a_modifier(self):
        self.make(bpy.ops.mesh.primitive_monkey_add, {}, size=0.1)
        self.object.modifiers.new("smooth", "SUBSURF")
        self.check("uvs")

    def test_lines_are_where_it_is_felt_with_two_maps(self):
        self.make(bpy.ops.mesh.primitive_uv_sphere_add, {}, radius=0.03)
        layers = self.object.data.uv_layers
        layers.new(name="other").data.foreach_set("uv", [0.5 * i % 1.0 for i in range(2 * len(self.object.data.loops))])
        layers.active_index = 1
        layers[1].active_render = True
        self.check("uvs")

    def test_two_materials_have_their_own_scale(self):
        self.make(bpy.ops.mesh.primitive_cylinder_add, {}, radius=0.02, depth=0.1)
        other = bpy.data.materials.new("other")
        self.tag.write(other, {"spatial_frequency": 500.0, "amplitude": 1e-4, "stiffness": 300.0})
        self.object.data.materials.append(other)
        for polygon in self.object.data.polygons:
            polygon.material_index = int(len(polygon.vertices) > 4)  # the caps
        self.assertEqual([part.material for part in self.shown().parts], [self.material, other])
        self.check("uvs")

    def test_a_plane_of_100_mm_has_99_lines_at_1_mm(self):
        self.material.knurl_on = True
        lines = self.shown().parts[0].segments[0].mean(axis=1)[:, 0]
        self.assertEqual(len(lines), 2 * 101)  # two triangles; at both edges of the plane u is a whole number
        self.assertEqual(sorted({round(1e3 * (x + 0.05), 4) for x in lines}), [float(n) for n in range(101)])

    def test_many_ridges_are_thinned_evenly(self):
        corners = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
        felt = ridges().Felt(corners[:, :, :2].copy(), "box")
        for limit, step in ((1000, 1), (999, 2), (400, 5), (150, 10), (99, 20), (25, 50)):
            lines, none, found = ridges().lines(corners, felt, (999.5, 0.0), limit)
            self.assertEqual((found, len(none)), (step, 0))
            self.assertLessEqual(len(lines), limit)
            cycles = 999.5 * lines[:, 0, 0] / step
            self.assertEqual(sorted(np.round(cycles).astype(int)), list(range(999 // step + 1)))

    def test_a_frequency_beyond_reason_is_thinned_too(self):
        corners = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
        for frequency, step in ((4e30, 10 ** 30), (9e299, 2 * 10 ** 299)):
            felt = ridges().Felt(corners[:, :, :2].copy(), "box")
            self.assertEqual(ridges().lines(corners, felt, (frequency, 0.0), 6)[2], step)

    def test_changes_are_seen_at_once(self):
        self.material.knurl_on = True
        before = self.shown()
        self.assertIs(self.shown(), before)
        self.material.knurl_ridges = 2.0
        self.assertEqual(len(self.shown().parts[0].segments[0]), len(before.parts[0].segments[0]) // 2 + 1)
        self.object.scale = (2.0, 1.0, 1.0)
        bpy.context.view_layer.update()
        self.assertEqual(len(self.shown().parts[0].segments[0]), len(before.parts[0].segments[0]))
        self.object.data.transform(((0.5, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)))
        self.object.data.update()
        bpy.context.view_layer.update()
        self.assertEqual(len(self.shown().parts[0].segments[0]), len(before.parts[0].segments[0]) // 2 + 1)
        self.material.knurl_on = False
        self.assertIsNone(self.shown())

    def test_a_large_mesh_is_measured_in_time_and_a_larger_one_is_left_out(self):
        self.make(bpy.ops.mesh.primitive_grid_add, {}, x_subdivisions=386, y_subdivisions=386, size=0.2)
        begin = time.monotonic()
        self.assertEqual(self.shown().too_many, 0)
        taken = time.monotonic() - begin
        lines = sum(len(part) for part in self.shown().parts[0].segments)
        print(f"overlay: {len(self.object.data.polygons) * 2} triangles, {lines} segments: {taken:.2f} s")
        self.assertLessEqual(lines, ridges().LIMIT)
        self.make(bpy.ops.mesh.primitive_grid_add, {}, x_subdivisions=390, y_subdivisions=390, size=0.2)
        self.assertEqual((self.shown().parts, self.shown().too_many), ([], 2 * 390 * 390))
        self.assertIn("Ridges are not drawn", sys.modules[NAME + ".panel"].warnings_of(
            self.material, self.object, bpy.context.evaluated_depsgraph_get())[0])

    def test_a_direction_is_turned_back_exactly(self):
        self.assertEqual(self.tag.turned(self.tag.turned([1.0, 2.0, 3.0], True), False), [1.0, 2.0, 3.0])
        self.assertEqual(math.copysign(1.0, self.tag.turned([0.0, 0.0, 1.0], True)[1]), 1.0)
