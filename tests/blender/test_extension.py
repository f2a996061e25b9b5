"""The Blender extension in a real Blender, installed from its zip; the tool judges the files that it makes.
usage: PYTHON_WITH_BPY test_extension.py KNURL ZIP     or: blender --background --python test_extension.py -- KNURL ZIP
SPDX-License-Identifier: MIT"""
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import zipfile

import bpy  # before addon_utils, whose folder it adds
import addon_utils
import numpy

KNURL, ZIP = sys.argv[-2:]
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


class Extension(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
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

    def export(self, extras=False):
        bpy.ops.export_scene.gltf(filepath=self.path, export_extras=extras)
        return json_of(self.path)

    def test_millimetres_become_the_tag_that_the_tool_reads(self):
        self.material.knurl_on = True
        self.material.knurl_ridges = 0.5
        self.material.knurl_depth = 0.4
        self.material.knurl_hardness = 500.0
        self.material.knurl_play = "S2"
        for extras in (False, True):
            made = self.export(extras)["materials"][0]["extras"]
            self.assertEqual(list(made), ["knurl"])
            surfaces, said = inspect(self.path)
            self.assertEqual(said, "")
            material = surfaces[0]["material"]
            self.assertAlmostEqual(material["spatial_frequency"][0], 2000.0, places=3)
            self.assertAlmostEqual(material["amplitude"], 0.0002, places=9)
            self.assertEqual((material["stiffness"], material["method"]), (500.0, "S2"))

    def test_an_object_overrides_its_material(self):
        self.material.knurl_on = True
        self.object.knurl_on = True
        self.object.knurl_ridges, self.object.knurl_ridges_across = 2.0, 4.0
        self.export()
        self.assertEqual(inspect(self.path)[0][0]["material"]["spatial_frequency"], [500.0, 250.0])

    def test_a_file_imported_and_exported_has_the_same_tag(self):
        self.material.knurl_on = True
        self.material.knurl_turn = 0.5
        self.material.knurl_across = (0.0, 1.0, 0.0)
        self.material.knurl_layout = "auto"
        self.material.knurl_flat = True
        before = self.export()["materials"][0]["extras"]["knurl"]
        bpy.data.materials.remove(self.material)
        bpy.ops.import_scene.gltf(filepath=self.path)
        loaded = bpy.context.object.active_material
        self.assertTrue(loaded.knurl_on)
        self.assertNotIn("knurl", loaded.keys())
        bpy.data.objects.remove(self.object)
        self.assertEqual(self.export()["materials"][0]["extras"], {"knurl": before})

    def test_switched_off_nothing_is_left(self):
        self.material.knurl_on = True
        self.material["mine"] = 1
        self.material.knurl_on = False
        self.assertEqual(self.export(True)["materials"][0]["extras"], {"mine": 1})
        self.assertNotIn("extras", self.export()["materials"][0])
        self.assertEqual([key for key in self.material.keys() if key.startswith("knurl")], [])

    def test_a_preset_is_the_material_of_the_list(self):
        with zipfile.ZipFile(ZIP) as archive:
            wanted = json.loads(archive.read("knurl/materials.json"))["materials"]
        self.assertGreater(len(wanted), 23)
        for material in wanted:
            self.assertEqual(bpy.ops.knurl.preset(name=material["name"]), {"FINISHED"})
            made = self.export()["materials"][0]["extras"]["knurl"]
            self.assertEqual(made, {"version": 1, **material["tag"]})

    def test_flat_properties_of_older_files_are_the_same_tag(self):
        self.material["knurl_spatial_frequency"] = 1000.0
        self.material["knurl_amplitude"] = 1e-4
        self.material["knurl_stiffness"] = 300.0
        self.assertTrue(self.material.knurl_on)
        self.assertAlmostEqual(self.material.knurl_ridges, 1.0, places=6)
        self.export(True)
        self.assertEqual(inspect(self.path)[0][0]["material"]["spatial_frequency"], [1000.0, 0.0])

    def test_a_nested_tag_of_another_importer_is_shown_and_edited_whole(self):
        self.material["knurl"] = {"version": 1, "spatial_frequency": [1000.0, 0.0], "amplitude": 1e-4, "stiffness": 300.0}
        self.assertAlmostEqual(self.material.knurl_ridges, 1.0, places=6)
        self.assertAlmostEqual(self.material.knurl_depth, 0.2, places=6)
        self.material.knurl_grip = 0.5
        self.assertEqual(self.export()["materials"][0]["extras"]["knurl"], {
            "version": 1, "spatial_frequency": [1000.0, 0.0], "amplitude": 1e-4, "stiffness": 300.0, "friction": 0.5})

    def test_a_setting_changed_while_off_makes_a_whole_tag(self):
        self.material.knurl_grip = 0.5
        self.export()
        surfaces, said = inspect(self.path)
        self.assertEqual((said, surfaces[0]["material"]["friction"]), ("", 0.5))

    def test_presets_need_a_material_of_this_file(self):
        path = os.path.join(self.folder.name, "linked.blend")
        bpy.data.libraries.write(path, {self.material})
        with bpy.data.libraries.load(path, link=True) as (there, here):
            here.materials = there.materials
        for material in (here.materials[0], None):
            self.object.data.materials[0] = material
            with self.assertRaisesRegex(RuntimeError, "expected an active material"):
                bpy.ops.knurl.preset(name="corduroy")
        bpy.context.view_layer.objects.active = None
        with self.assertRaisesRegex(RuntimeError, "expected an active material"):
            bpy.ops.knurl.preset(name="corduroy")

    def test_feel_runs_the_tool_on_an_export(self):
        program = os.path.join(self.folder.name, "tool")
        with open(program, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\necho \"$@\"\n")
        self.addCleanup(os.environ.pop, "KNURL_TOOL", None)
        os.environ["KNURL_TOOL"] = program
        with self.assertRaisesRegex(RuntimeError, "expected the program"):
            bpy.ops.knurl.feel()  # it cannot be run yet
        os.chmod(program, 0o755)
        made = []
        popen = subprocess.Popen
        with unittest.mock.patch("subprocess.Popen", lambda *args, **named: made.append(popen(*args, **named)) or made[0]):
            self.assertEqual(bpy.ops.knurl.feel(), {"FINISHED"})
        self.assertEqual(made[0].wait(10), 0)
        scene = made[0].args[2]
        self.addCleanup(shutil.rmtree, os.path.dirname(scene))
        self.assertEqual(json_of(scene)["asset"]["version"], "2.0")
        with open(scene + ".log", encoding="utf-8") as log:
            self.assertEqual(log.read(), f"run {scene} --view\n")

    def test_it_can_be_disabled_and_enabled_again(self):
        for _ in range(2):
            addon_utils.disable(NAME)
            self.assertFalse(hasattr(self.material, "knurl_on"))
            addon_utils.enable(NAME)
            self.assertFalse(self.material.knurl_on)

    def test_warnings_name_what_cannot_be_felt(self):
        warnings_of = sys.modules[NAME + ".panel"].warnings_of
        self.material.knurl_on = True
        self.assertEqual(warnings_of(self.material, self.object.data), [])
        self.material.knurl_ridges, self.material.knurl_hardness = 0.1, 900.0
        self.object.data.uv_layers.remove(self.object.data.uv_layers[0])
        self.assertEqual(len(warnings_of(self.material, self.object.data)), 3)


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result
    sys.stderr.flush()
    os._exit(0 if result.wasSuccessful() else 1)  # bpy 4.2 as a module crashes when Python ends
