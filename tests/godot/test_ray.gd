extends "res://suite.gd"

# Hits of a line segment on surfaces, for pointers, guns or shadows.


func tests() -> void:
	var s := make_surface(plate(), Vector3(0.2, 0.03, 0))
	var d := make_device("mouse")
	var above := Vector3(0.21, 1.03, 0.02)
	var below := Vector3(0.21, -1, 0.02)
	check("nothing where no device runs", d.cast_ray(above, below) == {})
	d.start()
	var hit: Dictionary = d.cast_ray(above, below)
	check("the surface", hit.get("surface") == s, hit)
	check("where", hit.get("position", Vector3.ZERO).is_equal_approx(Vector3(0.21, 0.03, 0.02)), hit)
	check("how it lies", hit.get("normal", Vector3.ZERO).is_equal_approx(Vector3.UP), hit)
	check_near("how far", hit.get("distance", -1.0), 1.0, 1e-6)
	check("not from behind", d.cast_ray(below, above) == {})
	s.double_sided = true
	await frames(3)
	check("but if it is double-sided", d.cast_ray(below, above).get("surface") == s)
	check("not beside it", d.cast_ray(above + Vector3.RIGHT, below + Vector3.RIGHT) == {})
	check("not before it", d.cast_ray(above, above - Vector3(0, 0.9, 0)) == {})
	s.get_parent().position.y = 0.5
	await until(func() -> bool: return d.cast_ray(above, below).get("distance", 0.0) < 0.6)
	check_near("it follows a move", d.cast_ray(above, below).get("distance", -1.0), 0.53, 1e-3)
	expect_error("KnurlDevice.cast_ray")
	check("no number is no line", d.cast_ray(Vector3(NAN, 0, 0), below) == {})
	s.get_parent().free()
	check("freed: gone", d.cast_ray(above, below) == {})
	check("a file's surfaces", d.load_gltf("res://plate_1d.glb") > 0)
	d.stop()
	d.start()
	hit = d.cast_ray(Vector3(0, 1, 0), Vector3(0, -1, 0))
	check("have no node", hit.has("position") and hit.surface == null, hit)
	clear()
