"""Each program starts and does what it is for, in seconds: what a quick run holds beside the unit tests."""

import csv
import os
import subprocess
import sys
import unittest
from pathlib import Path

from png import picture_of

sys.path.append(str(Path(__file__).resolve().parents[1]))
from support import CliTest, DIFFERENCE, DONE  # noqa: E402

VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
BLADES = 500


class Smoke(CliTest):
    def view(self, *arguments):
        """Runs sward-view, which must succeed; returns what it prints."""
        done = subprocess.run([VIEWER, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        return done.stdout

    def test_both_programs_tell_their_version_and_their_commands(self):
        self.assertRegex(self.sward("--version").stdout, r"^sward \d+\.\d+\.\d+\n$")
        self.assertRegex(self.view("--version"), r"^sward-view \d+\.\d+\.\d+\n$")
        self.assertIn(" bake ", self.sward("--help").stdout)
        self.assertIn(" render ", self.view("--help"))

    def test_a_field_is_baked_read_compared_and_exported(self):
        field = self.bake("plane", "--count", BLADES)
        self.assertEqual(self.info(field)["blades"], BLADES)
        self.sward("validate", field)
        other = self.bake("plane", "--count", BLADES, "--seed", "2", to="other.sward")
        self.sward("compare", field, field)
        self.sward("compare", field, other, code=DIFFERENCE)
        self.sward("export", field, "-o", "field.csv")
        with open(self.folder / "field.csv", encoding="ascii", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len({row["id"] for row in rows}), BLADES)

    def test_a_device_is_listed_and_draws_grass(self):
        self.assertRegex(self.view("devices"), r"^0 +\S")
        self.bake("plane", "--count", 4 * BLADES, "--blade-scale", "3", "--meadow", "grass")
        draw = ("render", "field.sward", "--size", "64x36", "--camera", "eye", "-q", "--force", "--geometry")
        self.view(*draw, "raster", "-o", "grass.png", "--validation")
        self.view(*draw, "tessellation", "-o", "bare.png", "--draw-distance", "0.001")
        grass, bare = (picture_of(self.folder / f"{name}.png") for name in ("grass", "bare"))
        self.assertEqual(grass.shape, (36, 64, 3))
        blades = (grass != bare).any(axis=-1)
        self.assertGreater(blades.mean(), 0.2, "blades cover much of the picture")
        red, green, blue = grass[blades].mean(axis=0)
        self.assertGreater(green, red)
        self.assertGreater(green, blue)


if __name__ == "__main__":
    unittest.main()
