extends "res://suite.gd"

const RANGE := PROPERTY_HINT_RANGE


func property(object: Object, name: String) -> Dictionary:
	for p in object.get_property_list():
		if p.name == name:
			return p
	return {}


func defaults() -> void:
	var g: Resource = ClassDB.instantiate(&"KnurlGrating")
	check("a grating is a Resource", g is Resource)
	check("spatial_frequency", g.spatial_frequency == Vector2(1000, 0), g.spatial_frequency)
	check("amplitude, stiffness, damping, friction, orientation, method",
			[g.amplitude, g.stiffness, g.damping, g.friction, g.orientation, g.method] == [0.0002, 400.0, 0.0, 0.0, 0.0, 0])
	var s: Node3D = ClassDB.instantiate(&"KnurlSurface")
	check("surface", s.grating == null and not s.double_sided and s.axis == Vector3.ZERO and s.enabled)
	check("nothing is felt yet", s.get_triangle_count() == 0 and not s.is_touched())
	var d: Node3D = ClassDB.instantiate(&"KnurlDevice")
	check("device", d.device == "fake" and d.stroke == "" and d.rate == 1000.0 and d.workspace_scale == 1.0)
	check("device's switches", d.autostart and d.reconnect and d.clamp and not d.even_sensation and d.response_file == "")
	check("device at rest", not d.running and not d.in_contact and d.force == Vector3.ZERO and d.ticks == 0)
	check("device's name at rest", d.device_name == "")
	check("status at rest", d.get_status() == {"running": false})
	check("no history at rest", d.get_history(10).is_empty())
	s.free()
	d.free()


func hints() -> void:
	var g: Resource = ClassDB.instantiate(&"KnurlGrating")
	var expected := {
		"spatial_frequency": "suffix:1/m", "amplitude": "suffix:m", "stiffness": "suffix:N/m",
		"damping": "suffix:N s/m", "friction": "or_greater", "orientation": "radians_as_degrees",
	}
	for name in expected:
		var p := property(g, name)
		check(name + " has a range", p.get("hint") == RANGE, p)
		check(name + "'s hint", expected[name] in p.get("hint_string", ""), p)
		check(name + " is stored", p.get("usage", 0) & PROPERTY_USAGE_STORAGE != 0)
	check("method's names", property(g, "method").hint_string == "Default,S1,S2,Bandlimited")
	var s: Node3D = ClassDB.instantiate(&"KnurlSurface")
	var held := property(s, "grating")
	check("grating's class", held.hint == PROPERTY_HINT_RESOURCE_TYPE and held.hint_string == "KnurlGrating", held)
	var d: Node3D = ClassDB.instantiate(&"KnurlDevice")
	check("strokes", property(d, "stroke").hint_string == ",line,sweep,circle,press,rest")
	check("rate", property(d, "rate").hint_string == "100,10000,1,suffix:Hz", property(d, "rate"))
	check("what is only told is not stored", property(d, "force").usage & PROPERTY_USAGE_STORAGE == 0)
	for signal_name in ["contact_started", "contact_ended", "button_changed", "fault"]:
		check("signal " + signal_name, d.has_signal(signal_name))
	s.free()
	d.free()


# Types for completion, the class reference and typed scripts.
func types() -> void:
	var found := {}
	for method in ClassDB.class_get_method_list(&"KnurlDevice", true):
		found[method.name] = method
	check("a surface is one", found.get_touched_surface.return.class_name == &"KnurlSurface", found.get_touched_surface)
	check("start() gives an Error", found.start.return.class_name == &"Error", found.start)
	check("vibrate() takes a Vibration", found.vibrate.args[0].class_name == &"KnurlDevice.Vibration", found.vibrate)
	check("and says so", found.vibrate.args[0].usage & PROPERTY_USAGE_CLASS_IS_ENUM != 0)
	var g: Resource = ClassDB.instantiate(&"KnurlGrating")
	check("a method is a Method", property(g, "method").class_name == &"KnurlGrating.Method", property(g, "method"))
	var d: Node3D = ClassDB.instantiate(&"KnurlDevice")
	var kind := property(d, "device")
	check("devices are suggested", kind.hint == PROPERTY_HINT_ENUM_SUGGESTION and "mouse" in kind.hint_string.split(","), kind)
	var groups := d.get_property_list().filter(func(p: Dictionary) -> bool: return p.usage & PROPERTY_USAGE_GROUP != 0)
	var names := groups.map(func(p: Dictionary) -> String: return p.name)
	check("groups", ["Workspace", "Force", "Connection", "State"].all(func(n: String) -> bool: return n in names), names)
	d.free()


func setters() -> void:
	var g: Resource = ClassDB.instantiate(&"KnurlGrating")
	var changes := [0]
	g.changed.connect(func() -> void: changes[0] += 1)
	g.amplitude = 0.0005
	g.spatial_frequency = Vector2(500, 250)
	g.method = 2
	check("values are kept", g.amplitude == 0.0005 and g.spatial_frequency == Vector2(500, 250) and g.method == 2)
	check("each change is told", changes[0] == 3, changes[0])
	expect_error("KnurlGrating.amplitude: expected 0 or more")
	g.amplitude = -1.0
	expect_error("KnurlGrating.stiffness: expected 1 or more")
	g.stiffness = NAN
	expect_error("KnurlGrating.spatial_frequency: expected 0 or more")
	g.spatial_frequency = Vector2(1, -1)
	expect_error("KnurlGrating.method: expected 0 to 3")
	g.method = 5
	check("what is wrong is refused", g.amplitude == 0.0005 and g.stiffness == 400.0 and g.method == 2 and
			g.spatial_frequency == Vector2(500, 250) and changes[0] == 3)
	var s: Node3D = ClassDB.instantiate(&"KnurlSurface")
	s.grating = g
	check("a grating comes back", s.grating == g and s.get_grating() == g)
	expect_error("KnurlSurface.grating: expected a KnurlGrating")
	s.set("grating", Resource.new())
	check("another resource is refused", s.grating == g)
	check("references are counted", g.get_reference_count() == 2, g.get_reference_count())
	s.grating = null
	check("none is allowed", s.grating == null and g.get_reference_count() == 1, g.get_reference_count())
	s.grating = g
	s.free()
	check("a freed surface lets its grating go", g.get_reference_count() == 1, g.get_reference_count())
	var d: Node3D = ClassDB.instantiate(&"KnurlDevice")
	d.device = "fake:?ä=1"
	check("text is UTF-8", d.device == "fake:?ä=1", d.device)
	expect_error("KnurlDevice.rate: expected 100 to 10000")
	d.rate = 20000.0
	check("rate", d.rate == 1000.0)
	d.free()


# By name, with Variants, as scripts without types and other languages call.
func untyped() -> void:
	var g: Variant = ClassDB.instantiate(&"KnurlGrating")
	g.call("set_stiffness", 500)
	check("a whole number is a number", g.get("stiffness") == 500.0)
	var copy: Resource = g.duplicate()
	check("a copy is alike", copy.get("stiffness") == 500.0 and copy != g)
	var s: Variant = ClassDB.instantiate(&"KnurlSurface")
	s.call("set_grating", g)
	var given: Variant = s.call("get_grating")
	check("by call()", given == g)
	given = null
	check("references by call()", g.get_reference_count() == 2, g.get_reference_count())
	check("warnings by call()", s.call("get_warnings") is PackedStringArray)
	check("as the editor asks", s.call("get_warnings") == s.get_warnings())
	s.free()


func packed() -> void:
	var g: Resource = ClassDB.instantiate(&"KnurlGrating")
	g.amplitude = 0.0003
	check("saved", ResourceSaver.save(g, "user://grating.tres") == OK)
	var back: Resource = ResourceLoader.load("user://grating.tres", "", ResourceLoader.CACHE_MODE_IGNORE)
	check("and loaded", back != null and back.amplitude == 0.0003 and back.get_class() == "KnurlGrating")


func tests() -> void:
	defaults()
	hints()
	types()
	setters()
	untyped()
	packed()
