@tool
extends GLTFDocumentExtension
## Imports EXT_mesh_gpu_instancing: a MultiMeshInstance3D of each node.
##
## Of a file of Sward each gets the grass shader, and the scene's root the script `sward_field.gd`. Other files get their
## own meshes and materials. What cannot be read is refused with an error that names file, node and value.

const Accessors := preload("res://addons/sward/gltf_accessors.gd")
const BladeInstances := preload("res://addons/sward/blade_instances.gd")
const BladeMesh := preload("res://addons/sward/blade_mesh.gd")
const SwardField := preload("res://addons/sward/sward_field.gd")
const GROUND_SHADER := preload("res://addons/sward/ground.gdshader")
const BLADE_SHADER := preload("res://addons/sward/blade.gdshader")

const NAME := "EXT_mesh_gpu_instancing"
## Newest version of the data under `extras.sward` that this importer knows.
const VERSION := 1
## Extensions of other nodes and buffers that would have to be decoded.
const NOT_READ := ["EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_mesh_quantization", "KHR_draco_mesh_compression"]
## Key of whether a file is refused before it is parsed.
const REFUSED := "sward_refused"
## Beyond this distance of the origin [m] single precision shows steps of 1 mm.
const FARTHEST := 8192.0


func _get_supported_extensions() -> PackedStringArray:
	return PackedStringArray([NAME])


func _import_preflight(state: GLTFState, extensions: PackedStringArray) -> Error:
	if not extensions.has(NAME):
		return ERR_SKIP
	# A key that is missing would be an error of its own.
	state.set_additional_data(REFUSED, false)
	for name: String in NOT_READ:
		if extensions.has(name):
			_refuse(state, "uses %s, which is not read together with %s; write the file without it" % [name, NAME])
	var extras := _extras(state)
	if extras.is_empty() and str(state.json.get("asset", {}).get("generator", "")).begins_with("sward"):
		push_warning("Sward: %s: was exported without --for-engines: it has no wind and no level of detail" % _name(state))
	var version: Variant = extras.get("version", VERSION)
	if not (version is float or version is int) or int(version) > VERSION:
		_refuse(state, "extras.sward has version %s, this add-on reads up to %d; take the add-on of that Sward" % [str(version).trim_suffix(".0"), VERSION])
	return OK


func _import_post_parse(state: GLTFState) -> Error:
	# Make all instances here: only now an error ends the import.
	if state.get_additional_data(REFUSED):
		return ERR_UNAVAILABLE
	var accessors := Accessors.new(state.json, state.buffers)
	var kinds := _kinds(state)
	var made := {}
	var nodes: Array = state.json.get("nodes", [])
	for i in nodes.size():
		var extension: Variant = nodes[i].get("extensions", {}).get(NAME)
		if extension == null:
			continue
		var fault := _make(state, accessors, kinds, nodes[i], extension, i, made)
		if not fault.is_empty():
			_fail(state, "node %d (%s): %s" % [i, nodes[i].get("name", "no name"), fault])
			return ERR_PARSE_ERROR
	state.set_additional_data(NAME, made)
	if not _extras(state).is_empty():
		_shade_ground(state)
	return OK


func _generate_scene_node(state: GLTFState, node: GLTFNode, _parent: Node) -> Node3D:
	var made: Variant = state.get_additional_data(NAME)
	var index := state.nodes.find(node)
	if made == null or not made.has(index):
		return null
	# Otherwise Godot adds the mesh again.
	node.mesh = -1
	return made[index]


func _import_post(state: GLTFState, root: Node) -> Error:
	var extras := _extras(state)
	if root is Node3D and not extras.is_empty():
		_move_near(state, root)
		root.set_script(SwardField)
		root.describe(extras)
	return OK


# The part of the file that Sward writes for engines.
static func _extras(state: GLTFState) -> Dictionary:
	for node: Dictionary in state.json.get("nodes", []):
		var extras: Variant = node.get("extras", {})
		if extras is Dictionary and extras.get("sward") is Dictionary:
			return extras.sward
	return {}


# Mesh and material by the number of a mesh, made when they are first used.
func _kinds(state: GLTFState) -> Dictionary:
	return {"extras": _extras(state), "meshes": {}, "file": state}


# Adds the node of instances to `made`; returns what is wrong.
func _make(state: GLTFState, accessors: Accessors, kinds: Dictionary, node: Dictionary, extension: Variant, index: int,
		made: Dictionary) -> String:
	if not extension is Dictionary or not extension.get("attributes") is Dictionary:
		return "%s has no attributes" % NAME
	var number := int(node.get("mesh", -1))
	if number < 0 or number >= state.meshes.size():
		return "mesh %d is missing; the file has %d" % [number, state.meshes.size()]
	var species := _species(kinds, number)
	var root_color := _color(species.get("root_color", []), Color.BLACK)
	var tip_color := _color(species.get("tip_color", []), Color.WHITE)
	var instances := BladeInstances.new()
	instances.make(accessors, extension.attributes, root_color, tip_color)
	if not instances.fault.is_empty():
		return instances.fault
	var multimesh := MultiMesh.new()
	multimesh.transform_format = MultiMesh.TRANSFORM_3D
	# The Compatibility renderer needs both or none.
	multimesh.use_colors = true
	multimesh.use_custom_data = true
	if species.is_empty():
		multimesh.mesh = state.meshes[number].mesh.get_mesh()
		instances.buffer = _whitened(instances.buffer)
	else:
		var mesh := _mesh(kinds, species, number)
		if mesh.mesh == null:
			return mesh.fault
		multimesh.mesh = mesh.mesh
	multimesh.instance_count = instances.count
	multimesh.buffer = instances.buffer
	var result := MultiMeshInstance3D.new()
	result.multimesh = multimesh
	if not species.is_empty():
		# A blade that bends leaves its box by its height.
		result.extra_cull_margin = float(species.get("mean_height_m", 0.5))
		result.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
		var has_ranks: bool = extension.attributes.has("_RANK")
		result.set_meta("sward", {"species": number, "counts": instances.counts if has_ranks else PackedInt32Array()})
	made[index] = result
	return ""


# What `extras.sward` says of a mesh; empty for files of others.
static func _species(kinds: Dictionary, number: int) -> Dictionary:
	var list: Variant = kinds.extras.get("species", [])
	return list[number] if list is Array and number < list.size() and list[number] is Dictionary else {}


func _mesh(kinds: Dictionary, species: Dictionary, number: int) -> BladeMesh:
	if not kinds.meshes.has(number):
		var state: GLTFState = kinds.file
		var base := Color.WHITE
		var primitive: Dictionary = state.json.meshes[number].primitives[0]
		if primitive.has("material"):
			var factor: Array = state.json.materials[int(primitive.material)].get("pbrMetallicRoughness", {}).get("baseColorFactor", [1, 1, 1, 1])
			base = Color(factor[0], factor[1], factor[2])
		var made := BladeMesh.new(state.meshes[number].mesh, base, float(species.get("fold", 0.0)))
		if made.mesh != null:
			made.mesh.surface_set_material(0, _material(kinds.extras, species, made))
		kinds.meshes[number] = made
	return kinds.meshes[number]


static func _material(extras: Dictionary, species: Dictionary, mesh: BladeMesh) -> ShaderMaterial:
	var material := ShaderMaterial.new()
	material.shader = BLADE_SHADER
	material.resource_name = species.get("name", "")
	var is_plant: bool = species.get("plant", false)
	material.set_shader_parameter("is_plant", is_plant)
	material.set_shader_parameter("rest_v1", mesh.v1)
	material.set_shader_parameter("rest_v2", mesh.v2)
	material.set_shader_parameter("fold", float(species.get("fold", 0.0)))
	material.set_shader_parameter("translucency", float(species.get("translucency", 0.5)))
	material.set_shader_parameter("gloss", float(species.get("gloss", 0.2)))
	material.set_shader_parameter("tip_color", _vector(species.get("tip_color", []), Vector3.ONE))
	SwardField.describe_material(material, extras)
	return material


# Gives the mesh of the drawn ground its own shader.
static func _shade_ground(state: GLTFState) -> void:
	var meshes: Array = state.json.get("meshes", [])
	for i in meshes.size():
		if meshes[i].get("name", "") != "ground":
			continue
		var mesh := state.meshes[i].mesh as ImporterMesh
		for surface in mesh.get_surface_count():
			var from := mesh.get_surface_material(surface) as BaseMaterial3D
			if from == null:
				continue
			var base := from.albedo_color.srgb_to_linear()
			var material := ShaderMaterial.new()
			material.shader = GROUND_SHADER
			material.resource_name = "ground"
			material.set_shader_parameter("base", Vector3(base.r, base.g, base.b))
			material.set_shader_parameter("roughness", from.roughness)
			if from.albedo_texture != null:
				material.set_shader_parameter("has_image", true)
				material.set_shader_parameter("image", from.albedo_texture)
			mesh.set_surface_material(surface, material)


# A field far from the origin is moved there; extras.origin_m keeps its place.
func _move_near(state: GLTFState, root: Node3D) -> void:
	for child in root.get_children() + [root]:
		if child is Node3D and child.position.length() > FARTHEST:
			push_warning("Sward: %s: the field lies %.0f m from the origin, where single precision shows steps; it is placed at the origin" % [_name(state), child.position.length()])
			child.position = Vector3.ZERO


# Instances of other files keep the colours of their meshes.
static func _whitened(buffer: PackedFloat32Array) -> PackedFloat32Array:
	for o in range(0, buffer.size(), BladeInstances.NUMBERS):
		for k in range(12, 16):
			buffer[o + k] = 1.0
	return buffer


static func _vector(list: Variant, otherwise: Vector3) -> Vector3:
	return Vector3(list[0], list[1], list[2]) if list is Array and list.size() == 3 else otherwise


static func _color(list: Variant, otherwise: Color) -> Color:
	var v := _vector(list, Vector3(otherwise.r, otherwise.g, otherwise.b))
	return Color(v.x, v.y, v.z)


# The file's path; Godot tells it without its ending.
static func _name(state: GLTFState) -> String:
	var path := state.base_path.path_join(state.filename)
	for ending: String in [".glb", ".gltf"]:
		if FileAccess.file_exists(path + ending):
			return path + ending
	return path


static func _refuse(state: GLTFState, text: String) -> void:
	_fail(state, text)
	state.set_additional_data(REFUSED, true)


static func _fail(state: GLTFState, text: String) -> void:
	push_error("Sward: %s: %s" % [_name(state), text])
