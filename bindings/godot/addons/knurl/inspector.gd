@tool
extends EditorInspectorPlugin
## Shows a [KnurlSurface]'s warnings above its properties. (A script cannot add configuration
## warnings to a native class, and those of a native class cannot change while a device runs.)


func _can_handle(object: Object) -> bool:
	return object is KnurlSurface


func _parse_begin(object: Object) -> void:
	add_custom_control(Warnings.new(object as KnurlSurface))


## A yellow line for each warning, updated while it is visible.
class Warnings:
	extends VBoxContainer
	const SECONDS := 0.5
	var _surface: KnurlSurface
	var _shown: PackedStringArray = []

	func _init(surface: KnurlSurface) -> void:
		_surface = surface
		var timer := Timer.new()
		timer.wait_time = SECONDS
		timer.autostart = true
		timer.timeout.connect(_refresh)
		add_child(timer, false, Node.INTERNAL_MODE_BACK)

	func _ready() -> void:
		_refresh()

	func _refresh() -> void:
		var warnings: PackedStringArray = (
			_surface.get_warnings() if is_instance_valid(_surface) else PackedStringArray()
		)
		if warnings == _shown:
			return
		_shown = warnings
		for line: Node in get_children():
			remove_child(line)
			line.queue_free()
		for warning: String in warnings:
			var line := Label.new()
			line.text = warning
			line.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
			line.add_theme_color_override(&"font_color", Color(1.0, 0.87, 0.4))
			add_child(line)
