@tool
extends RefCounted
## Spheres and capsules of a scene that push grass aside.

## Numbers of a collider: two ends [m], radius [m], velocity [m/s].
const STRIDE := 10
const MOST := 256

var _before := {} # centre of each in the last frame, by the id of its node


## The colliders of a SwardGrass3D, as numbers; `delta` [s] since the last call.
func update(node: Node3D, delta: float) -> PackedFloat64Array:
	var numbers := PackedFloat64Array()
	var now := {}
	for item in _items(node):
		var shape := _shape(item)
		if shape.is_empty() or numbers.size() >= STRIDE * MOST or not item.is_visible_in_tree():
			continue
		var place := item.global_transform
		var scale := place.basis.get_scale()
		var radius: float = shape.radius * maxf(scale.x, scale.z)
		var arm := place.basis.y.normalized() * maxf(0.5 * shape.height * scale.y - radius, 0.0)
		var id := item.get_instance_id()
		now[id] = place.origin
		var velocity: Vector3 = (place.origin - _before.get(id, place.origin)) / delta if delta > 0.0 else Vector3.ZERO
		for value: Vector3 in [place.origin - arm, place.origin + arm]:
			numbers.append_array([value.x, value.y, value.z])
		numbers.append_array([radius, velocity.x, velocity.y, velocity.z])
	_before = now
	return numbers


## What is wrong with the property `colliders` of a SwardGrass3D.
func warnings(node: Node3D) -> PackedStringArray:
	var wrong := PackedStringArray()
	for path: NodePath in node.get("colliders"):
		var item := node.get_node_or_null(path)
		if item == null:
			wrong.append("Collider %s: there is no such node." % path)
		elif _shapes_of(item).is_empty():
			wrong.append("Collider %s: it is no sphere or capsule, and has none." % path)
	return wrong


func _items(node: Node3D) -> Array[Node3D]:
	var items: Array[Node3D] = []
	for path: NodePath in node.get("colliders"):
		items.append_array(_shapes_of(node.get_node_or_null(path)))
	for child in node.get_children():
		items.append_array(_shapes_of(child))
	return items


# The node itself, or those of its children that have a shape: a body's.
func _shapes_of(item: Node) -> Array[Node3D]:
	var found: Array[Node3D] = []
	if item is Node3D and not _shape(item).is_empty():
		found.append(item)
	elif item:
		for child in item.get_children():
			if child is CollisionShape3D and not _shape(child).is_empty():
				found.append(child)
	return found


func _shape(item: Node) -> Dictionary:
	var shape: Resource = null
	if item is CollisionShape3D:
		shape = item.shape
	elif item is MeshInstance3D:
		shape = item.mesh
	if shape is SphereShape3D or shape is SphereMesh:
		return {"radius": shape.radius, "height": 2.0 * shape.radius}
	if shape is CapsuleShape3D or shape is CapsuleMesh:
		return {"radius": shape.radius, "height": shape.height}
	return {}
