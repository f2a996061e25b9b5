extends "res://suite.gd"

# A game's control of the force: gain, added force, vibrations, layers, clutch; and a workspace that
# moves with its node. A wall of 400 N/m, 1 mm deep, gives 0.4 N.


func wall(at := Vector3.ZERO) -> Node3D:
	var s := make_surface(plate(), at)
	s.grating.spatial_frequency = Vector2.ZERO
	s.grating.amplitude = 0.0
	return s


# A finger 1 mm below y = 0: the simulated hand rests on the wall.
func finger() -> Node3D:
	var d := make_device("mouse")
	d.start()
	d.move_hip(Vector3(0, 0.02, 0))
	await until(func() -> bool: return d.ticks > 100)
	d.move_hip(Vector3(0, -0.001, 0))
	return d


func is_about(d: Node3D, expected: float) -> Callable:
	return func() -> bool: return absf(d.force.y - expected) < 0.01


func scales() -> void:
	wall()
	var d: Node3D = await finger()
	check("pressed", await until(is_about(d, 0.4)), d.force)
	d.gain = 0.25
	check("a quarter of it", await until(is_about(d, 0.1)), d.force)
	check("and still touched", d.in_contact)
	expect_error("KnurlDevice.gain: expected 0 to 1")
	d.gain = 2.0
	check("no gain above 1", d.gain == 0.25)
	d.stop()
	d.start()
	d.move_hip(Vector3(0, 0.02, 0))
	await until(func() -> bool: return d.ticks > 100)
	d.move_hip(Vector3(0, -0.001, 0))
	check("the next run has it too", await until(is_about(d, 0.1)), d.force)
	clear()


func pushes() -> void:
	var d: Node3D = await finger()
	d.added_force = Vector3(0, 1.5, 0)
	check("a force of the game's", await until(is_about(d, 1.5)), d.force)
	d.added_force = Vector3(0, 100, 0)
	check("as much as the device has", await until(is_about(d, 3.3)), d.force)
	paused = true
	check("none in a pause", await until(func() -> bool: return d.force == Vector3.ZERO), d.force)
	paused = false
	expect_error("KnurlDevice.added_force: force: expected at most 1000 N")
	d.added_force = Vector3(0, 5000, 0)
	d.added_force = Vector3.ZERO
	check("and no more", await until(func() -> bool: return d.force == Vector3.ZERO), d.force)
	clear()


# 100 Hz of T3 at 1 kHz: ten ticks a period, half of them up.
func vibrates() -> void:
	var t3: int = ClassDB.class_get_integer_constant(&"KnurlDevice", &"VIBRATION_T3")
	var d: Node3D = await finger()
	d.vibrate(t3, 100.0, 1.0, 60.0, Vector3.UP)
	var seen := {}
	check("up and down", await until(func() -> bool:
		seen[snappedf(d.force.y, 0.01)] = true
		return seen.has(1.0) and seen.has(-1.0)), seen.keys())
	d.vibrate(t3, 100.0, 1.0, 0.0, Vector3.UP)
	check("no seconds end it", await until(func() -> bool: return d.force == Vector3.ZERO), d.force)
	d.vibrate(ClassDB.class_get_integer_constant(&"KnurlDevice", &"VIBRATION_T1"), 50.0, 0.5, 0.05, Vector3.RIGHT)
	check("one ends by itself", await until(func() -> bool: return d.force == Vector3.ZERO))
	expect_error("KnurlDevice.vibrate: vibration: expected 0.1 to 500 Hz")
	d.vibrate(t3, 700.0, 1.0, 1.0, Vector3.UP)
	expect_error("KnurlDevice.vibrate: direction")
	d.vibrate(t3, 100.0, 1.0, 1.0, Vector3.ZERO)
	d.stop()
	expect_error("KnurlDevice.vibrate: session: expected one that runs")
	d.vibrate(t3, 100.0, 1.0, 1.0, Vector3.UP)
	clear()


func layers() -> void:
	var s := wall()
	var d: Node3D = await finger()
	check("both are on layer 1", await until(is_about(d, 0.4)), d.force)
	s.layers = 2
	check("not felt on another", await until(func() -> bool: return not d.in_contact and d.force == Vector3.ZERO))
	check("and it says so", "layers" in " ".join(s.get_warnings()), s.get_warnings())
	d.layers = 3
	d.move_hip(Vector3(0, 0.02, 0))
	await seconds(0.1)
	d.move_hip(Vector3(0, -0.001, 0))
	check("felt by a device with both", await until(is_about(d, 0.4)), d.force)
	check("without a warning", s.get_warnings().is_empty(), s.get_warnings())
	d.layers = 4
	check("a device changes its layers", await until(func() -> bool: return not d.in_contact))
	clear()


# The simulated hand rests at the workspace's origin; the node moves it down, 1 mm into the wall,
# and away.
func follows() -> void:
	wall()
	var d := make_device("fake")
	d.position = Vector3(0, 0.02, 0)
	d.start()
	check("above the wall", await until(func() -> bool: return absf(d.hip_position.y - 0.02) < 1e-3), d.hip_position)
	for i in 30:
		d.position.y -= 0.0007
		await process_frame
	check("its node takes it down", await until(func() -> bool: return d.hip_position.y < -0.0004), d.hip_position)
	check("and the hand yields to the wall", await until(func() -> bool:
		return d.force.y > 0.15 and absf(d.force.y + 400.0 * d.hip_position.y) < 0.01), [d.force, d.hip_position])
	d.position = Vector3(2, 0, 0)
	check("and leaps away", await until(func() -> bool: return not d.in_contact and absf(d.hip_position.x - 2.0) < 1e-3), d.hip_position)
	d.rotation.y = PI / 2
	check("a node that turns in place leaves it there", await until(func() -> bool: return absf(d.hip_position.x - 2.0) < 1e-3))
	clear()


func clutches() -> void:
	var d := make_device("fake", "line")
	wall()
	d.start()
	check("on its way", await until(func() -> bool: return d.in_contact and d.velocity.length() > 0.05))
	d.clutch = true
	var at: Vector3 = d.hip_position
	check("nothing is felt", await until(func() -> bool: return d.force == Vector3.ZERO and not d.in_contact))
	await seconds(0.2)
	check("and it stays", d.hip_position == at, [d.hip_position, at])
	d.clutch = false
	check("then it goes on from there", await until(func() -> bool: return d.hip_position != at))
	check("without a leap", d.hip_position.distance_to(at) < 0.02, [d.hip_position, at])
	clear()


# The simulated hand rests 1 mm deep in a wall 30 mm below the node.
func zooms() -> void:
	wall(Vector3(0, -0.03, 0))
	var d := make_device("fake", "rest")
	d.start()
	check("rests on the wall", await until(func() -> bool: return d.force.y > 0.15), [d.force, d.hip_position])
	var resting: float = d.force.y
	d.workspace_scale = 1.2
	await seconds(0.4)
	check("a zoom presses it in", d.in_contact and d.force.y > resting + 0.1, [d.force, resting])
	var forces: PackedFloat32Array = d.get_history(300)
	var jump := 0.0
	for i in range(3, forces.size(), 2):
		jump = maxf(jump, absf(forces[i] - forces[i - 2]))
	check("without a jump", jump < 0.1, jump) # 400 N/m times 0.5 m/s, in a tick: 0.2 N
	d.workspace_scale = 0.5
	check("a smaller scale takes it off", await until(func() -> bool: return not d.in_contact and d.hip_position.y > -0.02), d.hip_position)
	d.workspace_scale = 1.0
	check("and back", await until(func() -> bool: return d.force.y > 0.15), d.force)
	d.clutch = true
	var at: Vector3 = d.hip_position
	d.workspace_scale = 3.0
	await seconds(0.1)
	check("with the clutch it stays", d.hip_position.distance_to(at) < 2e-4, [d.hip_position, at])
	d.clutch = false
	await seconds(0.2)
	check("and afterwards", d.hip_position.distance_to(at) < 1e-3 and d.in_contact, [d.hip_position, at])
	expect_error("KnurlDevice.workspace_scale: expected")
	d.workspace_scale = 0.0
	check("no scale of 0", d.workspace_scale == 3.0)
	clear()


func tests() -> void:
	await scales()
	await pushes()
	await vibrates()
	await layers()
	await follows()
	await zooms()
	await clutches()

