extends "res://suite.gd"

# A handler of any signal may free, remove, stop or start anything. Each signal (as it comes about) times each deed, in a
# scene of its own: a device below a holder, a second device, and a plate that both feel. run.sh has freed memory
# overwritten, so that its use is a crash here.
#
# The engine refuses to free an object that emits, or that a script is calling. With the node above it, it lets it pass;
# that one that emits was freed is an error then, of every engine object alike.

var scene: Node3D
var holder: Node3D
var device: Node3D
var other: Node3D
var surface: Node3D
var plate_node: Node3D

# Signals, and the device that brings them about.
var ways := {
	"touched": "mouse",
	"ridges_passed": "fake",
	"contact_started": "mouse",
	"button_changed": "fake:?press_at=0.05",
	"fault": "fake:?lose_at=0.05",
	"start_failed": "nonsense",
}

# Ends of a contact.
var ends := {
	"by switching it off": func() -> void: surface.enabled = false,
	"by stop()": func() -> void: device.stop(),
	"by removing the device": func() -> void: holder.remove_child(device),
	"by freeing the device's parent": func() -> void: holder.free(),
	"by removing the plate": func() -> void: scene.remove_child(plate_node),
	"by freeing the plate": func() -> void: plate_node.free(),
	"by freeing the scene": func() -> void: scene.free(),
}

var deeds := {
	"frees the device": func() -> void: free_with_parent(device),
	"frees the device's parent": func() -> void: free_it(holder),
	"frees the surface": func() -> void: free_with_parent(surface),
	"frees the plate": func() -> void: free_it(plate_node),
	"frees the other device": func() -> void: free_it(other),
	"frees the scene": func() -> void: free_it(scene),
	"removes the device": func() -> void: remove(device),
	"removes the plate": func() -> void: remove(plate_node),
	"stops": func() -> void:
		if is_instance_valid(device):
			device.stop(),
	"starts again": func() -> void:
		if is_instance_valid(device) and device.is_inside_tree() and device.device != "nonsense":
			device.stop()
			device.start(),
	"switches the surface off": func() -> void:
		if is_instance_valid(surface):
			surface.enabled = false,
	"changes the scene": func() -> void: change_scene_to_packed(next_scene()),
}

var emitter: Node3D
var locked := [] # objects that the engine refuses to free


func free_it(node: Variant) -> void:
	if is_instance_valid(node):
		node.free()


func free_with_parent(node: Variant) -> void:
	if not is_instance_valid(node) or node not in locked:
		free_it(node)
	elif node.get_parent():
		node.get_parent().free()


func remove(node: Variant) -> void:
	if is_instance_valid(node) and is_instance_valid(node.get_parent()):
		node.get_parent().remove_child(node)


func next_scene() -> PackedScene:
	var packed := PackedScene.new()
	var node := Node3D.new()
	packed.pack(node)
	node.free()
	return packed


func build(uri: String) -> void:
	scene = Node3D.new()
	holder = Node3D.new()
	device = make_device(uri, "line")
	other = make_device("mouse")
	surface = make_surface(plate())
	plate_node = surface.get_parent()
	device.autostart = uri == "nonsense"
	root.add_child(scene)
	current_scene = scene
	scene.add_child(holder)
	other.reparent(scene)
	plate_node.reparent(scene)
	device.reparent(holder)


# Moves both fingers, if they are mice, from above onto the plate. A handler may free them
# meanwhile.
func press() -> void:
	point(0.001)
	await until(func() -> bool: return mice().all(func(d: Node3D) -> bool: return d.ticks > 5))
	point(-0.001)


func point(height: float) -> void:
	for d: Node3D in mice():
		d.move_hip(Vector3(0, height, 0))


func mice() -> Array:
	var alive := [device, other].filter(func(d: Variant) -> bool: return is_instance_valid(d))
	return alive.filter(func(d: Node3D) -> bool: return d.device == "mouse" and d.running)


func dispose() -> void:
	current_scene = null
	for node: Variant in [scene, device, other, plate_node, surface]:
		if is_instance_valid(node):
			node.free()
	clear()


func play(name: String, signal_name: String, uri: String, end: Callable, deed: Callable) -> void:
	var calls := [0]
	var handler := func(_a: Variant = null, _b: Variant = null) -> void:
		calls[0] += 1
		if calls[0] == 1:
			deed.call()
			if not is_instance_valid(emitter):
				expect_error("was freed or unreferenced while a signal is being emitted from it")
	build(uri)
	emitter = surface if surface.has_signal(signal_name) else device
	locked = [emitter, device] if end == ends["by stop()"] else [emitter]
	if device.autostart:
		expect_error("found 'nonsense'")
	else:
		device.start()
	other.start()
	if end.is_valid():
		await press()
		var both := func() -> bool: return device.get_touched_surface() != null and other.get_touched_surface() != null
		check("%s: touched" % name, await until(both))
		emitter.connect(signal_name, handler)
	else:
		emitter.connect(signal_name, handler)
		await press()
	if end.is_valid():
		end.call()
	var is_told := func() -> bool: return calls[0] > 0 or not is_instance_valid(emitter)
	check("%s: is told" % name, await until(is_told, 2.0))
	await frames(3)
	if is_instance_valid(other) and other.is_inside_tree():
		var ticks: int = other.ticks
		check("%s: the other device goes on" % name, await until(func() -> bool: return other.ticks > ticks))
	dispose()


func tests() -> void:
	var only := OS.get_environment("KNURL_TEST_CELL") # to run only one, with its output
	for deed: String in deeds:
		for signal_name: String in ways:
			var name := "%s: %s" % [signal_name, deed]
			if only == "" or name == only:
				print("cell: ", name)
				await play(name, signal_name, ways[signal_name], Callable(), deeds[deed])
		for signal_name: String in ["released", "contact_ended"]:
			for end: String in ends:
				var name := "%s %s: %s" % [signal_name, end, deed]
				if only == "" or name == only:
					print("cell: ", name)
					await play(name, signal_name, "mouse", ends[end], deeds[deed])
