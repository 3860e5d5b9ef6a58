@tool
extends RefCounted
## Sun and surroundings of a scene of Godot, as the look of Sward's settings.

# Of the light from above and from below, relative to the sun: Sward's defaults at a sun of this luminance.
const USUAL_SUN := Vector3(3.4, 2.85, 2.1)
const USUAL_SKY := Vector3(0.42, 0.60, 0.92)
const USUAL_GROUND := Vector3(0.22, 0.2, 0.12)

var _sun: DirectionalLight3D
var _environment: Environment
var _last := []


## Looks at the scene of a node; true if its light has changed.
func update(node: Node3D) -> bool:
	if not is_instance_valid(_sun) or not _sun.is_inside_tree():
		_sun = _find_sun(node)
	_environment = node.get_world_3d().environment
	if _environment == null:
		_environment = node.get_world_3d().fallback_environment
	var now := [_sun, _environment]
	if _sun:
		now.append_array([_sun.global_basis.z, _sun.light_color, _sun.light_energy, _sun.is_visible_in_tree()])
	if _environment:
		now.append_array([_environment.ambient_light_source, _environment.ambient_light_color,
				_environment.ambient_light_energy])
	if now == _last:
		return false
	_last = now
	return true


## The keys of "look" in a settings file (docs/settings.md of Sward). Without a sun the field's own stay.
func look() -> Dictionary:
	if _sun == null:
		return {}
	var towards := _sun.global_basis.z.normalized()
	var linear := _sun.light_color.srgb_to_linear() * _sun.light_energy
	if not _sun.is_visible_in_tree():
		linear = Color.BLACK
	# Godot's light of energy 1 makes a white surface as bright as Sward's of colour 1.
	var share := maxf(linear.get_luminance(), 0.0) / 2.9
	var sky := USUAL_SKY * share
	var ground := USUAL_GROUND * share
	if _environment and _environment.ambient_light_source == Environment.AMBIENT_SOURCE_COLOR:
		var ambient := _environment.ambient_light_color.srgb_to_linear() * _environment.ambient_light_energy
		sky = Vector3(ambient.r, ambient.g, ambient.b)
		ground = sky
	return {
		"sun": {
			"azimuth": fposmod(rad_to_deg(atan2(towards.x, -towards.z)), 360.0),
			"elevation": rad_to_deg(asin(clampf(towards.y, -1.0, 1.0))),
			"color": [linear.r, linear.g, linear.b],
		},
		"sky": [sky.x, sky.y, sky.z],
		"ground": [ground.x, ground.y, ground.z],
		"exposure": 1.0,
	}


func _find_sun(node: Node3D) -> DirectionalLight3D:
	var named: NodePath = node.get("sun")
	if named:
		return node.get_node_or_null(named) as DirectionalLight3D
	var root := node.owner if node.owner else node.get_tree().current_scene
	var found := (root if root else node.get_tree().root).find_children("*", "DirectionalLight3D", true, false)
	return found[0] if found else null
