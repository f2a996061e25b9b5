extends GLTFDocumentExtension
## The importer, with its warnings recorded for checks.

var errors: PackedStringArray = []


func _import_post(state: GLTFState, root: Node) -> Error:
	var builder: RefCounted = load("res://addons/knurl/surface_builder.gd").new(state, root)
	builder.build()
	errors = builder.errors()
	return OK
