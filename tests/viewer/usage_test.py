"""What a user expects of the window without reading: where things appear, what keys do, what is covered. On
a real X server, by mouse and keys."""

import json
import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window_case import WindowCase  # noqa: E402

PANEL_END = 436  # pixels


class UsageCase(WindowCase):
    SIZE = (1000, 700)

    def rows(self, viewer, control):
        """The pixels of a control on the screen."""
        left, top, _, _ = viewer.window.geometry()
        return self.display.picture(left + round(control["x"]), top + round(control["y"]),
                                    round(control["width"]), round(control["height"]))


class OneViewerTest(UsageCase):
    """One viewer for all tests."""

    def setUp(self):
        super().setUp()
        self.viewer = self.open_kept()

    def test_a_click_that_meets_no_blade_says_so(self):
        viewer = self.viewer
        viewer.click_at(self.SIZE[0] - 40, 60)
        viewer.wait_for_value("Message/Notice", lambda shown: "No blade" in shown, "it says so")

    def test_labels_of_the_rail_begin_at_one_edge(self):
        viewer = self.viewer
        viewer.away()
        begins = []
        for name, control in viewer.controls().items():
            if not name.startswith("Rail/"):
                continue
            rows = self.rows(viewer, control)
            begins.append(min(x for row in rows for x, pixel in enumerate(row) if max(pixel) > 90))
        self.assertEqual(len(begins), 11)
        # Letters have side bearings of a pixel or two.
        self.assertLessEqual(max(begins) - min(begins), 2, begins)

    def test_tooltips_cover_no_control_and_grabs_no_number(self):
        viewer = self.viewer
        viewer.open_panel("Physics")
        viewer.away()
        controls = {name: control for name, control in viewer.controls().items()
                    if name.startswith(("Physics/", "Rail/")) and control["width"] > 0}
        for name in ("Physics/Strength", "Physics/Now", "Rail/Capture"):
            with self.subTest(control=name):
                self.display.xdotool("mousemove", "--window", viewer.window.number, *viewer.centre(name))
                viewer.wait(lambda: viewer.shows(f"Tooltip/{name}"), "the tooltip is there")
                viewer.wait_frames(3)
                tip = viewer.controls()[f"Tooltip/{name}"]
                self.assertGreater(tip["width"], 50)
                self.assertLessEqual(tip["y"] + tip["height"], self.SIZE[1])
                own = name.split("/")[0]
                for other, control in controls.items():
                    if other.startswith(own):
                        apart = (tip["x"] >= control["x"] + control["width"] or
                                 tip["x"] + tip["width"] <= control["x"] or
                                 tip["y"] >= control["y"] + control["height"] or
                                 tip["y"] + tip["height"] <= control["y"])
                        self.assertTrue(apart, f"it covers {other}")
        # Within a slider nothing is as light as a number; beside it there is one.
        viewer.away()
        for name in ("Physics/Strength", "Physics/Recovery"):
            slider = viewer.controls()[name]
            self.assertFalse(any(blue > 150 for row in self.rows(viewer, slider) for blue, _, _ in row), name)
            beside = {**slider, "x": slider["x"] + slider["width"], "width": 60}
            self.assertTrue(any(blue > 150 for row in self.rows(viewer, beside) for blue, _, _ in row), name)


class UsageTest(UsageCase):
    def place(self, viewer, number):
        viewer.wait(lambda: viewer.shows(f"Colliders/Collider {number}"), f"there is collider {number}")
        return [float(word) for word in viewer.shows(f"Colliders/Collider {number}").split()]

    def in_the_middle(self, viewer, number):
        """A collider lies near the middle of the picture that the panel leaves."""
        control = viewer.wait(lambda: viewer.controls().get(f"Picture/Collider {number}"), "it is seen")
        self.assertAlmostEqual(control["x"], (PANEL_END + self.SIZE[0]) / 2, delta=60)
        self.assertAlmostEqual(control["y"], self.SIZE[1] / 2, delta=60)

    def test_colliders_appear_where_the_camera_looks_and_beside_one_another(self):
        viewer = self.open(self.field("plane", 1500, 4), "--panel", "colliders", "--camera", "top")
        viewer.key("space")
        for number in range(1, 5):
            viewer.press("Add ball", panel="Colliders")
            self.place(viewer, number)
        radius = float(viewer.shows("Colliders/Radius"))
        self.in_the_middle(viewer, 1)
        places = [self.place(viewer, number) for number in range(1, 5)]
        for i, one in enumerate(places):
            for other in places[:i]:
                self.assertGreater(math.dist(one, other), 2 * radius, places)
        viewer.drag((700, 400), (820, 300), button=2)
        viewer.press("Add capsule", panel="Colliders")
        moved = self.place(viewer, 5)
        self.in_the_middle(viewer, 5)
        self.assertGreater(math.dist(moved, places[0]), 4 * radius)
        self.assert_ends_well(viewer)

    def eye(self, viewer, name):
        viewer.type_anew("File", "Camera", name)
        viewer.press("Save this camera", panel="Camera")
        viewer.wait((self.folder / name).exists, "the camera is written")
        camera = json.loads((self.folder / name).read_text())
        return (camera[0] if isinstance(camera, list) else camera)["eye"]

    def test_an_orbit_stays_above_the_ground(self):
        viewer = self.open(self.field("plane", 1500, 4), "--panel", "camera", "--camera", "eye")
        viewer.key("space")
        before = self.eye(viewer, "a.json")
        self.assertGreater(before[1], 0)
        for drag in (((700, 300), (720, 120)), ((700, 500), (690, 100))):
            viewer.drag(*drag)
        after = self.eye(viewer, "b.json")
        self.assertGreater(after[1], 0, "it is above the plane at height 0")
        self.assertNotEqual(before, after)
        self.assert_ends_well(viewer)

    def test_enter_in_the_name_opens_it(self):
        self.field("plane")
        viewer = self.open(self.field("hills"), "--panel", "field")
        viewer.press("Name", panel="Field")
        viewer.type("plane.sward")
        viewer.wait_for_value("Field/Name", lambda shown: shown == "plane.sward", "it is typed")
        self.display.xdotool("key", "--window", viewer.window.number, "Return")
        viewer.wait_for_value("Field/File", lambda shown: shown.endswith("plane.sward"), "it is opened")
        self.assert_ends_well(viewer)

    def test_a_light_brighter_than_white_has_a_hue_and_an_intensity(self):
        viewer = self.open(self.field(), "--panel", "look")
        channels = lambda: [float(word) for word in viewer.shows("Look/Sunlight").split()]
        before, intensity = channels(), float(viewer.shows("Look/Sunlight intensity"))
        self.assertGreater(intensity, 1)
        self.assertAlmostEqual(max(before), intensity, delta=0.01)
        viewer.away()
        swatch = self.rows(viewer, viewer.controls()["Look/Sunlight"])
        self.assertLess(swatch[10][10][0], 245, "the swatch shows the hue of the sun, not white")
        viewer.set("Sunlight intensity", "Look", 0.9)
        viewer.wait(lambda: max(channels()) > 2 * intensity, "it is brighter")
        after = channels()
        for one, other in zip(before, after):
            self.assertAlmostEqual(one / max(before), other / max(after), delta=0.01)
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
