extends SceneTree
## Every preset loads, and a Touch (the simulated one) has nothing to warn of.

const FOLDER := "res://addons/knurl/presets/"

var checks: RefCounted


func _initialize() -> void:
	await process_frame  # the root is in its tree
	checks = load("res://checks.gd").new()
	var names: PackedStringArray = DirAccess.get_files_at(FOLDER)
	checks.equal(names.size(), 7, "presets")
	for name: String in names:
		var grating: Resource = load(FOLDER + name)
		checks.check(
			grating != null and grating.is_class("KnurlGrating"), name + " is a KnurlGrating"
		)
		if grating == null:
			continue
		checks.check(grating.spatial_frequency.x > 0.0, name + " has a period")
		checks.equal(warnings_of(grating), PackedStringArray(), name + "'s warnings")
	# The paper's Experiment 3: 0.5, 1 and 2 mm at 0.7 N/mm.
	for pair: Array in [["paper_0_5mm", 2000.0], ["paper_1mm", 1000.0], ["paper_2mm", 500.0]]:
		var grating: Resource = load(FOLDER + pair[0] + ".tres")
		checks.equal(grating.spatial_frequency, Vector2(pair[1], 0.0), pair[0])
		checks.equal(grating.stiffness, 700.0, pair[0] + "'s stiffness")
	var materials: Array[Dictionary] = load("res://addons/knurl/materials.gd").LIST
	checks.equal(materials.size(), 29, "everyday materials")
	for material: Dictionary in materials:
		var grating: Resource = ClassDB.instantiate(&"KnurlGrating")
		for key: String in ["spatial_frequency", "amplitude", "stiffness", "friction", "orientation"]:
			grating.set(key, material[key])
		checks.equal(warnings_of(grating), PackedStringArray(), material["title"] + "'s warnings")
	var steel: Resource = ClassDB.instantiate(&"KnurlGrating")
	steel.stiffness = 1e5
	checks.check(not warnings_of(steel).is_empty(), "what is too stiff is warned of")
	checks.finish(self)


## The warnings of a surface with this grating while the fake device runs.
func warnings_of(grating: Resource) -> PackedStringArray:
	var plate := MeshInstance3D.new()
	var mesh := PlaneMesh.new()
	mesh.size = Vector2(0.1, 0.1)
	plate.mesh = mesh
	var surface: Node3D = ClassDB.instantiate(&"KnurlSurface")
	surface.set("grating", grating)
	plate.add_child(surface)
	root.add_child(plate)
	var device: Node3D = ClassDB.instantiate(&"KnurlDevice")
	device.set("autostart", false)
	root.add_child(device)
	checks.equal(device.call("start"), OK, "the fake device starts")
	var warnings: PackedStringArray = surface.call("get_warnings")
	device.call("stop")
	device.free()
	plate.free()
	return warnings
