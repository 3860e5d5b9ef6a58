extends SceneTree
## Opens imported scenes and writes what is in them as JSON: part of scripts/try-godot.
##
## godot --headless --script check.gd -- OUT.json SAMPLES SCENE …

func _initialize() -> void:
	var words := OS.get_cmdline_user_args()
	var found := {}
	for scene: String in words.slice(2):
		found[scene] = _describe(scene, int(words[1]))
	var file := FileAccess.open(words[0], FileAccess.WRITE)
	file.store_string(JSON.stringify(found, "", false, true))
	file.close()
	quit()


# Seconds to open the scene, its groups, and some instances of each in the world.
static func _describe(path: String, samples: int) -> Dictionary:
	var began := Time.get_ticks_usec()
	var packed := load(path) as PackedScene
	if packed == null:
		return {"error": "cannot be loaded"}
	var root := packed.instantiate() as Node3D
	var result := {"seconds": (Time.get_ticks_usec() - began) / 1e6, "script": root.get_script() != null, "groups": [], "instances": []}
	var grass := root.find_children("*", "MultiMeshInstance3D", true, false)
	var blades := 0
	for node: MultiMeshInstance3D in grass:
		blades += node.multimesh.instance_count
	result.blades = blades
	var number := 0
	for node: MultiMeshInstance3D in grass:
		var count := node.multimesh.instance_count
		result.groups.append({"name": node.name, "count": count})
		var place := Transform3D.IDENTITY
		var above: Node = node
		while above is Node3D:
			place = above.transform * place
			above = above.get_parent()
		# Every k-th of all blades, so that the samples are spread over the groups.
		var step := maxi(blades / samples, 1)
		# The renderer without a display keeps the buffer only.
		var buffer := node.multimesh.buffer
		var i := (step - number % step) % step
		while i < count:
			var o := 20 * i
			var at := place * Vector3(buffer[o + 3], buffer[o + 7], buffer[o + 11])
			var x := Vector3(buffer[o], buffer[o + 4], buffer[o + 8])
			var y := Vector3(buffer[o + 1], buffer[o + 5], buffer[o + 9])
			result.instances.append([node.name, i, at.x, at.y, at.z, x.length(), y.length()])
			i += step
		number += count
	for property: String in ["wind_strength", "wind_speed", "wave_length", "gust_size", "gustiness"]:
		if property in root:
			result[property] = root.get(property)
	root.free()
	return result
