extends "res://suite.gd"

# The same path through the engine and through `knurl run`, see tests/unity/traces.py.


func doubles(name: String) -> PackedFloat64Array:
	return FileAccess.get_file_as_bytes("res://" + name).to_float64_array()


func largest_difference(a: PackedFloat64Array, b: PackedFloat64Array) -> float:
	var largest := INF if a.size() != b.size() else 0.0
	for i in mini(a.size(), b.size()):
		largest = maxf(largest, absf(a[i] - b[i]))
	return largest


# A demo file as the engine's own glTF loader reads it, with the values of its tags.
func build(file: String, has_ridges: bool) -> int:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_file(file, state) != OK:
		return 0
	var scene := document.generate_scene(state)
	root.add_child(scene)
	var count := 0
	for mesh in scene.find_children("*", "MeshInstance3D", true, false):
		var material: Material = mesh.mesh.surface_get_material(0)
		var tags: Dictionary = material.get_meta("extras", {})
		if not tags.has("knurl") and not tags.has("knurl_amplitude"):
			continue
		var surface: Node3D = ClassDB.instantiate(&"KnurlSurface")
		var grating: Resource = ClassDB.instantiate(&"KnurlGrating")
		for key in ["spatial_frequency", "amplitude", "stiffness"]:
			var value: Variant = tags["knurl"][key] if tags.has("knurl") else tags["knurl_" + key]
			if key == "spatial_frequency":
				value = Vector2(value[0], value[1]) if value is Array else Vector2(value, 0)
			grating.set(key, value)
		if not has_ridges:
			grating.amplitude = 0.0
		surface.grating = grating
		mesh.add_child(surface)
		count += 1
	return count


# The tool puts the device's origin into the middle of the surfaces, which a float cannot express for the handle.
func play(asset: String, surfaces: int, tolerance: float) -> void:
	var file := "res://%s.glb" % asset
	var rows := doubles(asset + ".trace.bin")
	var expected := doubles(asset + ".forces.bin")
	var ticks := expected.size() / 3
	check("%s: a path to play" % asset, rows.size() == 4 * 1001 and ticks == 2001, [rows.size(), ticks])
	var d := make_device()
	d.clamp = false
	check("a file's surfaces", d.load_gltf(file) == surfaces)
	var forces: PackedFloat64Array = d.play_trace(rows, ticks)
	var nothing := PackedFloat64Array()
	nothing.resize(forces.size())
	check("something is felt", largest_difference(forces, nothing) > 0.2)
	check("through Knurl's loader: the same bits", largest_difference(forces, expected) <= tolerance, largest_difference(forces, expected))
	check("again: the same bits", d.play_trace(rows, ticks) == forces)
	d.free()
	d = make_device()
	d.clamp = false
	# The engine packs normals and tangents into 32 bits. On a curved surface it also makes tangents, which bend the ridges:
	# there the wall is compared.
	var is_flat := surfaces > 1 or asset == "grid_2d"
	expected = expected if is_flat else doubles(asset + ".wall.forces.bin")
	check("the engine's own meshes", build(file, is_flat) == surfaces)
	forces = d.play_trace(rows, ticks)
	var difference := largest_difference(forces, expected)
	print("note: %s, the engine's own meshes: at most %s N off" % [asset, difference])
	check("through the engine's loader: within 2e-4 N", difference < 2e-4, difference)
	d.free()
	clear()


func tests() -> void:
	play("plate_1d", 3, 0.0)
	play("grid_2d", 1, 0.0)
	play("knurled_handle", 1, 1e-12) # smooth, by its normals
	var rows := doubles("plate_1d.trace.bin")
	var d := make_device()
	expect_error("t, x, y, z")
	check("rows of three are refused", d.play_trace(PackedFloat64Array([0, 0, 0]), 10).is_empty())
	expect_error("only the fake device takes a trace")
	d.device = "mouse"
	check("another device is refused", d.play_trace(rows, 10).is_empty())
	expect_error("that is stopped")
	d.start()
	check("a running device is refused", d.play_trace(rows, 10).is_empty() and d.running)
	clear()
