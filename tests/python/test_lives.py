"""Lives of objects and threads: closing, guards, references and ends, each under a watchdog; probes that could end the
process are processes of their own. KNURL_TEST_RUNS: of each (1; 100 in ./run soak). SPDX-License-Identifier: MIT"""
import copy
import faulthandler
import functools
import gc
import os
import pickle
import subprocess
import sys
import threading
import time
import unittest
import unittest.mock

import numpy as np

import knurl

WATCHDOG_S = 120.0 # some programs take most of it on a machine that is busy with 30 others
RUNS = int(os.environ.get("KNURL_TEST_RUNS", "1"))
SCENE = """
import multiprocessing, sys, threading, time
import numpy as np
import knurl
scene = knurl.Scene()
scene.add_plane()
scene.configure_hip(resolution=0.0, workspace=((0, 0, 0), np.eye(3), 1.0))
scene.commit()
"""


def ready():
    scene = knurl.Scene()
    scene.add_plane()
    scene.commit()
    return scene


def repeated(test):
    """Runs a test RUNS times; if it hangs, the watchdog prints where each thread is, and ends the process."""
    @functools.wraps(test)
    def run(self):
        for _ in range(RUNS):
            faulthandler.dump_traceback_later(WATCHDOG_S, exit=True)
            try:
                test(self)
            finally: # a failed test does not end the others
                faulthandler.cancel_dump_traceback_later()
    return run


class Lives(unittest.TestCase):
    def probe(self, code):
        """Runs a program that ends by itself; returns its output."""
        for run in range(RUNS):
            try:
                done = subprocess.run([sys.executable, "-B", "-c", SCENE + code], capture_output=True, text=True, check=False,
                                      timeout=WATCHDOG_S)
            except subprocess.TimeoutExpired:
                self.fail(f"run {run + 1} of {RUNS} did not end within {WATCHDOG_S:g} s")
            self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        return done.stdout

    def test_two_threads_on_one_hip_are_told_so(self):
        self.assertEqual(self.probe("""
positions = np.tile([0.0, 0.0, -0.001], (300000, 1))
said = []
def tick():
    for _ in range(3):
        try:
            scene.tick(positions, fields=["depth"])
        except knurl.KnurlError as error:
            said.append(str(error))
threads = [threading.Thread(target=tick) for _ in range(2)]
for thread in threads: thread.start()
for thread in threads: thread.join()
print(len(scene.tick(positions[:5])), set(said) <= {"hip 0: expected one thread at a time, found a call while another "
                                                    "thread ticks it"})
"""), "5 True\n")

    @repeated
    def test_hips_of_a_scene_are_ticked_by_a_thread_each(self):
        scene = knurl.Scene(hips=2)
        scene.add_plane()
        scene.commit()
        found = [None, None]

        def tick(hip):
            found[hip] = scene.tick(np.zeros((20000, 3)), hip=hip)
        threads = [threading.Thread(target=tick, args=(hip,)) for hip in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([ticks["tick"][-1] for ticks in found], [19999, 19999])

    def test_an_error_comes_back_from_another_process(self):
        error = pickle.loads(pickle.dumps(knurl.KnurlError(-1, "why")))
        self.assertEqual((error.code, str(error)), (-1, "why"))
        self.assertEqual(str(copy.copy(error)), "why")
        self.assertIn("raised stiffness: expected", self.probe("""
def fail(_):
    scene.add_plane(material=knurl.Material(stiffness=-1.0))
with multiprocessing.get_context("fork").Pool(2) as pool:
    try:
        pool.map(fail, range(2))
    except knurl.KnurlError as error:
        print("raised", error)
"""))

    @repeated
    def test_a_loop_keeps_its_callback(self):
        ticks = []
        loop = knurl.Loop(ready(), knurl.Device("fake"), tick_callback=lambda row: ticks.append(int(row["tick"])))
        gc.collect()
        others = [knurl.Loop(ready(), knurl.Device("fake"), tick_callback=lambda row: self.fail()) for _ in range(3)]
        loop.step(50)
        self.assertEqual(ticks, list(range(50)))
        self.assertEqual(len(others), 3)

    def test_a_script_ends_while_its_loop_runs(self):
        for made in ("knurl.Loop(scene, knurl.Device('fake'), tick_callback=lambda row: None)",
                     "knurl.Loop(None, knurl.Device('fake'), force_callback=lambda tick, sample: (0, 0, 0))",
                     "knurl.Loop(scene, knurl.Device('fake'), record=True)",
                     "knurl.Loop(scene, knurl.Device.of_functions(lambda: (0, 0, 0), lambda force: None, 3.0, blocking=True))"):
            self.assertEqual(self.probe(f"loop = {made}\nloop.start()\ntime.sleep(0.03)\nprint('end')\n"), "end\n")

    @repeated
    def test_a_script_that_fails_while_its_loop_runs_ends(self):
        done = subprocess.run([sys.executable, "-B", "-c", SCENE + "loop = knurl.Loop(scene, knurl.Device('fake'), "
                               "tick_callback=lambda row: None)\nloop.start()\nraise SystemExit(3)"], check=False,
                              timeout=WATCHDOG_S)
        self.assertEqual(done.returncode, 3)

    @repeated
    def test_a_notebooks_cell_can_be_run_twice(self):
        scene, device, loops = ready(), knurl.Device("fake"), []
        for _ in range(3):
            loops.append(knurl.Loop(scene, device))
            loops[-1].start()
        self.assertEqual([loop.closed for loop in loops], [True, True, False])
        with self.assertRaisesRegex(knurl.KnurlError, "another loop was made with its device or HIP"):
            loops[0].pause()
        loops[-1].close()

    @repeated
    def test_a_device_that_is_opened_again_is_closed_first(self):
        class Exclusive:
            """The library, whose fake device can be opened once at a time, as a device on a wire can."""

            def __getattr__(self, name):
                return getattr(knurl.lib, name)

            def knurl_device_open(self, uri, device):
                if any(not owner.closed for owner in devices):
                    return knurl.lib.KNURL_ERROR_SYSTEM
                return knurl.lib.knurl_device_open(uri, device)

        scene, devices, loops = ready(), [], []
        with unittest.mock.patch.object(knurl.device, "lib", Exclusive()):
            for _ in range(3):
                devices.append(knurl.Device("fake"))
                loops.append(knurl.Loop(scene, devices[-1]))
                loops[-1].start()
            with self.assertRaises(knurl.KnurlError):
                knurl.Device("fake:") # another URI is another device
        self.assertEqual([device.closed for device in devices], [True, True, False])
        loops[-1].close()

    @repeated
    def test_what_is_closed_says_so(self):
        scene, device = ready(), knurl.Device("fake")
        loop = knurl.Loop(scene, device)
        loop.step(10)
        for thing in (loop, device, scene):
            thing.close()
            thing.close()
            self.assertTrue(thing.closed)
            self.assertIn("closed", repr(thing))
        self.assertEqual(loop.stats["ticks"], 10)
        for call in (lambda: scene.tick(np.zeros((1, 3))), lambda: device.info, lambda: loop.step(1)):
            with self.assertRaisesRegex(knurl.KnurlError, "closed"):
                call()

    @repeated
    def test_a_stepped_loop_ends_at_once(self):
        for end in (knurl.Loop.stop, knurl.Loop.close):
            loop = knurl.Loop(ready(), knurl.Device("fake"))
            loop.step(10)
            begin = time.monotonic()
            end(loop)
            self.assertLess(time.monotonic() - begin, 2.0) # its wait is 5 s
            self.assertEqual((loop.stats["state"], loop.stats["ticks"]), ("done", 10))
            loop.close()
        loop = knurl.Loop(ready(), knurl.Device("fake"))
        loop.close()
        self.assertEqual((loop.stats["state"], loop.stats["ticks"]), ("idle", 0))

    @repeated
    def test_each_is_a_context(self):
        with knurl.Scene() as scene, knurl.Device("fake") as device:
            scene.add_plane()
            scene.commit()
            with knurl.Loop(scene, device) as loop:
                while loop.stats["ticks"] == 0:
                    time.sleep(0.001)
            with knurl.Loop(scene, device) as again:
                pass
        self.assertGreater(loop.stats["ticks"], 0)
        self.assertTrue(loop.closed and again.closed and device.closed and scene.closed)

    def test_closing_in_the_middle_of_a_call_waits_for_its_end(self):
        self.assertEqual(self.probe("""
done = []
thread = threading.Thread(target=lambda: done.append(len(scene.tick(np.zeros((2000000, 3)), fields=["depth"]))))
thread.start()
time.sleep(0.01)
scene.close()
thread.join()
print(done)
"""), "[2000000]\n")

    @repeated
    def test_an_exception_in_a_callback_ends_the_loop_and_is_raised(self):
        def tick(row):
            if row["tick"] == 5:
                raise KeyError("mine")
        loop = knurl.Loop(ready(), knurl.Device("fake"), tick_callback=tick)
        with self.assertRaisesRegex(KeyError, "mine"):
            loop.step(100000)
        self.assertLess(loop.stats["ticks"], 5000)
        with self.assertRaisesRegex(KeyError, "mine"):
            with knurl.Loop(ready(), knurl.Device("fake"), tick_callback=tick) as loop:
                loop.wait(10.0)

    def test_the_last_reference_may_go_within_a_callback(self):
        self.assertEqual(self.probe("""
held = {}
device = knurl.Device("fake")
def tick(row):
    held.clear()
held["loop"] = knurl.Loop(scene, device, tick_callback=tick)
held["loop"].start()
while held: time.sleep(0.001)
knurl.Loop(scene, device).step(10) # it has its device back
print("end")
"""), "end\n")

    def test_a_callback_may_drop_its_loop_and_make_another(self):
        self.assertEqual(self.probe("""
held, made = {}, []
def tick(row):
    if held:
        held.clear()
        made.append(knurl.Loop(None, knurl.Device("fake"), force_callback=lambda tick, sample: (0, 0, 0)))
held["loop"] = knurl.Loop(scene, knurl.Device("fake"), tick_callback=tick)
held["loop"].start()
while not made: time.sleep(0.001)
print("end")
"""), "end\n")

    def test_a_callback_that_steps_another_loop_is_still_a_callback(self):
        self.assertEqual(self.probe("""
inner = knurl.Loop(None, knurl.Device("fake"), force_callback=lambda tick, sample: (0, 0, 0))
seen = []
def tick(row):
    inner.step(1)
    seen.append(len(scene.contacts()))
with knurl.Loop(scene, knurl.Device("fake"), tick_callback=tick) as loop:
    loop.wait(0.1)
print(len(seen) > 0)
"""), "True\n")

    def test_ctrl_c_ends_a_wait(self):
        self.assertEqual(self.probe("""
import _thread
try:
    with knurl.Loop(scene, knurl.Device("fake")) as loop:
        threading.Timer(0.2, _thread.interrupt_main).start() # not before: within a destructor Python drops the interrupt
        loop.wait()
except KeyboardInterrupt:
    print("interrupted", loop.closed)
"""), "interrupted True\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:-2])
