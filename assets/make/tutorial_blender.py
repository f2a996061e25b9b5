"""docs/tutorial.md in Blender, without a window: installs the extension, imports a model, chooses a material, exports.
usage: blender --background --python tutorial_blender.py -- ZIP MODEL OUT     SPDX-License-Identifier: MIT"""
import os
import sys
import tempfile
import zipfile

import addon_utils
import bpy
import numpy

archive, model, out = (os.path.abspath(path) for path in sys.argv[-3:])
if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Debian 12's Blender 3.4 needs it to import glTF with its own numpy
bpy.ops.wm.read_factory_settings(use_empty=True)
folder = tempfile.mkdtemp()
with zipfile.ZipFile(archive) as files:
    files.extractall(folder)
sys.path.insert(0, folder)
addon_utils.enable("io_scene_gltf2")
addon_utils.enable("knurl", default_set=True)  # as the preferences do
bpy.ops.import_scene.gltf(filepath=model)
bpy.context.view_layer.objects.active = [each for each in bpy.context.scene.objects if each.type == "MESH"][0]
bpy.ops.knurl.preset(name="knurl_straight")
bpy.ops.export_scene.gltf(filepath=out)
