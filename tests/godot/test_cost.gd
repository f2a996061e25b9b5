extends "res://suite.gd"

# Cost of the binding on the game's thread per frame: 100 surfaces, of which 10 move. Goal: 50 us.
# Printed, not
# asserted: machines differ.

const SURFACES := 100
const MOVING := 10
const FRAMES := 600


func percentile(times: Array, share: float) -> float:
	times.sort()
	return times[int(share * (times.size() - 1))]


# The device's part of a frame, called like the engine does, without the script's own moves.
func frame(device: Node3D, moving: Array, step: int) -> float:
	for s in moving:
		s.get_parent().position.y = -0.02 + 0.001 * sin(0.1 * step)
		s.force_update_transform() # the engine sends its notifications of moves; this is its own cost
	var begin := Time.get_ticks_usec()
	device.notification(Node.NOTIFICATION_INTERNAL_PROCESS)
	return float(Time.get_ticks_usec() - begin)


func tests() -> void:
	var all := []
	for i in SURFACES:
		all.append(make_surface(plate(0.02), Vector3(0.03 * (i % 10) - 0.15, -0.02, 0.03 * (i / 10) - 0.15)))
	var d := make_device("fake", "line")
	check("starts", d.start() == OK)
	await frames(5)
	check("all are there", d.get_status().surfaces == SURFACES)
	for moving in [0, MOVING, SURFACES]:
		var times := []
		for i in FRAMES:
			times.append(frame(d, all.slice(0, moving), i))
			await frames(1)
		print("note: %d surfaces, %d move: median %.0f us, p99 %.0f us, max %.0f us a frame" % [SURFACES, moving,
				percentile(times, 0.5), percentile(times, 0.99), percentile(times, 1.0)])
	var begin := Time.get_ticks_usec()
	for i in 1000:
		d.notification(Node.NOTIFICATION_INTERNAL_PROCESS)
	print("note: nothing moves, in a row: %.2f us a frame" % (float(Time.get_ticks_usec() - begin) / 1000.0))
	begin = Time.get_ticks_usec()
	for i in 1000:
		frame(d, all.slice(0, MOVING), i)
	print("note: 10 move, in a row, with the engine's and the script's part: %.2f us a frame" % (float(Time.get_ticks_usec() - begin) / 1000.0))
	check("and runs", d.running)
	clear()
