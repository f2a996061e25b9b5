"""Tags written into glTF files. usage: test_tagging.py [-v] KNURL ASSETS
SPDX-License-Identifier: MIT"""
import os
import pickle
import sys
import tempfile
import unittest

import knurl

PLATE = os.path.join(sys.argv.pop(), "plate_1d.glb")
KNURL = sys.argv.pop()


class Tagging(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.out = os.path.join(self.folder.name, "out.glb")
        self.addCleanup(self.folder.cleanup)

    def test_a_tag_that_is_set_is_listed_and_felt(self):
        knurl.tag(PLATE, self.out, material="steel", spatial_frequency=[1250, 0], amplitude=1e-4, stiffness=500)
        tagged = {o.name: o.tag for o in knurl.tags(self.out) if o.array == "materials"}
        self.assertEqual(tagged["steel"], {"version": 1, "spatial_frequency": [1250, 0], "amplitude": 1e-4, "stiffness": 500})
        with knurl.Scene() as before, knurl.Scene() as after:
            self.assertEqual(len(after.load(self.out)), len(before.load(PLATE)) + 1)

    def test_removed_again_the_file_has_the_same_bytes(self):
        knurl.tag(PLATE, self.out, material=3, spatial_frequency=500, amplitude=1e-4, stiffness=500)
        knurl.untag(self.out, self.out, material="steel")
        with open(PLATE, "rb") as one, open(self.out, "rb") as other:
            self.assertEqual(one.read(), other.read())
        self.assertEqual(os.listdir(self.folder.name), ["out.glb"])

    def test_keys_that_are_not_given_stay(self):
        knurl.tag(PLATE, self.out, material=0, stiffness=300, method="S2")
        self.assertEqual(knurl.tags(self.out)[0].tag, {"version": 1, "spatial_frequency": 1000.0, "amplitude": 0.0002,
                                                        "stiffness": 300, "method": "S2"})

    def test_what_is_wrong_writes_nothing(self):
        with self.assertRaisesRegex(knurl.KnurlError, r"material 'steel' \(3\): knurl.stiffness: expected a number > 0"):
            knurl.tag(PLATE, self.out, material="steel", stiffness=-1)
        with self.assertRaisesRegex(knurl.KnurlError, "unknown key"):
            knurl.tag(PLATE, self.out, material="steel", stifness=1)
        with self.assertRaisesRegex(ValueError, "expected one object None in materials, found 5"):
            knurl.tag(PLATE, self.out, stiffness=1)
        with self.assertRaisesRegex(ValueError, "expected one object 'tin' in materials, found 0"):
            knurl.untag(PLATE, self.out, material="tin")
        with self.assertRaisesRegex(ValueError, "one of material, mesh and node"):
            knurl.untag(PLATE, self.out, material=0, node=0)
        with self.assertRaises(ValueError):
            knurl.tag(PLATE, self.out, material=0, amplitude=float("nan"))
        with self.assertRaisesRegex(ValueError, "expected the name of a file"):
            knurl.tag(PLATE, "/dev/fd/777", material=0, stiffness=1)
        with self.assertRaises(OSError):
            knurl.tags(self.out)
        self.assertEqual(os.listdir(self.folder.name), [])

    def test_a_listed_object_can_be_pickled(self):
        self.assertEqual(pickle.loads(pickle.dumps(knurl.tags(PLATE))), knurl.tags(PLATE))


if __name__ == "__main__":
    unittest.main()
