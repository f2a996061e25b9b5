extends CanvasLayer
## What is touched, how fast the ridges go by, how hard they push; and what went wrong.

const PAPER := Color(0.09, 0.1, 0.13, 0.85)
const INK := Color(0.9, 0.93, 0.97)
const FAINT := Color(0.6, 0.66, 0.74)
const AMBER := Color(1.0, 0.75, 0.35)
const FAULTS_SHOWN := 4

var _touched := Label.new()
var _values := Label.new()
var _about := Label.new()
var _faults := Label.new()
var _told: PackedStringArray = []

@onready var _device: KnurlDevice = $"../KnurlDevice"


func _ready() -> void:
	_add_panel(Vector2(20.0, 20.0), Vector2(330.0, 0.0), [_touched, _values])
	_add_panel(Vector2(930.0, 20.0), Vector2(330.0, 0.0), [_about, _faults])
	_touched.add_theme_font_size_override(&"font_size", 24)
	_about.add_theme_color_override(&"font_color", FAINT)
	_faults.add_theme_color_override(&"font_color", AMBER)
	_faults.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	_device.fault.connect(func(_code: int, text: String) -> void: _tell(text))
	for surface: Node in get_parent().find_children("*", "KnurlSurface", true, false):
		_name_mesh((surface as KnurlSurface).get_parent() as MeshInstance3D)


func _process(_delta: float) -> void:
	_touched.text = _touched_name()
	_values.text = "temporal frequency   %5.0f Hz\nheight                      %+6.2f mm\nforce                         %5.2f N" % [
		_device.temporal_frequency, 1e3 * _device.height, _device.force.length(),
	]
	if not _device.running:
		_about.text = "no device is running"
		return
	var how: String = "\npress: left button, deeper: wheel" if _device.device == "mouse" else ""
	_about.text = "%s\n%.0f Hz, %d ticks, %d late%s" % [
		_device.device_name, _device.rate, _device.ticks, _device.overruns, how,
	]


func _touched_name() -> String:
	for surface: Node in get_parent().find_children("*", "KnurlSurface", true, false):
		if (surface as KnurlSurface).is_touched():
			return surface.get_parent().name
	return "nothing is touched"


func _tell(text: String) -> void:
	_told.append(text)
	_told = _told.slice(-FAULTS_SHOWN)
	_faults.text = "\n".join(_told)


## Its name, over it in the scene.
func _name_mesh(mesh: MeshInstance3D) -> void:
	var box: AABB = mesh.global_transform * mesh.get_aabb()
	var label := Label3D.new()
	label.text = mesh.name
	label.pixel_size = 0.00012
	label.font_size = 48
	label.outline_size = 12
	label.modulate = INK
	label.billboard = BaseMaterial3D.BILLBOARD_ENABLED
	mesh.add_child(label)
	label.global_position = Vector3(box.get_center().x, 0.003, box.position.z - 0.006)


func _add_panel(at: Vector2, size: Vector2, lines: Array[Label]) -> void:
	var panel := PanelContainer.new()
	var style := StyleBoxFlat.new()
	style.bg_color = PAPER
	style.set_corner_radius_all(8)
	style.set_content_margin_all(14.0)
	panel.add_theme_stylebox_override(&"panel", style)
	panel.position = at
	panel.custom_minimum_size = size
	var box := VBoxContainer.new()
	for line: Label in lines:
		line.add_theme_color_override(&"font_color", INK)
		line.add_theme_font_size_override(&"font_size", 17)
		box.add_child(line)
	panel.add_child(box)
	add_child(panel)
