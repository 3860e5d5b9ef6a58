"""A reader of ground files that shares no line with Sward: what each file's format and docs/any-ground.md
say, in NumPy. figures(path) gives triangles, area, and the means by area of the colour (linear) and of the tint
(its square root), which is how blades store it."""

import base64
import json
import struct
import zlib

import numpy as np

EARTH = np.array([0.085, 0.078, 0.036])  # ground without a colour


class Figures:
    """Sums over a ground."""

    def __init__(self):
        self.triangles, self.area, self.color, self.tint = 0, 0.0, np.zeros(3), np.zeros(3)

    def add_triangles(self, corners, colors):
        """n×3×3 corners and linear colours."""
        area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        self.triangles += len(corners)
        self.area += area.sum()
        self.color += area @ colors.mean(axis=1)
        # Mean of the root over each triangle, by a fine rule.
        n = 6
        shares = np.array([((3 * i + k) / (3 * n), (3 * j + k) / (3 * n)) for i in range(n) for j in range(n) for k in (1, 2)
                           if i + j < n and (k == 1 or i + j < n - 1)])
        weights = np.column_stack([1 - shares.sum(axis=1), shares])
        self.tint += area @ np.sqrt(np.clip(np.einsum("qc,tcx->tqx", weights, colors), 0, 1)).mean(axis=1)

    def add_polygon(self, corners, color):
        """A plane polygon of one colour, however it is cut."""
        turned = np.cross(corners - corners[0], np.roll(corners, -1, axis=0) - corners[0])
        area = 0.5 * np.linalg.norm(turned.sum(axis=0))
        self.triangles += len(corners) - 2
        self.area += area
        self.color += area * color
        self.tint += area * np.sqrt(color)

    def means(self):
        return {"triangles": self.triangles, "area": self.area, "color": self.color / self.area, "tint": self.tint / self.area}


def figures(path, **options):
    kind = path.suffix.lower()
    read = {".glb": gltf, ".gltf": gltf, ".obj": obj, ".ply": ply, ".off": off, ".stl": stl}.get(kind, heights)
    return read(path, **options).means()


def shares(colors):
    """Floats above 2 count to 255."""
    return colors / 255 if colors.size and colors.max() > 2 else colors


# glTF ---------------------------------------------------------------------------------------------

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
FULL = {"i1": 127, "u1": 255, "i2": 32767, "u2": 65535}


class Gltf:
    def __init__(self, path):
        data = path.read_bytes()
        binary = b""
        if data[:4] == b"glTF":
            at = 12
            while at < len(data):
                length, kind = struct.unpack_from("<II", data, at)
                body = data[at + 8:at + 8 + length]
                at += 8 + length
                if kind == 0x4E4F534A:
                    text = body
                elif kind == 0x004E4942:
                    binary = body
        else:
            text = data
        self.json = json.loads(text.decode("utf-8-sig"))
        self.buffers = []
        for buffer in self.json.get("buffers", []):
            uri = buffer.get("uri")
            self.buffers.append(binary if uri is None else base64.b64decode(uri.split(",", 1)[1]) if uri.startswith("data:")
                                else (path.parent / uri).read_bytes())

    def elements(self, view, offset, kind, count, width):
        """count×width numbers as stored."""
        view = self.json["bufferViews"][int(view)]
        at = int(view.get("byteOffset", 0)) + int(offset)
        kind = np.dtype(kind)
        stride = int(view.get("byteStride", kind.itemsize * width))
        raw = np.frombuffer(self.buffers[int(view["buffer"])], np.uint8)
        index = at + stride * np.arange(count)[:, None] + np.arange(kind.itemsize * width)
        return raw[index].copy().view(kind).reshape(count, width)

    def accessor(self, index):
        """Numbers of an accessor: sparse ones in place, normalised ones divided."""
        accessor = self.json["accessors"][int(index)]
        kind, width, count = TYPES[int(accessor["componentType"])], WIDTHS[accessor["type"]], int(accessor["count"])
        if "bufferView" in accessor:
            values = self.elements(accessor["bufferView"], accessor.get("byteOffset", 0), kind, count, width)
        else:
            values = np.zeros((count, width), kind)
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            where = self.elements(sparse["indices"]["bufferView"], sparse["indices"].get("byteOffset", 0),
                                  TYPES[int(sparse["indices"]["componentType"])], int(sparse["count"]), 1)[:, 0]
            values[where] = self.elements(sparse["values"]["bufferView"], sparse["values"].get("byteOffset", 0), kind,
                                          int(sparse["count"]), width)
        if accessor.get("normalized"):
            return np.maximum(values / FULL[kind[1:]], -1.0)
        return values.astype(float) if kind != "<u4" else values


def turn_of(quaternion):
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def placement(translation, rotation, scale):
    matrix = np.eye(4)
    matrix[:3, :3] = turn_of(np.asarray(rotation, float)) * np.asarray(scale, float)
    matrix[:3, 3] = translation
    return matrix


def local(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    return placement(node.get("translation", (0, 0, 0)), node.get("rotation", (0, 0, 0, 1)), node.get("scale", (1, 1, 1)))


def triangles_of(mode, index):
    if mode == 4:
        return index[:len(index) // 3 * 3].reshape(-1, 3)
    first = np.arange(len(index) - 2)
    if mode == 5:
        odd = first % 2
        return np.column_stack([index[first], index[first + 1 + odd], index[first + 2 - odd]])
    return np.column_stack([index[first + 1], index[first + 2], np.full(len(first), index[0])])


def gltf(path):
    file = Gltf(path)
    parents = {child: number for number, node in enumerate(file.json["nodes"]) for child in node.get("children", ())}

    def world(number):
        own = local(file.json["nodes"][number])
        return world(parents[number]) @ own if number in parents else own

    def joints_of(node):
        """The matrices that move what a node's skin holds, joints×4×4."""
        skin = file.json["skins"][node["skin"]]
        places = np.array([world(joint) for joint in skin["joints"]])
        if "inverseBindMatrices" in skin:
            return places @ file.accessor(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)[:len(places)]
        return places

    scene = file.json["scenes"][int(file.json.get("scene", 0))]
    corners, colors = [], []

    def visit(number, parent):
        node = file.json["nodes"][int(number)]
        extensions = node.get("extensions", {})
        if not extensions.get("KHR_node_visibility", {}).get("visible", True):
            return
        matrix = parent @ local(node)
        if "mesh" in node:
            places = [np.eye(4)]
            if "EXT_mesh_gpu_instancing" in extensions:
                known = {key: file.accessor(value) for key, value in extensions["EXT_mesh_gpu_instancing"]["attributes"].items()}
                count = len(next(iter(known.values())))
                places = [placement(known["TRANSLATION"][i] if "TRANSLATION" in known else (0, 0, 0),
                                    known["ROTATION"][i] if "ROTATION" in known else (0, 0, 0, 1),
                                    known["SCALE"][i] if "SCALE" in known else (1, 1, 1)) for i in range(count)]
            for place in places:
                mesh = file.json["meshes"][int(node["mesh"])]
                weights = node.get("weights", mesh.get("weights", ()))
                for primitive in mesh["primitives"]:
                    add(primitive, matrix @ place, weights, joints_of(node) if "skin" in node else None)
        for child in node.get("children", ()):
            visit(child, matrix)

    def morphed(primitive, weights, name, values):
        for weight, target in zip(weights, primitive.get("targets", ())):
            if name in target:
                values = values + weight * file.accessor(target[name])
        return values

    def skinned(attributes, points, joints):
        total = np.zeros((len(points), 4, 4))
        for part in range(sum(name.startswith("JOINTS_") for name in attributes)):
            shares = file.accessor(attributes[f"WEIGHTS_{part}"])
            numbers = file.accessor(attributes[f"JOINTS_{part}"]).astype(int)
            total += np.einsum("vi,vijk->vjk", shares, joints[numbers])
        # The last element is the sum of the weights.
        total /= total[:, 3:, 3:]
        return np.einsum("vjk,vk->vj", total, np.column_stack([points, np.ones(len(points))]))[:, :3]

    def add(primitive, matrix, weights, joints):
        mode, attributes = int(primitive.get("mode", 4)), primitive["attributes"]
        if "POSITION" not in attributes or mode < 4:
            return
        points = morphed(primitive, weights, "POSITION", file.accessor(attributes["POSITION"]))
        if joints is None:
            points = points @ matrix[:3, :3].T + matrix[:3, 3]
        else:
            points = skinned(attributes, points, joints)
        index = file.accessor(primitive["indices"])[:, 0].astype(int) if "indices" in primitive else np.arange(len(points))
        index = triangles_of(mode, index)
        if joints is None and np.linalg.det(matrix[:3, :3]) < 0:
            index = index[:, ::-1]
        # A strip's stitches are no triangles. Their corners may be two vertices with other weights of one joint.
        a, b, c = (points[index[:, i]] for i in range(3))
        least = 1e-9 * np.abs(points).max()
        index = index[np.all([np.abs(one - other).max(axis=1) > least for one, other in ((a, b), (b, c), (c, a))], axis=0)]
        color = np.ones(3)
        if "material" in primitive:
            material = file.json["materials"][int(primitive["material"])]
            color = np.array(material.get("pbrMetallicRoughness", {}).get("baseColorFactor", (1, 1, 1, 1)), float)[:3]
        if "COLOR_0" in attributes:
            accessor = file.json["accessors"][int(attributes["COLOR_0"])]
            stored = file.accessor(attributes["COLOR_0"])[:, :3]
            # Whole numbers are shares of their type's largest, whatever the file says.
            if accessor["componentType"] != 5126 and not accessor.get("normalized"):
                stored = stored / FULL[TYPES[int(accessor["componentType"])][1:]]
            each = np.clip(shares(morphed(primitive, weights, "COLOR_0", stored)), 0, 1)[index] * color
        else:
            plain = color.max() >= 0.4 and color.max() - color.min() <= 0.02 * color.max()
            each = np.broadcast_to(EARTH if plain else color, (*index.shape, 3))
        corners.append(points[index])
        colors.append(each)

    for number in scene["nodes"]:
        visit(number, np.eye(4))
    corners, colors = np.concatenate(corners), np.concatenate(colors)
    # What lies twice at one place is counted once.
    seen, kept = set(), []
    for i, triangle in enumerate(np.round(corners, 4)):
        rows = [tuple(row) for row in triangle + 0.0]
        first = rows.index(min(rows))
        key = tuple(rows[first:] + rows[:first])
        if key not in seen:
            seen.add(key)
            kept.append(i)
    result = Figures()
    result.add_triangles(corners[kept], colors[kept])
    return result


# Polygons -----------------------------------------------------------------------------------------

def obj(path):
    text = path.read_bytes().decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n").replace("\\\n", " ")
    points, colors, faces, kd, material, materials = [], [], [], {}, None, []
    for line in text.split("\n"):
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(word) for word in words[1:4]])
            if len(words) >= 7:
                colors.append([float(word) for word in words[4:7]])
        elif words[0] == "f":
            numbers = [int(word.split("/")[0]) for word in words[1:]]
            faces.append([number - 1 if number > 0 else len(points) + number for number in numbers])
            materials.append(material)
        elif words[0] == "usemtl":
            material = words[1]
        elif words[0] == "mtllib":
            name = None
            for entry in (path.parent / words[1]).read_text(encoding="utf-8").split("\n"):
                entry = entry.split()
                if entry[:1] == ["newmtl"]:
                    name = entry[1]
                elif entry[:1] == ["Kd"]:
                    kd[name] = np.array(entry[1:4], float)
    points, colors = np.array(points), shares(np.array(colors))
    result = Figures()
    for face, name in zip(faces, materials):
        color = kd.get(name, np.ones(3) if len(colors) else EARTH)
        result.add_polygon(points[face], color * colors[face[0]] ** 2 if len(colors) else color)
    return result


PLY = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
       "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}


def ply(path):
    data = path.read_bytes()
    ending = b"\r\n" if data.startswith(b"ply\r\n") else b"\r" if data.startswith(b"ply\r") else b"\n"
    head, body = data.split(b"end_header" + ending, 1)
    form, elements = "", []
    for line in head.decode().strip().split(ending.decode()):
        words = line.split()
        if words[0] == "format":
            form = words[1]
        elif words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    order = ">" if form == "binary_big_endian" else "<"
    tokens, at = iter(body.split()) if form == "ascii" else None, 0

    def take(kind, count):
        nonlocal at
        if tokens is not None:
            return [float(next(tokens)) for _ in range(count)]
        values = np.frombuffer(body, order + PLY[kind], count, at)
        at += values.nbytes
        return values.astype(float).tolist()

    points, colors, kinds, faces, strips = [], [], [], [], []
    for name, count, properties in elements:
        for _ in range(count):
            row = {}
            for words in properties:
                if words[0] == "list":
                    row[words[3]] = [int(v) for v in take(words[2], int(take(words[1], 1)[0]))]
                else:
                    row[words[1]] = take(words[0], 1)[0]
            if name == "vertex":
                points.append([row["x"], row["y"], row["z"]])
                if "red" in row:
                    colors.append([row["red"], row["green"], row["blue"]])
            elif name in ("face", "tristrips"):
                (faces if name == "face" else strips).append(next(v for k, v in row.items() if k.startswith("vertex_ind")))
        if name == "vertex":
            kinds = [words[0] for words in properties if words[1] == "red"]
    points = np.array(points)
    colors = np.array(colors)
    if kinds:
        full = FULL.get(PLY[kinds[0]])
        colors = colors / full if full else shares(colors)
    for strip in strips:
        piece = []
        for index in [*strip, -1]:
            if index >= 0:
                piece.append(index)
                continue
            if len(piece) > 2:
                faces += [face for face in triangles_of(5, np.array(piece)).tolist() if len(set(face)) == 3]
            piece = []
    result = Figures()
    for face in faces:
        result.add_polygon(points[face], colors[face[0]] ** 2 if len(colors) else EARTH)
    return result


def off(path):
    text = path.read_bytes().decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    lines = [line.split("#")[0].split() for line in text.split("\n")]
    words = [line for line in lines if line]
    keyword, flat = words[0][0], words[0][1:]
    rest = words[1:]
    if not flat:
        flat, rest = rest[0], rest[1:]
    vertices, faces = int(flat[0]), int(flat[1])
    points = np.array([[float(word) for word in line[:3]] for line in rest[:vertices]])
    written = [line[3:6] for line in rest[:vertices]] if keyword == "COFF" else []
    whole = all(word.isdigit() for row in written for word in row)
    colors = np.array(written, float) / (255 if whole else 1) if written else None
    tokens = [word for line in rest[vertices:] for word in [*line, "\n"]]
    result, at = Figures(), 0
    for _ in range(faces):
        face, count = [], None
        while count is None or len(face) < count:
            if tokens[at] != "\n":
                if count is None:
                    count = int(tokens[at])
                else:
                    face.append(int(tokens[at]))
            at += 1
        while tokens[at] != "\n":
            at += 1
        at += 1
        result.add_polygon(points[face], EARTH if colors is None else colors[face[0]] ** 2)
    return result


def stl(path):
    data = path.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else -1
    if len(data) == 84 + 50 * count:
        rows = np.frombuffer(data, np.dtype([("f", "<f4", 12), ("a", "<u2")]), count, 84)["f"]
        corners = rows[:, 3:].reshape(-1, 3, 3).astype(float)
    else:
        words = data.decode().lower().split()
        corners = np.array([words[i + 1:i + 4] for i, word in enumerate(words) if word == "vertex"], float).reshape(-1, 3, 3)
    result = Figures()
    result.add_triangles(corners, np.broadcast_to(EARTH, corners.shape))
    return result


# Heights ------------------------------------------------------------------------------------------

def png(data):
    at, rows = 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        at += 12 + length
        if kind == b"IHDR":
            width, height = struct.unpack_from(">II", body)
        elif kind == b"IDAT":
            rows += body
    rows = zlib.decompress(rows)
    table = np.frombuffer(rows, np.uint8).reshape(height, 1 + 2 * width)
    assert not table[:, 0].any()  # the generator filters nothing
    return table[:, 1:].copy().view(">u2").astype(float)


def heights(path, size=None, extent=None, height=None, endian="little", no_data=None):
    data, kind = path.read_bytes(), path.suffix.lower()
    order = ">" if endian == "big" else "<"
    if kind == ".asc":
        head, words = {}, data.decode().split()
        while words[0][0].isalpha():
            head[words[0].lower()] = float(words[1])
            words = words[2:]
        grid = np.array(words, float).reshape(int(head["nrows"]), int(head["ncols"]))
        no_data = head.get("nodata_value", -9999.0)
        extent = extent or [head["cellsize"] * (n - 1) for n in grid.shape[::-1]]
    elif kind == ".hgt":
        side = int(round((len(data) / 2) ** 0.5))
        grid, no_data = np.frombuffer(data, ">i2").reshape(side, side).astype(float), -32768
    elif kind == ".r32":
        grid = np.frombuffer(data, order + "f4").reshape(size[::-1]).astype(float)
        no_data = -9999 if no_data is None else no_data
    elif kind in (".r16", ".raw"):
        grid = np.frombuffer(data, order + "u2").reshape(size[::-1]).astype(float)
    else:
        grid = png(data)
    grid = np.where(grid == no_data, np.nan, grid) if no_data is not None else grid
    if height is not None:
        grid = height[0] + (height[1] - height[0]) * grid / (1 if kind == ".r32" else 65535)
    z, x = (np.linspace(0, extent[1], grid.shape[0]), np.linspace(0, extent[0], grid.shape[1]))
    points = np.dstack([*np.meshgrid(x, z), grid])[:, :, [0, 2, 1]]
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, :-1], points[1:, 1:]
    corners = np.concatenate([np.stack(three, axis=2).reshape(-1, 3, 3) for three in ((a, c, b), (b, c, d))])
    corners = corners[~np.isnan(corners).any(axis=(1, 2))]
    result = Figures()
    result.add_triangles(corners, np.broadcast_to(EARTH, corners.shape))
    return result
