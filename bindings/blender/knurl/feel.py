"""Feel: exports to a temporary file and opens Knurl's own view. SPDX-License-Identifier: MIT"""
import atexit
import os
import re
import shutil
import subprocess
import tempfile
import time

import bpy

ADDRESS_WAIT = 10.0  # s until the tool has printed the page's address
NO_TOOL = "expected the program 'knurl' on the path, or its path in KNURL_TOOL"
_running = []  # [process, folder, time until which its address is looked for; 0: found]


def tool():
    """The path of Knurl's tool, or None."""
    return shutil.which(os.environ.get("KNURL_TOOL") or "knurl")


def material_of(context):
    """The panel's material or, in a pinned panel without one, the active object's."""
    return getattr(context, "material", None) or (context.object and context.object.active_material)


def _address(folder):
    with open(os.path.join(folder, "scene.glb.log"), encoding="utf-8", errors="replace") as log:
        found = re.search(r"http://\S+", log.read())
    return found and found[0]


def _open(address):
    bpy.ops.wm.url_open(url=address)


def _look():
    """Opens the pages whose addresses are known by now, and removes the folders of views that have ended."""
    for each in list(_running):
        process, folder, until = each
        if until and _address(folder):
            _open(_address(folder))
            each[2] = 0.0
        elif until and time.monotonic() > until:
            each[2] = 0.0
        if process.poll() is not None:
            _running.remove(each)
            shutil.rmtree(folder, ignore_errors=True)
    if not _running:
        return None
    return 0.2 if any(until for _, _, until in _running) else 2.0


def _tidy():
    """Removes all folders: the tool has read its file, and a view that is still open goes on."""
    while _running:
        shutil.rmtree(_running.pop()[1], ignore_errors=True)


class KNURL_OT_feel(bpy.types.Operator):
    """Exports the scene to a temporary file and opens it in Knurl's own view"""
    bl_idname = "knurl.feel"
    bl_label = "Feel"

    def execute(self, _context):
        program = tool()
        if not program:
            self.report({"ERROR"}, f"Knurl: {NO_TOOL}")
            return {"CANCELLED"}
        folder = tempfile.mkdtemp(prefix="knurl-")
        path = os.path.join(folder, "scene.glb")
        try:
            bpy.ops.export_scene.gltf(filepath=path, export_apply=True)  # with modifiers, as the ridges are drawn
            with open(path + ".log", "wb") as log:
                process = subprocess.Popen([program, "run", path, "--view"], stdout=log, stderr=log)  # ends with its page
        except (AttributeError, OSError, RuntimeError) as error:  # the first: the glTF add-on is disabled
            shutil.rmtree(folder, ignore_errors=True)
            self.report({"ERROR"}, f"Knurl: {error}")
            return {"CANCELLED"}
        _running.append([process, folder, time.monotonic() + ADDRESS_WAIT])
        if not bpy.app.timers.is_registered(_look):
            bpy.app.timers.register(_look, first_interval=0.2)
        return {"FINISHED"}


def register():
    bpy.utils.register_class(KNURL_OT_feel)
    atexit.register(_tidy)


def unregister():
    if bpy.app.timers.is_registered(_look):
        bpy.app.timers.unregister(_look)
    _tidy()
    atexit.unregister(_tidy)
    bpy.utils.unregister_class(KNURL_OT_feel)
