"""The viewer's panels, on a real X server, under the validation layer: each is turned by mouse and
keys, and what follows is read from the controls themselves and from the picture."""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import share_that_differs  # noqa: E402
from window_case import ROOT, SWARD, WindowCase  # noqa: E402

PANELS = ("Field", "Meadow", "Paint", "Physics", "Wind", "Culling", "Colliders", "Look", "Camera", "Profile",
          "Capture")
GRASS = (440, 20, 440, 500)  # left, top, width, height of the picture beside an open panel


class PanelsCase(WindowCase):
    def grass(self, viewer):
        x, y, _, _ = viewer.window.geometry()
        left, top, width, height = GRASS
        return self.display.picture(x + left, y + top, width, height)

    def counts(self, viewer):
        names = ("Patch", "Orientation", "Frustum", "Distance", "Occlusion", "Detail", "Drawn")
        return {name: int(viewer.shows(f"Culling/{name} count")) for name in names}


class OneViewerTest(PanelsCase):
    """One viewer for all tests."""

    def setUp(self):
        super().setUp()
        self.viewer = self.open_kept()

    def test_a_frozen_culling_camera_stays_behind(self):
        viewer = self.viewer
        viewer.open_panel("Culling")
        viewer.key("2")  # at eye level
        viewer.key("space")
        viewer.wait_frames(4)
        viewer.key("c")
        viewer.wait_for_value("Culling/Frozen", lambda shown: shown == "on", "it is frozen")
        viewer.wait_frames(3)
        frozen = self.counts(viewer)
        self.assertGreater(frozen["Frustum"] + frozen["Patch"], 0)
        viewer.key("1")
        viewer.wait_frames(4)
        self.assertEqual(self.counts(viewer), frozen, "another view, the same blades")
        viewer.key("c")
        viewer.wait_for_value("Culling/Patch count", lambda count: count == "0",
                              "seen from far away no patch is left out")
        viewer.key("space")

    def test_a_collider_is_added_dragged_and_taken_away(self):
        viewer = self.viewer
        viewer.open_panel("Colliders")
        viewer.away()
        before = self.grass(viewer)
        viewer.press("Add ball", panel="Colliders")
        viewer.wait_for_value("Colliders/Collider 1", bool, "there is a ball")
        first = viewer.shows("Colliders/Collider 1")
        viewer.wait(lambda: share_that_differs(before, self.grass(viewer)) > 0.002,
                    "the ball is seen, and blades that give way to it")
        self.assertEqual(first, viewer.shows("Colliders/Collider 1"), "it lies still")
        x, y = viewer.centre("Picture/Collider 1")
        viewer.drag((x, y), (x - 60, y + 10))
        viewer.wait_for_value("Colliders/Collider 1", lambda place: place != first, "it is dragged")
        viewer.press("Remove", panel="Colliders")
        viewer.wait(lambda: viewer.shows("Colliders/Colliders").startswith("0 "), "it is gone")

    def test_the_wind_follows_the_arrow_that_is_dragged(self):
        viewer = self.viewer
        viewer.open_panel("Wind")
        dial = viewer.wait(lambda: viewer.controls().get("Wind/1/Heading"), "there is a compass")
        middle = (dial["x"] + dial["width"] / 2, dial["y"] + dial["height"] / 2)
        headings = []
        for x, y in ((0, -1), (1, 0)):
            viewer.drag([round(m) for m in middle],
                        [round(m + 24 * d) for m, d in zip(middle, (x, y))])
            headings.append(float(viewer.shows("Wind/1/Heading")))
            self.assertAlmostEqual(headings[-1], float(viewer.shows("Wind/1/Direction")), delta=1)
        # A quarter to the right of where the camera looks.
        self.assertAlmostEqual((headings[1] - headings[0]) % 360, 90, delta=3)

    def test_the_key_sheet_has_every_key(self):
        sources = ROOT / "src" / "apps" / "sward_view"
        names = {"ESCAPE": "Escape", "HOME": "Home", "SPACE": "Space", "PERIOD": ".", "TAB": "Tab"}
        codes = re.findall(r"{GLFW_KEY_(\w+), Key::", (sources / "window/window.cpp").read_text())
        self.assertGreater(len(codes), 10)
        viewer = self.viewer
        viewer.key("h")
        viewer.wait(lambda: "Keys/Close" in viewer.controls(), "the sheet is there")
        sheet = {name.split("/", 1)[1] for name in viewer.controls() if name.startswith("Keys/")}
        for code in codes:
            self.assertIn(names.get(code, code), sheet)
        self.assertTrue({"1 to 9", "Right drag + W A S D Q E", "Wheel", "Left drag",
                         "Drop, Shift+drop"} <= sheet)
        # The page has the same.
        page = (ROOT / "docs" / "viewer.md").read_text()
        rows = page[page.index("| input | does |"):page.index("Each control has a tooltip")].lower()
        for code in codes:
            name = "full stop" if code == "PERIOD" else names.get(code, code).lower()
            self.assertRegex(rows, rf"(\| |, ){re.escape(name)}( \||,)", name)
        viewer.key("h")

    def test_panels_hide_and_the_key_sheet_comes_and_goes(self):
        viewer = self.viewer
        self.assertIn("Rail/Field", viewer.controls())
        viewer.key("Tab")
        viewer.wait(lambda: "Rail/Field" not in viewer.controls(), "the panels are hidden")
        viewer.key("h")
        viewer.wait(lambda: "Keys/Close" in viewer.controls(), "the sheet is there")
        viewer.key("Escape")
        viewer.wait(lambda: "Keys/Close" not in viewer.controls(), "the sheet is gone")
        self.assertIsNone(viewer.process.poll())
        viewer.key("Tab")
        viewer.wait(lambda: "Rail/Field" in viewer.controls(), "the panels are back")


class PanelsTest(PanelsCase):
    def test_each_culling_test_counts_only_while_it_is_on(self):
        # Low behind a hill, near the draw distance, every test has something to leave out.
        near = self.folder / "near.json"
        near.write_text(json.dumps({"culling": {"draw_distance": 18}}))
        # Thin, edge-on and hidden blades depend on the resolution.
        low = self.folder / "low.json"
        low.write_text(json.dumps({"eye": [0, 0.6, 10], "target": [0, 0.3, -10], "fov_y_deg": 50}))
        field = self.field("hills", 1500, 2)
        info = json.loads(subprocess.run([SWARD, "info", "--json", field], check=True, capture_output=True).stdout)
        culled = info["blades"] + info["ribbons"]  # frames count ribbons on stalks, too
        viewer = self.open(field, "--camera", low, "--settings", near, "--panel", "culling", "--resolution", "0.4")
        viewer.key("space")
        viewer.wait_frames(4)
        total = sum(self.counts(viewer).values())
        self.assertEqual(total, culled)
        for name in ("Patch", "Orientation", "Frustum", "Distance", "Occlusion"):
            with self.subTest(test=name):
                before = self.counts(viewer)
                viewer.press(name, panel="Culling")
                self.assertEqual(viewer.shows(f"Culling/{name}"), "off")
                viewer.wait_for_value(f"Culling/{name} count", lambda count: count == "0",
                                      f"nothing is left out by {name}")
                self.assertGreater(before[name], 0, f"{name} had nothing to leave out")
                self.assertEqual(sum(self.counts(viewer).values()), culled)
                viewer.press(name, panel="Culling")
                viewer.wait_for_value(f"Culling/{name} count",
                                      lambda count, was=before[name]: int(count) == was,
                                      f"{name} leaves out as many as before")
        self.assert_ends_well(viewer)

    def test_every_control_of_every_panel_tells_what_it_is_with_unit_and_range(self):
        viewer = self.open(self.field())
        for panel, button in (("Colliders", "Add capsule"), ("Wind", "Add source")):
            viewer.press(button, panel=panel)
        # Numbers without a unit are shares, counts, or described by words.
        with_unit = ("Wind/1/Strength", "Physics/Recovery", "Look/Azimuth", "Culling/Draw distance",
                     "Colliders/Radius", "Capture/Interval", "Meadow/Slope to")
        kinds, abouts = {}, {}
        for panel in PANELS:
            viewer.open_panel(panel)
            viewer.wait_frames(2)
            told = {name: control for name, control in viewer.controls().items()
                    if name.startswith(panel + "/")}
            self.assertGreater(len(told), 3, panel)
            for name, control in told.items():
                with self.subTest(control=name):
                    about = abouts[name] = control["about"]
                    self.assertGreater(len(about), 8, "it tells what it is")
                    kind = control["kind"]
                    kinds.setdefault(kind, []).append(name)
                    if kind == "number":
                        # A second line: from, to, and the unit unless the first one names it.
                        self.assertRegex(about, r"\n-?[\d.e+-]+ to [\d.e+-]+")
                    if kind in ("toggle", "choice", "color", "place", "compass"):
                        self.assertIn("\n", about)
                    if kind == "place":
                        self.assertIn(" in m", about)
        # Each kind was met, in all more than sixty that can be turned.
        self.assertEqual(set(kinds), {"", "number", "toggle", "choice", "color", "text", "place",
                                      "compass", "button"})
        self.assertGreater(sum(len(names) for kind, names in kinds.items() if kind), 60)
        for name in with_unit:
            self.assertRegex(abouts[name], r"to [\d.e+-]+ (1/s|m|s|°);", name)

        # It is really shown where the mouse rests.
        viewer.open_panel("Physics")
        self.display.xdotool("mousemove", "--window", viewer.window.number,
                             *viewer.centre("Physics/Strength"))
        shown = viewer.wait(lambda: viewer.shows("Tooltip/Physics/Strength"), "the tooltip is there")
        self.assertIn("0 to 40 1/s", shown)
        self.assert_ends_well(viewer)


class LongPanelsTest(PanelsCase):
    def test_a_click_tells_of_a_blade(self):
        viewer = self.open(self.field(), "--camera", "top", "--resolution", "0.4")
        viewer.key("space")
        for x in range(300, 700, 16):
            viewer.click_at(x, 260)
            if viewer.shows("Blade/Id"):
                break
        told = viewer.controls()
        self.assertIn("Blade/Id", told, "a row of clicks meets no blade")
        self.assertEqual(told["Blade/Cull result"]["shows"], "drawn")
        subprocess.run([SWARD, "export", self.folder / "plane.sward", "-o", self.folder / "blades.csv"],
                       check=True, stderr=subprocess.DEVNULL)
        with open(self.folder / "blades.csv") as file:
            header = file.readline().strip().split(",")
            rows = {line.split(",")[0]: line.strip().split(",") for line in file}
        blade = rows[told["Blade/Id"]["shows"]]
        root = [float(blade[header.index(axis)]) for axis in "xyz"]
        shown = [float(word) for word in told["Blade/Root"]["shows"].split()]
        for a, b in zip(root, shown):
            self.assertAlmostEqual(a, b, delta=0.002)
        self.assertEqual(blade[header.index("patch")], told["Blade/Patch"]["shows"])
        self.assert_ends_well(viewer)

    def test_the_rows_of_the_profile_add_up_and_the_frame_rate_is_told(self):
        # A collider that moves has its shadow drawn anew in each frame.
        viewer = self.open(self.field("hills"), "--panel", "profile", "--collider", "sphere:0,1,0,0.5",
                           "--resolution", "1")
        viewer.press("Reset times", panel="Profile")
        names = ("sun shadow", "ground", "pyramid", "cull", "update", "blades", "shadow", "resolve", "not attributed")
        viewer.wait(lambda: all(f"Profile/{name}" in viewer.controls() for name in (*names, "total")),
                    "all passes are measured")
        viewer.wait_frames(12)
        told = viewer.controls()
        times = {name: float(told[f"Profile/{name}"]["shows"].split(" ms")[0])
                 for name in (*names, "total", "scaling", "interface")}
        self.assertAlmostEqual(sum(times[name] for name in names), times["total"],
                               delta=0.05 * times["total"])
        # Each dispatch lies within its row: what is left are copies and barriers.
        self.assertLess(times["not attributed"], 0.1 * times["total"], times)
        rate, milliseconds = (float(number) for number in re.search(
            r"([\d.]+) frames/s +([\d.]+) ms", told["Status/Numbers"]["shows"]).groups())
        self.assertAlmostEqual(rate * milliseconds, 1000, delta=0.05 * 1000 + 0.06 * milliseconds)
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
