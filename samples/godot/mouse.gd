extends Node
## The mouse as a HIP: it hovers over what the pointer is on, and presses while the left button is
## down. The wheel sets how deep.

const HOVER := 0.004  # m above the surface
const DEEPEST := 0.002  # m
const STEP := 0.0001  # m a notch of the wheel
const MM_PER_M := 1000.0

var _depth := 0.0006
var _pointer := Vector2.ZERO

@onready var _device: KnurlDevice = $"../KnurlDevice"
@onready var _camera: Camera3D = $"../Camera"


## What the pointer is on, the engine's physics tells. In metres it overlooks triangles of a
## millimetre, so its world is in millimetres, apart from what is seen.
func add_shapes() -> void:
	var body := StaticBody3D.new()
	for mesh: MeshInstance3D in $"../Surfaces".find_children("*", "MeshInstance3D", true, false):
		var shape := ConcavePolygonShape3D.new()
		shape.set_faces(
			mesh.global_transform.scaled(Vector3.ONE * MM_PER_M) * mesh.mesh.get_faces()
		)
		var holder := CollisionShape3D.new()
		holder.shape = shape
		body.add_child(holder)
	add_child(body)


func _physics_process(_delta: float) -> void:
	if not _device.running or _device.device != "mouse":
		return
	var from: Vector3 = _camera.project_ray_origin(_pointer)
	var to: Vector3 = from + _camera.project_ray_normal(_pointer)
	var query := PhysicsRayQueryParameters3D.create(from * MM_PER_M, to * MM_PER_M)
	var hit: Dictionary = _camera.get_world_3d().direct_space_state.intersect_ray(query)
	if hit.is_empty():
		return
	var pressed: bool = Input.is_mouse_button_pressed(MOUSE_BUTTON_LEFT)
	_device.move_hip(hit.position / MM_PER_M + hit.normal * (-_depth if pressed else HOVER))


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion:
		_pointer = (event as InputEventMouseMotion).position
	var button := event as InputEventMouseButton
	if button == null or not button.pressed:
		return
	if button.button_index == MOUSE_BUTTON_WHEEL_UP:
		_depth = minf(_depth + STEP, DEEPEST)
	elif button.button_index == MOUSE_BUTTON_WHEEL_DOWN:
		_depth = maxf(_depth - STEP, STEP)
