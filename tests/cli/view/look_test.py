"""Settings of the look, and the scenes of the gallery."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from png import mean_of
from soon import programs_that_start_soon

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ROOT = Path(__file__).resolve().parents[3]
# Pictures of scenes; scripts/any-ground makes the others.
KEPT = [path for path in (ROOT / "docs/gallery").glob("*.jpg") if not path.name.startswith("any-ground")]
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}


class LookTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-look-")
        cls.addClassCleanup(folder.cleanup)
        cls.field = Path(folder.name) / "f.sward"

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-look-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def render(self, look, code=0):
        if not self.field.exists():
            subprocess.run([SWARD, "bake", "plane", "--count", "1500", "-o", self.field, "-q"], check=True)
        (self.folder / "s.json").write_text(json.dumps({"look": look}), encoding="utf-8")
        done = subprocess.run([VIEWER, "render", self.field, "-o", "p.png", "--size", "64x36", "--force", "--camera",
                               "eye", "--geometry", "tessellation", "--settings", "s.json"], cwd=self.folder, env=ENVIRONMENT, text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stderr if code else mean_of(self.folder / "p.png")

    def test_sun_air_and_film_change_the_picture_as_they_should(self):
        usual = self.render({"clouds": 0})
        self.assertGreater(min(b - a for a, b in zip(usual, self.render({"clouds": 0, "exposure": 2}))), 10)
        evening = self.render({"clouds": 0, "sun": {"azimuth": 180, "elevation": 4}})
        self.assertLess(sum(evening), sum(usual))
        self.assertGreater(self.render({"clouds": 1})[0], usual[0])
        # Dense air: one colour, that of the sky near the horizon, with any ground.
        fog = self.render({"clouds": 0, "fog": 10})
        self.assertGreater(fog[2], usual[2])
        # An inverted up-vector: the sky is below, and the former horizon is haze.
        self.assertNotEqual(self.render({"clouds": 0, "up": [0, -1, 0]}), usual)

    def test_a_low_sun_warms_sky_and_air_but_not_what_settings_state(self):
        # Dense air shows the horizon alone.
        def warmth(elevation, **more):
            red, _, blue = self.render({"clouds": 0, "fog": 10, "exposure": 0.5, "sun": {"azimuth": 60, "elevation": elevation}, **more})[:3]
            return red / blue
        high, middle, low = (warmth(elevation) for elevation in (60, 24, 10))
        self.assertGreater(middle, 1.05 * high)
        self.assertGreater(low, 1.2 * high)
        sky = [0.42, 0.60, 0.92]
        self.assertAlmostEqual(warmth(60, sky=sky), high, delta=0.01)
        self.assertLess(warmth(10, sky=sky), 0.95 * low)

    def test_a_wrong_look_is_refused_by_name(self):
        for look, says in (({"sun": {"altitude": 3}}, "altitude"), ({"clouds": 1.5}, "look: clouds"),
                           ({"up": [0, 0, 0]}, "look: up"), ({"fogg": 1}, '"fogg"')):
            with self.subTest(look=look):
                self.assertIn(says, self.render(look, code=3))

class GalleryTest(unittest.TestCase):
    """scripts/gallery, which makes the pictures of docs/gallery.md."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-gallery-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def gallery(self, *arguments):
        if not (self.folder / "build").exists():
            programs_that_start_soon(self.folder / "build/bin")
        return subprocess.run([ROOT / "scripts" / "gallery", "--size", "96x54", "--out", self.folder / "out",
                               "--fields", self.folder / "fields", *map(str, arguments)], text=True,
                              env={**ENVIRONMENT, "SWARD_BUILD": str(self.folder / "build")},
                              capture_output=True)

    def drawn(self):
        """Names of the pictures that the gallery has made."""
        pictures = [path for path in (self.folder / "out").iterdir() if path.suffix == ".jpg"]
        for path in pictures:
            self.assertEqual(path.read_bytes()[:2], b"\xff\xd8")
        return {path.name for path in pictures}


class LongLook(GalleryTest):
    """A dozen pictures of all scenes."""

    def test_every_scene_of_the_gallery_bakes_and_is_drawn(self):
        done = self.gallery("--count", 300)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.drawn(), {path.name for path in KEPT})


class GalleryOfScenes(GalleryTest):
    def test_every_scene_of_the_gallery_has_pictures_on_its_page(self):
        names = {path.stem for path in (ROOT / "assets/scenes").glob("*.json") if ".camera" not in path.name}
        self.assertGreaterEqual(len(names), 6)
        self.assertEqual({path.stem.split("-")[0] for path in KEPT}, names)
        # They are small enough to be loaded with the page.
        page = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
        for path in KEPT:
            self.assertLessEqual(path.stat().st_size, 400_000, path.name)
            self.assertIn(f"gallery/{path.name}", page)

    def test_the_gallery_bakes_again_only_what_has_changed(self):
        self.assertEqual(self.gallery("--count", 200, "planet").returncode, 0)
        self.assertEqual(self.drawn(), {path.name for path in KEPT if path.name.startswith("planet")})
        field = self.folder / "fields" / "planet.sward"
        first = field.stat().st_mtime_ns
        self.assertEqual(self.gallery("--count", 200, "planet").returncode, 0)
        self.assertEqual(field.stat().st_mtime_ns, first)
        self.assertEqual(self.gallery("--count", 201, "planet").returncode, 0)
        self.assertGreater(field.stat().st_mtime_ns, first)
        wrong = self.gallery("plannet")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("planet", wrong.stderr)


if __name__ == "__main__":
    unittest.main()
