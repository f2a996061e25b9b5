#!/usr/bin/env python3
"""drawn.py sees that a picture's data have changed, and only that. SPDX-License-Identifier: MIT"""
import contextlib
import io
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../samples/study"))
import drawn

ROWS = ["1.5,none", "-2.25,plate", "nan,plate", "4,none"]


class Drawn(unittest.TestCase):
    def check(self, rows, header="force,surface"):
        """The exit code and the message for these rows, against ROWS."""
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(said):
            data, told = os.path.join(folder, "a.csv"), os.path.join(folder, "a.data")

            def write(lines, first):
                with open(data, "w", encoding="utf-8") as file:
                    file.write("\n".join([first, *lines]) + "\n")
            write(ROWS, "force,surface")
            self.assertEqual(drawn.main([told, data]), 0)
            write(rows, header)
            return drawn.main(["--check", told, data]), said.getvalue()

    def test_the_same_is_the_same(self):
        self.assertEqual(self.check(ROWS), (0, ""))

    def test_the_last_digits_do_not_matter(self):
        self.assertEqual(self.check(["1.50001,none", *ROWS[1:]])[0], 0)

    def test_a_number_a_text_a_gap_a_row_and_an_order_do(self):
        for rows in (["1.6,none", *ROWS[1:]], ["1.5,other", *ROWS[1:]], [*ROWS[:2], "0,plate", ROWS[3]], ROWS[:3],
                     [ROWS[1], ROWS[0], *ROWS[2:]]):
            code, said = self.check(rows)
            self.assertEqual(code, 1, rows)
            self.assertIn("a.png is out of date: ./run figures --update draws it again", said)

    def test_columns_that_come_and_go_are_named(self):
        code, said = self.check(ROWS, "strength,surface")
        self.assertEqual(code, 1)
        self.assertIn("a.csv strength: it was not there", said)
        self.assertIn("a.csv force: it is gone", said)

    def test_times_of_the_machine_are_left_out_and_temporal_frequencies_are_not(self):
        for key in ("ns_tick", "rows[].ns_second", "cost_ns.FOAW", "machine", "instructions_tick"):
            self.assertTrue(drawn.TIMED.search(key), key)
        for key in ("gains", "net", "frequency_error", "period_ms", "machines"):
            self.assertFalse(drawn.TIMED.search(key), key)

    def test_json_is_taken_apart_by_its_keys(self):
        columns = {}
        drawn.walk({"a": [{"b": 1}, {"b": 2}], "c": "x"}, "", columns)
        self.assertEqual(columns, {"a[].b": [1, 2], "c": ["x"]})

    def test_a_picture_whose_data_were_never_told_is_told(self):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(drawn.main(["--check", "/nowhere/a.data"]), 1)
        self.assertIn("there is none", said.getvalue())


if __name__ == "__main__":
    unittest.main()
