@tool
extends RefCounted
## On systems without the library, scripts take the place of its classes, so that scenes load, scripts
## parse and the game plays, with nothing to feel. The scripts in [code]standins/[/code] are ignored
## by the engine, because a script cannot have the name of a class that exists. They are used by
## [br]- the editor on a system without a library, which copies them into [constant ACTIVE];
## [br]- an export for such a system, which contains them (export.gd).
## [br]Scene files name the classes as types of nodes and resources, which only extensions can
## provide: [method convert] turns these into the scripts' base types, with the script.

const SOURCE := "res://addons/knurl/standins/"
const ACTIVE := "res://addons/knurl/standins_active/"
const EXTENSION := "res://addons/knurl/knurl.gdextension"
const BASES := {"KnurlGrating": "Resource", "KnurlSurface": "Node3D", "KnurlDevice": "Node3D", "KnurlEffect": "Node3D"}
const LOADER := "KnurlStandinLoader"
const MARK := "\u0001%d\u0001"  # no scene contains this character


## True if a text scene or resource has to be converted.
static func is_needed(text: String) -> bool:
	return text.contains('type="Knurl')


## A text scene or resource (.tscn, .tres) without Knurl's classes.
static func convert(text: String) -> String:
	var strings: PackedStringArray = []
	var used: Dictionary = {}
	var blocks: PackedStringArray = []
	for block: String in ("\n" + _take_strings(text, strings)).split("\n["):
		blocks.append(_convert_block(block, used))
	var scripts := ""
	for type: String in used:
		if used[type]:
			scripts += '[ext_resource type="Script" path="%s%s.gd" id="%s"]\n' % [ACTIVE, type, type]
	if not scripts.is_empty():
		# blocks: "" or a comment, the header, the rest
		blocks[1] = blocks[1].rstrip("\n") + "\n\n" + scripts
	return _put_strings("\n[".join(blocks).substr(1), strings)


## Replaces strings of several lines, which may look like nodes, by their numbers.
static func _take_strings(text: String, strings: PackedStringArray) -> String:
	var parts: PackedStringArray = []
	var from := 0  # the first character that is not in parts yet
	var begin: int = text.find('"')
	while begin >= 0:
		var end: int = text.find('"', begin + 1)
		while end >= 0 and _is_escaped(text, end):
			end = text.find('"', end + 1)
		if end < 0:
			break
		var string: String = text.substr(begin, end + 1 - begin)
		if string.contains("\n"):
			parts.append(text.substr(from, begin - from) + MARK % strings.size())
			strings.append(string)
			from = end + 1
		begin = text.find('"', end + 1)
	return "".join(parts) + text.substr(from)


static func _put_strings(text: String, strings: PackedStringArray) -> String:
	for i: int in strings.size():
		text = text.replace(MARK % i, strings[i])
	return text


## True if an odd number of backslashes stands before a character.
static func _is_escaped(text: String, at: int) -> bool:
	var first: int = at
	while first > 0 and text[first - 1] == "\\":
		first -= 1
	return (at - first) % 2 == 1


## A block is a line in brackets, without the first one, and its properties. used: for each class,
## whether its script is referred to.
static func _convert_block(block: String, used: Dictionary) -> String:
	var head: String = block.get_slice("\n", 0)
	var type: String = ""
	for known: String in BASES:
		if head.contains(' type="%s"' % known):
			type = known
	var is_resource: bool = head.begins_with("resource]") and used.get("KnurlGrating") == false
	if type == "" and not is_resource:
		return block
	var body: String = block.substr(head.length() + 1)
	if type != "":
		head = head.replace(' type="%s"' % type, ' type="%s"' % BASES[type])
	if head.begins_with("ext_resource"):  # its own file is converted
		return head + "\n" + body
	if head.begins_with("gd_resource"):  # the script goes into the block [resource]
		used[type] = false
		return head + "\n" + body
	if is_resource:
		type = "KnurlGrating"
	# The script comes before the properties that it has; a script of the user's extends ours.
	var script := ""
	var lines: PackedStringArray = body.split("\n")
	for i: int in lines.size():
		if lines[i].begins_with("script = "):
			script = lines[i]
			lines.remove_at(i)
			break
	if script == "":
		script = 'script = ExtResource("%s")' % type
		used[type] = true
	return head + "\n" + script + "\n" + "\n".join(lines)


## The editor's list of script classes, with the stand-ins.
static func list_classes(text: String) -> String:
	var list := ConfigFile.new()
	list.parse(text)
	var classes: Array[Dictionary] = []
	for known: Dictionary in list.get_value("", "list", []):
		if not known["class"] in BASES:
			classes.append(known)
	for name: String in BASES:
		classes.append(
			{
				"base": StringName(BASES[name]),
				"class": StringName(name),
				"icon": "",
				"is_abstract": false,
				"is_tool": false,
				"language": &"GDScript",
				"path": ACTIVE + name + ".gd",
			}
		)
	list.set_value("", "list", classes)
	return list.encode_to_text()


## Puts the scripts where the engine finds them. Returns false if they were there.
static func install() -> bool:
	if FileAccess.file_exists(ACTIVE + LOADER + ".gd"):
		return false
	DirAccess.make_dir_recursive_absolute(ACTIVE)
	write(ACTIVE + ".gitignore", "*\n")
	for name: String in BASES.keys() + [LOADER]:
		write(ACTIVE + name + ".gd", FileAccess.get_file_as_string(SOURCE + name + ".gd"))
	return true


## Removes them. Returns false if there were no scripts.
static func remove() -> bool:
	var folder := DirAccess.open(ACTIVE)
	if folder == null:
		return false
	folder.include_hidden = true
	for name: String in folder.get_files():
		folder.remove(name)
	DirAccess.remove_absolute(ACTIVE.rstrip("/"))
	return true


static func write(path: String, text: String) -> void:
	var file := FileAccess.open(path, FileAccess.WRITE)
	if file == null:
		push_error("Knurl: %s: %s" % [path, error_string(FileAccess.get_open_error())])
		return
	file.store_string(text)


## True if the add-on has a library for an export with these features.
static func has_library(features: PackedStringArray) -> bool:
	var extension := ConfigFile.new()
	if extension.load(EXTENSION) != OK:
		return false
	for tags: String in extension.get_section_keys("libraries"):
		var fits := true
		for tag: String in tags.split("."):
			fits = fits and tag in features
		var path: String = extension.get_value("libraries", tags)
		if fits and FileAccess.file_exists(EXTENSION.get_base_dir().path_join(path)):
			return true
	return false
