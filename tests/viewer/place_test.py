"""Where things are in the window: what `fit` frames, and balls at the ground's end. On a real X server, by
mouse and keys."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display  # noqa: E402
from viewer import Viewer  # noqa: E402

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
SIZE = (1000, 600)
PANEL_END = 436  # pixels


class PlaceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-view-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        for ground in ("sphere", "plane"):
            subprocess.run([SWARD, "bake", ground, "--count", "1000", "--blade-scale", "4", "-o",
                            cls.folder / f"{ground}.sward", "-q"], check=True)

    def setUp(self):
        self.display = Display()
        self.addCleanup(self.display.close)

    def open(self, ground, *arguments):
        viewer = Viewer(VIEWER, self.display, self.folder,
                        [self.folder / f"{ground}.sward", *arguments, "--size", "{}x{}".format(*SIZE)])
        self.addCleanup(viewer.close)
        viewer.wait_for_field()
        return viewer

    def assert_ends_well(self, viewer):
        code, said = viewer.end()
        self.assertEqual(code, 0, said)
        self.assertIn("0 validation messages", said)

    def columns_of_the_planet(self, viewer, begin):
        """The first and last column of the picture, from `begin` on, in which there is no sky."""
        viewer.away()
        left, top, _, _ = viewer.window.geometry()
        rows = self.display.picture(left, top + SIZE[1] // 2, SIZE[0], 1)
        blues = [x for x, (blue, _, red) in enumerate(rows[0]) if x >= begin and blue < red + 10]
        return blues[0], blues[-1]

    def test_fit_shows_the_field_beside_an_open_panel(self):
        viewer = self.open("sphere", "--panel", "physics")
        viewer.key("space")
        for begin, panel in ((PANEL_END, "Physics"), (100, None)):
            with self.subTest(panel=panel):
                viewer.open_panel(panel)
                viewer.drag((700, 300), (760, 320))
                viewer.key("f")
                first, last = self.columns_of_the_planet(viewer, begin)
                free_begin = begin if panel else 0
                self.assertGreater(first, begin, "nothing of it is covered")
                self.assertLess(last, SIZE[0] - 1)
                self.assertAlmostEqual((first + last) / 2, (free_begin + SIZE[0]) / 2, delta=25)
        self.assert_ends_well(viewer)

    def test_a_ball_thrown_over_the_edge_falls(self):
        viewer = self.open("plane", "--panel", "colliders", "--camera", "top")
        viewer.press("Add ball", panel="Colliders")
        viewer.wait(lambda: viewer.controls().get("Picture/Collider 1"), "the ball is seen")
        place = lambda: [float(word) for word in viewer.shows("Colliders/Collider 1").split()]
        begin = place()
        ball = viewer.controls()["Picture/Collider 1"]
        x, y = round(ball["x"]), round(ball["y"])
        # In steps, so that it is fast when it is let go; beyond the edge there is no ground to lie on.
        for _ in range(6):
            ball = viewer.controls()["Picture/Collider 1"]
            x, y = round(ball["x"]), round(ball["y"])
            viewer.drag((x, y), (x, y - 160), steps=4)
            if place()[1] < begin[1] - 1:
                break
        viewer.wait(lambda: place()[1] < begin[1] - 1, "it falls")
        self.assert_ends_well(viewer)

    def test_the_time_of_day_moves_and_colours_the_sun(self):
        viewer = self.open("plane", "--panel", "look", "--camera", "eye")
        shown = lambda name: [float(word) for word in viewer.shows(f"Look/{name}").split()]
        rising = shown("Elevation")[0]
        self.assertAlmostEqual(shown("Time of day")[0], 8.5, delta=1, msg="in the morning")
        viewer.set("Time of day", "Look", 0.5)
        viewer.wait(lambda: shown("Elevation")[0] > rising + 10, "it is noon")
        noon, azimuth = shown("Sunlight"), shown("Azimuth")[0]
        viewer.set("Time of day", "Look", 0.735)
        viewer.wait(lambda: shown("Elevation")[0] < rising - 20, "it is evening")
        evening = shown("Sunlight")
        self.assertGreater(abs(shown("Azimuth")[0] - azimuth), 60)
        self.assertGreater(evening[0] / evening[2], 1.3 * noon[0] / noon[2], "redder")
        # The azimuth can still be turned, and the hour stays.
        hour = shown("Time of day")[0]
        viewer.set("Azimuth", "Look", 0.5)
        viewer.wait(lambda: abs(shown("Azimuth")[0]) < 10, "it is turned")
        self.assertAlmostEqual(shown("Time of day")[0], hour, delta=0.1)
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
