#!/usr/bin/python3
"""A release's wheels for musl: tag, needed libraries and functions, and C programs that use their libraries with Debian's musl
1.2.3: those for x86-64 run here, those for arm64 under qemu. The Python files are compared with those of the wheels for glibc,
which are tried in an empty Debian: no Python runs here.
usage: musl.py RELEASE ZIG FOLDER     ZIG: made by cmake/zig.sh; FOLDER: Debian's musl, from musl.sh
SPDX-License-Identifier: MIT"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

RELEASE, ZIG, FOLDER = map(os.path.abspath, sys.argv[1:])
ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
DEBIAN = {"x86_64": "amd64", "aarch64": "arm64"}
QEMU = {"x86_64": [], "aarch64": ["qemu-aarch64"]}
LIBRARIES = ["libknurl.so.0.3", "libknurl_gltf.so.0.3", "libknurl_record.so"]
VERSION = "0.3.0"


def say(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout


def symbols(path, *options):
    return {line.split()[-1] for line in say("llvm-nm", "-D", *options, path).splitlines()}


def root(processor):
    return os.path.join(FOLDER, DEBIAN[processor], "root")


class Wheels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder, cls.trees = folder.name, {}
        for kind in ("musllinux_1_2", "manylinux_*"):
            for processor in DEBIAN:
                found = glob.glob(os.path.join(RELEASE, f"knurl-{VERSION}-py3-none-{kind}_{processor}.whl"))
                if len(found) != 1:
                    raise AssertionError(f"expected one wheel {kind}_{processor} in {RELEASE}, found {found}")
                cls.trees[kind[:4], processor] = to = os.path.join(folder.name, kind[:4], processor)
                with zipfile.ZipFile(found[0]) as wheel:
                    wheel.extractall(to)

    def libraries(self, processor):
        return [os.path.join(self.trees["musl", processor], "knurl", name) for name in LIBRARIES]

    def build(self, processor, source):
        out = os.path.join(self.folder, f"{os.path.basename(source)[:-2]}-{processor}")
        subprocess.run([os.path.join(ZIG, f"bin/{processor}-linux-musl-cc"), "-dynamic", "-O1", "-fno-sanitize=all", # whose runtime
                        source, f"-I{ROOT}/sdk/include", *self.libraries(processor)[:2], "-o", out], check=True) # needs a newer musl
        return out

    def start(self, processor, *command):
        emulator = QEMU[processor]
        if emulator and not shutil.which(emulator[0]):
            self.skipTest(f"no {emulator[0]}: apt-get install qemu-user")
        loader = os.path.join(root(processor), f"lib/{processor}-linux-musl/libc.so")
        return say(*emulator, loader, "--library-path", os.path.dirname(self.libraries(processor)[0]), *command)

    def test_they_hold_the_files_of_the_wheels_for_glibc(self):
        for processor in DEBIAN:
            files = {}
            for kind in ("musl", "many"):
                tree = self.trees[kind, processor]
                files[kind] = {}
                for path in glob.glob(f"{tree}/**", recursive=True):
                    if os.path.isfile(path) and os.path.basename(path) not in ("RECORD", "WHEEL"):
                        with open(path, "rb") as file:
                            files[kind][os.path.relpath(path, tree)] = None if ".so" in path else file.read()
            self.assertEqual(sorted(name for name in files["musl"] if ".so" in name), [f"knurl/{name}" for name in LIBRARIES])
            self.assertEqual(files["musl"], files["many"])

    def test_the_tag_is_that_of_the_name(self):
        for processor in DEBIAN:
            path, = glob.glob(os.path.join(self.trees["musl", processor], "*.dist-info/WHEEL"))
            with open(path, encoding="utf-8") as file:
                self.assertIn(f"Tag: py3-none-musllinux_1_2_{processor}\n", file.read())

    def test_they_need_musl_alone_and_those_beside_them(self):
        for processor in DEBIAN:
            for path in self.libraries(processor):
                said = say("llvm-readelf", "-dhW", path)
                self.assertIn({"x86_64": "X86-64", "aarch64": "AArch64"}[processor], said, path)
                beside = {"libknurl.so.0.3"} if "gltf" in path else set()
                self.assertEqual(set(re.findall(r"Shared library: \[(.*)\]", said)), {f"libc.musl-{processor}.so.1"} | beside, path)
                self.assertEqual("[$ORIGIN]" in said, "record" not in path, path)

    def test_each_function_is_one_of_musl_1_2_3_or_of_libknurl(self):
        for processor in DEBIAN:
            there = symbols(os.path.join(root(processor), f"lib/{processor}-linux-musl/libc.so"), "--defined-only")
            there |= symbols(self.libraries(processor)[0], "--defined-only")
            for path in self.libraries(processor):
                wanted = symbols(path, "--undefined-only")
                self.assertTrue(wanted, path)
                self.assertEqual(wanted - there, set(), path) # also versioned ones, such as memcpy@GLIBC_2.14

    def test_a_plate_is_felt_with_them(self):
        for processor in DEBIAN:
            with self.subTest(processor):
                said = self.start(processor, self.build(processor, os.path.join(ROOT, "tests/package/consumer/plate.c")))
                self.assertEqual(said, f"0.400000 N, knurl {VERSION}\n")

    def test_a_file_is_loaded_and_felt_in_a_loop(self):
        for processor in DEBIAN:
            with self.subTest(processor):
                said = self.start(processor, self.build(processor, os.path.join(ROOT, "samples/feel_scene.c")),
                                  os.path.join(ROOT, "assets/plate_1d.glb"))
                felt = re.findall(r"^\d s: (\d+) ridges, up to (\d\.\d\d) N$", said, re.M)
                self.assertEqual(len(felt), 5, said)
                self.assertGreater(int(felt[-1][0]), 0, said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
