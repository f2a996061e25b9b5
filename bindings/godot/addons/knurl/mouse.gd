@icon("res://addons/knurl/icons/KnurlMouse.svg")
class_name KnurlMouse
extends Node
## The mouse as a finger, for people without a device. Put it into a scene whose [KnurlDevice] has
## the device [code]mouse[/code]. It hovers over the surface under the pointer and presses while the
## left button is down; the wheel sets the depth. If no surface is under the pointer, it stays in
## the plane of the last one, so that a finger dragged over an edge slips off there.

const HOVER := 0.004  # m above the surface
const DEEPEST := 0.002  # m
const STEP := 0.0001  # m per notch of the wheel

## The device that it moves; empty: the first KnurlDevice among its siblings.
@export var device_path: NodePath

var _depth := 0.0006
var _pointer := Vector2.ZERO
var _pressed := false
var _device: KnurlDevice
var _plane := Plane()  # Plane(): no surface was hit yet


func _ready() -> void:
	_device = get_node_or_null(device_path)
	for sibling: Node in get_parent().get_children():
		if _device == null and sibling is KnurlDevice:
			_device = sibling
	if _device == null:
		push_warning("KnurlMouse: expected a KnurlDevice at device_path or beside it, found none")


func _process(_delta: float) -> void:
	var camera: Camera3D = get_viewport().get_camera_3d()
	if camera == null or not is_instance_valid(_device):
		return
	if not _device.running or _device.device != "mouse":
		_plane = Plane()
		return
	var from: Vector3 = camera.project_ray_origin(_pointer)
	var along: Vector3 = camera.project_ray_normal(_pointer)
	var hit: Dictionary = _device.cast_ray(from, from + along * camera.far)
	if hit.is_empty() and _plane == Plane():
		return
	var at: Variant = hit.get("position")
	if hit.is_empty():
		at = _plane.intersects_ray(from, along)
	else:
		# Double-sided surfaces may be seen from behind.
		var normal: Vector3 = hit.normal if hit.normal.dot(along) < 0.0 else -hit.normal
		_plane = Plane(normal, hit.position)
	_pressed = _pressed and Input.is_mouse_button_pressed(MOUSE_BUTTON_LEFT)
	var height: float = -_depth if _pressed else HOVER
	if at == null:  # the ray does not hit the plane: rise from the current position
		at = _plane.project(_device.hip_position)
		height = HOVER
	_device.move_hip(at + _plane.normal * height)


## A click on one of the game's buttons does not press the surface behind it.
func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion:
		_pointer = (event as InputEventMouseMotion).position
	var button := event as InputEventMouseButton
	if button == null or not button.pressed:
		return
	if button.button_index == MOUSE_BUTTON_LEFT:
		_pointer = button.position
		_pressed = true
	elif button.button_index == MOUSE_BUTTON_WHEEL_UP:
		_depth = minf(_depth + STEP, DEEPEST)
	elif button.button_index == MOUSE_BUTTON_WHEEL_DOWN:
		_depth = maxf(_depth - STEP, STEP)
