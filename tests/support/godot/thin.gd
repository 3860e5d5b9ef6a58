extends SceneTree
## Moves a camera away from a field and writes how many of its instances are drawn: part of scripts/try-godot.
##
## godot --headless --script thin.gd -- OUT.json SCENE DISTANCE …

var _words: PackedStringArray
var _camera := Camera3D.new()
var _grass: Array[Node] = []
var _found := []
var _frames := 0


func _initialize() -> void:
	_words = OS.get_cmdline_user_args()
	var field := (load(_words[1]) as PackedScene).instantiate()
	_grass = field.find_children("*", "MultiMeshInstance3D", true, false)
	# Without a display the picture has few pixels.
	field.set("thin_below", 0.02)
	root.add_child(field)
	_camera.fov = 45.0
	root.add_child(_camera)
	_camera.make_current()
	_place()


func _process(_delta: float) -> bool:
	_frames += 1
	# The node of the field thins in the frame after the camera has moved.
	if _frames % 3 != 0:
		return false
	var drawn := 0
	for grass: MultiMeshInstance3D in _grass:
		drawn += grass.multimesh.visible_instance_count
	_found.append(drawn)
	if _found.size() < _words.size() - 2:
		_place()
		return false
	var file := FileAccess.open(_words[0], FileAccess.WRITE)
	file.store_string(JSON.stringify(_found))
	file.close()
	return true


func _place() -> void:
	_camera.position = Vector3(0.0, 0.0, float(_words[2 + _found.size()]))
