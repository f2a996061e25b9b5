#!/usr/bin/env python3
"""package.sh makes a package that the Package Manager accepts. The libraries are stand-ins."""
import json
import os
import re
import shutil
import subprocess
import tarfile
import tempfile
import time
import unittest

import package
from package import metas, validate

REQUIRED = [  # by Unity's manual, "Package layout"
    "package.json",
    "README.md",
    "CHANGELOG.md",
    "LICENSE.md",
    "Third Party Notices.md",
    "Runtime/Knurl.Haptics.asmdef",
    "Editor/Knurl.Haptics.Editor.asmdef",
    "Tests/Runtime/Knurl.Haptics.Tests.asmdef",
    "Tests/Editor/Knurl.Haptics.Editor.Tests.asmdef",
    "Documentation~/com.knurl.haptics.md",
]
LINUX = "Plugins/Linux/x86_64/libknurl_unity.so"
WINDOWS = "Plugins/Windows/x86_64/knurl_unity.dll"
MACOS = "Plugins/macOS/libknurl_unity.dylib"


def make_library(path, compiler, magic):
    """An empty library, or without a compiler for it a file that starts like one."""
    if shutil.which(compiler):
        command = [compiler, "-shared", "-g", "-o", path, "-x", "c", "-"]
        code = "int knurl_stand_in(void); int knurl_stand_in(void) { return 1; }"
        subprocess.run(command, input=code, text=True, check=True)
    else:
        with open(path, "wb") as file:
            file.write(magic)
    return path


def make_libraries(case):
    """A stand-in for each system, for all tests of a class."""
    holder = tempfile.TemporaryDirectory()
    case.addClassCleanup(holder.cleanup)
    case.linux = make_library(os.path.join(holder.name, "libknurl_unity.so"), os.environ.get("CC", "cc"), b"\x7fELF")
    case.windows = make_library(
        os.path.join(holder.name, "knurl_unity.dll"), "x86_64-w64-mingw32-gcc-posix", b"MZ"
    )
    case.macos = os.path.join(holder.name, "libknurl_unity.dylib")
    with open(case.macos, "wb") as file:
        file.write(bytes.fromhex("cafebabe") + b"\0\0\0\2")
    return holder.name


def pack(out, *libraries, program=os.path.join(package.UNITY, "package.sh"), **more):
    environment = {**os.environ, **more}
    return subprocess.run([program, out, *libraries], capture_output=True, text=True, check=False, env=environment)


def paths_in(out):
    """The folder and the tarball."""
    stem = os.path.join(out, "com.knurl.haptics")
    return stem, f"{stem}-{package.version()}.tgz"


class Packed(unittest.TestCase):
    """The files of the package."""

    @classmethod
    def setUpClass(cls):
        out = os.path.join(make_libraries(cls), "out")
        cls.done = pack(out, cls.linux, cls.windows, cls.macos)
        cls.stem, cls.tarball = paths_in(out)

    def setUp(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))

    def test_a_tarball_is_laid_out_as_npm_does(self):
        with tarfile.open(self.tarball) as tar:
            members = tar.getmembers()
        names = [member.name for member in members]
        self.assertEqual(names[0], "package")
        self.assertTrue(all(name.startswith("package/") for name in names[1:]))
        for path in REQUIRED + [LINUX, WINDOWS, MACOS]:
            self.assertIn("package/" + path, names)
        self.assertTrue(all(member.isfile() or member.isdir() for member in members))
        self.assertEqual({member.uid for member in members} | {member.gid for member in members}, {0})
        self.assertEqual({member.mode & 0o777 for member in members if member.isfile()}, {0o644})

    def test_a_tarballs_manifest_names_samples_that_are_in_it(self):
        with tarfile.open(self.tarball) as tar:
            manifest = json.load(tar.extractfile("package/package.json"))
            names = tar.getnames()
        self.assertEqual(manifest["version"], package.version())
        for sample in manifest["samples"]:
            self.assertIn(f"package/{sample['path']}/README.md", names)
            self.assertTrue(any(re.match(rf"package/{sample['path']}/\w+\.cs$", name) for name in names))

    def test_the_folder_is_what_is_in_the_tarball(self):
        with tarfile.open(self.tarball) as tar:
            files = {name: tar.extractfile(name).read() for name in tar.getnames() if tar.getmember(name).isfile()}
        for name, content in files.items():
            with open(os.path.join(self.stem, name[len("package/") :]), "rb") as file:
                self.assertEqual(file.read(), content, name)
        count = sum(len(names) for _, _, names in os.walk(self.stem))
        self.assertEqual(count, len(files))

    def test_every_meta_of_it_is_right_and_has_its_file(self):
        self.assertEqual(metas.check(self.stem, True), [])

    def test_what_was_built_to_be_debugged_is_not_what_is_shipped(self):
        if not shutil.which("strip") or not shutil.which(os.environ.get("CC", "cc")):
            self.skipTest("no compiler")
        self.assertLess(os.path.getsize(os.path.join(self.stem, LINUX)), os.path.getsize(self.linux))


class Packing(package.InFolder):
    """How it goes, and goes wrong."""

    @classmethod
    def setUpClass(cls):
        make_libraries(cls)

    def setUp(self):
        super().setUp()
        self.out = os.path.join(self.folder, "out")
        self.stem, self.tarball = paths_in(self.out)

    def pack_both(self):
        done = pack(self.out, self.linux, self.windows)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def expect_nothing_made(self, done, sentence):
        self.assertEqual(done.returncode, 1)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(os.listdir(self.out), [])

    def test_the_same_files_make_the_same_bytes(self):
        self.pack_both()
        with open(self.tarball, "rb") as file:
            first = file.read()
        time.sleep(1.1)  # the clocks of archives go by seconds
        os.utime(self.linux)
        self.pack_both()
        with open(self.tarball, "rb") as file:
            self.assertEqual(file.read(), first)

    def test_nothing_else_is_left_behind(self):
        self.pack_both()
        self.pack_both()
        self.assertEqual(sorted(os.listdir(self.out)), [os.path.basename(self.stem), os.path.basename(self.tarball)])
        self.assertEqual(metas.check(self.stem, True), [])

    def test_for_one_system_alone_the_others_metas_stay_away(self):
        self.assertEqual(pack(self.out, self.linux).returncode, 0)
        self.assertEqual(metas.check(self.stem, True), [])
        self.assertEqual(sorted(os.listdir(os.path.join(self.stem, "Plugins"))), ["Linux", "Linux.meta"])

    def test_a_library_of_another_name_is_refused(self):
        other = os.path.join(self.folder, "libother.so")
        shutil.copy(self.linux, other)
        self.expect_nothing_made(pack(self.out, other), "libother.so: expected libknurl_unity.so, libknurl_unity.dylib or")

    def test_a_library_of_another_kind_is_refused(self):
        self.write("not a library", "knurl_unity.dll")
        done = pack(self.out, self.linux, os.path.join(self.folder, "knurl_unity.dll"))
        self.expect_nothing_made(done, "knurl_unity.dll: expected a library that starts with 'MZ'")

    def library_of(self, glibc):
        """A library that needs one symbol, of that glibc."""
        stand_in = os.path.join(self.folder, "libc.so.6")
        library = os.path.join(self.folder, "libknurl_unity.so")
        self.write(f"GLIBC_{glibc} {{ global: knurl_needed; local: *; }};", "map")
        compiler = [os.environ.get("CC", "cc"), "-shared", "-fPIC", "-nostdlib", "-x", "c", "-"]
        subprocess.run(compiler + ["-o", stand_in, f"-Wl,--version-script={self.folder}/map,-soname,libc.so.6"],
                       input="int knurl_needed(void); int knurl_needed(void) { return 1; }", text=True, check=True)
        subprocess.run(compiler + ["-o", library, "-x", "none", stand_in], text=True, check=True,
                       input="int knurl_needed(void); int f(void); int f(void) { return knurl_needed(); }")
        return library

    @unittest.skipUnless(shutil.which("objdump"), "no objdump")
    def test_a_library_for_a_newer_glibc_is_refused(self):
        self.expect_nothing_made(pack(self.out, self.library_of("2.32")),
                                 "libknurl_unity.so: expected symbols of glibc 2.31 or older, found ones of 2.32")
        self.assertEqual(pack(self.out, self.library_of("2.31")).returncode, 0)

    @unittest.skipUnless(shutil.which("objdump"), "no objdump")
    def test_a_newer_glibc_can_be_allowed_and_is_told(self):
        done = pack("--any-glibc", self.out, self.library_of("2.32"))
        self.assertEqual(done.returncode, 0)
        self.assertIn("found ones of 2.32: packed all the same", done.stderr)

    def test_addresses_are_written_where_they_are_known(self):
        url = "https://example.com/knurl"
        self.assertEqual(pack(self.out, self.linux, KNURL_URL=url + ".git").stderr, "")
        manifest = json.loads(package.read(self.stem, "package.json"))
        self.assertEqual(manifest["repository"], {"type": "git", "url": url + ".git"})
        for key in validate.ADDRESSES:
            path = manifest[key].removeprefix(url + "/blob/main/")
            self.assertTrue(os.path.isfile(os.path.join(package.ROOT, path)), path)
        self.assertIn(f'Page = "{manifest["documentationUrl"]}"', package.read(self.stem, "Runtime/Manual.cs"))
        self.assertIn("expected an https address", pack(self.out, self.linux, KNURL_URL="knurl").stderr)

    def test_it_is_signed_where_there_are_the_means(self):
        done = pack(self.out, self.linux, KNURL_UNITY_ORGANIZATION="42", PATH="/usr/bin:/bin")
        self.expect_nothing_made(done, "Unity's upm is not here to sign with")
        self.write('#!/bin/sh\nmkdir "$6"; echo "$1 $(basename "$2") $3 $4 $5" >"$6/com.knurl.haptics-'
                   + package.version() + '.tgz"\n', "upm")  # a stand-in that prints its arguments
        os.chmod(os.path.join(self.folder, "upm"), 0o755)
        done = pack(self.out, self.linux, KNURL_UNITY_ORGANIZATION="42", PATH=self.folder + ":" + os.environ["PATH"])
        self.assertIn(".tgz, signed, holds", done.stdout)
        self.assertEqual(package.read(self.tarball), "pack com.knurl.haptics --organization-id 42 --destination\n")
        self.assertIn(".tgz, unsigned, holds", pack(self.out, self.linux).stdout)

    def git(self, *arguments):
        command = ["git", "-C", self.folder, "-c", "user.name=a", "-c", "user.email=a@example.com", *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    @unittest.skipUnless(shutil.which("git"), "no git")
    def test_a_branch_holds_the_package_with_its_libraries_at_its_root(self):
        self.pack_both()
        self.git("init", "-q", "-b", "main")
        self.write("*.so\n*.dll\n", ".gitignore")
        self.git("add", ".gitignore")
        self.git("commit", "-q", "-m", "first")
        command = [os.path.join(package.UNITY, "branch.sh"), self.stem, "upm"]
        names = {"GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@example.com", "GIT_COMMITTER_NAME": "a",
                 "GIT_COMMITTER_EMAIL": "a@example.com"}
        for sentence in ("upm is com.knurl.haptics " + package.version(), "holds this package already"):
            done = subprocess.run(command, cwd=self.folder, env={**os.environ, **names}, capture_output=True, text=True,
                                  check=True)
            self.assertIn(sentence, done.stdout)
        there = [os.path.relpath(os.path.join(folder, name), self.stem)
                 for folder, _, files in os.walk(self.stem) for name in files]
        self.assertEqual(sorted(self.git("-c", "core.quotepath=off", "ls-tree", "-r", "--name-only", "upm").splitlines()),
                         sorted(there))
        self.assertEqual(self.git("ls-tree", "--name-only", "main"), ".gitignore\n")

    def copy_of_sources(self):
        """A copy of package.sh's inputs, to be broken."""
        unity = os.path.join(self.folder, "bindings", "unity")
        package.copy_of_package(os.path.join(unity, "package"))
        for name in ("metas.py", "package.sh", "validate.py"):
            shutil.copy(os.path.join(package.UNITY, name), unity)
        headers = os.path.join("sdk", "include", "knurl")
        os.makedirs(os.path.join(self.folder, headers))
        shutil.copy(os.path.join(package.ROOT, headers, "base.h"), os.path.join(self.folder, headers))
        return unity

    def test_a_version_that_is_not_the_sdks_is_refused(self):
        unity = self.copy_of_sources()
        manifest = package.read(unity, "package", "package.json").replace(f'"{package.version()}"', '"0.0.9"')
        self.write(manifest, unity, "package", "package.json")
        done = pack(self.out, self.linux, program=os.path.join(unity, "package.sh"))
        self.expect_nothing_made(done, f"package.json: version: expected {package.version()}")

    def test_a_package_with_a_wrong_meta_is_refused_and_the_last_one_stays(self):
        self.pack_both()
        unity = self.copy_of_sources()
        os.remove(os.path.join(unity, "package", "Editor.meta"))
        done = pack(self.out, self.linux, program=os.path.join(unity, "package.sh"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("Editor: missing", done.stderr)
        self.assertEqual(sorted(os.listdir(self.out)), [os.path.basename(self.stem), os.path.basename(self.tarball)])

    def test_a_library_that_somebody_tried_in_the_source_tree_is_not_packed(self):
        unity = self.copy_of_sources()
        shutil.copy(self.windows, os.path.join(unity, "package", WINDOWS))
        self.assertEqual(pack(self.out, self.linux, program=os.path.join(unity, "package.sh")).returncode, 0)
        self.assertFalse(os.path.exists(os.path.join(self.stem, WINDOWS)))


if __name__ == "__main__":
    unittest.main()
