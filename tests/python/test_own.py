"""Own devices, forces and other calls of a loop. SPDX-License-Identifier: MIT"""
import sys
import unittest

import numpy as np

import knurl

MASS, HAND = 0.1, 300.0 # kg, N/m


class Puck:
    """A mass in a hand's spring (critically damped), which the tests press down to 2 mm below the plate at z = 0."""

    def __init__(self):
        self.z, self.v, self.force, self.reads, self.closed = 0.005, 0.0, np.zeros(3), 0, False

    def read(self):
        damping = 2.0 * np.sqrt(HAND * MASS)
        for _ in range(10):
            self.v += 1e-4 * (self.force[2] + HAND * (-0.002 - self.z) - damping * self.v) / MASS
            self.z += 1e-4 * self.v
        self.reads += 1
        return (0.0, 0.0, self.z)

    def write(self, force):
        self.force = force

    def close(self):
        self.closed = True

    def open(self, **options):
        return knurl.Device.of_functions(self.read, self.write, 3.3, close=self.close, motors_known=True, name="puck", **options)


def plate(**material):
    scene = knurl.Scene()
    surface = scene.add_plane(half_extents=(0.06, 0.06), material=knurl.Material(**material))
    scene.configure_hip(workspace=((0, 0, 0), np.eye(3), 1.0))
    scene.commit()
    return scene, surface


class OwnDevices(unittest.TestCase):
    def test_a_wall_holds_a_mass_where_two_springs_balance(self):
        puck, (scene, _) = Puck(), plate(stiffness=500.0)
        loop = knurl.Loop(scene, puck.open(), record=("depth", "force"))
        loop.step(5000)
        # K d = H (0.002 - d)
        self.assertAlmostEqual(loop.ticks["depth"][-1], 0.002 * HAND / (500.0 + HAND), delta=2e-6)
        self.assertAlmostEqual(puck.force[2], loop.ticks["force"][-1, 2])

    def test_its_numbers_are_the_devices(self):
        device = Puck().open(resolution=1e-5, mass=MASS)
        self.assertEqual((device.info["name"], device.info["max_force"], device.info["mass"]), ("puck", 3.3, MASS))
        self.assertEqual(repr(device), "<knurl.Device 'puck': puck>")
        with self.assertRaisesRegex(TypeError, "no field 'masss': expected one of name, "):
            Puck().open(masss=1.0)

    def test_it_is_closed_once_with_zero_force(self):
        puck, (scene, _) = Puck(), plate()
        with puck.open() as device:
            loop = knurl.Loop(scene, device)
            loop.step(1000)
            loop.close()
        self.assertTrue(puck.closed)
        np.testing.assert_array_equal(puck.force, 0.0)

    def test_an_exception_is_a_lost_device(self):
        def read():
            raise OSError("unplugged")
        scene, _ = plate()
        device = knurl.Device.of_functions(read, lambda force: None, 3.0, motors_known=True)
        loop = knurl.Loop(scene, device)
        loop.step(100)
        self.assertEqual(loop.stats["state"], "lost")
        self.assertEqual(str(device.error), "unplugged")
        self.assertEqual([event.name for event in device.events()], ["lost"])

    def test_a_position_of_two_numbers_is_a_lost_device(self):
        device = knurl.Device.of_functions(lambda: (0.0, 0.001), lambda force: None, 3.0, motors_known=True)
        loop = knurl.Loop(plate()[0], device)
        loop.step(10)
        self.assertEqual(loop.stats["state"], "lost")
        self.assertIn("position: expected 3 numbers", str(device.error))

    def test_a_number_that_is_refused_leaves_nothing_behind(self):
        kept = len(knurl.callbacks._kept)
        with self.assertRaisesRegex(knurl.KnurlError, "max_force"):
            knurl.Device.of_functions(lambda: None, lambda force: None, -1.0)
        self.assertEqual(len(knurl.callbacks._kept), kept)

    def test_a_blocking_device_runs_on_its_own_thread(self):
        puck, (scene, _) = Puck(), plate()
        with puck.open(blocking=True) as device, knurl.Loop(scene, device) as loop:
            loop.wait(0.3)
        self.assertGreater(puck.reads, 50)
        self.assertIsNone(device.error)


class OwnForces(unittest.TestCase):
    def test_a_spring_of_ones_own_balances_the_hand(self):
        puck = Puck()
        loop = knurl.Loop(None, puck.open(), force_callback=lambda tick, sample: (0.0, 0.0, -200.0 * sample.position[2]))
        loop.step(5000)
        self.assertAlmostEqual(puck.z, -0.002 * HAND / (200.0 + HAND), delta=2e-6)

    def test_what_is_no_force_ends_the_loop_with_zero(self):
        for wrong in (None, (1.0, 2.0), "up"):
            puck = Puck()
            loop = knurl.Loop(None, puck.open(), force_callback=lambda tick, sample, wrong=wrong: wrong)
            with self.assertRaises((ValueError, TypeError)):
                loop.step(100)
            np.testing.assert_array_equal(puck.force, 0.0)
            self.assertEqual(loop.stats["state"], "done")

    def test_a_force_callback_and_a_record_are_refused_together(self):
        with self.assertRaisesRegex(ValueError, "expected a scene"):
            knurl.Loop(None, knurl.Device("fake"), record=True, force_callback=lambda tick, sample: (0, 0, 0))


class Games(unittest.TestCase):
    def test_pause_gain_and_an_added_force(self):
        puck, (scene, _) = Puck(), plate(stiffness=500.0)
        loop = knurl.Loop(scene, puck.open())
        loop.step(3000)
        held = puck.force[2]
        loop.set_force((0.25, 0.0, 0.0))
        loop.step(500)
        self.assertAlmostEqual(puck.force[0], 0.25, places=9)
        loop.set_gain(0.5)
        loop.step(3000)
        self.assertAlmostEqual(puck.force[0], 0.125, places=9)
        loop.pause()
        loop.step(500)
        np.testing.assert_array_equal(puck.force, 0.0)
        self.assertEqual(loop.stats["paused"], 1)
        loop.resume()
        loop.set_gain(1.0)
        loop.set_force((0.0, 0.0, 0.0))
        loop.step(5000)
        self.assertAlmostEqual(puck.force[2], held, delta=1e-4)

    def test_a_vibration_is_felt_at_its_frequency(self):
        scene, _ = plate()
        loop = knurl.Loop(scene, knurl.Device("fake"), record=("force",))
        loop.vibrate(100.0, 0.5, (1, 0, 0), seconds=2.0, method="T1")
        loop.step(1000)
        line = knurl.metrics.dominant(loop.ticks["force"][:, 0], 1000.0)
        self.assertEqual(line["hz"], 100.0)
        self.assertAlmostEqual(line["amplitude"], 0.5 * 4.0 / np.pi, delta=0.02)

    def test_materials_come_back_as_they_are_rendered(self):
        _, surface = plate(stiffness=300.0, spatial_frequency=(500.0, 0.0), amplitude=1e-4, friction=0.3)
        self.assertEqual(surface.material, knurl.Material(300.0, (500.0, 0.0), 1e-4, 0.0, 0.3, 0.0, "bandlimited"))
        surface.material = knurl.Material(method="S2")
        self.assertEqual(surface.material.method, "S2")
        self.assertEqual(surface.info["shape"], "plane")
        self.assertEqual(surface.limits(), "")

    def test_surfaces_are_equal_by_what_they_are(self):
        scene, surface = plate()
        self.assertEqual(surface, scene.surfaces[0])
        self.assertEqual(len({surface, scene.surfaces[0]}), 1)
        other, like = plate()
        self.assertNotEqual(surface, other.surfaces[0])
        self.assertEqual(repr(scene), "<knurl.Scene: 1 surface, 1 HIP>")
        like.remove()
        self.assertIn("no longer there", repr(like))

    def test_contacts_of_two_walls(self):
        scene, floor = plate()
        wall = scene.add_plane(half_extents=(0.06, 0.06), rotation=(0, np.sqrt(0.5), 0, np.sqrt(0.5)), position=(-0.02, 0, 0))
        scene.tick([[-0.02 + 0.002 * (1 - k / 200), 0.0, 0.002 * (1 - k / 200)] for k in range(400)])
        found = scene.contacts()
        self.assertEqual(set(found["surface"]), {floor.id, wall.id})
        np.testing.assert_allclose(np.sort(found["normal"], axis=1)[:, 2], 1.0)

    def test_contacts_belong_to_the_thread_that_ticks(self):
        scene, _ = plate()
        seen = []
        with knurl.Loop(scene, knurl.Device("fake"), tick_callback=lambda row: seen.append(len(scene.contacts()))) as loop:
            with self.assertRaisesRegex(knurl.KnurlError, "tick_callback"):
                scene.contacts()
            loop.wait(0.1)
        self.assertGreater(len(seen), 0)

    def test_contacts_of_another_hip_belong_to_its_own_thread(self):
        scene = knurl.Scene(hips=3)
        scene.add_plane()
        scene.commit()
        found = []
        with knurl.Loop(scene, knurl.Device("fake"), hip=1):
            knurl.Loop(scene, knurl.Device("fake"), tick_callback=lambda row: found.append(len(scene.contacts(2)))).step(1)
            self.assertEqual(found, [0])
            loop = knurl.Loop(scene, knurl.Device("fake"), tick_callback=lambda row: scene.contacts(1))
            with self.assertRaisesRegex(knurl.KnurlError, "hip 1: expected a call within"):
                loop.step(1)

    def test_devices_are_listed_with_a_reason(self):
        kinds = {listing.uri.split(":")[0]: listing for listing in knurl.devices()}
        self.assertEqual(kinds["fake"].reason, "")
        self.assertIn("touch", kinds)

    def test_a_trace_is_played(self):
        scene, _ = plate(stiffness=400.0)
        device = knurl.Device("fake")
        device.set_trace([0.0, 0.5, 1.0], [[0, 0, 0.001], [0, 0, -0.001], [0, 0, -0.001]])
        loop = knurl.Loop(scene, device, record=("force",))
        loop.step(1000)
        self.assertAlmostEqual(loop.ticks["force"][-1, 2], 0.4, places=6)

    def test_an_unknown_field_is_told_with_the_known(self):
        scene, _ = plate()
        with self.assertRaisesRegex(TypeError, "knurl_loop_desc has no field 'rate': expected one of hip, device, "):
            knurl.Loop(scene, knurl.Device("fake"), rate=1000)
        with self.assertRaisesRegex(TypeError, "knurl_hip_desc has no field 'rate'"):
            scene.configure_hip(rate=1000)
        with self.assertRaisesRegex(ValueError, "hip: expected 0 to 0, found 1"):
            scene.tick([[0, 0, 0]], hip=1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:-2])
