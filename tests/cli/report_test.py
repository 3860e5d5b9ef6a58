"""`--report` answers "why is there no grass here": its keys, its sums, and the dry run's promise."""

import os
import unittest

from support import CliTest, ROOT

# The contract: every key and the kind of its value.
NUMBER = (int, float)
REASONS = ("spacing", "mask", "cutout", "material", "slope", "altitude", "border", "curvature", "water",
           "clearance", "exposure", "occluder", "excluded", "paint")
STAGES = ("load", "topology", "rays", "sample", "traits", "patches", "write", "total")
CONTRACT = {
    "tool": str,
    "input": {"path": str, "triangles": int, "area_m2": NUMBER, "bounds": list, "hash": str},
    "seed": int,
    "slope_deg": list,
    "widening": NUMBER,
    "ground_colors": (dict, type(None)),
    "masks": list,
    "threads": int,
    "blade_scale": NUMBER,
    "roots": {"proposed": int, "kept": int, "rejected": {reason: int for reason in REASONS}},
    "spacing": {"requested_m": NUMBER, "minimum_m": NUMBER, "rho": NUMBER},
    "density_per_m2": {"requested": NUMBER, "reached": NUMBER, "closed": NUMBER},
    "timing_s": {stage: NUMBER for stage in STAGES},
    "processor_s": {"sample": NUMBER, "total": NUMBER},
    "memory_bytes": {"peak": int},
    "output": {"path": str, "bytes": int, "patches": int, "bytes_per_blade": NUMBER},
    "warnings": list,
}
LANDSCAPE = ROOT / "assets/meshes/landscape.glb"
FILTERS = ("--mask", "vertex-color:R:or-white", "--slope", "0:40", "--altitude", "-0.5:", "--clearance", "0.5",
           "--density", "20")


class Report(CliTest):
    def assert_keys(self, value, contract, place="report"):
        if not isinstance(contract, dict):
            self.assertIsInstance(value, contract, place)
            return
        self.assertEqual(set(value), set(contract), place)
        for key, inner in contract.items():
            self.assert_keys(value[key], inner, f"{place}.{key}")

    def test_verbosely_it_says_how_the_ground_hangs_together(self):
        # A book of three pages: one edge of three triangles, a border around each page.
        (self.folder / "book.obj").write_text(
            "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n")
        done = self.sward("bake", "book.obj", "-o", "book.sward", "-v", "--density", "50")
        self.assertIn("5 welded vertices", done.stderr)
        self.assertIn("6 border edges", done.stderr)
        self.assertIn("1 non-manifold edges", done.stderr)

    def assert_sums(self, report):
        roots = report["roots"]
        self.assertEqual(roots["proposed"], roots["kept"] + sum(roots["rejected"].values()))

    def test_the_keys_are_exactly_those_of_the_contract(self):
        self.assert_keys(self.report("hills", "--count", "1000"), CONTRACT)
        self.assert_keys(self.report("plane", "--density", "10", dry=True), CONTRACT)

    def test_every_proposed_root_is_kept_or_has_a_reason(self):
        report = self.report(LANDSCAPE, *FILTERS)
        self.assert_sums(report)
        for reason in ("mask", "slope", "altitude", "clearance"):
            self.assertGreater(report["roots"]["rejected"][reason], 0, reason)

    def test_the_report_says_what_is_in_the_field(self):
        report = self.report("hills", "--count", "5000", "--slope", "0:30", "--seed", "9",
                             "--threads", "2")
        field = self.folder / "field.sward"
        info = self.info(field)
        self.assertEqual(report["tool"], "sward 0.1.0")
        self.assertEqual(report["roots"]["kept"], 5000)
        self.assertEqual(report["roots"]["kept"], info["blades"])
        self.assertEqual(report["output"]["patches"], info["patches"])
        self.assertEqual(report["output"]["bytes"], field.stat().st_size)
        self.assertEqual(report["output"]["path"], "field.sward")
        self.assertAlmostEqual(report["output"]["bytes_per_blade"], field.stat().st_size / 5000)
        self.assertEqual((report["seed"], report["threads"]), (9, 2))
        self.assertEqual(report["input"]["path"], "hills")
        self.assertEqual(report["input"]["hash"], info["provenance"]["input_hash"])
        low, high = report["input"]["bounds"]
        self.assertTrue(all(l <= h for l, h in zip(low, high)))

    def test_times_and_memory_are_plausible(self):
        report = self.report("hills", "--count", "50000")
        times = report["timing_s"]
        stages = sum(seconds for stage, seconds in times.items() if stage != "total")
        self.assertGreater(times["load"], 0.0)
        self.assertGreater(times["write"], 0.0)
        self.assertGreater(times["total"], 0.0)
        self.assertLessEqual(stages, 1.01 * times["total"] + 0.005)
        self.assertGreater(report["memory_bytes"]["peak"], 1 << 20)
        # Processor time of a stage is a part of the whole's, and of all threads in its wall time.
        busy = report["processor_s"]
        self.assertGreater(busy["sample"], 0.0)
        self.assertLess(busy["sample"], busy["total"])
        self.assertLessEqual(busy["sample"], times["sample"] * report["threads"] + 0.02)

    def test_memory_is_that_of_the_bake_alone(self):
        # Whoever starts the program may hold more.
        held = bytearray(os.urandom(1 << 20)) * 400
        peak = self.report("plane", "--count", "1000")["memory_bytes"]["peak"]
        self.assertGreater(peak, 1 << 20)
        self.assertLess(peak, len(held) // 2)

    def test_density_reached_is_what_stands_on_the_area(self):
        report = self.report("plane", "--density", "50", "--blade-scale", "1")
        self.assertEqual(report["density_per_m2"]["requested"], 50)
        self.assertAlmostEqual(report["density_per_m2"]["reached"],
                               report["roots"]["kept"] / report["input"]["area_m2"])

    def test_warnings_on_stderr_are_those_of_the_report(self):
        done = self.sward("bake", "sphere", "-o", "f.sward", "--count", "100", "--report", "r.json")
        warnings = self.read_json("r.json")["warnings"]
        self.assertGreater(len(warnings), 0)
        for warning in warnings:
            self.assertIn(f"warning: {warning}\n", done.stderr)

    def test_a_dry_run_is_within_five_per_cent_and_writes_no_field(self):
        # An estimate tries 400000 candidates at most: fewer than there are on the arch.
        cases = [("hills", "--slope", "0:25", "--density", "60"),
                 ("sphere", "--count", "100000", "--slope", "0:90", "--sky-rays", "0"),
                 ("arch", "--density", "600", "--clearance", "1", "--sky-rays", "0"),
                 (LANDSCAPE, *FILTERS)]
        for case in cases:
            with self.subTest(case=case):
                dry = self.report(*case, dry=True)
                self.assertNotIn("field.sward", self.files())
                real = self.report(*case)
                for group, key in (("roots", "kept"), ("roots", "proposed"), ("output", "bytes")):
                    expected = real[group][key]
                    self.assertLess(abs(dry[group][key] - expected), 0.05 * expected, f"{group}.{key}")
                (self.folder / "field.sward").unlink()

    def test_a_dry_run_of_much_grass_is_quick(self):
        # Estimated from a sample: 100 million blades would take minutes and gigabytes.
        report = self.report("hills", "--count", "100000000", dry=True)
        self.assertEqual(report["roots"]["kept"], 100000000)
        self.assertLess(report["timing_s"]["total"], 20.0)
        self.assertLess(report["memory_bytes"]["peak"], 1 << 30)


if __name__ == "__main__":
    unittest.main()
