#!/usr/bin/python3
"""A release's files for macOS, read on Linux: processors, needed libraries, oldest system, signatures, exported functions; and
a program that links with the archive's headers and library. Nothing of them runs here.
usage: macos.py RELEASE ZIG     ZIG: made by cmake/zig.sh     SPDX-License-Identifier: MIT"""
import glob
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import macho

RELEASE, ZIG = map(os.path.abspath, sys.argv[1:])
CONSUMER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "consumer/plate.c")
OLDEST = "minos 11.0"
# The linker's, and C++'s operators new and delete, weak, which this linker cannot hide: they are malloc() and free().
OTHERS = re.compile(r"mh_dylib_header|dso_handle|Z(na|nw|da|dl)\w+")


def say(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def the(pattern):
    found = glob.glob(os.path.join(RELEASE, pattern))
    if len(found) != 1:
        raise AssertionError(f"expected one {pattern} in {RELEASE}, found {found}")
    return found[0]


def exports(path, *options):
    return {name.lstrip("_") for name in re.findall(r" [TDSB] (\S+)$", say("llvm-nm", *options, path), re.M)}


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.files, cls.trees = [], {}
        for name, pattern, expected in (("archive", "*-macos-universal.tar.gz", {"arm64", "x86_64"}),
                                        ("linux", "*-linux-aarch64.tar.gz", None),
                                        ("wheel-arm64", "*-macosx_11_0_arm64.whl", {"arm64"}),
                                        ("wheel-x86_64", "*-macosx_11_0_x86_64.whl", {"x86_64"})):
            to = os.path.join(folder.name, name)
            with (zipfile.ZipFile if pattern.endswith("whl") else tarfile.open)(the(pattern)) as archive:
                archive.extractall(to)
            cls.trees[name] = os.path.join(to, os.listdir(to)[0])
            for path in glob.glob(f"{to}/**", recursive=True):
                if not expected or os.path.islink(path) or not os.path.isfile(path):
                    continue
                with open(path, "rb") as file:
                    parts = macho.slices(file.read())
                if parts:
                    cls.files.append((path, expected, parts))

    def test_tool_and_libraries_are_there(self):
        names = sorted(os.path.basename(path) for path, _, _ in self.files)
        wheel = ["libknurl.0.3.dylib", "libknurl_gltf.0.3.dylib", "libknurl_record.dylib"]
        self.assertEqual(names, sorted(["knurl", "libknurl.0.3.0.dylib", "libknurl_gltf.0.3.0.dylib", *wheel, *wheel]))

    def test_each_is_for_its_processors(self):
        for path, expected, parts in self.files:
            self.assertEqual(set(parts), expected, path)
            found = re.findall(r"MH_MAGIC_64 +(\w+)", say("llvm-objdump", "--macho", "--arch=all", "--private-headers", path))
            self.assertEqual(sorted(name.lower() for name in found), sorted(expected), path)

    def test_each_for_arm64_has_a_valid_signature(self):
        for path, _, parts in self.files:
            if "arm64" in parts:
                self.assertIsNone(macho.fault_of_signature(parts["arm64"]), path)

    def test_it_needs_the_systems_library_and_those_beside_it(self):
        for path, expected, _ in self.files:
            headers = say("llvm-objdump", "--macho", "--arch=all", "--private-headers", path)
            self.assertEqual(headers.count(OLDEST), len(expected), path)
            places = {place.replace("@loader_path", os.path.dirname(path))
                      for place in re.findall(r"LC_RPATH\n.*\n +path (\S+)", headers)}
            used = set(re.findall(r"LC_LOAD_DYLIB\n.*\n +name (\S+)", headers)) - {"/usr/lib/libSystem.B.dylib"}
            for name in used:
                self.assertTrue(name.startswith("@rpath/libknurl"), f"{path} needs {name}")
                self.assertTrue(any(os.path.exists(os.path.join(place, name[7:])) for place in places), f"{path}: {name} in {places}")
            if os.path.basename(path) == "knurl" or "gltf" in path:
                self.assertTrue(used, path)

    def test_libraries_export_the_functions_of_linux(self):
        for name in ("libknurl", "libknurl_gltf"):
            there = exports(os.path.join(self.trees["linux"], f"lib/{name}.so"), "-D", "--defined-only")
            for path in (path for path, _, _ in self.files if re.search(rf"/{name}(\.\d+)+\.dylib$", path)):
                self.assertEqual({name for name in exports(path, "-gU") if not OTHERS.fullmatch(name)}, there, path)

    def test_a_program_links_with_the_archive(self):
        home = self.trees["archive"]
        for processor in ("aarch64", "x86_64"):
            out = os.path.join(home, "plate")
            subprocess.run([os.path.join(ZIG, f"bin/{processor}-macos.11.0-cc"), CONSUMER, f"-I{home}/include", f"-L{home}/lib",
                            "-lknurl", "-o", out], check=True)
            self.assertIn("@rpath/libknurl.0.3.dylib", say("llvm-objdump", "--macho", "--dylibs-used", out))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
