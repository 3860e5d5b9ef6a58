"""The .glb for engines: the same instances in rank order, what they look like, and what moves them."""

import sys
import unittest
from pathlib import Path

import numpy

sys.path.append(str(Path(__file__).resolve().parents[1]))

import gltf_instances
from export_tables import ExportTest, SPECIES
from support import USAGE

ADDED = ("_RANK", "_ROOT_COLOR", "_TIP_COLOR", "_LEAF_AREA")


def by_id(glb):
    found = gltf_instances.instances(glb)
    order = numpy.argsort(found["id"][:, 0])
    return {name: values[order] for name, values in found.items()}


def dispersion(places, share):
    """Mean of (number - expected)²/expected over squares in which a prefix of `share` has some eight instances: about
    1 - share for a random choice, less for one that is evenly spread."""
    some = int(len(places) * share)
    extent = numpy.ptp(places[:, 0]) * numpy.ptp(places[:, 2])
    cell = numpy.sqrt(8.0 * extent / some)
    x, z = (numpy.floor((places[:, k] - places[:, k].min()) / cell).astype(int) for k in (0, 2))
    squares = x * (z.max() + 1) + z
    expected = numpy.bincount(squares) * some / len(places)
    number = numpy.bincount(squares[:some], minlength=len(expected))
    full = expected > 1.0
    return float(((number - expected) ** 2)[full].dot(1.0 / expected[full]) / full.sum())


class EngineExport(ExportTest):
    def glb(self, field, name, *options):
        glb = gltf_instances.Glb.read(self.export(field, name, *options))
        self.assertEqual(gltf_instances.complaints(glb), [])
        return glb

    def test_the_instances_are_those_of_a_plain_export(self):
        field = self.bake("hills", "--count", "20000", "--sky-rays", "0")
        plain = self.glb(field, "plain.glb")
        engine = self.glb(field, "engine.glb", "--for-engines")
        a, b = by_id(plain), by_id(engine)
        self.assertEqual(set(b) - set(a), set(ADDED))
        for name, values in a.items():
            self.assertTrue(numpy.array_equal(values, b[name]), name)
        nodes = [(node["name"], node["translation"]) for node, _ in plain.instanced_nodes()]
        self.assertEqual(nodes, [(node["name"], node["translation"]) for node, _ in engine.instanced_nodes()])

    def test_ranks_rise_in_each_group(self):
        glb = self.glb(self.bake("hills", "--count", "60000", "--sky-rays", "0"), "b.glb", "--for-engines")
        for node, attributes in glb.instanced_nodes():
            ranks = glb.numbers(attributes["_RANK"])[:, 0]
            self.assertTrue((numpy.diff(ranks) >= 0.0).all(), node["name"])
            self.assertGreaterEqual(ranks[0], 0.0)
            self.assertLess(ranks[-1], 1.0)
        # A rank is a share of the blades around: so the ranks of all are spread evenly over [0, 1).
        ranks = numpy.sort(by_id(glb)["_RANK"][:, 0])
        error = numpy.abs(ranks - (numpy.arange(len(ranks)) + 0.5) / len(ranks)).max()
        self.assertLess(error, 0.05)

    def test_every_prefix_of_a_group_is_evenly_spread(self):
        field = self.bake("plane", "--count", "30000", "--sky-rays", "0")
        engine = self.glb(field, "engine.glb", "--for-engines")
        plain = self.glb(field, "plain.glb")
        for share in (1 / 16, 1 / 8, 1 / 4):
            even, by_patches = (
                [dispersion(places, share) for _, attributes in glb.instanced_nodes()
                 if len(places := glb.numbers(attributes["TRANSLATION"])) > 2000] for glb in (engine, plain))
            self.assertGreater(len(even), 4)
            self.assertLess(numpy.mean(even), 0.8 * (1.0 - share), share)
            self.assertGreater(numpy.mean(by_patches), 1.0 - share, "groups that go patch by patch do not thin so")

    def test_colours_are_those_of_species_ground_and_clump(self):
        field = self.bake("plane", "--count", "20000", "--meadow", "grass", "--sky-rays", "0")
        glb = self.glb(field, "b.glb", "--for-engines")
        found = by_id(glb)
        extras = glb.json["nodes"][glb.json["scenes"][0]["nodes"][0]]["extras"]["sward"]
        linear = lambda c: numpy.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
        for slot, species in enumerate(extras["species"]):
            own = found["mesh"][:, 0] == slot
            for name, key in (("_ROOT_COLOR", "root_color"), ("_TIP_COLOR", "tip_color")):
                mean = linear(found[name][own][:, :3]).mean(axis=0)
                # Wide variation, dry tips and the ground at the roots move the mean of many blades less than this.
                self.assertLess(numpy.abs(numpy.log(mean / numpy.array(species[key]))).max(), 1.0, (slot, name))
            self.assertGreater(found["_TIP_COLOR"][own][:, 1].std(), 0.01, "blades differ")
        # The leaf area is that around the root: m² of blade per m² of ground.
        area = (found["_HEIGHT"] * found["_WIDTH"]).sum() / numpy.prod(numpy.ptp(found["place"], axis=0)[[0, 2]])
        self.assertLess(abs(found["_LEAF_AREA"].mean() / (0.75 * area) - 1.0), 0.35)

    def test_extras_hold_wind_gravity_and_species(self):
        field = self.bake("plane", "--count", "3000")
        glb = self.glb(field, "b.glb", "--for-engines")
        (root,) = (glb.json["nodes"][i] for i in glb.json["scenes"][0]["nodes"])
        extras = root["extras"]["sward"]
        self.assertEqual((extras["version"], extras["order"]), (1, "rank"))
        wind = extras["wind"]
        self.assertAlmostEqual(float(numpy.linalg.norm(wind["direction"])), 1.0, places=6)
        self.assertEqual([round(wind[key], 3) for key in ("strength", "wave_length_m", "speed_m_per_s", "gust_size_m", "gustiness")],
                         [3.0, 7.0, 2.6, 3.5, 0.6])
        self.assertEqual([round(x, 3) for x in extras["gravity"]["direction"]], [0.0, -1.0, 0.0])
        self.assertEqual(len(extras["leaves"]["share_above"]), 16)
        self.assertEqual([species["name"] for species in extras["species"]], [one["name"] for one in SPECIES])
        table = self.table(field)
        for slot, species in enumerate(extras["species"]):
            own = table["species"] == slot
            self.assertEqual(species["blades"], own.sum())
            self.assertEqual(species["plant"], "organs" in SPECIES[slot])
            if own.any():
                self.assertAlmostEqual(species["mean_height_m"], table["height"][own].mean(), places=5)
                self.assertAlmostEqual(species["mean_width_m"], table["width"][own].mean(), places=6)
        self.assertNotIn("sward", self.glb(field, "plain.glb").json["nodes"][-1]["extras"])

    def test_the_ground_is_dark_below_a_closed_sward(self):
        field = self.bake("plane", "--density", "400", "--sky-rays", "0")
        brightness = []
        for options in (("--with-ground",), ("--with-ground", "--for-engines")):
            glb = self.glb(field, "b.glb", *options)
            (mesh,) = [mesh for mesh in glb.json["meshes"] if mesh["name"] == "ground"]
            (primitive,) = mesh["primitives"]
            base = glb.json["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"][:3]
            brightness.append((glb.numbers(primitive["attributes"]["COLOR_0"])[:, :3] * base).mean())
        self.assertLess(brightness[1], 0.6 * brightness[0])

    def test_other_formats_have_no_place_for_it(self):
        self.bake("plane", "--count", "10")
        for name in ("b.ply", "b.usda", "b.csv"):
            self.refused("export", "field.sward", "-o", name, "--for-engines", code=USAGE,
                         names=[name, "--for-engines", ".glb"])


if __name__ == "__main__":
    unittest.main()
