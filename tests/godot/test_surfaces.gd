extends "res://suite.gd"


# The force at rest, `depth` m below `at`, after a second: of a wall with a grating without
# friction.
func press(at: Vector3, device: Node3D = null) -> Vector3:
	var d := device if device else make_device()
	var rows := PackedFloat64Array([0, at.x, at.y + 0.01, at.z, 0.2, at.x, at.y, at.z])
	var forces: PackedFloat64Array = d.play_trace(rows, 400)
	if not device:
		d.free()
	if forces.size() != 1200:
		return Vector3(NAN, NAN, NAN)
	return Vector3(forces[1197], forces[1198], forces[1199])


# A smooth wall of 400 N/m: F = K z.
func smooth(mesh: Mesh, position := Vector3.ZERO) -> Node3D:
	var s := make_surface(mesh, position)
	s.grating.spatial_frequency = Vector2.ZERO
	s.grating.amplitude = 0.0
	return s


func fronts() -> void:
	var s := smooth(plate())
	check("the front holds: 400 N/m, 1 mm", press(Vector3(0, -0.001, 0)).is_equal_approx(Vector3(0, 0.4, 0)), press(Vector3(0, -0.001, 0)))
	s.get_parent().rotation.x = PI
	check("the back does not", press(Vector3(0, -0.001, 0)) == Vector3.ZERO, press(Vector3(0, -0.001, 0)))
	s.double_sided = true
	check("unless it is double sided", press(Vector3(0, -0.001, 0)).is_equal_approx(Vector3(0, 0.4, 0)))
	s.get_parent().rotation.x = 0.0
	s.double_sided = false
	s.get_parent().scale = Vector3(1, 1, -1)
	check("a mirror keeps the front in front", press(Vector3(0, -0.001, 0)).is_equal_approx(Vector3(0, 0.4, 0)), press(Vector3(0, -0.001, 0)))
	s.get_parent().scale = Vector3.ONE
	var box := BoxMesh.new()
	box.size = Vector3(0.1, 0.02, 0.1)
	s.get_parent().mesh = box
	check("so does the engine's box", press(Vector3(0, 0.009, 0)).is_equal_approx(Vector3(0, 0.4, 0)), press(Vector3(0, 0.009, 0)))
	clear()


func scales() -> void:
	var s := smooth(plate(1.0))
	s.get_parent().scale = Vector3(0.1, 1, 0.1)
	check("inside of the scaled mesh", press(Vector3(0.045, -0.001, 0)).y > 0.39)
	check("outside", press(Vector3(0.055, -0.001, 0)) == Vector3.ZERO)
	s.get_parent().rotation.y = 0.3
	s.get_parent().scale = Vector3(0.2, 3, 0.1)
	check("turned and scaled", press(Vector3(0.095 * cos(0.3), -0.001, -0.095 * sin(0.3))).y > 0.39)
	check("turned and scaled: outside", press(Vector3(0.105 * cos(0.3), -0.001, -0.105 * sin(0.3))) == Vector3.ZERO)
	var d := make_device()
	d.start()
	var before: int = d.get_status().surfaces
	s.get_parent().scale = Vector3(0.1, 1, 0.1)
	await frames(3)
	check("a scale that changes is baked anew", before == 1 and d.get_status().surfaces == 1 and s.get_triangle_count() == 2)
	s.get_parent().scale = Vector3.ZERO
	await frames(3)
	check("a scale of nothing is felt as nothing", d.get_status().surfaces == 0)
	check("and is warned of", " ".join(s.get_warnings()).contains("scaled to nothing"), s.get_warnings())
	s.get_parent().scale = Vector3(0.1, 1, 0.1)
	await frames(3)
	check("and comes back", d.get_status().surfaces == 1)
	clear()


func many_meshes() -> void:
	var mesh := plate(0.02)
	var lines := []
	lines.resize(Mesh.ARRAY_MAX)
	lines[Mesh.ARRAY_VERTEX] = PackedVector3Array([Vector3.ZERO, Vector3.ONE])
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_LINES, lines)
	var second := plate(0.02).surface_get_arrays(0)
	for i in 4:
		second[Mesh.ARRAY_VERTEX][i] += Vector3(0.04, 0, 0)
	second[Mesh.ARRAY_INDEX] = null
	second[Mesh.ARRAY_VERTEX] = PackedVector3Array([second[Mesh.ARRAY_VERTEX][0], second[Mesh.ARRAY_VERTEX][2],
			second[Mesh.ARRAY_VERTEX][1]])
	second[Mesh.ARRAY_TEX_UV] = PackedVector2Array([Vector2(0, 1), Vector2(1, 0), Vector2(1, 1)])
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, second)
	var s := smooth(mesh)
	var d := make_device()
	d.start()
	check("triangles of all surfaces, and of no lines", s.get_triangle_count() == 3, s.get_triangle_count())
	d.stop()
	check("the first", press(Vector3(0, -0.001, 0)).y > 0.39)
	check("the second, without indices", press(Vector3(0.045, -0.001, 0)).y > 0.39)
	s.get_parent().mesh = ArrayMesh.new()
	expect_error("its mesh has no triangles")
	check("an empty mesh is no crash", press(Vector3(0, -0.001, 0)) == Vector3.ZERO)
	clear()


func follows() -> void:
	var s := smooth(plate())
	var d := make_device("mouse")
	d.start()
	d.move_hip(Vector3(0, 0.02, 0))
	await until(func() -> bool: return d.ticks > 10)
	d.move_hip(Vector3(0, -0.001, 0))
	check("pressed", await until(func() -> bool: return absf(d.force.y - 0.4) < 0.02), d.force)
	s.get_parent().position.y = -0.0005
	check("lowered by half", await until(func() -> bool: return absf(d.force.y - 0.2) < 0.02), d.force)
	s.get_parent().rotation.z = 0.1
	check("tilted", await until(func() -> bool: return absf(d.force.x + d.force.y * tan(0.1)) < 1e-3 and d.force.x < -0.01), d.force)
	s.get_parent().position.x = 1.0
	check("gone", await until(func() -> bool: return d.force == Vector3.ZERO), d.force)
	clear()


func feels() -> void:
	var s := smooth(plate())
	var other := smooth(plate(), Vector3(0.5, 0, 0))
	other.grating = s.grating
	var d := make_device("mouse")
	d.start()
	d.move_hip(Vector3(0, 0.02, 0))
	await until(func() -> bool: return d.ticks > 10)
	d.move_hip(Vector3(0, -0.001, 0))
	check("400 N/m", await until(func() -> bool: return absf(d.force.y - 0.4) < 0.01), d.force)
	s.grating.stiffness = 200.0
	check("200 N/m", await until(func() -> bool: return absf(d.force.y - 0.2) < 0.01), d.force)
	var stiff: Resource = ClassDB.instantiate(&"KnurlGrating")
	stiff.spatial_frequency = Vector2.ZERO
	stiff.stiffness = 300.0
	s.grating = stiff
	check("another grating, 300 N/m", await until(func() -> bool: return absf(d.force.y - 0.3) < 0.01), d.force)
	s.enabled = false
	check("switched off", await until(func() -> bool: return d.force == Vector3.ZERO))
	s.enabled = true
	await again(d)
	check("switched on", await until(func() -> bool: return absf(d.force.y - 0.3) < 0.01), d.force)
	s.grating = null
	stiff.stiffness = 301.0
	stiff.stiffness = 300.0
	check("no grating", await until(func() -> bool: return d.force == Vector3.ZERO))
	s.grating = stiff
	await again(d)
	check("a grating again", await until(func() -> bool: return d.force.y > 0.2), d.force)
	clear()


# A wall that comes up around a finger is felt when the finger comes again.
func again(device: Node3D) -> void:
	device.move_hip(Vector3(0, 0.01, 0))
	await until(func() -> bool: return device.hip_position.y > 0.005)
	device.move_hip(Vector3(0, -0.001, 0))


# A grating's x comes from the uvs (along x here), or from the axis.
func directions() -> void:
	var d := make_device("fake")
	d.clamp = false
	var s := make_surface(plate())
	s.grating.method = 1
	var along := PackedFloat64Array([0, -0.02, -0.001, 0, 1, 0.02, -0.001, 0])
	var across := PackedFloat64Array([0, 0, -0.001, -0.02, 1, 0, -0.001, 0.02])
	check("ridges along u", ripples(d.play_trace(along, 1000)) > 30)
	check("none along v", ripples(d.play_trace(across, 1000)) == 0)
	s.axis = Vector3(0, 0, 1)
	check("an axis: none along u", ripples(d.play_trace(along, 1000)) == 0)
	check("but along the axis", ripples(d.play_trace(across, 1000)) > 30)
	s.axis = Vector3.ZERO
	s.grating.orientation = PI / 2
	check("turned", ripples(d.play_trace(across, 1000)) > 30)
	clear()


# How often the normal force rises through its mean.
func ripples(forces: PackedFloat64Array) -> int:
	var count := 0
	for i in range(200, forces.size() / 3 - 1):
		if forces[3 * i + 1] < 0.4 and forces[3 * i + 4] >= 0.4:
			count += 1
	return count


func warns() -> void:
	var lonely: Node3D = ClassDB.instantiate(&"KnurlSurface")
	root.add_child(lonely)
	check("no mesh, no grating", lonely.get_warnings().size() == 2 and "MeshInstance3D" in lonely.get_warnings()[0] and
			"grating" in lonely.get_warnings()[1], lonely.get_warnings())
	var s := make_surface(null)
	check("a parent without a mesh", s.get_warnings().size() == 1 and "no mesh" in s.get_warnings()[0], s.get_warnings())
	clear()
	var good := make_surface(plate())
	good.grating.stiffness = 300.0
	good.grating.amplitude = 0.0001
	var far := make_surface(plate(), Vector3(5, 0, 0))
	far.grating.amplitude = 0.0
	far.grating.stiffness = 300.0
	var hard := make_surface(plate(), Vector3(0, 0, 0))
	hard.grating.stiffness = 100000.0
	check("nothing before a device runs", good.get_warnings().is_empty() and hard.get_warnings().is_empty())
	var d := make_device()
	d.start()
	check("nothing of what is well", good.get_warnings().is_empty(), good.get_warnings())
	check("out of the workspace", "outside of the device's workspace" in " ".join(far.get_warnings()), far.get_warnings())
	check("too stiff", "N/m" in " ".join(hard.get_warnings()), hard.get_warnings())
	clear()


func comes_late() -> void:
	var d := make_device()
	d.start()
	var s := make_surface(plate())
	await frames(2)
	check("a surface that comes while it runs", s.get_triangle_count() == 2 and d.get_status().surfaces == 1)
	s.get_parent().queue_free()
	await frames(2)
	check("and goes", d.get_status().surfaces == 0)
	d.stop()
	check("files", d.load_gltf("res://plate_1d.glb") == 3)
	d.start()
	check("are felt", d.get_status().surfaces == 3)
	d.stop()
	make_surface(plate())
	d.start()
	check("and stay", d.get_status().surfaces == 4, d.get_status().surfaces)
	d.stop()
	var bytes := FileAccess.get_file_as_bytes("res://plate_1d.glb")
	for i in bytes.size() - 20:
		if bytes.slice(i, i + 15).get_string_from_ascii() == "knurl_amplitude":
			bytes[i + 14] = "o".unicode_at(0)
			break
	FileAccess.open("res://misspelt.glb", FileAccess.WRITE).store_buffer(bytes)
	check("a wrong tag leaves the others", d.load_gltf("res://misspelt.glb") == 2)
	clear()


# As the engine's bodies: a branch that is disabled is not in the way.
func disabled_branches() -> void:
	var branch := Node3D.new()
	var s := make_surface(plate())
	root.add_child(branch)
	s.get_parent().reparent(branch)
	var d := make_device()
	d.start()
	await frames(2)
	check("felt", s.get_triangle_count() == 2)
	branch.process_mode = Node.PROCESS_MODE_DISABLED
	await frames(2)
	check("not felt in a disabled branch", s.get_triangle_count() == 0 and d.get_status().surfaces == 0)
	check("which it tells", "process mode Disabled" in " ".join(s.get_warnings()), s.get_warnings())
	s.process_mode = Node.PROCESS_MODE_ALWAYS
	await frames(2)
	check("felt with a mode of its own", s.get_triangle_count() == 2)
	s.process_mode = Node.PROCESS_MODE_INHERIT
	root.remove_child(branch)
	root.add_child(branch)
	await frames(2)
	check("not when a disabled branch enters the tree", s.get_triangle_count() == 0)
	branch.process_mode = Node.PROCESS_MODE_INHERIT
	await frames(2)
	check("felt again", s.get_triangle_count() == 2)
	clear()


func tests() -> void:
	fronts()
	await scales()
	many_meshes()
	await follows()
	await feels()
	directions()
	warns()
	await comes_late()
	await disabled_branches()
