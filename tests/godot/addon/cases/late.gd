@tool
extends EditorPlugin
## Looks, in the editor, at files that were imported before Knurl's plugin was on.

var checks: RefCounted


func _enter_tree() -> void:
	if not OS.get_cmdline_args().has("--import"):
		probe.call_deferred()


func probe() -> void:
	checks = load("res://addons/probe/checks.gd").new()
	var end := Time.get_ticks_msec() + 20000
	while count("plate_1d.glb") * count("hints.gltf") == 0 and Time.get_ticks_msec() < end:
		await get_tree().create_timer(0.2).timeout
	while EditorInterface.get_resource_filesystem().is_scanning():
		await get_tree().process_frame
	await get_tree().create_timer(1.0).timeout  # or more would be imported, again
	checks.equal(count("plate_1d.glb"), 3, "surfaces of plate_1d.glb")
	checks.check(count("hints.gltf") > 0, "surfaces of hints.gltf")
	checks.equal(count("off.glb"), 0, "surfaces of off.glb, whose import has them switched off")
	checks.finish(get_tree())


func count(name: String) -> int:
	var path: String = "res://" + name
	var scene := ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	var found := 0
	for i: int in scene.get_state().get_node_count() if scene != null else 0:
		found += 1 if scene.get_state().get_node_type(i) == &"KnurlSurface" else 0
	return found
