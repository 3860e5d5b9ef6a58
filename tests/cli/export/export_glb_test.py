"""The .glb export, read back by code that is not the exporter's and held against the CSV."""

import json
import struct
import sys
import unittest
from pathlib import Path

import numpy

sys.path.append(str(Path(__file__).resolve().parents[1]))

import gltf_instances
import node_readers
from export_tables import ExportTest, PLACE_ERROR, SPECIES, front, turned
from meshes import container, glb_bytes, square


class GlbExport(ExportTest):
    def check(self, field, name="blades.glb"):
        """All instances of the file are the blades of the CSV."""
        glb = gltf_instances.Glb.read(self.export(field, name))
        self.assertEqual(gltf_instances.complaints(glb), [])
        table = self.table(field)
        found = gltf_instances.instances(glb)
        order = numpy.argsort(found["id"][:, 0])
        found = {key: values[order] for key, values in found.items()}
        self.assertTrue(numpy.array_equal(found["id"][:, 0], table["id"].astype(numpy.uint64)))
        self.assert_near(found["place"], self.columns(table, "x", "y", "z"), PLACE_ERROR)
        up = self.columns(table, "ux", "uy", "uz")
        self.assert_near(turned(found["ROTATION"], (0, 1, 0)), up, 2e-6)
        self.assert_near(turned(found["ROTATION"], (0, 0, 1)), front(up, table["facing"]), 4e-6)
        self.assert_near(found["SCALE"], self.scales(table), 1e-8)
        for attribute, column in (("_HEIGHT", "height"), ("_WIDTH", "width"),
                                  ("_STIFFNESS", "stiffness"), ("_EXPOSURE", "exposure"),
                                  ("_SPECIES", "species"), ("_CLUMP", "clump"),
                                  ("mesh", "species")):
            self.assert_near(found[attribute][:, 0], table[column], 1e-8)
        self.assert_near(found["_TINT"][:, :3], self.columns(table, "tint_r", "tint_g", "tint_b"),
                         0.5001 / 255)
        return glb

    def test_glb_instances_are_the_blades(self):
        glb = self.check(self.bake("hills", "--count", "150000", "--sky-rays", "0"))
        counts = {}
        for node, attributes in glb.instanced_nodes():
            group = tuple(node["translation"])
            counts[group] = counts.get(group, 0) + glb.json["accessors"][attributes["SCALE"]]["count"]
        self.assertGreater(len(counts), 4, "so many blades are more than one group")
        self.assertLessEqual(max(counts.values()), 32768)

    def test_blades_of_a_planet_stand_on_every_side(self):
        self.check(self.bake("sphere", "--count", "20000"))

    def test_glb_places_far_away_keep_their_micrometres(self):
        glb = self.check(self.far_field())
        root = glb.json["nodes"][glb.json["scenes"][0]["nodes"][0]]
        self.assertEqual(root["extras"]["origin_m"], root["translation"])
        self.assertTrue(all(x % 32 == 0 for x in root["translation"]))
        for node, _ in glb.instanced_nodes():
            origin, place = (numpy.array(n["translation"]) for n in (root, node))
            # A consumer in single precision adds them without error.
            single = origin.astype(numpy.float32) + place.astype(numpy.float32)
            self.assertTrue(numpy.array_equal(single.astype(float), origin + place))

    def test_three_js_shows_the_blades_where_they_are(self):
        # A matrix of three.js is of single precision before it is moved to the world, in doubles.
        for field in (self.bake("hills", "--count", "60000", "--sky-rays", "0", "--meadow", "grass"),
                      self.far_field("--meadow", "grass")):
            with self.subTest(field=field.name):
                rows = node_readers.three_instances(self.export(field, "blades.glb"))
                rows = rows[numpy.argsort(rows[:, 0])]
                table = self.table(field)
                self.assertTrue(numpy.array_equal(rows[:, 0], table["id"]))
                self.assert_near(rows[:, 13:16], self.columns(table, "x", "y", "z"), PLACE_ERROR)
                up = self.columns(table, "ux", "uy", "uz") * table["height"][:, None]
                self.assert_near(rows[:, 5:8], up, 1e-6)
                self.assert_near(numpy.linalg.norm(rows[:, 1:4], axis=1), table["width"], 1e-6)

    def test_blade_meshes_are_one_long_and_one_wide(self):
        glb = gltf_instances.Glb.read(self.export(self.bake("plane", "--count", "500", "--meadow", "grass"), "b.glb"))
        self.assertEqual(len(glb.json["meshes"]), 3, "grass has three species")
        for mesh in glb.json["meshes"]:
            (primitive,) = mesh["primitives"]
            points = glb.numbers(primitive["attributes"]["POSITION"])
            self.assertTrue(numpy.array_equal(points[:2], [[-0.5, 0, 0], [0.5, 0, 0]]))
            centres = numpy.array([points[points[:, 1] == y].mean(axis=0) for y in sorted(set(points[:, 1]))])
            steps = numpy.linalg.norm(numpy.diff(centres, axis=0), axis=1)
            self.assertAlmostEqual(steps.sum(), 1.0, delta=0.01)
            material = glb.json["materials"][primitive["material"]]
            red, green, blue, _ = material["pbrMetallicRoughness"]["baseColorFactor"]
            self.assertGreater(green + red, 3 * blue, "grass is not blue")
            self.assertTrue(material["doubleSided"])

    def test_a_plant_is_one_instance_of_a_mesh_with_its_ribbons(self):
        field = self.bake("plane", "--count", "3000")
        glb = gltf_instances.Glb.read(self.export(field, "b.glb"))
        self.assertEqual(gltf_instances.complaints(glb), [])
        self.assertEqual(len(glb.json["meshes"]), len(SPECIES))
        instances = 0
        for mesh, one in zip(glb.json["meshes"], SPECIES):
            triangles = len(glb.numbers(mesh["primitives"][0]["indices"])) / 3
            ribbons = sum(organ["count"] for organ in one.get("organs", []))
            self.assertGreaterEqual(triangles, 7 * (1 + ribbons), one["name"])
        for node in glb.json["nodes"]:
            attributes = node.get("extensions", {}).get("EXT_mesh_gpu_instancing", {}).get("attributes")
            if attributes is None:
                continue
            scales, heights = glb.numbers(attributes["SCALE"]), glb.numbers(attributes["_HEIGHT"])
            instances += len(scales)
            is_plant = "organs" in SPECIES[node["mesh"]]
            across = heights if is_plant else glb.numbers(attributes["_WIDTH"])
            self.assertTrue(numpy.array_equal(scales[:, 0], across.reshape(-1)), node["name"])
        self.assertEqual(instances, 3000)

    def test_the_ground_comes_along_when_asked_for(self):
        field = self.bake("hills", "--count", "200")
        bare = gltf_instances.Glb.read(self.export(field, "bare.glb"))
        self.assertNotIn("ground", [node["name"] for node in bare.json["nodes"]])
        self.check(field)
        glb = gltf_instances.Glb.read(self.export(field, "ground.glb", "--with-ground"))
        self.assertEqual(gltf_instances.complaints(glb), [])
        (ground,) = [node for node in glb.json["nodes"] if node["name"] == "ground"]
        primitives = glb.json["meshes"][ground["mesh"]]["primitives"]
        triangles = sum(glb.json["accessors"][p["indices"]]["count"] for p in primitives) // 3
        self.assertEqual(triangles, self.info(field)["ground"]["triangles"])
        # The ground alone is ground again: the same triangles bear the same blades.
        self.sward("bake", "ground.glb", "--node", "ground", "--count", "200", "-o", "again.sward", "-q")

    def test_the_copyright_of_the_ground_passes_on(self):
        (self.folder / "g.glb").write_bytes(
            glb_bytes(square(4.0), document={"asset": {"version": "2.0", "copyright": "CC0 © Ä. \"B\""}}))
        glb = gltf_instances.Glb.read(self.export(self.bake("g.glb", "--count", "10"), "b.glb"))
        self.assertEqual(glb.json["asset"]["copyright"], "CC0 © Ä. \"B\"")
        self.assertEqual(glb.json["asset"]["generator"], "sward 0.1.0")

    def test_glb_without_blades_needs_no_extension(self):
        field = self.bake("plane", "--density", "1", "--altitude", "5:")
        glb = gltf_instances.Glb.read(self.export(field, "none.glb"))
        self.assertEqual(gltf_instances.complaints(glb), [])
        self.assertNotIn("extensionsUsed", glb.json)

    def test_khronos_validator_finds_nothing(self):
        field = self.bake("hills", "--count", "2000")
        empty = self.bake("plane", "--density", "1", "--altitude", "5:", to="none.sward")
        for path in (self.export(field, "blades.glb"), self.export(empty, "none.glb"),
                     self.export(field, "ground.glb", "--with-ground"),
                     self.export(self.far_field(), "far-blades.glb")):
            with self.subTest(path=path.name):
                found = node_readers.gltf_issues(path)
                codes = {message["code"] for message in found["messages"]}
                self.assertEqual((found["numErrors"], found["numWarnings"]), (0, 0), found["messages"])
                self.assertLessEqual(codes, node_readers.EXPECTED)

    def test_khronos_validator_is_awake(self):
        path = self.export(self.bake("plane", "--count", "50"), "blades.glb")
        glb = gltf_instances.Glb.read(path)
        glb.json["accessors"][0]["max"][1] += 1.0
        path.write_bytes(container(json.dumps(glb.json).encode(), glb.binary))
        self.assertGreater(node_readers.gltf_issues(path)["numErrors"], 0)

    def test_the_check_of_the_instancing_rules_is_awake(self):
        whole = self.export(self.bake("plane", "--count", "300"), "blades.glb").read_bytes()
        glb = gltf_instances.Glb(whole)
        node, attributes = next(glb.instanced_nodes())
        at = glb.json["nodes"].index(node)

        def accessor(json_, name):
            return json_["accessors"][attributes[name]]

        def put(glb_, name, kind, value):
            view = glb_.json["bufferViews"][accessor(glb_.json, name)["bufferView"]]
            changed = bytearray(glb_.binary)
            struct.pack_into(kind, changed, view["byteOffset"], value)
            glb_.binary = bytes(changed)

        extension = gltf_instances.EXTENSION
        broken = {
            "extensionsUsed": lambda g: g.json["extensionsUsed"].clear(),
            "extensionsRequired": lambda g: g.json.pop("extensionsRequired"),
            "has no mesh": lambda g: g.json["nodes"][at].pop("mesh"),
            "has no attributes": lambda g: g.json["nodes"][at]["extensions"][extension]["attributes"].clear(),
            "extension has no attributes": lambda g: g.json["nodes"][at]["extensions"][extension].clear(),
            "counts differ": lambda g: accessor(g.json, "SCALE").update(count=accessor(g.json, "SCALE")["count"] - 1),
            "TRANSLATION is a VEC4": lambda g: accessor(g.json, "TRANSLATION").update(type="VEC4"),
            "ROTATION is a VEC4 of 5121": lambda g: accessor(g.json, "ROTATION").update(componentType=5121),
            "ROTATION is a VEC4 of 5122": lambda g: accessor(g.json, "ROTATION").update(componentType=5122),
            "SCALE is a SCALAR": lambda g: accessor(g.json, "SCALE").update(type="SCALAR"),
            "unsigned integers of 32 bits": lambda g: accessor(g.json, "_CLUMP").update(componentType=5125),
            "not aligned": lambda g: accessor(g.json, "_CLUMP").update(componentType=5121),
            "does not fit": lambda g: accessor(g.json, "_CLUMP").update(type="VEC4"),
            "does not begin with an underscore": lambda g: g.json["nodes"][at]["extensions"][extension]
            ["attributes"].update(HEIGHT=attributes["_HEIGHT"]),
            "unit quaternion": lambda g: put(g, "ROTATION", "<f", 1.5),
            "not finite": lambda g: put(g, "_WIDTH", "<f", float("nan")),
            "SCALE is not positive": lambda g: put(g, "SCALE", "<f", 0.0),
            "min of TRANSLATION": lambda g: put(g, "TRANSLATION", "<f", -1000.0),
            "max of POSITION": lambda g: g.json["accessors"][0]["max"].__setitem__(1, 1.5),
            "no min and max": lambda g: g.json["accessors"][0].pop("min"),
            "longer than the binary": lambda g: g.json["buffers"][0].update(byteLength=1 << 30),
        }
        for reason, change in broken.items():
            with self.subTest(reason=reason):
                changed = gltf_instances.Glb(whole)
                self.assertEqual(gltf_instances.complaints(changed), [])
                change(changed)
                self.assertIn(reason, "\n".join(gltf_instances.complaints(changed)))


if __name__ == "__main__":
    unittest.main()
