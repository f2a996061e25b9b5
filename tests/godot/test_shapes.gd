extends "res://suite.gd"

# Nodes other than MeshInstance3D: a wall of 400 N/m, 1 mm deep, gives 0.4 N for any source of
# triangles.


func surface_below(parent: Node3D) -> Node3D:
	var s: Node3D = ClassDB.instantiate(&"KnurlSurface")
	s.grating = ClassDB.instantiate(&"KnurlGrating")
	s.grating.amplitude = 0.0
	s.grating.spatial_frequency = Vector2.ZERO
	s.axis = Vector3(1, 0, 0)
	parent.add_child(s)
	return s


func press(at: Vector3) -> float:
	var d := make_device()
	var forces: PackedFloat64Array = d.play_trace(PackedFloat64Array([0, at.x, at.y + 0.01, at.z, 0.2, at.x, at.y, at.z]), 400)
	d.free()
	return forces[1198] if forces.size() == 1200 else NAN


func holds(what: String, s: Node3D, at: Vector3, expected := 0.4, tolerance := 1e-3) -> void:
	check("%s has nothing to say" % what, s.get_warnings().is_empty(), s.get_warnings())
	check_near("%s is felt" % what, press(at), expected, tolerance)


# The engine builds a CSG shape and a grid map's meshes at the end of a frame, and games paint grid maps later.
func made_with_the_device() -> void:
	var mesh := BoxMesh.new()
	mesh.size = Vector3.ONE * 0.02
	var csg := CSGBox3D.new()
	csg.size = mesh.size
	root.add_child(csg)
	var box := surface_below(csg)
	var grid := GridMap.new()
	grid.mesh_library = MeshLibrary.new()
	grid.mesh_library.create_item(0)
	grid.mesh_library.set_item_mesh(0, mesh)
	grid.cell_size = mesh.size
	root.add_child(grid)
	var tiles := surface_below(grid)
	var d := make_device()
	check("starts", d.start() == OK)
	await frames(3)
	check("a CSG shape made as the device starts", box.get_triangle_count() == 12, box.get_triangle_count())
	expect_error("its mesh has no triangles")
	await frames(20)
	check("an empty grid map is told once", not tiles.get_warnings().is_empty())
	grid.set_cell_item(Vector3i.ZERO, 0)
	await frames(3)
	check("painted, it is felt", tiles.get_triangle_count() == 12, tiles.get_triangle_count())
	check("and has nothing to say", tiles.get_warnings().is_empty(), tiles.get_warnings())
	clear()


# A plate of 0.1 m with one u and v over it, on a node that is scaled by 2 and 3.
func scale_of_uvs() -> void:
	var node := MeshInstance3D.new()
	var s := surface_below(node)
	check("nothing, no uvs", s.get_uv_scale() == Vector2.ZERO)
	node.mesh = plate(0.1)
	node.scale = Vector3(2, 1, 3)
	check("outside the tree, none", s.get_uv_scale() == Vector2.ZERO)
	root.add_child(node)
	check("on an axis, none", s.get_uv_scale() == Vector2.ZERO)
	s.axis = Vector3.ZERO
	var found: Vector2 = s.get_uv_scale()
	check_near("m for each u", found.x, 0.2, 1e-6)
	check_near("m for each v", found.y, 0.3, 1e-6)
	s.grating = null
	check("without a grating, none", s.get_uv_scale() == Vector2.ZERO)
	clear()


func tests() -> void:
	scale_of_uvs()
	await made_with_the_device()
	var csg := CSGBox3D.new()
	csg.size = Vector3(0.1, 0.02, 0.1)
	root.add_child(csg)
	var hole := CSGBox3D.new()
	hole.size = Vector3(0.02, 0.1, 0.02)
	hole.position.x = 0.03
	hole.operation = CSGShape3D.OPERATION_SUBTRACTION
	csg.add_child(hole)
	var carved := surface_below(csg)
	await frames(3)
	holds("a CSG shape", carved, Vector3(0, 0.009, 0))
	check_near("and its hole is not", press(Vector3(0.03, 0.009, 0)), 0.0, 1e-9)
	clear()

	var library := MeshLibrary.new()
	library.create_item(0)
	library.set_item_mesh(0, plate(0.1))
	var grid := GridMap.new()
	grid.mesh_library = library
	grid.cell_size = Vector3(0.1, 0.1, 0.1)
	grid.cell_center_y = false
	grid.set_cell_item(Vector3i(0, 0, 0), 0)
	grid.set_cell_item(Vector3i(2, 0, 0), 0)
	root.add_child(grid)
	var tiles := surface_below(grid)
	await frames(3)
	holds("a grid map's tile", tiles, Vector3(0.05, -0.001, 0.05))
	holds("and another", tiles, Vector3(0.25, -0.001, 0.05))
	check_near("but no gap between them", press(Vector3(0.15, -0.001, 0.05)), 0.0, 1e-9)
	clear()

	var shape := CollisionShape3D.new()
	shape.shape = plate(0.1).create_trimesh_shape()
	root.add_child(shape)
	holds("a collision shape of triangles", surface_below(shape), Vector3(0, -0.001, 0))
	shape.scale = Vector3(1, 1, -1)
	check_near("its front stays in front in a mirror", press(Vector3(0, -0.001, 0)), 0.4, 1e-3)
	clear()

	var many := MultiMeshInstance3D.new()
	many.multimesh = MultiMesh.new()
	many.multimesh.transform_format = MultiMesh.TRANSFORM_3D
	many.multimesh.mesh = plate(0.02)
	many.multimesh.instance_count = 3
	root.add_child(many)
	surface_below(many)
	var d := make_device()
	d.start()
	check("all instances of a multimesh", many.get_child(0).get_triangle_count() > 0, many.get_child(0).get_triangle_count())
	d.stop()
	clear()

	var box := BoxShape3D.new()
	box.size = Vector3(0.1, 0.02, 0.1)
	var ball := SphereShape3D.new()
	ball.radius = 0.02
	var rod := CylinderShape3D.new()
	rod.radius = 0.02
	rod.height = 0.04
	var pill := CapsuleShape3D.new()
	pill.radius = 0.02
	pill.height = 0.08
	for row: Array in [[box, 0.01], [ball, 0.02], [rod, 0.02], [pill, 0.04]]:
		var holder := CollisionShape3D.new()
		holder.shape = row[0]
		root.add_child(holder)
		holds("a %s" % row[0].get_class(), surface_below(holder), Vector3(0, row[1] - 0.001, 0), 0.4, 4e-3) # a round mesh has corners
		clear()

	var convex := CollisionShape3D.new()
	convex.shape = plate().create_convex_shape()
	root.add_child(convex)
	check("a convex shape is refused", "ConvexPolygonShape3D: expected a box" in " ".join(surface_below(convex).get_warnings()))
	clear()

	for row: Array in [[CollisionShape3D.new(), "ConcavePolygonShape3D"], [Label3D.new(), "Its parent is a Label3D"],
			[MultiMeshInstance3D.new(), "no multimesh"], [Node3D.new(), "Its parent is a Node3D"]]:
		root.add_child(row[0])
		var s := surface_below(row[0])
		check("%s is refused with a sentence" % row[0].get_class(), row[1] in " ".join(s.get_warnings()), s.get_warnings())
	clear()
