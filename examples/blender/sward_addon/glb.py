"""glTF in binary form: grounds that are written for `sward`, blades that `sward export` has written.

Arrays are NumPy's. All lengths are metres, Y is up. Nothing here knows Blender.
"""

import json
import struct

import numpy as np

FLOAT, UNSIGNED_INT = 5126, 5125
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


class Ground:
    """What grass grows on. Vertices are corners of faces: one for each corner."""

    def __init__(self, name, origin, positions, normals, triangles, slots, materials, mask=None):
        self.name = name  # of the node
        self.origin = origin  # of the positions [m], 3 numbers
        self.positions = positions  # (vertices, 3) [m]
        self.normals = normals  # (vertices, 3), unit length
        self.triangles = triangles  # (triangles, 3) numbers of vertices, counter-clockwise from the front
        self.slots = slots  # (triangles) numbers in `materials`
        self.materials = materials  # [(name, linear RGB, roughness)], may be empty
        self.mask = mask  # (vertices) 0 to 1, or None: attribute _SWARD_MASK


class Blades:
    """Blades of a field, in the order of its file, and a mesh for each species."""

    def __init__(self, origin, columns, species):
        self.origin = origin  # of the positions [m], 3 numbers
        # TRANSLATION, ROTATION (x y z w), SCALE, _HEIGHT, … and species: arrays, a row for each blade.
        self.columns = columns
        self.species = species  # [(name, positions, triangles, linear RGB of each vertex)]

    def __len__(self):
        return len(self.columns["species"])


def write_ground(path, ground):
    """Writes a .glb with one node, and a primitive for each material that is used."""
    views, accessors, parts = [], [], []

    def add(array, kind, component):
        content = np.ascontiguousarray(array, TYPES[component]).tobytes()
        start = sum(view["byteLength"] for view in views)
        views.append({"buffer": 0, "byteOffset": start, "byteLength": len(content)})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(array), "type": kind})
        parts.append(content)
        return len(accessors) - 1

    positions = np.asarray(ground.positions, "<f4")
    attributes = {"POSITION": add(positions, "VEC3", FLOAT)}
    accessors[0].update(min=positions.min(axis=0).tolist(), max=positions.max(axis=0).tolist())
    attributes["NORMAL"] = add(ground.normals, "VEC3", FLOAT)
    if ground.mask is not None:
        attributes["_SWARD_MASK"] = add(ground.mask, "SCALAR", FLOAT)
    primitives = []
    for slot in np.unique(ground.slots):
        indices = add(ground.triangles[ground.slots == slot].ravel(), "SCALAR", UNSIGNED_INT)
        primitives.append({"attributes": attributes, "indices": indices})
        if slot < len(ground.materials):
            primitives[-1]["material"] = int(slot)
    document = {
        "asset": {"version": "2.0", "generator": "Sward add-on for Blender"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": ground.name, "translation": [float(x) for x in ground.origin]}],
        "meshes": [{"primitives": primitives}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": sum(map(len, parts))}],
    }
    if ground.materials:
        document["materials"] = [
            {"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*map(float, color), 1.0], "metallicFactor": 0.0,
                                                    "roughnessFactor": float(roughness)}}
            for name, color, roughness in ground.materials]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    size = document["buffers"][0]["byteLength"]
    total = 12 + 8 + len(text) + 8 + size + -size % 4
    if total >= 2 ** 32:
        raise ValueError(f"{ground.name} takes {total / 1e9:.1f} GB as .glb, whose limit is 4.3 GB")
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, total))
        file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", size + -size % 4, 0x004E4942))
        file.writelines(parts)
        file.write(bytes(-size % 4))


def read_blades(path):
    """Reads what `sward export FIELD -o PATH.glb` has written. Throws ValueError if it is something else."""
    content = np.memmap(path, np.uint8, "r")
    head = content[:20].tobytes()
    if len(head) < 20 or head[:4] != b"glTF":
        raise ValueError(f"{path} is no .glb")
    length = struct.unpack("<I", head[12:16])[0]
    document = json.loads(content[20:20 + length].tobytes())
    binary = content[28 + length:]

    def array(number):
        accessor = document["accessors"][number]
        view = document["bufferViews"][accessor["bufferView"]]
        kind, columns = np.dtype(TYPES[accessor["componentType"]]), COMPONENTS[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        count = accessor["count"]
        stride = view.get("byteStride", kind.itemsize * columns)
        rows = np.ndarray((count, columns), kind, binary, start, (stride, kind.itemsize))
        return rows[:, 0] if columns == 1 else rows

    species = []
    for mesh in document.get("meshes", []):
        part = mesh["primitives"][0]
        surface = document["materials"][part["material"]]["pbrMetallicRoughness"]
        colors = array(part["attributes"]["COLOR_0"])[:, :3] * np.asarray(surface["baseColorFactor"][:3])
        species.append((mesh["name"], array(part["attributes"]["POSITION"]), array(part["indices"]).reshape(-1, 3), colors))

    nodes = document["nodes"]
    root = nodes[document["scenes"][0]["nodes"][0]]
    names = ("TRANSLATION", "ROTATION", "SCALE", "_HEIGHT", "_WIDTH", "_STIFFNESS", "_EXPOSURE", "_TINT")
    rows = {name: [] for name in (*names, "species")}
    for number in root.get("children", []):
        node = nodes[number]
        instancing = node.get("extensions", {}).get("EXT_mesh_gpu_instancing")
        if instancing is None:
            continue
        for name in names:
            rows[name].append(array(instancing["attributes"][name]))
        rows["TRANSLATION"][-1] = rows["TRANSLATION"][-1] + np.asarray(node.get("translation", (0, 0, 0)))
        rows["species"].append(np.full(len(rows["TRANSLATION"][-1]), node["mesh"], "<i4"))
    columns = {name: np.concatenate(parts) if parts else np.zeros((0,)) for name, parts in rows.items()}
    return Blades(np.asarray(root.get("translation", (0, 0, 0)), float), columns, species)
