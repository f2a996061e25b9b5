extends "res://suite.gd"

# Ridges that slide by under a finger that rests: an AnimatableBody3D at 100 mm/s over 1000 ridges/m, so that at 1 kHz a
# ridge lasts 10 ticks, at several pairs of frame and physics rates.

const SPEED := 0.1
const LENGTH := 1.0


func long_plate() -> PlaneMesh:
	var mesh := PlaneMesh.new()
	mesh.size = Vector2(LENGTH, 0.1)
	return mesh


# The gaps between ridges in the last ticks, in ticks, without the shortest and longest 2 %, because
# threads are late now and then. [shortest, longest]
func gaps(device: Node3D, ticks: int) -> Array:
	var rows: PackedFloat32Array = device.get_history(ticks)
	var found := []
	var last := -1
	for i in range(1, rows.size() / 2):
		if rows[2 * i - 2] < 0.0 and rows[2 * i] > 0.0:
			if last >= 0:
				found.append(i - last)
			last = i
	if found.size() < 20:
		return [0, 999]
	found.sort()
	return [found[int(0.02 * found.size())], found[int(0.98 * (found.size() - 1))]]


func slide(body: Node3D, physics: bool) -> Array:
	var s := make_surface(long_plate())
	s.grating.method = 1
	s.grating.amplitude = 0.0001
	var instance: Node3D = s.get_parent()
	root.remove_child(instance)
	root.add_child(body)
	body.add_child(instance)
	s.axis = Vector3(1, 0, 0)
	body.position.x = 0.5 * LENGTH - 0.1
	var d := make_device("mouse")
	d.start()
	d.move_hip(Vector3(0, 0.01, 0))
	await until(func() -> bool: return d.ticks > 20)
	d.move_hip(Vector3(0, -0.001, 0))
	await until(func() -> bool: return d.in_contact)
	var begin: int = d.ticks
	while d.ticks < begin + 2500:
		if physics:
			await physics_frame
			body.position.x -= SPEED / Engine.physics_ticks_per_second
		else:
			await process_frame
			body.position.x -= SPEED * root.get_process_delta_time()
	var found := gaps(d, 2000)
	clear()
	return found


func tests() -> void:
	for rates in [[144, 60], [240, 60], [60, 60], [30, 60], [100, 120], [240, 30]]:
		Engine.max_fps = rates[0]
		Engine.physics_ticks_per_second = rates[1]
		var found := []
		for attempt in 3: # because the machine may stall
			found = await slide(AnimatableBody3D.new(), true)
			if found[0] >= 9 and found[1] <= 11:
				break
		print("note: %d frames and %d steps a second: gaps of %d to %d ticks" % [rates[0], rates[1], found[0], found[1]])
		check("a body that physics moves is felt evenly at %s" % [rates], found[0] >= 9 and found[1] <= 11, found)
	Engine.physics_ticks_per_second = 60
	for rate in [45, 144]:
		Engine.max_fps = rate
		var found: Array = await slide(Node3D.new(), false)
		print("note: moved in %d frames a second: gaps of %d to %d ticks" % [rate, found[0], found[1]])
		check("so is what a script moves in %d frames a second" % rate, found[0] >= 9 and found[1] <= 11, found)
