# SPDX-License-Identifier: MIT
"""Models landscape.glb, the sample terrain: a small valley meadow with a path, a pond, a cliff and an arch.

    blender -b --factory-startup -P assets/meshes/make_landscape.py -- assets/meshes/landscape.glb
    blender -b --factory-startup -P assets/meshes/make_landscape.py -- OUT.glb --preview DIRECTORY

Needs Blender 3.4 with numpy (Debian 12: `blender python3-numpy`). Everything is computed here: the shapes and the noise in
landscape/, the textures too. Seeds are fixed, so the same Blender and numpy write the same file. `--preview` also renders a
few small pictures of the bare ground with Cycles.
"""

import json
import math
import os
import struct
import sys
import tempfile

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from landscape import rock  # noqa: E402
from landscape.ground import HALF, STEP, WATER_LEVEL, Ground  # noqa: E402

TILES = 2                 # the ground is cut into TILES x TILES nodes
CELLS = 192               # cells of the ground mesh along one side
CREASE = 48               # degrees: rock edges sharper than this are drawn sharp
COPYRIGHT = "CC0-1.0, the Sward authors"

# name, parent, x, z, height of the centre above the ground in radii, (axis), degrees, scale
BOULDERS = [
    ("boulder_meadow", "boulders", -3.6, 6.4, 0.30, (0.2, 1.0, 0.1), 20, (1.15, 0.95, 1.0)),
    ("boulder_path", "boulders", 3.9, 9.9, 0.10, (0.1, 1.0, -0.3), 140, (0.62, 0.5, 0.7)),
    ("boulder_pond", "boulders", -6.1, 4.9, 0.25, (0.0, 1.0, 0.3), 70, (0.85, 0.6, 0.8)),
    ("boulder_mirrored", "boulders", 7.6, 3.4, 0.25, (0.3, 1.0, 0.0), 50, (-0.95, 0.8, 1.1)),
    ("boulder_fallen", "boulders", 6.4, 0.6, 0.15, (0.8, 0.4, 0.2), 75, (0.75, 0.75, 0.75)),
    ("boulder_cairn", "boulders", -5.4, -6.2, 0.35, (0.1, 1.0, 0.1), 250, (0.8, 0.8, 0.8)),
    ("boulder_far", "boulders", 3.4, -13.2, 0.20, (0.0, 1.0, 0.2), 310, (0.9, 0.7, 0.8)),
    # children: placed in their parent's space (x, z and height in its units), one and then two boulders deep
    ("boulder_cairn_side", "boulder_cairn", -0.75, 0.75, -0.30, (0.9, 0.3, 0.1), 100, (0.5, 0.5, 0.5)),
    ("boulder_cairn_chip", "boulder_cairn_side", 0.95, 0.9, -0.40, (0.2, 0.9, 0.5), 200, (-0.45, 0.45, 0.45)),
]

# preview pictures: eye (its height is above the ground), target, vertical field of view, in glTF coordinates
VIEWS = {
    "edge": ((-2.6, 1.65, 16.0), (1.7, 2.4, -4.3), 45),
    "aerial": ((-17.0, 20.0, 27.0), (0.5, 0.0, 0.0), 45),
    "arch": ((1.2, 1.5, -0.6), (3.2, 3.9, -6.0), 62),
    "shelter": ((5.0, 1.6, 8.0), (10.5, 2.0, 2.0), 60),
    "pond": ((-15.0, 2.0, 13.0), (0.0, 1.0, -3.0), 50),
}


def to_blender(points):
    """glTF's y-up to Blender's z-up; the exporter turns it back exactly."""
    points = np.asarray(points, float)
    return np.stack([points[..., 0], -points[..., 2], points[..., 1]], -1)


class Scene:
    """What has been put into Blender, and the normals to be stamped into the exported file."""

    def __init__(self, directory):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.directory = directory
        self.stamps = {}                 # mesh name -> positions and normals as float32 in glTF coordinates

    def image(self, name, pixels):
        """An image of quality 85 from sRGB pixels, row 0 on top."""
        size = pixels.shape[0]
        draft = bpy.data.images.new(name + "_draft", size, size)
        rgba = np.ones((size, size, 4), np.float32)
        rgba[..., :3] = pixels[::-1]
        draft.pixels.foreach_set(rgba.ravel())
        settings = bpy.context.scene.render.image_settings
        settings.file_format, settings.quality = "JPEG", 85
        bpy.context.scene.view_settings.view_transform = "Standard"
        path = os.path.join(self.directory, name + ".jpg")
        draft.save_render(path)
        image = bpy.data.images.load(path)
        image.name = name
        return image

    def material(self, name, image=None, colour=(1, 1, 1), roughness=0.95):
        material = bpy.data.materials.new(name)
        material.use_nodes = material.use_backface_culling = True
        shader = material.node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = (*colour, 1)
        shader.inputs["Roughness"].default_value = roughness
        shader.inputs["Metallic"].default_value = 0.0
        if image:
            texture = material.node_tree.nodes.new("ShaderNodeTexImage")
            texture.image = image
            material.node_tree.links.new(shader.inputs["Base Color"], texture.outputs["Color"])
        return material

    def mesh(self, name, vertices, faces, normals, uv, material, mask=None):
        """A mesh of some faces; normals and `uv` are per corner, `mask` (COLOR_0) is per vertex.

        Vertices are split here wherever normal or uv differ, so that the exporter has nothing left to split or to reorder."""
        corner = np.hstack([faces.reshape(-1, 1), normals.reshape(-1, 3), uv.reshape(-1, 2)]).astype(np.float32)
        rows, index = np.unique(corner + np.float32(0), axis=0, return_inverse=True)
        used = rows[:, 0].astype(int)
        points = vertices[used].astype(np.float32) + np.float32(0)        # adding zero makes -0 a plain 0
        faces = index.reshape(-1, 3)
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(to_blender(points).tolist(), [], faces.tolist())
        mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
        mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", rows[faces.ravel(), 4:6].ravel())
        if mask is not None:
            # BYTE_COLOR is kept as 8-bit sRGB but read and written as linear values: what is painted here lands in COLOR_0
            # within 1/200, as normalised 16-bit numbers, half the size of FLOAT_COLOR's
            mesh.color_attributes.new("mask", "BYTE_COLOR", "POINT").data.foreach_set("color", mask[used].astype(np.float32).ravel())
            mesh.color_attributes.active_color_index = mesh.color_attributes.render_color_index = 0
        mesh.materials.append(material)
        mesh.update()
        self.stamps[name] = (points, np.ascontiguousarray(rows[:, 1:4]))
        return mesh

    def node(self, name, mesh=None, parent=None):
        node = bpy.data.objects.new(name, mesh)
        node.parent = parent
        bpy.context.scene.collection.objects.link(node)
        return node

    def export(self, path):
        bpy.ops.export_scene.gltf(
            filepath=path, export_format="GLB", export_copyright=COPYRIGHT, export_image_format="JPEG", export_yup=True,
            export_normals=True, export_tangents=False, export_texcoords=True, export_colors=True, export_materials="EXPORT",
            export_animations=False, export_skins=False, export_morph=False, export_cameras=False, export_lights=False)
        self._stamp_normals(path)

    def _stamp_normals(self, path):
        """Blender computes normals from each node alone, which differ along borders: puts the common ones in their place."""
        with open(path, "rb") as file:
            data = bytearray(file.read())
        length = struct.unpack_from("<I", data, 12)[0]
        gltf = json.loads(data[20:20 + length])
        binary = 20 + length + 8

        def offset(accessor):
            return binary + gltf["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)

        for mesh in gltf["meshes"]:
            attributes = mesh["primitives"][0]["attributes"]
            at, to = (offset(gltf["accessors"][attributes[k]]) for k in ("POSITION", "NORMAL"))
            points, normals = self.stamps[mesh["name"]]
            if not np.array_equal(np.frombuffer(data, np.float32, points.size, at) + np.float32(0), points.ravel()):
                raise RuntimeError("the exporter has reordered " + mesh["name"])
            data[to:to + normals.nbytes] = normals.tobytes()
        with open(path, "wb") as file:
            file.write(data)


def build_boulders(scene, ground, material):
    """Nine nodes that share one mesh; returns the distance to the nearest of them."""
    vertices, faces = rock.surface_nets(rock.boulder_distance, np.full(3, -1.5), np.full(3, 1.5), 0.145)
    vertices = rock.chisel(vertices, faces, 0.06)
    normals = rock.corner_normals(vertices, faces, CREASE)
    mesh = scene.mesh("boulder", vertices, faces, normals, rock.box_uv(vertices, faces, 5.0), material,
                      np.tile((0.0, 0.2, 0.0, 1.0), (len(vertices), 1)))
    nodes = {"boulders": scene.node("boulders")}
    for name, parent, x, z, lift, axis, degrees, scale in BOULDERS:
        node = nodes[name] = scene.node(name, mesh, nodes[parent])
        height = lift * abs(scale[1]) + (ground.at(ground.height, x, z) if parent == "boulders" else 0.0)
        node.location = to_blender((x, height, z))
        node.rotation_mode = "QUATERNION"
        node.rotation_quaternion = Quaternion(Vector(to_blender(axis)).normalized(), math.radians(degrees))
        node.scale = (scale[0], scale[2], scale[1])
    bpy.context.view_layer.update()
    inverses = [(np.array(nodes[b[0]].matrix_world.inverted()), min(np.abs(nodes[b[0]].matrix_world.to_scale()))) for b in BOULDERS]

    def distance(points):
        result = np.full(len(points), 9.0)
        for inverse, size in inverses:
            local = to_blender(points) @ inverse[:3, :3].T + inverse[:3, 3]
            near = np.linalg.norm(local, axis=1) < 2.5
            local = local[near]
            local = np.stack([local[:, 0], local[:, 2], -local[:, 1]], -1)
            result[near] = np.minimum(result[near], rock.boulder_distance(local) * size)
        return result

    return distance


def build_ground(scene, ground, material):
    """The heightfield as TILES x TILES nodes with common borders."""
    every = int(round(2 * HALF / CELLS / STEP))
    x, y, z = (raster[::every, ::every] for raster in (ground.x, ground.height, ground.z))
    vertices = np.stack([x, y, z], -1).reshape(-1, 3)
    index = np.arange((CELLS + 1) ** 2).reshape(CELLS + 1, CELLS + 1)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]      # counter-clockwise from above
    height = vertices[:, 1]
    flip = (np.abs(height[a] - height[c]) > np.abs(height[b] - height[d]))[..., None]   # the flatter diagonal
    first = np.where(flip, np.stack([a, b, d], -1), np.stack([a, b, c], -1))
    second = np.where(flip, np.stack([b, c, d], -1), np.stack([a, c, d], -1))
    cells = np.stack([first, second], 2)                                             # row, column, half, corner
    normals = rock.corner_normals(vertices, cells.reshape(-1, 3)).reshape(*cells.shape, 3)
    mask = ground.mask(vertices[:, 0], vertices[:, 2])
    uv = np.stack([(vertices[:, 0] + HALF) / (2 * HALF), 1.0 - (vertices[:, 2] + HALF) / (2 * HALF)], -1)
    side = CELLS // TILES
    for row in range(TILES):
        for column in range(TILES):
            name = "ground_" + "ns"[row] + "we"[column]
            tile = np.s_[row * side:(row + 1) * side, column * side:(column + 1) * side]
            faces = cells[tile].reshape(-1, 3)
            scene.node(name, scene.mesh(name, vertices, faces, normals[tile], uv[faces], material, mask))


def build_water(scene, ground, material):
    """A flat sheet over the brook and the pond, cut where the banks stand above it."""
    every = 6                                                                        # cells of 0.6 m
    low = ground.height < WATER_LEVEL + 0.05
    n = (ground.height.shape[0] - 1) // every
    wet = np.zeros((n, n), bool)
    for i in range(every + 1):
        for j in range(every + 1):
            wet |= low[i:i + every * n:every, j:j + every * n:every]
    index = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = index[:-1, :-1][wet], index[1:, :-1][wet], index[1:, 1:][wet], index[:-1, 1:][wet]
    faces = np.vstack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
    x, z = ground.x[::every, ::every].ravel(), ground.z[::every, ::every].ravel()
    vertices = np.stack([x, np.full_like(x, WATER_LEVEL), z], -1)
    normals = np.tile((0.0, 1.0, 0.0), (len(faces), 3, 1))
    scene.node("water", scene.mesh("water", vertices, faces, normals, np.stack([x, -z], -1)[faces] / 4.0, material))


def build_rock(scene, ground, cliff_material, arch_material):
    vertices, faces, is_arch = rock.cliff_and_arch(ground)
    normals = rock.corner_normals(vertices, faces, CREASE)
    smooth = np.zeros_like(vertices)
    smooth[faces] = rock.corner_normals(vertices, faces)
    mask = rock.rock_mask(vertices, smooth)
    for name, chosen, material in (("cliff", ~is_arch, cliff_material), ("arch", is_arch, arch_material)):
        part = faces[chosen]
        scene.node(name, scene.mesh(name, vertices, part, normals[chosen], rock.box_uv(vertices, part, 6.0), material, mask))


def build(scene):
    ground = Ground()
    stone = scene.image("rock_albedo", rock.rock_albedo(1024))
    boulders = build_boulders(scene, ground, scene.material("rock_boulder", stone))
    ground.cover(lambda points: np.minimum(rock.rock_distance(points), boulders(points)))
    build_ground(scene, ground, scene.material("meadow_ground", scene.image("meadow_albedo", ground.albedo(1024))))
    build_rock(scene, ground, scene.material("rock_cliff", stone), scene.material("rock_arch", stone))
    build_water(scene, ground, scene.material("water", colour=(0.030, 0.085, 0.080), roughness=0.08))
    return ground


def preview(stamps, directory, ground, views):
    """Small pictures of the bare ground under a low sun and a plain sky."""
    for name, (_, normals) in stamps.items():
        bpy.data.meshes[name].use_auto_smooth = True
        bpy.data.meshes[name].normals_split_custom_set_from_vertices(to_blender(normals).tolist())
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.max_bounces, scene.cycles.use_denoising = 20, 3, False
    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    scene.render.image_settings.file_format = "PNG"
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.45, 0.62, 0.85, 1)
    background.inputs["Strength"].default_value = 0.8
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle, sun.data.color = 4.0, 0.01, (1.0, 0.92, 0.78)
    sun.rotation_euler = Vector(to_blender((-0.75, 0.75, 0.55))).to_track_quat("Z", "Y").to_euler()
    scene.collection.objects.link(sun)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_fit = "VERTICAL"
    scene.collection.objects.link(camera)
    scene.camera = camera
    for name in views:
        (x, above, z), target, degrees = VIEWS[name]
        eye = (x, above + ground.at(ground.height, x, z), z)
        print("view %s: eye %.2f %.2f %.2f" % (name, *eye))
        eye, target = Vector(to_blender(eye)), Vector(to_blender(target))
        camera.matrix_world = Matrix.Translation(eye) @ (eye - target).to_track_quat("Z", "Y").to_matrix().to_4x4()
        camera.data.angle_y = math.radians(degrees)
        scene.render.filepath = os.path.join(directory, name + ".png")
        bpy.ops.render.render(write_still=True)


def main(arguments):
    output = os.path.abspath(arguments[0])
    with tempfile.TemporaryDirectory() as directory:
        scene = Scene(directory)
        ground = build(scene)
        scene.export(output)
        if "--preview" in arguments:
            at = arguments.index("--preview")
            preview(scene.stamps, os.path.abspath(arguments[at + 1]), ground, arguments[at + 2:] or VIEWS)


main(sys.argv[sys.argv.index("--") + 1:])
