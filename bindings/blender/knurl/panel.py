"""Panels of materials and objects: ridges in mm, over the custom properties of tag.py. SPDX-License-Identifier: MIT"""
import os
import shutil
import subprocess
import tempfile

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, StringProperty

from . import tag

ENCODER = 0.055e-3  # m: a 3D Systems Touch's
OWNERS = (bpy.types.Material, bpy.types.Object)


def _number(key, name, description, default=0.0, **range_of):
    """A property for one key of the tag."""
    return FloatProperty(name=name, description=description, get=lambda self: float(tag.get(self, key, default)),
                         set=lambda self, value: tag.put(self, key, value), **range_of)


def _ridges(axis, name, description):
    def get(self):
        frequency = tag.frequencies(self)[axis]
        return 1000.0 / frequency if frequency > 0.0 else 0.0

    def put(self, value):
        both = tag.frequencies(self)
        both[axis] = 1000.0 / value if value > 0.0 else 0.0
        tag.put(self, "spatial_frequency", both)

    return FloatProperty(name=name, description=description, min=0.0, soft_max=10.0, precision=3, step=1, get=get, set=put)


def _choice(key, name, description, items):
    words = [item[0] for item in items]

    def get(self):
        value = tag.get(self, key, words[0])
        return words.index(value) if value in words else 0

    return EnumProperty(name=name, description=description, items=items, get=get,
                        set=lambda self, index: tag.put(self, key, words[index] if index else None))


PROPERTIES = {
    "knurl_on": BoolProperty(
        name="Knurl", description="A force-feedback device feels ridges here",
        get=lambda self: tag.read(self) is not None,
        set=lambda self, on: tag.write(self, (tag.read(self) or tag.DEFAULT) if on else None)),
    "knurl_ridges": _ridges(0, "Ridges (mm)", "From ridge to ridge along u; 0: a smooth surface"),
    "knurl_ridges_across": _ridges(1, "Across (mm)", "From ridge to ridge along v, which makes a grid; 0: no ridges"),
    "knurl_depth": FloatProperty(
        name="Depth (mm)", description="From the bottom of a groove to the top of a ridge", min=0.0, soft_max=2.0,
        precision=3, step=1, get=lambda self: 2000.0 * float(tag.get(self, "amplitude", 0.0)),
        set=lambda self, value: tag.put(self, "amplitude", value / 2000.0)),
    "knurl_hardness": _number("stiffness", "Stiffness (N/m)", "Of the wall; a Touch holds some 800 N/m", 400.0, min=0.001,
                              soft_min=50.0, soft_max=1000.0),
    "knurl_grip": _number("friction", "Friction", "Coulomb coefficient", min=0.0, soft_max=1.5),
    "knurl_loss": _number("damping", "Damping (N s/m)", "Along the normal", min=0.0, soft_max=5.0),
    "knurl_turn": _number("orientation", "Direction", "Turns the ridges about the normal", subtype="ANGLE"),
    "knurl_across": FloatVectorProperty(
        name="Axis", description="Direction across the ridges in the object's space; 0, 0, 0: by its UVs", size=3,
        subtype="XYZ", get=lambda self: tuple(tag.get(self, "axis", (0.0, 0.0, 0.0))),
        set=lambda self, value: tag.put(self, "axis", list(value) if any(value) else None)),
    "knurl_layout": _choice("coordinates", "Coordinates", "How ridges are placed", [
        ("auto", "UVs", "By axis, tangents or UVs; by positions if there are none"),
        ("box", "Box", "By positions in object space")]),
    "knurl_play": _choice("method", "Method", "How ridges are played", [
        ("default", "Default", "The application's"),
        ("S1", "S1", "The paper's, by position"),
        ("S2", "S2", "The paper's, by velocity"),
        ("bandlimited", "bandlimited", "In step and without false tones"),
    ]),
    "knurl_flat": BoolProperty(
        name="Faceted", description="Felt as its triangles, though the mesh is shaded smooth",
        get=lambda self: not tag.get(self, "smooth", True),
        set=lambda self, on: tag.put(self, "smooth", False if on else None)),
}


def warnings_of(owner, mesh):
    """Sentences for the panel. mesh: the mesh shown with the material, or None."""
    found = []
    felt = [1.0 / f for f in tag.frequencies(owner) if f > 0.0]
    if any(period < 2.0 * ENCODER for period in felt):
        found.append("Ridges finer than two of a Touch's counts (0.11 mm)")
    if owner.knurl_hardness > 800.0:
        found.append("Stiffer than a Touch can hold (800 N/m)")
    if mesh is not None and felt and not any(owner.knurl_across) and owner.knurl_layout == "auto" and not mesh.uv_layers:
        found.append("No UVs: ridges follow positions; give an axis to choose their direction")
    return found


class KNURL_OT_preset(bpy.types.Operator):
    """Takes the tag of an everyday material"""
    bl_idname = "knurl.preset"
    bl_label = "Everyday Material"
    bl_options = {"REGISTER", "UNDO"}
    name: StringProperty()
    on_object: BoolProperty()

    def execute(self, context):
        owner = context.object  # in the Properties editor of a pinned material there may be no object
        if not self.on_object:
            owner = getattr(context, "material", None) or (owner and owner.active_material)
        chosen = [m for m in tag.materials() if m["name"] == self.name]
        if owner is None or owner.library or not chosen:
            self.report({"ERROR"}, f"Knurl: expected one of the everyday materials, found '{self.name}'" if not chosen else
                        "Knurl: expected an active material or object that is not linked from another file")
            return {"CANCELLED"}
        tag.write(owner, chosen[0]["tag"])
        return {"FINISHED"}


class KNURL_OT_feel(bpy.types.Operator):
    """Exports the scene to a temporary file and opens it in Knurl's own view"""
    bl_idname = "knurl.feel"
    bl_label = "Feel"

    def execute(self, _context):
        tool = shutil.which(os.environ.get("KNURL_TOOL") or "knurl")
        if not tool:
            self.report({"ERROR"}, "Knurl: expected the program 'knurl' on the path, or its path in KNURL_TOOL")
            return {"CANCELLED"}
        path = os.path.join(tempfile.mkdtemp(prefix="knurl-"), "scene.glb")
        bpy.ops.export_scene.gltf(filepath=path)
        with open(path + ".log", "wb") as log:
            subprocess.Popen([tool, "run", path, "--view"], stdout=log, stderr=log)  # ends when its page is closed
        self.report({"INFO"}, f"Knurl: the page's address is in {path}.log")
        return {"FINISHED"}


class KNURL_MT_presets(bpy.types.Menu):
    bl_idname = "KNURL_MT_presets"
    bl_label = "Everyday Material"

    def draw(self, context):
        for material in tag.materials():
            item = self.layout.operator("knurl.preset", text=material["title"])
            item.name, item.on_object = material["name"], context.space_data.context == "OBJECT"


def _draw(layout, owner, mesh):
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.active = owner.knurl_on
    layout.menu(KNURL_MT_presets.bl_idname)
    for name in ("knurl_ridges", "knurl_ridges_across", "knurl_depth", "knurl_hardness", "knurl_grip", "knurl_loss",
                 "knurl_turn", "knurl_across", "knurl_layout", "knurl_play", "knurl_flat"):
        layout.prop(owner, name)
    for sentence in warnings_of(owner, mesh) if owner.knurl_on else ():
        layout.label(text=sentence, icon="ERROR")
    layout.operator("knurl.feel", icon="PLAY")


class _Panel:
    bl_label = "Knurl"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(self.owner_of(context), "knurl_on", text="")

    def draw(self, context):
        shown = context.object
        _draw(self.layout, self.owner_of(context), shown.data if shown and shown.type == "MESH" else None)


class KNURL_PT_material(_Panel, bpy.types.Panel):
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None

    @staticmethod
    def owner_of(context):
        return context.material


class KNURL_PT_object(_Panel, bpy.types.Panel):
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    @staticmethod
    def owner_of(context):
        return context.object


CLASSES = (KNURL_OT_preset, KNURL_OT_feel, KNURL_MT_presets, KNURL_PT_material, KNURL_PT_object)


def register():
    for owner in OWNERS:
        for name, made in PROPERTIES.items():
            setattr(owner, name, made)
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    for owner in OWNERS:
        for name in PROPERTIES:
            delattr(owner, name)
