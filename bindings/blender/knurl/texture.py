"""Ridges from a texture: `knurl tag --from-texture` on a temporary export. SPDX-License-Identifier: MIT"""
import json
import os
import subprocess
import tempfile

import bpy

from . import feel, tag

NO_PATTERN = 3  # the tool's exit code
LONGEST = 60.0  # s


class KNURL_OT_from_texture(bpy.types.Operator):
    """Finds the ridges in the material's normal, occlusion or base colour texture"""
    bl_idname = "knurl.from_texture"
    bl_label = "Ridges from Texture"
    bl_options = {"REGISTER", "UNDO"}

    def _refuse(self, kind, sentence):
        self.report({kind}, f"Knurl: {sentence}")
        return {"CANCELLED"}

    def execute(self, context):
        material = feel.material_of(context)
        if material is None or material.library:
            return self._refuse("ERROR", "expected an active material that is not linked from another file")
        tool = feel.tool()
        if not tool:
            return self._refuse("ERROR", feel.NO_TOOL)
        with tempfile.TemporaryDirectory(prefix="knurl-") as folder:
            path = os.path.join(folder, "scene.glb")
            try:
                bpy.ops.export_scene.gltf(filepath=path, export_apply=True)
                found = subprocess.run([tool, "tag", path, "--material", material.name, "--from-texture"],
                                       capture_output=True, encoding="utf-8", errors="replace", timeout=LONGEST)
            except (AttributeError, OSError, RuntimeError, subprocess.TimeoutExpired) as error:
                return self._refuse("ERROR", str(error))
        said = (found.stderr.strip().splitlines() or [f"{tool} ended with {found.returncode}"])[-1]
        said = said.replace(path, material.name).removeprefix("knurl: ")
        if found.returncode != 0:
            return self._refuse("WARNING" if found.returncode == NO_PATTERN else "ERROR", said)
        made = {**(tag.read(material) or tag.DEFAULT), **json.loads(found.stdout)["tag"]}
        tag.write(material, {key: value for key, value in made.items() if value is not None})
        self.report({"INFO"}, f"Knurl: {said}")
        return {"FINISHED"}


def register():
    bpy.utils.register_class(KNURL_OT_from_texture)


def unregister():
    bpy.utils.unregister_class(KNURL_OT_from_texture)
