extends Control
## The last ticks, as the haptic thread played them: the grating's height, and the force.

const TICKS := 400
const PAPER := Color(0.09, 0.1, 0.13, 0.85)
const RULE := Color(1.0, 1.0, 1.0, 0.12)
const INK := Color(0.6, 0.66, 0.74)
const HEIGHT := Color(1.0, 0.75, 0.35)
const FORCE := Color(0.35, 1.0, 0.75)
const LEAST_HEIGHT := 0.0003  # m: end of the scale; grows if needed
const LEAST_FORCE := 0.5  # N
const MARGIN := Vector2(76.0, 14.0)
const FONT_SIZE := 14

var _height_end := LEAST_HEIGHT
var _force_end := LEAST_FORCE

@onready var _device: KnurlDevice = $"../../KnurlDevice"


func _process(_delta: float) -> void:
	queue_redraw()


func _draw() -> void:
	var style := StyleBoxFlat.new()
	style.bg_color = PAPER
	style.set_corner_radius_all(8)
	draw_style_box(style, Rect2(Vector2.ZERO, size))
	var history: PackedFloat32Array = _device.get_history(TICKS)
	var half := Vector2(size.x - 2.0 * MARGIN.x, 0.5 * size.y - 1.5 * MARGIN.y)
	var upper := Rect2(MARGIN, half)
	var lower := Rect2(MARGIN + Vector2(0.0, half.y + MARGIN.y), half)
	_height_end = maxf(_height_end, _largest(history, 0))
	_force_end = maxf(_force_end, _largest(history, 1))
	_rule(upper, "height", "%+.2f mm" % (1e3 * _height_end), "%+.2f" % (-1e3 * _height_end), HEIGHT)
	_trace(history, 0, upper, -_height_end, _height_end, HEIGHT)
	_rule(lower, "force", "%.2f N" % _force_end, "0", FORCE)
	_trace(history, 1, lower, 0.0, _force_end, FORCE)
	draw_string(
		get_theme_default_font(),
		Vector2(size.x - MARGIN.x + 8.0, size.y - MARGIN.y),
		"%.1f s" % (TICKS / _device.rate),
		HORIZONTAL_ALIGNMENT_LEFT,
		-1.0,
		FONT_SIZE,
		INK
	)


func _largest(history: PackedFloat32Array, column: int) -> float:
	var largest := 0.0
	for i: int in range(column, history.size(), 2):
		largest = maxf(largest, absf(history[i]))
	return largest


func _rule(box: Rect2, title: String, top: String, bottom: String, colour: Color) -> void:
	var font: Font = get_theme_default_font()
	draw_line(box.position, box.position + Vector2(box.size.x, 0.0), RULE)
	draw_line(box.end, box.end - Vector2(box.size.x, 0.0), RULE)
	draw_string(
		font,
		box.position + Vector2(8.0 - MARGIN.x, 10.0),
		top,
		HORIZONTAL_ALIGNMENT_LEFT,
		-1.0,
		FONT_SIZE,
		INK
	)
	draw_string(
		font,
		box.position + Vector2(8.0 - MARGIN.x, 0.5 * box.size.y + 5.0),
		title,
		HORIZONTAL_ALIGNMENT_LEFT,
		-1.0,
		FONT_SIZE + 2,
		colour
	)
	draw_string(
		font,
		box.position + Vector2(8.0 - MARGIN.x, box.size.y),
		bottom,
		HORIZONTAL_ALIGNMENT_LEFT,
		-1.0,
		FONT_SIZE,
		INK
	)


## Draws steps, not slopes, because a device holds each value until the next tick. The newest is at
## the right.
func _trace(
	history: PackedFloat32Array, column: int, box: Rect2, low: float, high: float, colour: Color
) -> void:
	@warning_ignore("integer_division")
	var count: int = history.size() / 2
	if count < 2:
		return
	var points: PackedVector2Array = []
	var width: float = box.size.x / TICKS
	for i: int in count:
		var y: float = (
			box.end.y
			- box.size.y * clampf((history[2 * i + column] - low) / (high - low), 0.0, 1.0)
		)
		var x: float = box.end.x - width * (count - i)
		points.append(Vector2(x, y))
		points.append(Vector2(x + width, y))
	draw_polyline(points, colour, 1.5, true)
