extends "res://suite.gd"

# Copies of a mesh share its shape in a device's scene: it is read, and its tree built, once for each
# scale. Edits of a mesh reach all copies, those of one copy none of the others.

const COPIES := 200


func sphere(segments: int) -> ArrayMesh:
	var ball := SphereMesh.new()
	ball.radius = 0.02
	ball.height = 0.04
	ball.radial_segments = segments
	ball.rings = segments / 2 - 1
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, ball.get_mesh_arrays())
	return mesh


# Milliseconds until copies of a mesh that enter the tree together are felt, and bytes of the scene.
func pool(d: Node3D, mesh: Mesh, own: bool) -> Array:
	var before: int = d.get_status().scene_bytes
	for i in COPIES:
		make_surface(mesh.duplicate() if own else mesh, Vector3(0.05 * (i % 20), 0, 0.05 * (i / 20)))
	var begin := Time.get_ticks_usec()
	d.notification(Node.NOTIFICATION_INTERNAL_PROCESS)
	var time := float(Time.get_ticks_usec() - begin) / 1000.0
	check("all are felt", d.get_status().surfaces == COPIES, d.get_status().surfaces)
	var bytes: int = d.get_status().scene_bytes - before
	for child in root.get_children():
		if child != d:
			root.remove_child(child)
			child.free()
	await frames(3)
	return [time, bytes]


func smooth_surface(mesh: Mesh, at: Vector3) -> Node3D:
	var s := make_surface(mesh, at)
	s.grating.spatial_frequency = Vector2.ZERO
	s.grating.amplitude = 0.0
	return s


# Height of the first hit of a ray from above.
func height(d: Node3D, x: float) -> float:
	var hit: Dictionary = d.cast_ray(Vector3(x, 0.1, 0), Vector3(x, -0.1, 0))
	return hit.position.y if not hit.is_empty() else -1.0


func lift(mesh: ArrayMesh, y: float) -> void:
	var arrays := plate(0.05).surface_get_arrays(0)
	var places: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	for i in places.size():
		places[i].y = y
	arrays[Mesh.ARRAY_VERTEX] = places
	mesh.clear_surfaces()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)


func tests() -> void:
	var d := make_device("fake")
	check("starts", d.start() == OK)
	await frames(2)
	var ball := sphere(24)
	var own: Array = await pool(d, ball, true)
	var shared: Array = await pool(d, ball, false)
	print("note: %d copies of %d triangles: %.1f ms, %.1f MB as meshes of their own; %.1f ms, %.2f MB as one mesh" % [
		COPIES, ball.surface_get_array_index_len(0) / 3, own[0], 1e-6 * own[1], shared[0], 1e-6 * shared[1]])
	check("one mesh takes a tenth of the memory", shared[1] < 0.1 * own[1], [shared[1], own[1]])

	var mesh := ArrayMesh.new()
	lift(mesh, 0.0)
	var all := []
	for i in 3:
		all.append(smooth_surface(mesh, Vector3(0.1 * i, 0, 0)))
	await frames(2)
	check("copies are where they are", absf(height(d, 0.1)) < 1e-6 and absf(height(d, 0.2)) < 1e-6)
	lift(mesh, 0.01)
	var late := smooth_surface(mesh, Vector3(0.3, 0, 0)) # before the others have been read again
	await frames(2)
	for i in 4:
		check("an edit reaches copy %d" % i, absf(height(d, 0.1 * i) - 0.01) < 1e-6, height(d, 0.1 * i))
	all[1].get_parent().scale = Vector3(1, 2, 1)
	await frames(2)
	check("another scale is another shape", absf(height(d, 0.1) - 0.02) < 1e-6, height(d, 0.1))
	check("of that copy alone", absf(height(d, 0.2) - 0.01) < 1e-6, height(d, 0.2))
	var other := ArrayMesh.new()
	lift(other, 0.03)
	all[0].get_parent().mesh = other
	await frames(2)
	check("another mesh is felt", absf(height(d, 0.0) - 0.03) < 1e-6, height(d, 0.0))
	check("by that copy alone", absf(height(d, 0.2) - 0.01) < 1e-6, height(d, 0.2))
	all[2].get_parent().free()
	await frames(2)
	check("a freed copy takes its own with it", height(d, 0.2) == -1.0 and absf(height(d, 0.3) - 0.01) < 1e-6)
	late.double_sided = true
	await frames(2)
	check("sides are a copy's own", d.cast_ray(Vector3(0.3, -0.1, 0), Vector3(0.3, 0.1, 0)).size() > 0)
	d.stop()
	check("starts again", d.start() == OK)
	check("with all of them", absf(height(d, 0.3) - 0.01) < 1e-6 and absf(height(d, 0.1) - 0.02) < 1e-6)
	clear()
