extends Node3D
## Meters: the force against what the device can give, the speed, ridges a second. Values are read
## once a frame; for every tick there is get_history().

@onready var device: KnurlDevice = $KnurlDevice
@onready var text: Label = $Hud/Text

var bar := ProgressBar.new()


func _ready() -> void:
	bar.position = Vector2(24, 100)
	bar.size = Vector2(400, 30)
	bar.show_percentage = false
	$Hud.add_child(bar)


func _process(_delta: float) -> void:
	if not device.running:
		return
	bar.max_value = device.get_status().max_force
	bar.value = device.force.length()
	text.text = (
		"%.2f of %.1f N, %.0f mm/s, %.0f ridges a second, %.2f mm deep"
		% [
			bar.value,
			bar.max_value,
			1e3 * device.velocity.length(),
			device.temporal_frequency,
			1e3 * device.depth,
		]
	)
