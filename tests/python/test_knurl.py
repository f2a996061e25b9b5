"""The Python module, as it is installed. usage: test_knurl.py [-v] KNURL ASSETS
SPDX-License-Identifier: MIT"""
import gc
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

import knurl

ASSETS = sys.argv.pop()
TOOL = sys.argv.pop()
STRAIGHT = {"resolution": 0.0, "workspace": ((0, 0, 0), np.eye(3), 1.0)}


def pressed(depth, rows=1000):
    """Positions that come down to so deep below z = 0 and stay there."""
    z = np.maximum(-depth, 0.001 - 1e-5 * np.arange(rows))
    return np.column_stack([np.zeros(rows), np.zeros(rows), z])


class Module(unittest.TestCase):
    def test_a_smooth_plate_answers_with_stiffness_times_depth(self):
        scene = knurl.Scene()
        plate = scene.add_plane(name="plate", material=knurl.Material(stiffness=500.0))
        scene.configure_hip(**STRAIGHT)
        scene.commit()
        ticks = scene.tick(pressed(0.002))
        self.assertEqual(ticks["force"].shape, (1000, 3))
        np.testing.assert_allclose(ticks["force"][-1], [0.0, 0.0, 1.0], atol=1e-12)
        np.testing.assert_allclose(ticks["depth"][-1], 0.002)
        np.testing.assert_array_equal(ticks["force"][:100], 0.0)
        np.testing.assert_array_equal(ticks["tick"], np.arange(1000))
        self.assertEqual(ticks["surface"][-1], plate.id)
        self.assertEqual([surface.name for surface in scene.surfaces], ["plate"])
        latest, counts = scene.latest()
        np.testing.assert_array_equal(latest["force"], ticks["force"][-1])
        self.assertEqual(counts["ticks"], 1000)

    def test_even_sensation_lowers_every_height_by_its_gain(self):
        along = np.arange(200) * 0.0002 # 200 ridges a second: a gain of 0.40, as samples/study/felt.md has it
        heights = {}
        for even in ("off", "model", "response"):
            scene = knurl.Scene()
            scene.add_plane(material=knurl.Material(spatial_frequency=(1000.0, 0.0), amplitude=0.0002, stiffness=500.0))
            scene.configure_hip(**STRAIGHT)
            if even == "response": # felt equally strongly at all frequencies but for the harmonics
                with tempfile.TemporaryDirectory() as folder:
                    path = os.path.join(folder, "response.csv")
                    with open(path, "w", encoding="utf-8") as file:
                        file.write("# knurl response 1\nfrequency_hz,gain\n20,39.0625\n40,39.0625\n250,1\n310,1.5376\n")
                    scene.set_even(path)
            else:
                scene.set_even(on=even == "model")
            scene.commit()
            positions = np.column_stack([along, np.zeros(200), np.full(200, -0.002)])
            heights[even] = scene.tick(positions, np.broadcast_to([0.2, 0.0, 0.0], (200, 3)))["height"][50:]
        np.testing.assert_allclose(heights["model"], 0.402 * heights["off"], atol=2e-3 * 0.0002)
        np.testing.assert_allclose(heights["response"], heights["off"], atol=1e-2 * 0.0002)
        with self.assertRaisesRegex(knurl.KnurlError, "mass is not known"):
            scene.set_even(mass=0.0)
        with self.assertRaises(FileNotFoundError):
            scene.set_even("nothing.csv")

    def test_a_mesh_of_arrays_is_felt_as_the_plane_is(self):
        corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * 0.05
        scene = knurl.Scene()
        scene.add_mesh(corners, [[0, 1, 2], [0, 2, 3]], axis=(1, 0, 0), material=knurl.Material(stiffness=400.0))
        scene.configure_hip(**STRAIGHT)
        scene.commit()
        np.testing.assert_allclose(scene.tick(pressed(0.001))["force"][-1], [0.0, 0.0, 0.4], atol=1e-7)

    def test_a_mesh_with_normals_is_felt_as_smooth_as_they_say(self):
        x = np.array([-0.01, 0.01]) # a chord of a cylinder of 50 mm round y, whose top is 50 mm up
        corners = np.array([[a, b, np.sqrt(0.05**2 - a**2)] for a in x for b in (-0.02, 0.02)])
        normals = corners * [1, 0, 1] / 0.05
        top = {}
        for name, given, smooth in (("flat", None, None), ("smooth", normals, None), ("off", normals, False)):
            scene = knurl.Scene()
            scene.add_mesh(corners, [[0, 2, 3], [0, 3, 1]], normals=given, smooth=smooth, axis=(0, 1, 0),
                           material=knurl.Material(stiffness=400.0))
            scene.configure_hip(**STRAIGHT)
            scene.commit()
            top[name] = scene.tick(pressed(0.002) + [0, 0, 0.05])["force"][-1][2]
        self.assertAlmostEqual(top["smooth"], 0.4 * 2.0, delta=0.016) # 2 mm below the cylinder; the patch is 2 % off
        self.assertEqual(top["off"], top["flat"])
        self.assertAlmostEqual(top["flat"], 0.4 * (2.0 - 1e3 * (0.05 - np.sqrt(0.05**2 - 0.01**2))), places=3)

    def test_normals_are_computed_if_asked_for(self):
        angles = np.arange(9) * 0.1
        corners = np.array([[0.05 * np.cos(a), 0.05 * np.sin(a), z] for a in angles for z in (-0.02, 0.02)])
        quads = [[i, i + 2, i + 3, i, i + 3, i + 1] for i in range(0, 16, 2)]
        surface = knurl.Scene().add_mesh(corners, np.reshape(quads, (-1, 3)), smooth=True, axis=(0, 0, 1))
        self.assertEqual((surface.info["curved_triangles"], surface.info["hard_edges"]), (16, 0))
        np.testing.assert_allclose(surface.info["facet_angle"][1], 0.1, rtol=1e-4)

    def test_a_batch_is_the_same_as_its_rows_one_by_one(self):
        results = []
        for parts in (1, 500):
            scene = knurl.Scene()
            scene.add_plane(material=knurl.Material(400.0, (700.0, 0.0), 2e-4, method="S2"))
            scene.configure_hip(**STRAIGHT)
            scene.commit()
            positions = pressed(0.001)
            positions[:, 0] = 0.00007 * np.arange(1000)
            results.append(np.concatenate([scene.tick(part) for part in np.array_split(positions, parts)]))
        for name in set(results[0].dtype.names) - {"surface"}: # an id is of its scene
            np.testing.assert_array_equal(results[0][name], results[1][name])
        self.assertGreater(results[0]["event"].max(), 10)

    def test_the_closest_points_of_a_plate_are_below_or_at_its_rim(self):
        scene = knurl.Scene()
        plate = scene.add_plane(half_extents=(0.05, 0.05))
        scene.commit()
        found = scene.closest([(0.01, 0.02, 0.003), (0.08, 0.0, 0.04), (0.0, 0.0, 2.0)])
        np.testing.assert_allclose(found["distance"], (0.003, 0.05, 0.0), atol=1e-12)
        np.testing.assert_allclose(found["position"], [(0.01, 0.02, 0.0), (0.05, 0.0, 0.0), (0.0, 0.0, 0.0)], atol=1e-12)
        self.assertEqual(found["surface"].tolist(), [plate.id, plate.id, 0])

    def test_a_gltf_file_is_loaded_and_stroked_by_the_fake_device(self):
        scene = knurl.Scene()
        surfaces = scene.load(os.path.join(ASSETS, "plate_1d.glb"))
        self.assertEqual(len(surfaces), 3)
        scene.commit()
        device = knurl.Device("fake")
        device.lay_stroke(scene, surfaces[0])
        loop = knurl.Loop(scene, device, tick_limit=2000)
        loop.step(2000)
        stats = loop.stats
        self.assertEqual((stats["state"], stats["ticks"], stats["overruns"], stats["watchdog_trips"]), ("done", 2000, 0, 0))
        self.assertGreater(stats["tick_ns"]["p99"], 0.0)
        self.assertEqual(repr(loop), "<knurl.Loop: done, 2000 ticks at 1000 Hz>")
        self.assertGreater(scene.latest()[1]["contact_ticks"], 1000)

    def test_a_files_name_need_not_be_utf8(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(os.fsencode(folder), b"plate\xff.glb")
            shutil.copy(os.path.join(ASSETS, "plate_1d.glb"), path)
            for name in (path, os.fsdecode(path)):
                self.assertEqual(len(knurl.Scene().load(name)), 3)

    def test_a_loop_runs_beside_python(self):
        scene = knurl.Scene()
        scene.add_plane()
        scene.commit()
        with knurl.Loop(scene, knurl.Device("fake")) as loop:
            deadline = time.monotonic() + 10.0
            while loop.stats["ticks"] < 20 and time.monotonic() < deadline:
                time.sleep(0.01)
            self.assertGreaterEqual(loop.stats["ticks"], 20)
        self.assertEqual(loop.stats["state"], "done")

    def test_what_is_wrong_is_told_in_the_librarys_words(self):
        scene = knurl.Scene()
        with self.assertRaisesRegex(knurl.KnurlError, "stiffness: expected") as caught:
            scene.add_plane(material=knurl.Material(stiffness=-1.0))
        self.assertEqual(caught.exception.code, knurl.lib.KNURL_ERROR_ARGUMENT)
        with self.assertRaisesRegex(knurl.KnurlError, "nowhere.glb: no such file"):
            scene.load("nowhere.glb")
        with self.assertRaisesRegex(knurl.KnurlError, "S1"):
            scene.add_plane(material=knurl.Material(method="S9"))
        with self.assertRaisesRegex(knurl.KnurlError, "committed"):
            scene.tick([[0, 0, 0]])
        with self.assertRaises(knurl.KnurlError):
            knurl.Device("nothing")
        surface = scene.add_plane()
        surface.remove()
        with self.assertRaises(knurl.KnurlError):
            surface.move((0, 0, 0))

    def test_arrays_of_another_shape_are_refused_before_the_library_sees_them(self):
        scene = knurl.Scene()
        for wrong in ([0, 0, 0], [[0, 0]], np.zeros((2, 2, 3))):
            with self.assertRaisesRegex(ValueError, "positions"):
                scene.tick(wrong)
        with self.assertRaisesRegex(ValueError, "uvs: expected 3 rows"):
            scene.add_mesh(np.eye(3), uvs=[[0, 0]])
        with self.assertRaisesRegex(ValueError, "half_extents"):
            scene.add_plane(half_extents=(1, 2, 3))

    def test_strided_and_integer_arrays_are_taken(self):
        scene = knurl.Scene()
        scene.add_plane()
        scene.configure_hip(**STRAIGHT)
        scene.commit()
        wide = np.zeros((10, 6), dtype=int)
        self.assertEqual(len(scene.tick(wide[:, ::2])), 10)
        self.assertEqual(len(scene.tick(np.zeros((0, 3)))), 0)

    def test_metrics_are_those_that_the_tool_prints(self):
        for method in ("T1", "T2", "T3"):
            for period_ms in (2.5, 7.3, 10.0, 40.0):
                printed = json.loads(subprocess.run([TOOL, "metrics", "--method", method, "--period-ms", str(period_ms),
                                                     "--amplitude", "0.7", "--rate", "1000"], check=True, capture_output=True,
                                                    text=True).stdout)
                found = knurl.metrics.temporal(method, 1e-3 * period_ms, 0.7)
                self.assertEqual(list(found), list(printed))
                for name in printed:
                    if name == "pcc":
                        np.testing.assert_allclose(list(found[name].values()), list(printed[name].values()), atol=1e-12)
                    else:
                        # the tool's spectra are single precision
                        tones = {"false_tones", "felt_false_tones"}
                        np.testing.assert_allclose(found[name], printed[name], rtol=1e-5 if name in tones else 1e-9,
                                                   atol=1e-6 if name in tones else 1e-12, err_msg=name)

    def test_metrics_of_signals_with_a_closed_form(self):
        square = knurl.metrics.wave("T1", 0.01, 2.0)
        np.testing.assert_array_equal(square, [2.0] * 5 + [-2.0] * 5)
        line = knurl.metrics.dominant(square, 1000.0) # held, it is a true square wave
        np.testing.assert_allclose([line["hz"], line["amplitude"]], [100.0, 8.0 / np.pi])
        t = np.arange(2000) / 1000.0
        tone = 0.3 * np.sin(2 * np.pi * 50.0 * t)
        line = knurl.metrics.dominant(tone, 1000.0)
        np.testing.assert_allclose([line["hz"], line["amplitude"]], [50.0, 0.3 * np.sinc(0.05)])
        steady = knurl.metrics.steady(tone + 0.1, 1000.0, 50.0)
        np.testing.assert_allclose([steady["level"], steady["push"], steady["net"]], [0.3, 0.1, 0.1])
        np.testing.assert_allclose(knurl.metrics.pcc(tone, np.cos(2 * np.pi * 50.0 * t)), 0.0, atol=1e-12)
        np.testing.assert_allclose(knurl.metrics.pcc(square, -3.0 * square), -1.0)
        self.assertEqual(len(knurl.metrics.wave("T3", 0.01, ticks=25)), 25)

    def test_metrics_refuse_what_they_cannot_measure(self):
        with self.assertRaisesRegex(ValueError, "expected T1, T2 or T3, found 'S1'"):
            knurl.metrics.wave("S1", 0.01)
        with self.assertRaisesRegex(knurl.KnurlError, "period"):
            knurl.metrics.wave("T1", -1.0)
        with self.assertRaisesRegex(ValueError, "finite numbers"):
            knurl.metrics.dominant([1.0, float("nan")], 1000.0)
        with self.assertRaisesRegex(ValueError, "cycles: expected a number for each of 3 values, found 2"):
            knurl.metrics.step([1.0, -1.0, 1.0], [0.0, 0.5])
        with self.assertRaisesRegex(ValueError, "50 ms"):
            knurl.metrics.steady([1.0, 2.0], 1000.0, 50.0)

    def test_objects_go_in_any_order(self):
        for order in ("scene", "device", "loop"):
            parts = {"scene": knurl.Scene(), "device": knurl.Device("fake")}
            parts["scene"].add_plane()
            parts["scene"].commit()
            parts["loop"] = knurl.Loop(parts["scene"], parts["device"])
            parts["loop"].start()
            del parts[order]
            gc.collect()
            parts.clear()
            gc.collect()


if __name__ == "__main__":
    unittest.main()
