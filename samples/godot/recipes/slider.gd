extends Node3D
## A setting with notches, as a dial has them: the finger slides from one to the next.

@onready var device: KnurlDevice = $KnurlDevice
@onready var notches: KnurlEffect = $Effect
@onready var text: Label = $Hud/Text


func _ready() -> void:
	$Plate.visible = false
	($Plate/KnurlSurface as KnurlSurface).enabled = false


func _process(_delta: float) -> void:
	var along: float = (device.hip_position - notches.global_position).x
	text.text = (
		"Setting %d, %.2f N towards its notch"
		% [roundi(along / notches.spacing), absf(device.force.x)]
	)
