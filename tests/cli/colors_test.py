"""Colours: the same ones in any format and type give blades the same tint and masks the same numbers."""

import json
import struct
import unittest

from meshes import color_png, container, square, textured_gltf
from support import CliTest, INPUT

# The table of blades holds 5, 6 and 5 bits of a tint.
STEPS = (31.0, 63.0, 31.0)
COLORS = [(60, 90, 40), (255, 255, 255), (13, 200, 77), (128, 128, 128)]


def ply(mesh, color, kind, binary=False, names=("red", "green", "blue")):
    """A PLY whose vertices have this colour, [0, 1], as numbers of `kind`."""
    unit, letter = {"uchar": (255, "B"), "ushort": (65535, "H"), "float": (1.0, "f"),
                    "int": (255, "i"), "double": (255.0, "d")}[kind]
    numbers = [c * unit if isinstance(unit, float) else round(c * unit) for c in color]
    form = "binary_big_endian" if binary else "ascii"
    head = f"ply\nformat {form} 1.0\nelement vertex {len(mesh.positions)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz")
    head += "".join(f"property {kind} {name}\n" for name in names)
    head += f"element face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    if binary:
        body = b"".join(struct.pack(">3f3" + letter, *p, *numbers) for p in mesh.positions)
        body += b"".join(struct.pack(">B3i", 3, *t) for t in mesh.triangles)
        return head.encode() + body
    text = "".join("{} {} {} {} {} {}\n".format(*p, *numbers) for p in mesh.positions)
    return (head + text + "".join("3 {} {} {}\n".format(*t) for t in mesh.triangles)).encode()


def obj(mesh, color, unit):
    """An OBJ with this colour behind each vertex, in [0, unit]."""
    lines = ["v {} {} {} {} {} {}".format(*p, *(c * unit for c in color)) for p in mesh.positions]
    return "\n".join(lines + ["f {} {} {}".format(*(i + 1 for i in t)) for t in mesh.triangles]) + "\n"


def off(mesh, color, whole):
    numbers = [round(255 * c) for c in color] if whole else list(color)
    lines = ["COFF", f"{len(mesh.positions)} {len(mesh.triangles)} 0"]
    lines += ["{} {} {} {} {} {} {}".format(*p, *numbers, 255 if whole else 1.0)
              for p in mesh.positions]
    return "\n".join(lines + ["3 {} {} {}".format(*t) for t in mesh.triangles]) + "\n"


def glb(mesh, color):
    """A GLB with this linear COLOR_0 in floats."""
    parts = [b"".join(struct.pack("<3f", *p) for p in mesh.positions),
             b"".join(struct.pack("<3f", *color) for _ in mesh.positions),
             b"".join(struct.pack("<3I", *t) for t in mesh.triangles)]
    count = len(mesh.positions)
    bounds = {"min": [min(p[i] for p in mesh.positions) for i in range(3)],
              "max": [max(p[i] for p in mesh.positions) for i in range(3)]}
    return container(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}, "indices": 2}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3", **bounds},
                      {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC3"},
                      {"bufferView": 2, "componentType": 5125, "count": 3 * len(mesh.triangles),
                       "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": sum(map(len, parts[:i])), "byteLength": len(part)}
                        for i, part in enumerate(parts)],
        "buffers": [{"byteLength": sum(map(len, parts))}]}).encode(), b"".join(parts))


def files_of(mesh, color):
    """Files of all formats that say this sRGB colour of 8 bits per channel."""
    share = [c / 255 for c in color]
    image = "tint.png"
    return {
        image: color_png(1, 1, bytes(color)),
        "tex.gltf": textured_gltf(mesh, [(0.5, 0.5)] * len(mesh.positions), image).encode(),
        # Sward takes sRGB for a square.
        "linear.glb": glb(mesh, [s * s for s in share]),
        "shares.obj": obj(mesh, share, 1.0).encode(),
        "bytes.obj": obj(mesh, share, 255.0).encode(),
        "bytes.ply": ply(mesh, share, "uchar"),
        "words.ply": ply(mesh, share, "ushort", binary=True),
        "shares.ply": ply(mesh, share, "float", binary=True),
        "integers.ply": ply(mesh, share, "int"),
        "doubles.ply": ply(mesh, share, "double", binary=True),
        "diffuse.ply": ply(mesh, share, "uchar", binary=True,
                           names=("diffuse_red", "diffuse_green", "diffuse_blue")),
        "bytes.off": off(mesh, share, True).encode(),
        "shares.off": off(mesh, share, False).encode(),
    }


class Colors(CliTest):
    def write_all(self, color):
        names = []
        for name, content in files_of(square(4.0, 2), color).items():
            (self.folder / name).write_bytes(content)
            names += [] if name.endswith(".png") else [name]
        return names

    def test_tint_is_the_same_in_every_format(self):
        for color in COLORS:
            for name in self.write_all(color):
                with self.subTest(name=name, color=color):
                    blades = self.blades(self.bake(name, "--count", "40", "--force"))
                    for blade in blades:
                        for channel, steps, value in zip("rgb", STEPS, color):
                            got = float(blade.row[f"tint_{channel}"])
                            self.assertLessEqual(abs(got - value / 255), 0.5 / steps + 1 / 255)

    def test_masks_read_numbers_as_stored(self):
        for name in self.write_all((51, 90, 40)):
            if name in ("tex.gltf", "linear.glb"):
                continue
            with self.subTest(name=name):
                roots = self.report(name, "--density", "400", "--blade-scale", "1", "--mask",
                                    "vertex-color:R")["roots"]
                # A fifth of 6400, ±5 standard deviations.
                self.assertLess(abs(roots["kept"] / roots["proposed"] - 0.2), 0.025)

    def test_an_export_keeps_the_tint(self):
        (self.folder / "a.ply").write_bytes(ply(square(4.0, 2), (0.25, 0.5, 0.75), "float"))
        self.sward("terrain", "a.ply", "-o", "a.glb")
        tints = [[b.row[f"tint_{c}"] for c in "rgb"] for f in ("a.ply", "a.glb")
                 for b in self.blades(self.bake(f, "--count", "1", "--force"))]
        self.assertEqual(tints[0], tints[1])

    def test_colours_to_255_are_a_warning(self):
        (self.folder / "a.obj").write_text(obj(square(4.0, 2), (0.25, 0.5, 0.75), 255.0))
        warnings = self.report("a.obj", "--count", "10")["warnings"]
        self.assertTrue(any("divided by 255" in w for w in warnings), warnings)

    def test_texture_coordinates_of_ply_have_any_name(self):
        mesh = square(4.0, 2)
        # The left half of the image is white, and so is that of the ground.
        (self.folder / "left.png").write_bytes(color_png(2, 1, bytes([255] * 3 + [0] * 3)))
        uvs = [(p[0] / 4 + 0.5, p[2] / 4 + 0.5) for p in mesh.positions]
        for names in (("texture_u", "texture_v"), ("u", "v"), ("s", "t"), None):
            head = f"ply\nformat ascii 1.0\nelement vertex {len(mesh.positions)}\n"
            head += "".join(f"property float {axis}\n" for axis in "xyz")
            head += "".join(f"property float {name}\n" for name in names or ())
            head += f"element face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\n"
            head += "" if names else "property list uchar float texcoord\n"
            lines = ["{} {} {}".format(*p) + (" {} {}".format(*uv) if names else "")
                     for p, uv in zip(mesh.positions, uvs)]
            for t in mesh.triangles:
                corners = "" if names else " 6 " + " ".join("{} {}".format(*uvs[i]) for i in t)
                lines.append("3 {} {} {}".format(*t) + corners)
            (self.folder / "a.ply").write_text(head + "end_header\n" + "\n".join(lines) + "\n")
            blades = self.blades(self.bake("a.ply", "--count", "400", "--force", "--mask",
                                           "texture:left.png"))
            left = sum(b.root[0] < 0 for b in blades)
            # An image of two pixels is soft: three quarters stand in the left half.
            self.assertGreater(left, 270, names)


if __name__ == "__main__":
    unittest.main()
