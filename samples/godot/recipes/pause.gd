extends Node3D
## Escape pauses the tree. The force ramps to zero and contacts end, with their signals; the HIP is
## still drawn, because a device's position is updated in a pause. Then the force ramps up again.

@onready var device: KnurlDevice = $KnurlDevice
@onready var text: Label = $Hud/Text


func _ready() -> void:
	process_mode = Node.PROCESS_MODE_ALWAYS  # this menu; everything else stops
	for node: Node in [$Plate, device]:
		node.process_mode = Node.PROCESS_MODE_PAUSABLE


func _unhandled_key_input(event: InputEvent) -> void:
	if event.is_action_pressed("ui_cancel"):
		get_tree().paused = not get_tree().paused


func _process(_delta: float) -> void:
	text.text = (
		"%s. %s, %.2f N. Escape: pause and go on."
		% [
			"Paused" if get_tree().paused else "Plays",
			"In contact" if device.in_contact else "No contact",
			device.force.length(),
		]
	)
