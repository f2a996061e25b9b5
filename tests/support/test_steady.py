#!/usr/bin/env python3
"""steady.py makes no test pass that fails, and none fail that the machine failed. SPDX-License-Identifier: MIT"""
import contextlib
import io
import subprocess
import sys
import unittest

import steady


class Steady(unittest.TestCase):
    def run_with(self, *outcomes):
        """Its exit code where attempts end so, (exit code, halt in s) each; how many there were; what it said."""
        left = list(outcomes)
        attempt, sleep, said = steady.attempt, steady.time.sleep, io.StringIO()
        steady.attempt, steady.time.sleep = (lambda command, environment: left.pop(0)), (lambda seconds: None)
        try:
            with contextlib.redirect_stdout(said):
                code = steady.main(["some_test"])
        finally:
            steady.attempt, steady.time.sleep = attempt, sleep
        return code, len(outcomes) - len(left), said.getvalue()

    def test_what_passes_passes_whatever_the_machine_did(self):
        self.assertEqual(self.run_with((0, 0.5)), (0, 1, ""))

    def test_a_skip_stays_one(self):
        self.assertEqual(self.run_with((77, 0.5)), (77, 1, ""))

    def test_a_failure_on_a_machine_that_keeps_time_is_one(self):
        self.assertEqual(self.run_with((3, 0.9 * steady.NOTICED)), (3, 1, ""))

    def test_a_failure_during_a_halt_is_tried_again(self):
        code, attempts, said = self.run_with((1, 0.02), (1, 0.02), (0, 0.0))
        self.assertEqual((code, attempts), (0, 3))
        self.assertIn("stood still for 20.0 ms: attempt 2 of 5", said)

    def test_one_attempt_without_a_halt_decides(self):
        self.assertEqual(self.run_with((1, 0.02), (2, 0.0))[:2], (2, 2))

    def test_short_halts_do_not_excuse_five_failures(self):
        self.assertEqual(self.run_with(*[(4, 0.9 * steady.FATAL)] * 5)[:2], (4, 5))

    def test_long_ones_make_it_a_skip_with_the_reason(self):
        code, attempts, said = self.run_with(*[(4, 0.03)] * 4, (4, 0.012))
        self.assertEqual((code, attempts), (77, 5))
        self.assertIn("skipped: some_test keeps real time, and this machine does not: it stood still for 12 ms", said)

    def test_crashes_and_sanitizers_are_never_tried_again(self):
        for code, seen in ((-11, 139), (134, 134), (steady.REPORTED, steady.REPORTED)):
            self.assertEqual(self.run_with((code, 0.5)), (seen, 1, ""))

    def test_a_real_command_is_watched_and_its_code_handed_on(self):
        code, halt = steady.attempt([sys.executable, "-c", "import time; time.sleep(0.05); raise SystemExit(5)"], None)
        self.assertEqual(code, 5)
        self.assertGreater(halt, 0.0)

    def test_sanitizers_are_told_the_code(self):
        done = subprocess.run(
            [sys.executable, "-B", steady.__file__, "sh", "-c", 'echo "$ASAN_OPTIONS $UBSAN_OPTIONS"'],
            env={"ASAN_OPTIONS": "a=1", "PATH": "/usr/bin:/bin"}, capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), "a=1:exitcode=66 exitcode=66")


if __name__ == "__main__":
    unittest.main()
