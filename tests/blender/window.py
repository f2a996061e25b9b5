"""Ridges in a Blender's window: drawn in two colours while Show Ridges is on, nothing of them while it is off, and nothing behind
the surface. usage: blender --factory-startup --window-geometry 0 0 640 480 --python window.py -- TOOLS ZIP
Prints "window: ok". SPDX-License-Identifier: MIT"""
import os
import sys
import tempfile
import traceback

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy
import installed
import numpy

COLOURS = {"across x": (1.0, 0.55, 0.1), "across y": (0.25, 0.75, 1.0)}
PATH = os.path.join(tempfile.mkdtemp(), "shot.png")


def seen():
    """How many of the window's pixels have a hue of the lines; some icons are orange, too."""
    bpy.ops.screen.screenshot(filepath=PATH)
    image = bpy.data.images.load(PATH)
    pixels = numpy.array(image.pixels[:]).reshape(-1, 4)[:, :3]
    bpy.data.images.remove(image)
    return {name: int((numpy.abs(pixels - colour).max(axis=1) < 0.2).sum()) for name, colour in COLOURS.items()}


def arrange():
    """A tagged plane fills the 3D view, seen from above."""
    for each in list(bpy.data.objects):
        bpy.data.objects.remove(each)
    bpy.ops.mesh.primitive_plane_add(size=0.1)
    plane = bpy.context.object
    plane.select_set(False)
    plane.knurl_on = True
    plane.knurl_ridges, plane.knurl_ridges_across = 4.0, 10.0
    view = [area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D"][0].spaces.active
    view.clip_start, view.show_gizmo = 0.001, False
    view.region_3d.view_location, view.region_3d.view_distance = (0.0, 0.0, 0.0), 0.15
    view.region_3d.view_rotation = (1.0, 0.0, 0.0, 0.0)
    view.overlay.show_floor = view.overlay.show_axis_x = view.overlay.show_axis_y = False


def show(on):
    bpy.context.window_manager.knurl_show_ridges = on


def hide_behind():
    """A plain plane above the tagged one."""
    bpy.ops.mesh.primitive_plane_add(size=0.2, location=(0.0, 0.0, 0.01))
    bpy.context.object.select_set(False)


def expect(what, least, most):
    found = seen()
    print(f"window: {what}: {found}", flush=True)
    assert all(least <= count <= most for count in found.values()), f"{what}: expected {least} to {most} pixels, found {found}"


STEPS = [arrange, lambda: show(True), lambda: None, lambda: expect("on", 1000, 100000), lambda: show(False), lambda: None,
         lambda: expect("off", 0, 100), lambda: show(True), hide_behind, lambda: None, lambda: expect("behind", 0, 100)]


def next_step():
    try:
        STEPS.pop(0)()
    except Exception:  # pylint: disable=broad-except  # a timer's is only printed, and the window would stay
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)
    if STEPS:
        return 1.0  # until it is drawn
    print("window: ok", flush=True)
    os._exit(0)


installed.install()
bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(next_step, first_interval=1.0)
