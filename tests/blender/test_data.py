"""Tags as Blender's data: numbers as typed, keys of other versions, undo, linked and overridden data, several objects.
SPDX-License-Identifier: MIT"""
import os
import subprocess
import sys

import installed
from installed import NAME, addon_utils, bpy


class Data(installed.Case):
    def setUp(self):
        super().setUp()
        self.tag = sys.modules[NAME + ".tag"]

    def tag_of(self, kind="materials", **options):
        return self.export(**options)[kind][0]["extras"]["knurl"]

    def test_numbers_are_written_as_they_were_typed(self):
        self.material.knurl_on = True
        self.material.knurl_ridges, self.material.knurl_depth = 0.4, 0.3
        self.material.knurl_hardness, self.material.knurl_grip, self.material.knurl_loss = 512.3, 0.3, 0.7
        self.material.knurl_across = (0.1, 0.2, 0.3)
        self.assertEqual(self.tag_of(), {
            "version": 1, "spatial_frequency": [2500.0, 0.0], "amplitude": 0.00015, "stiffness": 512.3, "damping": 0.7,
            "friction": 0.3, "axis": [0.1, 0.3, -0.2]})

    def test_an_axis_is_that_of_the_file(self):
        self.material.knurl_on = True
        self.material.knurl_across = (0.0, 0.0, 1.0)
        self.assertEqual(self.tag_of()["axis"], [0.0, 1.0, 0.0])
        self.assertEqual(tuple(self.material.knurl_across), (0.0, 0.0, 1.0))
        self.assertEqual(self.tag_of(export_yup=False)["axis"], [0.0, 0.0, 1.0])

    def test_keys_of_later_versions_stay(self):
        later = {"version": 2, "spatial_frequency": [1000.0, 0.0], "amplitude": 1e-4, "stiffness": 300.0, "warmth": 0.5,
                 "layers": {"under": 3.0}}
        for kept in ("flat", "nested"):
            if kept == "flat":
                self.tag.write(self.material, later)
            else:
                self.tag.write(self.material, None)
                self.material["knurl"] = later
            before = self.tag_of(warned=True)  # knurl refuses them, as it should
            self.assertEqual(before, later)
            bpy.ops.import_scene.gltf(filepath=self.path)
            loaded = bpy.context.object
            self.assertEqual(self.tag.read(loaded.active_material), later)
            bpy.data.objects.remove(loaded)

    def test_what_was_typed_wrongly_by_hand_is_warned_of_and_drawn_as_nothing(self):
        warnings_of = sys.modules[NAME + ".panel"].warnings_of
        for key, value, words in (
                ("spatial_frequency", "fine", "expected one or two numbers of 0 or more, found 'fine'"),
                ("spatial_frequency", [1.0, 2.0, 3.0], "expected one or two numbers"),
                ("amplitude", "0.1 mm", "expected a number of 0 or more"),
                ("stiffness", -1.0, "expected a number above 0"),
                ("orientation", "45", "expected a number, found '45'"),
                ("axis", [0.0, 0.0, 0.0], "expected three numbers that are not all 0"),
                ("axis", "z", "expected three numbers"),
                ("amplitud", 1.0, "unknown")):
            self.tag.write(self.material, {**self.tag.DEFAULT, key: value})
            for shown in ("ridges", "ridges_across", "depth", "hardness", "turn", "across", "layout", "play", "flat"):
                getattr(self.material, "knurl_" + shown)
            said = warnings_of(self.material, self.object, bpy.context.evaluated_depsgraph_get())
            self.assertEqual(len(said), 1, said)
            self.assertIn(f"knurl_{key}: {words}", said[0])
            with self.assertRaises(subprocess.CalledProcessError, msg=said):  # the tool refuses it, too
                self.export(warned=True)
                installed.inspect(self.path)

    def test_other_exporters_write_the_properties_too(self):
        addon_utils.enable("io_scene_fbx")
        self.material.knurl_on = True
        path = os.path.join(self.folder.name, "plane.fbx")
        bpy.ops.export_scene.fbx(filepath=path, use_custom_props=True)
        with open(path, "rb") as file:
            data = file.read()
        for key in self.tag.DEFAULT:
            self.assertIn(b"knurl_" + key.encode(), data)

    def test_a_setting_is_undone_and_done_again(self):
        bpy.context.preferences.edit.use_global_undo = True
        bpy.ops.ed.undo_push(message="before")
        self.material.knurl_on = True
        self.material.knurl_ridges = 0.5
        bpy.ops.ed.undo_push(message="tagged")
        bpy.ops.ed.undo()
        self.assertFalse(bpy.data.materials["ridges"].knurl_on)
        bpy.ops.ed.redo()
        self.assertAlmostEqual(bpy.data.materials["ridges"].knurl_ridges, 0.5)

    def linked(self):
        """The plane in a file of its own, linked."""
        self.material.knurl_on = True
        self.material.knurl_ridges = 0.5
        path = os.path.join(self.folder.name, "linked.blend")
        bpy.data.libraries.write(path, {self.object})
        bpy.data.objects.remove(self.object)
        bpy.data.materials.remove(self.material)
        with bpy.data.libraries.load(path, link=True) as (there, here):
            here.objects = there.objects
        bpy.context.scene.collection.objects.link(here.objects[0])
        return here.objects[0]

    def test_a_linked_material_is_exported_and_refuses_changes(self):
        linked = self.linked()
        self.assertAlmostEqual(linked.active_material.knurl_ridges, 0.5)
        self.assertEqual(self.tag_of()["spatial_frequency"], [2000.0, 0.0])
        bpy.context.view_layer.objects.active = linked
        with self.assertRaisesRegex(RuntimeError, "not linked from another file"):
            bpy.ops.knurl.preset(name="corduroy")

    def test_an_override_keeps_its_tag_in_the_file(self):
        override = self.linked().override_create(remap_local_usages=True)
        override.knurl_on = True
        override.knurl_ridges = 0.25
        path = os.path.join(self.folder.name, "overriding.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        loaded = [each for each in bpy.data.objects if each.override_library][0]
        self.assertAlmostEqual(loaded.knurl_ridges, 0.25)

    def test_a_tag_is_copied_to_all_selected_objects(self):
        others = []
        for _ in range(3):
            bpy.ops.mesh.primitive_plane_add(size=0.1)
            others.append(bpy.context.object)
        others[0].data.materials.append(bpy.data.materials.new("own"))
        self.object.knurl_on = self.material.knurl_on = True
        self.object.knurl_ridges, self.material.knurl_ridges = 0.5, 0.25
        for each in (*others[:2], self.object):
            each.select_set(True)
        others[2].select_set(False)
        bpy.context.view_layer.objects.active = self.object
        self.assertEqual(bpy.ops.knurl.copy(on_object=True), {"FINISHED"})
        self.assertEqual([self.tag.read(each) for each in others], [self.tag.read(self.object)] * 2 + [None])
        self.assertEqual(bpy.ops.knurl.copy(), {"FINISHED"})
        self.assertAlmostEqual(others[0].active_material.knurl_ridges, 0.25)
        self.object.select_set(False)
        for each in others:
            each.select_set(False)
        self.assertEqual(bpy.ops.knurl.copy(on_object=True), {"CANCELLED"})
