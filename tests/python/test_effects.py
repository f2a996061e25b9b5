"""Effects. SPDX-License-Identifier: MIT"""
import sys
import unittest

import numpy as np

import knurl


def free_scene():
    scene = knurl.Scene()
    scene.configure_hip(resolution=0.0, max_force=100.0, protections=0, workspace=((0, 0, 0), np.eye(3), 1.0))
    scene.commit()
    return scene


class Effects(unittest.TestCase):
    def test_notches_and_a_guide_follow_their_formulas(self):
        scene = free_scene()
        scene.set_effects([knurl.Effect("detent", axis=(1, 0, 0), stiffness=300.0, damping=0.0, spacing=0.005),
                           knurl.Effect("line", axis=(2, 0, 0), stiffness=400.0, damping=2.0, max_force=50.0)])
        t = np.linspace(0.0, 1.0, 500)
        at = np.column_stack([0.03 * t, 0.002 * np.sin(9 * t), 0.001 * t])
        v = np.column_stack([0.03 + 0 * t, 0.018 * np.cos(9 * t), 0.001 + 0 * t])
        force = scene.tick(at, v)["force"]
        turn = 2 * np.pi / 0.005
        np.testing.assert_allclose(force[:, 0], -300.0 / turn * np.sin(turn * at[:, 0]), atol=1e-12)
        np.testing.assert_allclose(force[:, 1:], -400.0 * at[:, 1:] - 2.0 * v[:, 1:], atol=1e-12)

    def test_an_anchor_moves_in_the_given_time_and_an_empty_list_ends_it(self):
        scene = free_scene()
        effect = knurl.Effect(damping=0.0)
        scene.set_effects([effect])
        effect.anchor = (0.01, 0.0, 0.0)
        scene.set_effects([effect], seconds=0.01)
        np.testing.assert_allclose(scene.tick(np.zeros((12, 3)))["force"][:, 0], np.minimum(np.arange(1, 13) * 0.2, 2.0), atol=1e-9)
        scene.set_effects()
        self.assertEqual(scene.tick(np.zeros((1, 3)))["force"].any(), False)

    def test_a_coil_has_the_force_of_notches_and_the_motors_their_band(self):
        scene = free_scene()
        scene.set_effects([knurl.Effect("detent", axis=(1, 0, 0), stiffness=500.0, damping=0.0, spacing=0.002)])
        t = np.arange(3000) / 1000.0
        ticks = scene.tick(np.column_stack([0.2 * t, 0 * t, 0 * t])) # 100 Hz
        samples, rumble = knurl.coil(ticks)
        size = 500.0 * 0.002 / (2 * np.pi)
        self.assertEqual(len(samples), 144000)
        line = 2.0 * abs(np.exp(-2j * np.pi * 100.0 * np.arange(48000) / 48000.0) @ samples[-48000:]) / 48000
        self.assertAlmostEqual(line, size, delta=0.03 * size) # within 0.2 dB
        w = np.tan(np.pi * 0.1) / np.tan(np.pi * 0.08) # Butterworth filters of second order at 80 Hz
        for motor, gain in enumerate((1.0, w * w) / np.sqrt(1.0 + w**4)):
            self.assertAlmostEqual(np.sqrt((rumble[-1000:, motor]**2).mean()), gain * size, delta=0.01 * size)

    def test_the_defaults_are_the_librarys(self):
        made = knurl.ffi.new("knurl_effect *")
        knurl.check(knurl.lib.knurl_effect_prepare(knurl.lib.KNURL_EFFECT_LINE, made))
        own = knurl.Effect("line")
        for name in ("stiffness", "damping", "spacing", "max_force"):
            self.assertEqual(getattr(made, name), getattr(own, name))
        self.assertEqual(tuple(made.axis), own.axis)

    def test_what_is_wrong_is_named(self):
        scene = free_scene()
        with self.assertRaisesRegex(ValueError, "kind: expected one of spring, detent, damper, line, plane, force, found 'glue'"):
            scene.set_effects([knurl.Effect("glue")])
        with self.assertRaisesRegex(knurl.KnurlError, r"effects\[1\]\.stiffness: expected 0 or 1 to 1000000000 N/m, found nan"):
            scene.set_effects([knurl.Effect(), knurl.Effect(stiffness=float("nan"))])
        with self.assertRaisesRegex(ValueError, "axis: expected 3 numbers"):
            scene.set_effects([knurl.Effect(axis=(1.0, 0.0))])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
