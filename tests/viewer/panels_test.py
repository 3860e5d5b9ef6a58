"""The viewer's panels, on a real X server, under the validation layer: each is turned by mouse and
keys, and what follows is read from the controls themselves and from the picture."""

import json
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import share_that_differs  # noqa: E402
from window_case import ROOT, SWARD, VIEWER, WindowCase  # noqa: E402

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
        field = self.field("hills")
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

    def test_wind_is_turned_and_settings_are_saved_and_loaded(self):
        field = self.field()
        viewer = self.open(field, "--panel", "wind")
        viewer.set("Total strength", "Wind", 0.9)
        stormy = float(viewer.shows("Wind/Total strength"))
        self.assertGreater(stormy, 20)
        viewer.press("Save settings", panel="Capture")
        saved = self.folder / "settings.json"
        viewer.wait(saved.exists, "the settings are written")
        strength = sum(wind["strength"] for wind in json.loads(saved.read_text())["wind"])
        self.assertAlmostEqual(strength, stormy, delta=0.01 * stormy)

        viewer.set("Total strength", "Wind", 0.1)
        self.assertLess(float(viewer.shows("Wind/Total strength")), 10)
        viewer.press("Load settings", panel="Capture")
        viewer.open_panel("Wind")
        viewer.wait_for_value("Wind/Total strength",
                              lambda shown: abs(float(shown) - stormy) < 0.01 * stormy,
                              "the wind is as it was saved")
        self.assert_ends_well(viewer)
        # The other program of the window takes the same file.
        subprocess.run([VIEWER, "render", field, "-o", self.folder / "storm.png", "--settings",
                        saved, "--size", "32x32", "-q"], check=True)

    def test_a_picture_is_taken_without_panels(self):
        viewer = self.open(self.field(), "--panel", "capture", environment={"PATH": ""})
        viewer.press("Video", panel="Capture")
        self.assertEqual(viewer.shows("Capture/Video"), "off", "there is no ffmpeg")
        viewer.key("p")
        picture = self.folder / "sward.png"
        viewer.wait(picture.exists, "the picture is written")
        width, height = (int.from_bytes(picture.read_bytes()[at:at + 4], "big") for at in (16, 20))
        self.assertEqual((width, height), self.SIZE, "with every pixel of the window")
        self.assert_ends_well(viewer)

    def ffmpeg(self, script):
        """A program of that name in a folder of its own; the variable PATH with it in front."""
        programs = self.folder / "programs"
        programs.mkdir(exist_ok=True)
        (programs / "ffmpeg").write_text("#!/bin/sh\n" + script)
        (programs / "ffmpeg").chmod(0o755)
        return {"PATH": f"{programs}:{os.environ['PATH']}"}

    def take_video(self, viewer):
        viewer.press("Video", panel="Capture")
        viewer.set("Pictures", "Capture", 0.02)
        viewer.wait_for_value("Capture/Pictures", lambda shown: int(shown) < 5, "few pictures")
        self.pictures = int(viewer.shows("Capture/Pictures"))
        viewer.press("Take sequence", panel="Capture")

    def test_a_film_is_made_by_ffmpeg_and_one_that_cannot_be_written_is_told(self):
        # A replacement for ffmpeg: records its arguments and its input.
        path = self.ffmpeg('for last; do :; done; echo "$@" >asked.txt; cat >"$last"')
        viewer = self.open(self.field(), "--panel", "capture", environment=path)
        self.take_video(viewer)
        film = self.folder / "sward.mp4"
        viewer.wait(film.exists, "the film is there")
        self.assertEqual(film.stat().st_size, self.pictures * self.SIZE[0] * self.SIZE[1] * 4)
        asked = (self.folder / "asked.txt").read_text()
        self.assertIn("-video_size {}x{} -framerate 30 ".format(*self.SIZE), asked)
        self.assertEqual(list(self.folder.glob("*.part*")), [])

        self.ffmpeg('for last; do :; done; echo half >"$last"; echo "No space left on device" >&2; exit 1')
        film.unlink()
        viewer.press("Take sequence", panel="Capture")
        viewer.wait_for_value("Message/Error", lambda shown: "No space left" in shown, "it complains")
        self.assertEqual(list(self.folder.glob("*.part*")), [], "nothing half written is left")
        self.assertFalse(film.exists())
        self.assert_ends_well(viewer)

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
        viewer = self.open(self.field(), "--panel", "profile", "--collider", "sphere:0,1,0,0.5")
        viewer.press("Reset times", panel="Profile")
        names = ("sun shadow", "ground", "pyramid", "cull", "update", "blades", "resolve", "not attributed")
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

    def test_a_path_is_recorded_and_render_takes_it(self):
        field = self.field()
        viewer = self.open(field, "--panel", "camera")
        viewer.key("r")
        viewer.wait_for_value("Camera/Record", lambda shown: shown == "on", "it records")
        viewer.drag((600, 200), (700, 220))
        viewer.key("r")
        path = self.folder / "camera_path.json"
        viewer.wait(path.exists, "the path is written")
        stops = json.loads(path.read_text())
        self.assertGreater(len(stops), 3)
        self.assertNotEqual(stops[0]["eye"], stops[-1]["eye"])
        # Played, it ends where it was left.
        viewer.key("Home")
        viewer.press("Replay", panel="Camera")
        self.assert_ends_well(viewer)
        subprocess.run([VIEWER, "render", field, "-o", self.folder / "way_%d.png", "--frames",
                        "0:1", "--fixed-dt", str(stops[-1]["time"]), "--camera", path, "--size",
                        "32x32", "-q"], check=True)
        self.assertNotEqual((self.folder / "way_0.png").read_bytes(),
                            (self.folder / "way_1.png").read_bytes())

    def test_a_bookmark_is_there_in_the_next_run(self):
        calm = (self.field(), "--wind-strength", "0", "--panel", "meadow", "--resolution", "0.4")
        viewer = self.open(*calm)
        # The panel initially shows the settings of the field's bake.
        self.assertEqual((viewer.shows("Meadow/Amount"), viewer.shows("Meadow/Count")),
                         ("count", "1500"))
        home = self.grass(viewer)
        viewer.drag((600, 200), (720, 240))
        viewer.key("ctrl+7")
        viewer.wait_frames(6)
        set_there = self.grass(viewer)
        self.assertGreater(share_that_differs(home, set_there), 0.1)
        self.assert_ends_well(viewer)
        viewer = self.open(*calm)
        viewer.wait(lambda: share_that_differs(home, self.grass(viewer)) < 0.02, "it is at home")
        viewer.key("7")
        viewer.wait(lambda: share_that_differs(set_there, self.grass(viewer)) < 0.05,
                    "it shows the place that was set")
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


if __name__ == "__main__":
    unittest.main()
