extends SceneTree
## Every preset loads, and asks no more than a Touch can play.

const FOLDER := "res://addons/knurl/presets/"
const TOUCH_FORCE := 3.3 # N
const T3_SWING := 2.9 # the largest swing of a method's square wave, in amplitudes (the 400 Hz mix: 1.143 + 1.731)


func _initialize() -> void:
	var checks: RefCounted = load("res://checks.gd").new()
	var names: PackedStringArray = DirAccess.get_files_at(FOLDER)
	checks.equal(names.size(), 7, "presets")
	for name: String in names:
		var grating: Resource = load(FOLDER + name)
		checks.check(grating != null and grating.is_class("KnurlGrating"), name + " is a KnurlGrating")
		if grating == null:
			continue
		checks.check(grating.spatial_frequency.x > 0.0, name + " has a period")
		checks.check(T3_SWING * grating.stiffness * grating.amplitude < TOUCH_FORCE, name + " is within a Touch's force")
	# The paper's Experiment 3: 0.5, 1 and 2 mm at 0.7 N/mm.
	for pair: Array in [["paper_0_5mm", 2000.0], ["paper_1mm", 1000.0], ["paper_2mm", 500.0]]:
		var grating: Resource = load(FOLDER + pair[0] + ".tres")
		checks.equal(grating.spatial_frequency, Vector2(pair[1], 0.0), pair[0])
		checks.equal(grating.stiffness, 700.0, pair[0] + "'s stiffness")
	checks.finish(self)
