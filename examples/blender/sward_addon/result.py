"""A field in Blender: a mesh of points with attributes, and Geometry Nodes that put a blade on each."""

import bpy
import numpy as np

GROUP = "Sward blades"
GROUND, FIELD, BLADES = "sward_ground", "sward_field", "sward_blades"  # properties of the collection
SHOWN = 50_000  # blades that a viewport draws fluently


def upright(vectors):
    """glTF's axes (Y up) to Blender's (Z up), of vectors in rows."""
    return np.stack([vectors[:, 0], -vectors[:, 2], vectors[:, 1]], axis=1)


def turns(quaternions):
    """Rotations of blades in glTF's axes (x y z w) as matrices in Blender's: +Z goes to the up-vector, -Y to where
    the blade looks."""
    x, y, z = upright(np.asarray(quaternions[:, :3], float)).T
    w = np.asarray(quaternions[:, 3], float)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), 2, 0)


def angles(matrices):
    """Euler angles X, Y, Z of rotation matrices [rad]."""
    level = np.hypot(matrices[:, 0, 0], matrices[:, 1, 0])
    free = level > 1e-6
    x = np.where(free, np.arctan2(matrices[:, 2, 1], matrices[:, 2, 2]), np.arctan2(-matrices[:, 1, 2], matrices[:, 1, 1]))
    z = np.where(free, np.arctan2(matrices[:, 1, 0], matrices[:, 0, 0]), 0.0)
    return np.stack([x, np.arctan2(-matrices[:, 2, 0], level), z], axis=1)


def find(ground):
    """The collection of what was baked on the object of this name; None if there is none."""
    return next((each for each in bpy.data.collections if each.get(GROUND) == ground), None)


def field_of(item):
    """The collection of the field that an object is the ground or the blades of; None if there is none."""
    if item is None:
        return None
    return find(item.name) or next((each for each in item.users_collection if GROUND in each), None)


def build(scene, ground, field, blades, metres):
    """Makes the collection of a field, and takes that of the ground's former one away. `metres` is the length of
    a unit of the scene. What was made is removed if it fails."""
    made = []
    try:
        former = find(ground)
        share = min(1.0, SHOWN / max(len(blades), 1))
        collection = keep(made, bpy.data.collections.new(f"Sward: {ground}"))
        species = keep(made, bpy.data.collections.new(f"Sward species: {ground}"))
        for number, (name, *shape) in enumerate(blades.species):
            species.objects.link(blade_object(made, f"{number:02} {name}", *shape))
        points = keep(made, bpy.data.objects.new("Sward blades", points_mesh(made, blades, metres)))
        points.location = upright(blades.origin[None, :])[0] / metres
        points.scale = (1.0 / metres,) * 3
        modifier = points.modifiers.new("Blades", "NODES")
        modifier.node_group = node_group()
        set_input(modifier, "Species", species)
        set_input(modifier, "Viewport share", share)
        collection.objects.link(points)
        collection[GROUND], collection[FIELD], collection[BLADES] = ground, field, len(blades)
    except Exception:
        bpy.data.batch_remove(made)
        raise
    if former is not None:
        remove(former)
    collection.name = f"Sward: {ground}"
    scene.collection.children.link(collection)
    return collection


def keep(made, item):
    made.append(item)
    return item


def remove(collection):
    """Takes a field's collection away with all that belongs to it alone."""
    gone = [collection]
    for item in collection.objects:
        modifier = item.modifiers.get("Blades")
        if GROUND not in collection or modifier is None:
            continue
        gone += [item, item.data]
        species = get_input(modifier, "Species")
        if species is not None:
            gone.append(species)
            for each in species.objects:
                gone += [each, each.data, *each.data.materials]
    bpy.data.batch_remove(set(gone))


def points_mesh(made, blades, metres):
    """Vertices are roots; positions in metres from the field's origin."""
    columns = blades.columns
    mesh = keep(made, bpy.data.meshes.new("Sward blades"))
    count = len(blades)
    if count == 0:
        return mesh
    mesh.vertices.add(count)
    mesh.vertices.foreach_set("co", upright(columns["TRANSLATION"]).astype("f4").ravel())
    matrices = turns(columns["ROTATION"])
    scale = np.asarray(columns["SCALE"], "f4")
    add(mesh, "up", "FLOAT_VECTOR", "vector", matrices[:, :, 2])
    add(mesh, "facing", "FLOAT_VECTOR", "vector", -matrices[:, :, 1])
    add(mesh, "rotation", "FLOAT_VECTOR", "vector", angles(matrices))
    add(mesh, "size", "FLOAT_VECTOR", "vector", scale[:, [0, 2, 1]])
    for name in ("height", "width", "stiffness", "exposure"):
        add(mesh, name, "FLOAT", "value", columns["_" + name.upper()])
    add(mesh, "species", "INT", "value", columns["species"])
    add(mesh, "tint", "BYTE_COLOR", "color_srgb", columns["_TINT"] / np.float32(255.0))
    mesh.update()
    return mesh


def add(mesh, name, kind, key, values):
    values = np.ascontiguousarray(values, np.int32 if kind == "INT" else np.float32)
    mesh.attributes.new(name, kind, "POINT").data.foreach_set(key, values.ravel())


def blade_object(made, name, positions, triangles, colors):
    mesh = keep(made, bpy.data.meshes.new(name))
    mesh.from_pydata(upright(positions).tolist(), [], triangles.tolist())
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    attribute = mesh.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
    attribute.data.foreach_set("color", np.hstack([colors, np.ones((len(colors), 1))]).astype("f4").ravel())
    mesh.materials.append(blade_material(made, name, colors))
    return keep(made, bpy.data.objects.new(name, mesh))


def blade_material(made, name, colors):
    material = keep(made, bpy.data.materials.new(f"Sward {name}"))
    material.diffuse_color = (*colors.mean(axis=0).tolist(), 1.0)
    material.use_nodes = True
    tree = material.node_tree
    shader = tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 0.7
    color = tree.nodes.new("ShaderNodeVertexColor")
    color.layer_name = "Color"
    tree.links.new(color.outputs["Color"], shader.inputs["Base Color"])
    return material


def node_group():
    """Puts a blade of its species on each point. A viewport shows a share of the points, a render all."""
    group = bpy.data.node_groups.get(GROUP)
    if group is not None and group.type == "GEOMETRY":
        return group
    group = bpy.data.node_groups.new(GROUP, "GeometryNodeTree")
    for name, kind in (("Geometry", "NodeSocketGeometry"), ("Species", "NodeSocketCollection"),
                       ("Viewport share", "NodeSocketFloat")):
        socket = new_socket(group, name, kind, "INPUT")
        if name == "Viewport share":
            socket.default_value, socket.min_value, socket.max_value = 1.0, 0.0, 1.0
    new_socket(group, "Geometry", "NodeSocketGeometry", "OUTPUT")

    nodes, links = group.nodes, group.links
    start, end = nodes.new("NodeGroupInput"), nodes.new("NodeGroupOutput")
    picked = nodes.new("GeometryNodeCollectionInfo")
    picked.inputs["Separate Children"].default_value = True
    picked.inputs["Reset Children"].default_value = True
    links.new(start.outputs["Species"], picked.inputs["Collection"])

    # A blade is drawn if its own random number, at most 1, is not above the share.
    chance = nodes.new("FunctionNodeRandomValue")
    shown = nodes.new("GeometryNodeSwitch")
    shown.input_type = "FLOAT"
    falls, passes = (socket for socket in shown.inputs if socket.enabled and socket.name in ("False", "True"))
    falls.default_value = 1.0
    links.new(nodes.new("GeometryNodeIsViewport").outputs[0], next(s for s in shown.inputs if s.enabled))
    links.new(start.outputs["Viewport share"], passes)
    drawn = nodes.new("FunctionNodeCompare")
    drawn.operation = "LESS_EQUAL"
    links.new(next(s for s in chance.outputs if s.enabled), drawn.inputs["A"])
    links.new(next(s for s in shown.outputs if s.enabled), drawn.inputs["B"])

    instances = nodes.new("GeometryNodeInstanceOnPoints")
    instances.inputs["Pick Instance"].default_value = True
    links.new(start.outputs["Geometry"], instances.inputs["Points"])
    links.new(drawn.outputs[0], instances.inputs["Selection"])
    links.new(picked.outputs[0], instances.inputs["Instance"])
    for name, kind, target in (("species", "INT", "Instance Index"), ("rotation", "FLOAT_VECTOR", "Rotation"),
                               ("size", "FLOAT_VECTOR", "Scale")):
        node = nodes.new("GeometryNodeInputNamedAttribute")
        node.data_type = kind
        node.inputs["Name"].default_value = name
        links.new(next(s for s in node.outputs if s.enabled), instances.inputs[target])
    links.new(instances.outputs[0], end.inputs[0])
    for place, node in enumerate(nodes):
        node.location = (220.0 * (place // 3), -180.0 * (place % 3))
    return group


def new_socket(group, name, kind, way):
    if hasattr(group, "interface"):  # Blender 4.0
        return group.interface.new_socket(name, in_out=way, socket_type=kind)
    return (group.inputs if way == "INPUT" else group.outputs).new(kind, name)


def input_key(modifier, name):
    group = modifier.node_group
    sockets = group.inputs if hasattr(group, "inputs") else group.interface.items_tree
    return next(each.identifier for each in sockets if each.name == name)


def set_input(modifier, name, value):
    modifier[input_key(modifier, name)] = value


def get_input(modifier, name):
    return modifier.get(input_key(modifier, name)) if modifier.node_group else None
