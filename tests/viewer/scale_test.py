"""The size of text and controls: the desktop's, an option's, and the user's, on a real X server."""

import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display  # noqa: E402
from window_case import VIEWER, WindowCase  # noqa: E402

DARK = 56  # panels are darker, over a white picture too; the sky and sunlit ground are lighter


class ScaleCase(WindowCase):
    SIZE = (1200, 780)

    def open(self, *arguments, dots_per_inch=None, size=None):
        # Without dots per inch: a desktop that asks for no size.
        self.display.set_resources(f"Xft.dpi:\t{dots_per_inch}\n" if dots_per_inch else "")
        viewer = super().open(self.field(), "--panel", "physics", *arguments, size=size)
        viewer.away()
        return viewer

    def sizes(self, viewer):
        """Measured on the screen: the height of the letters of a label, the width of rail and panel,
        the height of the status bar; and the height of a slider, which it tells."""
        viewer.wait_frames(3)
        control = viewer.controls()["Physics/Strength"]
        left, top, width, height = viewer.window.geometry()
        rows = self.display.picture(left, top, width, height)
        middle = int(control["y"] + control["height"] / 2)
        # The label stands to the left of its slider; its letters are lighter than the panel.
        rail = int(viewer.controls()["Rail/Field"]["x"] + viewer.controls()["Rail/Field"]["width"])
        lines = [y for y in range(int(control["y"]), int(control["y"] + control["height"]))
                 if any(max(pixel) > 80 for pixel in rows[y][rail + 12:int(control["x"]) - 4])]
        # The panel ends where it is light, between two controls.
        gap = rows[int(control["y"] + control["height"]) + 2]
        is_panel = lambda pixel: max(pixel) < DARK
        panel = next(x for x in range(rail + 4, width) if not is_panel(gap[x]))
        # Nothing is written at the right end of the status bar.
        status = next(y for y in range(height) if not is_panel(rows[height - 1 - y][width - 4]))
        self.assertLess(middle, height)
        return {"letters": max(lines) - min(lines) + 1, "panel": panel, "status": status,
                "slider": control["height"]}

    def assert_factor(self, sizes, other, factor):
        for name, size in sizes.items():
            # Letters and edges end at whole pixels.
            self.assertAlmostEqual(other[name], factor * size, delta=max(2, 0.06 * factor * size), msg=name)

    def hits(self, viewer):
        """A slider of this size is hit in its middle and near its lower edge."""
        control = viewer.controls()["Physics/Strength"]
        self.assertGreater(abs(float(viewer.shows("Physics/Strength")) - 20), 2)
        viewer.click_at(round(control["x"] + 0.5 * control["width"]),
                        round(control["y"] + 0.9 * control["height"]))
        self.assertAlmostEqual(float(viewer.shows("Physics/Strength")), 20, delta=1)

    def keys_change_it(self, viewer, usual):
        """While it runs."""
        for _ in range(4):
            viewer.key("ctrl+plus")
        viewer.wait(lambda: viewer.controls()["Physics/Strength"]["height"] > 1.3 * usual["slider"],
                    "it is larger")
        viewer.away()
        self.assert_factor(usual, self.sizes(viewer), 1.1 ** 4)
        self.hits(viewer)
        viewer.key("ctrl+minus")
        viewer.away()
        self.assert_factor(usual, self.sizes(viewer), 1.1 ** 3)
        viewer.key("ctrl+0")
        viewer.away()
        self.assert_factor(usual, self.sizes(viewer), 1)


class ScaleTest(ScaleCase):
    def test_it_follows_the_content_scale_and_keys_change_it(self):
        viewer = self.open()
        usual = self.sizes(viewer)
        self.keys_change_it(viewer, usual)
        self.assert_ends_well(viewer)

        viewer = self.open(dots_per_inch=192)
        self.assert_factor(usual, self.sizes(viewer), 2)
        # The whole rail is in sight.
        rail = [control for name, control in viewer.controls().items() if name.startswith("Rail/")]
        self.assertLess(max(control["y"] + control["height"] for control in rail),
                        viewer.window.geometry()[3] - 2 * usual["status"])
        self.hits(viewer)
        self.assert_ends_well(viewer)

    def test_a_size_out_of_range_is_refused(self):
        field = self.field()
        for value in ("0.4", "4.1", "nan", "large"):
            with self.subTest(value=value):
                done = subprocess.run([VIEWER, field, "--ui-scale", value], capture_output=True,
                                      text=True, env={**os.environ, "DISPLAY": self.display.name})
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("--ui-scale", done.stderr)
                self.assertIn(value, done.stderr)


class LongScaleTest(ScaleCase):
    def test_the_option_overrides_the_content_scale(self):
        viewer = self.open()
        usual = self.sizes(viewer)
        self.assert_ends_well(viewer)

        viewer = self.open("--ui-scale", "1", dots_per_inch=192)
        self.assert_factor(usual, self.sizes(viewer), 1)
        self.assert_ends_well(viewer)

        viewer = self.open("--ui-scale", "1.5", dots_per_inch=96)
        self.assert_factor(usual, self.sizes(viewer), 1.5)
        self.hits(viewer)
        self.assert_ends_well(viewer)

    def test_a_window_without_a_size_grows_within_the_screen(self):
        viewer = self.open(dots_per_inch=144, size=False)
        self.assertEqual(viewer.window.geometry()[2:], (Display.WIDTH, Display.HEIGHT))
        self.assert_ends_well(viewer)
        viewer = self.open(dots_per_inch=96, size=False)
        self.assertEqual(viewer.window.geometry()[2:], (1280, 720))
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
