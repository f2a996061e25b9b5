#!/usr/bin/env python3
"""Checks the cross-built libraries and tools for macOS, and for Linux and Windows on arm64: exports, dependencies and
signatures. Compares a run of the arm64 tool under qemu with the same run of this machine's tool.

usage: elsewhere.py BUILD KNURL PLATE     BUILD: with the folders macos-arm64, macos-x86_64, linux-arm64, windows-arm64
SPDX-License-Identifier: MIT"""
import json
import os
import shutil
import subprocess
import sys
import unittest

BUILD, KNURL, PLATE = sys.argv[1:4]
GLIBC = (2, 31)  # the oldest that libraries for Linux run with
ENTRIES = {"knurl_godot": "knurl_godot_init", "knurl_unity": "knurl_unity_interface"}
QEMU = shutil.which("qemu-aarch64")
TIMED = ("tick_ns", "jitter_us")


def say(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def below(preset, *path):
    return os.path.join(BUILD, preset, *path)


def libraries(preset):
    ends = ".dylib" if "macos" in preset else ".so"
    for folder in ("godot", "unity"):
        names = sorted(name for name in os.listdir(below(preset, folder)) if name.endswith(ends))
        if not names:
            raise AssertionError(f"expected a library in {below(preset, folder)}, found no {ends} file")
        yield from (below(preset, folder, name) for name in names)


def entry_of(path):
    return next(entry for stem, entry in ENTRIES.items() if stem in os.path.basename(path))


class MacOS(unittest.TestCase):
    presets = ("macos-arm64", "macos-x86_64")

    def test_each_library_exports_its_entry(self):
        for path in (path for preset in self.presets for path in libraries(preset)):
            self.assertIn(f" T _{entry_of(path)}\n", say("llvm-nm", "-gU", path), path)

    def test_it_needs_the_systems_library_alone(self):
        for path in (path for preset in self.presets for path in libraries(preset)):
            needed = say("llvm-objdump", "--macho", "--dylibs-used", path).splitlines()[1:]
            names = {line.split()[0] for line in needed} - {"@rpath/" + os.path.basename(path)}
            self.assertEqual(names, {"/usr/lib/libSystem.B.dylib"}, path)

    def test_it_runs_on_macos_11(self):
        for path in (path for preset in self.presets for path in libraries(preset)):
            self.assertIn("minos 11.0", say("llvm-objdump", "--macho", "--private-headers", path), path)

    def test_what_is_for_arm64_is_signed(self):
        for path in [*libraries("macos-arm64"), below("macos-arm64", "knurl")]:
            self.assertIn("LC_CODE_SIGNATURE", say("llvm-objdump", "--macho", "--private-headers", path), path)


class Arm64(unittest.TestCase):
    def test_each_library_exports_its_entry(self):
        for path in libraries("linux-arm64"):
            self.assertIn(f" T {entry_of(path)}\n", say("llvm-nm", "-D", "--defined-only", path), path)

    def test_it_runs_with_glibc_2_31(self):
        for path in [*libraries("linux-arm64"), below("linux-arm64", "knurl")]:
            symbols = say("llvm-nm", "-D", path).split()
            versions = [symbol.rsplit("@GLIBC_", 1)[1] for symbol in symbols if "@GLIBC_" in symbol]
            self.assertTrue(versions, path)
            self.assertLessEqual(max(tuple(map(int, version.split("."))) for version in versions), GLIBC, path)

    @unittest.skipUnless(QEMU, "no qemu-aarch64: apt-get install qemu-user")
    def test_a_run_says_what_it_says_here(self):
        stroke = ("run", PLATE, "--fast", "--seconds", "2")
        there = json.loads(say(QEMU, "-L", "/usr/aarch64-linux-gnu", below("linux-arm64", "knurl"), *stroke))
        here = json.loads(say(KNURL, *stroke))
        for key in TIMED:
            there.pop(key), here.pop(key)
        self.assertEqual(there, here)


class WindowsArm64(unittest.TestCase):
    library = below("windows-arm64", "godot", "libknurl_godot.windows.arm64.dll")

    def test_it_exports_its_entry_alone(self):
        said = say("llvm-readobj", "--file-headers", "--coff-exports", self.library)
        self.assertIn("Machine: IMAGE_FILE_MACHINE_ARM64 ", said)
        self.assertEqual([line.split()[1] for line in said.splitlines() if line.startswith("  Name: ")],
                         [ENTRIES["knurl_godot"]])

    def test_it_needs_the_systems_libraries_alone(self):
        said = say("llvm-readobj", "--coff-imports", self.library)
        names = {line.split()[1] for line in said.splitlines() if line.startswith("  Name: ")}
        others = {name for name in names if not name.startswith("api-ms-win-crt-")} # Windows' own C library
        self.assertEqual(others, {"ADVAPI32.dll", "KERNEL32.dll", "WINMM.dll"})


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False).result
    for test, reason in done.skipped:
        print(f"elsewhere: SKIPPED: {test.id().split('.', 1)[1]}: {reason}", file=sys.stderr)
    sys.exit(not done.wasSuccessful())
