extends "res://demo.gd"
## Moving toys: a roller that turns, and a marble and a drawer that roll and slide when they are
## pushed.
##
## Arguments after "--":
## [codeblock]
## --device URI    auto, touch, falcon, rawhid, mouse (default)
## --play          a simulated finger touches one after another; then the demo ends
## --shot PATH     a picture of the window is saved while it pushes the drawer
## [/codeblock]

const Overlay := preload("res://addons/knurl/overlay.gd")
const TURN := 1.0  # rad/s
const HEIGHT := 0.03  # m: height at which the finger moves from one to the next

var _ridges := 0

@onready var _device: KnurlDevice = $KnurlDevice
@onready var _roller: AnimatableBody3D = $Surfaces/Roller
@onready var _marble: RigidBody3D = $Surfaces/Marble
@onready var _drawer: RigidBody3D = $Surfaces/Drawer


func _ready() -> void:
	$Hud.name_meshes()
	Overlay.set_shown(self, true)
	var plays: bool = OS.get_cmdline_user_args().has("--play")
	_device.device = "mouse" if plays else argument("--device", "mouse")
	$"Surfaces/Roller/Roller, turning/KnurlSurface".ridges_passed.connect(
		func(_by: KnurlDevice, count: int) -> void: _ridges += count
	)
	await warm_up()
	if _device.start() == OK and plays:
		_play()


## Physics turns the roller; Knurl renders its motion smoothly at any frame rate.
func _physics_process(delta: float) -> void:
	_roller.rotate(Vector3.RIGHT, TURN * delta)


func _play() -> void:
	$Mouse.set_physics_process(false)
	var top: Vector3 = _roller.global_position + Vector3(0, 0.02, 0)
	await _go([top + Vector3.UP * HEIGHT, top - Vector3.UP * 0.0006], 0.5)
	_ridges = 0
	await get_tree().create_timer(1.0).timeout
	var ridges: int = _ridges
	var marble: Vector3 = _marble.global_position
	var behind: Vector3 = marble + Vector3(0, 0, 0.02)
	await _go([top + Vector3.UP * HEIGHT, behind + Vector3.UP * HEIGHT, behind], 0.4)
	await _go([behind + Vector3(0, 0, -0.02)], 1.0)
	await _go([behind + Vector3.UP * HEIGHT], 0.4)
	var drawer: Vector3 = _drawer.global_position
	var front: Vector3 = drawer + Vector3(0, 0, 0.025)
	await _go([front + Vector3.UP * HEIGHT, front], 0.4)
	await _go([front + Vector3(0, 0, -0.02)], 1.2)
	print(
		(
			"toys: %d ridges a second, marble %.0f mm, drawer %.0f mm"
			% [
				ridges,
				1e3 * marble.distance_to(_marble.global_position),
				1e3 * drawer.distance_to(_drawer.global_position)
			]
		)
	)
	await end(_device)


## Moves the finger through the places at a steady speed, `seconds` for each.
func _go(places: Array, seconds: float) -> void:
	var from: Vector3 = places[0] if _device.ticks == 0 else _device.hip_position
	for to: Vector3 in places:
		var begin: int = Time.get_ticks_usec()
		var share := 0.0
		while share < 1.0:
			await get_tree().process_frame
			share = minf(1e-6 * (Time.get_ticks_usec() - begin) / seconds, 1.0)
			_device.move_hip(from.lerp(to, share))
		from = to
