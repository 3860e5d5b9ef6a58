"""How much grows: density, count, their defaults and their bounds."""

import json
import math
import re
import unittest

from meshes import bumps, glb_bytes, square
from support import CliTest, DONE, INPUT, USAGE


# Blades so wide that few of them close the sward.
COARSE = ("--meadow", "grass", "--set", "species.*.width_m=[0.15,0.2]", "--sky-rays", "0")


class Amount(CliTest):
    def setUp(self):
        super().setUp()
        # 400 m²
        (self.folder / "square.glb").write_bytes(glb_bytes(square(20.0)))

    def kept(self, *options):
        return self.info(self.bake("square.glb", "--force", *options))["blades"]

    def assert_poisson(self, number, expected):
        """Within five standard deviations of a sum of independent tries."""
        self.assertLess(abs(number - expected), 5 * math.sqrt(expected), f"expected {expected}")

    def test_density_times_area_is_the_count(self):
        for density in (1, 25, 100):
            with self.subTest(density=density):
                self.assert_poisson(self.kept("--density", density, "--blade-scale", "1"),
                                    density * 400)

    def test_ground_too_small_for_a_blade_says_which_amount_gives_some(self):
        proposal = ""
        (self.folder / "tiny.glb").write_bytes(glb_bytes(square(0.01)))
        for amount, expected in (("--density=200", "0.02 blades"), ("--spacing=1", "blades were"),
                                 ("--density=0", "none was asked for")):
            sampling = ("--sampling", "poisson") if "spacing" in amount else ()
            for run in (("-o", "f.sward", "--force"), ("--dry-run",)):
                with self.subTest(amount=amount, run=run):
                    done = self.sward("bake", "tiny.glb", *run, amount, *sampling)
                    self.assertIn(expected, done.stderr)
                    found = re.search(r"--density (\S+) or --count (\d+)", done.stderr)
                    self.assertEqual(found is None, amount == "--density=0", done.stderr)
                    proposal = found.group(0) if found else proposal
        for option in ("--density", "--count"):
            self.bake("tiny.glb", option, re.search(option + r" (\S+)", proposal).group(1), "--force",
                      to="f.sward")
            self.assertGreater(self.info(self.folder / "f.sward")["blades"], 50)

    def test_the_default_closes_the_sward_and_says_so(self):
        (self.folder / "small.glb").write_bytes(glb_bytes(square(5.0)))
        done = self.sward("bake", "small.glb", "-o", "closed.sward", "--blade-scale", "1", "--report", "c.json", "--force")
        report = self.read_json("c.json")
        closed = report["density_per_m2"]["closed"]
        self.assertGreater(closed, 1000)
        self.assert_poisson(report["roots"]["kept"], closed * 25)
        self.assertRegex(done.stderr, r"blades per m² close the meadow's sward; --density")
        # A density that somebody chose is no closed sward.
        self.sward("bake", "small.glb", "-o", "closed.sward", "--density", "3", "--report", "c.json", "--force")
        self.assertEqual(self.read_json("c.json")["density_per_m2"]["closed"], 0)

    def test_count_is_exact(self):
        for count in (1, 7, 1000, 12345):
            with self.subTest(count=count):
                self.assertEqual(self.kept("--count", count), count)

    def test_count_is_exact_after_filters(self):
        hills = self.bake("hills", "--count", "5000", "--slope", "5:30", "--force")
        self.assertEqual(self.info(hills)["blades"], 5000)

    def test_density_and_count_exclude_each_other(self):
        self.refused("bake", "square.glb", "-o", "f.sward", "--density", "3", "--count", "3",
                     code=USAGE, names=["--density", "--count"])

    def test_more_than_max_blades_is_refused_before_sampling(self):
        done = self.refused("bake", "square.glb", "-o", "f.sward", "--density", "1e9",
                            code=INPUT, names=["4e+11", "--max-blades 200000000"])
        self.assertIn("error", done.stderr)
        self.refused("bake", "square.glb", "-o", "f.sward", "--count", "1001", "--max-blades", "1000",
                     code=INPUT, names=["1001", "1000"])
        # Ribbons count: prairie has plants, grass has none.
        for meadow, code in (("grass", 0), ("prairie", INPUT)):
            said = self.sward("bake", "square.glb", "-o", "f.sward", "--count", "1000", "--max-blades", "1000", "--meadow", meadow, "--force", code=code).stderr
        self.assertIn("with the ribbons of plants", said)

    def test_without_a_wish_the_number_keeps_to_the_budget_and_says_so(self):
        (self.folder / "large.glb").write_bytes(glb_bytes(square(1000.0)))
        for budget, options in ((50e6, ()), (1e6, ("--budget", "1000000"))):
            self.sward("bake", "large.glb", "--dry-run", "--report", "r.json", "--blade-scale", "1", "-q", "--force",
                       "--meadow", "grass", "--sky-rays", "0", *options)
            report = self.read_json("r.json")
            self.assertLess(abs(report["roots"]["kept"] - budget), 0.05 * budget)
            self.assertEqual(report["widening"], 2)
            warnings = " ".join(report["warnings"])
            self.assertRegex(warnings, r"blades and .* GB; --budget")
        self.refused("bake", "square.glb", "-o", "f.sward", "--budget", "0", code=USAGE, names=["--budget"])

    def test_a_heightfield_bears_no_grass_on_cliffs_unless_asked(self):
        dunes = ("bake", "dunes", "-o", "d.sward", "--density", "5", "--report", "d.json", "--force")
        self.sward(*dunes)
        self.assertEqual(self.read_json("d.json")["slope_deg"], [0, 45, 15])
        self.sward(*dunes, "--slope", "0:180")
        self.assertEqual(self.read_json("d.json")["slope_deg"], [0, 180, 0])
        for closed in ("sphere", "torus", "arch"):
            self.sward("bake", closed, "-o", "d.sward", "--density", "5", "--report", "d.json", "--force")
            self.assertEqual(self.read_json("d.json")["slope_deg"], [0, 180, 0])

    def test_a_painted_mask_multiplies_density(self):
        # Red runs from 0 in the west to 1 in the east: half of all in the mean, nothing at the edge.
        (self.folder / "painted.glb").write_bytes(
            glb_bytes(square(20.0, 16, lambda x, z: (x / 20 + 0.5, 0.0, 0.0, 1.0))))
        options = ("--density", "100", "--blade-scale", "1", "--mask")
        blades = self.blades(self.bake("painted.glb", *options, "vertex-color:R"))
        self.assert_poisson(len(blades), 20000)
        # The share west of x is (x/20 + 1/2)².
        west = sum(blade.root[0] < 0.0 for blade in blades)
        self.assert_poisson(west, 5000)
        inverted = self.bake("painted.glb", *options, "vertex-color:R:invert", to="inverted.sward")
        self.assert_poisson(sum(b.root[0] < 0.0 for b in self.blades(inverted)), 15000)

    def test_nothing_kept_is_a_field_with_a_warning_that_counts(self):
        done = self.sward("bake", "square.glb", "-o", "f.sward", "--density", "10", "--slope", "50:90",
                          code=DONE)
        self.assertRegex(done.stderr, r"warning: .*\b\d{4} slope|warning: .*slope:? \d{4}")
        self.assertEqual(self.info(self.folder / "f.sward")["blades"], 0)
        self.sward("validate", "f.sward")

    def test_small_ground_gets_smaller_and_denser_blades(self):
        (self.folder / "pot.glb").write_bytes(glb_bytes(square(0.5)))
        small = self.report("pot.glb", *COARSE)
        large = self.report("square.glb", *COARSE)
        self.assertLess(small["blade_scale"], 0.5)
        self.assertAlmostEqual(large["blade_scale"], 1.0)
        self.assertGreater(small["density_per_m2"]["reached"], 2 * large["density_per_m2"]["reached"])

    def test_one_ground_at_any_size_bears_a_meadow_of_its_size(self):
        # 12 mm, 12 m and 3.6 km wide; the last is not grown here, since it bears millions.
        for name, scale in (("ant", 0.001), ("garden", 1.0), ("county", 300.0)):
            mesh = bumps()
            mesh.positions = [tuple(scale * c for c in p) for p in mesh.positions]
            (self.folder / f"{name}.glb").write_bytes(glb_bytes(mesh))
        ant, garden = (self.report(f"{name}.glb", *COARSE, to=f"{name}.sward") for name in ("ant", "garden"))
        self.assertAlmostEqual(garden["blade_scale"], garden["input"]["area_m2"]**0.5 / 20, places=3)
        self.assertAlmostEqual(ant["blade_scale"] / garden["blade_scale"], 0.001, places=6)
        self.assert_poisson(ant["roots"]["kept"], garden["roots"]["kept"])
        usual = self.report("garden.glb", "--sky-rays", "0", dry=True)
        self.assertGreater(usual["roots"]["kept"], 300 * 144)
        ratio = self.mean_height("ant.sward") / self.mean_height("garden.sward")
        self.assertAlmostEqual(ratio / 0.001, 1.0, delta=0.02)
        for report in (ant, garden, usual):
            self.assertEqual(report["warnings"], [])
        county = self.report("county.glb", "--meadow", "grass", "--sky-rays", "0", dry=True)
        self.assertEqual(county["blade_scale"], 1.0)
        self.assertTrue(49e6 < county["roots"]["kept"] < 51e6, county["roots"])
        self.assertEqual(county["widening"], 2)
        self.assertEqual(len(county["warnings"]), 1)

    def mean_height(self, field):
        told = self.sward("info", field, "--histogram", "--json").stdout
        return json.loads(told)["histogram"]["height_m"]["mean"]

    def test_inputs_are_joined(self):
        (self.folder / "far.glb").write_bytes(
            glb_bytes(square(20.0), node={"translation": [100, 0, 0]}))
        self.sward("bake", "square.glb", "far.glb", "-o", "f.sward", "--count", "20000", "-q")
        blades = self.blades(self.folder / "f.sward")
        self.assert_poisson(sum(blade.root[0] > 50 for blade in blades), 10000)


if __name__ == "__main__":
    unittest.main()
