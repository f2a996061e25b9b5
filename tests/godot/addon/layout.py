#!/usr/bin/env python3
"""Checks what Godot's asset library asks of the add-on's zip, and of its entry there. SPDX-License-Identifier: MIT

usage: layout.py PACKAGE.zip GODOT     GODOT: the folder bindings/godot, with the entry and its icon"""
import os
import re
import struct
import sys
import unittest
import zipfile

HOME = "addons/knurl/"
ARCHIVE = zipfile.ZipFile(sys.argv[1])
GODOT = sys.argv[2]
NAMES = [name for name in ARCHIVE.namelist() if not name.endswith("/")]


def text_of(name):
    return ARCHIVE.read(HOME + name).decode("utf-8")


class Layout(unittest.TestCase):
    def test_all_is_below_the_addons_folder(self):
        self.assertEqual([name for name in NAMES if not name.startswith(HOME)], [])

    def test_licences_and_pages_are_there(self):
        for name in ("LICENSE", "README.md", "CHANGELOG.md", "THIRD_PARTY.md"):
            self.assertIn(HOME + name, NAMES)
        self.assertIn("MIT License", text_of("LICENSE"))
        for licence in ("MIT", "The base64 decoder", "ZPL 2.1", "BSD, 3 clauses"): # a section for each
            self.assertIn(f"\n## {licence}", text_of("THIRD_PARTY.md"))

    def test_each_script_has_an_id_of_its_own(self):
        files = [name for name in NAMES if re.search(r"\.(gd|gdshader|gdextension)$", name) and "/standins/" not in name]
        self.assertEqual([name for name in files if name + ".uid" not in NAMES], [])
        ids = [ARCHIVE.read(name) for name in NAMES if name.endswith(".uid")]
        self.assertEqual(len(ids), len(set(ids)))
        self.assertTrue(all(re.fullmatch(rb"uid://[a-y0-8]+\n?", one) for one in ids), ids)

    def test_what_the_extension_names_is_there(self):
        said = text_of("knurl.gdextension")
        for icon in re.findall(r'"(icons/[^"]+)"', said):
            self.assertIn(HOME + icon, NAMES)
        libraries = {name for name in NAMES if name.startswith(HOME + "bin/")}
        self.assertTrue(libraries)
        self.assertEqual(libraries - {HOME + name for name in re.findall(r'"(bin/[^"]+)"', said)}, set())


class Entry(unittest.TestCase):
    def test_the_icon_is_a_square_picture(self):
        with open(os.path.join(GODOT, "icon.png"), "rb") as file:
            head = file.read(24)
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", head[16:])
        self.assertEqual(width, height)
        self.assertGreaterEqual(width, 128)

    def test_the_entry_is_for_this_version(self):
        version = re.search(r'^version="(.*)"$', text_of("plugin.cfg"), re.M).group(1)
        with open(os.path.join(GODOT, "asset_library.md"), encoding="utf-8") as file:
            entry = file.read()
        self.assertIn(f"| version | {version} |", entry)
        self.assertIn(f"knurl-godot-{version}.zip", entry)
        oldest = re.search(r'^compatibility_minimum = "(.*)"$', text_of("knurl.gdextension"), re.M).group(1)
        self.assertIn(f"| Godot | {oldest} |", entry)
        for path in re.findall(r"`((?:assets|bindings)/[\w./]+)`", entry):
            self.assertTrue(os.path.exists(os.path.join(GODOT, "..", "..", path)), path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
