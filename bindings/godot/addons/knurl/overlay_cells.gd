@tool
extends RefCounted
## A [GridMap]'s cells, drawn once more with the material of the ridges: the node itself takes no
## overlay. They exist in the rendering server alone, so that a click in the editor finds the map.

const PERIOD := 250  # ms between looks at the cells, which no signal tells of: 10 000 take 9 ms

## The meshes that are drawn, as [method GridMap.get_meshes] gives them: a Transform3D, a Mesh, and so on.
var pairs: Array = []

var _instances: Array[RID] = []
var _multimeshes: Array[RID] = []
var _map: GridMap
var _looked: int  # ms


## Follows a map; null removes what is drawn. Returns true if its cells have changed.
func follow(map: GridMap) -> bool:
	var now: int = Time.get_ticks_msec()
	if map == _map and (map == null or now - _looked < PERIOD):
		return false
	_map = map
	_looked = now
	var found: Array = map.get_meshes() if map != null else []
	if found == pairs:
		return false
	pairs = found
	hide()
	return true


## Draws the cells at the map's place, which may have moved.
func draw(material: RID) -> void:
	if _instances.is_empty():
		_make(material)
	for instance: RID in _instances:
		RenderingServer.instance_set_transform(instance, _map.global_transform)
		RenderingServer.instance_set_visible(instance, _map.is_visible_in_tree())


## Until [method draw] is called.
func hide() -> void:
	for drawn: RID in _instances + _multimeshes:
		RenderingServer.free_rid(drawn)
	_instances.clear()
	_multimeshes.clear()


func _make(material: RID) -> void:
	var places: Dictionary = {}  # of each mesh
	for i: int in range(0, pairs.size(), 2):
		places.get_or_add(pairs[i + 1], []).append(pairs[i])
	for mesh: Mesh in places:
		var many: RID = RenderingServer.multimesh_create()
		RenderingServer.multimesh_allocate_data(
			many, places[mesh].size(), RenderingServer.MULTIMESH_TRANSFORM_3D
		)
		RenderingServer.multimesh_set_mesh(many, mesh.get_rid())
		for i: int in places[mesh].size():
			RenderingServer.multimesh_instance_set_transform(many, i, places[mesh][i])
		var instance: RID = RenderingServer.instance_create2(many, _map.get_world_3d().scenario)
		RenderingServer.instance_geometry_set_material_override(instance, material)
		_multimeshes.append(many)
		_instances.append(instance)
