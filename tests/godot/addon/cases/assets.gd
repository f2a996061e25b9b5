extends SceneTree
## The assets: as many surfaces as Knurl's own loader finds, with its materials; loaded at run time
## and by the editor.

var checks: RefCounted


func _initialize() -> void:
	checks = load("res://checks.gd").new()
	var gltf: GDScript = load("res://addons/knurl/import.gd")
	gltf.register()
	var seen := 0
	for name: String in DirAccess.get_files_at("res://"):
		if name.get_extension() == "glb" or name.get_extension() == "gltf":
			seen += 1
			var inspected: Dictionary = JSON.parse_string(
				FileAccess.get_file_as_string("res://%s.json" % name)
			)
			compare(name + " at run time", load_now(name), inspected)
			compare(
				name + " imported", (load("res://" + name) as PackedScene).instantiate(), inspected
			)
	checks.check(seen >= 3, "there are assets")
	gltf.unregister()
	checks.finish(self)


func load_now(name: String) -> Node:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	checks.equal(document.append_from_file("res://" + name, state), OK, name + " is read")
	return document.generate_scene(state)


func compare(what: String, scene: Node, inspected: Dictionary) -> void:
	var surfaces: Array[Node] = scene.find_children("*", "KnurlSurface", true, false)
	checks.equal(surfaces.size(), inspected["surfaces"].size(), what + ": surfaces")
	for i: int in mini(surfaces.size(), inspected["surfaces"].size()):
		var expected: Dictionary = inspected["surfaces"][i]
		var grating: Resource = surfaces[i].get("grating")
		var parent := surfaces[i].get_parent() as MeshInstance3D
		var at: String = "%s: '%s'" % [what, expected["name"]]
		checks.check(parent != null and parent.mesh != null, at + " is below its mesh")
		checks.equal(surfaces[i].owner, scene, at + " is saved with its scene")
		var frequency: Array = expected["material"]["spatial_frequency"]
		checks.equal(grating.spatial_frequency, Vector2(frequency[0], frequency[1]), at)
		checks.equal(surfaces[i].double_sided, expected["double_sided"], at + ", double-sided")
		for key: String in ["amplitude", "stiffness", "damping", "friction", "orientation"]:
			checks.close(grating.get(key), expected["material"][key], 1e-12, "%s: %s" % [at, key])
	scene.free()
