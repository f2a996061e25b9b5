@tool
extends EditorScenePostImportPlugin
## Names with a hint ([code]-rigid[/code], [code]-colonly[/code], ...) make the importer replace a
## tagged mesh by another node. This puts the mesh's [KnurlSurface] below the replacement, or
## reports that there is no replacement.

## An option of each scene's import. A file whose .import lacks it was imported while the plugin was
## off.
const OPTION := "knurl/surfaces"
const ADVICE := (
	"its name's import hint leaves no triangles to feel: "
	+ "give the mesh another name, or tag one beside it"
)


func _get_import_options(_path: String) -> void:
	add_import_option(OPTION, true)


func _post_process(scene: Node) -> void:
	if get_option_value(OPTION) == false:
		for surface: Node in scene.find_children("*", "KnurlSurface", true, true):
			surface.free()
		return
	for surface: Node in scene.find_children("*", "KnurlSurface", true, true):
		var parent: Node = surface.get_parent()
		if _can_be_felt(parent):
			continue
		var left: Node = _find_left(parent)
		surface.owner = null
		parent.remove_child(surface)
		if left == null:
			push_warning("Knurl: %s: %s: %s" % [scene.name, parent.name, ADVICE])
			surface.free()
			continue
		left.add_child(surface, true)
		surface.owner = scene
		if (
			left is CollisionShape3D
			and surface.axis == Vector3.ZERO
			and not surface.box_coordinates
		):
			push_warning(
				(
					"Knurl: %s: %s: a collision shape has no UVs: add an axis or box coordinates to the tag"
					% [scene.name, parent.name]
				)
			)


static func _can_be_felt(node: Node) -> bool:
	return (
		node is MeshInstance3D
		or node is CollisionShape3D and node.shape is ConcavePolygonShape3D
	)


## The mesh, or its triangles, below the node that replaced it.
static func _find_left(node: Node) -> Node:
	for type: String in ["MeshInstance3D", "CollisionShape3D"]:
		for child: Node in node.get_children():
			if child.is_class(type) and _can_be_felt(child):
				return child
	return null
