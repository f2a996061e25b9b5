@tool
extends EditorExportPlugin
## Exports for a system that the add-on has no library for: scripts take the place of its classes
## (standins.gd), scenes name these, and the engine does not look for the library. Other exports are
## left alone.

const Standins := preload("standins.gd")
## Files of the editor that an export takes from the disk as they are.
const CLASSES := "res://.godot/global_script_class_cache.cfg"
const EXTENSIONS := "res://.godot/extension_list.cfg"

var _lacks_library := false
var _changed: Dictionary = {}  # paths of these: their bytes before the export


func _get_name() -> String:
	return "Knurl"


func _export_begin(features: PackedStringArray, _debug: bool, _path: String, _flags: int) -> void:
	_lacks_library = not Standins.has_library(features)
	if not _lacks_library:
		return
	print("Knurl: no library for this system: scenes load and scripts run there, nothing is felt")
	for name: String in Standins.BASES:
		var text: String = FileAccess.get_file_as_string(Standins.SOURCE + name + ".gd")
		add_file(Standins.ACTIVE + name + ".gd", text.to_utf8_buffer(), false)
	_change(CLASSES, Standins.list_classes(FileAccess.get_file_as_string(CLASSES)))
	_change(
		EXTENSIONS,
		FileAccess.get_file_as_string(EXTENSIONS).replace(Standins.EXTENSION + "\n", "")
	)


func _export_end() -> void:
	for path: String in _changed:
		Standins.write(path, _changed[path])
	_changed.clear()


func _change(path: String, text: String) -> void:
	_changed[path] = FileAccess.get_file_as_string(path)
	Standins.write(path, text)


func _export_file(path: String, type: String, _features: PackedStringArray) -> void:
	if not _lacks_library:
		return
	var is_text: bool = path.get_extension() in ["tscn", "tres"]
	if path == Standins.EXTENSION:
		skip()
	elif is_text or type == "PackedScene":
		var text: String = FileAccess.get_file_as_string(path) if is_text else _text_of(path)
		if Standins.is_needed(text):
			add_file(
				path if is_text else path + ".tscn",
				Standins.convert(text).to_utf8_buffer(),
				not is_text
			)
			skip()


## An imported scene as text, which the game loads in its place.
func _text_of(path: String) -> String:
	var temporary := "user://knurl_export.tscn"
	var scene: Resource = load(path)
	if scene == null or ResourceSaver.save(scene, temporary) != OK:
		return ""
	var text: String = FileAccess.get_file_as_string(temporary)
	DirAccess.remove_absolute(temporary)
	return text
