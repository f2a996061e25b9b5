extends "res://suite.gd"

# Nothing is left behind: threads, handles and memory before and after 100 rounds.


func memory_kib() -> int:
	var status := FileAccess.open("/proc/self/status", FileAccess.READ)
	var line := status.get_line()
	while line != "" and not line.begins_with("VmRSS:"):
		line = status.get_line()
	return line.trim_prefix("VmRSS:").to_int()


func threads() -> int:
	return count("/proc/self/task")


func handles() -> int:
	return count("/proc/self/fd")


func round_of_a_device() -> void:
	var s := make_surface(plate())
	var d := make_device("fake", "line")
	d.load_gltf("res://plate_1d.glb")
	d.start()
	await frames(1)
	s.get_warnings()
	d.get_history(100)
	d.get_status()
	clear()


func devices() -> void:
	for i in 5: # for one-time allocations
		await round_of_a_device()
	var before := [threads(), handles()]
	var kib := memory_kib()
	check("there is something to count", before[0] > 0 and before[1] > 2 and kib > 1000, [before, kib])
	for i in 100:
		await round_of_a_device()
	await seconds(0.1)
	check("100 starts and stops leave no thread and no handle", [threads(), handles()] == before, [threads(), handles(), before])
	print("note: 100 starts and stops: %d KiB more" % (memory_kib() - kib))
	check("and little memory", memory_kib() - kib < 1024, memory_kib() - kib)


func extensions() -> void:
	const PATH := "res://knurl.gdextension"
	for i in 3:
		check("unloads", GDExtensionManager.unload_extension(PATH) == GDExtensionManager.LOAD_STATUS_OK)
		check("loads", GDExtensionManager.load_extension(PATH) == GDExtensionManager.LOAD_STATUS_OK)
	var before := [threads(), handles()]
	var kib := memory_kib()
	var ok := true
	for i in 100:
		ok = ok and GDExtensionManager.unload_extension(PATH) == GDExtensionManager.LOAD_STATUS_OK
		ok = ok and not ClassDB.class_exists(&"KnurlDevice")
		ok = ok and GDExtensionManager.load_extension(PATH) == GDExtensionManager.LOAD_STATUS_OK
		var d := make_device("fake", "rest")
		ok = ok and d.start() == OK
		await frames(1)
		d.free()
	check("100 rounds of loading and unloading", ok)
	await seconds(0.1)
	check("leave no thread and no handle", [threads(), handles()] == before, [threads(), handles(), before])
	print("note: 100 loads and unloads: %d KiB more" % (memory_kib() - kib))
	check("and little memory", memory_kib() - kib < 2048, memory_kib() - kib)


func tests() -> void:
	await devices()
	await extensions()
