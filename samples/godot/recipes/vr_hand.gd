extends Node3D
## A finger in VR: the tip of a controller is the HIP, and its motor plays the ridges that pass
## under it. In a game, Controller stands below an XROrigin3D, and a runtime moves it; here nothing
## does, so that the scene also runs without a headset.

const STRONGEST := 1.5  # N, played at the motor's full strength

@onready var device: KnurlDevice = $KnurlDevice
@onready var text: Label = $Hud/Text

var controller := XRController3D.new()


func _ready() -> void:
	controller.name = "Controller"
	controller.tracker = &"right_hand"
	controller.position = Vector3(0, -0.0006, 0)
	add_child(controller)
	device.stop()
	device.device = "mouse"
	device.start()


func _process(delta: float) -> void:
	device.move_hip(controller.global_position)
	var frequency: float = device.temporal_frequency
	var strength: float = minf(device.force.length() / STRONGEST, 1.0)
	if device.in_contact and frequency > 1.0:
		controller.trigger_haptic_pulse("haptic", frequency, strength, 2.0 * delta, 0.0)
	text.text = "%.0f Hz at %.0f %% of the motor's strength" % [frequency, 100.0 * strength]
