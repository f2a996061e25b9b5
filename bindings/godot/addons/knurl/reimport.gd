@tool
extends RefCounted
## Finds glTF files with tags that were imported without surfaces, while the plugin was off: the
## engine does not reimport them by itself.

const OPTION: String = preload("post_import.gd").OPTION
const GLB_MAGIC := 0x46546C67  # "glTF"


static func find(folder: EditorFileSystemDirectory) -> PackedStringArray:
	var found: PackedStringArray = []
	for i: int in folder.get_file_count():
		var path: String = folder.get_file_path(i)
		if path.get_extension().to_lower() in ["glb", "gltf"] and _lacks_surfaces(path):
			found.append(path)
	for i: int in folder.get_subdir_count():
		found.append_array(find(folder.get_subdir(i)))
	return found


static func _lacks_surfaces(path: String) -> bool:
	var settings := ConfigFile.new()
	return (
		settings.load(path + ".import") == OK
		and settings.get_value("remap", "importer", "") == "scene"
		and not settings.has_section_key("params", OPTION)
		and "knurl" in _json_of(path)
	)


## The file's JSON, as text. In a .glb it is the first chunk, after a header of 12 bytes.
static func _json_of(path: String) -> String:
	var file := FileAccess.open(path, FileAccess.READ)
	if file == null:
		return ""
	if file.get_32() != GLB_MAGIC:
		return FileAccess.get_file_as_string(path)
	file.seek(12)
	var length: int = file.get_32()
	file.seek(20)
	return file.get_buffer(mini(length, file.get_length() - 20)).get_string_from_utf8()
