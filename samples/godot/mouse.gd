extends Node
## The mouse as a HIP: it hovers over what the pointer is on, and presses while the left button is down. The wheel sets
## how deep.

const HOVER := 0.004 # m above the surface
const DEEPEST := 0.002 # m
const STEP := 0.0001 # m a notch of the wheel
const LAYER := 1

var _depth := 0.0006

@onready var _device: KnurlDevice = $"../KnurlDevice"
@onready var _camera: Camera3D = $"../Camera"


## What the pointer is on, the engine's physics tells.
func add_shapes() -> void:
	for mesh: Node in $"../Surfaces".find_children("*", "MeshInstance3D", true, false):
		(mesh as MeshInstance3D).create_trimesh_collision()


func _physics_process(_delta: float) -> void:
	if not _device.running or _device.device != "mouse":
		return
	var pointer: Vector2 = _camera.get_viewport().get_mouse_position()
	var from: Vector3 = _camera.project_ray_origin(pointer)
	var query := PhysicsRayQueryParameters3D.create(from, from + _camera.project_ray_normal(pointer), LAYER)
	var hit: Dictionary = _camera.get_world_3d().direct_space_state.intersect_ray(query)
	if hit.is_empty():
		return
	var pressed: bool = Input.is_mouse_button_pressed(MOUSE_BUTTON_LEFT)
	_device.move_hip(hit.position + hit.normal * (-_depth if pressed else HOVER))


func _unhandled_input(event: InputEvent) -> void:
	var button := event as InputEventMouseButton
	if button == null or not button.pressed:
		return
	if button.button_index == MOUSE_BUTTON_WHEEL_UP:
		_depth = minf(_depth + STEP, DEEPEST)
	elif button.button_index == MOUSE_BUTTON_WHEEL_DOWN:
		_depth = maxf(_depth - STEP, STEP)
