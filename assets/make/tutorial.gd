extends SceneTree
## The last step of docs/tutorial.md: a scene with the imported model and a device whose hand strokes
## it, a picture, and the ridges that were felt.

const SECONDS := 3.0


func _initialize() -> void:
	var stage := Node3D.new()
	root.add_child(stage)
	var model: Node3D = load("res://model.glb").instantiate()
	stage.add_child(model)
	var camera := Camera3D.new()
	stage.add_child(camera)
	camera.look_at_from_position(Vector3(0.02, 0.06, 0.085), Vector3.ZERO)
	camera.near = 0.01
	camera.fov = 45.0
	var light := DirectionalLight3D.new()
	light.rotation = Vector3(-0.9, -0.5, 0.0)
	stage.add_child(light)
	var device: Node3D = ClassDB.instantiate(&"KnurlDevice")
	device.stroke = "sweep"
	stage.add_child(device)
	load("res://addons/knurl/overlay.gd").set_shown(root, true)
	await create_timer(SECONDS).timeout
	var file := FileAccess.open("res://felt.txt", FileAccess.WRITE)
	for surface: Node in model.find_children("*", "KnurlSurface", true, false):
		var felt: float = device.get_status()["half_cycles_crossed"] / 2.0
		file.store_line("%s ridges per metre: %d ridges felt" % [surface.grating.spatial_frequency.x, felt])
	root.get_texture().get_image().save_png("res://picture.png")
	quit()
