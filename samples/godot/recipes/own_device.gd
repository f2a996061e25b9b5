extends Node3D
## A device of one's own: the stick of a gamepad, or the arrow keys, moves the HIP over the plate.
## Anything with a position will do: call move_hip() as often as there is a new one.

const SPEED := 0.08  # m/s
const DEPTH := 0.0006  # m below the plate
const REACH := Vector2(0.048, 0.028)  # m

@onready var device: KnurlDevice = $KnurlDevice
@onready var text: Label = $Hud/Text

var place := Vector2.ZERO


func _ready() -> void:
	device.stop()
	device.device = "mouse"  # the device that the game moves
	device.sound = true  # it has no motors: the texture is heard,
	device.rumble = 0  # and played by the first gamepad
	device.start()


func _process(delta: float) -> void:
	var stick: Vector2 = Input.get_vector("ui_left", "ui_right", "ui_up", "ui_down")
	place = (place + SPEED * delta * stick).clamp(-REACH, REACH)
	device.move_hip(Vector3(place.x, -DEPTH, place.y))
	text.text = (
		"Stick or arrow keys: at (%.0f, %.0f) mm, %.0f ridges a second"
		% [1e3 * place.x, 1e3 * place.y, device.temporal_frequency]
	)
