"""`sward-view render` of a field with seeds: what it sows near the eye."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
HILLS = ["hills", "--density", "40", "--sky-rays", "0", "--slope", "0:180", "--blade-scale", "1", "--meadow", "grass"]


class SownCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-sown-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.field = cls.folder / "seeded.sward"
        subprocess.run([SWARD, "bake", *HILLS, "--seeds", "always", "--budget", "2000", "-o", cls.field, "-q"], check=True)

    def render(self, *arguments, code=0):
        done = subprocess.run([VIEWER, "render", self.field, "--size", "64x36", "--camera", "eye", "-o", "s.png", "--force",
                               *map(str, arguments)], cwd=self.folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def counts(self, *arguments):
        self.render("--stats", "s.json", *arguments)
        return json.loads((self.folder / "s.json").read_text(encoding="utf-8"))


class MemoryOfSownBladesTest(SownCase):
    def test_sown_blades_stay_within_their_memory(self):
        stored = self.counts("--sown-memory", "0")
        least = self.counts("--sown-memory", "16M", "--validation")
        some = self.counts("--sown-memory", "128M")
        usual = self.counts()
        self.assertEqual(stored["blades"]["total"], stored["blades"]["resident"])
        self.assertLess(stored["blades"]["resident"], 3000)
        for sown, mebibytes in ((least, 16), (some, 128), (usual, 512)):
            beside = sown["memory_bytes"]["device"] - stored["memory_bytes"]["device"]
            # Room of the smallest number of units, and what a frame brings, are beside it.
            self.assertLess(beside, (mebibytes + 4) << 20)
            self.assertGreater(beside, 0.9 * (mebibytes << 20))
            self.assertGreater(sown["blades"]["resident"], 5 * stored["blades"]["resident"])
            self.assertEqual(sown["blades"]["total"], sown["blades"]["resident"] + sown["blades"]["streamed_out"])
            self.assertEqual(sown["blades"]["total"], usual["blades"]["total"])

    def test_memory_that_cannot_be_used_is_refused(self):
        for wrong in ("much", "15M", "-1", "65G", "128MB"):
            self.assertIn("--sown-memory", self.render("--sown-memory", wrong, code=1).stderr)
        self.assertIn("[16777216, 68719476736] bytes", self.render("--sown-memory", "1M", code=1).stderr)


class DumpOfSownBladesTest(SownCase):
    def dump(self, *options):
        self.render("--dump-blades", "d.csv", "--stats", "s.json", *options)
        counts = json.loads((self.folder / "s.json").read_text(encoding="utf-8"))["blades"]
        return counts, numpy.genfromtxt(self.folder / "d.csv", delimiter=",", skip_header=1, usecols=(0, 1, 2, 3, 14))

    def test_the_dump_lists_what_grows_there(self):
        counts, rows = self.dump()
        self.assertEqual(len(rows), counts["resident"])
        self.assertGreater(counts["sown"], 1000)
        self.assertEqual((rows[:, 4] > 0).sum(), counts["drawn"])
        subprocess.run([SWARD, "grow", self.field, "-o", self.folder / "grown.sward", "-q"], check=True)
        subprocess.run([SWARD, "export", self.folder / "grown.sward", "-o", self.folder / "g.csv", "-q"], check=True)
        grown = numpy.genfromtxt(self.folder / "g.csv", delimiter=",", skip_header=1, usecols=(0, 1, 2, 3))
        roots = {int(row[0]): row[1:4] for row in grown}
        away = [numpy.linalg.norm(row[1:4] - roots[int(row[0])]) for row in rows]
        self.assertLess(max(away), 1e-3)

    def test_paths_are_traced_by_a_dump_of_stored_blades(self):
        self.dump()
        trace = [SWARD, "trace", self.field, "-o", "t.exr", "--size", "16x9", "--samples", "1", "--blades", "d.csv", "--force", "-q"]
        done = subprocess.run(trace, cwd=self.folder, text=True, capture_output=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("--sown-memory 0", done.stderr)
        counts, rows = self.dump("--sown-memory", "0")
        self.assertEqual(len(rows), counts["total"])
        subprocess.run(trace, cwd=self.folder, check=True, capture_output=True)


if __name__ == "__main__":
    unittest.main()
