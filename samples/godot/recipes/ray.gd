extends Node3D
## The surface under the pointer, and its grating: a ray on the haptic surfaces, which needs no
## colliders.

@onready var device: KnurlDevice = $KnurlDevice
@onready var camera: Camera3D = $Camera
@onready var text: Label = $Hud/Text


func _unhandled_input(event: InputEvent) -> void:
	var motion := event as InputEventMouseMotion
	if motion == null:
		return
	var from: Vector3 = camera.project_ray_origin(motion.position)
	var to: Vector3 = from + camera.far * camera.project_ray_normal(motion.position)
	var hit: Dictionary = device.cast_ray(from, to)
	var surface: KnurlSurface = hit.get("surface")
	if surface == null:
		text.text = "Nothing to feel."
		return
	var grating: KnurlGrating = surface.grating
	text.text = (
		"%s: ridges of %.1f mm, %.0f N/m, at (%.0f, %.0f) mm."
		% [
			surface.get_parent().name,
			1e3 / grating.spatial_frequency.x,
			grating.stiffness,
			1e3 * hit.position.x,
			1e3 * hit.position.z,
		]
	)
