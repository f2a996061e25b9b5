"""Ticks as tables, verdicts and records. SPDX-License-Identifier: MIT"""
import pickle
import sys
import time
import unittest

import numpy as np

import knurl

FS, AMPLITUDE, SPEED = 1000.0, 2e-4, 0.1 # 100 Hz


def stroked(method=None, count=3000, **options):
    """Ticks of a hand 1 mm below a plate, along x at a steady speed, at exact positions and velocities."""
    scene = knurl.Scene()
    scene.add_plane(half_extents=(1, 1), material=knurl.Material(400.0, (FS, 0.0), AMPLITUDE, method=method))
    scene.configure_hip(resolution=0.0, workspace=((0, 0, 0), np.eye(3), 1.0), protections=0)
    scene.commit()
    x = SPEED * np.arange(count) / 1000.0 + 1.3e-4
    positions = np.column_stack([x, np.zeros(count), np.maximum(-0.001, 0.005 - 1e-4 * np.arange(count))])
    return scene.tick(positions, np.tile([SPEED, 0.0, 0.0], (count, 1)), **options)


class Tables(unittest.TestCase):
    def test_chosen_fields_are_those_of_all(self):
        whole, part = stroked(), stroked(fields=("height", "force"))
        self.assertEqual(part.dtype.names, ("height", "force"))
        self.assertEqual(part.itemsize, 4 * 8)
        for name in part.dtype.names:
            np.testing.assert_array_equal(part[name], whole[name])
        self.assertNotIn("reserved", whole.dtype.names)
        with self.assertRaisesRegex(ValueError, "fields: expected some of .*, found 'forces'"):
            stroked(fields=["forces"])

    def test_slices_and_pickles_keep_the_rate_and_columns_are_plain_arrays(self):
        ticks = stroked()
        for kept in (ticks[100:200], ticks[::7], pickle.loads(pickle.dumps(ticks))):
            self.assertEqual((type(kept), kept.rate), (knurl.Ticks, 1000.0))
        self.assertIs(type(ticks["force"]), np.ndarray)
        self.assertIs(type(ticks["depth"]), np.ndarray)
        self.assertEqual(knurl.as_ticks(np.concatenate([ticks, ticks]), 1000.0).verdict().played, 2 * ticks.verdict().played)
        with self.assertRaisesRegex(ValueError, "update rate"):
            np.empty(3, ticks.dtype).view(knurl.Ticks).verdict()

    def test_masked_rows_are_without_a_hand(self):
        scene = knurl.Scene()
        scene.add_plane()
        scene.configure_hip(resolution=0.0, workspace=((0, 0, 0), np.eye(3), 1.0))
        scene.commit()
        positions = np.ma.masked_array(np.tile([0.0, 0.0, -0.001], (10, 1)), np.zeros((10, 3), bool))
        positions[5] = np.ma.masked
        absent = scene.tick(positions)["flags"] & knurl.lib.KNURL_TICK_ABSENT != 0
        np.testing.assert_array_equal(absent, np.arange(10) == 5)
        self.assertFalse((scene.tick(positions.data)["flags"] & knurl.lib.KNURL_TICK_ABSENT).any()) # it is not kept

    def test_parts_are_the_whole(self):
        positions = np.column_stack([np.linspace(0, 0.04, 5000), np.zeros(5000), np.full(5000, -0.001)])
        results = []
        for feed in (positions, iter(np.array_split(positions, 7))):
            scene = knurl.Scene()
            scene.add_plane(material=knurl.Material(400.0, (FS, 0.0), AMPLITUDE))
            scene.configure_hip(resolution=0.0, workspace=((0, 0, 0), np.eye(3), 1.0))
            scene.commit()
            results.append(np.concatenate(list(scene.chunks(feed, rows=1700, fields=["height"]))))
        scene.configure_hip(resolution=0.0, workspace=((0, 0, 0), np.eye(3), 1.0))
        results.append(scene.tick(positions, fields=["height"]))
        for result in results[1:]:
            np.testing.assert_array_equal(result, results[0])

    def test_a_frame_has_a_column_a_number(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        ticks = stroked(count=100)
        frame = ticks.to_frame(["depth", "force", "hip", "cycles"], units={"depth": "mm", "force": "mN", "hip": "um"})
        self.assertEqual(list(frame.columns), ["depth", "force_x", "force_y", "force_z", "hip_x", "hip_y", "hip_z", "cycles_x",
                                               "cycles_y"])
        np.testing.assert_allclose(frame["depth"], 1e3 * ticks["depth"])
        np.testing.assert_allclose(frame["force_z"], 1e3 * ticks["force"][:, 2])
        np.testing.assert_allclose(frame["hip_x"], 1e6 * ticks["hip"][:, 0])
        np.testing.assert_allclose(frame.index, np.arange(100) / 1000.0)
        self.assertEqual(frame.attrs["units"]["force_x"], "mN")
        self.assertIsInstance(ticks.to_frame(), pandas.DataFrame)
        with self.assertRaisesRegex(ValueError, "units: expected one of m, km, mm, um for 'depth', found 'inch'"):
            ticks.to_frame(units={"depth": "inch"})
        with self.assertRaisesRegex(ValueError, "no unit for 'flags'"):
            ticks.to_frame(units={"flags": "N"})

    def test_a_plot_has_what_was_felt(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not installed")
        matplotlib.use("Agg")
        ticks = stroked(count=500)
        axes = ticks.plot()
        np.testing.assert_array_equal(axes[0].lines[0].get_ydata(), ticks["temporal_frequency"])
        np.testing.assert_array_equal(axes[1].lines[0].get_ydata(), 1e3 * ticks["height"])
        self.assertEqual([len(ax.lines) for ax in axes], [1, 1, 3])


class Verdicts(unittest.TestCase):
    def test_a_steady_stroke_is_what_its_equations_say(self):
        ticks = stroked()
        verdict = ticks.verdict(amplitude=AMPLITUDE)
        touched = np.count_nonzero(ticks["flags"] & knurl.lib.KNURL_TICK_CONTACT)
        self.assertAlmostEqual(verdict.crossed, 2.0 * 100.0 * touched / 1000.0, delta=0.01) # 2 fs v t
        self.assertAlmostEqual(verdict.played, verdict.crossed, delta=1.0)
        self.assertAlmostEqual(verdict.hz, 100.0, places=6)
        self.assertLess(verdict.false_tones, 1e-6)
        self.assertAlmostEqual(verdict.level, 4.0 / np.pi, delta=0.01)
        self.assertLess(verdict.push, 0.01)
        self.assertIn("200 played" if verdict.played == 200 else f"{verdict.played} played", str(verdict))

    def test_s1_between_ticks_has_false_tones_and_s2_pushes_little(self):
        def play(speed, method):
            grating = knurl.Grating((FS, 0.0), 1.0, method)
            t = np.arange(4000) / 1000.0
            heights = grating.play(np.column_stack([speed * t, 0 * t]), np.tile([speed, 0.0], (4000, 1)))["height"]
            return knurl.metrics.steady(heights[200:], 1000.0, 1000.0 * speed)
        s1, default = play(0.3777, "S1"), play(0.3777, None)
        # a sampled square wave has its harmonics above f_h/2 folded: 1/9 + 1/25 + ... of 8/pi^2 = 0.189 of its power
        self.assertAlmostEqual(s1["false_tones"], 1.0 - 8.0 / np.pi**2, delta=0.02)
        self.assertLess(default["false_tones"], 0.02)
        self.assertLess(play(0.3777, "S2")["push"], 0.05)

    def test_a_hand_that_never_keeps_its_speed_gets_counts_alone(self):
        ticks = stroked(count=150)
        verdict = ticks.verdict()
        self.assertTrue(np.isnan(verdict.level))
        self.assertIn("never steady", str(verdict))

    def test_out_of_step_is_counted_by_what_is_felt(self):
        t = np.arange(2000) / 1000.0

        def square(cycles):
            return np.where(np.mod(cycles, 1.0) < 0.5, 1.0, -1.0)
        self.assertEqual(knurl.metrics.step(square(10.13 * t + 0.01), 10.13 * t + 0.01), 0.0)
        self.assertAlmostEqual(knurl.metrics.step(square(10.0 * t), 10.5 * t), 1.0, delta=0.02) # a cycle behind after 2 s
        self.assertAlmostEqual(knurl.metrics.step(square(10.0 * t + 0.01), 10.0 * t - 0.19), 0.2, delta=0.011)
        back = np.where(t < 1.0, 10.03 * t, 10.03 * (2.0 - t)) # S1 there and back stays in step
        self.assertEqual(knurl.metrics.step(square(back), back), 0.0)

    def test_heights_alone_are_those_of_a_scene(self):
        ticks = stroked("S1")
        touched = ticks["surface"] != 0
        x = SPEED * np.arange(3000) / 1000.0 + 1.3e-4
        heights = knurl.Grating((FS, 0.0), AMPLITUDE, "S1").play(np.column_stack([x, 0 * x]), np.tile([SPEED, 0.0], (3000, 1)))
        np.testing.assert_array_equal(heights["height"][touched], ticks["height"][touched])
        np.testing.assert_array_equal(heights["height"], AMPLITUDE * np.sign(np.cos(2.0 * np.pi * FS * x))) # Eq. 11

    def test_velocities_of_a_ramp(self):
        t = np.arange(100) / 1000.0
        ramp = np.column_stack([0.2 * t, -0.1 * t, 0 * t])
        np.testing.assert_allclose(knurl.Velocity("difference").play(ramp)[1:], np.tile([0.2, -0.1, 0.0], (99, 1)), atol=1e-12)
        counted = np.round(ramp / 5.5e-5) * 5.5e-5
        found = {name: knurl.Velocity(name, 5.5e-5).play(counted)[60:, 0] for name in ("foaw", "difference")}
        self.assertLess(np.abs(found["foaw"] - 0.2).max(), 0.01)
        self.assertGreater(np.abs(found["difference"] - 0.2).max(), 0.01) # a count a tick is 0.055 m/s
        with self.assertRaisesRegex(ValueError, "difference"):
            knurl.Velocity("kalman")


class Records(unittest.TestCase):
    def setUp(self):
        self.scene = knurl.Scene()
        self.plate = self.scene.add_plane(half_extents=(0.06, 0.06), material=knurl.Material(400.0, (FS, 0.0), AMPLITUDE))
        self.scene.commit()
        self.device = knurl.Device("fake")
        self.device.lay_stroke(self.scene, self.plate)

    def test_every_tick_of_a_running_loop_is_recorded(self):
        with knurl.Loop(self.scene, self.device, record=("tick", "force")) as loop:
            time.sleep(0.7)
            some = len(loop.ticks)
        ticks = loop.ticks
        np.testing.assert_array_equal(ticks["tick"], np.arange(loop.stats["ticks"]))
        self.assertGreater(some, 0)
        self.assertEqual((loop.lost, ticks.rate), (0, 1000.0))

    def test_a_stepped_loop_records_more_than_its_ring_has_room_for(self):
        loop = knurl.Loop(self.scene, self.device, record=("tick", "height", "temporal_frequency", "flags"))
        loop.step(50000)
        np.testing.assert_array_equal(loop.ticks["tick"], np.arange(50000))
        self.assertEqual(loop.lost, 0)
        verdict = loop.ticks.verdict(AMPLITUDE)
        self.assertGreater(verdict.played, 5000)
        self.assertAlmostEqual(verdict.played / verdict.crossed, 1.0, delta=0.02)

    def test_a_recorded_loop_may_have_a_callback_too(self):
        seen = []
        loop = knurl.Loop(self.scene, self.device, record=("tick",), tick_callback=lambda row: seen.append(int(row["tick"])))
        loop.step(100)
        np.testing.assert_array_equal(loop.ticks["tick"], seen)
        self.assertEqual(len(seen), 100)

    def test_without_a_record_there_are_no_ticks(self):
        with self.assertRaisesRegex(ValueError, "record"):
            _ = knurl.Loop(self.scene, self.device).ticks


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:-2])
