"""A Blender object as ground: its evaluated mesh in the world, in metres, Y up."""

import bpy
import numpy as np

from . import glb

CELL = 32.0  # [m] a field's origin is a multiple of it


def metres_per_unit(scene):
    """Length of one unit of the scene [m]."""
    units = scene.unit_settings
    return units.scale_length if units.system != "NONE" else 1.0


def turned(vectors):
    """Blender's axes (Z up) to glTF's (Y up), of vectors in rows."""
    return np.stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]], axis=1)


def of_object(context, item, mask):
    """The ground of a mesh object; modifiers are applied. `mask` is None, ("GROUP", name) or ("ATTRIBUTE", name,
    channel). Throws ValueError, with a text for the user, if it is no ground or lacks the mask."""
    if item is None or item.type != "MESH":
        raise ValueError("Choose a mesh object as ground")
    if item.mode == "EDIT":
        item.update_from_editmode()
    graph = context.evaluated_depsgraph_get()
    evaluated = item.evaluated_get(graph)
    mesh = evaluated.to_mesh(preserve_all_data_layers=True, depsgraph=graph)
    try:
        return of_mesh(item, mesh, np.array(evaluated.matrix_world, float), metres_per_unit(context.scene), mask)
    finally:
        evaluated.to_mesh_clear()


def of_mesh(item, mesh, matrix, metres, mask):
    mesh.calc_loop_triangles()
    if not mesh.loop_triangles:
        raise ValueError(f'Object "{item.name}" has no faces')
    turn = matrix[:3, :3]
    mirrored = np.linalg.det(turn) < 0.0
    if np.linalg.det(turn) == 0.0:
        raise ValueError(f'Object "{item.name}" has the scale 0 on an axis')

    corners = read(mesh.loops, "vertex_index", 1, np.int32)
    points = read(mesh.vertices, "co", 3) @ turn.T + matrix[:3, 3]
    points = turned(points) * metres
    if not np.isfinite(points).all():
        raise ValueError(f'Object "{item.name}" has vertices that are not at a finite place')
    origin = np.round((points.min(axis=0) + points.max(axis=0)) / 2.0 / CELL) * CELL
    normals = turned(corner_normals(mesh) @ np.linalg.inv(turn))
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    triangles = read(mesh.loop_triangles, "loops", 3, np.int32)
    if mirrored:
        triangles = triangles[:, ::-1]
    weights = None if mask is None else np.clip(np.nan_to_num(mask_of(item, mesh, corners, mask)), 0.0, 1.0)
    return glb.Ground(item.name, origin, (points - origin)[corners], normals / np.maximum(length, 1e-30), triangles,
                      read(mesh.loop_triangles, "material_index", 1, np.int32), materials_of(item), weights)


def read(collection, name, columns, kind=np.float64):
    """A property of all elements as an array."""
    single = np.float32 if kind == np.float64 else kind
    values = np.empty(len(collection) * columns, single)
    collection.foreach_get(name, values)
    return (values if columns == 1 else values.reshape(-1, columns)).astype(kind)


def corner_normals(mesh):
    if hasattr(mesh, "corner_normals"):  # Blender 4.1
        return read(mesh.corner_normals, "vector", 3)
    mesh.calc_normals_split()
    return read(mesh.loops, "normal", 3)


def mask_of(item, mesh, corners, mask):
    """A number for each corner."""
    if mask[0] == "GROUP":
        group = item.vertex_groups.get(mask[1])
        if group is None:
            raise ValueError(f'Object "{item.name}" has no vertex group "{mask[1]}"')
        number = group.index
        weights = np.zeros(len(mesh.vertices))
        for index, vertex in enumerate(mesh.vertices):
            for entry in vertex.groups:
                if entry.group == number:
                    weights[index] = entry.weight
        return weights[corners]

    attribute = mesh.attributes.get(mask[1])
    if attribute is None:
        raise ValueError(f'Object "{item.name}" has no attribute "{mask[1]}"')
    if attribute.data_type in ("FLOAT", "INT", "INT8", "BOOLEAN"):
        kind = {"FLOAT": np.float64, "BOOLEAN": bool}.get(attribute.data_type, np.int32)
        values = read(attribute.data, "value", 1, kind).astype(float)
    elif attribute.data_type in ("FLOAT_COLOR", "BYTE_COLOR"):
        values = read(attribute.data, "color", 4)[:, "RGBA".index(mask[2])]
    else:
        raise ValueError(f'Attribute "{mask[1]}" is {attribute.data_type}; a mask is a number or a colour')
    if attribute.domain == "POINT":
        return values[corners]
    if attribute.domain == "CORNER":
        return values
    if attribute.domain == "FACE":
        return np.repeat(values, read(mesh.polygons, "loop_total", 1, np.int32))
    raise ValueError(f'Attribute "{mask[1]}" lies on {attribute.domain}; a mask lies on vertices, corners or faces')


def materials_of(item):
    """Names matter to `sward`: what is called rock or water bears no grass. Colours are those of the ground."""
    return [(slot.material.name, *look_of(slot.material)) if slot.material else ("none", (0.8, 0.8, 0.8), 0.9)
            for slot in item.material_slots]


def look_of(material):
    shader = material.use_nodes and material.node_tree.nodes.get("Principled BSDF")
    if shader and not shader.inputs["Base Color"].is_linked:
        return tuple(shader.inputs["Base Color"].default_value)[:3], shader.inputs["Roughness"].default_value
    return tuple(material.diffuse_color)[:3], material.roughness
