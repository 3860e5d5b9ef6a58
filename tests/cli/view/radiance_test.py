"""`sward-view render -o x.exr` writes the linear radiance of which a .png is the film."""

import json
import os
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "scripts"))
import exr_light  # noqa: E402
import light_pictures  # noqa: E402

SWARD, VIEWER = os.environ["SWARD_PROGRAM"], os.environ["SWARD_VIEW_PROGRAM"]
ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
USAGE, IO = 1, 2
EXPOSURE = 0.6
# A skyline before a sky that is nearly even.
EDGE = {"eye": [0.0, 1.0, 0.0], "target": [0.0, 0.9, -1.0], "up": [0.3, 1.0, 0.0], "fov_y_deg": 10}


def filmed(radiance):
    """filmOf() of film_curve.h."""
    x = 0.80 * radiance
    return np.clip((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0)


def off_quarters(picture):
    """Median distance from 0, 1, 2 or 3 of the quarters of a pixel of the skyline that the sky fills."""
    picture = picture.mean(axis=2)
    above, here, below = picture[:-4], picture[2:-2], picture[4:]
    share = (here - below) / np.maximum(above - below, 1e-3)
    edge = (above > 2.0 * below) & (share > 0.12) & (share < 0.88)
    assert edge.sum() > 15, edge.sum()
    return np.median(np.abs(4.0 * share[edge] - np.round(4.0 * share[edge])))


class RadianceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-radiance-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        for name, ground, count in (("meadow", "hills", 4000), ("bare", "plane", 1)):
            subprocess.run([SWARD, "bake", ground, "--count", str(count), "--blade-scale", "3", "--meadow", "grass", "-o",
                            cls.folder / f"{name}.sward", "-q"], check=True, stdout=subprocess.DEVNULL)
        cls.settings("look", {"exposure": EXPOSURE, "clouds": 0.5})
        cls.settings("dim", {"exposure": 0.1, "clouds": 0.5})
        # A sky that leans a little has no floor below the ground.
        cls.settings("white", {"sun": {"color": [0, 0, 0]}, "sky": [100, 100, 100], "ground": [0, 0, 0], "fog": 0, "clouds": 0,
                               "up": [0.05, 1, 0]})
        (cls.folder / "edge.json").write_text(json.dumps(EDGE), encoding="utf-8")

    @classmethod
    def settings(cls, name, look):
        (cls.folder / f"{name}.json").write_text(json.dumps({"wind": [], "look": look}), encoding="utf-8")

    def run_view(self, output, *arguments, code=0, field="meadow", size="128x72", camera="eye", look="look", limit=None):
        before = {path.name for path in self.folder.iterdir()}
        limits = (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))) if limit else None
        done = subprocess.run([VIEWER, "render", f"{field}.sward", "-o", output, "--size", size, "--camera", camera, "--settings",
                               f"{look}.json", "-q", *arguments], cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, preexec_fn=limits)
        self.assertEqual(done.returncode, code, done.stderr)
        if code:
            self.assertEqual({path.name for path in self.folder.iterdir()}, before)
        return done.stderr

    def drawn(self, name, *arguments, **how):
        self.run_view(name, "--force", "--validation", *arguments, **how)
        return light_pictures.read(self.folder / name)

    def test_a_png_is_its_film(self):
        for way in ("raster", "tessellation"):
            with self.subTest(way=way):
                how = ("--samples", "1", "--geometry", way)
                radiance, film = self.drawn("a.exr", *how), self.drawn("a.png", *how)
                self.assertEqual(radiance.shape, (72, 128, 3))
                self.assertGreater(np.ptp(radiance), 0.3)
                # The curve's value dithered by half a step, and rounded.
                away = light_pictures.encoded(filmed(EXPOSURE * radiance)).astype(int) - light_pictures.encoded(film)
                self.assertLessEqual(np.abs(away).max(), 1)

    def test_it_has_three_half_channels_and_no_exposure(self):
        radiance = self.drawn("a.exr")
        channels = exr_light.read(self.folder / "a.exr")
        self.assertEqual({name: channel.dtype for name, channel in channels.items()}, dict.fromkeys("BGR", np.dtype("<f2")))
        np.testing.assert_array_equal(self.drawn("dim.exr", look="dim"), radiance)

    def test_samples_are_averaged_in_radiance(self):
        """A pixel that one, two or three of four samples of the sky fill is that share of the way from ground to sky."""
        for way in ("raster", "tessellation"):
            with self.subTest(way=way):
                picture = self.drawn("edge.exr", "--samples", "4", "--geometry", way, "--thatch", "0", look="white", camera="edge.json",
                                     field="bare")
                # Ground and sky change by a few hundredths over two pixels.
                self.assertLess(off_quarters(picture), 0.08)

    def test_a_reference_is_a_mean_of_radiance(self):
        how = {"size": "64x36", "look": "white", "camera": "edge.json", "field": "bare"}
        reference, frame = self.drawn("reference.exr", "--reference", **how), self.drawn("frame.exr", "--samples", "4", **how)
        self.assertLess(abs(reference.mean() / frame.mean() - 1.0), 0.02)
        # 1024 samples of a pixel are no quarters.
        self.assertGreater(off_quarters(reference), 2.0 * off_quarters(frame))

    def test_each_frame_has_its_picture(self):
        self.run_view("f_%02d.exr", "--frames", "1:2", "--samples", "1")
        self.assertEqual(len(list(self.folder.glob("f_0[12].exr"))), 2)

    def test_what_makes_no_sense_or_cannot_be_written_is_refused(self):
        for arguments, code, says in ((("x.exr", "--debug", "lod"), USAGE, "--debug"), (("x.EXR",), USAGE, ".exr or .npz"),
                                      (("none/x.exr",), IO, "none"), (("meadow.sward.exr/x.exr",), IO, "x.exr")):
            with self.subTest(arguments=arguments):
                self.assertIn(says, self.run_view(*arguments, code=code))
        # A full disk, as far as a program can tell.
        self.assertIn("x.exr", self.run_view("x.exr", size="640x360", code=IO, limit=65536))
        (self.folder / "old.exr").write_text("old")
        self.addCleanup((self.folder / "old.exr").unlink)
        self.assertIn("--force", self.run_view("old.exr", code=IO))
        self.assertEqual((self.folder / "old.exr").read_text(), "old")


if __name__ == "__main__":
    unittest.main()
