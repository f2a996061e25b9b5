#!/usr/bin/env python3
"""The presets are Godot's, number for number, in a form that Unity loads."""
import glob
import os
import re
import struct
import unittest
import xml.etree.ElementTree

import package
from package import metas

GODOT = os.path.join(package.ROOT, "bindings", "godot")
SCRIPT = "Runtime/KnurlGrating.cs"
FIELDS = {  # Godot's property, Unity's serialized field
    "spatial_frequency": "spatialFrequency",
    "amplitude": "amplitude",
    "stiffness": "stiffness",
    "damping": "damping",
    "friction": "friction",
    "orientation": "orientation",
    "method": "method",
}


def name_of(path):
    return os.path.splitext(os.path.basename(path))[0]


def single(text):
    """The float that an engine makes of a number's text."""
    return struct.unpack("f", struct.pack("f", float(text)))[0]


def godots_value(text):
    vector = re.fullmatch(r"Vector2\((.*), (.*)\)", text)
    return tuple(map(single, vector.groups())) if vector else single(text)


def godots_defaults():
    root = xml.etree.ElementTree.parse(os.path.join(GODOT, "doc_classes", "KnurlGrating.xml")).getroot()
    return {member.get("name"): godots_value(member.get("default")) for member in root.iter("member")}


def godots_presets():
    presets = {}
    for path in glob.glob(os.path.join(GODOT, "addons", "knurl", "presets", "*.tres")):
        lines = re.findall(r"^(\w+) = (.+)$", package.read(path), re.MULTILINE)
        presets[name_of(path)] = {**godots_defaults(), **{key: godots_value(text) for key, text in lines}}
    return presets


def unitys_value(text):
    vector = re.fullmatch(r"\{x: (.*), y: (.*)\}", text)
    return tuple(map(single, vector.groups())) if vector else single(text)


class Presets(unittest.TestCase):
    def setUp(self):
        paths = glob.glob(os.path.join(package.PACKAGE, "Presets", "*.asset"))
        self.presets = {name_of(path): package.read(path) for path in paths}

    def test_are_those_of_godot(self):
        self.assertEqual(len(godots_presets()), 7)
        self.assertEqual(sorted(self.presets), sorted(godots_presets()))

    def test_have_godots_numbers(self):
        for name, expected in godots_presets().items():
            lines = dict(re.findall(r"^  (\w+): (.*)$", self.presets[name], re.MULTILINE))
            for theirs, ours in FIELDS.items():
                self.assertEqual(unitys_value(lines[ours]), expected[theirs], f"{name}: {ours}")

    def test_have_no_fields_that_the_script_does_not_serialize(self):
        script = package.read(package.PACKAGE, SCRIPT)
        fields = set(re.findall(r"\[SerializeField.*?\]\s*\n\s*\w+ (\w+)\b", script, re.DOTALL))
        self.assertEqual(fields, set(FIELDS.values()))
        for name, text in self.presets.items():
            found = re.findall(r"^  (?!m_)(\w+): ", text, re.MULTILINE)
            self.assertEqual(sorted(found), sorted(FIELDS.values()), name)

    def test_are_of_the_grating_script(self):
        guid = metas.check_meta(SCRIPT, package.read(package.PACKAGE, SCRIPT + ".meta"), False)[1]
        for name, text in self.presets.items():
            self.assertIn(f"\n  m_Script: {{fileID: 11500000, guid: {guid}, type: 3}}\n", text, name)

    def test_are_assets_of_their_own_name(self):
        for name, text in self.presets.items():
            start = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!114 &11400000\nMonoBehaviour:\n"
            self.assertTrue(text.startswith(start), name)
            self.assertIn(f"\n  m_Name: {name}\n", text)


if __name__ == "__main__":
    unittest.main()
