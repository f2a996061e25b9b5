@tool
class_name KnurlOverlay
extends Node
## Draws the ridges of a [KnurlSurface] over its mesh, as they will be felt: period, orientation,
## grid. On a [MeshInstance3D], [MultiMeshInstance3D], [CSGShape3D] and [GridMap], on uvs or an axis; it
## does not draw box coordinates, whose phase the haptic scene finds.
##
## [codeblock]
## KnurlOverlay.set_shown(get_tree().root, true) # on all surfaces below; false removes it
## [/codeblock]
## It is an internal child of its surface: not saved, and freed with it. It draws through the
## rendering server, so the mesh's own materials and [member GeometryInstance3D.material_overlay]
## stay as they are.

const SHADER := preload("overlay.gdshader")
const Cells := preload("overlay_cells.gd")
const NAME := &"KnurlOverlay"

var _material := ShaderMaterial.new()
var _drawn_on := RID()
var _cells := Cells.new()
var _uv_scale := Vector2.ZERO  # m for each unit of u and v; of this mesh, at this size:
var _mesh: Mesh
var _size := Basis()
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


func _init() -> void:
	_material.shader = SHADER


func _enter_tree() -> void:
	_shown = []
	_process(0.0)


func _exit_tree() -> void:
	_draw_on(null)
	_cells.follow(null)


## Polls each frame instead of using signals, because a surface's mesh, scale and grating may all
## change.
func _process(_delta: float) -> void:
	var surface := get_parent() as KnurlSurface
	var node := surface.get_parent() as Node3D
	var is_drawn: bool = (
		surface.grating != null
		and surface.enabled
		and not surface.box_coordinates
		and _measure(surface, node)
	)
	var by_axis: bool = not surface.axis.is_zero_approx()
	if not is_drawn or not (by_axis or _uv_scale != Vector2.ZERO):
		_draw_on(null)
		_cells.hide()
		return
	_draw_on(node as GeometryInstance3D)
	if node is GridMap:
		_cells.draw(_material.get_rid())
	var grating: KnurlGrating = surface.grating
	var overlay: Material = node.material_overlay if node is GeometryInstance3D else null
	var values: Array = [
		grating.spatial_frequency, grating.orientation, surface.axis, surface.double_sided, overlay
	]
	if values == _shown:
		return
	_shown = values
	_material.set_shader_parameter(&"spatial_frequency", grating.spatial_frequency)
	_material.set_shader_parameter(&"orientation", grating.orientation)
	_material.set_shader_parameter(&"axis", surface.axis)
	_material.set_shader_parameter(&"by_axis", by_axis)
	_material.set_shader_parameter(&"double_sided", surface.double_sided)
	_material.next_pass = overlay  # the mesh's own overlay is drawn after it
	if _drawn_on.is_valid():
		RenderingServer.instance_geometry_set_material_overlay(_drawn_on, _material.get_rid())


## Asks for the scale of the uvs again if a node's meshes or its size are others. Returns false if it
## has no mesh to draw on.
func _measure(surface: KnurlSurface, node: Node3D) -> bool:
	var is_other: bool = _cells.follow(node as GridMap)
	var mesh: Mesh = _mesh_of(node as GeometryInstance3D)
	var size: Basis = node.global_basis.transposed() * node.global_basis  # without its rotation
	if (mesh == null and _cells.pairs.is_empty()) or size.determinant() == 0.0:
		return false
	if is_other or mesh != _mesh or not (size * _size.inverse()).is_equal_approx(Basis()):
		_mesh = mesh
		_size = size
		_uv_scale = surface.get_uv_scale()
		_material.set_shader_parameter(&"uv_scale", _uv_scale)
		_material.set_shader_parameter(&"volume", absf(node.global_basis.determinant()))
	return true


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
