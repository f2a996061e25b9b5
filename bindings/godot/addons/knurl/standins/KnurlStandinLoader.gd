class_name KnurlStandinLoader
extends ResourceFormatLoader
## Loads text scenes and resources that name Knurl's classes, on systems without the library. The engine
## creates loaders by their class's name. Not a tool: the editor keeps unknown classes as they are.

const Standins := preload("res://addons/knurl/standins.gd")


var _is_needed: bool = not ClassDB.class_exists(&"KnurlDevice")


func _init() -> void:
	if _is_needed:  # before the engine's own, which fails
		ResourceLoader.add_resource_format_loader(self, true)


func _get_recognized_extensions() -> PackedStringArray:
	return ["tscn", "tres"]


func _handles_type(_type: StringName) -> bool:
	return true


func _recognize_path(path: String, _type: StringName) -> bool:
	return (
		_is_needed
		and path.get_extension() in ["tscn", "tres"]
		and not path.begins_with("user://")
		and Standins.is_needed(FileAccess.get_file_as_string(path))
	)


## The engine loads text from files only.
func _load(path: String, _original: String, _threads: bool, _cache: int) -> Variant:
	var name := "user://knurl_%x_%d.%s" % [path.hash(), OS.get_thread_caller_id(), path.get_extension()]
	var file := FileAccess.open(name, FileAccess.WRITE)
	if file == null:
		return FileAccess.get_open_error()
	file.store_string(Standins.convert(FileAccess.get_file_as_string(path)))
	file.close()
	var loaded: Resource = ResourceLoader.load(name, "", ResourceLoader.CACHE_MODE_IGNORE)
	DirAccess.remove_absolute(name)
	return loaded if loaded != null else ERR_PARSE_ERROR
