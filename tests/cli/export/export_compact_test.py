"""The compact .glb export: its size and its stated errors, read back by decoders of others."""

import sys
import unittest
from pathlib import Path

import numpy

sys.path.append(str(Path(__file__).resolve().parents[1]))

import gltf_instances
import node_readers
from export_tables import ExportTest, PLACE_ERROR, SPECIES, front, turned
from support import ROOT, USAGE

# What docs/exports.md states.
BYTES_A_BLADE = 16
PLACE = 2.0 ** -12  # [m] half a step
TURN = numpy.radians(0.6)
SCALE = 1.0 / 256.0  # of the largest of a node


def angle(a, b):
    """Angle between unit vectors [rad], exact for small ones too."""
    return 2.0 * numpy.arcsin(numpy.clip(numpy.linalg.norm(a - b, axis=1) / 2.0, 0.0, 1.0))


class CompactGlb(ExportTest):
    def compact(self, field, name="compact.glb", *options):
        path = self.export(field, name, "--compact", *options)
        return path, gltf_instances.Glb(node_readers.unpacked(path))

    def check(self, field, *options):
        """Every blade of the CSV is there, within the stated errors."""
        path, glb = self.compact(field, "ids.glb", "--with-ids", *options)
        self.assertEqual(gltf_instances.complaints(glb), [])
        table = self.table(field)
        found = gltf_instances.instances(glb)
        scales = [glb.numbers(attributes["SCALE"]) for _, attributes in glb.instanced_nodes()]
        order = numpy.argsort(found["id"][:, 0])
        largest = numpy.concatenate([numpy.tile(s.max(axis=0), (len(s), 1)) for s in scales])[order]
        found = {key: values[order] for key, values in found.items()}
        self.assertTrue(numpy.array_equal(found["id"][:, 0], table["id"].astype(numpy.uint64)))
        self.assert_near(found["place"], self.columns(table, "x", "y", "z"), PLACE + PLACE_ERROR)
        up = self.columns(table, "ux", "uy", "uz")
        for axis, real in (((0, 1, 0), up), ((0, 0, 1), front(up, table["facing"]))):
            turn = angle(turned(found["ROTATION"], axis), real)
            self.assertLessEqual(turn.max(), TURN)
            self.assertGreater(turn.max(), TURN / 8.0, "the bound says something")
        self.assertLessEqual((numpy.abs(found["SCALE"] - self.scales(table)) / largest).max(), SCALE * 1.001)
        # What the field stores in steps, the file has in the same steps.
        traits = found["_TRAITS"]
        for column, name, steps in ((0, "stiffness", 63), (1, "exposure", 31), (2, "clump", 1)):
            self.assert_near(traits[:, column], table[name] * steps, 1e-4)
        self.assert_near(found["_TINT"][:, :3],
                         self.columns(table, "tint_r", "tint_g", "tint_b") * (31, 63, 31), 1e-4)
        self.assert_near(found["mesh"][:, 0], table["species"], 0)
        return path, glb

    def test_blades_are_those_of_the_field(self):
        self.check(self.bake("hills", "--count", "30000"))

    def test_blades_of_a_planet_stand_on_every_side(self):
        self.check(self.bake("sphere", "--count", "20000", "--sky-rays", "0"))

    def test_blades_far_away_stand_where_they_are(self):
        self.check(self.far_field(), "--meshopt", "KHR")

    def test_a_blade_takes_less_than_16_bytes(self):
        # Ground with an image, so that tints differ, and exposure; a meadow of eight species.
        for field in (self.bake(ROOT / "assets/meshes/landscape.glb", "--count", "150000", "--bare-names", "none"),
                      self.bake("hills", "--count", "150000", "--sky-rays", "0", "--meadow", "prairie", to="p.sward")):
            with self.subTest(field=field.name):
                path = self.export(field, "small.glb", "--compact")
                self.assertLessEqual(path.stat().st_size, BYTES_A_BLADE * 150000)

    def test_a_file_without_ids_has_the_same_blades(self):
        field = self.bake("hills", "--count", "5000", "--sky-rays", "0")
        _, plain = self.compact(field)
        _, named = self.compact(field, "ids.glb", "--with-ids")
        nodes = list(zip(plain.instanced_nodes(), named.instanced_nodes(), strict=True))
        self.assertGreater(len(nodes), 0)
        for (_, one), (_, other) in nodes:
            self.assertEqual(other.keys() - one.keys(), {"_ROOT_ID"})
            for name, index in one.items():
                self.assertTrue(numpy.array_equal(plain.raw(index), named.raw(other[name])), name)

    def test_nodes_say_where_their_blades_are(self):
        _, glb = self.compact(self.bake("hills", "--count", "150000", "--sky-rays", "0"))
        nodes = list(glb.instanced_nodes())
        self.assertGreater(len({tuple(node["translation"]) for node, _ in nodes}), 1)
        for node, attributes in nodes:
            low, high = numpy.array(node["extras"]["bounds_m"])
            places, scales = glb.numbers(attributes["TRANSLATION"]), glb.numbers(attributes["SCALE"])
            self.assertTrue((places >= low - PLACE).all() and (places <= high + PLACE).all())
            # A bent blade reaches as far as it is long, and no more than the bounds.
            self.assertGreaterEqual(high[1] - places[:, 1].max(), 0.0)
            self.assertLess((high - low).max(), 40.0)
            self.assertGreater(scales.min(), 0.0)

    def test_species_have_two_levels(self):
        _, glb = self.compact(self.bake("plane", "--count", "500"))
        meshes = glb.json["meshes"]
        self.assertEqual(len(meshes), 2 * len(SPECIES))
        for slot, mesh in enumerate(meshes[:len(SPECIES)]):
            lod = mesh["extras"]["lod"]
            self.assertEqual(lod["mesh"], len(SPECIES) + slot)
            self.assertGreater(lod["below_pixels"], 2)
            fine, coarse = (len(glb.numbers(meshes[i]["primitives"][0]["indices"]))
                            for i in (slot, lod["mesh"]))
            self.assertLessEqual(coarse, 0.55 * fine, mesh["name"])
            # Both end at the same tip.
            tips = [glb.numbers(meshes[i]["primitives"][0]["attributes"]["POSITION"])[:, 1].max()
                    for i in (slot, lod["mesh"])]
            self.assertAlmostEqual(*tips, delta=0.02)

    def test_three_js_shows_the_blades_where_they_are(self):
        field = self.bake("hills", "--count", "20000", "--sky-rays", "0", "--meadow", "grass")
        table = self.table(field)
        for name in ("EXT", "KHR"):
            with self.subTest(name=name):
                path = self.export(field, "blades.glb", "--compact", "--with-ids", "--meshopt", name)
                self.assertIn(name.encode() + b"_meshopt_compression", path.read_bytes())
                rows = node_readers.three_instances(path)
                rows = rows[numpy.argsort(rows[:, 0])]
                self.assertTrue(numpy.array_equal(rows[:, 0], table["id"]))
                self.assert_near(rows[:, 13:16], self.columns(table, "x", "y", "z"), PLACE + PLACE_ERROR)
                heights = numpy.linalg.norm(rows[:, 5:8], axis=1)
                self.assert_near(heights, table["height"], SCALE * table["height"].max() + 1e-4)
                up = self.columns(table, "ux", "uy", "uz")
                self.assertLessEqual(angle(rows[:, 5:8] / heights[:, None], up).max(), TURN)

    def test_khronos_validator_finds_nothing(self):
        field = self.bake("hills", "--count", "2000")
        empty = self.bake("plane", "--density", "1", "--altitude", "5:", to="none.sward")
        for path in (self.export(field, "blades.glb", "--compact"), self.export(empty, "none.glb", "--compact"),
                     self.export(field, "ground.glb", "--compact", "--with-ground", "--meshopt", "KHR"),
                     self.export(field, "ids.glb", "--compact", "--with-ids")):
            with self.subTest(path=path.name):
                found = node_readers.gltf_issues(path)
                codes = {message["code"] for message in found["messages"]}
                self.assertEqual((found["numErrors"], found["numWarnings"]), (0, 0), found["messages"])
                self.assertLessEqual(codes, node_readers.EXPECTED)

    def test_its_ground_is_ground_again(self):
        field = self.bake("hills", "--count", "200")
        self.export(field, "ground.glb", "--compact", "--with-ground")
        self.sward("bake", "ground.glb", "--node", "ground", "--count", "200", "-o", "again.sward", "-q")
        ids = [numpy.sort(self.table(self.folder / name)["id"]) for name in ("field.sward", "again.sward")]
        self.assertTrue(numpy.array_equal(*ids), "the same triangles bear the same blades")

    def test_options_that_do_not_fit_are_refused(self):
        self.bake("plane", "--count", "50")
        for name, options, words in (("f.ply", ["--compact"], ["f.ply", "--compact", ".glb or .usda"]),
                                     ("f.csv", ["--compact"], ["f.csv", "--compact", ".glb or .usda"]),
                                     ("f.glb", ["--with-ids"], ["f.glb", "--with-ids", "--compact"]),
                                     ("f.glb", ["--meshopt", "KHR"], ["f.glb", "--meshopt", "--compact"]),
                                     ("f.usda", ["--compact", "--meshopt", "KHR"], ["f.usda", "--meshopt", ".glb"]),
                                     ("f.glb", ["--compact", "--meshopt", "ZIP"], ["--meshopt", "ZIP", "EXT", "KHR"])):
            with self.subTest(name=name, options=options):
                self.refused("export", "field.sward", "-o", name, *options, code=USAGE, names=words)


class LongCompactGlb(ExportTest):
    def test_three_js_loads_a_million_blades_in_a_second(self):
        field = self.bake("hills", "--count", "1000000", "--sky-rays", "0")
        path = self.export(field, "million.glb", "--compact")
        self.assertLessEqual(path.stat().st_size, BYTES_A_BLADE * 1000000)
        self.assertLessEqual(min(node_readers.three_load_time(path) for _ in range(3)), 1.0)


if __name__ == "__main__":
    unittest.main()
