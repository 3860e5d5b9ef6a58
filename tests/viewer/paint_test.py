"""Painting in the viewer, by mouse and keys on a real X server: strokes, undo, what is saved, and what is
left when it is killed."""

import json
import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import share_that_differs, wait_until  # noqa: E402
from window_case import SWARD, WindowCase  # noqa: E402

GROUND = "plane"
COUNT = 60000
# Options that the panel Meadow does not have are taken from the field.
SCALE = 1.02
BAKE = ["--meadow", "grass", "--sky-rays", "4"]
LEFT, RIGHT, LOW = (560, 420), (760, 420), 470  # places of the picture beside the panel


def has_ended(process):
    """Whether a process has ended, also if its parent has not waited for it yet."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] == "Z"
    except FileNotFoundError:
        return True


class PaintCase(WindowCase):
    SIZE = (1000, 760)

    def setUp(self):
        super().setUp()
        self.meadow = self.field(GROUND, COUNT, SCALE, *BAKE, name="meadow.sward")
        self.baked = self.meadow.read_bytes()
        self.autosave = self.folder / "meadow.strokes.autosave.json"

    def open(self, *arguments):
        viewer = super().open(*arguments, "--panel", "paint", "--camera", "top", "--resolution", "0.35")
        viewer.key("space")
        return viewer

    def begin(self, viewer):
        viewer.click("Paint/Start painting")
        viewer.wait(lambda: "Paint/Kind" in viewer.controls(), "painting begins")

    def paint(self):
        viewer = self.open(self.meadow, "--ground", GROUND)
        self.begin(viewer)
        self.assertEqual(self.blades(viewer), COUNT)
        return viewer

    def choose(self, viewer, kind):
        viewer.click("Paint/Kind")
        viewer.wait(lambda: f"Paint/Kind {kind}" in viewer.controls(), "the list is open")
        viewer.wait_frames(2)
        viewer.click(f"Paint/Kind {kind}")
        viewer.wait_for_value("Paint/Kind", lambda shown: shown == kind, "it is chosen")

    @staticmethod
    def blades(viewer):
        return int((viewer.shows("Paint/Blades") or "0").replace(" ", "").replace(",", ""))

    def strokes(self, viewer):
        return int(viewer.shows("Paint/Count"))

    def wait_for_strokes(self, viewer, count):
        viewer.wait_for_value("Paint/Count", lambda shown: shown == str(count), f"{count} strokes")

    def settled(self, viewer, holds, what):
        viewer.wait(lambda: holds(self.blades(viewer)), what)
        viewer.wait_frames(4)

    def picture(self, viewer):
        viewer.away()
        left, top, _, _ = viewer.window.geometry()
        return self.display.picture(left + 450, top + 120, 520, 560)

    def erase(self, viewer, begin=LEFT, end=RIGHT):
        self.choose(viewer, "Remove grass")
        viewer.set("Radius", "Paint", 0.68)
        viewer.drag(begin, end)

    def blades_of(self, field):
        told = subprocess.run([SWARD, "info", "--json", field], check=True, capture_output=True)
        return json.loads(told.stdout)["blades"]

    def saved(self):
        try:
            return json.loads(self.autosave.read_text())["strokes"]
        except (OSError, ValueError):
            return []


class PaintTest(PaintCase):
    def test_strokes_change_the_picture_and_undo_brings_it_back(self):
        viewer = self.paint()
        before = self.picture(viewer)
        self.erase(viewer)
        self.wait_for_strokes(viewer, 1)
        self.settled(viewer, lambda count: 0 < count < COUNT, "blades are gone")
        viewer.wait_frames(8)  # the last part of the stroke, too
        fewer = self.blades(viewer)
        erased = self.picture(viewer)
        erases = share_that_differs(before, erased, 12)
        self.assertGreater(erases, 0.012)
        viewer.key("ctrl+z")
        self.settled(viewer, lambda count: count == COUNT, "all blades are back")
        self.assertEqual(self.strokes(viewer), 0)
        viewer.wait(lambda: share_that_differs(erased, self.picture(viewer), 12) > 0.5 * erases,
                    "the picture follows")
        self.assertLess(share_that_differs(before, self.picture(viewer), 12), 0.1 * erases)
        viewer.key("ctrl+shift+z")
        self.settled(viewer, lambda count: count == fewer, "the stroke is there again")
        self.assertGreater(share_that_differs(before, self.picture(viewer), 12), 0.7 * erases)
        # Its switch does the same as undo.
        viewer.click("Paint/Stroke 1", 0.1)
        self.settled(viewer, lambda count: count == COUNT, "a hidden stroke does not count")
        self.assertEqual(self.strokes(viewer), 1)
        self.assert_ends_well(viewer)

    def test_strokes_are_told_named_and_drawn_straight(self):
        viewer = self.paint()
        self.choose(viewer, "Remove grass")
        viewer.click_at(*LEFT)
        self.wait_for_strokes(viewer, 1)
        xdotool = self.display.xdotool
        xdotool("keydown", "Shift_L")
        viewer.wait_frames(2)
        viewer.click_at(*RIGHT)
        xdotool("keyup", "Shift_L")
        self.wait_for_strokes(viewer, 2)
        self.assertRegex(viewer.shows("Paint/Stroke 1"), r"Remove grass; at .*; radius 1 m")
        self.assertRegex(viewer.shows("Paint/Stroke 2"), r"Remove grass; at .* m long, radius 1 m")
        viewer.wait(self.autosave.exists, "it is saved by itself")
        dot, line = (viewer.wait(lambda: len(self.saved()) == 2 and self.saved(), "both are saved"))
        self.assertEqual(dot["points"][0], line["points"][0], "it goes on from the end")
        # The stroke under the mouse lies on the ground.
        plain = self.picture(viewer)
        xdotool("mousemove", "--window", viewer.window.number, *viewer.centre("Paint/Stroke 2", 0.3))
        viewer.wait_frames(4)
        left, top, _, _ = viewer.window.geometry()
        shown = self.display.picture(left + 450, top + 120, 520, 560)
        self.assertGreater(share_that_differs(plain, shown, 40), 0.001)
        viewer.click("Paint/Name Stroke 2")
        viewer.wait(lambda: "Paint/Stroke name" in viewer.controls(), "it asks for the name")
        viewer.type_anew("Stroke name", "Paint", "gate")
        viewer.click("Paint/Take name")
        viewer.wait(lambda: (viewer.shows("Paint/Stroke 2") or "").startswith("gate: Remove grass"), "it has a name")
        viewer.wait(lambda: self.saved()[1].get("name") == "gate", "so has the file")
        viewer.key("ctrl+z")
        viewer.wait(lambda: viewer.shows("Paint/Stroke 2").startswith("Remove grass"), "it has none")
        self.assert_ends_well(viewer)

    def test_what_is_saved_is_what_was_painted(self):
        viewer = self.paint()
        self.erase(viewer)
        self.settled(viewer, lambda count: 0 < count < COUNT, "blades are gone")
        fewer = self.blades(viewer)
        self.assertTrue(self.autosave.exists())
        strokes = self.folder / "meadow.strokes.json"
        for button, path in (("Save field...", self.meadow), ("Save strokes...", strokes)):
            viewer.click(f"Paint/{button}")
            viewer.wait_for_value("Files/Name", lambda shown: shown == path.name, "it proposes a name")
            viewer.wait_frames(3)
            viewer.key("Return")
            if path == self.meadow:  # its own file, which is there
                viewer.wait(lambda: "Question/Replace" in viewer.controls(), "it asks")
                viewer.wait_frames(3)
                viewer.click("Question/Replace")
                viewer.wait(lambda: path.read_bytes() != self.baked, "it is replaced")
            viewer.wait(path.exists, f"{path.name} is written")
        viewer.wait_for_value("Paint/Saved", lambda shown: shown == "yes", "it is told")
        self.assertFalse(self.autosave.exists())
        viewer.window.ask_to_close()
        self.assertEqual(viewer.process.wait(timeout=60), 0, viewer.said())
        painted, baked = self.meadow, self.folder / "baked.sward"
        self.assertEqual(self.blades_of(painted), fewer)
        subprocess.run([SWARD, "bake", GROUND, "--count", str(COUNT), "--blade-scale", str(SCALE), *BAKE,
                        "--paint", strokes, "-o", baked, "-q"], check=True)
        self.assertEqual(baked.read_bytes(), painted.read_bytes())
        again = self.open(painted, "--ground", GROUND)
        self.assertIn(f"{fewer}", again.shows("Status/Numbers").replace(" ", "").replace(",", ""))
        self.assert_ends_well(again)

    def test_strokes_that_are_not_saved_are_asked_for(self):
        viewer = self.paint()
        self.erase(viewer)
        self.wait_for_strokes(viewer, 1)
        viewer.window.ask_to_close()
        viewer.wait(lambda: "strokes" in (viewer.shows("Question/Text") or ""), "it asks")
        viewer.wait_frames(3)
        try:
            viewer.click("Question/Save and close")
        except AssertionError:
            pass
        self.assertEqual(viewer.process.wait(timeout=60), 0, viewer.said())
        strokes = json.loads((self.folder / "meadow.strokes.json").read_text())["strokes"]
        self.assertEqual([stroke["kind"] for stroke in strokes], ["erase"])
        self.assertFalse(self.autosave.exists())

    def test_killed_within_a_stroke_it_leaves_those_before_and_a_whole_field(self):
        viewer = self.paint()
        self.erase(viewer)
        self.wait_for_strokes(viewer, 1)
        viewer.wait(self.autosave.exists, "it is saved by itself")
        xdotool = self.display.xdotool
        xdotool("mousemove", "--window", viewer.window.number, LEFT[0], LOW)
        viewer.wait_frames(2)
        xdotool("mousedown", 1)
        xdotool("mousemove", "--window", viewer.window.number, RIGHT[0], LOW)
        viewer.wait_frames(3)
        children = subprocess.run(["pgrep", "-P", str(viewer.process.pid)], capture_output=True,
                                  text=True).stdout.split()
        self.assertTrue(children, "sward edit runs")
        viewer.process.send_signal(signal.SIGKILL)
        viewer.process.wait()
        xdotool("mouseup", 1)
        for child in children:
            wait_until(lambda: has_ended(child), "sward edit ends, too")
        strokes = json.loads(self.autosave.read_text())["strokes"]
        self.assertEqual([stroke["kind"] for stroke in strokes], ["erase"])
        self.assertEqual(self.meadow.read_bytes(), self.baked)
        again = self.open(self.meadow, "--ground", GROUND)
        again.click("Paint/Start painting")
        again.wait(lambda: "Question/Load them" in again.controls(), "it offers the strokes")
        again.wait_frames(3)
        again.click("Question/Load them")
        again.wait(lambda: "Paint/Kind" in again.controls(), "painting begins")
        self.wait_for_strokes(again, 1)
        self.settled(again, lambda count: 0 < count < COUNT, "the stroke is applied")
        self.assert_ends_well(again)


class LongPaintTest(PaintCase):
    def test_a_field_with_seeds_is_painted_where_it_is_sown(self):
        seeded = self.folder / "seeded.sward"
        subprocess.run([SWARD, "bake", GROUND, "--seeds", "always", "--budget", "20000",
                        *BAKE, "-q", "-o", seeded], check=True)
        viewer = self.open(seeded, "--ground", GROUND)
        self.begin(viewer)
        viewer.wait_frames(20)
        before = self.picture(viewer)
        self.erase(viewer)
        self.wait_for_strokes(viewer, 1)
        viewer.wait(lambda: share_that_differs(before, self.picture(viewer), 12) > 0.01, "sown blades are gone")
        viewer.key("ctrl+z")
        viewer.wait(lambda: share_that_differs(before, self.picture(viewer), 12) < 0.005, "they are back")
        self.assert_ends_well(viewer)

    def test_strokes_off_the_ground_are_told_and_moved(self):
        strokes = self.folder / "above.json"
        strokes.write_text(json.dumps({"format": "sward strokes 1", "strokes": [
            {"kind": "erase", "radius_m": 2, "points": [[-4, 3, 0], [4, 3, 0]], "normals": [[0, 1, 0]]}]}))
        viewer = self.open(self.meadow, "--ground", GROUND)
        viewer.type_anew("Strokes", "Paint", str(strokes))
        self.begin(viewer)
        viewer.wait(lambda: "touch no ground" in (viewer.shows("Message/Error") or ""), "it is told")
        self.assertIn("touches no ground", viewer.shows("Paint/Stroke 1"))
        self.assertEqual(self.blades(viewer), COUNT)
        viewer.set("Move by", "Paint", 0.9)
        viewer.click("Paint/Move onto ground")
        self.settled(viewer, lambda count: 0 < count < COUNT, "the stroke counts")
        viewer.wait(lambda: "Paint/Off the ground" not in viewer.controls(), "nothing is left")
        viewer.key("ctrl+z")
        self.settled(viewer, lambda count: count == COUNT, "it is above the ground again")
        self.assert_ends_well(viewer)

    def test_the_eyedropper_takes_a_species(self):
        viewer = self.paint()
        viewer.click("Paint/Take species")
        viewer.click_at(*LEFT)
        viewer.wait_for_value("Paint/Kind", lambda shown: shown == "Sow a species", "it is the brush's")
        self.assertEqual(self.strokes(viewer), 0, "the click paints nothing")
        self.assert_ends_well(viewer)

    def test_a_session_that_is_killed_is_told_and_the_window_goes_on(self):
        viewer = self.paint()
        self.erase(viewer)
        self.wait_for_strokes(viewer, 1)
        for child in subprocess.run(["pgrep", "-P", str(viewer.process.pid)], capture_output=True,
                                    text=True).stdout.split():
            os.kill(int(child), signal.SIGKILL)
        viewer.wait(lambda: "sward edit" in (viewer.shows("Message/Error") or ""), "it is told")
        self.assertIn(str(self.autosave.name), viewer.shows("Message/Error"))
        viewer.wait(lambda: "Paint/Start painting" in viewer.controls(), "it can begin again")
        self.assertTrue(self.autosave.exists())
        self.assert_ends_well(viewer)

    def test_a_field_of_another_bake_is_not_painted(self):
        viewer = self.open(self.meadow, "--ground", "dunes")
        viewer.click("Paint/Start painting")
        viewer.wait(lambda: "was not baked on dunes" in (viewer.shows("Message/Error") or ""),
                    "it is told")
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
