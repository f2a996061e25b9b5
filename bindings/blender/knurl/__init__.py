"""Knurl in Blender: ridges on materials and objects, in mm, and in glTF files. SPDX-License-Identifier: MIT"""
from . import feel, overlay, panel, properties, texture, translations
from .gltf import glTF2ExportUserExtension, glTF2ImportUserExtension  # found by the glTF add-on under these names

bl_info = {  # Blender 3.4 to 4.1; from 4.2 on blender_manifest.toml counts
    "name": "Knurl",
    "description": "Ridges that a force-feedback device can feel",
    "author": "Knurl",
    "version": (0, 3, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Material and Object > Knurl",
    "category": "Material",
}

__all__ = ["glTF2ExportUserExtension", "glTF2ImportUserExtension", "register", "unregister"]

PARTS = (translations, properties, overlay, feel, texture, panel)


def register():
    for part in PARTS:
        part.register()


def unregister():
    for part in reversed(PARTS):
        part.unregister()
