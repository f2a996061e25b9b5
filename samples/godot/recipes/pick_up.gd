extends Node3D
## Holds the touched object while a button of the device, or the space bar, is held. A click of
## 40 ms marks the grip, a softer one the release.

@onready var device: KnurlDevice = $KnurlDevice
@onready var text: Label = $Hud/Text

var held: Node3D
var grip := Vector3.ZERO  # from the HIP to the held object


func _ready() -> void:
	device.button_changed.connect(func(_index: int, pressed: bool) -> void: set_grip(pressed))
	text.text = "Touch the plate and hold a button, or the space bar."


func _unhandled_key_input(event: InputEvent) -> void:
	if event.is_action("ui_accept") and not event.is_echo():
		set_grip(event.is_pressed())


func set_grip(closed: bool) -> void:
	var surface: KnurlSurface = device.get_touched_surface()
	if closed and surface != null and held == null:
		held = surface.get_parent()
		grip = held.global_position - device.hip_position
		surface.enabled = false  # the wall would push the hand away from the held object
		click(0.8)
	elif not closed and held != null:
		(held.get_node("KnurlSurface") as KnurlSurface).enabled = true
		held = null
		click(0.4)
	text.text = "Holds %s." % (held.name if held != null else &"nothing")


func click(newtons: float) -> void:
	device.vibrate(KnurlDevice.VIBRATION_T3, 150.0, newtons, 0.04, Vector3.UP)


func _process(_delta: float) -> void:
	if held != null:
		held.global_position = device.hip_position + grip
