extends "res://suite.gd"

# Many surfaces: their cost when they enter the tree and when a device starts, and a limit on logged
# errors. Bounds on times are a few times those of a desktop.

const MANY := 16000


# s that a branch of so many meshes takes to enter the tree and to leave it, with and without surfaces.
func enter(mesh: Mesh, grating: Resource, with_surfaces: bool) -> Array:
	var branch := Node3D.new()
	for i in MANY:
		var instance := MeshInstance3D.new()
		instance.mesh = mesh
		instance.position = Vector3(0.03 * (i % 126), -0.02, 0.03 * (i / 126))
		var child: Node3D = ClassDB.instantiate(&"KnurlSurface") if with_surfaces else Node3D.new()
		if with_surfaces:
			child.grating = grating
		instance.add_child(child)
		branch.add_child(instance)
	var begin := Time.get_ticks_usec()
	root.add_child(branch)
	var entered := 1e-6 * (Time.get_ticks_usec() - begin)
	return [branch, entered]


func tests() -> void:
	var grating: Resource = ClassDB.instantiate(&"KnurlGrating")
	grating.amplitude = 0.0001
	var mesh := plate(0.02)
	var plain: Array = enter(mesh, grating, false)
	plain[0].free()
	var all: Array = enter(mesh, grating, true)
	print("note: %d surfaces enter in %.3f s, as many plain nodes in %.3f s" % [MANY, all[1], plain[1]])
	check("entering costs little beside the engine's own", all[1] - plain[1] < 0.3, all[1] - plain[1])
	var d := make_device("fake")
	var begin := Time.get_ticks_usec()
	check("starts", d.start() == OK)
	print("note: a device starts with them in %.3f s" % (1e-6 * (Time.get_ticks_usec() - begin)))
	check("with all of them", d.get_status().surfaces == MANY, d.get_status().surfaces)
	await frames(3)
	begin = Time.get_ticks_usec()
	var more: Array = enter(mesh, grating, true)
	var built := Time.get_ticks_usec()
	await frames(2)
	print("note: as many more come while it runs in %.3f s" % (1e-6 * (Time.get_ticks_usec() - built) + more[1]))
	check("twice as many", d.get_status().surfaces == 2 * MANY, d.get_status().surfaces)
	begin = Time.get_ticks_usec()
	more[0].free()
	print("note: and go in %.3f s" % (1e-6 * (Time.get_ticks_usec() - begin)))
	check("gone", d.get_status().surfaces == MANY, d.get_status().surfaces)
	d.stop()
	all[0].free()
	var empty := ArrayMesh.new()
	for i in 100:
		make_surface(empty)
	for i in 3:
		expect_error("its mesh has no triangles")
	expect_error("97 further surfaces are not felt")
	d.start()
	clear()
