# Base of all test scripts: counts checks, waits for frames, strokes scenes. A script overrides
# `tests()`, or `benchmark()`; run.sh reads the closing line.
extends SceneTree

var passed := 0
var failed := 0


func check(what: String, holds: bool, found: Variant = null) -> void:
	if holds:
		passed += 1
	else:
		failed += 1
		printerr("FAIL: ", what, "" if found == null else "; found %s" % [found])


func check_near(what: String, found: float, expected: float, tolerance: float) -> void:
	check(what, absf(found - expected) <= tolerance, "%s instead of %s" % [found, expected])


# Announces an error: run.sh ignores one line with this text.
func expect_error(part: String) -> void:
	print("expected error: ", part)


func frames(count: int) -> void:
	for i in count:
		await process_frame


# Waits for something to become true, for so many seconds at most.
func until(what: Callable, seconds := 5.0) -> bool:
	var end := Time.get_ticks_msec() + int(1000.0 * seconds)
	while not what.call():
		if Time.get_ticks_msec() > end:
			return false
		await process_frame
	return true


func seconds(duration: float) -> void:
	var end := Time.get_ticks_usec() + int(1e6 * duration)
	while Time.get_ticks_usec() < end:
		await process_frame


# A square of `size` m in the xz plane that faces up, with u along x and v along -z, as the glTF loader would see it.
func plate(size := 0.1) -> ArrayMesh:
	var h := 0.5 * size
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = PackedVector3Array([Vector3(-h, 0, h), Vector3(h, 0, h), Vector3(h, 0, -h), Vector3(-h, 0, -h)])
	arrays[Mesh.ARRAY_TEX_UV] = PackedVector2Array([Vector2(0, 1), Vector2(1, 1), Vector2(1, 0), Vector2(0, 0)])
	arrays[Mesh.ARRAY_INDEX] = PackedInt32Array([0, 2, 1, 0, 3, 2]) # clockwise, seen from above
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh


# A MeshInstance3D in the tree with a KnurlSurface below it, which is returned.
func make_surface(mesh: Mesh, position := Vector3.ZERO) -> Node3D:
	var instance := MeshInstance3D.new()
	instance.name = "Plate"
	instance.mesh = mesh
	instance.position = position
	var surface: Node3D = ClassDB.instantiate(&"KnurlSurface")
	surface.grating = ClassDB.instantiate(&"KnurlGrating")
	instance.add_child(surface)
	root.add_child(instance)
	return surface


# A KnurlDevice in the tree that does not start by itself.
func make_device(uri := "fake", stroke := "") -> Node3D:
	var device: Node3D = ClassDB.instantiate(&"KnurlDevice")
	device.device = uri
	device.stroke = stroke
	device.autostart = false
	root.add_child(device)
	return device


func clear() -> void:
	for child in root.get_children():
		root.remove_child(child)
		child.free()


func tests() -> void:
	pass


func _initialize() -> void:
	run.call_deferred()


func run() -> void:
	check("the extension is loaded", ClassDB.class_exists(&"KnurlDevice"))
	if failed == 0:
		await tests()
	print("%d passed, %d failed" % [passed, failed])
	quit(1 if failed > 0 else 0)


func count(folder: String) -> int:
	var dir := DirAccess.open(folder)
	return dir.get_directories().size() + dir.get_files().size() if dir else -1
