@tool
extends RefCounted
## The mesh of a species as the shader needs it.
##
## UV: across and along the ribbon. UV2: place along the blade or stalk, and height of the ridge of a folded blade in
## widths. CUSTOM0: linear colour of the mesh; 1 for the organs of a plant, 0 for a blade or stalk. It has no vertex
## colours, as Godot multiplies those by the instance's.

## The curve of the mesh at rest: a blade of height 1 from the origin over `v1` to `v2`.
var v1 := Vector3(0.0, 0.5, 0.0)
var v2 := Vector3(0.0, 1.0, 0.0)
var mesh: ArrayMesh
var fault := ""


func _init(source: ImporterMesh, base: Color, fold: float) -> void:
	if source == null or source.get_surface_count() != 1:
		fault = "a mesh of grass has one primitive, this one has %d" % (0 if source == null else source.get_surface_count())
		return
	var from := source.get_surface_arrays(0)
	if from[Mesh.ARRAY_TEX_UV] == null or from[Mesh.ARRAY_NORMAL] == null:
		fault = "a mesh of grass needs TEXCOORD_0 and NORMAL"
		return
	var places: PackedVector3Array = from[Mesh.ARRAY_VERTEX]
	var uvs: PackedVector2Array = from[Mesh.ARRAY_TEX_UV]
	var colors := PackedColorArray()
	if from[Mesh.ARRAY_COLOR] != null:
		colors = from[Mesh.ARRAY_COLOR]
	else:
		colors.resize(places.size())
		colors.fill(Color.WHITE)
	# The first ribbon is the blade or the stalk; it ends where the next begins at its root.
	var first := 1
	while first < uvs.size() and uvs[first].y >= uvs[first - 1].y:
		first += 1
	_find_curve(places, uvs, first)
	var along := PackedVector2Array()
	var custom := PackedFloat32Array()
	for i in places.size():
		var is_organ := i >= first
		along.append(Vector2(_nearest(places[i]) if is_organ else uvs[i].y, _ridge(uvs, i, fold)))
		var color := colors[i] * base
		custom.append_array([color.r, color.g, color.b, 1.0 if is_organ else 0.0])
	var to := []
	to.resize(Mesh.ARRAY_MAX)
	to[Mesh.ARRAY_VERTEX] = places
	to[Mesh.ARRAY_NORMAL] = from[Mesh.ARRAY_NORMAL]
	to[Mesh.ARRAY_TEX_UV] = uvs
	to[Mesh.ARRAY_TEX_UV2] = along
	to[Mesh.ARRAY_CUSTOM0] = custom
	to[Mesh.ARRAY_INDEX] = from[Mesh.ARRAY_INDEX]
	mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, to, [], {},
			Mesh.ARRAY_CUSTOM_RGBA_FLOAT << Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT)


# A quadratic Bézier curve from its middle and its end.
func _find_curve(places: PackedVector3Array, uvs: PackedVector2Array, first: int) -> void:
	var middle := Vector3.ZERO
	var end := Vector3.ZERO
	var in_middle := 0
	var at_end := 0
	for i in first:
		if _ridge(uvs, i, 1.0) > 0.0:
			continue
		if absf(uvs[i].y - 0.5) < 1e-4:
			middle += places[i]
			in_middle += 1
		elif absf(uvs[i].y - 1.0) < 1e-4:
			end += places[i]
			at_end += 1
	if in_middle > 0 and at_end > 0:
		v2 = end / at_end
		v1 = 2.0 * middle / in_middle - 0.5 * v2


# Height of the ridge between the edges of its row, in widths; 0 for an edge.
static func _ridge(uvs: PackedVector2Array, i: int, fold: float) -> float:
	if i == 0 or i + 1 >= uvs.size() or uvs[i - 1].y != uvs[i].y or uvs[i + 1].y != uvs[i].y:
		return 0.0
	return 0.5 * fold * (uvs[i + 1].x - uvs[i - 1].x)


# Place along the curve that is nearest to a point.
func _nearest(point: Vector3) -> float:
	var best := 0.0
	var least := INF
	for i in 65:
		var t := i / 64.0
		var away := point.distance_squared_to(2.0 * t * (1.0 - t) * v1 + t * t * v2)
		if away < least:
			least = away
			best = t
	return best
