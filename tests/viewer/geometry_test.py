"""Blades drawn by compute shaders look as those that the graphics pipeline draws."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
MESHES = Path(__file__).resolve().parents[2] / "assets" / "meshes"

# PSNR [dB] over the pixels with grass, and mean signed difference of any 32 × 32 tile.
MIN_PSNR = 40.0
# Where a pixel shows both halves of a folded blade, four samples of it have one light.
MIN_PSNR_OF_FOLDS = 37.0
MAX_TILE = 2.0
TILE = 32

SHAPES = ("triangle-tip", "quad", "triangle", "quadratic", "dandelion")


def psnr(a, b, where):
    error = np.mean((a - b)[where] ** 2)
    return 10.0 * np.log10(255.0 ** 2 / max(error, 1e-9))


class GeometryTest(unittest.TestCase):
    def setUp(self):
        needs("skimage")
        folder = tempfile.TemporaryDirectory(prefix="sward-geometry-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments):
        done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)

    def bake(self, *arguments):
        field = self.folder / "field.sward"
        meadow = [] if "--meadow" in arguments else ["--meadow", "grass"]
        self.run_program(SWARD, "bake", *arguments, *meadow, "-o", field, "--force", "-q")
        return field

    def draw(self, field, *arguments):
        picture = self.folder / "picture.png"
        self.run_program(VIEWER, "render", field, "-o", picture, "--size", "320x192", "--force",
                         "-q", "--validation", *arguments)
        from skimage.io import imread
        return imread(picture)[..., :3].astype(float)

    def compare(self, field, *arguments, least=MIN_PSNR):
        bare = self.draw(field, *arguments, "--draw-distance", "0.001")
        by_pipeline = self.draw(field, *arguments, "--geometry", "tessellation")
        for way in ("--geometry raster --raster-for gpu", "--geometry raster --raster-for cpu"):
            with self.subTest(way=way):
                picture = self.draw(field, *arguments, *way.split())
                grass = np.any(by_pipeline != bare, axis=-1) | np.any(picture != bare, axis=-1)
                self.assertGreater(np.mean(grass), 0.02, "there is grass to compare")
                self.assertGreaterEqual(psnr(picture, by_pipeline, grass), least)
                signed = (picture - by_pipeline).mean(axis=-1)
                rows, columns = (n // TILE * TILE for n in signed.shape)
                tiles = signed[:rows, :columns].reshape(rows // TILE, TILE, columns // TILE, TILE).mean((1, 3))
                self.assertLessEqual(np.abs(tiles).max(), MAX_TILE)

    def each_number_of_samples(self, field, *arguments):
        for samples in ("1", "4"):
            with self.subTest(samples=samples):
                self.compare(field, *arguments, "--samples", samples)

    def test_hills_from_far_and_from_amid_the_blades(self):
        field = self.bake("hills", "--count", "20000", "--blade-scale", "3")
        for camera in ("fit", "eye"):
            with self.subTest(camera=camera):
                self.each_number_of_samples(field, "--camera", camera)

    def test_sphere(self):
        self.each_number_of_samples(self.bake("sphere", "--count", "8000", "--blade-scale", "3"))

    def test_landscape(self):
        self.each_number_of_samples(
            self.bake(MESHES / "landscape.glb", "--mask", "vertex-color:R:or-white", "--count", "20000",
                      "--blade-scale", "3"), "--camera", "eye")

    def test_each_shape_flat_and_folded(self):
        # So wide that a fold shows.
        for index, shape in enumerate(SHAPES):
            for fold, samples in ((0.0, "4"), (1.0, "14"[index % 2])):
                with self.subTest(shape=shape, fold=fold):
                    meadow = self.folder / "meadow.json"
                    meadow.write_text(json.dumps({"species": [
                        {"name": "one", "shape": shape, "fold": fold, "width_m": [0.08, 0.16],
                         "height_m": [0.6, 1.2]}]}))
                    field = self.bake("plane", "--count", "4000", "--meadow", meadow)
                    least = MIN_PSNR_OF_FOLDS if fold > 0.0 and samples == "4" else MIN_PSNR
                    self.compare(field, "--camera", "edge", "--samples", samples, least=least)

    def test_without_level_of_detail_and_at_a_fixed_level(self):
        field = self.bake("dunes", "--count", "10000")
        self.compare(field, "--camera", "edge", "--lod", "off", "--samples", "4")
        self.compare(field, "--camera", "edge", "--tess-level", "7", "--samples", "1")

    def test_ways_that_there_are_not_are_wrong_usage(self):
        for option in ("--geometry", "--raster-for"):
            with self.subTest(option=option):
                done = subprocess.run([VIEWER, "render", "none.sward", "-o", "none.png", option, "maybe"],
                                      capture_output=True, text=True, timeout=60)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, f"{option}: 'maybe' is not one of auto, ")

    def test_the_picture_does_not_depend_on_the_order_of_threads(self):
        field = self.bake("hills", "--count", "20000", "--blade-scale", "3")
        for device in ("gpu", "cpu"):
            way = ("--camera", "eye", "--geometry", "raster", "--raster-for", device)
            first = self.draw(field, *way)
            for _ in range(3):
                self.assertTrue((first == self.draw(field, *way)).all())


if __name__ == "__main__":
    unittest.main()
