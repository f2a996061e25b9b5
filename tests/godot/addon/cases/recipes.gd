extends SceneTree
## Every recipe of the sample runs for a moment, and its text says what happens there.
## With an argument DIR, after "--", each is drawn and its picture saved there, and a film of the tutorial.

const SECONDS := 5.0  # at most, until a text is right
const STROKE := 2.5  # s: more than the simulated hand takes from end to end and back

var checks: RefCounted
var stage: Node
var device: Node3D


func _initialize() -> void:
	checks = load("res://checks.gd").new()
	play()


func play() -> void:
	await tutorial()
	await show_recipe("meter")
	await says("^[0-9.]+ of [0-9.]+ N, [1-9][0-9]* mm/s, [1-9][0-9]* ridges", "the meters move")
	await end("meter")

	await show_recipe("pick_up")
	await until(func() -> bool: return device.get_touched_surface() != null)
	var before: Vector3 = stage.get_node("Plate").position
	press("ui_accept", true)
	await says("^Holds Plate", "what is touched is picked up")
	await create_timer(0.3).timeout
	checks.check(stage.get_node("Plate").position != before, "and carried")
	await picture("pick_up")
	press("ui_accept", false)
	await says("^Holds nothing", "and let go")
	await end("")

	await show_recipe("pause")
	await says("^Plays. In contact, [0-9.]*[1-9]", "a force before the pause")
	press("ui_cancel", true)
	await says("^Paused. No contact, 0.00 N", "none in a pause")
	await picture("pause")
	press("ui_cancel", false)
	press("ui_cancel", true)
	await says("^Plays. In contact, [0-9.]*[1-9]", "and again after it")
	await end("")

	await show_recipe("hot_plug")
	await says("^Plays with mouse[\\s\\S]*Novint Falcon", "reasons why there is no device")
	checks.equal(device.device, "mouse", "the device without one")
	await end("hot_plug")

	await show_recipe("calibrate")
	var bench := Node3D.new()  # the device may stand in another node, turned about
	bench.position = Vector3(0.3, 0, 0)
	bench.rotation.y = PI
	root.add_child(bench)
	device.reparent(bench)
	await says("button: [1-9][0-9] mm", "the reach is measured")
	await create_timer(STROKE).timeout
	checks.equal(device.force, Vector3.ZERO, "nothing is felt meanwhile")
	press("ui_accept", true)
	await says("^Reach [1-9][0-9]* mm, scale", "and used")
	press("ui_accept", false)
	var left := INF
	var right := -INF
	var end_at: int = Time.get_ticks_msec() + int(1000.0 * STROKE)
	while Time.get_ticks_msec() < end_at:
		await process_frame
		left = minf(left, device.hip_position.x)
		right = maxf(right, device.hip_position.x)
	checks.close(right - left, 0.08, 0.01, "the hand reaches most of the plate, m")
	checks.close(0.5 * (left + right), 0.0, 0.004, "about its middle, m")
	device.reparent(stage)
	bench.free()
	await end("calibrate")

	await show_recipe("ray")
	var motion := InputEventMouseMotion.new()
	motion.position = (
		root.get_final_transform()
		* (stage.get_node("Camera") as Camera3D).unproject_position(Vector3.ZERO)
	)
	Input.parse_input_event(motion)
	await says("^Plate: ridges of 2.0 mm, 700 N/m, at .-?0, -?0. mm", "the ray finds the plate")
	await end("ray")

	await show_recipe("own_device")
	press("ui_right", true)
	await says("^Stick or arrow keys: at .[1-9].* [1-9][0-9]* ridges", "the keys stroke it")
	await end("own_device")
	press("ui_right", false)

	await show_recipe("trigger")
	await by_hand()
	device.move_hip(Vector3(0, 0, 0.003))
	await says("^0 shots. Pull towards you: 3.0 mm", "the trigger is pulled")
	checks.close(device.force.z, -0.9, 0.1, "its spring, N")
	device.move_hip(Vector3(0, 0, 0.007))
	await says("^1 shots", "it breaks")
	device.move_hip(Vector3.ZERO)
	await says("^1 shots.*: 0.0 mm", "it is let go")
	device.move_hip(Vector3(0, 0, 0.007))
	await says("^2 shots", "and breaks again")
	await end("trigger")

	await show_recipe("slider")
	await by_hand()
	device.move_hip(Vector3(0.0325, 0, 0))
	await says("^Setting 3, 0.[23]", "a quarter of a notch off, it pulls back")
	await end("slider")

	await show_recipe("vr_hand")
	var hand: Node3D = stage.get_node("Controller")
	create_tween().tween_property(hand, "position:x", 0.04, 2.0)
	await says("^[1-9][0-9]* Hz at [1-9][0-9]* %", "the motor plays the ridges")
	await end("vr_hand")
	checks.finish(self)


## Its steps, with a film of them.
func tutorial() -> void:
	stage = (load("res://recipes/tutorial.tscn") as PackedScene).instantiate()
	root.add_child(stage)
	device = stage.get_node("KnurlDevice")
	film()
	await says("^1 of 5", "a mesh")
	checks.equal(stage.find_children("*", "KnurlSurface", true, false).size(), 0, "surfaces in the first step")
	await next("^2 of 5", "a surface")
	checks.check(not device.running, "and no device yet")
	await next("^3 of 5", "a device")
	await until(func() -> bool: return device.in_contact)
	checks.check(device.in_contact, "whose hand touches the surface")
	await next("^4 of 5", "a grid")
	checks.equal(device.get_touched_surface().grating.spatial_frequency, Vector2(250, 250), "the grating")
	await next("^5 of 5.* ([2-9]|[1-9][0-9]+) ridges", "a signal")
	stage.ridges = 0
	stage.count(device, 1)
	await says(" 1 ridge[.]", "a ridge alone")
	await dwell()
	await end("")


func next(pattern: String, sentence: String) -> void:
	await dwell()
	press("ui_accept", true)
	press("ui_accept", false)
	await says(pattern, sentence)


## For a reader of the film.
func dwell() -> void:
	if not OS.get_cmdline_user_args().is_empty():
		await create_timer(2.5).timeout


func film() -> void:
	var count := 0
	var filmed: Node = stage
	while not OS.get_cmdline_user_args().is_empty() and is_instance_valid(filmed):
		await picture("tutorial_%03d" % count)
		count += 1


## The test moves the HIP.
func by_hand() -> void:
	device.stop()
	device.device = "mouse"
	device.start()
	device.move_hip(Vector3.ZERO)
	await create_timer(0.3).timeout


func show_recipe(name: String) -> void:
	stage = (load("res://recipes/%s.tscn" % name) as PackedScene).instantiate()
	root.add_child(stage)
	device = stage.get_node("KnurlDevice")
	await until(func() -> bool: return device.running)
	checks.check(device.running, name + ": its device runs")


func end(shot: String) -> void:
	if not shot.is_empty():
		await picture(shot)
	paused = false
	stage.queue_free()
	await process_frame


func says(pattern: String, sentence: String) -> void:
	var expected := RegEx.create_from_string(pattern)
	var label := stage.get_node("Hud/Text") as Label
	await until(func() -> bool: return expected.search(label.text) != null)
	checks.check(expected.search(label.text) != null, "%s: found '%s'" % [sentence, label.text])


func press(action: String, pressed: bool) -> void:
	var key := InputEventKey.new()
	key.keycode = {
		"ui_accept": KEY_SPACE, "ui_cancel": KEY_ESCAPE, "ui_right": KEY_RIGHT
	}[action]
	key.pressed = pressed
	Input.parse_input_event(key)


func until(holds: Callable) -> void:
	var last: int = Time.get_ticks_msec() + int(1000.0 * SECONDS)
	while not holds.call() and Time.get_ticks_msec() < last:
		await process_frame


func picture(name: String) -> void:
	var folder: PackedStringArray = OS.get_cmdline_user_args()
	if not folder.is_empty():
		for i: int in 3:
			await RenderingServer.frame_post_draw
		root.get_texture().get_image().save_png("%s/%s.png" % [folder[0], name])
