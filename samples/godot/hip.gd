extends Node3D
## Where the HIP is (the ball), the proxy that the surface holds back (the ring), and the force on the hand (the line).

const METRES_PER_NEWTON := 0.02

var _line := ImmediateMesh.new()

@onready var _device: KnurlDevice = $"../KnurlDevice"


func _ready() -> void:
	$Force.mesh = _line


func _process(_delta: float) -> void:
	visible = _device.running
	$Ball.global_position = _device.hip_position
	$Proxy.visible = _device.in_contact
	$Proxy.global_position = _device.proxy_position
	_line.clear_surfaces()
	if _device.in_contact and not _device.force.is_zero_approx():
		_line.surface_begin(Mesh.PRIMITIVE_LINES)
		_line.surface_add_vertex(_device.proxy_position)
		_line.surface_add_vertex(_device.proxy_position + METRES_PER_NEWTON * _device.force)
		_line.surface_end()
