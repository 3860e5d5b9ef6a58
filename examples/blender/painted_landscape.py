"""Makes a landscape with a painted mask in Blender and exports it for sward.

    blender -b --factory-startup --python painted_landscape.py -- FOLDER

FOLDER/landscape.glb  hills with a creek; what is painted lies in the red of its vertex colours
FOLDER/mask.png       the same paint as an image over the landscape's UV map
FOLDER/landscape.blend  to paint on by hand: Vertex Paint mode, colour attribute "Grass"

Blender 3.4 (Debian 12) and newer; nothing but bpy and mathutils.
"""

import math
import os
import sys

import bpy
from mathutils import Vector, noise

SIDE = 32.0  # [m]
CELLS = 200  # a vertex every 16 cm: as sharp as paint on vertices can be
PIXELS = 1024


def height(x, y):
    """Hills as the A.N.T. Landscape add-on makes them: hetero terrain noise, sunk along the creek."""
    place = Vector((x / 15.0 + 3.7, y / 15.0 - 1.2, 0.0))
    hills = 1.1 * noise.hetero_terrain(place, 1.0, 2.0, 5, 0.6, noise_basis="PERLIN_ORIGINAL")
    return hills - 0.8 * math.exp(-((creek(x, y) / 2.4) ** 2))


def creek(x, y):
    """Distance from the creek's middle [m], about."""
    return y - 4.0 * math.sin(x / 6.0) + 3.0


def paint(x, y):
    """Where grass grows, 0 to 1: not in the creek, nor on the ring of a path, nor round its centre."""
    def off(distance, width):
        return min(max((abs(distance) - width) / 0.4 + 0.5, 0.0), 1.0)

    ring = math.hypot(x - 3.0, y - 6.0)
    return off(creek(x, y), 1.3) * off(ring - 5.5, 0.6) * off(ring, 1.6)


def landscape():
    """A grid with heights, a UV map from 0 to 1, and the paint as a colour of each vertex."""
    step = SIDE / CELLS
    points = [(i * step - SIDE / 2, j * step - SIDE / 2) for j in range(CELLS + 1) for i in range(CELLS + 1)]
    row = CELLS + 1
    faces = [(j * row + i, j * row + i + 1, (j + 1) * row + i + 1, (j + 1) * row + i)
             for j in range(CELLS) for i in range(CELLS)]
    mesh = bpy.data.meshes.new("Landscape")
    mesh.from_pydata([(x, y, height(x, y)) for x, y in points], [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))

    colors = mesh.color_attributes.new("Grass", "FLOAT_COLOR", "POINT")
    for color, (x, y) in zip(colors.data, points):
        color.color = (paint(x, y), 0.0, 0.0, 1.0)
    mesh.color_attributes.active_color = colors

    uvs = mesh.uv_layers.new(name="Over all")
    for loop, uv in zip(mesh.loops, uvs.data):
        x, y = points[loop.vertex_index]
        uv.uv = (x / SIDE + 0.5, y / SIDE + 0.5)

    earth = bpy.data.materials.new("earth")
    earth.use_nodes = True
    shader = earth.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (0.16, 0.10, 0.06, 1.0)
    shader.inputs["Roughness"].default_value = 0.95
    mesh.materials.append(earth)
    return bpy.data.objects.new("Landscape", mesh)


def mask_image(path):
    """The paint as a grey picture; a value is stored as it is, whatever the screen makes of it."""
    image = bpy.data.images.new("mask", PIXELS, PIXELS)
    image.colorspace_settings.name = "Non-Color"
    pixels = []
    for j in range(PIXELS):
        for i in range(PIXELS):
            value = paint(((i + 0.5) / PIXELS - 0.5) * SIDE, ((j + 0.5) / PIXELS - 0.5) * SIDE)
            pixels += (value, value, value, 1.0)
    image.pixels.foreach_set(pixels)
    image.filepath_raw = path
    image.file_format = "PNG"
    image.save()


def main():
    folder = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
    os.makedirs(folder, exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.collection.objects.link(landscape())
    mask_image(os.path.join(folder, "mask.png"))
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "landscape.blend"), check_existing=False)
    # Y up and metres are what glTF means; colours are exported unless somebody says otherwise.
    bpy.ops.export_scene.gltf(filepath=os.path.join(folder, "landscape.glb"), export_format="GLB",
                              export_colors=True, export_apply=True, export_yup=True)


main()
