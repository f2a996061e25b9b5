#!/usr/bin/env python3
"""steady.py fails every broken test, and no test that the machine disturbed. SPDX-License-Identifier: MIT"""
import contextlib
import io
import os
import subprocess
import sys
import unittest

import steady


class Steady(unittest.TestCase):
    def run_with(self, *outcomes):
        """Its exit code for these attempts, (exit code, halt in s, output) each; the number of attempts; its output.
        Attempts that print nothing fail at different checks."""
        left = [(*outcome, f"[   LINE   ] --- some_test.c:{place}: error: Failure!")[:3]
                for place, outcome in enumerate(outcomes)]
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

    def failures_at(self, *lines):
        return [(1, 0.03, f"[  ERROR   ] --- 0x{count} != 0\n[   LINE   ] --- a.c:{line}: error: Failure!\n")
                for count, line in enumerate(lines)]

    def test_a_failure_that_repeats_is_one_whatever_the_machine_did(self):
        code, attempts, said = self.run_with(*self.failures_at(7, 7, 7))
        self.assertEqual((code, attempts), (1, 3))
        self.assertIn("the same failure in 3 of 3 attempts is no fault of the machine: a.c:7", said)

    def test_a_check_that_fails_each_time_counts_among_others_that_differ(self):
        outcomes = [(1, 0.03, f"[ LINE ] --- a.c:{other}: error: Failure!\n[ LINE ] --- b.c:9: error: Failure!\n")
                    for other in range(3)]
        self.assertEqual(self.run_with(*outcomes)[:2], (1, 3))

    def test_failures_at_the_same_check_now_and_then_are_the_machines(self):
        self.assertEqual(self.run_with(*self.failures_at(7, 7, 8, 7, 7))[:2], (77, 5))

    def test_a_script_s_failures_are_compared_without_their_numbers(self):
        repeated = [(1, 0.03, f"starting\nFAILED: {3 * n}.5 ms late\ndone {n}\n") for n in range(3)]
        self.assertEqual(self.run_with(*repeated)[:2], (1, 3))
        names = ("alpha", "beta", "gamma", "delta", "epsilon")
        differing = [(1, 0.03, f"starting\nFAILED: {name}\n") for name in names]
        self.assertEqual(self.run_with(*differing)[:2], (77, 5))

    def test_commands_that_fail_in_silence_are_compared_by_their_codes(self):
        self.assertEqual(self.run_with(*[(1, 0.03, "")] * 3)[:2], (1, 3))
        self.assertEqual(self.run_with(*[(n, 0.03, "") for n in range(1, 6)])[:2], (77, 5))

    def test_crashes_and_sanitizers_are_never_tried_again(self):
        for code, seen in ((-11, 139), (134, 134), (steady.REPORTED, steady.REPORTED)):
            self.assertEqual(self.run_with((code, 0.5)), (seen, 1, ""))

    def test_a_real_command_is_watched_and_its_code_handed_on(self):
        script = "import sys, time; print('out'); print('err', file=sys.stderr); time.sleep(0.05); sys.exit(5)"
        done = subprocess.run(
            [sys.executable, "-B", "-c", "import steady, sys; print(steady.attempt(sys.argv[1:], None))",
             sys.executable, "-u", "-c", script],
            cwd=os.path.dirname(steady.__file__), capture_output=True, text=True, check=True)
        passed_on, result = done.stdout.rsplit("\n", 2)[:2]
        self.assertEqual(passed_on, "out\nerr")
        code, halt, output = eval(result)
        self.assertEqual((code, output), (5, "out\nerr\n"))
        self.assertGreater(halt, 0.0)

    def test_sanitizers_are_told_the_code(self):
        done = subprocess.run(
            [sys.executable, "-B", steady.__file__, "sh", "-c", 'echo "$ASAN_OPTIONS $UBSAN_OPTIONS"'],
            env={"ASAN_OPTIONS": "a=1", "PATH": "/usr/bin:/bin"}, capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), "a=1:exitcode=66 exitcode=66")


if __name__ == "__main__":
    unittest.main()
