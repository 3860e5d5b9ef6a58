"""What a user expects of the window without reading: where things appear, what keys do, what is covered. On
a real X server, by mouse and keys."""

import json
import math
import signal
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

    def focus(self):
        return self.viewer.shows("Keyboard/Focus")

    def tab_to(self, name):
        for _ in range(40):
            if self.focus() == name:
                return
            self.viewer.key("Tab")
        self.fail(f"Tab does not reach {name}, but {self.focus()}")

    def test_tab_arrows_and_enter_change_what_the_mouse_changes(self):
        viewer = self.viewer
        viewer.open_panel("Culling")
        viewer.away()
        self.assertIsNone(self.focus())
        # Toggles: Space turns what has the focus, and does not pause.
        self.tab_to("Culling/Orientation")
        viewer.key("space")
        viewer.wait_for_value("Culling/Orientation", lambda shown: shown == "off", "it is turned off")
        self.assertNotIn("paused", viewer.shows("Status/Numbers"))
        viewer.key("Return")
        viewer.wait_for_value("Culling/Orientation", lambda shown: shown == "on", "it is turned on")
        viewer.key("shift+Tab")
        self.assertEqual(self.focus(), "Culling/Patch")
        # Sliders: right and left.
        self.tab_to("Culling/Detail threshold")
        before = float(viewer.shows("Culling/Detail threshold"))
        viewer.key("Right")
        viewer.wait_for_value("Culling/Detail threshold", lambda shown: float(shown) > before, "it is more")
        viewer.key("Left")
        viewer.wait_for_value("Culling/Detail threshold", lambda shown: abs(float(shown) - before) < 0.02 * before,
                              "it is as before")
        # Drop-downs: closed, and open.
        self.tab_to("Culling/Colour by")
        viewer.key("Down")
        viewer.wait_for_value("Culling/Colour by", lambda shown: shown == "level of detail", "the next")
        viewer.key("Return")
        viewer.wait(lambda: "Culling/Colour by wind" in viewer.controls(), "the list is open")
        viewer.wait_frames(2)
        viewer.key("Down")
        viewer.key("Down")
        self.assertEqual(self.focus(), "Culling/Colour by wind")
        viewer.key("Return")
        viewer.wait_for_value("Culling/Colour by", lambda shown: shown == "wind", "it is chosen")
        viewer.wait(lambda: "Culling/Colour by wind" not in viewer.controls(), "the list is closed")
        # One that the mouse has opened.
        viewer.click("Culling/Colour by")
        viewer.wait(lambda: "Culling/Colour by wind" in viewer.controls(), "the list is open")
        viewer.wait_frames(2)
        for _ in range(3):
            viewer.key("Up")
        viewer.key("Return")
        viewer.wait_for_value("Culling/Colour by", lambda shown: shown == "none", "it is chosen")
        # Without a focus keys mean what they do over the picture.
        viewer.away()
        viewer.click_at(self.SIZE[0] - 40, 60)
        self.assertIsNone(self.focus())
        viewer.key("space")
        viewer.wait_for_value("Status/Numbers", lambda shown: "paused" in shown, "it pauses")
        viewer.key("space")
        viewer.key("ctrl+h")
        viewer.wait(lambda: "Rail/Field" not in viewer.controls(), "the panels are hidden")
        viewer.key("ctrl+h")
        viewer.wait(lambda: "Rail/Field" in viewer.controls(), "the panels are back")

    def test_tab_reaches_text_fields_and_leaves_them(self):
        viewer = self.viewer
        viewer.open_panel("Field")
        viewer.away()
        self.tab_to("Field/Name")
        viewer.wait_frames(6)  # until it is scrolled into sight
        viewer.type("h.x")
        viewer.wait_for_value("Field/Name", lambda shown: shown == "h.x", "it is typed")
        self.assertNotIn("Keys/Close", viewer.controls())
        viewer.key("Tab")
        self.assertNotEqual(self.focus(), "Field/Name")
        viewer.type("h")
        viewer.wait(lambda: "Keys/Close" in viewer.controls(), "it is a key of the window again")
        self.assertEqual(viewer.shows("Field/Name"), "h.x")
        viewer.key("h")

    def test_a_key_after_a_click_into_a_text_field_is_a_letter_alone(self):
        viewer = self.viewer
        viewer.open_panel("Camera")
        viewer.press("File", panel="Camera")
        before = viewer.shows("Camera/File")
        viewer.click_at(self.SIZE[0] - 40, 60)
        x, y = viewer.centre("Camera/File")
        # All of it in one frame.
        viewer.process.send_signal(signal.SIGSTOP)
        try:
            self.display.xdotool("mousemove", "--window", viewer.window.number, x, y, "click", 1)
            self.display.xdotool("key", "--window", viewer.window.number, "h")
        finally:
            viewer.process.send_signal(signal.SIGCONT)
        viewer.wait_for_value("Camera/File", lambda shown: len(shown) == len(before) + 1, "it is typed")
        viewer.wait_frames(3)
        self.assertNotIn("Keys/Close", viewer.controls())
        viewer.click_at(self.SIZE[0] - 40, 60)

    def test_tooltips_of_tabs_lie_beside_the_panel_that_they_open(self):
        viewer = self.viewer
        viewer.open_panel("Look")
        for name in ("Rail/Look", "Rail/Capture"):
            self.display.xdotool("mousemove", "--window", viewer.window.number, *viewer.centre(name))
            viewer.wait(lambda: viewer.shows(f"Tooltip/{name}"), "the tooltip is there")
            viewer.wait_frames(3)
            self.assertGreaterEqual(viewer.controls()[f"Tooltip/{name}"]["x"], PANEL_END)

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


class LongUsageTest(UsageCase):
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
        encoded = [255 * (1.055 * (channel / max(before)) ** (1 / 2.4) - 0.055) for channel in before]
        for shown, told in zip(swatch[10][10][::-1], encoded):
            self.assertAlmostEqual(shown, told, delta=3, msg="the swatch has the hue of the sun")
        viewer.set("Sunlight intensity", "Look", 0.9)
        viewer.wait(lambda: max(channels()) > 2 * intensity, "it is brighter")
        after = channels()
        for one, other in zip(before, after):
            self.assertAlmostEqual(one / max(before), other / max(after), delta=0.01)
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
