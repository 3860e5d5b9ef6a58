@tool
extends RefCounted
## Grass by Sward's renderer on Godot's Vulkan device: one picture of colour and depth for each viewport that shows the
## node's world, shown by a quad over that viewport.

## The renderer cannot go on.
signal failed(reason: String)

## Views at the same time.
const MAX_VIEWS := 4
const SHADER := preload("screen_grass.gdshader")
# Frames after which Godot has no more use for what was given to it.
const FRAMES_UNTIL_FREE := 6

## Of the next frame: time [s], and the numbers of colliders.gd.
var time := 0.0
var spheres := PackedFloat64Array()


class View:
	var viewport: Viewport
	var index: int
	var size := Vector2i.ZERO
	var textures: Array[Texture2DRD] = []
	var rids: Array[RID] = []
	var quad := MeshInstance3D.new()
	var material := ShaderMaterial.new()


var _node: Node3D
var _native: Object
var _views: Array[View] = []
var _viewports: Array[Viewport] = []
var _warned := false

static var _leaving := [] # renderers that are to be freed, with the frame


## Why the renderer cannot run here; empty if it may.
static func why_not() -> String:
	if DisplayServer.get_name() == "headless":
		return "Godot runs headless"
	if RenderingServer.get_rendering_device() == null:
		return "Godot's Compatibility renderer does not use Vulkan"
	var driver := RenderingServer.get_current_rendering_driver_name()
	if driver != "vulkan":
		return "Godot draws with %s, and Vulkan is needed" % driver
	if not ClassDB.class_exists("SwardNative"):
		return "the extension libsward_godot_native.so is not loaded; it needs Vulkan's loader libvulkan.so.1"
	if ProjectSettings.get_setting("rendering/driver/threads/thread_model", 1) == 2:
		return "Godot draws in a thread of its own (rendering/driver/threads/thread_model)"
	return ""


## Opens the field for a node. Returns why it cannot, or nothing.
func start(node: Node3D, path: String, budget: int) -> String:
	var device := RenderingServer.get_rendering_device()
	_node = node
	_native = ClassDB.instantiate("SwardNative")
	var wrong: String = _native.start(
			device.get_driver_resource(RenderingDevice.DRIVER_RESOURCE_TOPMOST_OBJECT, RID(), 0),
			device.get_driver_resource(RenderingDevice.DRIVER_RESOURCE_PHYSICAL_DEVICE, RID(), 0),
			device.get_driver_resource(RenderingDevice.DRIVER_RESOURCE_LOGICAL_DEVICE, RID(), 0),
			device.get_driver_resource(RenderingDevice.DRIVER_RESOURCE_COMMAND_QUEUE, RID(), 0),
			device.get_driver_resource(RenderingDevice.DRIVER_RESOURCE_QUEUE_FAMILY, RID(), 0))
	if wrong.is_empty():
		wrong = _native.load(path, budget)
	if wrong:
		_native.stop()
		_native = null
		return wrong
	place()
	_find_viewports()
	node.get_tree().node_added.connect(_node_added)
	RenderingServer.frame_pre_draw.connect(_draw)
	return ""


## Frees the renderer, when Godot's frames in flight are done with its pictures.
func stop() -> void:
	if _native == null:
		return
	RenderingServer.frame_pre_draw.disconnect(_draw)
	_node.get_tree().node_added.disconnect(_node_added)
	for view in _views:
		_free_view(view)
	_views.clear()
	if _leaving.is_empty():
		RenderingServer.frame_post_draw.connect(_free_leaving)
	_leaving.append([_native, Engine.get_frames_drawn() + FRAMES_UNTIL_FREE])
	_native = null


static func _free_leaving() -> void:
	_leaving = _leaving.filter(func(entry: Array) -> bool: return entry[1] > Engine.get_frames_drawn())
	if _leaving.is_empty():
		RenderingServer.frame_post_draw.disconnect(_free_leaving)


## Lays the text of a settings file over the field's own. Returns what is wrong with it.
func apply(settings: String) -> String:
	return _native.apply(settings)


## Takes the node's place.
func place() -> void:
	var at := _node.global_transform
	var turn := at.basis.get_rotation_quaternion()
	var wrong: String = _native.place(PackedFloat64Array([at.origin.x, at.origin.y, at.origin.z, turn.x, turn.y, turn.z,
			turn.w, at.basis.get_scale().x]))
	if wrong:
		push_error("SwardGrass3D %s: %s" % [_node.name, wrong])


func show_quads(are_shown: bool) -> void:
	for view in _views:
		view.quad.visible = are_shown


func drawn_blades() -> int:
	return _native.drawn_blades() if _native else 0


func _find_viewports() -> void:
	_viewports = [_node.get_tree().root]
	for viewport in _node.get_tree().root.find_children("*", "Viewport", true, false):
		_viewports.append(viewport)


func _node_added(node: Node) -> void:
	if node is Viewport:
		_viewports.append(node)


# Whether Godot draws the node's world in a viewport in this frame.
func _is_shown(viewport: Viewport) -> bool:
	if viewport.disable_3d or viewport.get_camera_3d() == null or viewport.find_world_3d() != _node.get_world_3d():
		return false
	var sub := viewport as SubViewport
	if sub == null:
		return true
	match sub.render_target_update_mode:
		SubViewport.UPDATE_DISABLED:
			return false
		SubViewport.UPDATE_ALWAYS, SubViewport.UPDATE_ONCE:
			return true
	var parent := sub.get_parent() as CanvasItem
	return parent == null or parent.is_visible_in_tree()


func _draw() -> void:
	var numbers := PackedFloat64Array()
	if not _node.is_visible_in_tree():
		return
	_viewports = _viewports.filter(func(viewport) -> bool: return is_instance_valid(viewport) and viewport.is_inside_tree())
	var shown := _viewports.filter(_is_shown)
	if shown.size() > MAX_VIEWS:
		_warn("%d viewports show the grass, and it is drawn in %d of them" % [shown.size(), MAX_VIEWS])
		shown.resize(MAX_VIEWS)
	for view in _views.duplicate():
		if not view.viewport in shown:
			_free_view(view)
			_views.erase(view)
	for viewport: Viewport in shown:
		var camera := viewport.get_camera_3d()
		if camera.projection == Camera3D.PROJECTION_ORTHOGONAL:
			failed.emit.call_deferred("camera %s is orthogonal, and it draws in perspective alone" % camera.name)
			return
		var view := _view_of(viewport)
		if view == null:
			return
		numbers.append(view.index)
		numbers.append_array(_matrix(camera))
		_tell_shader(view, camera, shown.size())
	var wrong: String = _native.draw(time, numbers, spheres)
	if wrong:
		failed.emit.call_deferred(wrong)


# From the world to Vulkan's clip space: y downwards, depth 1 near and 0 far; Godot's has y upwards and -1 to 1.
func _matrix(camera: Camera3D) -> PackedFloat64Array:
	var clip := camera.get_camera_projection() * Projection(camera.get_camera_transform().affine_inverse())
	var numbers := PackedFloat64Array()
	for column in 4:
		var c: Vector4 = clip[column]
		numbers.append_array([c.x, -c.y, 0.5 * (c.w - c.z), c.w])
	return numbers


func _view_of(viewport: Viewport) -> View:
	var view: View = null
	var used := []
	for known in _views:
		used.append(known.index)
		if known.viewport == viewport:
			view = known
	if view == null:
		view = View.new()
		view.viewport = viewport
		while view.index in used:
			view.index += 1
		_make_quad(view)
		_views.append(view)
	# Of the 3D picture, which scaling makes smaller or larger than the viewport.
	var size := Vector2i((viewport.get_texture().get_size() * viewport.scaling_3d_scale).max(Vector2.ONE))
	if size != view.size:
		var wrong := _resize(view, size)
		if wrong:
			failed.emit.call_deferred(wrong)
			return null
	return view


func _make_quad(view: View) -> void:
	view.material.shader = SHADER
	var quad := view.quad
	quad.mesh = QuadMesh.new()
	quad.material_override = view.material
	quad.custom_aabb = AABB(Vector3.ONE * -1e7, Vector3.ONE * 2e7)
	quad.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
	quad.gi_mode = GeometryInstance3D.GI_MODE_DISABLED
	quad.ignore_occlusion_culling = true
	quad.top_level = true
	_node.add_child(quad, false, Node.INTERNAL_MODE_BACK)


func _resize(view: View, size: Vector2i) -> String:
	_free_textures(view)
	var wrong: String = _native.resize(view.index, size.x, size.y)
	if wrong:
		return wrong
	view.size = size
	var device := RenderingServer.get_rendering_device()
	var images := [_native.color_image(view.index), _native.depth_image(view.index)]
	var formats := [RenderingDevice.DATA_FORMAT_R16G16B16A16_SFLOAT, RenderingDevice.DATA_FORMAT_R32_SFLOAT]
	for i in 2:
		view.rids.append(device.texture_create_from_extension(RenderingDevice.TEXTURE_TYPE_2D, formats[i],
				RenderingDevice.TEXTURE_SAMPLES_1, RenderingDevice.TEXTURE_USAGE_SAMPLING_BIT, images[i], size.x, size.y, 1, 1))
		# A texture that has lost its image is another one for Godot: the material is told anew.
		view.textures.append(Texture2DRD.new())
		view.textures[i].texture_rd_rid = view.rids[i]
		view.material.set_shader_parameter(["grass_color", "grass_depth"][i], view.textures[i])
	return ""


# A quad shows a view's picture where that view's camera looks, and nowhere else.
func _tell_shader(view: View, camera: Camera3D, views: int) -> void:
	var at := camera.get_camera_transform()
	view.material.set_shader_parameter("eye", at.origin)
	view.material.set_shader_parameter("backwards", at.basis.z.normalized())
	view.material.set_shader_parameter("focal", camera.get_camera_projection()[1][1])
	# One view alone may lag behind a camera that Godot interpolates.
	view.material.set_shader_parameter("slack", 1.0 if views == 1 else 1e-3)


func _free_view(view: View) -> void:
	_free_textures(view)
	if is_instance_valid(view.quad):
		view.quad.queue_free()


func _free_textures(view: View) -> void:
	for i in view.rids.size():
		view.textures[i].texture_rd_rid = RID()
		RenderingServer.get_rendering_device().free_rid(view.rids[i])
	view.rids.clear()
	view.textures.clear()
	view.size = Vector2i.ZERO


func _warn(text: String) -> void:
	if not _warned:
		_warned = true
		push_warning("SwardGrass3D %s: %s" % [_node.name, text])
