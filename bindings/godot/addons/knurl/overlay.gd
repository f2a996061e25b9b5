@tool
class_name KnurlOverlay
extends Node
## Draws the ridges of a [KnurlSurface] over its mesh, as they will be felt: period, orientation,
## grid. On a [MeshInstance3D], [MultiMeshInstance3D] and [CSGShape3D], on uvs or an axis; it does not
## draw box coordinates, whose phase the haptic scene finds, and not on a [GridMap].
##
## [codeblock]
## KnurlOverlay.set_shown(get_tree().root, true) # on all surfaces below; false removes it
## [/codeblock]
## It is an internal child of its surface: not saved, and freed with it. It draws through the
## rendering server, so the mesh's own materials and [member GeometryInstance3D.material_overlay]
## stay as they are.

const SHADER := preload("overlay.gdshader")
const NAME := &"KnurlOverlay"
## Meshes with more triangles are sampled, because the uv scale is only a mean: the editor stays
## responsive.
const MEASURED_TRIANGLES := 50000

var _material := ShaderMaterial.new()
var _drawn_on := RID()
var _measured: Array = []  # the mesh and the basis that uv_scale was measured on
var _shown: Array = []  # the material's current parameters


## Puts an overlay on every surface at and below [param root], or removes them.
static func set_shown(root: Node, shown: bool) -> void:
	if root is KnurlSurface:
		var overlay: Node = find_on(root)
		if shown and overlay == null:
			overlay = new()  # not by name: a project never opened in the editor has no list of global classes
			overlay.name = NAME
			root.add_child(overlay, false, Node.INTERNAL_MODE_BACK)
		elif not shown and overlay != null:
			root.remove_child(overlay)
			overlay.queue_free()
	for child: Node in root.get_children():
		set_shown(child, shown)


## The overlay of a surface, or null.
static func find_on(surface: KnurlSurface) -> Node:
	return surface.get_node_or_null(NodePath(NAME))


## Metres per u and v: the area-weighted means of |dP/du| and |dP/dv| over all triangles, as in
## Knurl.
## [param basis]: the mesh's scale. Zero if there are no uvs.
static func measure_uvs(mesh: Mesh, basis: Basis) -> Vector2:
	var sum := Vector2.ZERO
	var area := 0.0
	for i: int in mesh.get_surface_count():
		var arrays: Array = mesh.surface_get_arrays(i)
		if arrays[Mesh.ARRAY_TEX_UV] == null:
			continue
		var places: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
		var uvs: PackedVector2Array = arrays[Mesh.ARRAY_TEX_UV]
		var corners: PackedInt32Array = (
			arrays[Mesh.ARRAY_INDEX] if arrays[Mesh.ARRAY_INDEX] else range(places.size())
		)
		@warning_ignore("integer_division")
		var stride: int = 3 * (1 + corners.size() / 3 / MEASURED_TRIANGLES)
		for at: int in range(0, corners.size() - 2, stride):
			var a: int = corners[at]
			var edge1: Vector3 = basis * (places[corners[at + 1]] - places[a])
			var edge2: Vector3 = basis * (places[corners[at + 2]] - places[a])
			var uv1: Vector2 = uvs[corners[at + 1]] - uvs[a]
			var uv2: Vector2 = uvs[corners[at + 2]] - uvs[a]
			var det: float = uv1.cross(uv2)
			if absf(det) > 1e-9 * pow(absf(uv1.x) + absf(uv1.y) + absf(uv2.x) + absf(uv2.y), 2.0):
				var size: float = edge1.cross(edge2).length() * stride
				sum.x += size * ((uv2.y * edge1 - uv1.y * edge2) / det).length()
				sum.y += size * ((uv1.x * edge2 - uv2.x * edge1) / det).length()
				area += size
	return sum / area if area > 0.0 else Vector2.ZERO


func _init() -> void:
	_material.shader = SHADER


func _enter_tree() -> void:
	_shown = []
	_process(0.0)


func _exit_tree() -> void:
	_draw_on(null)


## Polls each frame instead of using signals, because a surface's mesh, scale and grating may all
## change.
func _process(_delta: float) -> void:
	var surface := get_parent() as KnurlSurface
	var parent := surface.get_parent() as GeometryInstance3D
	var mesh: Mesh = _mesh_of(parent)
	if mesh == null or surface.grating == null or not surface.enabled or surface.box_coordinates:
		_draw_on(null)
		return
	var basis: Basis = parent.global_basis
	if _measured != [mesh, basis]:
		_measured = [mesh, basis]
		_material.set_shader_parameter(&"uv_scale", measure_uvs(mesh, basis))
		_material.set_shader_parameter(&"volume", absf(basis.determinant()))
	var by_axis: bool = not surface.axis.is_zero_approx()
	var has_coordinates: bool = (
		by_axis or _material.get_shader_parameter(&"uv_scale") != Vector2.ZERO
	)
	_draw_on(parent if has_coordinates else null)
	var grating: KnurlGrating = surface.grating
	var values: Array = [
		grating.spatial_frequency,
		grating.orientation,
		surface.axis,
		surface.double_sided,
		parent.material_overlay,
	]
	if values == _shown:
		return
	_shown = values
	_material.set_shader_parameter(&"spatial_frequency", grating.spatial_frequency)
	_material.set_shader_parameter(&"orientation", grating.orientation)
	_material.set_shader_parameter(&"axis", surface.axis)
	_material.set_shader_parameter(&"by_axis", by_axis)
	_material.set_shader_parameter(&"double_sided", surface.double_sided)
	_material.next_pass = parent.material_overlay  # the mesh's own overlay is drawn after it
	if _drawn_on.is_valid():
		RenderingServer.instance_geometry_set_material_overlay(_drawn_on, _material.get_rid())


## A node's drawn mesh, or null.
func _mesh_of(node: GeometryInstance3D) -> Mesh:
	if node is MeshInstance3D:
		return (node as MeshInstance3D).mesh
	if node is MultiMeshInstance3D:
		var many: MultiMesh = (node as MultiMeshInstance3D).multimesh
		return many.mesh if many != null else null
	if node is CSGShape3D:
		var pair: Array = (node as CSGShape3D).get_meshes()  # a Transform3D, the mesh
		return pair[1] if pair.size() == 2 else null
	return null


func _draw_on(parent: GeometryInstance3D) -> void:
	var instance: RID = parent.get_instance() if parent != null else RID()
	if instance == _drawn_on:
		return
	if _drawn_on.is_valid() and _owner_of_drawn() != null:
		var own: Material = _owner_of_drawn().material_overlay
		RenderingServer.instance_geometry_set_material_overlay(
			_drawn_on, own.get_rid() if own != null else RID()
		)
	_drawn_on = instance
	if instance.is_valid():
		RenderingServer.instance_geometry_set_material_overlay(instance, _material.get_rid())


func _owner_of_drawn() -> GeometryInstance3D:
	var parent := get_parent().get_parent() as GeometryInstance3D
	return parent if parent != null and parent.get_instance() == _drawn_on else null
