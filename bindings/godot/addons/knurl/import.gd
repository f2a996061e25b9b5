@tool
class_name KnurlGltf
extends GLTFDocumentExtension
## Makes [KnurlSurface] children of the meshes of a glTF file whose materials, meshes or nodes carry
## a knurl tag in their [code]extras[/code]: one for each node and tagged primitive, as Knurl's own
## loader does.
##
## The plugin registers it in the editor. In a game that loads glTF files while it runs, call
## [method register] first. Tags are read from the file's JSON, so engines that do not keep extras
## as metadata (before 4.4) do as well.

const Builder := preload("surface_builder.gd")

static var _registered: GLTFDocumentExtension


## Makes GLTFDocument create surfaces from tags. May be called again.
static func register() -> void:
	if _registered == null:
		_registered = new()
		# First, because the engine's own extension replaces the nodes that the builder works on.
		GLTFDocument.register_gltf_document_extension(_registered, true)


## Undoes [method register].
static func unregister() -> void:
	if _registered != null:
		GLTFDocument.unregister_gltf_document_extension(_registered)
		_registered = null


func _import_post(state: GLTFState, root: Node) -> Error:
	var builder := Builder.new(state, root)
	builder.build()
	for sentence: String in builder.errors():
		push_warning(
			"Knurl: %s: %s" % [state.filename if state.filename else "glTF data", sentence]
		)
	return OK
