extends SceneTree
## The importer's name hints on tagged meshes: the surface is below the node that remains.

var checks: RefCounted = load("res://checks.gd").new()


func _init() -> void:
	var scene: Node = load("res://hints.gltf").instantiate()
	for row: Array in [
		["Plain", "MeshInstance3D"],
		["Crate", "MeshInstance3D"],
		["Walls", "MeshInstance3D"],
		["Hidden", "CollisionShape3D"],
		["Car", "MeshInstance3D"],
	]:
		var branch: Node = scene.find_child(row[0] + "*", true, false)
		checks.check(branch != null, "%s is there" % row[0])
		var found: Array[Node] = []
		if branch != null:
			found = branch.find_children("*", "KnurlSurface", true, false)
			if branch is MeshInstance3D and found.is_empty():
				found.assign(branch.get_children().filter(func(n: Node) -> bool: return n.is_class("KnurlSurface")))
		checks.equal(found.size(), 1, "surfaces of %s" % row[0])
		if found.size() == 1:
			checks.equal(found[0].get_parent().get_class(), row[1], "parent of %s's" % row[0])
			checks.check(found[0].position == Vector3.ZERO, "%s's lies on it" % row[0])
			checks.equal(Array(found[0].get_warnings()), [], "%s's can be felt" % row[0])
	checks.finish(self)
	scene.free()
