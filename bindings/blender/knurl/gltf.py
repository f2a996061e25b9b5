"""Tags in glTF files, by the hooks of Blender's glTF add-on; independent of its option Custom Properties.
SPDX-License-Identifier: MIT"""
from . import tag


def _export(made, owner, settings):
    if made is None or owner is None:
        return
    extras = {key: value for key, value in (made.extras or {}).items() if key != "knurl" and not key.startswith(tag.PREFIX)}
    found = tag.read(owner)
    if found:
        if any(tag.axis(found)) and not settings.get("gltf_yup", True):
            found["axis"] = tag.turned(found["axis"], False)
        extras["knurl"] = found
    made.extras = extras or None


def _import(loaded, owner):
    extras = getattr(loaded, "extras", None)
    if owner is None or not isinstance(extras, dict):
        return
    nested = extras.get("knurl")
    flat = {key[len(tag.PREFIX):]: value for key, value in extras.items() if key.startswith(tag.PREFIX)}
    if isinstance(nested, dict) or flat:
        tag.write(owner, nested if isinstance(nested, dict) else flat)


class glTF2ExportUserExtension:  # pylint: disable=invalid-name
    """Writes extras.knurl, in the nested form."""

    def gather_material_hook(self, gltf2_material, blender_material, export_settings):
        _export(gltf2_material, blender_material, export_settings)

    def gather_mesh_hook(self, gltf2_mesh, blender_mesh, *rest):  # parameters between them differ between versions
        _export(gltf2_mesh, blender_mesh, rest[-1])

    def gather_node_hook(self, gltf2_node, blender_object, export_settings):
        _export(gltf2_node, blender_object, export_settings)


class glTF2ImportUserExtension:  # pylint: disable=invalid-name
    """Reads both forms into custom properties, which the panels show."""

    def __init__(self):
        self.extensions = []  # read by the importer

    def gather_import_material_after_hook(self, gltf_material, _vertex_color, blender_material, _gltf):
        _import(gltf_material, blender_material)

    def gather_import_mesh_after_hook(self, gltf_mesh, blender_mesh, _gltf):
        _import(gltf_mesh, blender_mesh)

    def gather_import_node_after_hook(self, _vnode, gltf_node, blender_object, _gltf):
        _import(gltf_node, blender_object)
