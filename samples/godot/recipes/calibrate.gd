extends Node3D
## Fits a hand's reach to the plate: move the stylus as far to the left and right as is comfortable,
## then press a button of the device, or the space bar. The device is paused meanwhile: nothing is
## felt, and its position is updated.

const WIDTH := 0.08  # m of the scene that the hand is to reach: most of the plate
const LEAST := 0.005  # m

@onready var device: KnurlDevice = $KnurlDevice
@onready var centre: Vector3 = device.global_position  # the middle of the reach is to be there
@onready var text: Label = $Hud/Text

var left := INF
var right := -INF


func _ready() -> void:
	device.paused = true
	device.button_changed.connect(func(_index: int, pressed: bool) -> void: finish(pressed))


func _unhandled_key_input(event: InputEvent) -> void:
	finish(event.is_action_pressed("ui_accept"))


func _process(_delta: float) -> void:
	if not device.paused or device.ticks == 0:
		return
	# In metres of the device: the workspace turns, moves and scales these.
	var x: float = (device.global_transform.orthonormalized().affine_inverse() * device.hip_position).x
	left = minf(left, x / device.workspace_scale)
	right = maxf(right, x / device.workspace_scale)
	text.text = "Move left and right, then press a button: %.0f mm so far." % (1e3 * (right - left))


func finish(pressed: bool) -> void:
	if not pressed or not device.paused or right - left < LEAST:
		return
	device.workspace_scale = WIDTH / (right - left)
	var right_of_device: Vector3 = device.global_basis.x.normalized()
	device.global_position = centre - 0.5 * (left + right) * device.workspace_scale * right_of_device
	device.paused = false
	text.text = "Reach %.0f mm, scale %.2f." % [1e3 * (right - left), device.workspace_scale]
