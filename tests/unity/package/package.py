"""Shared by the tests of the Unity package: paths, copies to break, metas.py as a module."""
import os
import re
import shutil
import sys
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
UNITY = os.path.join(ROOT, "bindings", "unity")
PACKAGE = os.path.join(UNITY, "package")

sys.path.insert(0, UNITY)
import metas  # noqa: E402  pylint: disable=wrong-import-position,unused-import
import validate  # noqa: E402  pylint: disable=wrong-import-position,unused-import


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def version():
    """The SDK's, from its header."""
    header = read(ROOT, "sdk", "include", "knurl", "base.h")
    return ".".join(re.findall(r"^#define KNURL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, re.MULTILINE))


def copy_of_package(folder):
    """The package as git has it: without libraries that somebody put there to try them."""
    return shutil.copytree(PACKAGE, folder, ignore=shutil.ignore_patterns("*.so", "*.dll"))


class InFolder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = holder.name

    def write(self, text, *path):
        with open(os.path.join(self.folder, *path), "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
