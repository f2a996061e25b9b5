extends "res://suite.gd"

# Warnings of surfaces that are not felt as they look or by their settings: by get_warnings(), which
# the editor shows beside a node, and in a game one line each when a device starts.


class Listener:
	extends Logger
	var lines: PackedStringArray = []

	func _log_error(_function: String, _file: String, _line: int, code: String, rationale: String, _notify: bool, type: int, _traces: Array) -> void:
		if type == ERROR_TYPE_WARNING:
			lines.append(code + rationale)


func gentle(mesh: Mesh, position := Vector3.ZERO) -> Node3D:
	var s := make_surface(mesh, position)
	s.grating.stiffness = 300.0
	s.grating.amplitude = 0.0001
	return s


func says(s: Node3D, part: String) -> void:
	var lines := Array(s.get_warnings()).filter(func(line: String) -> bool: return part in line)
	check("'%s' is said once" % part, lines.size() == 1, s.get_warnings())


# A game whose world is larger than the device's reach, and one that changes its scenes.
func tells_once() -> void:
	var listener := Listener.new()
	OS.add_logger(listener)
	for i in 20:
		var far := gentle(plate(0.05), Vector3(5, 0, 0))
		gentle(plate(0.05))
		var odd := gentle(plate(0.05), Vector3(0, 0.05, 0))
		odd.get_parent().name = "Odd"
		odd.get_parent().scale = Vector3(1, 1, 2)
		make_device("fake").start()
		await frames(1)
		says(far, "outside of the device's workspace")
		clear()
	check("20 scenes: what is wrong is told once, what is out of reach is not", listener.lines.size() == 1, listener.lines.size())
	listener.lines.clear()
	for i in 3:
		gentle(plate(0.05), Vector3(5, 0, 0))
		var d := make_device("fake")
		d.name = "Finger"
		d.start()
		await frames(1)
		clear()
	check("but if all of it is", listener.lines.size() == 1 and "none of the surfaces" in listener.lines[0], listener.lines.size())
	OS.remove_logger(listener)


func tests() -> void:
	await tells_once()
	await tells_what()


func tells_what() -> void:
	var listener := Listener.new()
	OS.add_logger(listener)
	var well := gentle(plate(0.05))
	var far := gentle(plate(0.05), Vector3(5, 0, 0))
	var hard := gentle(plate(0.05), Vector3(0.06, 0, 0))
	hard.grating.stiffness = 100000.0
	var away := gentle(plate(0.02), Vector3(0, 0.01, 0))
	away.position.x = 0.004
	var uneven := gentle(plate(0.02), Vector3(0, 0.02, 0))
	uneven.get_parent().scale = Vector3(1, 1, 2)
	var skinned := gentle(plate(0.02), Vector3(0, 0.03, 0))
	skinned.get_parent().skin = Skin.new()
	var can := CylinderMesh.new()
	can.top_radius = 0.05
	can.bottom_radius = 0.05
	can.height = 0.01
	var capped := gentle(can, Vector3(-0.05, 0, 0))
	capped.grating.spatial_frequency = Vector2(700, 700)
	var bare := plate(0.02)
	var arrays := bare.surface_get_arrays(0)
	arrays[Mesh.ARRAY_TEX_UV] = null
	bare.clear_surfaces()
	bare.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var aimless := gentle(bare, Vector3(0, 0.04, 0))
	var viewport := SubViewport.new()
	viewport.own_world_3d = true
	root.add_child(viewport)
	var apart := gentle(plate(0.02), Vector3(0, -0.03, 0))
	apart.get_parent().reparent(viewport)
	var soft := SoftBody3D.new()
	soft.mesh = plate(0.02)
	root.add_child(soft)
	var yielding: Node3D = gentle(plate(0.02))
	yielding.reparent(soft)
	var hidden := gentle(plate(0.02), Vector3(0, -0.02, 0))
	hidden.get_parent().visible = false
	var label := Label3D.new()
	root.add_child(label)
	var lost: Node3D = gentle(plate(0.02))
	lost.reparent(label)
	var d := make_device("fake")
	check("starts", d.start() == OK)
	await frames(2)
	check("nothing of what is well", well.get_warnings().is_empty(), well.get_warnings())
	says(far, "outside of the device's workspace")
	says(hard, "that stay stable")
	says(away, "4 mm off its parent")
	says(uneven, "scaled unevenly (1, 1, 2)")
	says(skinned, "skin or blend shapes")
	says(capped, "its uvs stretch: the 700/m along v")
	check("nor of a mesh without uvs", aimless.get_warnings().is_empty(), aimless.get_warnings())
	says(apart, "another World3D")
	says(yielding, "SoftBody3D")
	says(hidden, "Its parent is hidden")
	hidden.enabled = false
	check("but if it is switched off", hidden.get_warnings().is_empty(), hidden.get_warnings())
	says(lost, "Its parent is a Label3D")
	print("note: a cylinder: ", capped.get_warnings())
	var first := listener.lines.size()
	check("told when it starts, clamped or not", first == 9, listener.lines)
	check("of many the first", "further warnings" in listener.lines[-1], listener.lines)
	await seconds(0.3)
	check("and once", listener.lines.size() == first)
	OS.remove_logger(listener)
	clear()
