@tool
extends EditorPlugin
## Registers the importer of grass: from then on Godot imports .glb files with EXT_mesh_gpu_instancing.

const GltfGrass := preload("res://addons/sward/gltf_grass.gd")

var _importer: GLTFDocumentExtension


func _enter_tree() -> void:
	_importer = GltfGrass.new()
	# First, so that no other extension takes the nodes.
	GLTFDocument.register_gltf_document_extension(_importer, true)


func _exit_tree() -> void:
	GLTFDocument.unregister_gltf_document_extension(_importer)
	_importer = null
