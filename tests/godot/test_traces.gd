extends "res://suite.gd"

# The same path through the engine and through `knurl run`, see trace.py.


func doubles(name: String) -> PackedFloat64Array:
	return FileAccess.get_file_as_bytes("res://" + name).to_float64_array()


func largest_difference(a: PackedFloat64Array, b: PackedFloat64Array) -> float:
	var largest := INF if a.size() != b.size() else 0.0
	for i in mini(a.size(), b.size()):
		largest = maxf(largest, absf(a[i] - b[i]))
	return largest


# The demo plate from the engine's own glTF loader, with the values of its tags.
func build_plate() -> int:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_file("res://plate_1d.glb", state) != OK:
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
		surface.grating = grating
		mesh.add_child(surface)
		count += 1
	return count


func tests() -> void:
	var rows := doubles("trace.bin")
	var expected := doubles("forces.bin")
	var ticks := expected.size() / 3
	check("a path to play", rows.size() == 4 * 1001 and ticks == 2001, [rows.size(), ticks])
	var d := make_device()
	d.clamp = false
	check("a file's surfaces", d.load_gltf("res://plate_1d.glb") == 3)
	var forces: PackedFloat64Array = d.play_trace(rows, ticks)
	check("something is felt", largest_difference(forces, PackedFloat64Array(Array(forces).map(func(_f): return 0.0))) > 0.5)
	check("through Knurl's loader: the same bits", forces == expected, largest_difference(forces, expected))
	check("again: the same bits", d.play_trace(rows, ticks) == expected)
	d.free()
	d = make_device()
	d.clamp = false
	check("the engine's own meshes", build_plate() == 3)
	forces = d.play_trace(rows, ticks)
	var difference := largest_difference(forces, expected)
	print("note: the engine's own meshes: at most %s N off" % difference)
	check("through the engine's loader: within 1e-4 N", difference < 1e-4, difference)
	expect_error("t, x, y, z")
	check("rows of three are refused", d.play_trace(PackedFloat64Array([0, 0, 0]), 10).is_empty())
	expect_error("only the fake device takes a trace")
	d.device = "mouse"
	check("another device is refused", d.play_trace(rows, 10).is_empty())
	expect_error("that is stopped")
	d.start()
	check("a running device is refused", d.play_trace(rows, 10).is_empty() and d.running)
	clear()
