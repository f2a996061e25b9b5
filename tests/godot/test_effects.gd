extends "res://suite.gd"

# KnurlEffect: forces at a node, without a surface.


func make_effect(kind: int, position := Vector3.ZERO) -> Node3D:
	var effect: Node3D = ClassDB.instantiate(&"KnurlEffect")
	effect.kind = kind
	effect.position = position
	effect.damping = 0.0
	root.add_child(effect)
	return effect


func mouse_at(place: Vector3) -> Node3D:
	var d := make_device("mouse")
	d.start()
	d.move_hip(place)
	await until(func() -> bool: return d.hip_position.distance_to(place) < 1e-4)
	return d


func has_force(d: Node3D, expected: Vector3) -> bool:
	return await until(func() -> bool: return d.force.distance_to(expected) < 0.01)


func defaults() -> void:
	var e: Node3D = ClassDB.instantiate(&"KnurlEffect")
	check("numbers", [e.kind, e.stiffness, e.damping, e.spacing, e.max_force, e.layers] == [1, 200.0, 1.0, 0.01, 2.0, 1])
	check("axis up, enabled", e.axis == Vector3.UP and e.enabled)
	e.free()


func springs() -> void:
	var d: Node3D = await mouse_at(Vector3.ZERO)
	var e := make_effect(1, Vector3(0.005, 0, 0)) # 200 N/m
	check("it pulls to the node", await has_force(d, Vector3(1, 0, 0)), d.force)
	e.position.x = -0.004
	check("and follows it", await has_force(d, Vector3(-0.8, 0, 0)), d.force)
	e.stiffness = 100.0
	check("and its properties", await has_force(d, Vector3(-0.4, 0, 0)), d.force)
	e.enabled = false
	check("disabled", await has_force(d, Vector3.ZERO), d.force)
	e.enabled = true
	e.layers = 2
	await frames(3)
	check("on another layer", d.force == Vector3.ZERO, d.force)
	d.layers = 3
	check("which the device has too", await has_force(d, Vector3(-0.4, 0, 0)), d.force)
	d.stop()
	d.start()
	d.move_hip(Vector3.ZERO)
	check("the next run has it", await has_force(d, Vector3(-0.4, 0, 0)), d.force)
	e.free()
	check("freed", await has_force(d, Vector3.ZERO), d.force)
	clear()


func turns() -> void:
	var d: Node3D = await mouse_at(Vector3.ZERO)
	var parent := Node3D.new()
	root.add_child(parent)
	var e := make_effect(5, Vector3(0, 0.002, 0)) # a plane across y
	e.reparent(parent)
	check("a plane", await has_force(d, Vector3(0, 0.4, 0)), d.force)
	parent.rotation.z = -PI / 2.0 # about the origin: the plane is at x = 2 mm, across x
	check("turns with its parent", await has_force(d, Vector3(0.4, 0, 0)), d.force)
	e.kind = 6
	e.axis = Vector3(0, 0, 3)
	check("a force", await has_force(d, Vector3(0, 0, 2)), d.force)
	clear()


func refuses() -> void:
	var d: Node3D = await mouse_at(Vector3.ZERO)
	expect_error("effects[0].axis: expected a vector with a length")
	var e := make_effect(4)
	e.axis = Vector3.ZERO
	await frames(3)
	check("nothing is felt", d.force == Vector3.ZERO, d.force)
	e.free()
	for i in 9:
		make_effect(6).max_force = 0.1
	check("8 of 9", await has_force(d, Vector3(0, 0.8, 0)), d.force)
	clear()


func tests() -> void:
	defaults()
	await springs()
	await turns()
	await refuses()
