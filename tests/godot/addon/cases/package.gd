extends SceneTree
## The unpacked package works: classes exist, a preset loads, and the fake device plays a trace on a
## plate.

const K := 700.0  # N/m, of the preset
const DEPTH := 0.001  # m


func _initialize() -> void:
	run()  # in a function of its own: a mistake in it ends it, and the frames below end the game


func _process(_delta: float) -> bool:
	return Engine.get_process_frames() > 300


func run() -> void:
	var checks: RefCounted = load("res://checks.gd").new()
	for name: StringName in [&"KnurlGrating", &"KnurlSurface", &"KnurlDevice"]:
		checks.check(ClassDB.class_exists(name), "class " + name)
	var plate := MeshInstance3D.new()
	var mesh := PlaneMesh.new()
	mesh.size = Vector2(0.1, 0.1)
	plate.mesh = mesh
	var surface: Node3D = ClassDB.instantiate(&"KnurlSurface")
	surface.set("grating", load("res://addons/knurl/presets/paper_1mm.tres").duplicate())
	surface.get("grating").set("amplitude", 0.0)  # smooth: expects Hooke's law
	plate.add_child(surface)
	root.add_child(plate)
	var device: Node3D = ClassDB.instantiate(&"KnurlDevice")
	device.set("autostart", false)
	device.set("device", "fake")
	root.add_child(device)
	await process_frame
	# Still, 1 mm inside, for a second.
	var rows: PackedFloat64Array = [0.0, 0.0, -DEPTH, 0.0, 1.0, 0.0, -DEPTH, 0.0]
	var forces: PackedFloat64Array = device.call("play_trace", rows, 500)
	checks.equal(forces.size(), 1500, "three numbers a tick")
	if forces.size() == 1500:
		checks.close(forces[1498], K * DEPTH, 0.02 * K * DEPTH, "the force of Hooke's law, N")
		checks.close(forces[1497], 0.0, 1e-6, "none along the plate")
	root.remove_child(device)
	device.free()
	plate.free()
	checks.finish(self)
