"""Memory follows the data: a mesh takes at most 64 bytes for each byte of its file, and 64 MB, whatever its header
claims. The most memory that a process had tells."""

import json
import struct
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from meshes import container, glb_bytes, obj_text, square, stl_bytes
from support import CliTest, DONE, INPUT, PROGRAM, UNSUPPORTED

MEGABYTE = 1 << 20
PER_BYTE = 64
FREE = 64 * MEGABYTE
HUGE = (1 << 16, 1 << 31, (1 << 32) - 1)
# A process begins with the memory of the one that starts it: this one is small.
STARTER = """
import os, sys
child = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ)
_, status, used = os.wait4(child, 0)
print("\\n%d %d" % (os.waitstatus_to_exitcode(status), used.ru_maxrss))
"""
PLY_FORMATS = ("ascii", "binary_little_endian", "binary_big_endian")


def grid(cells):
    """Corners of a level grid as whole numbers, and its triangles."""
    points = [(x, 0, z) for z in range(cells + 1) for x in range(cells + 1)]
    rows = cells + 1
    triangles = [t for z in range(cells) for x in range(cells) for a in [z * rows + x]
                 for t in ((a, a + rows, a + 1), (a + 1, a + rows, a + rows + 1))]
    return points, triangles


def gltf(**parts):
    return json.dumps({"asset": {"version": "2.0"}, **parts}).encode()


def glb(document, binary=b""):
    return container(json.dumps(document).encode(), binary)


def triangle():
    """A GLB document of a triangle, and its bytes."""
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 0, -1) + struct.pack("<3H2x", 0, 1, 2)
    return {"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(data)}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
                          {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 3}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]}, data


class MeshMemory(CliTest):
    def peak(self, name, content):
        """Loads a mesh; the most memory of the process [bytes], and its exit code."""
        (self.folder / name).write_bytes(content)
        done = subprocess.run([sys.executable, "-S", "-c", STARTER, str(PROGRAM), "bake", name, "-o", "f.sward", "--force",
                               "--count", "10", "--threads", "2"], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", check=True)
        self.said, _, figures = done.stdout.rstrip("\n").rpartition("\n")
        code, most = map(int, figures.split())
        self.assertIn(code, (DONE, INPUT, UNSUPPORTED), f"{name}: {self.said[:500]}")
        return most * 1024, code

    def hold(self, files, codes=(INPUT, UNSUPPORTED)):
        """Each of `files` (what, ending, content) keeps the law and ends with one of `codes`."""
        base, _ = self.peak("base.obj", b"v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n")
        for what, ending, content in files:
            with self.subTest(what):
                most, code = self.peak("a" + ending, content)
                self.assertIn(code, codes, self.said[:500])
                limit = base + FREE + PER_BYTE * len(content)
                self.assertLess(most, limit, f"{what}: {most / MEGABYTE:.0f} MB for {len(content)} bytes")

    def test_counts_of_a_ply(self):
        axes = "property float x\nproperty float y\nproperty float z\n"
        files = []
        for form in PLY_FORMATS:
            head = f"ply\nformat {form} 1.0\n"
            body = b"0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n" if form == "ascii" else struct.pack(
                (">" if "big" in form else "<") + "9fB3i", 0, 0, 0, 0, 0, 1, 1, 0, 0, 3, 0, 1, 2)
            for count in HUGE:
                for vertices, faces, things in ((count, 1, 0), (3, count, 0), (3, 1, count)):
                    for kind in ("int", "list uchar int", "list double double"):
                        files.append((f"{form} {vertices} {faces} {things} {kind}", ".ply", (
                            head + f"element vertex {vertices}\n{axes}element thing {things}\nproperty {kind} a\n"
                            f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n").encode() + body))
        # A list of so many corners, and so many properties.
        for count in HUGE:
            files.append((f"list of {count}", ".ply", (
                f"ply\nformat binary_little_endian 1.0\nelement vertex 3\n{axes}element face 1\n"
                "property list uint uchar vertex_indices\nproperty list uint float texcoord\nend_header\n").encode()
                + struct.pack("<9fI", 0, 0, 0, 0, 0, 1, 1, 0, 0, count) + b"\0\1\2"))
        self.hold(files[::5] + files[-3:])

    def test_counts_of_other_polygons(self):
        files = []
        for count in HUGE:
            files += [(f"OFF {count} {other}", ".off", f"OFF\n{count} {other} 0\n0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n".encode())
                      for other in (1, count)]
            files.append((f"OFF corners {count}", ".off", f"OFF\n3 1 0\n0 0 0\n0 0 1\n1 0 0\n{count} 0 1 2\n".encode()))
            files.append((f"OFF binary {count}", ".off", b"OFF BINARY\n" + struct.pack(">3I", count, count, 0) + bytes(60)))
            files.append((f"STL {count}", ".stl", bytes(80) + struct.pack("<I", count) + bytes(150)))
            files.append((f"OBJ {count}", ".obj", f"v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 {count}\n".encode()))
        for line in ("f", "v 0 0 0", "vn", "vt", "o a", "usemtl", "mtllib a", "f 1 1"):
            files.append((f"OBJ of {line}", ".obj", b"v 0 0 0\n" + f"{line}\n".encode() * 100_000))
        files.append(("OBJ of names", ".obj", b"v 0 0 0\n" + b"".join(b"o %d\nusemtl %d\n" % (i, i) for i in range(50_000))))
        self.hold(files)

    def test_claims_of_a_gltf(self):
        files = []
        for count in HUGE:
            document, data = triangle()
            document["accessors"][0]["count"] = count
            files.append((f"vertices {count}", ".glb", glb(document, data)))
            del document["accessors"][0]["bufferView"]
            files.append((f"zeros {count}", ".glb", glb(document, data)))
            document, data = triangle()
            document["bufferViews"][0]["byteLength"] = document["buffers"][0]["byteLength"] = count
            files.append((f"bytes {count}", ".glb", glb(document, data)))
            document, data = triangle()
            document["accessors"][0]["sparse"] = {"count": count, "indices": {"bufferView": 1, "componentType": 5121},
                                                  "values": {"bufferView": 0}}
            files.append((f"sparse {count}", ".glb", glb(document, data)))
            document, data = triangle()
            document["bufferViews"][0]["extensions"] = {"EXT_meshopt_compression": {
                "buffer": 0, "byteLength": 36, "byteStride": 12, "count": count, "mode": "ATTRIBUTES"}}
            document["bufferViews"][0]["byteLength"] = 12 * count
            files.append((f"meshopt {count}", ".glb", glb(document, b"\xa0" + data[1:])))
            for method in (0, 1):
                document, data = triangle()
                document["accessors"] = [{"componentType": 5126, "type": "VEC3", "count": count},
                                         {"componentType": 5125, "type": "SCALAR", "count": 3 * (count // 3)}]
                draco = b"DRACO\2\2\1" + bytes((method, 0, 0, 0)) + b"\xff\xff\xff\x0f" * 6
                document["buffers"][0]["byteLength"] = document["bufferViews"][0]["byteLength"] = len(draco)
                document["bufferViews"] = document["bufferViews"][:1]
                document["meshes"][0]["primitives"][0]["extensions"] = {
                    "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
                files.append((f"Draco {method} {count}", ".glb", glb(document, draco)))
        # Much of little.
        for key, entry in (("nodes", {}), ("materials", {}), ("scenes", {}), ("textures", {}), ("samplers", {}),
                           ("meshes", {"primitives": [{"attributes": {}}]}),
                           ("meshes", {"primitives": [{"attributes": {}, "targets": [{}] * 20}] * 5})):
            files.append((f"many {key}", ".gltf", gltf(**{key: [entry] * (60_000 if key != "nodes" else 500_000)})))
        files.append(("deep", ".gltf", b"[" * (4 * MEGABYTE)))
        files.append(("numbers", ".gltf", b'{"extras":[' + b"0," * 2_000_000 + b"0]}"))
        files.append(("keys", ".gltf", b'{"extras":{' + b",".join(b'"%d":{}' % i for i in range(200_000)) + b"}}"))
        # The same bytes again and again.
        document, data = triangle()
        document["meshes"][0]["primitives"] *= 5000
        document["nodes"] = [{"mesh": 0, "name": "n" * 4000} for _ in range(2000)]
        document["scenes"] = [{"nodes": list(range(2000))}]
        files.append(("primitives", ".glb", glb(document, data)))
        document, data = triangle()
        document["accessors"].append({"componentType": 5126, "type": "VEC3", "count": 65_000})
        document["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}
        document["meshes"][0]["primitives"] *= 20
        files.append(("instances", ".glb", glb(document, data)))
        document["nodes"][0]["name"] = "n" * 4000
        files.append(("instances of a long name", ".glb", glb(document, data)))
        self.hold(files)

    def test_whole_meshes(self):
        """Valid files keep the law, too: few bytes for each triangle, without normals."""
        points, triangles = grid(200)
        shorts = b"".join(struct.pack("<3H", *p) for p in points)
        words = b"".join(struct.pack("<3I", *t) for t in triangles)
        halves = b"".join(struct.pack("<3H", *t) for t in triangles)
        head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n" + "".join(
            f"property ushort {axis}\n" for axis in "xyz") + f"element face {len(triangles)}\n"
        document, _ = triangle()
        floats = b"".join(struct.pack("<3f", *p) for p in points)
        document["buffers"] = [{"byteLength": len(floats) + len(words)}]
        document["bufferViews"] = [{"buffer": 0, "byteLength": len(floats)},
                                   {"buffer": 0, "byteOffset": len(floats), "byteLength": len(words)}]
        document["accessors"] = [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": len(points)},
                                 {"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": 3 * len(triangles)}]
        mesh = square(200.0, 200)
        self.hold([
            ("PLY", ".ply", (head + "property list uchar ushort vertex_indices\nend_header\n").encode() + shorts
             + b"".join(b"\3" + halves[i:i + 6] for i in range(0, len(halves), 6))),
            ("GLB", ".glb", glb(document, floats + words)),
            ("STL", ".stl", stl_bytes(mesh)),
            ("OBJ", ".obj", obj_text(mesh).encode()),
            ("OFF", ".off", (f"OFF\n{len(points)} {len(triangles)} 0\n" + "".join("%d %d %d\n" % p for p in points)
                             + "".join("3 %d %d %d\n" % t for t in triangles)).encode()),
        ], codes=(DONE,))

    def test_normals_of_short_numbers_take_no_memory(self):
        """326 bytes that once took 8 GB."""
        points, triangles = grid(4)
        content = (f"ply\nformat binary_big_endian 1.0\nelement vertex {len(points)}\n"
                   + "".join(f"property ushort {axis}\n" for axis in "xyz")
                   + "".join(f"property short {axis}\n" for axis in ("nx", "ny", "nz"))
                   + f"element face {len(triangles)}\nproperty list uchar uchar vertex_indices\nend_header\n").encode()
        content += b"".join(struct.pack(">3H3h", 2 * x, y, 2 * z, 0, 32767, 0) for x, y, z in points)
        content += b"".join(struct.pack(">4B", 3, *t) for t in triangles)
        most, code = self.peak("a.ply", content)
        self.assertEqual(code, DONE, self.said)
        self.assertLess(most, 50 * MEGABYTE)


if __name__ == "__main__":
    unittest.main()
