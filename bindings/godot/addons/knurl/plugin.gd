@tool
extends EditorPlugin
## Knurl in the editor: glTF tags become surfaces, devices show their workspace, surfaces their
## warnings, and a button in the 3D view draws the ridges.

const FOLDER := "res://addons/knurl/"
const Standins := preload("standins.gd")

var _gizmo: EditorNode3DGizmoPlugin
var _post_import: EditorScenePostImportPlugin
var _inspector: EditorInspectorPlugin
var _picker: EditorInspectorPlugin
var _export: EditorExportPlugin
var _button: Button
# The scripts below name Knurl's classes, so they are loaded only if the extension is.
var _gltf: GDScript
var _overlay: GDScript


func _enter_tree() -> void:
	_export = load(FOLDER + "export.gd").new()
	add_export_plugin(_export)
	if not ClassDB.class_exists(&"KnurlSurface"):
		push_error(
			(
				"Knurl: its library is not loaded: expected one for this platform in %sbin; "
				+ "the add-on's zip brings it, the folder of a clone does not (see README.md). "
				+ "Until then games play, but nothing is felt; do not save scenes with Knurl's nodes "
				+ "here: the engine keeps such nodes, but not their gratings."
			)
			% FOLDER
		)
		set_process(Standins.install())
		return
	set_process(false)
	if Standins.remove():
		push_warning("Knurl: its library is there again: restart the editor, which knows stand-ins")
		set_process(true)
		return
	_gltf = load(FOLDER + "import.gd")
	_overlay = load(FOLDER + "overlay.gd")
	_gltf.register()
	_post_import = load(FOLDER + "post_import.gd").new()
	add_scene_post_import_plugin(_post_import)
	_gizmo = load(FOLDER + "gizmo.gd").new()
	add_node_3d_gizmo_plugin(_gizmo)
	_inspector = load(FOLDER + "inspector.gd").new()
	add_inspector_plugin(_inspector)
	_picker = load(FOLDER + "material_picker.gd").new(get_undo_redo())
	add_inspector_plugin(_picker)
	_button = Button.new()
	_button.text = "Gratings"
	_button.tooltip_text = "Draw the ridges of Knurl's surfaces where they will be felt."
	_button.icon = _load_icon("KnurlGrating")
	_button.toggle_mode = true
	_button.flat = true
	_button.toggled.connect(_show_gratings)
	add_control_to_container(CONTAINER_SPATIAL_EDITOR_MENU, _button)
	scene_changed.connect(_on_scene_changed)
	get_tree().node_added.connect(_on_node_added)
	EditorInterface.get_inspector().property_edited.connect(_on_property_edited)
	_import_again()


func _exit_tree() -> void:
	remove_export_plugin(_export)
	if _gltf == null:
		return
	EditorInterface.get_inspector().property_edited.disconnect(_on_property_edited)
	get_tree().node_added.disconnect(_on_node_added)
	scene_changed.disconnect(_on_scene_changed)
	_show_gratings(false)
	remove_control_from_container(CONTAINER_SPATIAL_EDITOR_MENU, _button)
	_button.queue_free()
	remove_inspector_plugin(_picker)
	remove_inspector_plugin(_inspector)
	remove_node_3d_gizmo_plugin(_gizmo)
	remove_scene_post_import_plugin(_post_import)
	_gltf.unregister()


## Has the editor look for classes that have come or gone, once it looks for nothing else. Without
## await: the editor may reload scripts in the meantime, which ends that.
func _process(_delta: float) -> void:
	var files: EditorFileSystem = EditorInterface.get_resource_filesystem()
	if not files.is_scanning():
		set_process(false)
		files.scan()


## Files with tags that were imported while the plugin was off have no surfaces.
func _import_again() -> void:
	var files: EditorFileSystem = EditorInterface.get_resource_filesystem()
	while is_inside_tree() and files.is_scanning():
		await get_tree().process_frame
	if not is_inside_tree() or files.get_filesystem() == null:
		return
	var found: PackedStringArray = load(FOLDER + "reimport.gd").find(files.get_filesystem())
	if not found.is_empty():
		print("Knurl: importing files with tags again, now with surfaces: ", ", ".join(found))
		files.reimport_files(found)


## Reads the icon's text: when a project is first opened, plugins start before images are imported.
static func _load_icon(name: String) -> Texture2D:
	var image := Image.new()
	image.load_svg_from_string(
		FileAccess.get_file_as_string("%sicons/%s.svg" % [FOLDER, name]),
		EditorInterface.get_editor_scale()
	)
	return ImageTexture.create_from_image(image)


func _show_gratings(shown: bool) -> void:
	var root: Node = EditorInterface.get_edited_scene_root()
	if root != null:
		_overlay.set_shown(root, shown)


func _on_scene_changed(_root: Node) -> void:
	_show_gratings(_button.button_pressed)


func _on_node_added(node: Node) -> void:
	if _button.button_pressed and node.is_class("KnurlSurface"):
		_show_gratings.call_deferred(true)


func _on_property_edited(_property: String) -> void:
	var edited: Object = EditorInterface.get_inspector().get_edited_object()
	if edited != null and edited.is_class("KnurlDevice"):
		edited.update_gizmos()
