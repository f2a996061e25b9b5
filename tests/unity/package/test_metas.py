#!/usr/bin/env python3
"""Every file and folder of the package has a meta that Unity accepts, and a meta's faults are named."""
import os
import subprocess
import sys
import unittest

import package
from package import metas

GRATING = "Runtime/KnurlGrating.cs"
LIBRARY = "Plugins/Windows/x86_64/knurl_unity.dll"


class SourceTree(unittest.TestCase):
    def test_has_nothing_wrong(self):
        self.assertEqual(metas.check(package.PACKAGE, False), [])

    def test_has_a_meta_for_each_library(self):
        for library in metas.LIBRARIES:
            self.assertTrue(os.path.isfile(os.path.join(package.PACKAGE, library + ".meta")), library)


class Faults(package.InFolder):
    """One copy of the package, one thing broken in it."""

    def setUp(self):
        super().setUp()
        self.root = os.path.join(self.folder, "copy")
        package.copy_of_package(self.root)
        self.assertEqual(metas.check(self.root, False), [])

    def expect(self, *faults, packed=False):
        found = metas.check(self.root, packed)
        self.assertEqual(len(found), len(faults), found)
        for fault, sentence in zip(faults, found):
            self.assertIn(fault, sentence)

    def edit(self, path, old, new):
        text = package.read(self.root, path)
        self.assertIn(old, text)
        self.write(text.replace(old, new), self.root, path)

    def test_a_file_without_a_meta_is_missing_one(self):
        os.remove(os.path.join(self.root, GRATING + ".meta"))
        self.expect(f"{GRATING}: missing")

    def test_a_folder_without_a_meta_is_missing_one(self):
        os.remove(os.path.join(self.root, "Runtime.meta"))
        self.expect("Runtime: missing")

    def test_a_meta_without_its_file_is_an_orphan(self):
        os.remove(os.path.join(self.root, GRATING))
        self.expect(f"{GRATING}.meta: orphan")

    def test_a_librarys_meta_may_stand_alone_in_the_source_tree_but_not_in_a_packed_one(self):
        self.expect(packed=False)
        self.expect("libknurl_unity.so.meta: orphan", "knurl_unity.dll.meta: orphan", "libknurl_unity.dylib.meta: orphan",
                    packed=True)

    def test_two_metas_with_one_guid_are_both_named(self):
        other = "Runtime/KnurlSurface.cs.meta"
        guid = metas.check_meta(GRATING, package.read(self.root, GRATING + ".meta"), False)[1]
        self.edit(other, metas.check_meta(other[:-5], package.read(self.root, other), False)[1], guid)
        self.expect(f"{GRATING}.meta, {other}: duplicate guid {guid}")

    def test_a_guid_that_is_none_is_malformed(self):
        for wrong in ("xyz", 32 * "0", 31 * "a", 32 * "A"):
            text = f"fileFormatVersion: 2\nguid: {wrong}\nMonoImporter:\n"
            self.write(text, self.root, GRATING + ".meta")
            self.expect(f"{GRATING}.meta: malformed guid: expected 32 hexadecimal digits")

    def test_a_meta_that_is_none_is_malformed(self):
        for text in ("", "guid: " + 32 * "a" + "\n", "<<<<<<< HEAD\n"):
            self.write(text, self.root, GRATING + ".meta")
            self.expect(f"{GRATING}.meta: malformed: expected 'fileFormatVersion: 2'")

    def test_a_wrong_importer_is_named_beside_the_right_one(self):
        self.edit(GRATING + ".meta", "MonoImporter:", "DefaultImporter:")
        self.expect("wrong importer: expected MonoImporter, found DefaultImporter")
        self.edit(GRATING + ".meta", "DefaultImporter:\n", "")
        self.expect("wrong importer: expected MonoImporter, found none")

    def test_each_kind_of_file_has_its_importer(self):
        kinds = {
            "package.json": "PackageManifestImporter",
            "README.md": "TextScriptImporter",
            "Runtime/Knurl.Haptics.asmdef": "AssemblyDefinitionImporter",
            "Presets/file.asset": "NativeFormatImporter",
            LIBRARY: "PluginImporter",
        }
        for path, importer in kinds.items():
            self.assertIn(f"\n{importer}:\n", package.read(self.root, path + ".meta"), path)

    def test_a_folders_meta_says_that_it_is_one(self):
        self.edit("Runtime.meta", "folderAsset: yes\n", "")
        self.expect("Runtime.meta: wrong kind")

    def test_a_library_for_other_platforms_than_its_own_is_refused(self):
        self.edit(LIBRARY + ".meta", "OS: Windows", "OS: AnyOS")
        self.expect("wrong platforms: expected Any off, Editor (Windows) and Standalone Win64 on, CPU x86_64")

    def test_what_unity_does_not_look_at_needs_no_meta(self):
        os.makedirs(os.path.join(self.root, "Documentation~", "More"))
        self.write("", self.root, "Documentation~", "More", "More.cs")
        self.write("", self.root, ".hidden")
        self.expect()

    def test_what_a_sample_brings_has_metas(self):
        os.remove(os.path.join(self.root, "Samples~", "ThreePlates", "KnurlDemo.cs.meta"))
        self.expect("Samples~/ThreePlates/KnurlDemo.cs: missing")

    def test_a_file_of_an_unknown_kind_is_refused_when_metas_are_written(self):
        self.write("", self.root, "Runtime", "picture.tga")
        done = self.run_metas("--write")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("Runtime/picture.tga: no importer is known", done.stderr)

    def run_metas(self, *arguments):
        program = os.path.join(package.UNITY, "metas.py")
        command = [sys.executable, program, *arguments, self.root]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_the_program_says_all_faults_and_fails(self):
        os.remove(os.path.join(self.root, GRATING + ".meta"))
        os.remove(os.path.join(self.root, "Editor.meta"))
        done = self.run_metas("--check")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(len(done.stderr.splitlines()), 2)
        self.assertEqual(self.run_metas("--write").returncode, 0)
        self.assertEqual(self.run_metas("--check").returncode, 0)

    def test_written_again_a_meta_is_what_it_was(self):
        before = package.read(self.root, GRATING + ".meta")
        os.remove(os.path.join(self.root, GRATING + ".meta"))
        self.run_metas("--write")
        self.assertEqual(package.read(self.root, GRATING + ".meta"), before)

    def test_a_meta_that_is_there_keeps_its_guid(self):
        guid = 16 * "ab"
        self.write(f"fileFormatVersion: 2\nguid: {guid}\nMonoImporter:\n", self.root, GRATING + ".meta")
        self.run_metas("--write")
        self.assertIn(guid, package.read(self.root, GRATING + ".meta"))

    def test_a_folder_that_is_no_package_is_refused(self):
        os.remove(os.path.join(self.root, "package.json"))
        self.assertIn("found no package.json", self.run_metas("--check").stderr)


if __name__ == "__main__":
    unittest.main()
