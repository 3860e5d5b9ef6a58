"""Reads the instances of a .glb and checks the rules of EXT_mesh_gpu_instancing, which Khronos'
validator does not know. Written from the two specifications, without a look at the exporter."""

import json
import struct

import numpy

EXTENSION = "EXT_mesh_gpu_instancing"

COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
UNSIGNED_INT, FLOAT = 5125, 5126
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

# What the extension says about its own attributes: type, and component types with normalisation.
KNOWN = {
    "TRANSLATION": ("VEC3", {(FLOAT, False)}),
    "ROTATION": ("VEC4", {(FLOAT, False), (5120, True), (5122, True)}),
    "SCALE": ("VEC3", {(FLOAT, False)}),
}


class Glb:
    """The two chunks of a binary glTF."""

    def __init__(self, content):
        magic, version, total = struct.unpack_from("<4sII", content)
        if (magic, version, total) != (b"glTF", 2, len(content)):
            raise ValueError(f"header {magic} {version} {total} of {len(content)} bytes")
        chunks, at = [], 12
        while at < len(content):
            size, kind = struct.unpack_from("<II", content, at)
            if size % 4 != 0 or at + 8 + size > len(content):
                raise ValueError(f"a chunk of {size} bytes at {at}")
            chunks.append((kind, content[at + 8:at + 8 + size]))
            at += 8 + size
        if [kind for kind, _ in chunks] != [0x4E4F534A, 0x004E4942]:
            raise ValueError(f"chunks {[hex(kind) for kind, _ in chunks]}")
        self.json = json.loads(chunks[0][1])
        self.binary = chunks[1][1]

    @classmethod
    def read(cls, path):
        return cls(path.read_bytes())

    def raw(self, index):
        """The numbers of an accessor as they are stored, a row for each element."""
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind = numpy.dtype(COMPONENTS[accessor["componentType"]])
        width = WIDTHS[accessor["type"]]
        inside = accessor.get("byteOffset", 0)
        first = view.get("byteOffset", 0) + inside
        size = accessor["count"] * width * kind.itemsize
        if "byteStride" in view or inside + size > view["byteLength"]:
            raise ValueError(f"accessor {index} does not fit into its buffer view")
        if first % kind.itemsize != 0 or first + size > len(self.binary):
            raise ValueError(f"accessor {index} begins or ends at the wrong byte")
        return numpy.frombuffer(self.binary, kind, accessor["count"] * width, first).reshape(-1, width)

    def numbers(self, index):
        """The same as they are meant: normalised integers as fractions."""
        values = self.raw(index).astype(numpy.float64)
        accessor = self.json["accessors"][index]
        if accessor.get("normalized", False):
            largest = numpy.iinfo(COMPONENTS[accessor["componentType"]]).max
            values = numpy.maximum(values / largest, -1.0)
        return values

    def instanced_nodes(self):
        """Each node with instances, with the places of its attributes' accessors."""
        for node in self.json.get("nodes", []):
            if EXTENSION in node.get("extensions", {}):
                yield node, node["extensions"][EXTENSION]["attributes"]


def complaints(glb):
    """What breaks a rule of the extension, of the accessors it uses, or of the meshes it shows."""
    found = []
    try:
        nodes = list(glb.instanced_nodes())
    except KeyError:
        return ["a node's extension has no attributes"]
    for name in ("extensionsUsed", "extensionsRequired"):
        if nodes and EXTENSION not in glb.json.get(name, []):
            found.append(f"{name} does not name the extension")
        if name in glb.json and not glb.json[name]:
            found.append(f"{name} is empty")
    if glb.json["buffers"][0]["byteLength"] > len(glb.binary):
        found.append("the buffer is longer than the binary chunk")
    for node, attributes in nodes:
        name = node.get("name", "?")
        found += [f"{name}: {text}" for text in node_complaints(glb, node, attributes)]
    return found


def node_complaints(glb, node, attributes):
    if not 0 <= node.get("mesh", -1) < len(glb.json.get("meshes", [])):
        yield "has no mesh"
    else:
        yield from mesh_complaints(glb, glb.json["meshes"][node["mesh"]])
    if not attributes:
        yield "has no attributes"
    counts = {}
    for name, index in attributes.items():
        if not 0 <= index < len(glb.json["accessors"]):
            yield f"{name} has no accessor"
            continue
        counts[name] = glb.json["accessors"][index]["count"]
        yield from attribute_complaints(glb, name, index)
    if len(set(counts.values())) > 1:
        yield f"counts differ: {counts}"


def attribute_complaints(glb, name, index):
    accessor = glb.json["accessors"][index]
    component, normalized = accessor["componentType"], accessor.get("normalized", False)
    if name in KNOWN:
        kind, components = KNOWN[name]
        if accessor["type"] != kind or (component, normalized) not in components:
            yield f"{name} is a {accessor['type']} of {component}"
            return
    elif not name.startswith("_"):
        yield f"{name} does not begin with an underscore"
    elif component == UNSIGNED_INT:
        yield f"{name} has unsigned integers of 32 bits"
    elif WIDTHS[accessor["type"]] * numpy.dtype(COMPONENTS[component]).itemsize % 4 != 0:
        yield f"elements of {name} are not aligned to four bytes"
    try:
        values = glb.numbers(index)
    except ValueError as error:
        yield f"{name}: {error}"
        return
    yield from bounds_complaints(glb, name, index)
    if accessor["count"] < 1:
        yield f"{name} is empty"
    elif not numpy.isfinite(values).all():
        yield f"{name} has numbers that are not finite"
    elif name == "ROTATION":
        longest = numpy.abs(numpy.linalg.norm(values, axis=1) - 1.0).max()
        if longest > (1e-5 if component == FLOAT else 1e-2):
            yield f"ROTATION is not a unit quaternion: off by {longest}"
    elif name == "SCALE" and (values <= 0.0).any():
        yield "SCALE is not positive"


def mesh_complaints(glb, mesh):
    for primitive in mesh["primitives"]:
        index = primitive["attributes"].get("POSITION")
        if index is None:
            yield "a primitive has no POSITION"
            continue
        accessor = glb.json["accessors"][index]
        if "min" not in accessor or "max" not in accessor:
            yield "POSITION has no min and max"
        yield from bounds_complaints(glb, "POSITION", index)
        if "indices" in primitive and glb.raw(primitive["indices"]).max() >= accessor["count"]:
            yield "an index has no vertex"


def bounds_complaints(glb, name, index):
    accessor = glb.json["accessors"][index]
    values = glb.raw(index)
    for bound, extreme in (("min", values.min(axis=0)), ("max", values.max(axis=0))):
        if bound in accessor and not numpy.array_equal(
                numpy.array(accessor[bound], numpy.float32), extreme.astype(numpy.float32)):
            yield f"{bound} of {name} is {accessor[bound]}, not {extreme}"


def instances(glb):
    """All instances in world space: id, place, quaternion x y z w, scale, and each further attribute
    by its name."""
    scene = glb.json["scenes"][glb.json["scene"]]
    (root,) = (glb.json["nodes"][i] for i in scene["nodes"])
    origin = numpy.array(root.get("translation", [0.0, 0.0, 0.0]), numpy.float64)
    below = [glb.json["nodes"][i] for i in root.get("children", [])]
    columns = {}
    for node, attributes in glb.instanced_nodes():
        if not any(node is child for child in below):
            raise ValueError("an instanced node is not a child of the root")
        numbers = {name: glb.numbers(index) for name, index in attributes.items()}
        words = glb.raw(attributes["_ROOT_ID"]).astype(numpy.uint64)
        numbers["id"] = sum(words[:, k:k + 1] << numpy.uint64(16 * k) for k in range(4))
        numbers["place"] = origin + numpy.array(node["translation"]) + numbers["TRANSLATION"]
        numbers["mesh"] = numpy.full((len(words), 1), node["mesh"])
        for name, values in numbers.items():
            columns.setdefault(name, []).append(values)
    return {name: numpy.concatenate(values) for name, values in columns.items()}
