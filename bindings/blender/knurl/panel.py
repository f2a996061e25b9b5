"""Panels of materials and objects. SPDX-License-Identifier: MIT"""
import bpy
from bpy.app.translations import pgettext_iface as translated
from bpy.props import BoolProperty, StringProperty

from . import feel, overlay, tag

ENCODER = 0.055e-3  # m: a 3D Systems Touch's
STRETCH_MAX = 2.0  # an octave: knurl inspect warns beyond it


def _stretched(part):
    """A sentence on a part whose uvs stretch, or None."""
    fs = tag.frequencies(part.tag)
    turned = tag.number(part.tag, "orientation", 0.0) != 0.0
    for k in (0, 1):
        felt, (least, most) = max(fs) if turned else fs[k], part.felt.stretch[k]
        if felt > 0.0 and (most > STRETCH_MAX or least * STRETCH_MAX < 1.0):
            words = translated("UVs stretch: ridges are {least:.2g} to {most:.2g} mm apart, uneven on {share:.2g} % of the area")
            return words.format(least=1000.0 / (most * felt), most=1000.0 / (least * felt), share=100.0 * part.felt.uneven)
    return None


def _by_shape(owner, mesh, shown):
    """Sentences on the mesh's effect on the ridges. shown: see overlay.shown_of()."""
    if shown.too_many:
        yield translated("Ridges are not drawn: {count} triangles, more than {most}").format(
            count=shown.too_many, most=overlay.TRIANGLES_MAX)
    for part in shown.parts:
        if owner not in (part.material, None) and isinstance(owner, bpy.types.Material):
            continue
        if part.felt.source == "box" and part.tag.get("coordinates") != "box":
            yield translated("UVs have no area: ridges follow positions; unwrap, or give an axis" if mesh.uv_layers else
                             "No UVs: ridges follow positions; give an axis to choose their direction")
        sentence = _stretched(part) if part.felt.source == "uvs" and part.tag.get("method") != "S2" else None
        if sentence:
            yield sentence
        if part.step > 1:
            yield translated("Many ridges: one of {step} is drawn").format(step=part.step)


def warnings_of(owner, shown_object=None, depsgraph=None):
    """Sentences for the panel. shown_object: the mesh object shown with the material, or None."""
    found = list(tag.faults(tag.read(owner) or {}))
    if any(f * 2.0 * ENCODER > 1.0 for f in tag.frequencies(tag.read(owner) or {})):
        found.append(translated("Ridges finer than two of a Touch's counts (0.11 mm)"))
    if owner.knurl_hardness > 800.0:
        found.append(translated("Stiffer than a Touch can hold (800 N/m)"))
    shown = shown_object and overlay.shown_of(shown_object, depsgraph)
    if shown:
        found += _by_shape(owner, shown_object.data, shown)
        if any(modifier.show_viewport for modifier in shown_object.modifiers):
            found.append(translated("Modifiers are felt if the export applies them"))
    return list(dict.fromkeys(found))


class KNURL_OT_preset(bpy.types.Operator):
    """Takes the tag of an everyday material"""
    bl_idname = "knurl.preset"
    bl_label = "Everyday Material"
    bl_options = {"REGISTER", "UNDO"}
    name: StringProperty()
    on_object: BoolProperty()

    @classmethod
    def description(cls, _context, properties):
        chosen = [m for m in tag.materials() if m["name"] == properties.name]
        return f"Period {chosen[0]['period']}. Depth {chosen[0]['depth']}" if chosen else cls.__doc__

    def execute(self, context):
        # in the Properties editor of a pinned material there may be no object
        owner = context.object if self.on_object else feel.material_of(context)
        chosen = [m for m in tag.materials() if m["name"] == self.name]
        if owner is None or owner.library or not chosen:
            self.report({"ERROR"}, f"Knurl: expected one of the everyday materials, found '{self.name}'" if not chosen else
                        "Knurl: expected an active material or object that is not linked from another file")
            return {"CANCELLED"}
        tag.write(owner, chosen[0]["tag"])
        return {"FINISHED"}


class KNURL_OT_copy(bpy.types.Operator):
    """Gives the other selected meshes this tag: theirs, or their active materials'"""
    bl_idname = "knurl.copy"
    bl_label = "Copy to Selected"
    bl_options = {"REGISTER", "UNDO"}
    on_object: BoolProperty()

    def execute(self, context):
        source = context.object if self.on_object else feel.material_of(context)
        others = [each if self.on_object else each.active_material for each in context.selected_objects if each.type == "MESH"]
        others = [each for each in dict.fromkeys(others) if each and each != source]
        editable = [each for each in others if not each.library]
        for each in editable if source else ():
            tag.write(each, tag.read(source))
        left = len(others) - len(editable)
        self.report({"INFO"} if source and editable else {"WARNING"}, f"Knurl: copied to {len(editable) if source else 0}" +
                    (f"; {left} linked from another file cannot be changed" if left else ""))
        return {"FINISHED"} if source and editable else {"CANCELLED"}


class KNURL_MT_presets(bpy.types.Menu):
    bl_idname = "KNURL_MT_presets"
    bl_label = "Everyday Material"

    def draw(self, context):
        for material in tag.materials():
            item = self.layout.operator("knurl.preset", text=material["title"], translate=False)
            item.name, item.on_object = material["name"], context.space_data.context == "OBJECT"


def _draw(layout, context, owner):
    shown = context.object if context.object and context.object.type == "MESH" else None
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.prop(context.window_manager, "knurl_show_ridges")
    column = layout.column()
    column.active = owner.knurl_on
    column.menu(KNURL_MT_presets.bl_idname)
    for name in ("knurl_ridges", "knurl_ridges_across", "knurl_depth", "knurl_hardness", "knurl_grip", "knurl_loss",
                 "knurl_turn", "knurl_across", "knurl_layout", "knurl_play", "knurl_flat"):
        column.prop(owner, name)
    for sentence in warnings_of(owner, shown, context.evaluated_depsgraph_get()) if owner.knurl_on else ():
        layout.label(text=sentence, icon="ERROR", translate=False)
    if len(context.selected_objects) > 1:
        layout.operator("knurl.copy", icon="PASTEDOWN").on_object = isinstance(owner, bpy.types.Object)
    if isinstance(owner, bpy.types.Material):
        layout.operator("knurl.from_texture", icon="TEXTURE")
    layout.operator("knurl.feel", icon="PLAY")


class _Panel:
    bl_label = "Knurl"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(self.owner_of(context), "knurl_on", text="")

    def draw(self, context):
        _draw(self.layout, context, self.owner_of(context))


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


CLASSES = (KNURL_OT_preset, KNURL_OT_copy, KNURL_MT_presets, KNURL_PT_material, KNURL_PT_object)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
