extends Node3D
## A trigger: a spring (a plane) that pushes the finger back and breaks with a click. The plate is
## out of the way.

const TRAVEL := 0.006  # m

@onready var device: KnurlDevice = $KnurlDevice
@onready var spring: KnurlEffect = $Effect
@onready var text: Label = $Hud/Text

var shots := 0
var stiffness := 0.0  # N/m, before the break


func _ready() -> void:
	stiffness = spring.stiffness
	$Plate.visible = false
	($Plate/KnurlSurface as KnurlSurface).enabled = false


func _process(_delta: float) -> void:
	var pulled: float = (device.hip_position - spring.global_position).z
	if pulled > TRAVEL and spring.stiffness == stiffness:
		shots += 1
		spring.stiffness = 0.2 * stiffness
		device.vibrate(KnurlDevice.VIBRATION_T3, 150.0, 0.8, 0.04, Vector3.BACK)
	elif pulled < 0.3 * TRAVEL:
		spring.stiffness = stiffness
	text.text = "%d shots. Pull towards you: %.1f mm" % [shots, 1e3 * maxf(pulled, 0.0)]
