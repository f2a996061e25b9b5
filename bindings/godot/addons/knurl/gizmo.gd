@tool
extends EditorNode3DGizmoPlugin
## A [KnurlDevice] in the editor: the box that its stylus reaches, its axes, and the HIP at its
## origin.

## m: the workspace of each device, by the scheme of its URI. A Touch's is its maker's figure, a
## Falcon's a cube of 4 inches.
const WORKSPACES: Dictionary = {
	"touch": Vector3(0.160, 0.120, 0.070),
	"falcon": Vector3(0.1016, 0.1016, 0.1016),
	"fake": Vector3(0.160, 0.120, 0.070),  # a simulated Touch
}
const HIP_RADIUS := 0.002


func _init() -> void:
	create_material("box", Color(1.0, 0.62, 0.2))
	create_material("x", Color(0.96, 0.2, 0.32))
	create_material("y", Color(0.53, 0.84, 0.01))
	create_material("z", Color(0.16, 0.55, 0.96))
	var hip := StandardMaterial3D.new()
	hip.albedo_color = Color(1.0, 0.62, 0.2)
	hip.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
	add_material("hip", hip)


func _get_gizmo_name() -> String:
	return "Knurl device"


func _has_gizmo(for_node_3d: Node3D) -> bool:
	return for_node_3d is KnurlDevice


func _redraw(gizmo: EditorNode3DGizmo) -> void:
	gizmo.clear()
	var device := gizmo.get_node_3d() as KnurlDevice
	var size: Vector3 = workspace_of(device)
	if size != Vector3.ZERO:
		var edges: PackedVector3Array = edges_of(AABB(-0.5 * size, size))
		gizmo.add_lines(edges, get_material("box", gizmo))
		gizmo.add_collision_segments(edges)
	var reach: float = 0.01 * device.workspace_scale
	for axis: String in ["x", "y", "z"]:
		var tip := Vector3.ZERO
		tip["xyz".find(axis)] = reach
		gizmo.add_lines(PackedVector3Array([Vector3.ZERO, tip]), get_material(axis, gizmo))
	var ball := SphereMesh.new()
	ball.radius = HIP_RADIUS * device.workspace_scale
	ball.height = 2.0 * ball.radius
	gizmo.add_mesh(ball, get_material("hip", gizmo))


## m: a device's workspace; zero if it is unknown ("mouse": no limits).
static func workspace_of(device: KnurlDevice) -> Vector3:
	return WORKSPACES.get(device.device.get_slice(":", 0), Vector3.ZERO) * device.workspace_scale


static func edges_of(box: AABB) -> PackedVector3Array:
	var edges: PackedVector3Array = []
	for corner: int in 8:
		for bit: int in [1, 2, 4]:
			if corner & bit == 0:
				edges.append(_corner(box, corner))
				edges.append(_corner(box, corner | bit))
	return edges


static func _corner(box: AABB, bits: int) -> Vector3:
	return box.position + box.size * Vector3(bits & 1, (bits >> 1) & 1, (bits >> 2) & 1)
