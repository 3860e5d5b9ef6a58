"""`--geometry` and `--raster-for` choose the way that draws. That all ways draw the same on many scenes, tests/gpu
holds."""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from png import picture_of

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]

# PSNR [dB] over the pixels with grass, and mean signed difference of any 32 × 32 tile.
MIN_PSNR = 40.0
MAX_TILE = 2.0
TILE = 32

WAYS = {"tessellation": ("--geometry", "tessellation"),
        "raster for gpu": ("--geometry", "raster", "--raster-for", "gpu"),
        "raster for cpu": ("--geometry", "raster", "--raster-for", "cpu")}


def psnr(a, b, where):
    error = np.mean((a - b)[where] ** 2)
    return 10.0 * np.log10(255.0 ** 2 / max(error, 1e-9))


class GeometryTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-geometry-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        subprocess.run([SWARD, "bake", "hills", "--count", "5000", "--blade-scale", "3", "--meadow", "grass", "-o",
                        cls.folder / "field.sward", "-q"], check=True)
        # The graphics pipeline draws the ground before the blades that would shade it.
        (cls.folder / "plain.json").write_text('{"look": {"blade_shadows": false}}', encoding="utf-8")
        cls.drawn = {}

    def draw(self, *arguments):
        """The picture and its stats; each is drawn once."""
        if arguments not in self.drawn:
            done = subprocess.run([VIEWER, "render", "field.sward", "-o", "picture.png", "--size", "160x96", "--camera",
                                   "eye", "--samples", "4", "--force", "-q", "--settings", "plain.json", "--validation", "--stats", "stats.json",
                                   *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.drawn[arguments] = (picture_of(self.folder / "picture.png").astype(float),
                                     json.loads((self.folder / "stats.json").read_text(encoding="utf-8")))
        return self.drawn[arguments]

    def test_the_way_that_is_asked_for_draws(self):
        memory = {}
        for way, arguments in WAYS.items():
            with self.subTest(way=way):
                stats = self.draw(*arguments)[1]
                self.assertEqual((stats["geometry"], stats["geometry_reason"]), (way.split()[0], "asked for"))
                self.assertEqual(stats["validation_messages"], 0)
                memory[way] = stats["memory_bytes"]["device"]
        # The raster for a GPU keeps lists in the device's memory that the one for a CPU does not need.
        self.assertGreater(memory["raster for gpu"], 2 * memory["raster for cpu"])

    def test_without_a_wish_the_program_chooses_and_says_why(self):
        picture, stats = self.draw()
        self.assertIn(stats["geometry"], ("raster", "tessellation"))
        self.assertNotIn(stats["geometry_reason"], ("", "asked for"))
        # On lavapipe it is the raster for a CPU: the same bytes of memory, the same picture.
        same, asked = self.draw(*WAYS["raster for cpu"])
        self.assertEqual(stats["memory_bytes"]["device"], asked["memory_bytes"]["device"])
        self.assertTrue((picture == same).all())

    def test_each_way_shows_the_same_grass(self):
        by_pipeline = self.draw(*WAYS["tessellation"])[0]
        bare = self.draw(*WAYS["tessellation"], "--draw-distance", "0.001")[0]
        for way in ("raster for gpu", "raster for cpu"):
            with self.subTest(way=way):
                picture = self.draw(*WAYS[way])[0]
                grass = np.any(by_pipeline != bare, axis=-1) | np.any(picture != bare, axis=-1)
                self.assertGreater(np.mean(grass), 0.02, "there is grass to compare")
                self.assertGreaterEqual(psnr(picture, by_pipeline, grass), MIN_PSNR)
                signed = (picture - by_pipeline).mean(axis=-1)
                rows, columns = (n // TILE * TILE for n in signed.shape)
                tiles = signed[:rows, :columns].reshape(rows // TILE, TILE, columns // TILE, TILE).mean((1, 3))
                self.assertLessEqual(np.abs(tiles).max(), MAX_TILE)

    def test_ways_that_there_are_not_are_wrong_usage(self):
        for option in ("--geometry", "--raster-for"):
            with self.subTest(option=option):
                done = subprocess.run([VIEWER, "render", "none.sward", "-o", "none.png", option, "maybe"],
                                      capture_output=True, text=True, timeout=60)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, f"{option}: 'maybe' is not one of auto, ")


if __name__ == "__main__":
    unittest.main()
