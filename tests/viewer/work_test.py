"""The viewer loses no work of its user: Escape, files that exist, fields that are not saved. On a real X
server, by mouse and keys."""

import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import share_that_differs  # noqa: E402
from window_case import SWARD, WindowCase  # noqa: E402


class WorkCase(WindowCase):
    SIZE = (900, 700)

    def open_mesh(self):
        return self.open(self.mesh(), "--meadow", "grass", "--panel", "field")

    def escape(self, viewer):
        viewer.key("Escape")
        self.assertIsNone(viewer.process.poll(), "it still runs")

    def wait_for_end(self, viewer):
        self.assertEqual(viewer.process.wait(timeout=60), 0, viewer.said())
        self.assertIn("0 validation messages", viewer.said())

    def asked(self, viewer):
        viewer.wait(lambda: viewer.shows("Question/Text"), "it asks")
        viewer.wait_frames(3)  # until the question has its place
        return viewer.shows("Question/Text")

    def answer(self, viewer, answer):
        """The question goes, or the program ends."""
        try:
            viewer.click(f"Question/{answer}")
            viewer.wait(lambda: "Question/Text" not in viewer.controls(), "the question is gone")
        except AssertionError:
            if viewer.process.poll() is None:
                raise

    def assert_valid(self, field):
        subprocess.run([SWARD, "validate", field], check=True, capture_output=True)


class WorkTest(WorkCase):
    def test_escape_closes_only_what_is_topmost(self):
        viewer = self.open(self.field(), "--panel", "culling", "--camera", "top", "--resolution", "0.4")
        viewer.key("space")
        left, top, _, _ = viewer.window.geometry()
        panel = lambda: self.display.picture(left + 100, top + 300, 330, 390)
        viewer.away()
        closed = panel()
        viewer.click("Culling/Colour by")
        viewer.away()
        self.assertGreater(share_that_differs(closed, panel(), 12), 0.1, "there is a drop-down")
        viewer.key("h")
        self.assertIn("Keys/Close", viewer.controls())
        self.escape(viewer)
        viewer.away()
        self.assertIn("Keys/Close", viewer.controls(), "first the drop-down")
        self.escape(viewer)
        self.assertNotIn("Keys/Close", viewer.controls())
        viewer.wait(lambda: share_that_differs(closed, panel(), 12) < 0.03, "it is gone")
        for x in range(500, 860, 16):
            viewer.click_at(x, 300)
            if viewer.shows("Blade/Id"):
                break
        self.assertIn("Blade/Id", viewer.controls(), "a blade is met")
        self.escape(viewer)
        self.assertNotIn("Blade/Id", viewer.controls())
        self.assertEqual(viewer.shows("Rail/Culling"), "open")
        self.escape(viewer)
        self.assertEqual(viewer.shows("Rail/Culling"), "")
        viewer.window.key("Escape")
        self.wait_for_end(viewer)

    def test_a_bake_that_is_not_saved_asks_before_it_is_lost(self):
        other = self.field("hills")
        viewer = self.open_mesh()
        self.assertEqual(viewer.shows("Field/Saved"), "no")
        for end in (viewer.window.ask_to_close, lambda: viewer.key("Escape")):
            # Escape closes the panel first.
            if end != viewer.window.ask_to_close:
                viewer.key("Escape")
            end()
            self.assertIn("plane.glb", self.asked(viewer))
            self.escape(viewer)
            viewer.wait(lambda: "Question/Text" not in viewer.controls(), "the question is gone")
        viewer.window.ask_to_close()
        self.asked(viewer)
        self.answer(viewer, "Cancel")
        # Another field would take its place.
        self.drop(viewer, other)
        self.assertIn("plane.glb", self.asked(viewer))
        self.answer(viewer, "Cancel")
        viewer.open_panel("Field")
        self.assertTrue(viewer.shows("Field/File").endswith("plane.glb"), "it is still there")
        viewer.window.ask_to_close()
        self.asked(viewer)
        self.answer(viewer, "Close without saving")
        self.wait_for_end(viewer)
        self.assertEqual([path.name for path in self.folder.glob("*.sward")], ["hills.sward"])

    def test_a_bake_is_saved_and_then_nothing_is_asked(self):
        viewer = self.open_mesh()
        viewer.press("Save field as...", panel="Field")
        viewer.wait_for_value("Files/Name", lambda shown: shown == "plane.sward", "it proposes a name")
        viewer.wait_frames(3)
        viewer.key("Return")
        saved = self.folder / "plane.sward"
        viewer.wait(saved.exists, "the field is written")
        viewer.wait_for_value("Field/Saved", lambda shown: shown == "plane.sward", "it is told")
        self.assert_valid(saved)
        # The same name again asks.
        before = saved.read_bytes()
        viewer.key("ctrl+s")
        self.assertIn("plane.sward", self.asked(viewer))
        self.answer(viewer, "Cancel")
        self.assertEqual(saved.read_bytes(), before)
        viewer.window.ask_to_close()
        self.wait_for_end(viewer)

    def test_files_of_settings_cameras_sequences_and_pictures_are_not_replaced_unasked(self):
        old = b"{}"
        for name in ("settings.json", "camera_path.json", "frame_0003.png"):
            (self.folder / name).write_bytes(old)
        viewer = self.open(self.field())
        for panel, button, name in (("Capture", "Save settings", "settings.json"),
                                    ("Camera", "Save this camera", "camera_path.json"),
                                    ("Capture", "Take sequence", "frame_%04d.png")):
            with self.subTest(button=button):
                viewer.press(button, panel=panel)
                self.assertIn(name, self.asked(viewer))
                self.answer(viewer, "Cancel")
        for name in ("settings.json", "camera_path.json", "frame_0003.png"):
            self.assertEqual((self.folder / name).read_bytes(), old, name)
        viewer.press("Save settings", panel="Capture")
        self.asked(viewer)
        self.answer(viewer, "Save as settings-2.json")
        viewer.wait((self.folder / "settings-2.json").exists, "it is written beside the old one")
        self.assertEqual((self.folder / "settings.json").read_bytes(), old)
        viewer.press("Save settings", panel="Capture")
        self.asked(viewer)
        self.answer(viewer, "Replace")
        viewer.wait(lambda: (self.folder / "settings.json").read_bytes() != old, "it is replaced")
        # A recorded path is not lost, nor is the old one.
        viewer.key("r")
        viewer.wait_frames(3)
        viewer.key("r")
        viewer.wait((self.folder / "camera_path-2.json").exists, "the path is written")
        self.assertEqual((self.folder / "camera_path.json").read_bytes(), old)
        # A second picture gets a name of its own.
        first, second = self.folder / "sward.png", self.folder / "sward-2.png"
        viewer.key("p")
        viewer.wait(first.exists, "the picture is written")
        bytes_of_first = first.read_bytes()
        viewer.key("p")
        viewer.wait(second.exists, "so is the second")
        viewer.wait_for_value("Message/Notice", lambda shown: "sward-2.png" in shown, "it is told")
        self.assertEqual(first.read_bytes(), bytes_of_first)
        viewer.window.ask_to_close()
        self.wait_for_end(viewer)


class LongWorkTest(WorkCase):
    def test_it_is_saved_at_the_end_under_a_name_that_is_free(self):
        there = self.field()
        before = there.read_bytes()
        viewer = self.open_mesh()
        viewer.window.ask_to_close()
        self.asked(viewer)
        self.assertIn("plane-2.sward", viewer.controls()["Question/Save and close"]["about"])
        self.answer(viewer, "Save and close")
        self.wait_for_end(viewer)
        self.assertEqual(there.read_bytes(), before)
        self.assert_valid(self.folder / "plane-2.sward")
        self.assertIn("plane-2.sward", viewer.said())


if __name__ == "__main__":
    unittest.main()
