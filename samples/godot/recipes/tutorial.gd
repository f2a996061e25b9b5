extends Node3D
## From a mesh to ridges in five steps; the space bar goes on. In the editor the same nodes are added by clicks.

const STEPS: PackedStringArray = [
	"A MeshInstance3D of 100 x 60 mm: 1 unit is 1 m.",
	"Below it, a KnurlSurface with a KnurlGrating: ridges of 2 mm, drawn by KnurlOverlay.",
	'A KnurlDevice: "fake" is a simulated hand, "auto" the first device that is connected.',
	"grating.spatial_frequency = Vector2(250, 250): a grid, felt from the next tick on.",
	"surface.ridges_passed: %d ridge%s. Felt at 1 kHz, told once a frame.",
]

var step := 0
var ridges := 0

@onready var plate: MeshInstance3D = $Plate
@onready var surface: KnurlSurface = $Plate/KnurlSurface
@onready var device: KnurlDevice = $KnurlDevice
@onready var text: Label = $Hud/Text


func _ready() -> void:
	$Hip.hide()
	plate.remove_child(surface)
	surface.grating = surface.grating.duplicate()  # it is changed below
	show_step()


func _exit_tree() -> void:
	if not surface.is_inside_tree():
		surface.queue_free()


func _unhandled_key_input(event: InputEvent) -> void:
	if event.is_action_pressed("ui_accept") and step + 1 < STEPS.size():
		step += 1
		take_step()


func take_step() -> void:
	match step:
		1:
			plate.add_child(surface)
		2:
			device.start()
			$Hip.show()
		3:
			surface.grating.spatial_frequency = Vector2(250, 250)
		4:
			surface.ridges_passed.connect(count)
	show_step()


func count(_device: KnurlDevice, passed: int) -> void:
	ridges += passed
	show_step()


func show_step() -> void:
	var sentence: String = STEPS[step]
	if "%d" in sentence:
		sentence %= [ridges, "" if ridges == 1 else "s"]
	text.text = "%d of %d. %s" % [step + 1, STEPS.size(), sentence]
	if step + 1 < STEPS.size():
		text.text += "\nSpace: go on."
