"""Input that is missing, broken or beyond the program: an exit code, a message, nothing left."""

import json
import math
import os
import struct
import unittest

from meshes import Mesh, bumps, container, glb_bytes, grey_png, obj_text, square, stl_bytes
from support import CliTest, DONE, INPUT, IO, ROOT, UNSUPPORTED, USAGE


class Input(CliTest):
    def refused_ground(self, name, content, code, *words):
        """Writes a ground and bakes it with what must be in the message; whole field names too."""
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        self.refused("bake", name, "-o", "f.sward", code=code, names=[name, *words])

    def test_a_missing_file(self):
        self.refused("bake", "none.glb", "-o", "f.sward", code=IO, names=["none.glb"])
        self.refused("bake", "plane", "--occluder", "none.glb", "-o", "f.sward", code=IO,
                     names=["none.glb"])
        for command in ("info", "validate"):
            self.refused(command, "none.sward", code=IO, names=["none.sward"])

    def test_a_folder_is_not_a_mesh(self):
        (self.folder / "folder.glb").mkdir()
        self.refused("bake", "folder.glb", "-o", "f.sward", code=IO, names=["folder.glb"])

    def test_truncated_glbs_of_any_length(self):
        whole = glb_bytes(square(4.0))
        for size in (1, 4, 11, 12, 19, 20, 100, len(whole) // 2, len(whole) - 4, len(whole) - 1):
            with self.subTest(size=size):
                self.refused_ground("cut.glb", whole[:size], INPUT)

    def test_an_empty_file(self):
        for name in ("e.glb", "e.gltf", "e.obj", "e.ply", "e.stl", "e.off", "e.json"):
            with self.subTest(name=name):
                self.refused_ground(name, b"", INPUT)

    def test_a_required_extension_that_is_not_supported(self):
        document = {"extensionsUsed": ["ACME_curved_space"], "extensionsRequired": ["ACME_curved_space"]}
        self.refused_ground("curved.glb", glb_bytes(square(4.0), document=document), UNSUPPORTED,
                            "ACME_curved_space")

    def test_a_used_extension_that_is_not_required_does_no_harm(self):
        document = {"extensionsUsed": ["ACME_curved_space"]}
        (self.folder / "m.glb").write_bytes(glb_bytes(square(4.0), document=document))
        self.sward("bake", "m.glb", "-o", "f.sward", "--count", "10", code=DONE)

    def test_another_version_of_gltf(self):
        self.refused_ground("v3.glb", glb_bytes(square(4.0), document={"asset": {"version": "3.0"}}),
                            UNSUPPORTED, "3.0")

    def test_a_mesh_without_triangles(self):
        points = Mesh([(0, 0, 0), (1, 0, 0), (0, 0, 1)], [])
        document = {"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}]}
        self.refused_ground("points.glb", glb_bytes(points, document=document), INPUT, "triangle")
        self.refused_ground("empty.obj", "v 0 0 0\nv 1 0 0\n", INPUT, "no faces")
        self.refused_ground("nothing.glb", container(json.dumps({"asset": {"version": "2.0"}}).encode(),
                                                     b""), INPUT)

    def test_triangles_without_area(self):
        self.refused_ground("flat.glb", glb_bytes(Mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)])),
                            INPUT)

    def test_positions_that_are_no_numbers(self):
        for value in (math.nan, math.inf, -math.inf):
            mesh = square(4.0)
            mesh.positions[5] = (0.0, value, 0.0)
            with self.subTest(value=value):
                self.refused_ground("nan.glb", glb_bytes(mesh), INPUT)
        self.refused_ground("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", INPUT)

    def test_indices_beyond_the_vertices(self):
        mesh = square(4.0)
        mesh.triangles[7] = (0, 1, 100000)
        self.refused_ground("index.glb", glb_bytes(mesh), INPUT, "100000")

    def test_buffers_beyond_the_file(self):
        document = {"buffers": [{"byteLength": 1 << 40}]}
        self.refused_ground("buffer.glb", glb_bytes(square(4.0), document=document), INPUT)

    def test_files_of_an_unknown_kind(self):
        self.refused_ground("ground.fbx", b"Kaydara FBX Binary", UNSUPPORTED, ".fbx")

    def test_a_recipe_with_an_unknown_key(self):
        self.refused_ground("r.json", '{"kind": "sphere", "radios": 3}', INPUT, "radios")

    def test_a_meadow_with_an_unknown_key(self):
        meadow = json.loads((ROOT / "assets/meadows/meadow.json").read_text(encoding="utf-8"))
        self.write_json("m.json", {**meadow, "speceis": []})
        self.refused("bake", "plane", "-o", "f.sward", "--meadow", "m.json", code=INPUT,
                     names=["m.json", "speceis", "species"])

    def test_a_scene_that_does_not_exist(self):
        (self.folder / "m.glb").write_bytes(glb_bytes(square(4.0)))
        self.refused("bake", "m.glb", "-o", "f.sward", "--scene", "3", code=USAGE,
                     names=["m.glb", "scene 3"])

    def test_a_count_that_no_ground_can_keep(self):
        # No root has this slope: the field is empty, the count is not reached, and the program says so.
        done = self.sward("bake", "plane", "-o", "f.sward", "--count", "100", "--slope", "80:90")
        self.assertIn("warning: ", done.stderr)

    def test_every_format_of_the_contract_is_read(self):
        mesh = square(4.0)
        corners = [[mesh.positions[i] for i in triangle] for triangle in mesh.triangles]
        header = (f"ply\nformat ascii 1.0\nelement vertex {len(mesh.positions)}\nproperty float x\n"
                  "property float y\nproperty float z\n"
                  f"element face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\n"
                  "end_header\n")
        points = "".join("{} {} {}\n".format(*p) for p in mesh.positions)
        faces = "".join("3 {} {} {}\n".format(*t) for t in mesh.triangles)
        facets = "".join("facet normal 0 1 0\nouter loop\n"
                         + "".join("vertex {} {} {}\n".format(*p) for p in c)
                         + "endloop\nendfacet\n" for c in corners)
        texts = {
            "m.obj": obj_text(mesh),
            "m.ply": header + points + faces,
            "m.off": f"OFF\n{len(mesh.positions)} {len(mesh.triangles)} 0\n" + points + faces,
            "m.stl": f"solid m\n{facets}endsolid m\n",
        }
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh))
        for name, text in texts.items():
            (self.folder / name).write_text(text)
        for name in ("m.glb", *texts):
            with self.subTest(name=name):
                report = self.report(name, "--count", "10")
                self.assertAlmostEqual(report["input"]["area_m2"], 16.0, places=5)
                self.assertEqual(report["input"]["triangles"], len(mesh.triangles))

    def test_an_existing_file_wins_over_a_built_in_of_its_name(self):
        (self.folder / "plane").write_text("not a mesh")
        self.refused("bake", "plane", "-o", "f.sward", code=UNSUPPORTED, names=["plane"])

    def test_a_heightmap_is_ground(self):
        samples = [(i * 977) % 65536 for i in range(9 * 5)]
        (self.folder / "m.png").write_bytes(grey_png(9, 5, samples))
        (self.folder / "m.r16").write_bytes(struct.pack(f"<{len(samples)}H", *samples))
        placed = ("--extent", "16", "8", "--height", "-3:5", "--count", "500")
        done = self.sward("bake", "m.png", "-o", "f.sward", *placed)
        self.assertNotIn("warning", done.stderr)
        report = self.report("m.png", *placed)
        self.assertEqual(report["input"]["triangles"], 2 * 8 * 4)
        low, high = report["input"]["bounds"]
        self.assertEqual((low[0], high[0], low[2], high[2]), (-8.0, 8.0, -4.0, 4.0))
        self.assertGreaterEqual(low[1], -3.0)
        self.assertLessEqual(high[1], 5.0)
        self.bake("m.r16", "--size", "9x5", *placed, to="r.sward")
        self.sward("compare", "field.sward", "r.sward")

    def test_a_heightmap_without_its_options(self):
        (self.folder / "m.r16").write_bytes(b"\0" * 18)
        self.refused("bake", "m.r16", "-o", "f.sward", code=USAGE, names=["m.r16", "--size"])
        for bad in ("3", "3x", "x3", "0x9", "3x3x3", "99999999x2"):
            self.refused("bake", "m.r16", "--size", bad, "-o", "f.sward", code=USAGE, names=["--size"])
        self.refused("bake", "m.r16", "--size", "32768x32768", "-o", "f.sward", code=USAGE,
                     names=["--size", "17000000"])
        self.refused("bake", "m.r16", "--size", "4x3", "-o", "f.sward", code=INPUT,
                     names=["m.r16", "24 bytes"])
        for bad in ("5", "5:", "7:1", "a:b"):
            self.refused("bake", "m.r16", "--size", "3x3", "--height", bad, "-o", "f.sward",
                         code=USAGE, names=["--height"])
        self.refused("bake", "m.r16", "--size", "3x3", "--extent", "10", "-o", "f.sward", code=USAGE,
                     names=["--extent"])
        self.refused("bake", "m.r16", "--size", "3x3", "--extent", "0", "10", "-o", "f.sward",
                     code=USAGE, names=["--extent"])
        self.refused("bake", "m.r16", "--size", "3x3", "--hole-mask", "none.png", "-o", "f.sward",
                     code=IO, names=["none.png"])
        done = self.sward("bake", "m.r16", "--size", "3x3", "-o", "f.sward", "--count", "10")
        self.assertIn("--extent", done.stderr)
        self.assertIn("--height", done.stderr)

    def test_options_of_heightmaps_without_a_heightmap(self):
        done = self.sward("bake", "plane", "--extent", "9", "9", "-o", "f.sward", "--count", "10")
        self.assertIn("warning: --size, --extent", done.stderr)

    def test_a_hole_mask_keeps_grass_away(self):
        (self.folder / "m.png").write_bytes(grey_png(5, 5, [100] * 25))
        (self.folder / "holes.png").write_bytes(grey_png(2, 1, [0, 65535]))
        field = self.bake("m.png", "--extent", "8", "8", "--height", "0:1", "--hole-mask",
                          "holes.png", "--count", "300")
        self.assertTrue(all(blade.root[0] >= 0.0 for blade in self.blades(field)))

    def test_a_z_up_stl_in_centimetres_equals_the_glb(self):
        mesh = bumps()
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh))
        # (x, y, z) lies at (x, −z, y) where z is up.
        turned = Mesh([(100 * x, -100 * z, 100 * y) for x, y, z in mesh.positions], mesh.triangles)
        (self.folder / "m.stl").write_bytes(stl_bytes(turned))
        common = ("--density", "40", "--seed", "3")
        self.bake("m.glb", *common, to="glb.sward")
        done = self.sward("bake", "m.stl", "-o", "stl.sward", "--up-axis", "z", "--units", "cm", *common)
        self.assertNotIn("warning: m.stl", done.stderr)
        self.sward("compare", "glb.sward", "stl.sward", "--match", "id", "--tolerance", "1e-4")

        # Without its flags the program names the flags to try.
        done = self.sward("bake", "m.stl", "-o", "wrong.sward", "--count", "10")
        self.assertIn("--up-axis z", done.stderr)
        self.assertIn("--units cm", done.stderr)

    def test_compressed_gltf_of_the_wrong_kind(self):
        # Unit tests cover Draco and meshopt; this tests exit codes.
        draco = {"extensionsRequired": ["KHR_draco_mesh_compression"], "meshes": [{"primitives": [{
            "attributes": {"POSITION": 0}, "indices": 1, "extensions": {
                "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}]}
        self.refused_ground("draco.glb", glb_bytes(square(4.0), document=draco), INPUT, "Draco")
        views = [{"buffer": 0, "byteLength": 972, "extensions": {"EXT_meshopt_compression": {
            "buffer": 0, "byteLength": 900, "byteStride": 12, "count": 81, "mode": "ATTRIBUTES"}}}]
        self.refused_ground("meshopt.glb", glb_bytes(square(4.0), document={"bufferViews": views}), INPUT,
                            "EXT_meshopt_compression")

    def test_an_obj_without_its_library_is_baked(self):
        (self.folder / "m.obj").write_text("mtllib gone.mtl\nusemtl grass\n" + obj_text(square(4.0)))
        done = self.sward("bake", "m.obj", "-o", "f.sward", "--count", "10")
        self.assertIn("gone.mtl", done.stderr)

    def test_samples_made_by_others_are_read(self):
        # The folder contains no project files; commands must work there.
        samples = sorted((ROOT.parent / "shared/samples").glob("**/*.gl[tb]*"))
        samples += sorted((ROOT.parent / "shared/samples").glob("heightmap*.png"))
        for mesh in [ROOT / "assets/meshes/landscape.glb", *samples]:
            with self.subTest(mesh=mesh.name):
                self.bake(mesh, "--count", "1000", "--force")
                self.sward("validate", "field.sward")

    def test_a_pipe_is_refused_and_not_waited_for(self):
        self.bake("plane", "--count", "9", to="f.sward")
        self.sward("plan", "plane", "--count", "9", "--tiles", "1", "-o", "p.json")
        for kind in ("sward", "glb", "obj", "png", "json"):
            os.mkfifo(self.folder / f"pipe.{kind}")
        bake = ("bake", "-o", "o.sward")
        for command, kind in ((("info",), "sward"), (("validate",), "sward"), (("compare", "f.sward"), "sward"),
                              (("export", "-o", "o.csv"), "sward"), (bake, "glb"), (bake, "obj"), (bake, "png"), (bake, "json"),
                              ((*bake, "plane", "--meadow"), "json"), ((*bake, "plane", "--mask"), "png"),
                              ((*bake, "plane", "--occluder"), "glb"), ((*bake, "plane", "--exclude"), "obj"),
                              (("terrain", "-o", "o.glb"), "json"), (("compare", "f.sward", "f.sward", "--transform"), "json"),
                              (("tile", "--index", "0", "-o", "o"), "json"), (("merge", "-o", "o.sward"), "json")):
            name = f"pipe.{kind}"
            with self.subTest(command=command, kind=kind):
                more = ["d"] if command[0] == "merge" else []
                word = f"texture:{name}" if command[-1] == "--mask" else name
                self.refused(*command, word, *more, code=IO, names=[name, "not a regular file"])


if __name__ == "__main__":
    unittest.main()
