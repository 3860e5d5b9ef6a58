@tool
@icon("res://addons/sward/icon.svg")
class_name SwardField
extends Node3D
## A field of grass, imported from a .glb of [code]sward export --for-engines[/code].
##
## The blades stand in the MultiMeshInstance3D nodes below. This node gives their shader the wind and the camera, and
## draws fewer, wider blades with distance: far groups of blades are shortened to those of the lowest ranks, which are
## spread evenly, and single blades fade in and out. It follows the camera of its viewport, and in the editor that of the
## first 3D view.

@export_group("Wind")
## Strength of the wind relative to the field's own; 0: calm.
@export_range(0.0, 4.0, 0.01, "or_greater") var wind_strength := 1.0:
	set(value):
		wind_strength = value
		_tell("wind_strength", value * _own_strength)
## Direction towards which the wind blows, in the world.
@export var wind_direction := Vector3(0.8, 0.0, 0.6):
	set(value):
		wind_direction = value if value.length_squared() > 1e-12 else Vector3(1.0, 0.0, 0.0)
		_tell("wind_direction", wind_direction.normalized())
## Speed at which waves and gusts travel.
@export_range(0.0, 30.0, 0.01, "or_greater", "suffix:m/s") var wind_speed := 2.6:
	set(value):
		wind_speed = value
		_tell("wind_speed", value)
## Length of the waves from crest to crest.
@export_range(0.1, 100.0, 0.01, "or_greater", "suffix:m") var wave_length := 7.0:
	set(value):
		wave_length = maxf(value, 0.001)
		_tell("wave_length", wave_length)
## Size of gusts along the wind; across it they are twice as large.
@export_range(0.1, 100.0, 0.01, "or_greater", "suffix:m") var gust_size := 3.5:
	set(value):
		gust_size = maxf(value, 0.001)
		_tell("gust_size", gust_size)
## Share of the wind's strength that comes in gusts; the rest comes in waves.
@export_range(0.0, 1.0, 0.01) var gustiness := 0.6:
	set(value):
		gustiness = value
		_tell("gustiness", value)

@export_group("Level of detail")
## Width of a typical blade on the screen below which blades are left out, and the others widened. 0: all blades are
## drawn. Smaller values show more blades far away and cost more.
@export_range(0.0, 4.0, 0.01, "suffix:px") var thin_below := 1.0:
	set(value):
		thin_below = value
		_tell("thin_below", value)
## Distance beyond which no blade is drawn. 0: unlimited.
@export_range(0.0, 2000.0, 0.1, "or_greater", "suffix:m") var draw_distance := 0.0:
	set(value):
		draw_distance = value
		_tell("draw_distance", value if value > 0.0 else 1e9)

@export_group("Shadows")
## Whether blades cast shadows. They always darken one another by a formula, which costs nothing; shadows of their own
## shape cost a second pass over all blades.
@export var cast_shadows := false:
	set(value):
		cast_shadows = value
		for grass in _grass:
			grass.cast_shadow = _casting()

@export_storage var _own_strength := 3.0
@export_storage var _blade_width := 0.01
@export_storage var _gravity_direction := Vector3(0.0, -1.0, 0.0)
@export_storage var _attractor := Vector3.ZERO

# Instances that more than one field of a scene shares are drawn as far as the field that needs most.
static var _shared := {}

var _grass: Array[MultiMeshInstance3D] = []
var _materials: Array[ShaderMaterial] = []
var _last_eye := Vector3.INF
var _last_pixels := 0.0


## Takes wind and sizes from the `extras.sward` of a file.
func describe(extras: Dictionary) -> void:
	var wind: Dictionary = extras.get("wind", {})
	_own_strength = float(wind.get("strength", 3.0))
	wind_direction = _vector(wind.get("direction"), wind_direction)
	wind_speed = float(wind.get("speed_m_per_s", wind_speed))
	wave_length = float(wind.get("wave_length_m", wave_length))
	gust_size = float(wind.get("gust_size_m", gust_size))
	gustiness = float(wind.get("gustiness", gustiness))
	var gravity: Dictionary = extras.get("gravity", {})
	_gravity_direction = _vector(gravity.get("direction"), _gravity_direction)
	_attractor = _vector(gravity.get("attractor_m"), _attractor)
	_blade_width = mean_width(extras)


## Mean width of the blades of all species [m].
static func mean_width(extras: Dictionary) -> float:
	var sum := 0.0
	var blades := 0.0
	for species: Dictionary in extras.get("species", []):
		sum += float(species.get("mean_width_m", 0.0)) * float(species.get("blades", 0))
		blades += float(species.get("blades", 0))
	return sum / blades if blades > 0.0 else 0.01


## Gives a material all that `extras.sward` says of the whole field.
static func describe_material(material: ShaderMaterial, extras: Dictionary) -> void:
	var wind: Dictionary = extras.get("wind", {})
	var gravity: Dictionary = extras.get("gravity", {})
	var leaves: Dictionary = extras.get("leaves", {})
	var values := {
		"wind_direction": _vector(wind.get("direction"), Vector3(0.8, 0.0, 0.6)),
		"wind_strength": float(wind.get("strength", 3.0)),
		"wind_speed": float(wind.get("speed_m_per_s", 2.6)),
		"wave_length": float(wind.get("wave_length_m", 7.0)),
		"gust_size": float(wind.get("gust_size_m", 3.5)),
		"gustiness": float(wind.get("gustiness", 0.6)),
		"gravity_direction": _vector(gravity.get("direction"), Vector3(0.0, -1.0, 0.0)),
		"gravity_strength": float(gravity.get("strength", 6.5)),
		"gravity_forward": float(gravity.get("forward", 0.25)),
		"attractor": _vector(gravity.get("attractor_m"), Vector3.ZERO),
		"attractor_blend": float(gravity.get("blend", 0.0)),
		"recovery": float(extras.get("recovery", 6.0)),
		"leaf_top": float(leaves.get("top_m", 0.5)),
		"leaf_projection": float(leaves.get("projection", 0.3)),
		"blade_width": mean_width(extras),
	}
	for name: String in values:
		material.set_shader_parameter(name, values[name])
	var roots := PackedFloat32Array()
	for share: float in leaves.get("share_above", []):
		roots.append(sqrt(maxf(share, 0.0)))
	if roots.size() == 16:
		material.set_shader_parameter("leaf_roots", roots)


func _ready() -> void:
	_grass.clear()
	_materials.clear()
	# Each field has materials of its own, so that two of one file may differ.
	var own := {}
	for node: MultiMeshInstance3D in find_children("*", "MultiMeshInstance3D", true, false):
		if not node.has_meta("sward"):
			continue
		_grass.append(node)
		var from := node.multimesh.mesh.surface_get_material(0) as ShaderMaterial
		if from == null:
			continue
		if not own.has(from):
			own[from] = from.duplicate()
			_materials.append(own[from])
		node.material_override = own[from]
		node.cast_shadow = _casting()
	set_notify_transform(true)
	_tell_all()


func _notification(what: int) -> void:
	if what == NOTIFICATION_TRANSFORM_CHANGED:
		_tell_place()


func _process(_delta: float) -> void:
	var camera := _camera()
	if camera == null or _grass.is_empty():
		return
	var eye := camera.global_position
	var pixels := _pixels_per_metre(camera)
	if eye != _last_eye or pixels != _last_pixels:
		_last_eye = eye
		_last_pixels = pixels
		_tell("eye", eye)
		_tell("pixels_per_metre", pixels)
		_tell("is_parallel", camera.projection == Camera3D.PROJECTION_ORTHOGONAL)
	_thin(camera, eye, pixels)


# Sets how many instances of each group are drawn: those that its nearest place needs.
func _thin(camera: Camera3D, eye: Vector3, pixels: float) -> void:
	var frame := Engine.get_process_frames()
	var is_parallel := camera.projection == Camera3D.PROJECTION_ORTHOGONAL
	for grass in _grass:
		var counts: PackedInt32Array = grass.get_meta("sward").counts
		if counts.is_empty():
			continue
		var box := grass.global_transform * grass.get_aabb()
		var away := 1.0 if is_parallel else eye.distance_to(eye.clamp(box.position, box.end))
		var share := share_of(_blade_width * pixels / maxf(away, 1e-6), thin_below)
		var wanted := 0
		if draw_distance <= 0.0 or is_parallel or away <= draw_distance:
			wanted = visible_of(counts, share)
		var multimesh := grass.multimesh
		var other: Array = _shared.get(multimesh, [-1, 0])
		if other[0] == frame:
			wanted = maxi(wanted, other[1])
		_shared[multimesh] = [frame, wanted]
		if multimesh.visible_instance_count != wanted:
			multimesh.visible_instance_count = wanted


## Share of the blades that is drawn where a typical one is `pixels` wide; the shader has the same rule.
static func share_of(pixels: float, below: float) -> float:
	return 1.0 / 0.9 if below <= 0.0 else clampf(pixels / below, 1.0 / 256.0, 1.0 / 0.9)


## Instances of a group among which are all with a rank below `share`. `counts`: see blade_instances.gd.
static func visible_of(counts: PackedInt32Array, share: float) -> int:
	if share >= 1.0:
		return counts[0]
	var step := floori(-log(maxf(share, 1.0 / 256.0)) / log(2.0) * 4.0 + 1e-4)
	return counts[clampi(step, 0, counts.size() - 1)]


func _exit_tree() -> void:
	for grass in _grass:
		_shared.erase(grass.multimesh)


func _camera() -> Camera3D:
	if Engine.is_editor_hint() and is_inside_tree() and get_viewport() != null:
		# The class is unknown outside of the editor.
		var editor := Engine.get_singleton("EditorInterface") if Engine.has_singleton("EditorInterface") else null
		if editor != null:
			return editor.get_editor_viewport_3d(0).get_camera_3d()
	return get_viewport().get_camera_3d()


# Pixels that a metre has at a distance of one metre; of a parallel projection, everywhere.
func _pixels_per_metre(camera: Camera3D) -> float:
	var size := camera.get_viewport().get_visible_rect().size
	var across := size.y if camera.keep_aspect == Camera3D.KEEP_HEIGHT else size.x
	if camera.projection == Camera3D.PROJECTION_ORTHOGONAL:
		return across / camera.size
	if camera.projection == Camera3D.PROJECTION_FRUSTUM:
		return across * camera.near / camera.size
	return 0.5 * across / tan(0.5 * deg_to_rad(camera.fov))


func _casting() -> GeometryInstance3D.ShadowCastingSetting:
	return GeometryInstance3D.SHADOW_CASTING_SETTING_DOUBLE_SIDED if cast_shadows else GeometryInstance3D.SHADOW_CASTING_SETTING_OFF


func _tell(parameter: StringName, value: Variant) -> void:
	for material in _materials:
		material.set_shader_parameter(parameter, value)


func _tell_all() -> void:
	_tell("wind_strength", wind_strength * _own_strength)
	_tell("wind_direction", wind_direction.normalized())
	_tell("wind_speed", wind_speed)
	_tell("wave_length", wave_length)
	_tell("gust_size", gust_size)
	_tell("gustiness", gustiness)
	_tell("thin_below", thin_below)
	_tell("draw_distance", draw_distance if draw_distance > 0.0 else 1e9)
	_tell_place()


func _tell_place() -> void:
	if not is_inside_tree():
		return
	_tell("gravity_direction", (global_basis * _gravity_direction).normalized())
	# The file has it relative to the node of the field, which has the origin as its place.
	var field := get_node_or_null("field") as Node3D
	_tell("attractor", (field if field != null else self).global_transform * _attractor)


static func _vector(list: Variant, otherwise := Vector3.ZERO) -> Vector3:
	return Vector3(list[0], list[1], list[2]) if list is Array and list.size() == 3 else otherwise
