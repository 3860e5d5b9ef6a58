extends GLTFDocumentExtension
## Takes the ground alone of a .glb that `sward export --with-ground` wrote.

const INSTANCING := "EXT_mesh_gpu_instancing"


## The ground, or null if the file cannot be read.
static func load_from(path: String) -> Node3D:
	var extension := new()
	GLTFDocument.register_gltf_document_extension(extension, true)
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	var scene: Node = document.generate_scene(state) if document.append_from_file(path, state) == OK else null
	GLTFDocument.unregister_gltf_document_extension(extension)
	return scene as Node3D


func _get_supported_extensions() -> PackedStringArray:
	return [INSTANCING]


func _import_preflight(_state: GLTFState, _extensions: PackedStringArray) -> Error:
	return OK


func _parse_node_extensions(_state: GLTFState, node: GLTFNode, extensions: Dictionary) -> Error:
	if extensions.has(INSTANCING):
		node.mesh = -1
	return OK
