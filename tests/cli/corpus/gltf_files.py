"""glTF files of the corpus: accessors, primitives and nodes in every form."""

import base64
import json
import struct

import numpy as np

from shapes import grid, grid_triangles, rotate, turned

SIGNED = {5120: 127, 5122: 32767}
FULL = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}
KINDS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


class GltfFile:
    def __init__(self, chance):
        self.chance, self.binary, self.views, self.accessors = chance, bytearray(), [], []
        self.used, self.meshes, self.nodes, self.materials, self.colored = set(), [], [], [], chance.random() < 0.5
        self.skins = []

    def view(self, data, **more):
        self.binary += b"\0" * (-len(self.binary) % 8)
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **more})
        self.binary += data
        return len(self.views) - 1

    def accessor(self, array, component, kind, view=None, offset=0, normalized=False, sparse=False, bounds=False):
        """Adds an accessor of an n×m array, whole or as differences from zeros or from other numbers."""
        stored = np.ascontiguousarray(array, KINDS[component])
        entry = {"componentType": component, "count": len(stored), "type": kind}
        if normalized:
            entry["normalized"] = True
        if bounds:
            entry["min"], entry["max"] = ([float(v) for v in f(stored.astype(float), axis=0)] for f in (np.min, np.max))
        if view is not None:
            entry.update(bufferView=view, byteOffset=offset)
        elif sparse:
            base = np.zeros_like(stored)
            if self.chance.random() < 0.5:
                keep = np.array([self.chance.random() < 0.7 for _ in range(len(stored))])
                base[keep] = stored[keep]
                entry["bufferView"] = self.padded(base, component)
            where = np.flatnonzero((base != stored).any(axis=1))
            if len(where) == 0:
                where = np.array([0])
            index = self.chance.choice((5121, 5123, 5125) if len(stored) < 256 else (5123, 5125))
            entry["sparse"] = {"count": len(where),
                               "indices": {"bufferView": self.view(where.astype(KINDS[index]).tobytes()), "componentType": index},
                               "values": {"bufferView": self.view(stored[where].tobytes())}}
        else:
            entry["bufferView"] = self.padded(stored, component)
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def padded(self, stored, component):
        """A view of vertices, whose elements begin at multiples of four bytes."""
        size = stored.dtype.itemsize * stored.shape[1]
        if size % 4 == 0 or stored.shape[1] == 1:
            return self.view(stored.tobytes())
        stride = size + -size % 4
        rows = np.zeros((len(stored), stride), np.uint8)
        rows[:, :size] = np.ascontiguousarray(stored).view(np.uint8).reshape(len(stored), size)
        return self.view(rows.tobytes(), byteStride=stride)

    def interleaved(self, first, second):
        """Two float arrays in one view, and a gap: their accessors' views and offsets."""
        rows = np.column_stack([first, second, np.zeros((len(first), 1))]).astype("<f4")
        return self.view(rows.tobytes(), byteStride=4 * rows.shape[1]), 4 * first.shape[1]

    def mesh(self, joints=0):
        """A mesh that follows so many joints, in its pose at rest by weights of its own, its node's or none."""
        targets = self.chance.choice((0, 0, 0, 1, 2))
        primitives = [self.primitive(joints, targets) for _ in range(self.chance.choice((1, 1, 2, 3)))]
        if self.chance.random() < 0.15:
            primitives.append({"attributes": {}})  # nothing to show
        if self.chance.random() < 0.15:
            spots = np.array([[0, 0, 0], [1, 1, 1]])
            primitives.append({"attributes": {"POSITION": self.accessor(spots, 5126, "VEC3", bounds=True)},
                               "mode": self.chance.choice((0, 1, 2, 3))})
        self.meshes.append({"primitives": primitives})
        if targets and self.chance.random() < 0.8:
            self.meshes[-1]["weights"] = self.weights(targets)
        return len(self.meshes) - 1, targets

    def weights(self, targets):
        return [round(self.chance.choice((0.0, 1.0, self.chance.uniform(-0.5, 1.5))), 3) for _ in range(targets)]

    def add_targets(self, result, count, targets):
        """Differences of places and colours, whole or sparse."""
        result["targets"] = []
        for _ in range(targets):
            target = {}
            if self.chance.random() < 0.8:
                moves = np.array([[self.chance.uniform(-0.5, 0.5) for _ in range(3)] for _ in range(count)])
                moves[[self.chance.random() < 0.5 for _ in range(count)]] = 0
                target["POSITION"] = self.accessor(moves, 5126, "VEC3", sparse=self.chance.random() < 0.5, bounds=True)
            if "COLOR_0" in result["attributes"] and self.chance.random() < 0.5:
                target["COLOR_0"] = self.accessor(np.full((count, 3), -0.2), 5126, "VEC3")
            result["targets"].append(target)

    def add_influences(self, result, count, joints):
        """Each vertex follows one to four joints, in one set or two."""
        for part in range(self.chance.choice((1, 1, 2))):
            kind = self.chance.choice((5121, 5123, 5126))
            numbers = np.array([[self.chance.randrange(joints) for _ in range(4)] for _ in range(count)])
            shares = np.array([[self.chance.random() if self.chance.random() < 0.6 else 0.0 for _ in range(4)] for _ in range(count)])
            shares[:, 0] += 0.1
            shares /= shares.sum(axis=1)[:, None]
            result["attributes"][f"JOINTS_{part}"] = self.accessor(numbers, self.chance.choice((5121, 5123)), "VEC4")
            result["attributes"][f"WEIGHTS_{part}"] = self.accessor(
                shares if kind == 5126 else np.round(shares * FULL[kind]), kind, "VEC4", normalized=kind != 5126)

    def skin(self, node):
        """Joints below a node, one below another, and as a rule the inverse of a pose in which they were bound."""
        chance = self.chance
        joints, above = [], node
        for i in range(chance.randint(1, 4)):
            self.nodes.append({"translation": [chance.uniform(-2, 2) for _ in range(3)],
                               "rotation": [float(v) for v in turned(chance)],
                               "scale": [chance.choice((1, 1, 1, -1)) * chance.uniform(0.5, 1.5) for _ in range(3)]})
            joints.append(len(self.nodes) - 1)
            above.setdefault("children", []).append(joints[-1])
            above = chance.choice((node, self.nodes[-1]))
        skin = {"joints": joints}
        if chance.random() < 0.8:
            binds = np.zeros((len(joints), 4, 4))
            binds[:] = np.eye(4)
            for bind in binds:
                bind[:3, :3] = rotate(turned(chance), np.eye(3)).T * chance.uniform(0.5, 2.0)
                bind[:3, 3] = [chance.uniform(-3, 3) for _ in range(3)]
            skin["inverseBindMatrices"] = self.accessor(binds.transpose(0, 2, 1).reshape(-1, 16), 5126, "MAT4")
        self.skins.append(skin)
        return len(self.skins) - 1, len(joints)

    def primitive(self, joints=0, targets=0):
        """A field, strip or fan; each lies elsewhere, so that none covers another."""
        chance = self.chance
        mode = chance.choice((4, 4, 5, 6))
        columns, rows = chance.randint(2, 7), chance.randint(2, 7)
        if mode == 6:
            count = chance.randint(3, 9)
            angles = np.sort([chance.uniform(0, 6.2) for _ in range(count)]) + 0.01 * np.arange(count)
            points = np.vstack([[0, 0, 0], np.column_stack([np.cos(angles), 0.1 * angles, np.sin(angles)])])
            order = list(range(len(points)))
        else:
            points = grid(chance, columns, rows)
            order = [i for t in grid_triangles(columns, rows) for i in t]
            if mode == 5:
                order = []
                for j in range(rows - 1):
                    line = [i for c in range(columns) for i in (j * columns + c, (j + 1) * columns + c)]
                    order += ([order[-1], line[0]] if order else []) + line
        points = points + np.array([0, 30.0 * len(self.accessors), 0])
        result = {"attributes": {}}
        if mode != 4 or chance.random() < 0.3:
            result["mode"] = mode
        if chance.random() < 0.25:
            points, order = points[order], None
        self.add_points(result, points)
        if joints:
            self.add_influences(result, len(points), joints)
        if targets:
            self.add_targets(result, len(points), targets)
        if order is not None:
            kind = chance.choice([k for k in (5121, 5123, 5125) if len(points) < FULL.get(k, 1 << 30)])
            result["indices"] = self.accessor(np.array(order)[:, None], kind, "SCALAR", sparse=chance.random() < 0.15)
        if not self.colored and chance.random() < 0.8 or self.colored and chance.random() < 0.4:
            factor = [round(chance.uniform(0.1, 0.9), 3), round(chance.uniform(0.0, 0.05), 3), round(chance.uniform(0.1, 0.9), 3), 1]
            self.materials.append({"pbrMetallicRoughness": {"baseColorFactor": factor}})
            result["material"] = len(self.materials) - 1
        return result

    def add_points(self, result, points):
        chance = self.chance
        colors = np.array([[chance.random() for _ in range(3)] + [1.0] for _ in points])
        form = chance.choice(("plain", "plain", "sparse", "interleaved", "quantised"))
        if form == "interleaved":
            view, offset = self.interleaved(points, colors)
            result["attributes"]["POSITION"] = self.accessor(points, 5126, "VEC3", view=view, bounds=True)
            if self.colored:
                result["attributes"]["COLOR_0"] = self.accessor(colors, 5126, "VEC4", view=view, offset=offset)
            return
        if form == "quantised":
            # Whole numbers of another scale are another shape, which is as good.
            component = chance.choice((5120, 5121, 5122, 5123))
            points = points - points.min(axis=0)
            points = np.round(points / points.max() * min(FULL[component], 4000))
            if component in SIGNED:
                points -= np.round(points.max() / 3)
            self.used.add("KHR_mesh_quantization")
            result["attributes"]["POSITION"] = self.accessor(points, component, "VEC3", bounds=True,
                                                             normalized=component in (5120, 5121) and chance.random() < 0.5)
        else:
            result["attributes"]["POSITION"] = self.accessor(points, 5126, "VEC3", sparse=form == "sparse", bounds=True)
        if self.colored:
            width = chance.choice((3, 4))
            component = chance.choice((5121, 5123, 5126))
            stored = colors[:, :width] * (1 if component == 5126 else FULL[component])
            result["attributes"]["COLOR_0"] = self.accessor(stored if component == 5126 else np.round(stored), component,
                                                            f"VEC{width}", normalized=component != 5126)

    def node(self, place, depth=0):
        chance = self.chance
        node = {}
        if chance.random() < 0.3:
            q, s = turned(chance), [chance.uniform(0.4, 2.0) for _ in range(3)]
            matrix = np.eye(4)
            matrix[:3, :3] = rotate(q, np.eye(3)).T * s
            matrix[:3, 3] = place
            node["matrix"] = [float(v) for v in matrix.T.ravel()]
        else:
            node["translation"] = [float(v) for v in place]
            if chance.random() < 0.5:
                node["rotation"] = [float(v) for v in turned(chance)]
            if chance.random() < 0.5:
                node["scale"] = [chance.choice((1, 1, -1)) * chance.uniform(0.4, 2.0) for _ in range(3)]
        extensions = {}
        if depth == 0 or chance.random() < 0.7:
            joints = 0
            if chance.random() < 0.2:
                node["skin"], joints = self.skin(node)
            node["mesh"], targets = self.mesh(joints)
            if targets and chance.random() < 0.4:
                node["weights"] = self.weights(targets)
            if not joints and chance.random() < 0.25:
                extensions["EXT_mesh_gpu_instancing"] = {"attributes": self.instances()}
        if depth > 0 and chance.random() < 0.15:
            extensions["KHR_node_visibility"] = {"visible": chance.random() < 0.3}
        if extensions:
            node["extensions"] = extensions
            self.used |= set(extensions)
        if depth < 2:
            below = [self.node(np.array([300.0 * (1 + i), 0, 50.0]), depth + 1) for i in range(chance.choice((0, 0, 1, 2)))]
            if below:
                node["children"] = node.get("children", []) + below
        self.nodes.append(node)
        return len(self.nodes) - 1

    def instances(self):
        chance = self.chance
        count = chance.randint(1, 4)
        attributes = {}
        if chance.random() < 0.8:
            attributes["TRANSLATION"] = self.accessor(np.array([[100.0 * i, 3.0, chance.uniform(-5, 5)] for i in range(count)]), 5126, "VEC3")
            if chance.random() < 0.6:
                kind = chance.choice((5120, 5122, 5126))
                turns = np.array([turned(chance) for _ in range(count)])
                attributes["ROTATION"] = self.accessor(turns if kind == 5126 else np.round(turns * FULL[kind]), kind, "VEC4",
                                                       normalized=kind != 5126)
            if chance.random() < 0.6:
                attributes["SCALE"] = self.accessor(np.array([[chance.uniform(0.5, 2)] * 3 for _ in range(count)]), 5126, "VEC3")
        if not attributes or chance.random() < 0.2:
            attributes["_ID"] = self.accessor(np.arange(count)[:, None], 5126, "SCALAR")
        return attributes


def write_gltf(folder, name, chance):
    file = GltfFile(chance)
    roots = [file.node(np.array([2000.0 * i, 0.0, 0.0])) for i in range(chance.choice((1, 1, 2)))]
    lost = [file.node(np.zeros(3), 2)] if chance.random() < 0.2 else []  # in no scene that is shown
    form = chance.choice(("glb", "glb", "data", "file"))
    buffer = {"byteLength": len(file.binary)}
    if form == "data":
        buffer["uri"] = "data:application/octet-stream;base64," + base64.b64encode(file.binary).decode()
    elif form == "file":
        buffer["uri"] = f"{name}.bin"
        (folder / buffer["uri"]).write_bytes(file.binary)
    scenes = [{"nodes": lost}, {"nodes": roots}] if lost else [{"nodes": roots}]
    document = {"asset": {"version": "2.0"}, "scene": len(scenes) - 1, "scenes": scenes, "nodes": file.nodes, "meshes": file.meshes,
                "accessors": file.accessors, "bufferViews": file.views, "buffers": [buffer]}
    if file.materials:
        document["materials"] = file.materials
    if file.skins:
        document["skins"] = file.skins
    if file.used:
        document["extensionsUsed"] = sorted(file.used)
    if required := sorted(file.used & {"KHR_mesh_quantization"}):
        document["extensionsRequired"] = required
    text = json.dumps(document)
    if chance.random() < 0.2:
        text = text.replace('"componentType": 5126,', '"componentType": 5126.0,')
    data = text.encode()
    if form == "glb":
        data += b" " * (-len(data) % 4)
        file.binary += b"\0" * (-len(file.binary) % 4)
        data = (struct.pack("<4sIIII", b"glTF", 2, 28 + len(data) + len(file.binary), len(data), 0x4E4F534A) + data
                + struct.pack("<II", len(file.binary), 0x004E4942) + file.binary)
    elif chance.random() < 0.2:
        data = b"\xef\xbb\xbf" + data
    path = folder / (f"{name}.glb" if form == "glb" else f"{name}.gltf")
    path.write_bytes(data)
    return path.name, {}
