"""Pictures of the Blender extension: its panel beside the ridges in the 3D view, in a light and a dark theme.
usage: xvfb-run -s '-screen 0 1600x1000x24' blender --factory-startup --window-geometry 0 0 W H --python blender_pictures.py --
    FOLDER THEME NAME     THEME: light or dark; NAME: of one of PICTURES
The extension must be enabled in Blender's user resources (tests/blender/installed.py does it). SPDX-License-Identifier: MIT"""
import os
import re
import sys

import addon_utils
import bpy
import numpy
from mathutils import Euler

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
FOLDER, THEME, NAME = sys.argv[-3:]
THEMES = [path for path in bpy.utils.preset_paths("interface_theme")][0]
HEADER = 28  # pixels of the Properties editor's
SHARE = 0.45  # of the width, for the panel
if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Debian 12's Blender 3.4 needs it to import glTF with its own numpy


def handle():
    """The knurled handle of the demo, near."""
    bpy.ops.import_scene.gltf(filepath=os.path.join(ROOT, "assets/knurled_handle.glb"))
    shown = [each for each in bpy.context.scene.objects if each.type == "MESH"][0]
    bpy.context.view_layer.objects.active = shown
    return shown, 0.1, Euler((1.1, 0.0, 0.75))


def tutorial():
    """The plain handle of docs/tutorial.md, which tutorial.sh leaves in FOLDER, with a material chosen."""
    bpy.ops.import_scene.gltf(filepath=os.path.join(FOLDER, "model.glb"))
    shown = [each for each in bpy.context.scene.objects if each.type == "MESH"][0]
    bpy.context.view_layer.objects.active = shown
    bpy.ops.knurl.preset(name="knurl_straight")
    return shown, 0.1, Euler((1.1, 0.0, 0.75))


PICTURES = {"blender": handle, "tutorial_blender": tutorial}


def area_of(kind):
    return [area for area in bpy.context.window.screen.areas if area.type == kind][0]


def close(kind):
    with bpy.context.temp_override(area=area_of(kind)):
        bpy.ops.screen.area_close()


def arrange(shown, distance, turn):
    view = area_of("VIEW_3D")
    space = view.spaces.active
    space.show_gizmo = space.show_region_toolbar = space.show_region_header = space.show_region_ui = False
    shown.select_set(False)
    for name in ("cursor", "text", "outline_selected", "object_origins", "floor", "axis_x", "axis_y", "relationship_lines"):
        setattr(space.overlay, "show_" + name, False)
    space.clip_start = 0.001
    region = space.region_3d
    region.view_perspective = "PERSP"
    region.view_location, region.view_distance = shown.matrix_world.translation + turn.to_matrix().col[0] * 0.1 * distance, distance
    region.view_rotation = turn.to_quaternion()
    bpy.context.window_manager.knurl_show_ridges = True


def split():
    """The 3D view alone, then the panel beside it."""
    with bpy.context.temp_override(area=area_of("VIEW_3D"), region=area_of("VIEW_3D").regions[-1]):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=SHARE)
    right = max((area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D"), key=lambda area: area.x)
    right.type = "PROPERTIES"


def show_material():
    area_of("PROPERTIES").spaces.active.context = "MATERIAL"


def end():
    """A screenshot without the bars above and below."""
    path = os.path.join(FOLDER, f"{NAME}{'' if THEME == 'light' else '_dark'}.png")
    bpy.ops.screen.screenshot(filepath=path)
    whole = bpy.data.images.load(path)
    areas = bpy.context.window_manager.windows[0].screen.areas
    low, high = min(area.y for area in areas), max(area.y + area.height - HEADER for area in areas)
    pixels = numpy.array(whole.pixels[:]).reshape(whole.size[1], whole.size[0], 4)[low:high]
    cut = bpy.data.images.new("cut", whole.size[0], high - low)
    cut.pixels.foreach_set(pixels.astype(numpy.float32).ravel())
    cut.file_format, cut.filepath_raw = "PNG", path
    cut.save()
    bpy.ops.wm.quit_blender()


def begin():
    bpy.context.preferences.view.show_splash = False
    if THEME == "light":
        bpy.ops.script.execute_preset(filepath=os.path.join(THEMES, "Blender_Light.xml"),
                                      menu_idname="USERPREF_MT_interface_theme_presets")
    for each in list(bpy.data.objects):
        bpy.data.objects.remove(each)
    for name in [name for name in dir(bpy.types) if re.match(r"(EEVEE_|CYCLES_)?MATERIAL_PT_|[A-Z]+_PT_.*material.*", name)]:
        kind = getattr(bpy.types, name)
        if not name.startswith("KNURL") and kind.is_registered:
            bpy.utils.unregister_class(kind)
    arrange(*PICTURES[NAME]())
    steps = [lambda: close("DOPESHEET_EDITOR"), lambda: close("OUTLINER"), lambda: close("PROPERTIES"), split, show_material, lambda: None, end]
    bpy.app.timers.register(lambda: steps.pop(0)() or 3.0, first_interval=3.0)  # each after a redraw


addon_utils.enable("io_scene_gltf2")
addon_utils.enable("knurl")
begin()
