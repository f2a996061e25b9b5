#!/usr/bin/python3
"""The page's own driver (samples/web/inverse3.js) repeats the SDK's limits of the Inverse3: they must be the same.
usage: test_page_limits.py SOURCE     SPDX-License-Identifier: MIT"""
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1))


def text(path):
    return (SOURCE / path).read_text(encoding="utf-8")


PAGE = text("samples/web/inverse3.js")
DRIVER = text("sdk/src/device/inverse3/inverse3.c")
MODELS = text("sdk/src/device/inverse3/service.c")
SERVICE = text("sdk/src/device/inverse3/service.h")
MESSAGES = text("sdk/src/device/inverse3/message.h")


def number(pattern, code):
    """The only number there."""
    found, = re.findall(pattern, code)
    return float(found)


def defined(name, code):
    return number(rf"#define {name} +(\d+)", code)


def constant(name):
    return number(rf"const {name} = ([\d.]+);", PAGE)


class Limits(unittest.TestCase):
    def test_models_have_the_same_names_forces_and_stiffness(self):
        name, = re.findall(r'#define KNURL_INVERSE3_NAME +"(.+)"', SERVICE)
        found = re.findall(r'\{"(\w+)", (KNURL_INVERSE3_NAME|".+?"), ([\d.]+), ([\d.]+), ([\d.]+), [\d.]+\}', MODELS)
        titles = {"KNURL_INVERSE3_NAME": name}
        driver = {kind: (titles.get(title, title.strip('"')), min(float(most), float(held)), float(stiffness))
                  for kind, title, most, held, stiffness in found}
        page = {kind: (title, float(force), float(stiffness)) for kind, title, force, stiffness in re.findall(
            r'(\w+): \{ name: "(.+?)", force: ([\d.]+), stiffness: ([\d.]+) \}', PAGE)}
        self.assertEqual(len(driver), 3)
        self.assertEqual(page, driver)

    def test_a_silence_is_as_long(self):
        self.assertEqual(constant("GAP_MS"), defined("ANSWER_NS", DRIVER) / 1e6)
        self.assertEqual(constant("HELLO_MS"), defined("KNURL_INVERSE3_HELLO_MS", SERVICE))

    def test_the_force_ramps_up_as_in_a_loop(self):
        self.assertEqual(constant("RAMP_S"), number(r"\.ramp_s = ([\d.]+)", text("sdk/src/loop/loop.c")))

    def test_messages_and_ids_are_as_long(self):
        self.assertEqual(constant("LONGEST"), defined("KNURL_INVERSE3_LONGEST", MESSAGES))
        self.assertEqual(number(r"\[\\w-\]\{1,(\d+)\}", PAGE), defined("KNURL_INVERSE3_ID_ROOM", MESSAGES) - 1)


unittest.main()
