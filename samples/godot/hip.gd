extends Node3D
## Draws the HIP (the ball), the proxy on the surface (the ring), and the force on the hand (the
## rod).

const METRES_PER_NEWTON := 0.05
const SHORTEST := 1e-4  # m

@onready var _device: KnurlDevice = $"../KnurlDevice"


func _process(_delta: float) -> void:
	$Ball.global_position = _device.hip_position
	$Proxy.global_position = _device.proxy_position
	# The rod is 1 m long along y; its foot is placed on the proxy.
	var length: float = maxf(METRES_PER_NEWTON * _device.force.length(), SHORTEST)
	var up: Vector3 = _device.force.normalized() if length > SHORTEST else Vector3.UP
	var aside: Vector3 = (
		up.cross(Vector3.RIGHT if absf(up.x) < 0.9 else Vector3.FORWARD).normalized()
	)
	$Force.global_transform = Transform3D(
		Basis(aside, up * length, aside.cross(up)), _device.proxy_position + 0.5 * length * up
	)
