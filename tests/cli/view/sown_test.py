"""`sward-view render` of a field with seeds: what it sows near the eye."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
HILLS = ["hills", "--density", "40", "--sky-rays", "0", "--slope", "0:180", "--blade-scale", "1"]


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


if __name__ == "__main__":
    unittest.main()
