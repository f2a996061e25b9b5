extends Node3D
## Plays with Knurl's classes. Without a library the values are there, and nothing is felt.

@onready var device: KnurlDevice = $Device
@onready var surface: KnurlSurface = $Plate/KnurlSurface


func _ready() -> void:
	var checks: RefCounted = load("res://checks.gd").new()
	var has_library: bool = ClassDB.class_exists(&"KnurlDevice")
	checks.equal(has_library, OS.get_cmdline_user_args().has("felt"), "a library")
	checks.equal(surface.grating.spatial_frequency, Vector2(700, 0), "the scene's grating")
	checks.equal(
		surface.get_meta("note"),
		(
			'Text that looks like a scene:\nscript = "none"\n'
			+ '[node name="N" type="KnurlSurface"]\n[resource]\n\\'
		),
		"a text"
	)
	checks.equal(surface.grating.method, KnurlGrating.METHOD_S2, "an enumeration")
	surface.grating.amplitude = 0.001
	checks.equal(surface.grating.amplitude, 0.001, "a changed grating")
	var other: KnurlSurface = $Plate2/KnurlSurface
	checks.equal(other.grating.spatial_frequency, Vector2(500, 500), "a preset")
	checks.equal(other.grating.resource_path, "res://addons/knurl/presets/grid.tres", "its path")
	checks.equal(scene_file_path, "res://game.tscn", "the scene's path")
	checks.equal(KnurlGrating.new().stiffness, 400.0, "a new grating's default")
	checks.equal(device.device, "mouse", "a property of a device with a script")
	var plate: Node = (load("res://plate_1d.glb") as PackedScene).instantiate()
	add_child(plate)
	var felt: Array = plate.find_children("*", "", true, false).filter(is_surface)
	# imported without a library, a file has no surfaces
	var expected: int = 0 if OS.get_cmdline_user_args().has("unimported") else 3
	checks.equal(felt.size(), expected, "surfaces of an imported file")
	checks.check(
		felt.all(func(s: KnurlSurface) -> bool: return s.grating.stiffness > 0.0), "their gratings"
	)
	KnurlOverlay.set_shown(self, true)
	add_child(KnurlMouse.new())
	await get_tree().create_timer(0.5).timeout
	checks.equal(device.running, has_library, "runs")
	checks.equal(surface.get_triangle_count() > 0, has_library, "triangles")
	if not has_library:
		checks.equal(device.failures.size(), 1, "failed starts")
		checks.equal(device.failures[0][0], ERR_UNAVAILABLE, "why the start failed")
		checks.equal(device.start(), ERR_UNAVAILABLE, "a start by hand")
		checks.equal(device.get_touched_surface(), null, "the touched surface")
		checks.equal(device.cast_ray(Vector3.UP, Vector3.DOWN), {}, "a ray")
	checks.finish(get_tree())


func is_surface(node: Node) -> bool:
	return node is KnurlSurface
