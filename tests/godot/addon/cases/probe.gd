@tool
extends EditorPlugin
## Checks Knurl's plugin from inside the editor: button, gizmo, warnings; then ends it. Not during
## an import.

const FOLDER := "res://addons/knurl/"

var checks: RefCounted


func _enter_tree() -> void:
	if not OS.get_cmdline_args().has("--import"):
		probe.call_deferred()


func probe() -> void:
	checks = load("res://addons/probe/checks.gd").new()
	while EditorInterface.get_resource_filesystem().is_scanning():
		await get_tree().process_frame
	await get_tree().create_timer(1.0).timeout
	checks.check(EditorInterface.is_plugin_enabled("knurl"), "the plugin is on")
	EditorInterface.open_scene_from_path("res://stage.tscn")
	await get_tree().create_timer(0.5).timeout
	var stage: Node = EditorInterface.get_edited_scene_root()
	checks.check(stage != null, "the scene is open")
	if stage != null:
		probe_button(stage)
		probe_gizmo(stage.get_node("KnurlDevice"))
		probe_rows(stage.get_node("KnurlDevice"))
		await probe_help()
		await probe_warnings(stage.get_node("KnurlSurface"))
		await probe_materials()
		await probe_limits(stage)
		await probe_paint(stage)
		checks.equal(
			stage.get_node("KnurlDevice").get("running"), false, "no device runs in the editor"
		)
	checks.finish(get_tree())


func probe_button(stage: Node) -> void:
	var overlay: GDScript = load(FOLDER + "overlay.gd")
	var surface: Node = stage.get_node("Plate/KnurlSurface")
	var base: Control = EditorInterface.get_base_control()
	var buttons: Array[Node] = base.find_children("*", "Button", true, false).filter(
		func(button: Node) -> bool: return (button as Button).text == "Gratings"
	)
	checks.equal(buttons.size(), 1, "buttons")
	if buttons.size() != 1:
		return
	buttons[0].button_pressed = true
	checks.check(overlay.find_on(surface) != null, "the button draws")
	var packed := PackedScene.new()
	packed.pack(stage)
	checks.check(
		not packed.get_state().get_node_name(packed.get_state().get_node_count() - 1).contains(
			"Overlay"
		),
		"what it draws is not saved"
	)
	buttons[0].button_pressed = false
	checks.check(overlay.find_on(surface) == null, "and takes it off")


func probe_gizmo(device: Node3D) -> void:
	checks.check(device.get_gizmos().size() >= 1, "the device has a gizmo")
	var gizmo: GDScript = load(FOLDER + "gizmo.gd")
	checks.equal(
		gizmo.workspace_of(device), 2.0 * Vector3(0.16, 0.12, 0.07), "its workspace, scaled by 2"
	)
	checks.equal(gizmo.edges_of(AABB(Vector3.ZERO, Vector3.ONE)).size(), 24, "a box has 12 edges")


## Properties that exist only in games have no row.
func probe_rows(device: Node) -> void:
	for property: Dictionary in device.get_property_list():
		if property.name in ["force", "running", "ticks", "hip_position"]:
			checks.equal(property.usage & PROPERTY_USAGE_EDITOR, 0, "rows for " + property.name)


func probe_help() -> void:
	EditorInterface.get_script_editor().goto_help("class_name:KnurlDevice")
	await get_tree().create_timer(1.0).timeout
	var pages: Array[Node] = EditorInterface.get_script_editor().find_children(
		"*", "RichTextLabel", true, false
	)
	var texts: Array = pages.map(func(page: Node) -> String: return page.get_parsed_text()).filter(
		func(text: String) -> bool: return "Runs a haptic thread" in text
	)
	checks.equal(texts.size(), 1, "pages of KnurlDevice")
	for text: String in texts:
		checks.check("\tA game that is paused" not in text, "no paragraph is indented by tabs")


func probe_warnings(surface: Node) -> void:
	EditorInterface.inspect_object(surface)
	await get_tree().create_timer(1.5).timeout
	var warning: String = surface.get_warnings()[0]
	var inspector: Control = EditorInterface.get_inspector()
	var labels: Array[Node] = inspector.find_children("*", "Label", true, false).filter(
		func(label: Node) -> bool: return (label as Label).text == warning
	)
	checks.equal(labels.size(), 1, "the inspector shows '%s'" % warning)


func probe_materials() -> void:
	var grating: Resource = ClassDB.instantiate(&"KnurlGrating")
	EditorInterface.edit_resource(grating)
	await get_tree().create_timer(0.5).timeout
	var buttons: Array[Node] = EditorInterface.get_inspector().find_children("*", "MenuButton", true, false).filter(
		func(button: Node) -> bool: return (button as MenuButton).text == "Everyday Material"
	)
	checks.equal(buttons.size(), 1, "buttons for everyday materials")
	var menu: PopupMenu = (buttons[0] as MenuButton).get_popup()
	checks.equal(menu.item_count, 29, "everyday materials")
	for index: int in menu.item_count:
		if menu.get_item_text(index) == "Metal file, coarse":
			checks.check("a guess (files have" in menu.get_item_tooltip(index), "a guess is called one")
			menu.index_pressed.emit(index)
	checks.equal(grating.spatial_frequency, Vector2(984.25, 0), "the file's ridges")
	checks.check(is_equal_approx(grating.orientation, 0.4363), "the file's direction")
	var undo: EditorUndoRedoManager = EditorInterface.get_editor_undo_redo()
	undo.get_history_undo_redo(undo.get_object_history_id(grating)).undo()
	checks.equal(grating.spatial_frequency, Vector2(1000, 0), "the ridges after undo")
	checks.equal(grating.orientation, 0.0, "the direction after undo")


## No device runs here: surfaces are checked against the presets of the scene's devices.
func probe_limits(stage: Node) -> void:
	var device: Node3D = ClassDB.instantiate(&"KnurlDevice")
	device.device = "touch"
	stage.add_child(device)
	var mesh := MeshInstance3D.new()
	var plane := PlaneMesh.new()
	plane.size = Vector2(0.05, 0.05)
	mesh.mesh = plane
	var surface: Node3D = ClassDB.instantiate(&"KnurlSurface")
	var grating: Resource = ClassDB.instantiate(&"KnurlGrating")
	grating.stiffness = 300.0
	grating.amplitude = 0.0001
	surface.grating = grating
	mesh.add_child(surface)
	stage.add_child(mesh)
	mesh.position = device.position
	checks.equal(Array(warnings_of(surface, device)), [], "nothing of what is well")
	grating.stiffness = 100000.0
	checks.check("N/m" in " ".join(warnings_of(surface, device)), "too stiff for a Touch")
	grating.stiffness = 300.0
	mesh.position.x += 5.0
	checks.check(
		"outside of the device's workspace" in " ".join(warnings_of(surface, device)),
		"out of reach of a Touch"
	)
	device.workspace_scale = 100.0
	checks.check(
		not "outside" in " ".join(warnings_of(surface, device)), "a larger workspace reaches it"
	)
	device.workspace_scale = 1.0
	mesh.position.x -= 5.0
	var can := CylinderMesh.new()
	can.top_radius = 0.05
	can.bottom_radius = 0.05
	can.height = 0.01
	mesh.mesh = can
	grating.spatial_frequency = Vector2(700, 700)
	checks.check("along v" in " ".join(surface.get_warnings()), "stretches along v are told as well")
	device.device = "tuch"
	checks.check(
		"expected auto, fake" in " ".join(device.get_warnings()), "a misspelt device"
	)
	mesh.free()
	device.free()
	await get_tree().process_frame


## A grid map is empty until something is painted.
func probe_paint(stage: Node) -> void:
	var mesh := BoxMesh.new()
	mesh.size = Vector3(0.02, 0.02, 0.02)
	var grid := GridMap.new()
	grid.mesh_library = MeshLibrary.new()
	grid.mesh_library.create_item(0)
	grid.mesh_library.set_item_mesh(0, mesh)
	grid.cell_size = mesh.size
	var surface: Node3D = ClassDB.instantiate(&"KnurlSurface")
	surface.grating = ClassDB.instantiate(&"KnurlGrating")
	surface.axis = Vector3.RIGHT
	grid.add_child(surface)
	stage.add_child(grid)
	await get_tree().process_frame
	checks.check("no triangles" in " ".join(surface.get_warnings()), "an empty grid map")
	grid.set_cell_item(Vector3i.ZERO, 0)
	await get_tree().create_timer(0.2).timeout
	checks.check(
		not "no triangles" in " ".join(surface.get_warnings()), "a painted grid map has triangles"
	)
	grid.free()


## Those that name a device.
func warnings_of(surface: Node, device: Node) -> PackedStringArray:
	var found: PackedStringArray = []
	for line: String in surface.get_warnings():
		if line.begins_with(String(device.name) + ":"):
			found.append(line)
	return found
