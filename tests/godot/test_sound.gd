extends "res://suite.gd"

# A device's sound at the output of the engine's mixer (the Dummy driver's, at 44100 Hz).

var capture := AudioEffectCapture.new()


# The loudest sample in some seconds, or INF if one is not finite.
func listen(duration: float) -> float:
	var peak := 0.0
	capture.clear_buffer()
	await seconds(duration)
	for frame in capture.get_buffer(capture.get_frames_available()):
		if not (is_finite(frame.x) and frame.x == frame.y):
			return INF
		peak = maxf(peak, absf(frame.x))
	return peak


func is_silent() -> bool:
	for i in 20: # the mixer's own volumes fade too
		if await listen(0.1) == 0.0:
			return true
	return false


func stroked() -> Node3D:
	make_surface(plate())
	var d := make_device("fake", "line")
	d.sound = true
	d.start()
	await until(func() -> bool: return d.in_contact and d.velocity.length() > 0.05)
	return d


func sounds(peak: float) -> bool:
	return peak > 0.001 and peak <= 1.0


func strokes() -> void:
	var d: Node3D = await stroked()
	var peak := await listen(0.5)
	check("a stroke sounds", sounds(peak), peak)
	check("by a player of its own", d.get_node("Sound") is AudioStreamPlayer and d.get_child_count() == 1)
	d.sound = false
	check("it can be turned off", await is_silent())
	d.sound = true
	peak = await listen(0.5)
	check("and on again", sounds(peak), peak)
	d.stop()
	check("a device that stops is silent", await is_silent())
	d.start()
	await until(func() -> bool: return d.in_contact and d.velocity.length() > 0.05)
	peak = await listen(0.5)
	check("and sounds in its next run", sounds(peak), peak)
	d.free()
	check("one that is freed is silent", await is_silent())
	clear()


func rests() -> void:
	make_surface(plate())
	var d := make_device("mouse")
	d.sound = true
	d.start()
	d.move_hip(Vector3(0, 0.01, 0))
	await until(func() -> bool: return d.ticks > 100)
	d.move_hip(Vector3(0, -0.001, 0))
	check("a finger that rests", await until(func() -> bool: return d.in_contact and d.velocity == Vector3.ZERO))
	check("is silent", await is_silent())
	check("and stays so", await listen(0.3) == 0.0)
	clear()


# A player of the game's, on a bus of its own.
func routes() -> void:
	AudioServer.add_bus(1)
	AudioServer.set_bus_name(1, "Coil")
	AudioServer.set_bus_mute(1, true)
	make_surface(plate())
	var d := make_device("fake", "line")
	var player := AudioStreamPlayer3D.new()
	player.name = "Sound"
	player.bus = &"Coil"
	d.add_child(player)
	d.sound = true
	d.start()
	await until(func() -> bool: return d.in_contact and d.velocity.length() > 0.05)
	check("the game's player plays", player.playing and d.get_child_count() == 1)
	check("on its bus alone", await listen(0.3) == 0.0)
	clear()
	AudioServer.remove_bus(1)


# The motors of a gamepad, which need not be connected for the engine to note their strength.
func rumbles() -> void:
	make_surface(plate(0.2)).grating.spatial_frequency = Vector2(1000, 0)
	var d := make_device("fake", "line")
	d.rumble = 3
	d.start()
	check("a stroke turns the motors", await until(func() -> bool: return Input.get_joy_vibration_strength(3).x > 0.02),
			Input.get_joy_vibration_strength(3))
	check("above all the fast one, at 100 ridges a second", await until(func() -> bool:
		return Input.get_joy_vibration_strength(3).x > Input.get_joy_vibration_strength(3).y),
			Input.get_joy_vibration_strength(3))
	check("within their strength", Input.get_joy_vibration_strength(3).x <= 1.0)
	d.rumble = 4
	check("another gamepad takes over", Input.get_joy_vibration_strength(3) == Vector2.ZERO)
	check("at once", await until(func() -> bool: return Input.get_joy_vibration_strength(4).x > 0.02))
	d.stop()
	check("and stops with the device", Input.get_joy_vibration_strength(4) == Vector2.ZERO)
	clear()


func tests() -> void:
	await rumbles()
	AudioServer.add_bus_effect(0, capture)
	await strokes()
	await rests()
	await routes()
	var d: Node3D = await stroked() # and the engine ends meanwhile
	check("sounds to the end", d.running and sounds(await listen(0.2)))
