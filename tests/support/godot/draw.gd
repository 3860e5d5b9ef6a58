extends SceneTree
## Draws a scene with a given camera and saves the picture: part of scripts/try-godot.
##
## godot --script draw.gd -- SCENE CAMERA.json OUT.png [wind=X] [thin=X] [shadows=1] [frames=N] [environment=SCENE]
##     [sun_shadow=0]: lights of the environment cast no shadows
##     [bare=OUT.png]: first a picture without blades

var _frames := 0
var _last := 8
var _out := ""
var _bare := ""
var _grass: Array[Node] = []
var _times: PackedFloat64Array = []
var _then := 0


func _initialize() -> void:
	var words := OS.get_cmdline_user_args()
	var options := {}
	for word in words.slice(3):
		options[word.get_slice("=", 0)] = word.get_slice("=", 1)
	_out = words[2]
	_last = int(options.get("frames", "8"))
	var began := Time.get_ticks_msec()
	var field := (load(words[0]) as PackedScene).instantiate() as Node3D
	print("opened: %.3f s" % ((Time.get_ticks_msec() - began) / 1000.0))
	if options.has("wind"):
		field.set("wind_strength", float(options.wind))
	if options.has("thin"):
		field.set("thin_below", float(options.thin))
	if options.has("shadows"):
		field.set("cast_shadows", options.shadows == "1")
	root.add_child(field)
	_bare = options.get("bare", "")
	_grass = field.find_children("*", "MultiMeshInstance3D", true, false)
	_show_grass(_bare.is_empty())
	if options.has("environment"):
		var light := (load(options.environment) as PackedScene).instantiate()
		for sun: Light3D in light.find_children("*", "Light3D", true, false):
			sun.shadow_enabled = options.get("sun_shadow", "1") == "1"
		root.add_child(light)
	var view: Dictionary = JSON.parse_string(FileAccess.get_file_as_string(words[1]))
	var camera := Camera3D.new()
	camera.fov = view.fov_y_deg
	camera.near = 0.05
	camera.far = 4000.0
	root.add_child(camera)
	camera.look_at_from_position(_vector(view.eye), _vector(view.target), _vector(view.get("up", [0, 1, 0])))
	camera.make_current()


func _process(_delta: float) -> bool:
	var now := Time.get_ticks_usec()
	if _then > 0:
		_times.append((now - _then) / 1e6)
	_then = now
	_frames += 1
	if _frames < _last:
		return false
	if not _bare.is_empty():
		_save(_bare)
		_bare = ""
		_frames = 0
		_show_grass(true)
		return false
	_save(_out)
	_times.sort()
	print("frame: %.3f s" % _times[_times.size() / 2])
	return true


func _show_grass(is_shown: bool) -> void:
	for node: Node3D in _grass:
		node.visible = is_shown


func _save(path: String) -> void:
	var image := root.get_texture().get_image()
	# One renderer has an alpha channel, too.
	image.convert(Image.FORMAT_RGB8)
	var error := image.save_png(path)
	if error != OK:
		push_error("%s cannot be written: %s" % [path, error_string(error)])


static func _vector(list: Array) -> Vector3:
	return Vector3(list[0], list[1], list[2])
