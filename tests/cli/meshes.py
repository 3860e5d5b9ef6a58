"""Meshes made in the test, written as the formats a user brings."""

import base64
import json
import math
import struct
import zlib


class Mesh:
    """Corners and triangles; colours, if any, one RGBA in [0, 1] for each corner."""

    def __init__(self, positions, triangles, colors=None):
        self.positions = [tuple(map(float, p)) for p in positions]
        self.triangles = [tuple(t) for t in triangles]
        self.colors = colors

    def area(self, index):
        a, b, c = (self.positions[i] for i in self.triangles[index])
        return 0.5 * length(cross(subtract(b, a), subtract(c, a)))

    def moved(self, matrix):
        """Turned by a 3×3 matrix given as rows."""
        return Mesh([apply(matrix, p) for p in self.positions], self.triangles, self.colors)


def square(side, cells=8, color_of=None):
    """A level square around the origin that faces up; `color_of(x, z)` gives its corners' colours."""
    step = side / cells
    points = [(x * step - side / 2, 0.0, z * step - side / 2)
              for z in range(cells + 1) for x in range(cells + 1)]
    triangles = []
    for z in range(cells):
        for x in range(cells):
            a = z * (cells + 1) + x
            b, c, d = a + 1, a + cells + 1, a + cells + 2
            triangles += [(a, c, b), (b, c, d)]
    return Mesh(points, triangles, color_of and [color_of(p[0], p[2]) for p in points])


def bumps(side=12.0, cells=24):
    """A square with hills and dales, without any symmetry."""
    mesh = square(side, cells)
    mesh.positions = [(x, 1.1 * math.sin(0.9 * x + 0.3) * math.cos(0.7 * z - 0.2) + 0.15 * x, z)
                      for x, _, z in mesh.positions]
    return mesh


def glb_bytes(mesh, node=None, document=None):
    """A binary glTF of one node; `node` and `document` override entries of the JSON."""
    corners = b"".join(struct.pack("<3f", *p) for p in mesh.positions)
    indices = b"".join(struct.pack("<3I", *t) for t in mesh.triangles)
    colors = b"".join(struct.pack("<4f", *c) for c in mesh.colors or [])
    parts = [corners, indices, colors]
    offsets = [0, len(corners), len(corners) + len(indices)]
    binary = b"".join(parts)
    # JSON has no NaN; a bound that is none is left at zero, as a careless exporter does.
    finite = [p for p in mesh.positions if all(map(math.isfinite, p))] or [(0.0, 0.0, 0.0)]
    attributes = {"POSITION": 0}
    accessors = [
        {"bufferView": 0, "componentType": 5126, "count": len(mesh.positions), "type": "VEC3",
         "min": [min(p[i] for p in finite) for i in range(3)],
         "max": [max(p[i] for p in finite) for i in range(3)]},
        {"bufferView": 1, "componentType": 5125, "count": 3 * len(mesh.triangles),
         "type": "SCALAR"},
    ]
    if mesh.colors:
        attributes["COLOR_0"] = 2
        accessors.append({"bufferView": 2, "componentType": 5126, "count": len(mesh.colors),
                          "type": "VEC4"})
    primitive = {"attributes": attributes}
    if mesh.triangles:
        primitive["indices"] = 1
    else:
        del accessors[1]
    text = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "ground", **(node or {})}],
        "meshes": [{"primitives": [primitive]}],
        "accessors": accessors,
        "bufferViews": [{"buffer": 0, "byteOffset": offset, "byteLength": len(part)}
                        for part, offset in zip(parts, offsets) if part],
        "buffers": [{"byteLength": len(binary)}],
        **(document or {}),
    }
    return container(json.dumps(text).encode(), binary)


def container(text, binary):
    """JSON and binary as the two chunks of a .glb."""
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    body = struct.pack("<II", len(text), 0x4E4F534A) + text
    body += struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def grey_png(width, height, samples):
    """A 16-bit greyscale PNG, samples row by row."""
    return png(width, height, 16, 0, struct.pack(f">{width * height}H", *samples))


def color_png(width, height, pixels):
    """An 8-bit RGB PNG of 3·width·height bytes."""
    return png(width, height, 8, 2, pixels)


def png(width, height, depth, kind, pixels):
    def chunk(name, content):
        body = name + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))

    stride = len(pixels) // height
    rows = b"".join(b"\0" + pixels[j * stride:(j + 1) * stride] for j in range(height))
    return (b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def textured_gltf(mesh, uvs, image, sampler=None):
    """A .gltf of one node whose material has the image of this URI as base colour."""
    parts = [b"".join(struct.pack("<3f", *p) for p in mesh.positions),
             b"".join(struct.pack("<2f", *uv) for uv in uvs),
             b"".join(struct.pack("<3I", *t) for t in mesh.triangles)]
    binary = b"".join(parts)
    offsets = [sum(map(len, parts[:i])) for i in range(3)]
    return json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "ground"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2,
                                    "material": 0}]}],
        "materials": [{"name": "painted", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [sampler or {}],
        "images": [{"uri": image}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(mesh.positions), "type": "VEC3",
             "min": [min(p[i] for p in mesh.positions) for i in range(3)],
             "max": [max(p[i] for p in mesh.positions) for i in range(3)]},
            {"bufferView": 1, "componentType": 5126, "count": len(uvs), "type": "VEC2"},
            {"bufferView": 2, "componentType": 5125, "count": 3 * len(mesh.triangles), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": offset, "byteLength": len(part)}
                        for offset, part in zip(offsets, parts)],
        "buffers": [{"byteLength": len(binary),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(binary).decode()}],
    })


def blender_glb(mesh, uvs):
    """A .glb laid out as Blender 3.4 exports a landscape with a colour attribute: COLOR_0, POSITION,
    TEXCOORD_0 and NORMAL in floats, short indices, a two-sided material without an image."""
    count = len(mesh.positions)
    parts = [b"".join(struct.pack("<4f", *c) for c in mesh.colors),
             b"".join(struct.pack("<3f", *p) for p in mesh.positions),
             b"".join(struct.pack("<2f", *uv) for uv in uvs),
             b"".join(struct.pack("<3f", 0.0, 1.0, 0.0) for _ in mesh.positions),
             b"".join(struct.pack("<3H", *t) for t in mesh.triangles)]
    parts[4] += b"\0" * (-len(parts[4]) % 4)
    bounds = {"min": [min(p[i] for p in mesh.positions) for i in range(3)],
              "max": [max(p[i] for p in mesh.positions) for i in range(3)]}
    floats = {"componentType": 5126, "count": count}
    text = {
        "asset": {"generator": "Khronos glTF Blender I/O v3.4.50", "version": "2.0"},
        "scene": 0,
        "scenes": [{"name": "Scene", "nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "Landscape"}],
        "materials": [{"doubleSided": True, "name": "earth", "pbrMetallicRoughness": {
            "baseColorFactor": [0.16, 0.1, 0.06, 1], "metallicFactor": 0, "roughnessFactor": 0.95}}],
        "meshes": [{"name": "Landscape", "primitives": [{"attributes": {
            "COLOR_0": 0, "POSITION": 1, "TEXCOORD_0": 2, "NORMAL": 3}, "indices": 4, "material": 0}]}],
        "accessors": [{"bufferView": 0, "type": "VEC4", **floats},
                      {"bufferView": 1, "type": "VEC3", **floats, **bounds},
                      {"bufferView": 2, "type": "VEC2", **floats},
                      {"bufferView": 3, "type": "VEC3", **floats},
                      {"bufferView": 4, "componentType": 5123, "count": 3 * len(mesh.triangles),
                       "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": sum(map(len, parts[:i])), "byteLength": len(part),
                         "target": 34963 if i == 4 else 34962} for i, part in enumerate(parts)],
        "buffers": [{"byteLength": sum(map(len, parts))}],
    }
    return container(json.dumps(text).encode(), b"".join(parts))


def obj_text(mesh):
    lines = ["v {:.9g} {:.9g} {:.9g}".format(*p) for p in mesh.positions]
    lines += ["f {} {} {}".format(*(i + 1 for i in t)) for t in mesh.triangles]
    return "\n".join(lines) + "\n"


def stl_bytes(mesh):
    """A binary STL."""
    facets = b"".join(struct.pack("<12fH", 0, 0, 0, *(c for i in t for c in mesh.positions[i]), 0)
                      for t in mesh.triangles)
    return b" " * 80 + struct.pack("<I", len(mesh.triangles)) + facets


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return tuple(x / length(a) for x in a)


def apply(matrix, point):
    return tuple(dot(row, point) for row in matrix)


def rotation(axis, angle):
    """Rows of the rotation by `angle` [rad] about `axis` (Rodrigues), and the same as quaternion x, y, z, w."""
    x, y, z = unit(axis)
    c, s = math.cos(angle), math.sin(angle)
    rows = [[c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s],
            [y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s],
            [z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)]]
    half = math.sin(angle / 2)
    return rows, [x * half, y * half, z * half, math.cos(angle / 2)]
