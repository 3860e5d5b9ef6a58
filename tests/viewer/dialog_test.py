"""Files are chosen from a list in the window, by mouse and by keys alone. On a real X server."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window_case import WindowCase  # noqa: E402


class DialogCase(WindowCase):
    SIZE = (900, 640)

    def setUp(self):
        super().setUp()
        self.field("hills")
        (self.folder / "far").mkdir()
        self.field(name="far/plane.sward")
        self.mesh().rename(self.folder / "ground.glb")
        (self.folder / "notes.txt").write_text("no field")

    def open(self, *arguments):
        return super().open(*arguments, "--panel", "field")

    def browse(self, viewer):
        viewer.press("Name browse", panel="Field")
        viewer.wait(lambda: viewer.shows("Files/Folder"), "the dialog is open")
        viewer.wait_frames(3)

    def entries(self, viewer):
        fixed = {"Up", "Folder", "Name", "All files", "Open", "Add field", "Cancel", "Complaint", "Save"}
        return {name.removeprefix("Files/") for name in viewer.controls()
                if name.startswith("Files/")} - fixed


class DialogTest(DialogCase):
    def test_a_field_is_opened_by_the_mouse(self):
        viewer = self.open("hills.sward")
        self.browse(viewer)
        self.assertEqual(viewer.shows("Files/Folder"), str(self.folder.resolve()))
        shown = self.entries(viewer)
        self.assertLessEqual({"far/", "hills.sward", "ground.glb"}, shown)
        self.assertNotIn("notes.txt", shown)
        viewer.click("Files/far/")
        viewer.click("Files/Open")
        viewer.wait(lambda: "plane.sward" in self.entries(viewer), "the folder is entered")
        viewer.click("Files/plane.sward", 0.1)
        viewer.click("Files/Add field")
        viewer.wait(lambda: viewer.shows("Field/Show 2"), "there are two fields")
        self.assertIn("plane.sward", viewer.shows("Field/Show 2"))
        self.assert_ends_well(viewer)

    def test_a_field_is_opened_by_keys_alone(self):
        viewer = self.open("hills.sward")
        self.browse(viewer)
        # Types at once; a part of a name leaves what it means, and Enter goes there.
        viewer.type("fa")
        viewer.wait_frames(2)
        viewer.wait(lambda: self.entries(viewer) == {"far/"}, "the rest is left out")
        viewer.key("Return")
        viewer.wait(lambda: viewer.shows("Files/Folder").endswith("far"), "the folder is entered")
        viewer.wait_frames(3)
        viewer.type("..")
        viewer.wait_frames(2)
        viewer.key("Return")
        viewer.wait(lambda: not viewer.shows("Files/Folder").endswith("far"), "it goes up")
        viewer.wait_frames(3)
        for _ in range(9):
            viewer.key("Down")
        viewer.key("Up")  # hills.sward is the last
        viewer.wait(lambda: viewer.shows("Files/ground.glb") == "selected", "keys select")
        viewer.key("Escape")
        viewer.wait(lambda: "Files/Folder" not in viewer.controls(), "Escape closes the dialog only")
        self.assertTrue(viewer.shows("Field/File").endswith("hills.sward"))
        self.browse(viewer)
        viewer.type("far/plane.sward")
        viewer.wait_frames(2)
        viewer.key("Return")
        viewer.wait_for_value("Field/File", lambda shown: shown == "far/plane.sward", "it is opened")
        self.assert_ends_well(viewer)


class LongDialogTest(DialogCase):
    def test_a_bake_is_saved_under_a_name_in_a_chosen_folder(self):
        viewer = self.open("ground.glb", "--meadow", "grass")
        viewer.press("Save field as...", panel="Field")
        viewer.wait_for_value("Files/Name", lambda shown: shown == "ground.sward", "it proposes a name")
        viewer.wait_frames(3)
        viewer.click("Files/far/", 0.1)
        viewer.click("Files/far/", 0.1)
        viewer.wait(lambda: viewer.shows("Files/Folder").endswith("far"), "a second click enters it")
        viewer.click("Files/Save")
        saved = self.folder / "far" / "ground.sward"
        viewer.wait(saved.exists, "it is written")
        viewer.wait_for_value("Field/Saved", lambda shown: shown == "far/ground.sward", "it is told")
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
