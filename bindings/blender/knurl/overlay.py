"""Ridges drawn in the 3D view, where they are felt. SPDX-License-Identifier: MIT"""
import bpy
import gpu
import numpy as np
from bpy.app.handlers import persistent
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from . import properties, ridges, tag

TRIANGLES_MAX = 300000  # of a mesh: half a second of numpy
COLOURS = ((1.0, 0.55, 0.1, 0.9), (0.25, 0.75, 1.0, 0.9))  # crests across x, across y
WIDTH = 1.5  # pixels
TOWARDS_EYE = 1e-3  # of the distance, so that the surface does not hide its own lines


class Part:
    """The triangles of one material. segments: across x and across y, see ridges.lines()."""

    def __init__(self, material, merged, felt, segments, step):
        self.material, self.tag, self.felt, self.segments, self.step = material, merged, felt, segments, step
        self.batches = None


class Shown:
    """What is felt of an object. too_many: its triangles, if they are more than TRIANGLES_MAX; then it has no parts."""

    def __init__(self, signature, parts, too_many=0):
        self.signature, self.parts, self.too_many = signature, parts, too_many


_kept = {}  # by the object's name
_handle = None


def _read(layer, name, kind, width):
    values = np.empty(len(layer) * width, kind)
    layer.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def arrays_of(mesh):
    """(corners (n, 3, 3), uvs (n, 3, 2) or None, material indices (n)) of a mesh's triangles. The first uv map is the one
    that glTF's TEXCOORD_0 gets."""
    mesh.calc_loop_triangles()
    triangles = mesh.loop_triangles
    corners = _read(mesh.vertices, "co", np.float32, 3).astype(float)[_read(triangles, "vertices", np.int32, 3)]
    uvs = None
    if mesh.uv_layers:
        uvs = _read(mesh.uv_layers[0].data, "uv", np.float32, 2).astype(float)[_read(triangles, "loops", np.int32, 3)]
    return corners, uvs, _read(triangles, "material_index", np.int32, 1)


def parts_of(mesh, materials, tags, linear):
    """One for each material that is tagged; materials, tags: by index, at least one; linear: of the object's matrix."""
    corners, uvs, index = arrays_of(mesh)
    index = np.clip(index, 0, len(tags) - 1)
    for i, merged in enumerate(tags):
        own = index == i
        if any(tag.frequencies(merged)) and own.any():
            felt = ridges.measure(corners[own], None if uvs is None else uvs[own], linear, tag.axis(merged),
                                  merged.get("coordinates") == "box", tag.number(merged, "orientation", 0.0))
            *segments, step = ridges.lines(corners[own], felt, tag.frequencies(merged))
            yield Part(materials[i], merged, felt, segments, step)


def shown_of(shown, depsgraph):
    """Shown of an object, modifiers and all, kept until something changes; None if it is not tagged."""
    materials = [slot.material for slot in shown.material_slots] or [None]
    tags = [tag.merged(material, shown.data, shown) for material in materials]
    if not any(tags):
        return None
    linear = np.array(shown.matrix_world.to_3x3())
    signature = repr((tags, linear.tolist(), shown.data.name_full, [m and m.name_full for m in materials]))
    kept = _kept.get(shown.name_full)
    if kept is None or kept.signature != signature:
        evaluated = shown.evaluated_get(depsgraph)
        mesh = evaluated.to_mesh()
        mesh.calc_loop_triangles()
        count = len(mesh.loop_triangles)
        if count > TRIANGLES_MAX:
            kept = Shown(signature, [], count)
        else:
            kept = Shown(signature, list(parts_of(mesh, materials, tags, linear)))
        evaluated.to_mesh_clear()
        _kept[shown.name_full] = kept
    return kept


def _nearer():
    """The model-view matrix, a little nearer to the eye; the picture stays the same."""
    view = gpu.matrix.get_model_view_matrix()
    if gpu.matrix.get_projection_matrix()[3][3] == 0.0:  # perspective
        return Matrix.Scale(1.0 - TOWARDS_EYE, 4) @ view
    return Matrix.Translation((0.0, 0.0, TOWARDS_EYE * bpy.context.region_data.view_distance)) @ view


def _draw_part(shader, part):
    if part.batches is None:
        part.batches = [batch_for_shader(shader, "LINES", {"pos": lines.reshape(-1, 3).astype(np.float32)}) if len(lines)
                        else None for lines in part.segments]
    for batch, colour in zip(part.batches, COLOURS):
        if batch:
            shader.uniform_float("color", colour)
            batch.draw(shader)


def _draw():
    context = bpy.context
    if not context.window_manager.knurl_show_ridges or not context.space_data.overlay.show_overlays:
        return
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR" if bpy.app.version >= (4, 0) else "3D_POLYLINE_UNIFORM_COLOR")
    depsgraph = context.evaluated_depsgraph_get()
    gpu.state.depth_test_set("LESS_EQUAL")
    gpu.state.blend_set("ALPHA")
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", WIDTH)
    for each in context.view_layer.objects:
        if each.type == "MESH" and each.visible_get() and each.visible_in_viewport_get(context.space_data):
            shown = shown_of(each, depsgraph)
            with gpu.matrix.push_pop():
                gpu.matrix.load_matrix(_nearer())
                gpu.matrix.multiply_matrix(each.matrix_world)
                for part in shown.parts if shown else ():
                    _draw_part(shader, part)
    gpu.state.blend_set("NONE")
    gpu.state.depth_test_set("NONE")


@persistent
def _forget_changed(_scene, depsgraph):
    for update in depsgraph.updates:
        if update.is_updated_geometry and isinstance(update.id, bpy.types.Object):
            _kept.pop(update.id.name_full, None)


@persistent
def _forget(*_):
    _kept.clear()


_HANDLERS = ((bpy.app.handlers.depsgraph_update_post, _forget_changed), (bpy.app.handlers.load_post, _forget),
             (bpy.app.handlers.undo_post, _forget), (bpy.app.handlers.redo_post, _forget))


def register():
    global _handle
    bpy.types.WindowManager.knurl_show_ridges = bpy.props.BoolProperty(
        name="Show Ridges", description="Draws the crests in the 3D view, where they are felt", update=properties.redraw)
    for handlers, function in _HANDLERS:
        handlers.append(function)
    if not bpy.app.background:
        _handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")


def unregister():
    if _handle:
        bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
    for handlers, function in _HANDLERS:
        handlers.remove(function)
    _kept.clear()
    del bpy.types.WindowManager.knurl_show_ridges
