"""The known systems are measured test by test, and what is measured is plotted."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

from soon import programs_that_start_soon

ROOT = Path(__file__).resolve().parents[3]
SVG = "{http://www.w3.org/2000/svg}"


class SystemsTest(unittest.TestCase):
    def run_script(self, *arguments):
        done = subprocess.run([sys.executable, ROOT / "scripts" / "systems", *arguments], capture_output=True, text=True,
                              timeout=200, env={**os.environ, "SWARD_BUILD": str(self.build)})
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_culling_tests_alone_and_together_are_measured_and_plotted(self):
        with tempfile.TemporaryDirectory(prefix="sward-systems-") as folder:
            folder = Path(folder)
            self.build = folder / "build"
            programs_that_start_soon(self.build / "bin")
            self.run_script("--measure", folder / "measured.json", "--fields", folder, "--size", "64x36", "--frames", "1",
                            "--share", "0.01", "buckets")
            system, = json.loads((folder / "measured.json").read_text(encoding="utf-8"))["systems"]
            blades = {way["cull"]: way["stats"]["blades"] for way in system["ways"]}
            self.assertEqual(list(blades), ["none", "orientation", "frustum", "distance", "all"])
            for cull, counts in blades.items():
                culled = counts["culled"]
                self.assertEqual(counts["drawn"] + counts["lod"] + sum(culled.values()), counts["resident"], cull)
                for test in ("orientation", "frustum", "distance"):
                    self.assertEqual(culled[test] > 0, cull in (test, "all"), f"{cull}: {culled}")
                self.assertGreaterEqual(counts["drawn"], blades["all"]["drawn"])

            self.run_script("--plot", folder / "measured.json", folder / "plots")
            text = (folder / "plots" / "README.md").read_text(encoding="utf-8")
            self.assertIn("buckets.svg", text)
            for cull, counts in blades.items():
                self.assertIn(f"| {cull} | {counts['drawn']} |", text)
            plot = xml.etree.ElementTree.parse(folder / "plots" / "buckets.svg")
            widths = [float(bar.get("width")) for bar in plot.iter(SVG + "rect") if bar.get("fill") == "#b08d3c"]
            self.assertEqual(len(widths), len(blades))
            for width, counts in zip(widths, blades.values()):
                self.assertAlmostEqual(width / widths[0], counts["drawn"] / blades["none"]["drawn"], delta=0.01)


if __name__ == "__main__":
    unittest.main()
