@tool
extends RefCounted
## Reads accessors of a glTF as numbers. The first fault is kept in `fault`, and everything read after it is empty.

## Component types: bytes, and the largest number of a normalised one (0: not an integer).
const COMPONENTS := {5120: [1, 127.0], 5121: [1, 255.0], 5122: [2, 32767.0], 5123: [2, 65535.0], 5126: [4, 0.0]}
const WIDTHS := {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

## What is wrong with the file, or empty.
var fault := ""

var _json: Dictionary
var _buffers: Array


func _init(json: Dictionary, buffers: Array) -> void:
	_json = json
	_buffers = buffers


## Number of elements of accessor `index`, or -1.
func count(index: int) -> int:
	var accessors: Array = _json.get("accessors", [])
	if index < 0 or index >= accessors.size():
		_fail("accessor %d is missing; the file has %d" % [index, accessors.size()])
		return -1
	return int(accessors[index].get("count", -1))


## The numbers of accessor `index`, `width` for each element, normalised integers as fractions.
func numbers(index: int, width: int) -> PackedFloat32Array:
	var bytes := raw(index, width, PackedInt32Array([5120, 5121, 5122, 5123, 5126]))
	if not fault.is_empty():
		return PackedFloat32Array()
	var accessor: Dictionary = _json.accessors[index]
	var type := int(accessor.componentType)
	if type == 5126:
		return bytes.to_float32_array()
	var largest: float = COMPONENTS[type][1] if accessor.get("normalized", false) else 1.0
	var result := PackedFloat32Array()
	var size: int = COMPONENTS[type][0]
	result.resize(bytes.size() / size)
	for i in result.size():
		var value := 0
		match type:
			5120: value = bytes.decode_s8(i)
			5121: value = bytes.decode_u8(i)
			5122: value = bytes.decode_s16(2 * i)
			5123: value = bytes.decode_u16(2 * i)
		result[i] = maxf(value / largest, -1.0)
	return result


## The bytes of accessor `index`, whose elements must have `width` components of one of `types`.
func raw(index: int, width: int, types: PackedInt32Array) -> PackedByteArray:
	var none := PackedByteArray()
	var elements := count(index)
	if not fault.is_empty():
		return none
	var accessor: Dictionary = _json.accessors[index]
	var type := int(accessor.get("componentType", 0))
	if not types.has(type) or WIDTHS.get(accessor.get("type", ""), 0) != width:
		return _fail("accessor %d has %s of component type %d; expected %d of %s" % [index, accessor.get("type", "?"), type, width, types])
	if elements < 0 or accessor.has("sparse") or not accessor.has("bufferView"):
		return _fail("accessor %d is sparse or has no buffer view, which is not read" % index)
	var views: Array = _json.get("bufferViews", [])
	var number := int(accessor.bufferView)
	if number < 0 or number >= views.size():
		return _fail("buffer view %d of accessor %d is missing; the file has %d" % [number, index, views.size()])
	var view: Dictionary = views[number]
	if not view.get("extensions", {}).is_empty():
		return _fail("buffer view %d is compressed (%s), which is not read" % [number, ", ".join(view.extensions.keys())])
	var size: int = COMPONENTS[type][0] * width
	if int(view.get("byteStride", size)) != size:
		return _fail("buffer view %d has a stride of %d bytes, elements of accessor %d have %d" % [number, int(view.byteStride), index, size])
	var inside := int(accessor.get("byteOffset", 0))
	var length := size * elements
	if inside < 0 or inside + length > int(view.get("byteLength", 0)):
		return _fail("accessor %d needs %d bytes, its buffer view %d has %d" % [index, inside + length, number, int(view.get("byteLength", 0))])
	var buffer := int(view.get("buffer", -1))
	if buffer < 0 or buffer >= _buffers.size() or _buffers[buffer].is_empty():
		return _fail("buffer %d of buffer view %d is missing" % [buffer, number])
	var bytes: PackedByteArray = _buffers[buffer]
	var first := int(view.get("byteOffset", 0)) + inside
	if first < 0 or first + length > bytes.size():
		return _fail("accessor %d ends at byte %d, buffer %d has %d" % [index, first + length, buffer, bytes.size()])
	return bytes.slice(first, first + length)


func _fail(text: String) -> PackedByteArray:
	if fault.is_empty():
		fault = text
	return PackedByteArray()
