"""The default sward: how much of the ground it covers, and how it looks where a budget thinned it."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from png import linear_mean_of, picture_of, pixels_of

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
# Three times the size of real blades: a ninth as many.
SCALE = 3

# Bright ground of 20 m × 20 m. Its colour is not neutral: ground in plain white gets soil.
PINK = "newmtl pink\nKd 1 0.7 0.7\n"
PINK_PLANE = "mtllib pink.mtl\nusemtl pink\nv -10 0 -10\nv -10 0 10\nv 10 0 10\nv 10 0 -10\nvn 0 1 0\n" \
             "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n"


# A box of 2 m × 1 m × 2 m without a bottom.
BOX = "v -1 0 1\nv 1 0 1\nv 1 1 1\nv -1 1 1\nv -1 0 -1\nv 1 0 -1\nv 1 1 -1\nv -1 1 -1\n" \
      "f 4 3 7 8\nf 1 2 3 4\nf 6 5 8 7\nf 2 6 7 3\nf 5 1 4 8\n"


class SwardTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-sward-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def bake(self, ground, *options):
        field = self.folder / "f.sward"
        done = subprocess.run([SWARD, "bake", ground, "--blade-scale", str(SCALE), "-o", field, "--force", *options],
                              env=ENVIRONMENT, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return field, done.stderr

    def draw(self, field, eye, fov, *options, size="160x120", way="tessellation"):
        camera = {"eye": eye, "target": [0, 0, 0], "up": [0, 0, -1], "fov_y_deg": fov}
        (self.folder / "camera.json").write_text(json.dumps(camera), encoding="utf-8")
        done = subprocess.run([VIEWER, "render", field, "-o", "p.png", "--force", "--size", size, "--camera",
                               "camera.json", "--geometry", way, *options], cwd=self.folder, env=ENVIRONMENT, text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / "p.png"

    def covered(self, meadow):
        """Share of the pixels from above that show a blade. The debug mode draws ground in grey."""
        field, _ = self.bake("plane", "--meadow", meadow)
        pixels = pixels_of(self.draw(field, [0, 30, 0], 15, "--debug", "patches", "--samples", "1", size="160x160"))
        return (pixels.max(axis=1) - pixels.min(axis=1) > 6).mean()

    def test_the_built_in_meadow_covers_85_per_cent_of_the_ground(self):
        self.assertGreater(self.covered("meadow"), 0.85)
        # What a thinner meadow covers is what it states.
        self.assertAlmostEqual(self.covered("steppe"), 0.6, delta=0.2)

    def test_a_thinned_meadow_is_as_bright_from_afar(self):
        # With plants, a tenth of the blades is 5.4 % darker and as much greener: panicles are bright and red (docs/algorithms/shading.md).
        for meadow, error in (("grass", 0.03), ("meadow", 0.06)):
            with self.subTest(meadow=meadow):
                self.is_as_bright_from_afar(meadow, error)

    def is_as_bright_from_afar(self, meadow, error):
        whole = None
        (self.folder / "s.json").write_text('{"look": {"exposure": 1}}', encoding="utf-8")
        field, _ = self.bake("plane", "--meadow", meadow)
        told = json.loads(subprocess.run([SWARD, "info", field, "--json"], capture_output=True, check=True).stdout)
        # Drifts change the number of plants, and of their ribbons, on ground as small as this.
        blades = 1.2 * (told["blades"] + told.get("ribbons", 0))
        for share in (1, 0.1) if meadow == "grass" else (1, 0.5, 0.1):
            # What is compared are numbers of blades: not a dry patch that is as wide as this plane.
            field, said = self.bake("plane", "--meadow", meadow, "--set", "wide_variation=0", "--budget",
                                    str(int(share * blades)))
            self.assertEqual("--budget" in said, share < 1, said)
            light = linear_mean_of(self.draw(field, [0, 120, 400], 0.5, "--settings", "s.json"))
            whole = whole or light
            # Luminance, and hue as red to green: air adds most of the blue.
            luminance = [sum(k * c for k, c in zip((0.2126, 0.7152, 0.0722), one)) for one in (light, whole)]
            self.assertAlmostEqual(luminance[0] / luminance[1], 1, delta=error, msg=str(share))
            self.assertAlmostEqual(light[0] / light[1] * whole[1] / whole[0], 1, delta=error, msg=str(share))

    def test_bright_ground_does_not_bleach_the_sward(self):
        plane = self.folder / "pink.obj"
        plane.write_text(PINK_PLANE, encoding="utf-8")
        (self.folder / "pink.mtl").write_text(PINK, encoding="utf-8")
        field, _ = self.bake(plane)
        green = linear_mean_of(self.draw(field, [0, 12, 12], 30))
        self.assertLess(green[0], 0.9 * green[1])
        self.assertLess(green[2], 0.5 * green[1])
        # Thatch is what hides it.
        thin, _ = self.bake(plane, "--density", "60")
        (self.folder / "bare.json").write_text('{"look": {"thatch": 0}}', encoding="utf-8")

        def light(*options):
            # The tessellator would not draw the same bytes twice.
            return linear_mean_of(self.draw(thin, [0, 12, 12], 30, *options, size="80x60", way="raster"))
        hidden, bare = light(), light("--settings", "bare.json")
        self.assertGreater(sum(bare), 1.05 * sum(hidden))
        # The option says the same as the settings, and overrides them.
        self.assertEqual(light("--thatch", "0"), bare)
        self.assertEqual(light("--settings", "bare.json", "--thatch", "1"), hidden)

    def test_the_edge_of_a_solid_is_no_black_slit(self):
        box = self.folder / "box.obj"
        box.write_text(BOX, encoding="utf-8")
        camera = {"eye": [3.2, 1.9, 0], "target": [1, 0.9, 0], "fov_y_deg": 30}
        (self.folder / "edge.json").write_text(json.dumps(camera), encoding="utf-8")
        # By the formula of shade alone: shadows of blades near the eye brighten a gap.
        (self.folder / "s.json").write_text('{"look": {"blade_shadows": false}}', encoding="utf-8")

        def slit(*options):
            """The light of the darkest rows near the edge, relative to the median row."""
            field, _ = self.bake(box, "--meadow", "grass", "--set", "species.*.height_m=[0.06,0.12]", *options)
            done = subprocess.run([VIEWER, "render", field, "-o", "p.png", "--force", "--size", "160x120", "--camera",
                                   "edge.json", "--settings", "s.json"], cwd=self.folder, env=ENVIRONMENT, text=True, capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            luminance = (picture_of(self.folder / "p.png") / 255.0) ** 2.2 @ (0.2126, 0.7152, 0.0722)
            rows = sorted(luminance.mean(axis=1).reshape(40, 3).mean(axis=1))
            return rows[0] / rows[20]
        # A path tracer has 0.35 here. Blades along their own face's normal leave a gap.
        self.assertGreater(slit(), 0.3)
        self.assertLess(slit("--set", "crease_blend=0"), 0.1)


if __name__ == "__main__":
    unittest.main()
