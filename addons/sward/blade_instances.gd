@tool
extends RefCounted
## Turns the instance attributes of a node into the buffer of a MultiMesh.
##
## 20 numbers an instance: three rows of its transform, four of its colour, four of its custom data. The Compatibility
## renderer stores the last eight as halves, which hold integers up to 2048 exactly:
## colour: linear colour of the tip; leaf area around the root.
## custom: stiffness (6 bits) + 64 exposure (5 bits); rank; root colour, sRGB: red (5 bits) + 32 green (6 bits); blue
## (5 bits).

const Accessors := preload("res://addons/sward/gltf_accessors.gd")

## Numbers of an instance in the buffer.
const NUMBERS := 20

## counts[k] of a group is the number of its instances with a rank below 2^(-k / STEPS_PER_OCTAVE).
const STEPS_PER_OCTAVE := 4
const STEPS := 33

const BYTES := [5121]

## What `make()` has found out; `fault` is empty if all went well.
var fault := ""
var buffer := PackedFloat32Array()
## Instances below each rank, see STEPS_PER_OCTAVE.
var counts := PackedInt32Array()
var count := 0


## Reads the `attributes` of a node's extension. `root_color` and `tip_color`, linear, are those of its species, for files
## without drawn colours.
func make(accessors: Accessors, attributes: Dictionary, root_color: Color, tip_color: Color) -> void:
	for name in ["TRANSLATION", "ROTATION", "SCALE"]:
		if not attributes.has(name):
			continue
		count = maxi(count, accessors.count(int(attributes[name])))
	for name: String in attributes:
		var own := accessors.count(int(attributes[name]))
		if own != count and fault.is_empty() and accessors.fault.is_empty():
			fault = "%s has %d elements, other attributes have %d" % [name, own, count]
	var places := _numbers(accessors, attributes, "TRANSLATION", [0.0, 0.0, 0.0])
	var turns := _numbers(accessors, attributes, "ROTATION", [0.0, 0.0, 0.0, 1.0])
	var scales := _numbers(accessors, attributes, "SCALE", [1.0, 1.0, 1.0])
	var stiffness := _numbers(accessors, attributes, "_STIFFNESS", [0.5])
	var exposure := _numbers(accessors, attributes, "_EXPOSURE", [1.0])
	var ranks := _numbers(accessors, attributes, "_RANK", [0.0])
	var leaf_area := _numbers(accessors, attributes, "_LEAF_AREA", [0.0])
	var roots := _colors(accessors, attributes, "_ROOT_COLOR", root_color)
	var tips := _colors(accessors, attributes, "_TIP_COLOR", tip_color)
	if fault.is_empty():
		fault = accessors.fault
	if not fault.is_empty():
		return
	_fill(places, turns, scales, stiffness, exposure, ranks, leaf_area, roots, tips)
	counts = counts_of(ranks)


## Instances below each rank of a list that rises.
static func counts_of(ranks: PackedFloat32Array) -> PackedInt32Array:
	var result := PackedInt32Array()
	result.resize(STEPS)
	for k in STEPS:
		result[k] = ranks.bsearch(pow(2.0, -float(k) / STEPS_PER_OCTAVE))
	# A rank is below 1.
	result[0] = ranks.size()
	return result


func _fill(places: PackedFloat32Array, turns: PackedFloat32Array, scales: PackedFloat32Array,
		stiffness: PackedFloat32Array, exposure: PackedFloat32Array, ranks: PackedFloat32Array,
		leaf_area: PackedFloat32Array, roots: PackedByteArray, tips: PackedByteArray) -> void:
	var linear := PackedFloat32Array()
	linear.resize(256)
	for i in 256:
		linear[i] = Color(i / 255.0, 0.0, 0.0).srgb_to_linear().r
	var to := PackedFloat32Array()
	to.resize(NUMBERS * count)
	var o := 0
	var i3 := 0
	var i4 := 0
	for i in count:
		var basis := Basis(Quaternion(turns[i4], turns[i4 + 1], turns[i4 + 2], turns[i4 + 3]).normalized())
		var x := basis.x * scales[i3]
		var y := basis.y * scales[i3 + 1]
		var z := basis.z * scales[i3 + 2]
		to[o] = x.x
		to[o + 1] = y.x
		to[o + 2] = z.x
		to[o + 3] = places[i3]
		to[o + 4] = x.y
		to[o + 5] = y.y
		to[o + 6] = z.y
		to[o + 7] = places[i3 + 1]
		to[o + 8] = x.z
		to[o + 9] = y.z
		to[o + 10] = z.z
		to[o + 11] = places[i3 + 2]
		to[o + 12] = linear[tips[i4]]
		to[o + 13] = linear[tips[i4 + 1]]
		to[o + 14] = linear[tips[i4 + 2]]
		to[o + 15] = leaf_area[i]
		to[o + 16] = roundf(63.0 * stiffness[i]) + 64.0 * roundf(31.0 * exposure[i])
		to[o + 17] = ranks[i]
		to[o + 18] = float((roots[i4] >> 3) + ((roots[i4 + 1] >> 2) << 5))
		to[o + 19] = float(roots[i4 + 2] >> 3)
		o += NUMBERS
		i3 += 3
		i4 += 4
	buffer = to


# The numbers of an attribute, or `otherwise` for each instance.
func _numbers(accessors: Accessors, attributes: Dictionary, name: String, otherwise: Array) -> PackedFloat32Array:
	if attributes.has(name):
		return accessors.numbers(int(attributes[name]), otherwise.size())
	var result := PackedFloat32Array()
	result.resize(count * otherwise.size())
	for k in otherwise.size():
		if otherwise[k] == 0.0:
			continue
		for i in count:
			result[i * otherwise.size() + k] = otherwise[k]
	return result


# The four bytes of a colour, or those of `otherwise` for each instance.
func _colors(accessors: Accessors, attributes: Dictionary, name: String, otherwise: Color) -> PackedByteArray:
	if attributes.has(name):
		return accessors.raw(int(attributes[name]), 4, PackedInt32Array(BYTES))
	var srgb := otherwise.linear_to_srgb()
	var one := PackedInt32Array([srgb.to_abgr32()]).to_byte_array()
	var result := PackedInt32Array()
	result.resize(count)
	result.fill(one.decode_s32(0))
	return result.to_byte_array()
