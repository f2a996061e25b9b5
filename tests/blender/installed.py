"""The extension, installed from its zip into a real Blender, for the tests of this folder.
usage: PYTHON_WITH_BPY main.py TOOLS ZIP     or: blender --background --python main.py -- TOOLS ZIP
TOOLS: the folder of the programs knurl and cycles. SPDX-License-Identifier: MIT"""
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

import bpy  # before addon_utils, whose folder it adds
import addon_utils
import numpy

TOOLS, ZIP = sys.argv[-2:]
KNURL = os.path.join(TOOLS, "knurl")
IS_EXTENSION = bpy.app.version >= (4, 2)
NAME = "bl_ext.user_default.knurl" if IS_EXTENSION else "knurl"
if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Debian 12's Blender 3.4 needs it to import glTF with its own numpy


def install():
    """Installs the zip as a user does; for versions before 4.2 it is unpacked here."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("io_scene_gltf2")
    if IS_EXTENSION:
        bpy.ops.extensions.package_install_files(filepath=ZIP, repo="user_default", enable_on_install=True)
    else:
        folder = tempfile.mkdtemp()
        with zipfile.ZipFile(ZIP) as archive:
            archive.extractall(folder)
        sys.path.insert(0, folder)
        addon_utils.enable(NAME, default_set=True)
    assert NAME in bpy.context.preferences.addons, "the extension is not enabled"


def inspect(path):
    """The surfaces in the output of `knurl inspect`, and its messages."""
    done = subprocess.run([KNURL, "inspect", path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)["surfaces"], done.stderr


def json_of(path):
    with open(path, "rb") as file:
        data = file.read()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


class Case(unittest.TestCase):
    """With a plane of 0.1 m and its material, `ridges`."""

    exported = 0

    @classmethod
    def setUpClass(cls):
        if NAME not in bpy.context.preferences.addons:
            install()

    def setUp(self):
        for blocks in (bpy.data.objects, bpy.data.meshes, bpy.data.materials):
            for block in list(blocks):
                blocks.remove(block)
        bpy.ops.mesh.primitive_plane_add(size=0.1)
        self.object = bpy.context.object
        self.material = bpy.data.materials.new("ridges")
        self.object.data.materials.append(self.material)
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "plane.glb")

    def export(self, warned=False, **options):
        """Exports the scene; returns the JSON. warned: of its ridges `knurl inspect` has to warn, or there are none."""
        bpy.ops.export_scene.gltf(filepath=self.path, **options)
        if "KNURL_KEEP" in os.environ:
            Case.exported += 1
            name = f"{'warned' if warned else 'clean'}_{Case.exported}_{self.id().rsplit('.', 1)[1]}.glb"
            shutil.copy(self.path, os.path.join(os.environ["KNURL_KEEP"], name))
        return json_of(self.path)

