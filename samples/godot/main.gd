extends Node3D
## Three gratings side by side, felt with a device, or with the mouse where there is none.
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
const WARM_UP_FRAMES := 5  # late, for shaders are compiled; a device's force is zero while a game hangs

@onready var _device: KnurlDevice = $KnurlDevice


func _ready() -> void:
	_add_handle()
	$Hud.name_meshes()
	Overlay.set_shown(self, true)
	if _is_drawn_by_cpu():
		_draw_coarsely(true)
	var stroke: bool = OS.get_cmdline_user_args().has("--stroke")
	_device.device = "fake" if stroke else _argument("--device", "mouse")
	if stroke:
		_device.stroke = "sweep"
	for i: int in WARM_UP_FRAMES:
		await get_tree().process_frame
	if _device.start() != OK:
		return  # the device said why
	if stroke:
		_end_after_stroke()


## A glTF file whose material is tagged, read while the game runs: its surface is made of the tag.
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
	var path: String = _argument("--shot", "")
	var status: int = OK
	if not path.is_empty():
		_draw_coarsely(false)
		await RenderingServer.frame_post_draw
		status = get_viewport().get_texture().get_image().save_png(path)
	_device.stop()
	get_tree().quit(0 if status == OK else 1)


## Where the CPU draws, frames would else be so late that the device, which takes the game to hang,
## sets its force to zero.
func _draw_coarsely(coarsely: bool) -> void:
	get_viewport().msaa_3d = Viewport.MSAA_DISABLED if coarsely else Viewport.MSAA_4X
	get_viewport().scaling_3d_scale = 0.35 if coarsely else 1.0


func _is_drawn_by_cpu() -> bool:
	return RenderingServer.get_video_adapter_name().contains("llvmpipe")


func _argument(name: String, default: String) -> String:
	var arguments: PackedStringArray = OS.get_cmdline_user_args()
	var at: int = arguments.find(name)
	return arguments[at + 1] if at >= 0 and at + 1 < arguments.size() else default
