"""The blades of a frame stand in a traced picture as in the frame."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "trace"))

from exr import read_exr

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}


class TracedBlades(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-traced-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments):
        done = subprocess.run(arguments, cwd=self.folder, env=ENVIRONMENT, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def seen(self, *options):
        """What the middles of the pixels show."""
        self.run_program(SWARD, "trace", "f.sward", "-o", "p.exr", "--force", "--size", "160x90", "--samples", "1",
                         "--eye", "0,0.8,1.6", "--target", "0,0.1,0", "--layers", "blade", *options)
        return read_exr(self.folder / "p.exr")[1]["blade.id"]

    def dump(self, *options):
        self.run_program(VIEWER, "render", "f.sward", "-o", "p.png", "--force", "--size", "64x36", "--samples", "1",
                         "--dump-blades", "d.csv", *options)

    def test_a_calm_frame_has_the_blades_at_rest_and_a_windy_one_has_not(self):
        # Grass, and flowers with ribbons.
        self.run_program(SWARD, "bake", "plane", "--scale", "0.2", "--count", "3000", "--blade-scale", "1",
                         "-o", "f.sward")
        resting = self.seen()
        self.assertGreater(len(set(resting)), 500)
        self.dump("--wind-strength", "0")
        calm = self.seen("--blades", "d.csv")
        # A stored direction is rounded to 1e-5.
        self.assertLess(sum(a != b for a, b in zip(resting, calm)), 0.002 * len(resting))
        self.dump("--wind-strength", "5")
        windy = self.seen("--blades", "d.csv")
        self.assertGreater(sum(a != b for a, b in zip(resting, windy)), 0.2 * len(resting))


if __name__ == "__main__":
    unittest.main()
