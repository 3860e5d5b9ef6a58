"""Where things are in the window: what `fit` frames, and balls at the ground's end. On a real X server, by
mouse and keys."""

import json
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window_case import WindowCase  # noqa: E402

PANEL_END = 436  # pixels


class PlaceTest(WindowCase):
    SIZE = (1000, 600)

    def columns_of_the_planet(self, viewer, begin):
        """The first and last column of the picture, from `begin` on, in which there is no sky."""
        viewer.away()
        left, top, _, _ = viewer.window.geometry()
        rows = self.display.picture(left, top + self.SIZE[1] // 2, self.SIZE[0], 1)
        blues = [x for x, (blue, _, red) in enumerate(rows[0]) if x >= begin and blue < red + 10]
        return blues[0], blues[-1]

    def test_fit_shows_the_field_beside_an_open_panel(self):
        viewer = self.open(self.field("sphere", 1000, 4), "--panel", "physics")
        viewer.key("space")
        for begin, panel in ((PANEL_END, "Physics"), (100, None)):
            with self.subTest(panel=panel):
                viewer.open_panel(panel)
                viewer.drag((700, 300), (760, 320))
                viewer.key("f")
                first, last = self.columns_of_the_planet(viewer, begin)
                free_begin = begin if panel else 0
                self.assertGreater(first, begin, "nothing of it is covered")
                self.assertLess(last, self.SIZE[0] - 1)
                self.assertAlmostEqual((first + last) / 2, (free_begin + self.SIZE[0]) / 2, delta=25)
        self.assert_ends_well(viewer)

    def throw(self, viewer, begin, end):
        """Drags in the time of a few frames, and lets go at once: what is held is fast then."""
        steps = [[begin[k] + (end[k] - begin[k]) * i // 8 for k in (0, 1)] for i in range(1, 9)]
        to = ("mousemove", "--window", viewer.window.number)
        self.display.xdotool(*to, *begin, "mousedown", 1)
        viewer.wait_frames(2)
        self.display.xdotool(*(word for step in steps for word in (*to, *step, "sleep", 0.03)), "mouseup", 1)
        viewer.wait_frames(2)

    def test_a_ball_thrown_over_the_edge_falls(self):
        viewer = self.open(self.field("plane", 1000, 4), "--panel", "colliders", "--camera", "top")
        viewer.press("Add ball", panel="Colliders")
        viewer.wait(lambda: viewer.controls().get("Picture/Collider 1"), "the ball is seen")
        place = lambda: [float(word) for word in viewer.shows("Colliders/Collider 1").split()]
        begin = place()

        def has_fallen():
            return place()[1] < begin[1] - 1

        def lies_still():
            before = place()
            viewer.wait_frames(3)
            return place() == before

        for _ in range(6):
            ball = viewer.controls()["Picture/Collider 1"]
            x, y = round(ball["x"]), round(ball["y"])
            # Beyond the edge there is no ground to lie on.
            self.throw(viewer, (x, y), (x, y - 160))
            viewer.wait(lambda: has_fallen() or lies_still(), "it falls, or lies still")
            if has_fallen():
                break
        self.assertTrue(has_fallen())
        self.assert_ends_well(viewer)

    def test_the_time_of_day_moves_and_colours_the_sun(self):
        viewer = self.open(self.field("plane", 1000, 4), "--panel", "look", "--camera", "eye")
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


class LongPlaceTest(WindowCase):
    SIZE = (1000, 600)

    def assert_shows_all(self, viewer):
        """Ground and grass lie in the free part of the window and nearly fill it."""
        viewer.away()
        controls, (left, top, width, height) = viewer.controls(), viewer.window.geometry()
        begin = round(controls["Panel/Width"]["x"])
        end = round(controls["Status/Numbers"]["y"]) - 12
        rows = self.display.picture(left + begin, top, width - begin, end)
        is_field = rows[..., 0] < rows[..., 2] + 10  # the sky is blue
        across, upward = is_field.any(axis=0).nonzero()[0], is_field.any(axis=1).nonzero()[0]
        self.assertGreater(width - begin, 0.25 * width, "the panel leaves room")
        self.assertGreater(across[0], 2)
        self.assertLess(across[-1], width - begin - 3)
        self.assertGreater(upward[0], 2)
        self.assertLess(upward[-1], end - 3)
        self.assertGreater(max((across[-1] - across[0]) / (width - begin), (upward[-1] - upward[0]) / end), 0.7)
        self.assertAlmostEqual((across[0] + across[-1]) / 2, (width - begin) / 2, delta=0.05 * width)

    def test_fit_cuts_nothing_off_however_large_panel_and_controls_are(self):
        field = self.field("hills", 1000, 4)
        # Under a sky that is not above it, it stands on no floor.
        tilted = self.folder / "tilted.json"
        tilted.write_text(json.dumps({"look": {"up": [0.3, 1, 0]}}))
        for panel, size, scale in (("field", (1100, 640), 1), ("look", (1000, 600), 2)):
            with self.subTest(panel=panel, scale=scale):
                viewer = self.open(field, "--panel", panel, "--ui-scale", scale, "--wind-strength", "0",
                                   "--settings", tilted, size=size)
                self.assert_shows_all(viewer)  # it begins so
                viewer.drag((900, 300), (940, 320))
                viewer.key("f")
                self.assert_shows_all(viewer)
                viewer.drag((900, 300), (940, 320))
                viewer.key("1")
                self.assert_shows_all(viewer)
                if scale == 2:
                    self.assert_ends_well(viewer)
                    continue
                # A panel is dragged narrower, and wider again.
                x = round(viewer.controls()["Panel/Width"]["x"])
                viewer.drag((x + 2, 300), (x - 118, 300))
                viewer.wait_for_value("Panel/Width", lambda shown: abs(int(shown) - 220) < 8, "it is narrower")
                viewer.key("f")
                self.assert_shows_all(viewer)
                self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
