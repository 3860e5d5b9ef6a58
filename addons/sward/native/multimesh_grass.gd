@tool
extends Node3D
## Grass as MultiMeshes: one for each group of neighbouring blades and each species.

const SHADER := preload("blades.gdshader")
# Numbers of a blade in the buffer, and their bytes on the device.
const STRIDE := 20
const BLADE_BYTES := 4 * STRIDE
# Colliders that the shader knows.
const MAX_SPHERES := 8

var _materials: Array[ShaderMaterial] = []
var _instances: Array[MultiMeshInstance3D] = []
var _breeze := Vector3.ZERO # the field's own wind: direction times speed [m/s]


## Takes the blades of an open SwardFieldReader, at most as many as `budget` [MiB] holds; 0: all.
func fill(reader: Object, budget: int) -> void:
	var origin: PackedFloat64Array = reader.origin()
	position = Vector3(origin[0], origin[1], origin[2])
	var breeze: PackedFloat64Array = reader.breeze()
	# The shader bends in proportion to the speed: a field may have another strength at the same speed.
	_breeze = Vector3(breeze[0], breeze[1], breeze[2]) * (2.6 * breeze[4] / 3.0)
	var share := 1.0
	if budget > 0:
		share = minf(1.0, float(budget << 20) / maxf(BLADE_BYTES * reader.blade_count(), 1.0))
	var meshes: Array[Mesh] = []
	for species: int in reader.species_count():
		meshes.append(_mesh(reader, species))
	for group: int in reader.group_count():
		for species: int in meshes.size():
			var buffer: PackedFloat32Array = reader.blade_buffer(group, species)
			var count := int(share * (buffer.size() / STRIDE))
			if count > 0:
				_add(reader, group, meshes[species], buffer.slice(0, count * STRIDE), 1.0 / sqrt(share))


func _add(reader: Object, group: int, mesh: Mesh, buffer: PackedFloat32Array, widening: float) -> void:
	var multimesh := MultiMesh.new()
	multimesh.transform_format = MultiMesh.TRANSFORM_3D
	# Custom data without colours are garbage in the Compatibility renderer.
	multimesh.use_colors = true
	multimesh.use_custom_data = true
	multimesh.mesh = mesh
	multimesh.instance_count = buffer.size() / STRIDE
	multimesh.buffer = buffer
	var box: PackedFloat64Array = reader.group_bounds(group)
	var low := Vector3(box[0], box[1], box[2])
	multimesh.custom_aabb = AABB(low, Vector3(box[3], box[4], box[5]) - low)
	var place: PackedFloat64Array = reader.group_place(group)
	var instance := MultiMeshInstance3D.new()
	instance.multimesh = multimesh
	instance.position = Vector3(place[0], place[1], place[2])
	instance.set_instance_shader_parameter("widening", widening)
	_instances.append(instance)
	add_child(instance)


## Takes wind and shadows from a SwardGrass3D.
func apply(node: Node3D) -> void:
	var wind := _breeze
	if node.wind_override:
		var angle := deg_to_rad(node.wind_direction)
		wind = Vector3(sin(angle), 0.0, -cos(angle)) * node.wind_speed
	for material in _materials:
		material.set_shader_parameter("wind", wind)
	for instance in _instances:
		instance.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_ON if node.shadows \
				else GeometryInstance3D.SHADOW_CASTING_SETTING_OFF


## Tells the shader of the first MAX_SPHERES colliders; numbers as in colliders.gd. Of a capsule, its middle.
func push(numbers: PackedFloat64Array) -> void:
	var spheres := PackedVector4Array()
	spheres.resize(MAX_SPHERES)
	for i in mini(numbers.size() / 10, MAX_SPHERES):
		var o := 10 * i
		spheres[i] = Vector4(0.5 * (numbers[o] + numbers[o + 3]), 0.5 * (numbers[o + 1] + numbers[o + 4]),
				0.5 * (numbers[o + 2] + numbers[o + 5]), numbers[o + 6])
	for material in _materials:
		material.set_shader_parameter("spheres", spheres)


func _mesh(reader: Object, species: int) -> Mesh:
	var rows: PackedFloat32Array = reader.mesh_vertices(species)
	var count := rows.size() / 12
	var positions := PackedVector3Array()
	var normals := PackedVector3Array()
	var colors := PackedColorArray()
	var uvs := PackedVector2Array()
	for i in count:
		var o := 12 * i
		positions.append(Vector3(rows[o], rows[o + 1], rows[o + 2]))
		normals.append(Vector3(rows[o + 3], rows[o + 4], rows[o + 5]))
		colors.append(Color(rows[o + 6], rows[o + 7], rows[o + 8]))
		uvs.append(Vector2(rows[o + 9], rows[o + 10]))
	var indices: PackedInt32Array = reader.mesh_indices(species)
	# Godot's front faces are clockwise.
	for i in range(0, indices.size(), 3):
		var second := indices[i + 1]
		indices[i + 1] = indices[i + 2]
		indices[i + 2] = second
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = positions
	arrays[Mesh.ARRAY_NORMAL] = normals
	arrays[Mesh.ARRAY_COLOR] = colors
	arrays[Mesh.ARRAY_TEX_UV] = uvs
	arrays[Mesh.ARRAY_INDEX] = indices
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var material := ShaderMaterial.new()
	material.shader = SHADER
	material.set_shader_parameter("roughness", 1.0 - reader.gloss(species))
	mesh.surface_set_material(0, material)
	_materials.append(material)
	return mesh
