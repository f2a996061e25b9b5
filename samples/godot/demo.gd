extends Node3D
## Shared by both demo scenes: arguments after "--", drawing on a CPU, and a picture at the end.

## Shaders are compiled meanwhile; a device's force is zero while a game hangs.
const WARM_UP_FRAMES := 5


## Frames that are drawn before a device starts.
func warm_up() -> void:
	if RenderingServer.get_video_adapter_name().contains("llvmpipe"):
		_draw_coarsely(true)
	for i: int in WARM_UP_FRAMES:
		await get_tree().process_frame


## Saves a picture if --shot is given, and ends the demo.
func end(device: KnurlDevice) -> void:
	var path: String = argument("--shot", "")
	var status: int = OK
	if not path.is_empty():
		_draw_coarsely(false)
		await RenderingServer.frame_post_draw
		status = get_viewport().get_texture().get_image().save_png(path)
	device.stop()
	get_tree().quit(0 if status == OK else 1)


func argument(option: String, default: String) -> String:
	var arguments: PackedStringArray = OS.get_cmdline_user_args()
	var at: int = arguments.find(option)
	return arguments[at + 1] if at >= 0 and at + 1 < arguments.size() else default


## If the CPU draws, full frames take so long that the device treats the game as hung and zeroes its
## force.
func _draw_coarsely(coarsely: bool) -> void:
	get_viewport().msaa_3d = Viewport.MSAA_DISABLED if coarsely else Viewport.MSAA_4X
	get_viewport().scaling_3d_scale = 0.35 if coarsely else 1.0
