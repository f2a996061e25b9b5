extends "res://suite.gd"

# A finger rests 1 mm deep in a smooth wall of 400 N/m (0.4 N) while the game edits the wall. It
# stays in contact, without a signal of its end.

var device: Node3D
var surface: Node3D
var told := []


func press(mesh: Mesh) -> void:
	surface = make_surface(mesh)
	surface.grating.amplitude = 0.0
	surface.grating.spatial_frequency = Vector2.ZERO
	device = make_device("mouse")
	device.contact_ended.connect(func(what: Node) -> void: told.append(what))
	device.start()
	device.move_hip(Vector3(0, 0.02, 0))
	await until(func() -> bool: return device.ticks > 20)
	device.move_hip(Vector3(0, -0.001, 0))
	await until(func() -> bool: return absf(device.force.y - 0.4) < 0.002)
	await seconds(0.3)
	told.clear()


# Every tick since the change pushed, once the change was seen.
func stays(what: String, force := 0.4) -> void:
	await frames(3)
	await seconds(0.05)
	var rows: PackedFloat32Array = device.get_history(150)
	var least := INF
	for i in rows.size() / 2:
		least = minf(least, rows[2 * i + 1])
	check("%s: it goes on pushing" % what, least > 0.5 * force, least)
	check("%s: as it should" % what, absf(device.force.y - force) < 0.02, device.force)
	check("%s: no contact ended" % what, told.is_empty(), told)
	if not told.is_empty(): # otherwise the rest fails, too
		device.move_hip(Vector3(0, 0.02, 0))
		await until(func() -> bool: return device.hip_position.y > 0.01)
		device.move_hip(Vector3(0, -0.001, 0))
		await until(func() -> bool: return absf(device.force.y - 0.4) < 0.01, 1.0)
		told.clear()


func box(height := 0.02) -> BoxMesh:
	var mesh := BoxMesh.new()
	mesh.size = Vector3(0.1, height, 0.1)
	return mesh


func goes(what: String) -> void:
	check("%s: no ghost of it is felt" % what, await until(func() -> bool: return device.force == Vector3.ZERO, 1.0), device.force)
	check("%s: its contact ended" % what, await until(func() -> bool: return told.size() == 1, 1.0), told)


func tests() -> void:
	await press(plate())
	var instance: MeshInstance3D = surface.get_parent()
	var other := Node3D.new()
	root.add_child(other)
	instance.reparent(other)
	await stays("put below another node in place")
	var twin := MeshInstance3D.new()
	twin.mesh = plate()
	root.add_child(twin)
	surface.reparent(twin)
	await stays("put below another mesh in place")
	surface.reparent(instance)
	await frames(2)
	instance.scale = Vector3(1.3, 1, 0.7)
	await stays("scaled")
	for i in 30:
		instance.scale = Vector3.ONE * (1.0 + 0.3 * sin(0.3 * i))
		await frames(1)
	await stays("pulsing")
	instance.scale = Vector3.ONE
	surface.axis = Vector3(0, 0, 1)
	await stays("another axis")
	surface.double_sided = true
	await stays("double sided")
	instance.mesh = box(0.0)
	await stays("another mesh")
	var edited := plate()
	instance.mesh = edited
	await frames(2)
	edited.clear_surfaces()
	edited.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, plate(0.2).surface_get_arrays(0))
	await stays("an edited mesh")
	var plane := PlaneMesh.new()
	plane.size = Vector2(0.1, 0.1)
	instance.mesh = plane
	await frames(2)
	plane.size = Vector2(0.3, 0.3)
	await stays("a primitive of another size")
	plane.center_offset = Vector3(0, -0.0005, 0)
	await stays("a primitive that is lower", 0.2)
	plane.center_offset = Vector3.ZERO
	await stays("and back")
	plane.subdivide_width = 3
	await stays("a primitive of more triangles")
	told.clear()
	instance.mesh = null
	await goes("no mesh")
	device.move_hip(Vector3(0, 0.02, 0))
	await until(func() -> bool: return device.hip_position.y > 0.01)
	instance.mesh = plate()
	await frames(3)
	device.move_hip(Vector3(0, -0.001, 0))
	check("a mesh again", await until(func() -> bool: return absf(device.force.y - 0.4) < 0.01), device.force)
	told.clear()
	instance.mesh = ArrayMesh.new()
	expect_error("its mesh has no triangles")
	await goes("an empty mesh")
	clear()
	await press(plate())
	surface.get_parent().remove_child(surface)
	await goes("out of the tree")
	surface.free()
	clear()
	await press(plate())
	surface.get_parent().free()
	await goes("freed")
	clear()
	await press(plate())
	surface.get_parent().queue_free()
	await goes("freed later")
	clear()
