"""Torques and grippers, over the stand-in for Force Dimension's library. usage: test_torque.py [-v] KNURL ASSETS
SPDX-License-Identifier: MIT"""
import ctypes
import os
import sys
import unittest

import numpy as np

import knurl

sys.argv.pop()
STUB = os.path.join(os.path.dirname(os.path.abspath(sys.argv.pop())), "tests/libknurl_stub_dhd.so")
TYPE, SIGMA7 = 0, 104


class Told(ctypes.Structure):
    """stub_dhd_torque: its motors' torque and gripper's force now, and the largest since it was asked last."""

    _fields_ = [("torque", ctypes.c_double * 3), ("grip", ctypes.c_double), ("most_torque", ctypes.c_double),
                ("most_grip", ctypes.c_double), ("alone", ctypes.c_int), ("gravity", ctypes.c_int)]


class Torques(unittest.TestCase):
    def setUp(self):
        stub = ctypes.CDLL(STUB)
        stub.stub_dhd_set(TYPE, SIGMA7)
        self.tell = stub.stub_dhd_tell_torque
        self.device = knurl.Device(f"dhd:?library={STUB}")
        self.told()

    def tearDown(self):
        self.device.close()

    def told(self):
        told = Told()
        self.tell(ctypes.byref(told))
        return told

    def play(self, torque_callback, scene=None, **options):
        """A loop of 50 ticks, without a scene with no force; it runs in real time, as the library does."""
        if scene is None:
            options["force_callback"] = lambda tick, sample: (0, 0, 0)
        loop = knurl.Loop(scene, self.device, torque_callback=torque_callback, ramp_s=0.0, tick_limit=50, **options)
        loop.start()
        self.assertTrue(loop.wait(10.0))
        return loop

    def test_a_torque_and_a_grippers_force_reach_the_device(self):
        grips = []

        def turn(tick, sample):
            grips.append(sample.grip)
            return knurl.Torque((0.01, 0.02, 0.03), grip=1.5)
        self.play(turn)
        told = self.told()
        self.assertAlmostEqual(told.most_torque, np.sqrt(0.0014), places=12)
        self.assertAlmostEqual(told.most_grip, 1.5, places=12)
        self.assertEqual(grips, [0.2] * 50) # rad, the stand-in's

    def test_three_numbers_are_a_torque(self):
        self.play(lambda tick, sample: np.array([0.0, 0.05, 0.0]))
        told = self.told()
        self.assertAlmostEqual(told.most_torque, 0.05, places=12)
        self.assertEqual(told.most_grip, 0.0)

    def test_a_torque_is_shortened_to_the_devices(self):
        self.play(lambda tick, sample: (1e3, 0, 0))
        self.assertAlmostEqual(self.told().most_torque, self.device.info["max_torque"], places=12)

    def test_beside_a_scene_its_ticks_are_recorded_all_the_same(self):
        scene = knurl.Scene()
        scene.add_plane()
        scene.commit()
        loop = self.play(lambda tick, sample: (0, 0, 0.04), scene, record=("tick", "force"))
        np.testing.assert_array_equal(loop.ticks["tick"], np.arange(50))
        self.assertAlmostEqual(self.told().most_torque, 0.04, places=12)

    def test_what_is_no_torque_ends_the_loop_with_none(self):
        for wrong, why in (((1, 2), "torque: expected 3 numbers"), (knurl.Torque(grip="x"), "could not convert"), (None, "torque: expected")):
            with self.assertRaisesRegex((ValueError, TypeError), why):
                self.play(lambda tick, sample: wrong) # pylint: disable=cell-var-from-loop
            self.assertEqual(self.told().most_torque, 0.0)


if __name__ == "__main__":
    unittest.main()
