extends "res://demo.gd"
## Three gratings side by side, felt with a device, or with the mouse if there is no device.
##
## Arguments after "--":
## [codeblock]
## --device URI    touch, falcon, rawhid, fake, mouse (default)
## --stroke        the fake device, whose simulated hand strokes the first surface; ends after 2 s
## --shot PATH     a picture of the window is saved at the end of the stroke
## [/codeblock]

const Overlay := preload("res://addons/knurl/overlay.gd")
const Gltf := preload("res://addons/knurl/import.gd")
const HANDLE := "res://knurled_handle.glb"
const HANDLE_SCALE := 0.65  # its 110 mm on a plate of 70
const STROKE_SECONDS := 2.0

@onready var _device: KnurlDevice = $KnurlDevice


func _ready() -> void:
	_add_handle()
	$Hud.name_meshes()
	Overlay.set_shown(self, true)
	var stroke: bool = OS.get_cmdline_user_args().has("--stroke")
	_device.device = "fake" if stroke else argument("--device", "mouse")
	if stroke:
		_device.stroke = "sweep"
	await warm_up()
	if _device.start() != OK:
		return  # the device logged the error
	if stroke:
		_end_after_stroke()


## Loads a glTF file with a tagged material at run time: the tag becomes a surface.
func _add_handle() -> void:
	Gltf.register()
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	if document.append_from_file(HANDLE, state) != OK:
		return
	var handle := document.generate_scene(state) as Node3D
	handle.name = "Handle"
	handle.scale = Vector3.ONE * HANDLE_SCALE
	handle.rotation.y = 0.5 * PI
	handle.position = Vector3(0.056, 0.0, 0.0)
	$Surfaces.add_child(handle)


func _end_after_stroke() -> void:
	while _device.running and _device.ticks < STROKE_SECONDS * _device.rate:
		await get_tree().process_frame
	print(
		(
			"stroke: %d ticks, %d overruns, in contact: %s"
			% [_device.ticks, _device.overruns, _device.in_contact]
		)
	)
	await end(_device)
