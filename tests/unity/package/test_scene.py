#!/usr/bin/env python3
"""The sample's scene: all that it refers to is there, and its components' fields are the scripts'."""
import glob
import os
import re
import unittest

import package
from package import metas

SCENE = os.path.join(package.PACKAGE, "Samples~", "ThreePlates", "Three Plates.unity")
BUILT_IN = {  # Unity's: the quad's and the sphere's mesh, the default material
    "0000000000000000e000000000000000": {10210, 10207},
    "0000000000000000f000000000000000": {10303},
}
SCRIPT = 11500000
ASSET = 11400000


def documents():
    """Class, id and text of each object."""
    parts = re.split(r"^--- !u!(\d+) &(\d+)\n", package.read(SCENE), flags=re.MULTILINE)
    return list(zip(map(int, parts[1::3]), map(int, parts[2::3]), parts[3::3]))


def paths_by_guid():
    found = {}
    for meta in metas.walk(package.PACKAGE)[2]:
        found[re.search(r"^guid: (\w+)$", package.read(package.PACKAGE, meta), re.MULTILINE).group(1)] = meta[:-5]
    return found


class Scene(unittest.TestCase):
    def setUp(self):
        self.documents = documents()
        self.paths = paths_by_guid()

    def test_every_reference_is_to_something(self):
        ids = [each for _, each, _ in self.documents]
        self.assertEqual(len(ids), len(set(ids)))
        for _, _, text in self.documents:
            for file, guid in re.findall(r"\{fileID: (\d+)(?:, guid: (\w+), type: \d)?\}", text):
                if not guid:
                    self.assertIn(int(file), ids + [0])
                elif guid in BUILT_IN:
                    self.assertIn(int(file), BUILT_IN[guid])
                else:
                    kind = ".cs" if int(file) == SCRIPT else ".asset" if int(file) == ASSET else "?"
                    self.assertEqual(os.path.splitext(self.paths[guid])[1], kind)

    def test_objects_list_their_components_and_those_their_object(self):
        owners = {each: re.search(r"m_GameObject: \{fileID: (\d+)\}", text) for _, each, text in self.documents}
        for kind, each, text in self.documents:
            if kind == 1:
                listed = set(map(int, re.findall(r"- component: \{fileID: (\d+)\}", text)))
                owned = {part for part, owner in owners.items() if owner and int(owner.group(1)) == each}
                self.assertEqual(listed, owned, text)

    def test_fields_are_the_scripts(self):
        seen = set()
        for kind, _, text in self.documents:
            if kind != 114:
                continue
            path = self.paths[re.search(r"m_Script: \{fileID: \d+, guid: (\w+)", text).group(1)]
            name = os.path.splitext(path)[0]
            sources = "".join(package.read(each) for each in glob.glob(os.path.join(package.PACKAGE, name + "*.cs")))
            declared = set(re.findall(r"\[SerializeField[^\]]*\]\s*\w+ (\w+)", sources))
            fields = set(re.findall(r"^  ([a-z]\w*): ", text, re.MULTILINE)) - {"m_"}
            fields = {field for field in fields if not field.startswith("m_")}
            self.assertEqual(fields, declared, path)
            seen.add(os.path.basename(name))
        self.assertEqual(seen, {"KnurlSurface", "KnurlDevice", "KnurlMouse", "KnurlCursor", "KnurlPaint", "KnurlReadout",
                                "KnurlStripes"})

    def test_it_can_be_seen_and_felt(self):
        kinds = [kind for kind, _, _ in self.documents]
        self.assertEqual((kinds.count(20), kinds.count(108)), (1, 1))  # a camera and a light
        self.assertIn("device: mouse", package.read(SCENE))
        self.assertIn("autostart: 1", package.read(SCENE))

    def test_whatever_is_drawn_is_painted_and_the_device_is_heard_and_plotted(self):
        """The built-in material is magenta in URP."""
        drawn, painted, felt, striped, plotted = set(), set(), set(), set(), 0
        for kind, _, text in self.documents:
            owner = re.search(r"m_GameObject: \{fileID: (\d+)\}", text)
            script = re.search(r"m_Script: \{fileID: \d+, guid: (\w+)", text)
            name = os.path.basename(self.paths[script.group(1)]) if script else ""
            if kind == 23:
                drawn.add(owner.group(1))
            elif name == "KnurlPaint.cs":
                painted.add(owner.group(1))
            elif name == "KnurlSurface.cs":
                felt.add(owner.group(1))
            elif name == "KnurlStripes.cs":
                striped.add(owner.group(1))
            plotted += name == "KnurlReadout.cs"
        self.assertEqual(len(drawn), 5)
        self.assertEqual((painted, plotted), (drawn, 1))
        self.assertEqual((len(felt), striped), (3, felt))
        self.assertIn("sound: 1", package.read(SCENE))


if __name__ == "__main__":
    unittest.main()
