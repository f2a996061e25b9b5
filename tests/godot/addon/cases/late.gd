@tool
extends EditorPlugin
## Checks, in the editor, files that were imported before Knurl's plugin was on.

var checks: RefCounted
var imported: Array = []


func _enter_tree() -> void:
	if not OS.get_cmdline_args().has("--import"):
		probe.call_deferred()


func probe() -> void:
	checks = load("res://addons/probe/checks.gd").new()
	var files: EditorFileSystem = EditorInterface.get_resource_filesystem()
	var late: Array = ["res://hints.gltf", "res://plate_1d.glb"].filter(lacks_surfaces)
	# Nothing is loaded before they are imported: loading a scene in the midst of an import fails.
	files.resources_reimported.connect(
		func(paths: PackedStringArray) -> void: imported.append_array(Array(paths))
	)
	var end := Time.get_ticks_msec() + 60000
	while not late.all(imported.has) and Time.get_ticks_msec() < end:
		await get_tree().process_frame
	await get_tree().create_timer(1.0).timeout  # or more would be imported, again
	while files.is_scanning():
		await get_tree().process_frame
	checks.equal(count("plate_1d.glb"), 3, "surfaces of plate_1d.glb")
	checks.check(count("hints.gltf") > 0, "surfaces of hints.gltf")
	checks.equal(count("off.glb"), 0, "surfaces of off.glb, whose import has them switched off")
	checks.finish(get_tree())


func lacks_surfaces(path: String) -> bool:
	return not "knurl/surfaces" in FileAccess.get_file_as_string(path + ".import")


func count(name: String) -> int:
	var path: String = "res://" + name
	var scene := ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	var found := 0
	for i: int in scene.get_state().get_node_count() if scene != null else 0:
		found += 1 if scene.get_state().get_node_type(i) == &"KnurlSurface" else 0
	return found
