class_name KnurlMouse
extends Node
## The mouse as a finger, for people without a device: put it into a scene whose [KnurlDevice] has
## the device [code]mouse[/code]. It hovers over what the pointer is on, and presses while the left
## button is down. The wheel sets how deep.

const HOVER := 0.004  # m above the surface
const DEEPEST := 0.002  # m
const STEP := 0.0001  # m a notch of the wheel
const MM_PER_M := 1000.0
const APART := 1 << 31  # the collision layer of its own shapes

## Which device it moves; empty: the first KnurlDevice beside it.
@export var device_path: NodePath

var _depth := 0.0006
var _pointer := Vector2.ZERO
var _bodies: Dictionary = {}  # a KnurlSurface's instance id -> StaticBody3D
var _device: KnurlDevice


func _ready() -> void:
	_device = get_node_or_null(device_path)
	for sibling: Node in get_parent().get_children():
		if _device == null and sibling is KnurlDevice:
			_device = sibling
	if _device == null:
		push_warning("KnurlMouse: expected a KnurlDevice at device_path or beside it, found none")
		set_physics_process(false)


## What the pointer is on, the engine's physics tells. In metres it overlooks triangles of a
## millimetre, so its shapes are in millimetres, on a layer of their own.
func _physics_process(_delta: float) -> void:
	var camera: Camera3D = get_viewport().get_camera_3d()
	if camera == null or not _device.running or _device.device != "mouse":
		return
	_follow_surfaces(get_tree().root)
	var from: Vector3 = camera.project_ray_origin(_pointer)
	var to: Vector3 = from + camera.project_ray_normal(_pointer)
	var query := PhysicsRayQueryParameters3D.create(from * MM_PER_M, to * MM_PER_M, APART)
	var hit: Dictionary = camera.get_world_3d().direct_space_state.intersect_ray(query)
	if hit.is_empty():
		return
	var pressed: bool = Input.is_mouse_button_pressed(MOUSE_BUTTON_LEFT)
	_device.move_hip(hit.position / MM_PER_M + hit.normal * (-_depth if pressed else HOVER))


func _follow_surfaces(root: Node) -> void:
	for id: int in _bodies.keys():
		var known := instance_from_id(id) as Node
		if known == null or not known.is_inside_tree():
			_bodies[id].queue_free()
			_bodies.erase(id)
	for surface: KnurlSurface in root.find_children("*", "KnurlSurface", true, false):
		var mesh := surface.get_parent() as MeshInstance3D
		if mesh == null or mesh.mesh == null:
			continue
		var id: int = surface.get_instance_id()
		if not _bodies.has(id):
			_bodies[id] = _make_body(mesh)
		var at: Transform3D = mesh.global_transform
		_bodies[id].global_transform = Transform3D(
			at.basis.orthonormalized(), at.origin * MM_PER_M
		)


func _make_body(mesh: MeshInstance3D) -> StaticBody3D:
	var body := StaticBody3D.new()
	var holder := CollisionShape3D.new()
	var shape := ConcavePolygonShape3D.new()
	shape.set_faces(
		(
			Transform3D(Basis.from_scale(mesh.global_basis.get_scale() * MM_PER_M))
			* mesh.mesh.get_faces()
		)
	)
	holder.shape = shape
	body.collision_layer = APART
	body.collision_mask = 0
	body.add_child(holder)
	add_child(body)
	return body


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
