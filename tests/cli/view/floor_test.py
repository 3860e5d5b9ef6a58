"""The floor below ground that stands: lit, in the ground's shadow, and fading into the haze; none below a ball or a planet."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "scripts"))
import light_pictures  # noqa: E402

SWARD, VIEWER = os.environ["SWARD_PROGRAM"], os.environ["SWARD_VIEW_PROGRAM"]
# A box of 12 m × 1 m × 8 m whose top is at height 0.
SLAB = "".join(f"v {x} {y} {z}\n" for y in (0, -1) for x, z in ((-6, -4), (6, -4), (6, 4), (-6, 4))) + \
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"


class FloorTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-floor-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "slab.obj").write_text(SLAB, encoding="ascii")
        for name, options in (("slab.obj", ["--slope", "0:50"]), ("sphere", ["--ground-up", "radial"]), ("hills", [])):
            subprocess.run([SWARD, "bake", name, *options, "--count", "500", "--sky-rays", "0", "-o", f"{Path(name).stem}.sward", "-q"],
                           cwd=cls.folder, check=True, stdout=subprocess.DEVNULL)

    def seen(self, field, views, way="raster", elevation=30, **look):
        """Radiance along each view, an eye and a target, the sun in the east. A camera path has them all, one a second."""
        path = [{"time": i, "eye": eye, "target": target, "up": [0, 0, 1], "fov_y_deg": 1} for i, (eye, target) in enumerate(views)]
        (self.folder / "path.json").write_text(json.dumps(path), encoding="utf-8")
        look = {"sun": {"azimuth": 90, "elevation": elevation}, "fog": 0, "clouds": 0, **look}
        (self.folder / "look.json").write_text(json.dumps({"wind": [], "look": look}), encoding="utf-8")
        done = subprocess.run([VIEWER, "render", f"{field}.sward", "-o", "p%d.exr", "--size", "9x9", "--samples", "1", "--camera",
                               "path.json", "--frames", f"0:{len(views) - 1}", "--fixed-dt", "1", "--settings", "look.json",
                               "--geometry", way, "--force", "-q", "--validation"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [light_pictures.read(self.folder / f"p{i}.exr").mean(axis=(0, 1)) for i in range(len(views))]

    def floor(self, *places, **how):
        """The floor of the slab at each x, from six metres above."""
        return self.seen("slab", [([x, 5, -1], [x, -1, 0]) for x in places], **how)

    def test_it_is_lit_by_the_sun_and_shaded_by_the_ground(self):
        for way in ("raster", "tessellation"):
            with self.subTest(way=way):
                east, west, farther_east, farther_west = self.floor(6.8, -6.8, 8.5, -8.5, way=way)
                self.assertLess(west[0], 0.5 * east[0])
                # The shadow of a metre under a sun at 30° is 1.73 m long.
                np.testing.assert_allclose(farther_west, farther_east, rtol=0.01)
        # Behind the shadow map's box there is no shadow.
        east, west, far_east, far_west = self.floor(9.0, -9.0, 30.0, -30.0, elevation=10)
        self.assertLess(west[0], 0.85 * east[0])
        np.testing.assert_allclose(far_west[0], far_east[0], rtol=0.05)

    def test_it_is_darker_at_the_foot_and_fades_into_the_haze(self):
        foot, near, away = self.floor(6.05, 9.0, 400.0)
        self.assertLess(foot[2], 0.93 * near[2])
        self.assertGreater(near[0] / near[2], 1.2 * away[0] / away[2])
        # Under a sky that leans there is no floor.
        leaning, = self.floor(9.0, up=[0.3, 1, 0])
        self.assertLess(leaning[0] / leaning[2], 1.1 * away[0] / away[2])

    def test_sheets_have_one_and_planets_none(self):
        for field, has_one in (("hills", True), ("sphere", False)):
            with self.subTest(field=field):
                beside, = self.seen(field, [([28, 40, -10], [28, -4, 0])])
                self.assertEqual(bool(beside[0] > 0.85 * beside[2]), has_one)


if __name__ == "__main__":
    unittest.main()
