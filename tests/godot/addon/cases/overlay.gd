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
