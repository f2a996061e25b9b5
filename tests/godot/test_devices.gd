extends "res://suite.gd"


func runs_and_stops() -> void:
	var d := make_device("fake", "line")
	make_surface(plate())
	check("starts", d.start() == OK)
	check("runs", d.running)
	check("twice is fine", d.start() == OK)
	check("has a name", "simulated Touch" in d.device_name, d.device_name)
	check("ticks", await until(func() -> bool: return d.ticks > 500))
	check("feels", await until(func() -> bool: return d.in_contact and d.force.y > 0.05))
	check("the proxy lies on the plate", absf(d.proxy_position.y) < 1e-6, d.proxy_position)
	check("the hip lies below", d.hip_position.y < 0.0, d.hip_position)
	check("ridges are crossed", await until(func() -> bool: return absf(d.temporal_frequency - 100.0) < 15.0))
	var history: PackedFloat32Array = d.get_history(1000)
	check("a history of pairs", history.size() >= 2 * 500 and history.size() <= 2000, history.size())
	var heights := {}
	for i in history.size() / 2:
		heights[snappedf(history[2 * i], 1e-7)] = true
	check("of ridges and grooves", heights.has(snappedf(0.0002, 1e-7)) and heights.has(snappedf(-0.0002, 1e-7)), heights.keys())
	check("no more than there is room for", d.get_history(1000000).size() <= 2 * 8192)
	var status: Dictionary = d.get_status()
	check("status", status.running and status.ticks > 500 and status.surfaces == 1 and status.max_force == 3.3)
	d.stop()
	check("stopped", not d.running and d.force == Vector3.ZERO and not d.in_contact)
	d.stop()
	check("starts again", d.start() == OK and d.running)
	clear()


func starts_by_itself() -> void:
	var d: Node3D = ClassDB.instantiate(&"KnurlDevice")
	root.add_child(d)
	check("not before its first frame", not d.running)
	check("but in it", await until(func() -> bool: return d.running))
	root.remove_child(d)
	check("stops with leaving", not d.running)
	root.add_child(d)
	check("starts with coming back", await until(func() -> bool: return d.running))
	clear()


# At 100 ridges a second, the stroke's, the model leaves 0.37 of the amplitude; less at its ends.
func even_sensation() -> void:
	var d := make_device("fake", "line")
	make_surface(plate())
	d.even_sensation = true
	check("starts by the model", d.start() == OK)
	check("feels", await until(func() -> bool: return d.ticks > 800 and d.in_contact))
	var greatest := 0.0
	var history: PackedFloat32Array = d.get_history(8192)
	for i in history.size() / 2:
		greatest = maxf(greatest, absf(history[2 * i]))
	check("lower ridges", greatest > 0.00005 and greatest < 0.0002 * 1.28 * 0.4, greatest)
	d.stop()
	d.response_file = "user://response.csv"
	var file := FileAccess.open(d.response_file, FileAccess.WRITE)
	file.store_string("# knurl response 1\nfrequency_hz,gain\n20,1\n400,1\n")
	file.close()
	check("starts by a response", d.start() == OK)
	d.stop()
	file = FileAccess.open(d.response_file, FileAccess.WRITE)
	file.store_string("# knurl response 1\nfrequency_hz,gain\n20,1\n400,-1\n")
	file.close()
	expect_error("response: line 4: expected a gain above 0")
	check("a response that is wrong", d.start() == ERR_FILE_CORRUPT)
	d.response_file = "res://nothing.csv"
	expect_error("expected a file that can be read, found 'res://nothing.csv'")
	check("a response that is not there", d.start() == ERR_FILE_CANT_READ and not d.running)
	d.even_sensation = false
	check("off", d.start() == OK)
	clear()


func refuses() -> void:
	var d := make_device("nonsense")
	expect_error("found 'nonsense'")
	check("an unknown device", d.start() == ERR_INVALID_PARAMETER and not d.running)
	d.device = "fake:?speed=1"
	expect_error("expected key=value with a key of")
	check("a wrong key", d.start() == ERR_INVALID_PARAMETER)
	d.device = "fake"
	d.stroke = "wiggle"
	expect_error("'wiggle'")
	check("a wrong stroke", d.start() == ERR_INVALID_PARAMETER)
	expect_error("KnurlDevice.load_gltf")
	check("a file that is not there", d.load_gltf("res://nothing.glb") == -1)
	d.stroke = ""
	check("and is well after all that", d.start() == OK)
	root.remove_child(d)
	expect_error("inside a scene tree")
	check("outside of the tree", d.start() != OK and not d.running)
	d.free()
	var many: Array[Node3D] = []
	for i in 8:
		many.append(make_device())
		check("device %d of 8" % i, many[i].start() == OK)
	var ninth := make_device()
	expect_error("at most 8 devices")
	check("a ninth", ninth.start() != OK and not ninth.running)
	many[3].stop()
	check("takes a place that is free", ninth.start() == OK)
	clear()


func tells() -> void:
	var s := make_surface(plate())
	var d := make_device("fake:?press_at=0.5", "press")
	var told := []
	d.contact_started.connect(func(what: Node) -> void: told.append(["started", what]))
	d.contact_ended.connect(func(what: Node) -> void: told.append(["ended", what]))
	d.button_changed.connect(func(index: int, pressed: bool) -> void: told.append(["button", index, pressed]))
	check("starts", d.start() == OK)
	check("a contact", await until(func() -> bool: return told.has(["started", s])))
	check("the surface knows", s.is_touched())
	check("a button", await until(func() -> bool: return told.has(["button", 0, true])))
	check("and its end", await until(func() -> bool: return told.has(["button", 0, false])))
	s.get_parent().remove_child(s)
	check("removed while touched: ended", await until(func() -> bool: return told.has(["ended", s])))
	check("and no force", not s.is_touched() and await until(func() -> bool: return d.force == Vector3.ZERO and not d.in_contact))
	s.free()
	check("each once", told.size() == 4, told)
	clear()


func ends_with_the_finger() -> void:
	var s := make_surface(plate())
	var d := make_device("mouse")
	var told := []
	d.contact_started.connect(func(what: Node) -> void: told.append(what))
	d.contact_ended.connect(func(what: Node) -> void: told.append(what))
	d.start()
	await seconds(0.05)
	check("a mouse that has not moved is nowhere", d.ticks == 0 and d.force == Vector3.ZERO)
	d.move_hip(Vector3(0, 0.02, 0))
	check("then it ticks", await until(func() -> bool: return d.ticks > 50))
	d.move_hip(Vector3(0, -0.002, 0))
	check("down", await until(func() -> bool: return told == [s]), told)
	check("pressed", await until(func() -> bool: return d.force.y > 0.5), d.force)
	d.move_hip(Vector3(0, 0.02, 0))
	check("up", await until(func() -> bool: return told == [s, s]), told)
	clear()


func dies_and_lives() -> void:
	var told := []
	var d := make_device("fake:?lose_at=0.2")
	d.fault.connect(func(code: int, text: String) -> void: told.append([code, text]))
	d.start()
	check("lost", await until(func() -> bool: return told.any(func(t: Array) -> bool: return t[0] == 1 and "gone" in t[1])), told)
	check("found again", await until(func() -> bool: return told.any(func(t: Array) -> bool: return t[0] == 33)), told)
	check("and runs", d.running and await until(func() -> bool: return d.ticks > 300))
	clear()
	told.clear()
	var e := make_device("fake:?lose_at=0.2")
	e.reconnect = false
	e.fault.connect(func(code: int, text: String) -> void: told.append([code, text]))
	e.start()
	check("without reconnect it stops", await until(func() -> bool: return not e.running))
	check("and says why", told.any(func(t: Array) -> bool: return t[0] == 1), told)
	clear()


func pauses_and_hangs() -> void:
	var d := make_device("fake", "rest")
	make_surface(plate())
	d.start()
	check("pressed", await until(func() -> bool: return d.force.length() > 0.05))
	paused = true
	check("a pause zeroes the force", await until(func() -> bool: return d.force == Vector3.ZERO, 1.0), d.force)
	check("and holds on to the device", d.running)
	paused = false
	check("and comes back", await until(func() -> bool: return d.force.length() > 0.05))
	d.paused = true
	check("it can pause by itself", await until(func() -> bool: return d.force == Vector3.ZERO and not d.in_contact), d.force)
	var ticks: int = d.ticks
	check("its ticks go on", await until(func() -> bool: return d.ticks > ticks + 400) and d.paused and d.force == Vector3.ZERO)
	d.paused = false
	check("and it comes back", await until(func() -> bool: return d.force.length() > 0.05))
	OS.delay_msec(400)
	check("a game that hangs has no force", d.force == Vector3.ZERO, d.force)
	check("and comes back as well", await until(func() -> bool: return d.force.length() > 0.05))
	clear()


# A paused tree does not process the device's node; contacts end all the same, with a signal.
func a_paused_tree_ends_what_is_touched() -> void:
	var d := make_device("fake", "rest")
	var s := make_surface(plate())
	var told := []
	d.contact_started.connect(func(_surface: Node) -> void: told.append("started"))
	d.contact_ended.connect(func(_surface: Node) -> void: told.append("ended"))
	d.start()
	for i in 3:
		check("touched", await until(func() -> bool: return s.is_touched() and d.in_contact))
		paused = true
		check("ended", await until(func() -> bool: return told.back() == "ended", 1.0), told)
		check("and all say so", not s.is_touched() and not d.in_contact and d.get_touched_surface() == null)
		paused = false
	check("touched again", await until(func() -> bool: return told.size() == 7 and s.is_touched()), told)
	paused = true
	paused = false
	await seconds(0.3)
	check("a pause of no length loses nothing", s.is_touched() and d.in_contact, told)
	clear()


func goes_on_elsewhere_in_the_tree() -> void:
	var d := make_device("fake", "rest")
	var s := make_surface(plate())
	var shelf := Node3D.new()
	root.add_child(shelf)
	d.start()
	check("touched", await until(func() -> bool: return s.is_touched()))
	var told := []
	d.contact_ended.connect(func(_surface: Node) -> void: told.append(1))
	var ticks: int = d.ticks
	d.reparent(shelf)
	check("it runs on", d.running and d.ticks >= ticks)
	check("its ticks go on", await until(func() -> bool: return d.ticks > ticks + 100))
	await frames(3)
	check("what it touches stays touched", s.is_touched() and told.is_empty(), told)
	shelf.position.x = 1.0
	check("and it follows its new parent", await until(func() -> bool: return absf(d.hip_position.x - 1.0) < 0.1), d.hip_position)
	shelf.remove_child(d)
	check("out of the tree it stops", not d.running)
	await frames(2)
	root.add_child(d)
	await frames(2)
	check("for good", not d.running)
	clear()


func leaves_with_its_scene() -> void:
	var packed := PackedScene.new()
	var scene := Node3D.new()
	var inner: Node3D = ClassDB.instantiate(&"KnurlDevice")
	scene.add_child(inner)
	inner.owner = scene
	packed.pack(scene)
	scene.free()
	var started := change_scene_to_packed(packed)
	check("a scene", started == OK and await until(func() -> bool: return current_scene != null))
	var d := current_scene.get_child(0)
	check("runs", await until(func() -> bool: return d.running))
	var threads := count("/proc/self/task")
	unload_current_scene()
	await frames(2)
	check("the haptic threads went with it", count("/proc/self/task") < threads, [count("/proc/self/task"), threads])
	clear()


func stopped_by_its_own_signals() -> void:
	var d := make_device("fake", "rest")
	make_surface(plate())
	d.contact_started.connect(func(_surface: Node) -> void: d.stop())
	d.start()
	check("a handler may stop it", await until(func() -> bool: return not d.running))
	d.contact_ended.connect(func(_surface: Node) -> void: d.queue_free())
	d.start()
	var id := d.get_instance_id()
	check("or free it", await until(func() -> bool: return not is_instance_id_valid(id)))
	clear()


func handlers_that_free_surfaces() -> void:
	var all := []
	for i in 5:
		all.append(make_surface(plate()))
	var d := make_device("fake", "rest")
	var ended := [0]
	d.contact_ended.connect(func(_surface: Node) -> void:
		ended[0] += 1
		for s in all:
			if is_instance_valid(s) and s.get_parent().is_inside_tree():
				s.get_parent().free())
	d.start()
	check("touched", await until(func() -> bool: return d.in_contact))
	await frames(2)
	for s in all:
		s.enabled = false
	check("all are freed by the handler", await until(func() -> bool: return ended[0] > 0 and d.get_status().surfaces == 0))
	await frames(2)
	check("the device goes on", d.running and ended[0] == 1, ended[0])
	clear()
	var s := make_surface(plate())
	var e := make_device("fake", "rest")
	var told := []
	e.contact_started.connect(func(_surface: Node) -> void: told.append(1))
	e.contact_ended.connect(func(what: Node) -> void: told.append(what == s))
	e.start()
	check("touched again", await until(func() -> bool: return told == [1]))
	s.enabled = false
	check("switched off while touched: ended", await until(func() -> bool: return told == [1, true]), told)
	s.grating.stiffness = 300.0
	s.grating = null
	await frames(2)
	check("and no grating is no crash", e.running)
	clear()


func tests() -> void:
	await runs_and_stops()
	await starts_by_itself()
	await even_sensation()
	await refuses()
	await tells()
	await ends_with_the_finger()
	await dies_and_lives()
	await pauses_and_hangs()
	await a_paused_tree_ends_what_is_touched()
	await goes_on_elsewhere_in_the_tree()
	await leaves_with_its_scene()
	await stopped_by_its_own_signals()
	await handlers_that_free_surfaces()
