@tool
extends EditorInspectorPlugin
## Offers everyday materials above the properties of a [KnurlGrating].

const Materials: GDScript = preload("materials.gd")
const SWATCH := 16

var _undo: EditorUndoRedoManager  # the plugin's: EditorInterface of 4.3 does not give it


func _init(undo: EditorUndoRedoManager) -> void:
	_undo = undo


func _can_handle(object: Object) -> bool:
	return object is KnurlGrating


func _parse_begin(object: Object) -> void:
	add_custom_control(make_button(object as KnurlGrating))


## A button with a menu; the chosen material's sources are in the items' tooltips, and below it once
## it is chosen.
func make_button(grating: KnurlGrating) -> VBoxContainer:
	var box := VBoxContainer.new()
	var button := MenuButton.new()
	var sources := Label.new()
	button.text = "Everyday Material"
	button.flat = false
	sources.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	sources.hide()
	var menu: PopupMenu = button.get_popup()
	for material: Dictionary in Materials.LIST:
		menu.add_icon_item(_swatch(material["color"]), material["title"])
		menu.set_item_tooltip(-1, describe(material))
	menu.index_pressed.connect(
		func(index: int) -> void:
			var material: Dictionary = Materials.LIST[index]
			_take(grating, material)
			sources.text = material["title"] + ". " + describe(material)
			sources.show()
	)
	box.add_child(button)
	box.add_child(sources)
	return box


## The source of its numbers.
static func describe(material: Dictionary) -> String:
	return "Period: %s. Depth: %s." % [material["period"], material["depth"]]


## The values of the properties that a material sets; damping and method stay.
static func values_of(material: Dictionary) -> Dictionary:
	var values: Dictionary = {}
	for key: String in ["spatial_frequency", "amplitude", "stiffness", "friction", "orientation"]:
		values[key] = material[key]
	return values


## One step for undo.
func _take(grating: KnurlGrating, material: Dictionary) -> void:
	var values: Dictionary = values_of(material)
	_undo.create_action("Everyday Material")
	for key: String in values:
		_undo.add_do_property(grating, key, values[key])
		_undo.add_undo_property(grating, key, grating.get(key))
	_undo.commit_action()


static func _swatch(color: Color) -> ImageTexture:
	var image: Image = Image.create(SWATCH, SWATCH, false, Image.FORMAT_RGB8)
	image.fill(color)
	return ImageTexture.create_from_image(image)
