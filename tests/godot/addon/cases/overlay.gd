extends SceneTree
## The overlay as drawn: stripes at the ridges of Eq. 11, on uvs and on an axis, turned, as a grid;
## and removed completely. A camera looks straight down on a square plate, a known number of
## pixels to the millimetre.

const PIXELS_PER_MM := 10.0
const HEIGHT := 360  # pixels of the window
const PLATE := 0.03  # m
const DARK := Color.BLACK
const BRIGHT := Color.WHITE

var checks: RefCounted
var overlay: GDScript
var plate := MeshInstance3D.new()
var surface: Node3D


func _initialize() -> void:
	checks = load("res://checks.gd").new()
	overlay = load("res://addons/knurl/overlay.gd")
	build_stage()
	await run()
	checks.finish(self)


func build_stage() -> void:
	var camera := Camera3D.new()
	camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	camera.size = HEIGHT / PIXELS_PER_MM * 1e-3
	camera.position = Vector3(0.0, 0.1, 0.0)
	camera.rotation.x = -0.5 * PI  # looks along -y; the picture's right is +x, its upper edge -z
	camera.near = 0.01
	root.add_child(camera)
	var mesh := PlaneMesh.new()
	mesh.size = Vector2(PLATE, PLATE)
	var grey := StandardMaterial3D.new()
	grey.albedo_color = Color(0.5, 0.5, 0.5)
	grey.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	mesh.material = grey
	plate.mesh = mesh
	root.add_child(plate)
	surface = ClassDB.instantiate(&"KnurlSurface")
	surface.grating = ClassDB.instantiate(&"KnurlGrating")
	plate.add_child(surface)


func run() -> void:
	var before: Image = await picture()
	overlay.set_shown(root, true)
	await process_frame
	var drawn: Node = overlay.find_on(surface)
	checks.check(drawn != null, "there is an overlay")
	checks.check(surface.get_children().is_empty(), "which is no child that is saved")
	drawn._material.set_shader_parameter(&"ridge", BRIGHT)
	drawn._material.set_shader_parameter(&"groove", DARK)
	# A plane's uvs run from 0 to 1 over its size, so the coordinates start at its corner.
	var corner := Vector2(0.5 * PLATE, 0.5 * PLATE)
	await expect("ridges of 2 mm", Vector2(500, 0), 0.0, Vector3.ZERO, corner)
	await expect("ridges across", Vector2(0, 400), 0.0, Vector3.ZERO, corner)
	await expect("a grid", Vector2(300, 200), 0.0, Vector3.ZERO, corner)
	await expect("a turned grid", Vector2(300, 200), 0.6, Vector3.ZERO, corner)
	await expect("on an axis", Vector2(500, 0), 0.0, Vector3(2, 0, 0), Vector2.ZERO)
	await expect(
		"on an axis that is turned", Vector2(250, 400), 0.3, Vector3(1, 0, 1), Vector2.ZERO
	)
	plate.scale = Vector3(0.5, 1.0, 0.8)
	await expect(
		"on a plate that is scaled",
		Vector2(600, 400),
		0.0,
		Vector3.ZERO,
		corner * Vector2(0.5, 0.8)
	)
	await expect("scaled, on an axis", Vector2(600, 400), 0.2, Vector3(1, 0, 0), Vector2.ZERO)
	plate.scale = Vector3.ONE
	await expect_fade()
	root.remove_child(plate)
	await expect_others()
	root.add_child(plate)
	await expect_off(before)


## Every pixel of the plate further than one pixel from an edge is bright if Eq. 11 is +A, otherwise
## dark.
func expect(
	what: String, frequency: Vector2, orientation: float, axis: Vector3, corner: Vector2
) -> void:
	surface.grating.spatial_frequency = frequency
	surface.grating.orientation = orientation
	surface.axis = axis
	var image: Image = await picture()
	var middle := Vector2(image.get_width(), image.get_height()) * 0.5
	var half: Vector2 = 0.5 * PLATE * Vector2(plate.scale.x, plate.scale.z) * 0.95
	var wrong := 0
	var seen := 0
	for row: int in range(0, image.get_height(), 3):
		for column: int in range(0, image.get_width(), 3):
			var p: Vector2 = (Vector2(column + 0.5, row + 0.5) - middle) * 1e-3 / PIXELS_PER_MM  # x, z
			if absf(p.x) > half.x or absf(p.y) > half.y:
				continue
			var cycles: Vector2 = coordinates(p, axis, corner).rotated(-orientation) * frequency
			if near_edge(cycles, frequency):
				continue
			seen += 1
			var high: bool = cos(TAU * cycles.x) * cos(TAU * cycles.y) >= 0.0
			if (image.get_pixel(column, row).g > 0.5) != high:
				wrong += 1
	checks.check(seen > 500, "%s: enough is looked at (%d)" % [what, seen])
	checks.equal(wrong, 0, "%s: pixels of %d that are not as Eq. 11 has them" % [what, seen])


## m along x and y = n x x, as the design has them: n is +y here, and the world's z runs down the
## picture.
func coordinates(p: Vector2, axis: Vector3, corner: Vector2) -> Vector2:
	if axis == Vector3.ZERO:
		return Vector2(p.x + corner.x, -(p.y + corner.y))  # v runs down: y against it
	var along: Vector3 = (plate.global_basis * axis).normalized()
	var y: Vector3 = Vector3.UP.cross(along)
	var place := Vector3(p.x, 0.0, p.y)
	return Vector2(place.dot(along), place.dot(y))


func near_edge(cycles: Vector2, frequency: Vector2) -> bool:
	for i: int in 2:
		var pixels: float = (
			absf(fposmod(cycles[i], 0.5) - 0.25) / maxf(frequency[i], 1e-6) * 1e3 * PIXELS_PER_MM
		)
		if frequency[i] > 0.0 and pixels < 1.5:
			return true
	return false


## Ridges finer than a pixel are grey and do not alias.
func expect_fade() -> void:
	surface.grating.spatial_frequency = Vector2(33333, 0)
	surface.grating.orientation = 0.0
	surface.axis = Vector3.ZERO
	var image: Image = await picture()
	var low := 1.0
	var high := 0.0
	@warning_ignore("integer_division")
	for column: int in range(image.get_width() / 2 - 50, image.get_width() / 2 + 50):
		@warning_ignore("integer_division")
		var value: float = image.get_pixel(column, image.get_height() / 2).g
		low = minf(low, value)
		high = maxf(high, value)
	checks.check(high - low < 0.4, "ridges of 0.3 pixels do not alias (%.2f to %.2f)" % [low, high])


## Nodes other than mesh instances: as many ridges are drawn as are felt, and as there are.
func expect_others() -> void:
	var many := MultiMeshInstance3D.new()
	var plane := PlaneMesh.new()
	plane.size = Vector2(0.008, 0.008)
	many.multimesh = MultiMesh.new()
	many.multimesh.transform_format = MultiMesh.TRANSFORM_3D
	many.multimesh.mesh = plane
	many.multimesh.instance_count = 2
	many.multimesh.set_instance_transform(0, Transform3D(Basis(), Vector3(-0.01, 0, 0)))
	many.multimesh.set_instance_transform(
		1, Transform3D(Basis.from_scale(2 * Vector3.ONE), Vector3(0.005, 0, 0))
	)
	show_ridges(many, Vector2(1000, 0))
	await expect_ridges("a small instance", -0.0135, -0.0065, 7.0)
	await expect_ridges("a large one of the same multimesh", -0.002, 0.012, 14.0)
	var box := CSGBox3D.new()
	box.size = Vector3(0.02, 0.02, 0.02)
	box.position.y = -0.01
	many.free()
	show_ridges(box, Vector2(0, 1000))  # v runs along x on its top
	await expect_ridges("a CSG box", -0.009, 0.009, 18.0)
	box.free()
	await expect_stretched()
	await expect_cells()


func tile(size: Vector2, offset: float, uv_factor: float) -> Array:
	var plane := PlaneMesh.new()
	plane.size = size
	plane.center_offset.x = offset
	var arrays: Array = plane.get_mesh_arrays()
	for i: int in arrays[Mesh.ARRAY_TEX_UV].size():
		arrays[Mesh.ARRAY_TEX_UV][i] *= uv_factor
	return arrays


## A small triangle with stretched uvs does not change the ridges of the rest: it would change the mean.
func expect_stretched() -> void:
	var node := MeshInstance3D.new()
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, tile(Vector2(0.02, 0.02), 0.0, 1.0))
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, tile(Vector2(0.002, 0.02), 0.012, 1e-4))
	node.mesh = mesh
	show_ridges(node, Vector2(1000, 0))
	await expect_ridges("a plate beside a stretched strip", -0.009, 0.009, 18.0)
	node.free()


## A grid map of two meshes, one of which has twice as many metres per u: Knurl feels their mean,
## 0.012 m for each u of both. Then a cell is painted, as a game does.
func expect_cells() -> void:
	var grid := GridMap.new()
	grid.mesh_library = MeshLibrary.new()
	grid.cell_size = Vector3(0.008, 0.008, 0.008)
	for item: int in 2:
		var mesh := ArrayMesh.new()
		var arrays: Array = tile(Vector2(0.008, 0.008), 0.0, 1.0 if item == 0 else 0.5)
		mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
		grid.mesh_library.create_item(item)
		grid.mesh_library.set_item_mesh(item, mesh)
	grid.position.y = -0.004
	grid.set_cell_item(Vector3i(-1, 0, 0), 0)
	grid.set_cell_item(Vector3i(0, 0, 0), 1)
	var before: Image = await picture()
	show_ridges(grid, Vector2(1000, 0))
	await expect_ridges("a cell", -0.0076, -0.0004, 10.8)
	await expect_ridges("a cell of another mesh", 0.0004, 0.0076, 5.4)
	grid.position.x = 0.004
	await expect_ridges("a cell of a map that was moved", -0.0036, 0.0036, 10.8)
	grid.position.x = 0.0
	grid.set_cell_item(Vector3i(1, 0, 0), 0)
	await create_timer(0.3).timeout  # the overlay looks four times a second
	await expect_ridges("a cell that is painted", 0.0084, 0.0156, 9.6)
	grid.visible = false
	checks.check((await picture()).get_data() == before.get_data(), "a hidden map has no ridges")
	grid.free()


func show_ridges(node: Node3D, frequency: Vector2) -> void:
	var felt: Node3D = ClassDB.instantiate(&"KnurlSurface")
	felt.grating = ClassDB.instantiate(&"KnurlGrating")
	felt.grating.spatial_frequency = frequency
	node.add_child(felt)
	root.add_child(node)
	overlay.set_shown(root, true)


## Ridges along x, from one place to another.
func expect_ridges(what: String, from: float, to: float, expected: float) -> void:
	var image: Image = await picture()
	var drawn: Array[float] = []
	@warning_ignore("integer_division")
	for column: int in range(to_column(image, from), to_column(image, to)):
		@warning_ignore("integer_division")
		drawn.append(image.get_pixel(column, image.get_height() / 2).g)
	checks.close(0.5 * crossings(drawn), expected, 1.0, "%s: ridges that are drawn" % what)
	var device: Node3D = ClassDB.instantiate(&"KnurlDevice")
	device.autostart = false
	device.device = "fake"
	root.add_child(device)
	var rows: PackedFloat64Array = [
		0.0, from, 0.004, 0.001, 0.2, from, -0.0005, 0.001, 1.2, to, -0.0005, 0.001
	]
	var forces: PackedFloat64Array = device.play_trace(rows, 1190)
	var pushed: Array[float] = []
	for i: int in range(210, 1190):
		pushed.append(forces[3 * i + 1])
	checks.close(0.5 * crossings(pushed), expected, 1.0, "%s: ridges that are felt" % what)
	root.remove_child(device)
	device.free()


func to_column(image: Image, x: float) -> int:
	return roundi(0.5 * image.get_width() + x * 1e3 * PIXELS_PER_MM)


## How often values cross the middle of their range.
func crossings(values: Array[float]) -> int:
	var middle: float = 0.5 * (values.min() + values.max())
	var count := 0
	for i: int in range(1, values.size()):
		count += 1 if (values[i] > middle) != (values[i - 1] > middle) else 0
	return count


func expect_off(before: Image) -> void:
	overlay.set_shown(root, false)
	var after: Image = await picture()
	checks.check(overlay.find_on(surface) == null, "the overlay is gone")
	checks.check(after.get_data() == before.get_data(), "what was drawn before is drawn again")
	checks.check(plate.material_overlay == null, "the mesh kept its own overlay")
	var own := StandardMaterial3D.new()
	own.albedo_color = Color.RED
	own.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	plate.material_overlay = own
	var red: Image = await picture()
	overlay.set_shown(root, true)
	await picture()
	overlay.set_shown(root, false)
	checks.check(
		(await picture()).get_data() == red.get_data(), "a user's overlay is drawn as before"
	)
	overlay.set_shown(root, true)
	await picture()
	plate.remove_child(surface)
	checks.check(
		(await picture()).get_data() == red.get_data(),
		"a surface that leaves takes its overlay along"
	)
	surface.free()


func picture() -> Image:
	for i: int in 3:
		await RenderingServer.frame_post_draw
	return root.get_texture().get_image()
