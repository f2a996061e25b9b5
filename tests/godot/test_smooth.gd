extends "res://suite.gd"

# Round meshes of the engine, pressed 1 mm deep into a wall of 400 N/m: 0.4 N along the normal of the round form.

const DEPTH := 0.001
const RADIUS := 0.02


func surface_below(parent: Node3D, smooth: int) -> Node3D:
	var s: Node3D = ClassDB.instantiate(&"KnurlSurface")
	s.grating = ClassDB.instantiate(&"KnurlGrating")
	s.grating.amplitude = 0.0
	s.grating.spatial_frequency = Vector2.ZERO
	s.axis = Vector3(1, 0, 0)
	s.smooth = smooth
	parent.add_child(s)
	return s


func press(at: Vector3, normal: Vector3) -> Vector3:
	var d := make_device()
	var from := at + 0.01 * normal
	var to := at - DEPTH * normal
	var forces: PackedFloat64Array = d.play_trace(PackedFloat64Array([0, from.x, from.y, from.z, 0.2, to.x, to.y, to.z]), 400)
	d.free()
	return Vector3(forces[1197], forces[1198], forces[1199]) if forces.size() == 1200 else Vector3.ZERO


func ball() -> SphereMesh:
	var mesh := SphereMesh.new()
	mesh.radius = RADIUS
	mesh.height = 2.0 * RADIUS
	mesh.radial_segments = 24
	mesh.rings = 11
	return mesh


# Between the vertices: half a segment round, half a ring up.
func direction() -> Vector3:
	var a := TAU / 48.0
	var up := PI / 24.0
	return Vector3(sin(a) * cos(up), sin(up), cos(a) * cos(up))


# The force of a node's shape, with the scale that was set on it.
func force_of(node: Node3D, smooth: int, scale := Vector3.ONE) -> Vector3:
	node.scale = scale
	root.add_child(node)
	var s := surface_below(node, smooth)
	var found := press(direction() * RADIUS * scale, (direction() / scale).normalized())
	check("nothing to say, but that it is uneven", s.get_warnings().size() <= (0 if scale.abs() == Vector3.ONE else 1), s.get_warnings())
	clear()
	return found


func drawn() -> Node3D:
	var node := MeshInstance3D.new()
	node.mesh = ball()
	return node


func collider() -> Node3D:
	var node := CollisionShape3D.new()
	node.shape = ball().create_trimesh_shape()
	return node


func tests() -> void:
	var auto: int = 0
	var off: int = 1
	var on: int = 2
	check("its constants", ClassDB.class_get_integer_constant(&"KnurlSurface", &"SMOOTH_OFF") == off
			and ClassDB.class_get_integer_constant(&"KnurlSurface", &"SMOOTH_ON") == on)
	var round_force := force_of(drawn(), auto)
	check_near("a sphere is felt as round as it looks", round_force.length(), 0.4, 0.005) # of 24 segments: 1 %
	check_near("along its normal", round_force.normalized().angle_to(direction()), 0.0, 0.002)
	# The middle of a quad's diagonal is R cos(half of the angle between its ends) from the centre.
	var ends: Array[Vector3] = []
	for up: float in [0.0, PI / 12.0]:
		ends.append(Vector3(0, sin(up), cos(up)).rotated(Vector3.UP, TAU / 24.0 if up == 0.0 else 0.0))
	var sagitta := RADIUS * (1.0 - cos(0.5 * ends[0].angle_to(ends[1])))
	var flat_force := force_of(drawn(), off)
	check_near("off: as its triangles", flat_force.length(), 400.0 * (DEPTH - sagitta), 0.02)
	check_near("a collision shape has no normals", force_of(collider(), auto).length(), flat_force.length(), 0.02)
	check_near("on: they are computed", force_of(collider(), on).length(), 0.4, 0.008)
	for scale: Vector3 in [Vector3(2, 1, 1), Vector3(1, 1, -1), Vector3(-1.5, 1, 0.7)]:
		var found := force_of(drawn(), auto, scale)
		check_near("scaled by %s" % scale, found.length(), 0.4, 0.008)
		check_near("its normal", found.normalized().angle_to((direction() / scale).normalized()), 0.0, 0.02)
