extends "res://suite.gd"

# A game's use of a device: listing, waiting for one, touch signals at surfaces, pushing touched
# bodies.


func finds_devices() -> void:
	var d := make_device()
	var found: Array = d.list_devices()
	check("kinds of devices are listed", found.size() >= 3, found)
	for one: Dictionary in found:
		check("each with what it takes", one.has_all(["device", "name", "reason", "usable"]), one)
	d.device = "auto"
	if not found.any(func(one: Dictionary) -> bool: return one.usable):
		expect_error("auto: expected a device that is connected, found none")
		check("without any, auto says so", d.start() == ERR_CANT_CONNECT)
	clear()


func waits_for_one() -> void:
	var d: Node3D = ClassDB.instantiate(&"KnurlDevice")
	var told := []
	d.device = "nonsense"
	d.retry = 0.05
	d.start_failed.connect(func(error: int, text: String) -> void: told.append([error, text]))
	expect_error("found 'nonsense'")
	root.add_child(d)
	check("a start of its own that fails is told", await until(func() -> bool: return told.size() == 1), told)
	check("with its error", told[0][0] == ERR_INVALID_PARAMETER and "nonsense" in told[0][1], told)
	await seconds(0.3)
	check("once, however often it is tried", told.size() == 1, told)
	d.device = "fake"
	check("and it starts when it can", await until(func() -> bool: return d.running))
	clear()


func tells_surfaces() -> void:
	var s := make_surface(plate())
	var told := []
	s.touched.connect(func(by: Node) -> void: told.append(["touched", by]))
	s.released.connect(func(by: Node) -> void: told.append(["released", by]))
	var ridges := [0]
	s.ridges_passed.connect(func(_by: Node, count: int) -> void: ridges[0] += count)
	var d := make_device("mouse")
	d.start()
	d.move_hip(Vector3(-0.03, 0.01, 0))
	await until(func() -> bool: return d.ticks > 50)
	check("nothing is touched", d.get_touched_surface() == null)
	d.move_hip(Vector3(-0.03, -0.001, 0))
	check("a surface hears of its touch", await until(func() -> bool: return told == [["touched", d]]), told)
	check("the device knows it", d.get_touched_surface() == s)
	check("and how deep", await until(func() -> bool: return absf(d.depth - 0.001) < 1e-4), d.depth)
	await seconds(0.2)
	ridges[0] = 0
	var fastest := 0.0
	for i in 61:
		d.move_hip(Vector3(-0.03 + 0.001 * i, -0.001, 0))
		await frames(1)
		fastest = maxf(fastest, d.velocity.x)
	await seconds(0.3)
	check("60 mm of 1000 ridges/m are 60 ridges", absi(ridges[0] - 60) <= 2, ridges)
	check("and a velocity", fastest > 0.02 and fastest < 0.5, fastest)
	d.move_hip(Vector3(0, 0.02, 0))
	check("and of its end", await until(func() -> bool: return told.size() == 2 and told[1] == ["released", d]), told)
	check("nothing is touched any more", d.get_touched_surface() == null and d.buttons == 0)
	clear()


# A body without other forces gets the opposite of the hand's force: momentum = the forces' sum over
# time.
func pushes() -> void:
	var s := make_surface(plate())
	var body := RigidBody3D.new()
	body.mass = 2.0
	body.gravity_scale = 0.0
	body.linear_damp_mode = RigidBody3D.DAMP_MODE_REPLACE
	body.angular_damp_mode = RigidBody3D.DAMP_MODE_REPLACE
	body.lock_rotation = true
	var box := CollisionShape3D.new()
	box.shape = BoxShape3D.new()
	body.add_child(box)
	root.add_child(body)
	s.get_parent().reparent(body)
	s.grating.amplitude = 0.0
	var d := make_device("mouse")
	d.start()
	d.move_hip(Vector3(0, 0.01, 0))
	await until(func() -> bool: return d.ticks > 50)
	d.move_hip(Vector3(0, -0.001, 0))
	await until(func() -> bool: return d.force.y > 0.3)
	await seconds(0.3)
	check("it is not pushed unless it is asked for", body.linear_velocity == Vector3.ZERO, body.linear_velocity)
	d.move_hip(Vector3(0, 0.01, 0))
	await until(func() -> bool: return not d.in_contact)
	s.reaction = true
	await frames(2)
	var at := body.position.y
	var begin: int = d.ticks
	d.move_hip(Vector3(0, -0.002, 0))
	check("pushed, it goes", await until(func() -> bool: return body.position.y < at - 0.004), body.position)
	await until(func() -> bool: return not d.in_contact)
	await frames(5)
	var rows: PackedFloat32Array = d.get_history(d.ticks - begin)
	var impulse := 0.0
	for i in rows.size() / 2:
		impulse += 0.001 * rows[2 * i + 1]
	check_near("with the momentum that the hand spent", -body.mass * body.linear_velocity.y, impulse, 0.05 * impulse)
	print("note: %.4f N s spent, %.4f kg m/s in the body" % [impulse, -body.mass * body.linear_velocity.y])
	clear()


func tests() -> void:
	finds_devices()
	await waits_for_one()
	await tells_surfaces()
	await pushes()
	var grating: Resource = ClassDB.instantiate(&"KnurlGrating")
	check("methods have names", ClassDB.class_get_integer_constant(&"KnurlGrating", &"METHOD_BANDLIMITED") == 3 and
			ClassDB.class_get_enum_constants(&"KnurlGrating", &"Method").size() == 4)
	check("so have faults", ClassDB.class_get_integer_constant(&"KnurlDevice", &"FAULT_LOST") == 1 and
			ClassDB.class_get_integer_constant(&"KnurlDevice", &"FAULT_RECONNECTED") == 33)
	grating.method = ClassDB.class_get_integer_constant(&"KnurlGrating", &"METHOD_S2")
	check("that can be set", grating.method == 2)
