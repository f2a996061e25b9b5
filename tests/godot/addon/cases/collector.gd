extends GLTFDocumentExtension
## The importer, with what it would warn of kept to be looked at.

var errors: PackedStringArray = []


func _import_post(state: GLTFState, root: Node) -> Error:
	var builder: RefCounted = load("res://addons/knurl/surface_builder.gd").new(state, root)
	builder.build()
	errors = builder.errors()
	return OK
