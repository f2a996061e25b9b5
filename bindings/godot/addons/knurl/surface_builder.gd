@tool
extends RefCounted
## Builds the surfaces of one file for [KnurlGltf]: reads its tags, merges material < mesh < node
## key by key, and puts a [KnurlSurface] below each node that shows a tagged primitive. A wrong tag
## gives an error message, and only the surfaces that use it are left out.

const Tags := preload("tags.gd")
const TRIANGLES := 4  # glTF's mode; 5 and 6 are strips and fans

var _json: Dictionary
var _state: GLTFState
var _root: Node
var _tags := Tags.new()
var _of_materials: Array[Tags.Tag] = []
var _of_meshes: Array[Tags.Tag] = []
var _of_nodes: Array[Tags.Tag] = []
var _gratings: Dictionary = {}  # values -> KnurlGrating: equal gratings are shared
var _parts: Dictionary = {}  # [ImporterMesh, primitives] -> ImporterMesh with only those


func _init(state: GLTFState, root: Node) -> void:
	_state = state
	_root = root
	_json = state.json


func errors() -> PackedStringArray:
	return _tags.errors


func build() -> void:
	_of_materials = _read_all("materials", "material")
	_of_meshes = _read_all("meshes", "mesh")
	_of_nodes = _read_all("nodes", "node")
	_refuse_lost_tags()
	var nodes: Array = _array(_json, "nodes")
	for index: int in nodes.size():
		if nodes[index].has("mesh"):
			_show(index, int(nodes[index]["mesh"]))


func _read_all(key: String, kind: String) -> Array[Tags.Tag]:
	var tags: Array[Tags.Tag] = []
	for object: Dictionary in _array(_json, key):
		tags.append(_tags.read(object, _label(kind, object, tags.size())))
	return tags


func _refuse_lost_tags() -> void:
	_tags.refuse(_json, "", "tag a material, mesh or node")
	var scenes: Array = _array(_json, "scenes")
	for index: int in scenes.size():
		_tags.refuse(
			scenes[index], _label("scene", scenes[index], index), "tag a material, mesh or node"
		)
	var meshes: Array = _array(_json, "meshes")
	for index: int in meshes.size():
		var primitives: Array = _array(meshes[index], "primitives")
		for i: int in primitives.size():
			_tags.refuse(
				primitives[i],
				_label("mesh", meshes[index], index),
				"tag the mesh, its node or a material",
				"primitives[%d].extras" % i
			)
	var nodes: Array = _array(_json, "nodes")
	for index: int in nodes.size():
		if not nodes[index].has("mesh"):
			_tags.refuse(
				nodes[index],
				_label("node", nodes[index], index),
				"the node shows no mesh; tag nodes below it that do, their meshes or materials"
			)


## One node of the file with its mesh. A node with several primitives keeps those without a surface
## (or the first one), and gets a child mesh instance for each other: a KnurlSurface is felt over
## all of its parent's mesh.
func _show(node_index: int, mesh_index: int) -> void:
	var instance := _state.get_scene_node(node_index) as ImporterMeshInstance3D
	var primitives: Array = _array(_array(_json, "meshes")[mesh_index], "primitives")
	var tagged: Dictionary = {}  # primitive -> Tag
	for primitive: int in primitives.size():
		var tag: Tags.Tag = _tag_of(node_index, mesh_index, primitive, primitives[primitive])
		if tag != null and instance != null:
			tagged[primitive] = tag
	if tagged.is_empty():
		return
	if instance.mesh == null or instance.mesh.get_surface_count() != primitives.size():
		(
			_tags
			. errors
			. append(
				(
					"%s: expected a mesh of %d primitives from the engine, found another: it is not felt"
					% [_place(node_index, mesh_index), primitives.size()]
				)
			)
		)
		return
	var kept: Array = range(primitives.size()).filter(
		func(i: int) -> bool: return not tagged.has(i)
	)
	var whole: ImporterMesh = instance.mesh
	if kept.is_empty():
		kept = [tagged.keys()[0]]
	for primitive: int in tagged:
		var parent: ImporterMeshInstance3D = instance
		if kept != [primitive]:
			parent = _add_part(instance, whole, primitive, _material_name(primitives[primitive]))
		_add_surface(parent, tagged[primitive], _is_double_sided(primitives[primitive]))
	if kept.size() < primitives.size():
		instance.mesh = _part_of(whole, kept)


## The merged tag of a node's primitive; null if there is no tag, or it cannot be felt.
func _tag_of(
	node_index: int, mesh_index: int, primitive_index: int, primitive: Dictionary
) -> Tags.Tag:
	var merged: Tags.Tag = null
	var material: Tags.Tag = (
		_of_materials[int(primitive["material"])] if primitive.has("material") else null
	)
	for tag: Tags.Tag in [material, _of_meshes[mesh_index], _of_nodes[node_index]]:
		if tag != null:
			merged = merged if merged != null else Tags.Tag.new()
			merged.override_with(tag)
	if merged == null or merged.broken:
		return null
	var why: String = _why_not(merged, node_index, mesh_index, primitive)
	if why.is_empty():
		return merged
	_tags.errors.append(
		"%s, primitive %d: %s" % [_place(node_index, mesh_index), primitive_index, why]
	)
	return null


func _why_not(tag: Tags.Tag, node_index: int, mesh_index: int, primitive: Dictionary) -> String:
	var missing: String = tag.missing_key()
	if not missing.is_empty():
		var material: String = ""
		if primitive.has("material"):
			material = (
				_label("material", _material_of(primitive), int(primitive["material"])) + ", "
			)
		return (
			"knurl.%s: missing: expected in extras of %s%s or %s"
			% [
				missing,
				material,
				_label("mesh", _array(_json, "meshes")[mesh_index], mesh_index),
				_label("node", _array(_json, "nodes")[node_index], node_index),
			]
		)
	if _array(_json, "nodes")[node_index].has("skin"):
		return "skin: a tagged mesh cannot be skinned"
	if not _array(primitive, "targets").is_empty():
		return "targets: a tagged mesh cannot have morph targets"
	if int(primitive.get("mode", TRIANGLES)) < TRIANGLES:
		return "mode: expected triangles in a tagged primitive"
	return ""


func _add_surface(parent: Node3D, tag: Tags.Tag, double_sided: bool) -> void:
	var surface := KnurlSurface.new()
	surface.name = "KnurlSurface"
	surface.grating = _grating_of(tag)
	surface.double_sided = double_sided
	surface.axis = tag.values.get("axis", Vector3.ZERO)
	if tag.values.has("smooth"):
		surface.smooth = (
			KnurlSurface.SMOOTH_ON if tag.values["smooth"] else KnurlSurface.SMOOTH_OFF
		)
	surface.box_coordinates = tag.values.get("coordinates", "auto") == "box"
	_add_child(parent, surface)


func _grating_of(tag: Tags.Tag) -> KnurlGrating:
	var values: Dictionary = tag.values.duplicate()
	for key: String in ["axis", "coordinates", "smooth"]:  # set on the surface
		values.erase(key)
	if not _gratings.has(values):
		var grating := KnurlGrating.new()
		for key: String in values:
			grating.set(key, values[key])
		_gratings[values] = grating
	return _gratings[values]


func _add_part(
	instance: ImporterMeshInstance3D, whole: ImporterMesh, primitive: int, part: String
) -> ImporterMeshInstance3D:
	var child := ImporterMeshInstance3D.new()
	child.name = part if not part.is_empty() else "primitive %d" % primitive
	child.mesh = _part_of(whole, [primitive])
	child.layer_mask = instance.layer_mask
	child.cast_shadow = instance.cast_shadow
	_add_child(instance, child)
	return child


func _part_of(whole: ImporterMesh, primitives: Array) -> ImporterMesh:
	var key: Array = [whole, primitives]
	if _parts.has(key):
		return _parts[key]
	var part := ImporterMesh.new()
	part.resource_name = whole.resource_name
	for i: int in primitives:
		part.add_surface(
			whole.get_surface_primitive_type(i),
			whole.get_surface_arrays(i),
			[],
			{},
			whole.get_surface_material(i),
			whole.get_surface_name(i),
			whole.get_surface_format(i)
		)
	_parts[key] = part
	return part


func _add_child(parent: Node, child: Node) -> void:
	parent.add_child(child, true)
	child.owner = _root  # otherwise it is not saved with the imported scene


func _material_of(primitive: Dictionary) -> Dictionary:
	return (
		_array(_json, "materials")[int(primitive["material"])] if primitive.has("material") else {}
	)


func _material_name(primitive: Dictionary) -> String:
	return _material_of(primitive).get("name", "")


func _is_double_sided(primitive: Dictionary) -> bool:
	return _material_of(primitive).get("doubleSided", false)


func _place(node_index: int, mesh_index: int) -> String:
	return (
		"%s, %s"
		% [
			_label("node", _array(_json, "nodes")[node_index], node_index),
			_label("mesh", _array(_json, "meshes")[mesh_index], mesh_index),
		]
	)


static func _array(object: Dictionary, key: String) -> Array:
	return object.get(key, [])


static func _label(kind: String, object: Dictionary, index: int) -> String:
	var name: String = object.get("name", "")
	return "%s %d" % [kind, index] if name.is_empty() else "%s '%s' (%d)" % [kind, name, index]
