"""Draws blades and ground in Blender's Cycles; runs inside Blender: blender -b --factory-startup -P in_cycles.py -- WORK.json

WORK.json: {"arrays": file of field_arrays.py, "size": [w, h], "samples", "bounces", "gloss": bool, "threads",
"sky": radiance from above, "below": radiance from below, "up": unit, "views": [{"camera": {eye, target, up, fov_y_deg},
"sun": direction towards it, "color": its radiance as sward-view's settings state it, "seed", "output": an EXR file}]}.
Every picture has the light groups `sun` and `sky`, the whole, and alpha 0 where there is sky.
"""

import json
import math
import os
import sys

import bpy
import numpy as np
from mathutils import Matrix, Vector

SUN_DIAMETER = 0.53   # [degrees]
LEAF_INDEX = 1.32     # of refraction: Comar et al. 2014
LEAF_ROUGHNESS = 0.3  # between 0.46 across the veins and 0.18 along them


def mesh_object(scene, name, vertices, faces, colors, values):
    mesh = bpy.data.meshes.new(name)
    corners = faces.shape[1]
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", vertices.ravel())
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", faces.ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, corners, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(faces), corners, np.int32))
    for key, color in colors.items():
        padded = np.ones((len(color), 4), np.float32)
        padded[:, :3] = color
        mesh.attributes.new(key, "FLOAT_COLOR", "POINT").data.foreach_set("color", padded.ravel())
    for key, value in values.items():
        mesh.attributes.new(key, "FLOAT", "POINT").data.foreach_set("value", value)
    mesh.update(calc_edges=True)
    shown = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(shown)
    return shown


def material(name):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.node_tree.nodes.clear()
    return made, made.node_tree


def attribute(tree, name, output="Color"):
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_name = name
    return node.outputs[output]


def shaded(tree, kind, color):
    node = tree.nodes.new(kind)
    tree.links.new(color, node.inputs["Color"])
    return node.outputs[0]


def leaf_material(has_gloss):
    """Lambert reflection and Lambert transmission; with gloss, a dielectric layer whose share is the Fresnel factor."""
    made, tree = material("leaf")
    join = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(shaded(tree, "ShaderNodeBsdfDiffuse", attribute(tree, "reflected")), join.inputs[0])
    tree.links.new(shaded(tree, "ShaderNodeBsdfTranslucent", attribute(tree, "through")), join.inputs[1])
    result = join.outputs[0]
    if has_gloss:
        fresnel, share, glossy, layer = (tree.nodes.new(f"ShaderNode{kind}")
                                         for kind in ("Fresnel", "Math", "BsdfGlossy", "MixShader"))
        fresnel.inputs["IOR"].default_value = LEAF_INDEX
        share.operation = "MULTIPLY"
        tree.links.new(fresnel.outputs[0], share.inputs[0])
        tree.links.new(attribute(tree, "gloss", "Fac"), share.inputs[1])
        glossy.inputs["Roughness"].default_value = LEAF_ROUGHNESS
        tree.links.new(share.outputs[0], layer.inputs[0])
        tree.links.new(result, layer.inputs[1])
        tree.links.new(glossy.outputs[0], layer.inputs[2])
        result = layer.outputs[0]
    tree.links.new(result, tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return made


def ground_material():
    made, tree = material("ground")
    color = shaded(tree, "ShaderNodeBsdfDiffuse", attribute(tree, "reflected"))
    tree.links.new(color, tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return made


def even_sky(scene, up, above, below):
    """One radiance on either side of the horizon."""
    world = scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    make = lambda kind: tree.nodes.new(f"ShaderNode{kind}")
    output, background, place, rise, is_above, choice = (make(kind) for kind in (
        "OutputWorld", "Background", "TexCoord", "VectorMath", "Math", "MixRGB"))
    rise.operation, is_above.operation = "DOT_PRODUCT", "GREATER_THAN"
    rise.inputs[1].default_value, is_above.inputs[1].default_value = up, 0.0
    choice.inputs[1].default_value, choice.inputs[2].default_value = (*below, 1.0), (*above, 1.0)
    tree.links.new(place.outputs["Generated"], rise.inputs[0])
    tree.links.new(rise.outputs["Value"], is_above.inputs[0])
    tree.links.new(is_above.outputs[0], choice.inputs[0])
    tree.links.new(choice.outputs[0], background.inputs[0])
    tree.links.new(background.outputs[0], output.inputs[0])
    world.cycles.sampling_method = "MANUAL"
    world.cycles.sample_map_resolution = 64
    world.lightgroup = "sky"


def place_camera(camera, view):
    eye, target, up = (Vector(view[key]) for key in ("eye", "target", "up"))
    z = (eye - target).normalized()
    x = up.cross(z).normalized()
    y = z.cross(x)
    camera.data.angle = math.radians(view["fov_y_deg"])
    camera.data.clip_start, camera.data.clip_end = 0.01, 10000.0
    camera.matrix_world = Matrix(((x.x, y.x, z.x, eye.x), (x.y, y.y, z.y, eye.y), (x.z, y.z, z.z, eye.z), (0, 0, 0, 1)))


def set_up_render(scene, work):
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    cycles.device, cycles.samples = "CPU", work["samples"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = work["bounces"]
    cycles.transparent_max_bounces = work["bounces"]
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = 0.0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    render.film_transparent = True
    render.resolution_x, render.resolution_y = work["size"]
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", work["threads"]
    render.use_persistent_data = True
    render.use_file_extension = False
    settings = render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"


def main(path):
    with open(path, encoding="utf-8") as file:
        work = json.load(file)
    arrays = np.load(work["arrays"])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    blades = mesh_object(scene, "blades", arrays["vertices"], arrays["faces"],
                         {"reflected": arrays["reflected"], "through": arrays["through"]}, {"gloss": arrays["gloss"]})
    blades.data.materials.append(leaf_material(work["gloss"]))
    if len(arrays["ground"]):
        faces = np.arange(len(arrays["ground"]), dtype=np.int32).reshape(-1, 3)
        ground = mesh_object(scene, "ground", arrays["ground"], faces, {"reflected": arrays["ground_color"]}, {})
        ground.data.materials.append(ground_material())
    layer = scene.view_layers[0]
    for group in ("sun", "sky"):
        layer.lightgroups.add(name=group)
    even_sky(scene, work["up"], work["sky"], work["below"])
    # A sun's energy is its irradiance; Lambert's reflected radiance is albedo · irradiance / π.
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.angle, sun.data.energy = math.radians(SUN_DIAMETER), math.pi
    sun.rotation_mode, sun.lightgroup = "QUATERNION", "sun"
    scene.collection.objects.link(sun)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_fit = "VERTICAL"
    scene.collection.objects.link(camera)
    scene.camera = camera
    set_up_render(scene, work)
    for view in work["views"]:
        place_camera(camera, view["camera"])
        scene.cycles.seed = view["seed"]
        sun.data.color = view["color"]
        sun.rotation_quaternion = Vector(view["sun"]).to_track_quat("Z", "Y")
        # Whole or not at all.
        scene.render.filepath = view["output"] + ".part"
        bpy.ops.render.render(write_still=True)
        os.rename(view["output"] + ".part", view["output"])


main(sys.argv[sys.argv.index("--") + 1])
