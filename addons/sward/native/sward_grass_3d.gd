@tool
class_name SwardGrass3D
extends Node3D
## Grass of a [code].sward[/code] file, drawn by Sward's own renderer on Godot's Vulkan device where that runs, and as
## MultiMeshes elsewhere.
##
## It says which of them draws, and why, in the properties [member renderer_in_use] and [member renderer_reason], and in
## a line of the output. What is wrong with a file or a property stands in the error panel and beside the node. The
## page docs/godot_native.md of Sward tells what the native renderer needs.

## Which renderer is wanted.
enum Renderer {
	## The native one where it runs, else MultiMeshes.
	AUTO,
	## The same, with a warning where it does not run.
	NATIVE,
	## MultiMeshes.
	MULTIMESH,
}

const NativeViews := preload("native_views.gd")
const MultiMeshGrass := preload("multimesh_grass.gd")
const Colliders := preload("colliders.gd")
const Light := preload("light.gd")

## Emitted when the grass of a field is there, with the renderer that draws it: "native", "multimesh" or, if nothing is
## drawn, "none".
signal renderer_chosen(renderer_name: String, reason: String)

## The field file, of [code]sward bake[/code].
@export_file("*.sward") var field := "":
	set(value):
		field = value
		reload()

## Which renderer draws.
@export var renderer := Renderer.AUTO:
	set(value):
		renderer = value
		reload()

## Device memory for the blades; 0: as much as they need. Of a larger field, the native renderer streams what is seen;
## MultiMeshes have an even sample of its blades.
@export_range(0, 65536, 1, "or_greater", "suffix:MiB") var budget := 0:
	set(value):
		budget = value
		reload()

## Whether blades cast shadows: on one another by the native renderer, on Godot's things too by MultiMeshes.
@export var shadows := true:
	set(value):
		shadows = value
		_settings_changed = true

@export_group("Wind", "wind_")
## Replaces the wind that the field has saved by the two properties below.
@export var wind_override := false:
	set(value):
		wind_override = value
		_settings_changed = true

## Where the wind blows to, in degrees clockwise from -Z, seen from above.
@export_range(0, 360, 0.1, "degrees") var wind_direction := 127.0:
	set(value):
		wind_direction = value
		_settings_changed = true

## How fast gusts travel; blades bend in proportion. 0: calm.
@export_range(0, 40, 0.1, "suffix:m/s") var wind_speed := 2.6:
	set(value):
		wind_speed = value
		_settings_changed = true

@export_group("Surroundings")
## What pushes grass aside, besides this node's own children: spheres and capsules, as shapes or as meshes.
@export var colliders: Array[NodePath] = []:
	set(value):
		colliders = value
		update_configuration_warnings()

## The light of the sun; if empty, the first DirectionalLight3D of the scene.
@export var sun := NodePath():
	set(value):
		sun = value
		_light = Light.new()

## A settings file's text (docs/settings.md of Sward), laid over the field's own for the native renderer.
@export_multiline var settings := "":
	set(value):
		settings = value
		_settings_changed = true

## What draws: "native", "multimesh" or "none". Read-only.
var renderer_in_use: String:
	get:
		return _in_use

## Why that renderer draws, or nothing does. Read-only.
var renderer_reason: String:
	get:
		return _reason

var _in_use := "none"
var _reason := "no field is set"
var _problem := "" # what is wrong with the file or a property, for the warnings of the editor
var _settings_changed := true
var _is_waiting := false # for the reload at the end of the frame
var _time := 0.0
var _reader: Object
var _views: NativeViews
var _blades: MultiMeshGrass
var _colliders := Colliders.new()
var _light := Light.new()


## Opens the field anew at the end of this frame.
func reload() -> void:
	if _is_waiting or not is_inside_tree():
		return
	_is_waiting = true
	_reload.call_deferred()


## Blades of the field, as they are planted; 0 if there is none.
func blade_count() -> int:
	return _reader.blade_count() if _reader else 0


## Blades that the native renderer has drawn in a former frame; -1 by MultiMeshes.
func drawn_blades() -> int:
	return _views.drawn_blades() if _views else -1


func _enter_tree() -> void:
	set_notify_transform(true)
	reload()


func _exit_tree() -> void:
	_clear()


func _notification(what: int) -> void:
	if what == NOTIFICATION_TRANSFORM_CHANGED and _views:
		_views.place()
	elif what == NOTIFICATION_VISIBILITY_CHANGED and _views:
		_views.show_quads(is_visible_in_tree())


func _process(delta: float) -> void:
	_time += delta
	if _in_use == "none":
		return
	if _light.update(self):
		_settings_changed = true
	var spheres := _colliders.update(self, delta)
	if _views:
		if _settings_changed:
			_settings_changed = false
			var wrong := _views.apply(_settings_text())
			if wrong:
				_report("settings: %s" % wrong)
		_views.time = _time
		_views.spheres = spheres
	elif _blades:
		if _settings_changed:
			_settings_changed = false
			_blades.apply(self)
		_blades.push(spheres)


func _reload() -> void:
	_is_waiting = false
	if not is_inside_tree():
		return
	_clear()
	_problem = ""
	if field.is_empty():
		_choose("none", "no field is set")
		return
	if not ClassDB.class_exists("SwardFieldReader"):
		_fall_back_to_glb()
		return
	_reader = ClassDB.instantiate("SwardFieldReader")
	var path := file_path(field)
	var wrong: String = _reader.open(path)
	if wrong:
		_reader = null
		_report(wrong)
		_choose("none", wrong)
		return
	var reason := _start_native(path)
	if reason:
		_start_multimesh(reason)


## The file of the operating system behind a path of Godot. Sward maps files; one inside of a package is copied out.
static func file_path(path: String) -> String:
	if path.begins_with("uid://"):
		path = ResourceUID.get_id_path(ResourceUID.text_to_id(path))
	var global := ProjectSettings.globalize_path(path)
	if not path.begins_with("res://") or OS.has_feature("editor") or not FileAccess.file_exists(path):
		return global
	var copy := "user://sward/%s.sward" % path.md5_text()
	var source := FileAccess.open(path, FileAccess.READ)
	DirAccess.make_dir_recursive_absolute("user://sward")
	var target := FileAccess.open(copy, FileAccess.WRITE)
	if source == null or target == null:
		return global
	while source.get_position() < source.get_length():
		target.store_buffer(source.get_buffer(1 << 20))
	target.close()
	return ProjectSettings.globalize_path(copy)


func _start_native(path: String) -> String:
	if renderer == Renderer.MULTIMESH:
		return "the property renderer says so"
	var reason := NativeViews.why_not()
	if reason.is_empty():
		_views = NativeViews.new()
		reason = _views.start(self, path, budget)
	if reason:
		_views = null
		if renderer == Renderer.NATIVE:
			_report("the native renderer cannot run: %s" % reason)
		return reason
	_views.failed.connect(_native_failed)
	_settings_changed = true
	_choose("native", "Godot draws with Vulkan, and its device has what Sward needs")
	return ""


func _native_failed(reason: String) -> void:
	if _views == null:
		return # it was freed in the same frame
	_views.stop()
	_views = null
	_report("the native renderer has stopped: %s" % reason)
	_start_multimesh(reason)


func _start_multimesh(reason: String) -> void:
	_blades = MultiMeshGrass.new()
	_blades.fill(_reader, budget)
	add_child(_blades, false, Node.INTERNAL_MODE_BACK)
	_settings_changed = true
	_choose("multimesh", reason)


# Without the extension no field can be read. An export of the same field beside it can.
func _fall_back_to_glb() -> void:
	var reason := "the extension of Sward is not loaded (addons/sward/native/libsward_godot_field.so)"
	var glb := field.get_basename() + ".glb"
	var scene: PackedScene = load(glb) if ResourceLoader.exists(glb, "PackedScene") else null
	if scene == null:
		_report("%s: %s, and there is no %s" % [field, reason, glb.get_file()])
		_choose("none", reason)
		return
	add_child(scene.instantiate(), false, Node.INTERNAL_MODE_BACK)
	_report("%s: %s; %s is shown instead" % [field, reason, glb.get_file()])
	_choose("multimesh", "%s; it is %s" % [reason, glb.get_file()])


func _clear() -> void:
	if _views:
		_views.stop()
		_views = null
	_blades = null
	for child in get_children(true):
		if not child in get_children(false):
			remove_child(child)
			child.queue_free()
	_reader = null
	_in_use = "none"


func _choose(renderer_name: String, reason: String) -> void:
	_in_use = renderer_name
	_reason = reason
	notify_property_list_changed()
	update_configuration_warnings()
	if renderer_name != "none":
		var blades := "%d blades, " % blade_count() if _reader else ""
		print("SwardGrass3D %s: %s, %sdrawn by %s: %s" % [name, field.get_file(), blades,
				"the native renderer" if renderer_name == "native" else "MultiMeshes", reason])
	renderer_chosen.emit(renderer_name, reason)


# Into Godot's error panel, and beside the node in the scene tree.
func _report(problem: String) -> void:
	_problem = problem
	push_error("SwardGrass3D %s: %s" % [name, problem])
	update_configuration_warnings()


func _settings_text() -> String:
	var own: Dictionary = {}
	if settings.strip_edges():
		var parsed = JSON.parse_string(settings)
		if not parsed is Dictionary:
			return settings # the renderer says what is wrong
		own = parsed
	if wind_override and not own.has("wind"):
		own["wind"] = wind_sources()
	var look: Dictionary = own.get_or_add("look", {})
	look.merge(_light.look())
	look.merge({"blade_shadows": shadows})
	return JSON.stringify(own)


## The wind of the two properties as sources of a settings file: waves and gusts in the shares of a field's own breeze.
func wind_sources() -> Array:
	var angle := deg_to_rad(wind_direction)
	var direction := [sin(angle), 0.0, -cos(angle)]
	var strength := 3.0 * wind_speed / 2.6 # of Sward's defaults
	if wind_speed <= 0.0:
		return []
	return [
		{"kind": "wave", "direction": direction, "speed": wind_speed, "strength": 0.4 * strength, "size": 7.0},
		{"kind": "noise", "direction": direction, "speed": wind_speed, "strength": 0.6 * strength, "size": 3.5},
	]


func _get_property_list() -> Array[Dictionary]:
	var usage := PROPERTY_USAGE_EDITOR | PROPERTY_USAGE_READ_ONLY
	return [
		{"name": "Renderer in use", "type": TYPE_NIL, "usage": PROPERTY_USAGE_GROUP, "hint_string": "renderer_"},
		{"name": "renderer_in_use", "type": TYPE_STRING, "usage": usage},
		{"name": "renderer_reason", "type": TYPE_STRING, "usage": usage, "hint": PROPERTY_HINT_MULTILINE_TEXT},
	]


func _get_configuration_warnings() -> PackedStringArray:
	var warnings := PackedStringArray()
	if field.is_empty():
		warnings.append("No field is set: choose a .sward file, made by sward bake.")
	if _problem:
		warnings.append(_problem)
	if is_inside_tree():
		warnings.append_array(_colliders.warnings(self))
		var scale := global_basis.get_scale()
		if not is_equal_approx(scale.x, scale.y) or not is_equal_approx(scale.y, scale.z):
			warnings.append("The scale is %s; blades have one scale, and the native renderer takes that of X." % scale)
	return warnings
