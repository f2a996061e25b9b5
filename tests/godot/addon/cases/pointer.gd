extends SceneTree
## The demo with its default device, the mouse: hovering touches nothing, pressing does; each
## surface under the pointer.

const FRAMES := 60  # at most, for the HIP to follow

var checks: RefCounted


func _initialize() -> void:
	checks = load("res://checks.gd").new()
	var main: Node = (load("res://main.tscn") as PackedScene).instantiate()
	root.add_child(main)
	var device: Node = main.get_node("KnurlDevice")
	await until(func() -> bool: return device.get("running"))
	checks.equal(device.get("running"), true, "the mouse is a device that runs")
	for surface: Node in main.find_children("*", "KnurlSurface", true, false):
		var mesh := surface.get_parent() as MeshInstance3D
		var box: AABB = mesh.global_transform * mesh.get_aabb()
		var top := Vector3(box.get_center().x, box.end.y, box.get_center().z)
		var pointer: Vector2 = (main.get_node("Camera") as Camera3D).unproject_position(top)
		point(pointer, false)
		await until(func() -> bool: return not device.get("in_contact") and over(device, box))
		checks.check(
			over(device, box) and not device.get("in_contact"),
			"%s: hovering touches nothing" % mesh.name
		)
		point(pointer, true)
		await until(surface.call.bind("is_touched"))
		checks.equal(surface.call("is_touched"), true, "%s: pressing touches" % mesh.name)
		checks.equal(device.get("in_contact"), true, "%s: and the device knows" % mesh.name)
		await until(func() -> bool: return (device.get("force") as Vector3).y > 0.0)  # by a ramp
		checks.check(
			(device.get("force") as Vector3).y > 0.0,
			"%s: it pushes up (%s N)" % [mesh.name, device.get("force")]
		)
	main.queue_free()
	await process_frame
	checks.finish(self)


func point(at: Vector2, pressed: bool) -> void:
	var motion := InputEventMouseMotion.new()
	motion.position = at
	motion.global_position = at
	Input.parse_input_event(motion)
	var button := InputEventMouseButton.new()
	button.button_index = MOUSE_BUTTON_LEFT
	button.position = at
	button.pressed = pressed
	Input.parse_input_event(button)


func over(device: Node, box: AABB) -> bool:
	var hip: Vector3 = device.get("hip_position")
	return (
		hip.x > box.position.x
		and hip.x < box.end.x
		and hip.z > box.position.z
		and hip.z < box.end.z
	)


func until(holds: Callable) -> void:
	for i: int in FRAMES:
		await process_frame
		if holds.call():
			return
