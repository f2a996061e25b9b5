extends CanvasLayer
## Shows the touched surface, the frequency of its ridges, the force, and faults.

const PAPER := Color(0.09, 0.1, 0.13, 0.85)
const INK := Color(0.9, 0.93, 0.97)
const FAINT := Color(0.6, 0.66, 0.74)
const AMBER := Color(1.0, 0.75, 0.35)
const FAULTS_SHOWN := 2
const LATE_TICKS := 7 # KNURL_FAULT_OVERRUN
const PANEL_WIDTH := 310.0
const MARGIN := 20.0

var _touched := Label.new()
var _frequency := Label.new()
var _height := Label.new()
var _force := Label.new()
var _about := Label.new()
var _faults := Label.new()
var _told: PackedStringArray = []

@onready var _device: KnurlDevice = $"../KnurlDevice"


func _ready() -> void:
	_add_panel(
		false,
		[
			_touched,
			_row("temporal frequency", _frequency),
			_row("height", _height),
			_row("force", _force),
		]
	)
	_add_panel(true, [_about, _faults])
	_touched.add_theme_font_size_override(&"font_size", 24)
	_about.add_theme_color_override(&"font_color", FAINT)
	_faults.add_theme_color_override(&"font_color", AMBER)
	_faults.visible = false
	_device.fault.connect(_on_fault)


## Labels each mesh in the scene with its name.
func name_meshes() -> void:
	for surface: Node in get_parent().find_children("*", "KnurlSurface", true, false):
		_name_mesh((surface as KnurlSurface).get_parent() as MeshInstance3D)


func _process(_delta: float) -> void:
	_touched.text = _touched_name()
	_frequency.text = "%.0f Hz" % _device.temporal_frequency
	_height.text = "%+.2f mm" % (1e3 * _device.height)
	_force.text = "%.2f N" % _device.force.length()
	if not _device.running:
		_about.text = "no device is running"
		return
	var how: String = "\npress: left button, deeper: wheel" if _device.device == "mouse" else ""
	_about.text = (
		"%s\n%.0f Hz, %d ticks, %d late%s"
		% [
			_device.device_name,
			_device.rate,
			_device.ticks,
			_device.overruns,
			how,
		]
	)


func _touched_name() -> String:
	for surface: Node in get_parent().find_children("*", "KnurlSurface", true, false):
		if (surface as KnurlSurface).is_touched():
			return surface.get_parent().name
	return "nothing is touched"


func _on_fault(code: int, text: String) -> void:
	if code != LATE_TICKS: # only counted, because there are many without real-time scheduling
		_tell(text)


func _tell(text: String) -> void:
	_told.append(text)
	_told = _told.slice(-FAULTS_SHOWN)
	_faults.text = "\n".join(_told)
	_faults.visible = true


func _name_mesh(mesh: MeshInstance3D) -> void:
	var box: AABB = mesh.global_transform * mesh.get_aabb()
	var label := Label3D.new()
	label.text = mesh.name
	label.pixel_size = 0.0001
	label.font_size = 48
	label.outline_size = 12
	label.modulate = INK
	label.billboard = BaseMaterial3D.BILLBOARD_ENABLED
	label.top_level = true  # not scaled with the mesh
	mesh.add_child(label)
	label.global_position = Vector3(box.get_center().x, 0.004, box.end.z + 0.005)


func _row(title: String, value: Label) -> Control:
	var row := HBoxContainer.new()
	var name := Label.new()
	name.text = title
	name.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	_dress(name)
	_dress(value)
	row.add_child(name)
	row.add_child(value)
	return row


func _dress(label: Label) -> void:
	label.add_theme_color_override(&"font_color", INK)
	label.add_theme_font_size_override(&"font_size", 16)
	label.autowrap_mode = (
		TextServer.AUTOWRAP_WORD_SMART if label in [_about, _faults] else TextServer.AUTOWRAP_OFF
	)


func _add_panel(right: bool, lines: Array[Control]) -> void:
	var panel := PanelContainer.new()
	var style := StyleBoxFlat.new()
	style.bg_color = PAPER
	style.set_corner_radius_all(8)
	style.set_content_margin_all(12.0)
	panel.add_theme_stylebox_override(&"panel", style)
	panel.custom_minimum_size.x = PANEL_WIDTH
	var box := VBoxContainer.new()
	for line: Control in lines:
		if line is Label:
			_dress(line as Label)
		box.add_child(line)
	panel.add_child(box)
	add_child(panel)
	panel.anchor_left = 1.0 if right else 0.0
	panel.anchor_right = panel.anchor_left
	panel.grow_horizontal = Control.GROW_DIRECTION_BEGIN if right else Control.GROW_DIRECTION_END
	panel.position += Vector2(-MARGIN if right else MARGIN, MARGIN)
