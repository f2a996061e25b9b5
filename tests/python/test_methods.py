"""Own methods. SPDX-License-Identifier: MIT"""
import sys
import time
import unittest

import numpy as np

import knurl

FS, AMPLITUDE = 1000.0, 0.2e-3


def triangle(tick, memory):
    return 4.0 * abs(tick.cycles[0] % 1.0 - 0.5) - 1.0


def positions(count=3000, speed=0.08):
    t = np.arange(count) / 1000.0
    return np.column_stack([speed * t - 0.1, 0 * t, 0 * t - 0.002])


def scene_of(method):
    scene = knurl.Scene()
    scene.add_plane(half_extents=(0.2, 0.05), material=knurl.Material(400.0, (FS, 0.0), AMPLITUDE, method=method))
    scene.configure_hip(resolution=0.0, workspace=((0, 0, 0), np.eye(3), 1.0))
    scene.commit()
    return scene


class OwnMethods(unittest.TestCase):
    def test_a_scene_plays_what_the_function_returns(self):
        knurl.add_method("triangle", triangle)
        scene = scene_of("triangle")
        self.assertEqual(scene.surfaces[0].material.method, "triangle")
        ticks = scene.tick(positions())
        phase = FS * positions()[:, 0]
        np.testing.assert_allclose(ticks["height"], AMPLITUDE * (4.0 * abs(phase % 1.0 - 0.5) - 1.0), atol=1e-9 * AMPLITUDE)
        verdict = ticks.verdict(amplitude=AMPLITUDE)
        self.assertAlmostEqual(verdict.level, 8.0 / np.pi**2, delta=0.02) # of a triangle's first harmonic
        self.assertLessEqual(verdict.crest, 1.0)
        self.assertAlmostEqual(verdict.played, verdict.crossed, delta=1.0)

    def test_a_grating_gives_it_both_phases_and_its_memory(self):
        seen = []

        def count(tick, memory):
            memory[0] += 1.0
            seen.append((*tick.cycles, *tick.velocity, *tick.spatial_frequency, tick.temporal_frequency, tick.period, memory[0]))
            return 0.0

        knurl.add_method("count", count)
        grating = knurl.Grating((1000.0, 500.0), method="count")
        grating.play([[0.001, 0.002], [0.003, 0.004]], [[0.1, 0.0], [0.0, -0.4]])
        np.testing.assert_allclose(seen, [(1.0, 1.0, 0.1, 0.0, 1000.0, 500.0, 100.0, 1e-3, 1.0),
                                          (3.0, 2.0, 0.0, -0.4, 1000.0, 500.0, 200.0, 1e-3, 2.0)], atol=1e-12)

    def test_whatever_it_returns_is_clamped_and_counted(self):
        returned = iter([float("nan"), float("inf"), 1e30, -1e30, 1.5, 1.25])
        knurl.add_method("wild", lambda tick, memory: next(returned), crest=1.25)
        played = knurl.Grating(method="wild").play(np.zeros((6, 2)), np.zeros((6, 2)))["height"]
        self.assertEqual(list(played), [0.0, 0.0, 1.25, -1.25, 1.25, 1.25])
        number = next(i for i in range(1, 30) if knurl.ffi.string(knurl.lib.knurl_method_name(i)) == b"wild")
        self.assertEqual(knurl.lib.knurl_method_get_faults(number), 5)

    def test_an_exception_is_raised_by_the_tick_and_the_next_ticks_go_on(self):
        calls = []

        def fails(tick, memory):
            calls.append(1)
            return 1.0 if len(calls) < 4 else 1.0 / 0.0

        knurl.add_method("fails", fails)
        scene = scene_of("fails")
        with self.assertRaises(ZeroDivisionError):
            scene.tick(positions())
        self.assertEqual(len(calls), 4)
        knurl.add_method("fails", lambda tick, memory: 0.5)
        np.testing.assert_allclose(scene.tick(positions())["height"][1:], 0.5 * AMPLITUDE)
        knurl.add_method("fails", lambda tick, memory: "high")
        with self.assertRaisesRegex(ValueError, "high"):
            knurl.Grating(method="fails").play(np.zeros((2, 2)), np.zeros((2, 2)))

    def test_a_loop_plays_it_and_raises_its_exception(self):
        def fails(tick, memory):
            raise RuntimeError("in a loop")

        knurl.add_method("looped", triangle)
        scene, device = scene_of("looped"), knurl.Device("fake")
        device.lay_stroke(scene, scene.surfaces[0])
        loop = knurl.Loop(scene, device, record=("height",))
        loop.step(2000)
        self.assertGreater(abs(loop.ticks["height"]).max(), 0.9 * AMPLITUDE)
        knurl.add_method("looped", fails)
        with self.assertRaisesRegex(RuntimeError, "in a loop"):
            loop.step(2000)

    def test_an_exception_of_a_replaced_function_is_forgotten(self):
        def fails(tick, memory):
            raise RuntimeError("of the first cell")

        knurl.add_method("cell", fails)
        scene, device = scene_of("cell"), knurl.Device("fake")
        device.lay_stroke(scene, scene.surfaces[0])
        raised = knurl.methods._own["cell"]
        loop = knurl.Loop(scene, device)
        loop.start()
        while raised.error is None:
            time.sleep(0.001)
        loop.close()
        knurl.add_method("cell", lambda tick, memory: 0.5)
        np.testing.assert_allclose(scene.tick(positions())["height"][1:], 0.5 * AMPLITUDE)

    def test_what_is_wrong_is_refused(self):
        for name in ("S2", "two words", ""):
            with self.assertRaisesRegex(knurl.KnurlError, "name: expected "):
                knurl.add_method(name, triangle)
        with self.assertRaisesRegex(knurl.KnurlError, "crest: expected above 0 and up to 10"):
            knurl.add_method("good", triangle, crest=11.0)
        knurl.add_method("again", triangle, crest=2.0)
        with self.assertRaisesRegex(ValueError, "crest: expected 2, because there is a method 'again', found 3"):
            knurl.add_method("again", triangle, crest=3.0)
        with self.assertRaisesRegex(knurl.KnurlError, "bandlimited, .*again.*found 'nobody'"):
            knurl.Material(method="nobody")._desc()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:-2])
