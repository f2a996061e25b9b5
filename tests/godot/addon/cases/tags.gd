extends SceneTree
## Tags, right and wrong, against Knurl's own loader: with "-- write" the files are written, the
## driver runs `knurl inspect` on each, and the second run expects its results.

const RIGHT := {"knurl_spatial_frequency": 1000, "knurl_amplitude": 0.0002, "knurl_stiffness": 400}
const NESTED := {
	"knurl": {"version": 1, "spatial_frequency": [1000, 500], "amplitude": 0.0002, "stiffness": 400}
}
const GRATING: Array[String] = ["amplitude", "stiffness", "damping", "friction", "orientation"]
const METHODS: Dictionary = {0: "bandlimited", 1: "S1", 2: "S2", 3: "bandlimited"}  # 0: the default

var checks: RefCounted


func _initialize() -> void:
	var files: Dictionary = right()
	files.merge(wrong())
	if OS.get_cmdline_user_args().has("write"):
		for name: String in files:
			var file := FileAccess.open("res://files/%s.gltf" % name, FileAccess.WRITE)
			file.store_string(JSON.stringify(files[name], "", false, true))
		print("1 passed, 0 failed")
		quit()
		return
	checks = load("res://checks.gd").new()
	for name: String in files:
		var said: String = FileAccess.get_file_as_string("res://files/%s.said" % name)
		var is_taken: bool = said.begins_with("{")
		checks.equal(is_taken, not wrong().has(name), name + ": the loader takes what is right")
		if is_taken:
			compare(name, files[name], JSON.parse_string(said))
		else:
			refused(name, files[name], said)
	checks.finish(self)


## Files that Knurl takes. {} is an object without a tag.
func right() -> Dictionary:
	return {
		"material": model(RIGHT, {}, {}),
		"mesh": model({}, RIGHT, {}),
		"node": model({}, {}, RIGHT),
		"nested": model(NESTED, {}, {}),
		"none": model({}, {}, {}),
		"other_extras": model({"colour": "red"}, {}, {}),
		"key_by_key":
		model(RIGHT, {"knurl_amplitude": 0.0003, "knurl_stiffness": 500}, {"knurl_stiffness": 600}),
		"forms_mixed":
		model(NESTED, {"knurl_damping": 1.5}, {"knurl": {"version": 1, "friction": 0.25}}),
		"from_parts":
		model(
			{"knurl_spatial_frequency": 700}, {"knurl_amplitude": 0.0001}, {"knurl_stiffness": 300}
		),
		"all_keys":
		model(
			RIGHT.merged(
				{
					"knurl_damping": 2,
					"knurl_friction": 0.5,
					"knurl_orientation": -0.75,
					"knurl_method": "S1",
					"knurl_axis": [0, 0, 2]
				}
			),
			{},
			{}
		),
		"smooth": model(RIGHT.merged({"knurl_spatial_frequency": [0, 0]}, true), {}, {}),
		"felt_flat": model(RIGHT.merged({"knurl_smooth": false}), {}, {}),
		"felt_smooth": model(RIGHT.merged({"knurl_smooth": 1}), {}, {}),
		"no_coordinates": model(RIGHT, {}, {}, {"attributes": {"POSITION": 0}}),
		"two_nodes":
		with_node(
			model({}, RIGHT, {}), {"mesh": 0, "name": "b", "extras": {"knurl_stiffness": 100}}
		),
		"one_of_two_primitives": with_primitive(model(RIGHT, {}, {}), {}),
		"both_primitives":
		with_primitive(model(RIGHT, {}, {}), {"knurl_stiffness": 200}.merged(RIGHT)),
		"all_by_mesh": with_primitive(model({}, RIGHT, {}), {"knurl_stiffness": 200}),
		"all_by_node": with_primitive(model({}, {}, RIGHT), {}),
	}


## Files that it refuses: each has one thing wrong.
func wrong() -> Dictionary:
	var files: Dictionary = {
		"both_forms": model(NESTED.merged({"knurl_damping": 1}), {}, {}),
		"nested_no_object": model({"knurl": 7}, {}, {}),
		"no_version": model({"knurl": {"stiffness": 400}}, {}, {}),
		"missing_amplitude":
		model({"knurl_spatial_frequency": 1000, "knurl_stiffness": 400}, {}, {}),
		"missing_all": model({}, {"knurl": {"version": 1}}, {}),
		"targets": model(RIGHT, {}, {}, {"targets": [{"POSITION": 0}]}),
		"lines": model(RIGHT, {}, {}, {"mode": 1}),
		"on_root": lost(model({}, {}, {}), "root"),
		"on_scene": lost(model({}, {}, {}), "scene"),
		"on_primitive": lost(model({}, {}, {}), "primitive"),
		"on_empty_node": with_node(model({}, {}, {}), {"name": "empty", "extras": RIGHT}),
	}
	var values: Dictionary = {
		"version": [2, "1"],
		"spatial_frequency": [-1, "fine", [1000], [1000, -1], [1, 2, 3], true],
		"amplitude": [-0.1, "a", [1]],
		"stiffness": [0, -5, null],
		"damping": [-1, {}],
		"friction": [-0.5, "x"],
		"orientation": ["north", [0]],
		"axis": [[0, 0, 0], [1, 0], [1, 0, "z"], 5],
		"method": ["S3", 2],
		"colour": [1],
	}
	for key: String in values:
		for i: int in values[key].size():
			files["wrong_%s_%d" % [key, i]] = model(
				RIGHT.merged({"knurl_" + key: values[key][i]}, true), {}, {}
			)
			var nested: Dictionary = NESTED["knurl"].merged({key: values[key][i]}, true)
			files["wrong_nested_%s_%d" % [key, i]] = model({}, {}, {"knurl": nested})
	return files


func compare(name: String, file: Dictionary, inspected: Dictionary) -> void:
	var errors: PackedStringArray = []
	var scene: Node = generate(file, errors)
	var surfaces: Array[Node] = scene.find_children("*", "KnurlSurface", true, false)
	checks.equal(errors, PackedStringArray(), name + ": nothing is wrong")
	checks.equal(surfaces.size(), inspected["surfaces"].size(), name + ": surfaces")
	for i: int in mini(surfaces.size(), inspected["surfaces"].size()):
		var expected: Dictionary = inspected["surfaces"][i]
		var found: Dictionary = by_name(surfaces, expected["name"])
		var at: String = "%s: '%s'" % [name, expected["name"]]
		checks.check(not found.is_empty(), at + " is there")
		if found.is_empty():
			continue
		var grating: Resource = found["surface"].grating
		var frequency: Array = expected["material"]["spatial_frequency"]
		checks.equal(grating.spatial_frequency, Vector2(frequency[0], frequency[1]), at)
		checks.equal(METHODS[grating.method], expected["material"]["method"], at + ": method")
		checks.equal(["auto", "off", "on"][found["surface"].smooth], expected["smooth"], at + ": smooth")
		for key: String in GRATING:
			checks.close(grating.get(key), expected["material"][key], 1e-9, "%s: %s" % [at, key])
		checks.equal(found["triangles"], int(expected["triangles"]), at + ": triangles")
	if name == "all_keys" and surfaces.size() == 1:
		checks.equal(surfaces[0].axis, Vector3(0, 0, 1), "the axis")
		checks.equal(surfaces[0].double_sided, true, "double-sided as the material is")
	scene.free()


## The surface that Knurl's loader would name so: by its node, or of several primitives "node /
## material".
func by_name(surfaces: Array[Node], name: String) -> Dictionary:
	for surface: Node in surfaces:
		var parent := surface.get_parent() as MeshInstance3D
		var names: Array[String] = [
			String(parent.name), "%s / %s" % [parent.name, parent.mesh.get("surface_0/name")]
		]
		names.append("%s / %s" % [parent.get_parent().name, parent.name])
		if names.has(name):
			@warning_ignore("integer_division")
			return {"surface": surface, "triangles": parent.mesh.get_faces().size() / 3}
	return {}


func refused(name: String, file: Dictionary, said: String) -> void:
	var errors: PackedStringArray = []
	var scene: Node = generate(file, errors)
	checks.equal(
		scene.find_children("*", "KnurlSurface", true, false).size(), 0, name + ": no surface"
	)
	checks.equal(errors.size(), 1, "%s: sentences %s" % [name, errors])
	if not errors.is_empty():
		var reason: String = errors[0].get_slice(", found", 0)
		checks.check(
			said.contains(reason),
			"%s: the loader says '%s', the add-on '%s'" % [name, said.strip_edges(), reason]
		)
	scene.free()


## The scene, and the builder's errors.
func generate(file: Dictionary, errors: PackedStringArray) -> Node:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	var collector: GLTFDocumentExtension = load("res://collector.gd").new()
	GLTFDocument.register_gltf_document_extension(collector, true)
	document.append_from_buffer(JSON.stringify(file, "", false, true).to_utf8_buffer(), "", state)
	var scene: Node = document.generate_scene(state)
	GLTFDocument.unregister_gltf_document_extension(collector)
	errors.append_array(collector.errors)
	return scene


## A unit square with uvs, and the extras of its material, mesh and node.
func model(
	material: Dictionary, mesh: Dictionary, node: Dictionary, primitive: Dictionary = {}
) -> Dictionary:
	var floats: PackedFloat32Array = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1]
	var bytes: PackedByteArray = floats.to_byte_array()
	bytes.append_array(PackedByteArray([0, 0, 1, 0, 2, 0, 0, 0, 2, 0, 3, 0]))
	return {
		"asset": {"version": "2.0"},
		"scene": 0,
		"scenes": [{"nodes": [0]}],
		"nodes": [{"name": "a", "mesh": 0, "extras": node}],
		"meshes":
		[
			{
				"name": "square",
				"extras": mesh,
				"primitives":
				[
					(
						{
							"attributes": {"POSITION": 0, "TEXCOORD_0": 1},
							"indices": 2,
							"material": 0
						}
						. merged(primitive, true)
					)
				],
			}
		],
		"materials": [{"name": "m", "doubleSided": true, "extras": material}],
		"buffers":
		[
			{
				"byteLength": bytes.size(),
				"uri": "data:application/octet-stream;base64," + Marshalls.raw_to_base64(bytes),
			}
		],
		"bufferViews":
		[
			{"buffer": 0, "byteLength": 48},
			{"buffer": 0, "byteOffset": 48, "byteLength": 32},
			{"buffer": 0, "byteOffset": 80, "byteLength": 12},
		],
		"accessors":
		[
			{
				"bufferView": 0,
				"componentType": 5126,
				"count": 4,
				"type": "VEC3",
				"min": [0, 0, 0],
				"max": [1, 1, 0]
			},
			{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
			{"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},
		],
	}


func with_node(file: Dictionary, node: Dictionary) -> Dictionary:
	file["nodes"].append(node)
	file["scenes"][0]["nodes"].append(1)
	return file


## The same square once more, with a material of its own.
func with_primitive(file: Dictionary, material: Dictionary) -> Dictionary:
	file["materials"].append({"name": "second", "extras": material})
	var primitive: Dictionary = file["meshes"][0]["primitives"][0].duplicate(true)
	primitive["material"] = 1
	file["meshes"][0]["primitives"].append(primitive)
	return file


func lost(file: Dictionary, where: String) -> Dictionary:
	match where:
		"root":
			file["extras"] = RIGHT
		"scene":
			file["scenes"][0]["extras"] = RIGHT
		"primitive":
			file["meshes"][0]["primitives"][0]["extras"] = RIGHT
	return file
