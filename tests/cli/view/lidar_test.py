"""`sward-view lidar`: a field as a range sensor measures it on a device, against `sward lidar`."""

import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import numpy as np

from support import DONE, INPUT, UNSUPPORTED, USAGE, CliTest, digest

VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
SCANNER = ("--scanner", "0,0", "--above", "1.5", "--rings", "16", "--columns", "128", "--elevation", "-60:5", "--rays", "3",
           "--resolution", "0.02")


class DeviceLidar(CliTest):
    def setUp(self):
        super().setUp()
        self.bake("hills", "--scale", "0.2", "--count", "6000", to="f.sward")

    def view(self, *arguments, code=DONE, environment=None):
        done = subprocess.run([VIEWER, *arguments], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, **(environment or {})})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def points(self, *options):
        self.view("lidar", "f.sward", "-o", "d.npy", "--force", *options)
        return np.load(self.folder / "d.npy")

    def by_embree(self, *options):
        self.sward("lidar", "f.sward", "-o", "e.npy", "--force", *options)
        return np.load(self.folder / "e.npy")

    def assert_alike(self, a, b):
        """The same returns of at least 99.5 % of the pulses."""
        keys = [{(p["beam"], p["number"], p["returns"], p["id"], p["species"], round(float(p["range"]), 3)) for p in points}
                for points in (a, b)]
        beams = {key[0] for key in keys[0] | keys[1]}
        self.assertGreater(len(beams), 1000)
        self.assertLess(len({key[0] for key in keys[0] ^ keys[1]}), 0.005 * len(beams))

    def test_points_are_those_of_the_ray_caster(self):
        self.assert_alike(self.points(*SCANNER), self.by_embree(*SCANNER))

    def test_wind_moves_the_blades_as_a_picture_shows_them(self):
        wind = ("--wind-strength", "6")
        self.view("render", "f.sward", "-o", "p.png", "--size", "16x16", "--samples", "1", "--cull", "none", "--lod", "off",
                  "--frames", "12:12", "--dump-blades", "blades.csv", *wind)
        windy = self.points(*SCANNER, *wind, "--time", "0.2")
        self.assert_alike(windy, self.by_embree(*SCANNER, "--blades", "blades.csv"))
        calm = self.points(*SCANNER)
        self.assertNotEqual(len(calm), len(windy))

    def test_all_formats_and_any_number_of_threads_have_the_same_points(self):
        points = self.points(*SCANNER, "--threads", "1")
        first = digest(self.folder / "d.npy")
        self.points(*SCANNER, "--threads", "3")
        self.assertEqual(digest(self.folder / "d.npy"), first)
        for name in ("d.ply", "d.las"):
            self.view("lidar", "f.sward", "-o", name, *SCANNER)
            self.assertIn(len(points) * {"d.ply": 56, "d.las": 30}[name] // 10000, [(self.folder / name).stat().st_size // 10000 + i for i in (-1, 0)])

    def test_without_an_output_it_tells_counts_and_rates(self):
        said = self.view("lidar", "f.sward", "--airborne", "20", "--sweep", "15", "--spacing", "0.1").stdout
        self.assertRegex(said, r"^\d+ points of \d+ pulses; [\d.]+ % of the rays met the ground, [\d.]+ % nothing; "
                               r"[\d.]+ million pulses a second on .+, [\d.]+ million counted\n$")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["f.sward"])

    def test_wrong_beams_and_options_are_refused_and_nothing_is_left(self):
        beams = np.tile([0.0, 5.0, 0.0, 0.0, -1.0, 0.0], (10, 1))
        beams[3, 1] = np.nan
        np.save(self.folder / "nan.npy", beams)
        beams[3, 1:] = 0
        np.save(self.folder / "still.npy", beams)
        before = self.files()
        for options, code, words in ((("--beams", "nan.npy"), INPUT, "nan.npy: row 3: y is nan"),
                                     (("--beams", "still.npy"), INPUT, "still.npy: row 3: dx dy dz are 0, 0, 0"),
                                     ((), USAGE, "exactly one of"),
                                     (("--airborne", "5", "--sweep", "5", "--tilt", "5"), USAGE, "--sweep and --tilt"),
                                     (("--airborne", "5", "--time", "1", "--blades", "b.csv"), USAGE, "--blades")):
            with self.subTest(options):
                self.assertIn(words, self.view("lidar", "f.sward", "-o", "w.npy", *options, code=code).stderr)
                self.assertEqual(self.files(), before)

    def test_a_machine_without_a_device_is_told_so(self):
        nothing = {"VK_ICD_FILENAMES": "/nonexistent.json", "VK_DRIVER_FILES": "/nonexistent.json"}
        said = self.view("lidar", "f.sward", "-o", "w.npy", "--airborne", "5", code=UNSUPPORTED, environment=nothing).stderr
        self.assertIn("mesa-vulkan-drivers", said)
        self.assertFalse((self.folder / "w.npy").exists())


if __name__ == "__main__":
    unittest.main()
