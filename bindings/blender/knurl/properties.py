"""The settings of materials and objects, in mm, over the custom properties of tag.py. SPDX-License-Identifier: MIT"""
import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty

from . import tag

OWNERS = (bpy.types.Material, bpy.types.Object)


def redraw(_owner, _context):
    """The ridges in all 3D views."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _typed(value):
    """The number that was typed: Blender's are float32, and 0.3 arrives as 0.30000001."""
    return float(f"{value:.7g}")


_OVERRIDABLE = {"LIBRARY_OVERRIDABLE"}


def _number(key, name, description, default=0.0, **range_of):
    """A property for one key of the tag."""
    return FloatProperty(name=name, description=description, get=lambda self: tag.number(tag.read(self) or {}, key, default),
                         set=lambda self, value: tag.put(self, key, _typed(value)), update=redraw, override=_OVERRIDABLE,
                         **range_of)


def _ridges(axis, name, description):
    def get(self):
        frequency = tag.frequencies(tag.read(self) or {})[axis]
        return 1000.0 / frequency if frequency > 0.0 else 0.0

    def put(self, value):
        both = tag.frequencies(tag.read(self) or tag.DEFAULT)
        both[axis] = 1000.0 / _typed(value) if value > 0.0 else 0.0
        tag.put(self, "spatial_frequency", both)

    return FloatProperty(name=name, description=description, min=0.0, soft_max=10.0, precision=3, step=1, get=get, set=put,
                         update=redraw, override=_OVERRIDABLE)


def _choice(key, name, description, items):
    words = [item[0] for item in items]

    def get(self):
        value = tag.get(self, key, words[0])
        return words.index(value) if value in words else 0

    return EnumProperty(name=name, description=description, items=items, get=get, update=redraw, override=_OVERRIDABLE,
                        set=lambda self, index: tag.put(self, key, words[index] if index else None))


PROPERTIES = {
    "knurl_on": BoolProperty(
        name="Knurl", description="A force-feedback device feels ridges here", update=redraw, override=_OVERRIDABLE,
        get=lambda self: tag.read(self) is not None,
        set=lambda self, on: tag.write(self, (tag.read(self) or tag.DEFAULT) if on else None)),
    "knurl_ridges": _ridges(0, "Ridges (mm)", "From ridge to ridge along u; 0: a smooth surface"),
    "knurl_ridges_across": _ridges(1, "Across (mm)", "From ridge to ridge along v, which makes a grid; 0: no ridges"),
    "knurl_depth": FloatProperty(
        name="Depth (mm)", description="From the bottom of a groove to the top of a ridge", min=0.0, soft_max=2.0,
        precision=3, step=1, get=lambda self: 2000.0 * tag.number(tag.read(self) or {}, "amplitude", 0.0),
        set=lambda self, value: tag.put(self, "amplitude", _typed(value) / 2000.0), override=_OVERRIDABLE),
    "knurl_hardness": _number("stiffness", "Stiffness (N/m)", "Of the wall; a Touch holds some 800 N/m", 400.0, min=0.001,
                              soft_min=50.0, soft_max=1000.0),
    "knurl_grip": _number("friction", "Friction", "Coulomb coefficient", min=0.0, soft_max=1.5),
    "knurl_loss": _number("damping", "Damping (N s/m)", "Along the normal", min=0.0, soft_max=5.0),
    "knurl_turn": _number("orientation", "Direction", "Turns the ridges about the normal", subtype="ANGLE"),
    "knurl_across": FloatVectorProperty(
        name="Axis", description="Direction across the ridges in the object's space; 0, 0, 0: by its UVs", size=3,
        subtype="XYZ", get=lambda self: tag.turned(tag.axis(tag.read(self) or {}), False),
        set=lambda self, value: tag.put(self, "axis", tag.turned(map(_typed, value), True) if any(value) else None),
        update=redraw, override=_OVERRIDABLE),
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
        name="Faceted", description="Felt as its triangles, though the mesh is shaded smooth", override=_OVERRIDABLE,
        get=lambda self: not tag.get(self, "smooth", True),
        set=lambda self, on: tag.put(self, "smooth", False if on else None)),
}


def register():
    for owner in OWNERS:
        for name, made in PROPERTIES.items():
            setattr(owner, name, made)


def unregister():
    for owner in OWNERS:
        for name in PROPERTIES:
            delattr(owner, name)
