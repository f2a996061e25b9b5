extends Node3D
## Where the HIP is (the ball), the proxy that the surface holds back (the ring), and the force on the hand (the rod).

const METRES_PER_NEWTON := 0.03

@onready var _device: KnurlDevice = $"../KnurlDevice"


func _process(_delta: float) -> void:
	visible = _device.running
	$Ball.global_position = _device.hip_position
	$Proxy.visible = _device.in_contact
	$Proxy.global_position = _device.proxy_position
	var length: float = METRES_PER_NEWTON * _device.force.length()
	$Force.visible = _device.in_contact and length > 1e-4
	if $Force.visible: # the rod stands along y, 1 m long, its foot on the proxy
		var up: Vector3 = _device.force.normalized()
		var aside: Vector3 = up.cross(Vector3.RIGHT if absf(up.x) < 0.9 else Vector3.UP).normalized()
		$Force.global_transform = Transform3D(Basis(aside, up * length, aside.cross(up)), _device.proxy_position + 0.5 * length * up)
