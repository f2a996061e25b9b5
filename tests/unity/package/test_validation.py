#!/usr/bin/env python3
"""The checks of Unity's package validation; each fault is named."""
import json
import os
import unittest

import package
from package import validate


class SourceTree(unittest.TestCase):
    def test_has_nothing_wrong(self):
        self.assertEqual(validate.check(package.PACKAGE, False), [])


class Faults(package.InFolder):
    """One copy of the package, one thing broken in it."""

    def setUp(self):
        super().setUp()
        self.root = os.path.join(self.folder, "copy")
        package.copy_of_package(self.root)

    def expect(self, *faults):
        found = validate.check(self.root, False)
        self.assertEqual(len(found), len(faults), found)
        for fault, sentence in zip(faults, found):
            self.assertIn(fault, sentence)

    def edit(self, **more):
        manifest = json.loads(package.read(self.root, "package.json"))
        manifest.update(more)
        self.write(json.dumps(manifest), self.root, "package.json")

    def test_a_wrong_field_is_named_with_what_was_expected(self):
        for key, value in {"name": "Knurl Haptics", "version": "1", "displayName": 60 * "a", "description": "short",
                           "unity": "2021", "license": "", "author": "", "dependencies": {"a": "^1.0.0"}}.items():
            manifest = {**json.loads(package.read(package.PACKAGE, "package.json")), key: value}
            self.write(json.dumps(manifest), self.root, "package.json")
            found = [fault for fault in validate.check(self.root, False) if fault.startswith("package.json")]
            self.assertEqual(len(found), 1, found)
            self.assertIn(f"package.json: {key}: expected", found[0])

    def test_an_address_is_one_of_the_web(self):
        self.edit(documentationUrl="docs/index.md")
        self.expect("documentationUrl: expected an https address")
        self.assertEqual(len(validate.check(package.PACKAGE, True)), 4)  # published, they have to be there

    def test_a_changelog_begins_with_this_version_and_its_date(self):
        text = package.read(self.root, "CHANGELOG.md")
        version = package.version()
        for wrong in (f"[{version}] - unreleased", "[0.0.9] - 2026-11-22", f"[{version}] - 2026-13-01", version):
            self.write(f"# Changelog\n\n## {wrong}\n" + text, self.root, "CHANGELOG.md")
            self.expect(f"CHANGELOG.md: expected '[{version}] - YYYY-MM-DD'")

    def test_a_missing_document_is_named(self):
        for name in ("LICENSE.md", "README.md"):
            os.remove(os.path.join(self.root, name))
        self.expect("LICENSE.md: missing", "README.md: missing")

    def test_samples_are_what_the_manifest_lists(self):
        os.makedirs(os.path.join(self.root, "Samples~", "More"))
        self.write("", self.root, "Samples~", "More", "a.cs")
        self.expect("Samples~/More: expected to be listed")
        self.edit(samples=[{"displayName": "a", "description": "", "path": "Samples~/More"}])
        self.expect("Samples~/ThreePlates: expected to be listed", "'Samples~/More': expected a displayName and a desc")

    def test_files_that_packages_may_not_hold_are_named(self):
        self.write("", self.root, "Editor", "setup.exe")
        self.write("", self.root, "Editor", 150 * "a" + ".md")
        os.makedirs(os.path.join(self.root, "Empty"))
        os.symlink("README.md", os.path.join(self.root, "link.md"))
        self.expect("at most 140 characters", "Editor/setup.exe: files of this kind", "Empty: expected files",
                    "link.md: expected a file, found a link")


if __name__ == "__main__":
    unittest.main()
