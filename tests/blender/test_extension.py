"""The Blender extension's settings, exports and imports; the tool judges the files. usage: see installed.py
SPDX-License-Identifier: MIT"""
import json
import os
import re
import sys
import zipfile

import installed
import numpy
from installed import KNURL, NAME, ZIP, bpy, addon_utils, inspect, json_of


class Extension(installed.Case):
    def test_millimetres_become_the_tag_that_the_tool_reads(self):
        self.material.knurl_on = True
        self.material.knurl_ridges = 0.5
        self.material.knurl_depth = 0.4
        self.material.knurl_hardness = 500.0
        self.material.knurl_play = "S2"
        for extras in (False, True):
            made = self.export(export_extras=extras)["materials"][0]["extras"]
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
        self.assertEqual(self.export(warned=True, export_extras=True)["materials"][0]["extras"], {"mine": 1})
        self.assertNotIn("extras", self.export(warned=True)["materials"][0])
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
        self.export(export_extras=True)
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
            file.write("#!/bin/sh\nprintf 'http://127.0.0.1:1/?'\nprintf %s, \"$@\"\necho\n")
        self.addCleanup(os.environ.pop, "KNURL_TOOL", None)
        os.environ["KNURL_TOOL"] = program
        with self.assertRaisesRegex(RuntimeError, "expected the program"):
            bpy.ops.knurl.feel()  # it cannot be run yet
        os.chmod(program, 0o755)
        feel = sys.modules[NAME + ".feel"]
        opened = []
        self.addCleanup(setattr, feel, "_open", feel._open)
        feel._open = opened.append
        self.assertEqual(bpy.ops.knurl.feel(), {"FINISHED"})
        (process, folder, _), = feel._running
        scene = os.path.join(folder, "scene.glb")
        self.assertEqual(process.wait(10), 0)
        self.assertEqual(json_of(scene)["asset"]["version"], "2.0")
        with open(scene + ".log", encoding="utf-8") as log:
            self.assertEqual(log.read(), f"http://127.0.0.1:1/?run,{scene},--view,\n")
        self.assertIsNone(feel._look())  # as Blender's timer does
        self.assertEqual(opened, [f"http://127.0.0.1:1/?run,{scene},--view,"])
        self.assertFalse(os.path.exists(folder))

    def _texture(self, grey):
        """Gives the material a texture, one number a pixel, over the plane's 0.1 m."""
        image = bpy.data.images.new("cloth", grey.shape[1], grey.shape[0])
        image.pixels.foreach_set(numpy.repeat(grey[..., None], 4, axis=2).astype(numpy.float32).ravel())
        image.pack()
        self.material.use_nodes = True
        nodes = self.material.node_tree
        shown = nodes.nodes.new("ShaderNodeTexImage")
        shown.image = image
        nodes.links.new(shown.outputs["Color"], nodes.nodes["Principled BSDF"].inputs["Base Color"])

    def test_ridges_are_found_in_a_texture(self):
        self.addCleanup(os.environ.pop, "KNURL_TOOL", None)
        os.environ["KNURL_TOOL"] = KNURL
        self._texture(numpy.tile(0.5 + 0.4 * numpy.sin(2.0 * numpy.pi * numpy.arange(256) * 20.0 / 256.0), (256, 1)))
        self.material.knurl_grip = 0.5
        self.assertEqual(bpy.ops.knurl.from_texture(), {"FINISHED"})
        self.assertAlmostEqual(self.material.knurl_ridges, 5.0, delta=0.02)
        self.assertEqual((self.material.knurl_ridges_across, self.material.knurl_grip), (0.0, 0.5))
        self.export()
        self.assertAlmostEqual(inspect(self.path)[0][0]["material"]["spatial_frequency"][0], 200.0, delta=1.0)

    def test_a_texture_without_a_pattern_changes_nothing(self):
        self.addCleanup(os.environ.pop, "KNURL_TOOL", None)
        os.environ["KNURL_TOOL"] = KNURL
        self._texture(numpy.random.default_rng(1).random((256, 256)))
        self.assertEqual(bpy.ops.knurl.from_texture(), {"CANCELLED"})
        self.assertFalse(self.material.knurl_on)

    def test_a_texture_needs_the_tool_and_a_texture(self):
        self.addCleanup(os.environ.pop, "KNURL_TOOL", None)
        os.environ["KNURL_TOOL"] = os.path.join(self.folder.name, "no tool")
        with self.assertRaisesRegex(RuntimeError, "expected the program"):
            bpy.ops.knurl.from_texture()
        os.environ["KNURL_TOOL"] = KNURL
        with self.assertRaisesRegex(RuntimeError, "ridges.*texture"):
            bpy.ops.knurl.from_texture()

    def test_without_blenders_gltf_add_on_the_buttons_say_so(self):
        self.addCleanup(os.environ.pop, "KNURL_TOOL", None)
        self.addCleanup(addon_utils.enable, "io_scene_gltf2")
        os.environ["KNURL_TOOL"] = KNURL
        addon_utils.disable("io_scene_gltf2")
        for press in (bpy.ops.knurl.from_texture, bpy.ops.knurl.feel):
            with self.assertRaisesRegex(RuntimeError, "^Error: Knurl: .*export_scene.gltf"):
                press()

    def test_it_can_be_disabled_and_enabled_again(self):
        for _ in range(2):
            addon_utils.disable(NAME)
            self.assertFalse(hasattr(self.material, "knurl_on"))
            addon_utils.enable(NAME)
            self.assertFalse(self.material.knurl_on)

    def warnings(self, owner=None):
        return sys.modules[NAME + ".panel"].warnings_of(owner or self.material, self.object, bpy.context.evaluated_depsgraph_get())

    def test_warnings_name_what_cannot_be_felt(self):
        self.material.knurl_on = True
        self.assertEqual(self.warnings(), [])
        self.material.knurl_ridges, self.material.knurl_hardness = 0.1, 900.0
        self.object.data.uv_layers.remove(self.object.data.uv_layers[0])
        self.object.data.update()
        bpy.context.view_layer.update()
        self.assertEqual([sentence[:9] for sentence in self.warnings()], ["Ridges fi", "Stiffer t", "No UVs: r"])

    def test_a_warning_tells_how_uvs_stretch_as_inspect_does(self):
        self.material.knurl_on = True
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=2, y_subdivisions=1, size=0.1)
        self.object = bpy.context.object
        self.object.data.materials.append(self.material)
        for at in self.object.data.uv_layers[0].data:
            at.uv[0] = max(0.0, at.uv[0] - 0.45)  # the left half has a tenth of the uvs
        said, = self.warnings()
        felt = self.inspected()
        self.assertIn(f"UVs stretch: ridges are {1000.0 / felt[1]:.2g} to {1000.0 / felt[0]:.2g} mm apart", said)
        self.material.knurl_play = "S2"  # follows the velocity
        self.assertEqual(self.warnings(), [])

    def inspected(self):
        """Ridges per metre, least and most, in a warning of `knurl inspect`."""
        self.export(warned=True)
        found = re.search(r"are felt as ([0-9.e+]+) to ([0-9.e+]+)/m", inspect(self.path)[1])
        return float(found[1]), float(found[2])

    def test_a_palette_and_modifiers_are_warned_of(self):
        self.material.knurl_on = True
        self.object.data.uv_layers[0].data.foreach_set("uv", [0.5] * 8)
        self.object.modifiers.new("thick", "SOLIDIFY")
        self.object.data.update()
        bpy.context.view_layer.update()
        self.assertEqual([sentence[:9] for sentence in self.warnings()], ["UVs have ", "Modifiers"])
