"""What can be opened in the viewer's window, and what goes wrong with it."""

import json
import os
import resource
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from viewer import child_of  # noqa: E402
from window_case import ROOT, SWARD, WindowCase  # noqa: E402


class OpeningCase(WindowCase):
    SIZE = (800, 600)

    def setUp(self):
        super().setUp()
        # Where a bake writes its field before it is shown.
        self.scratch = self.folder / "scratch"
        self.scratch.mkdir()

    def start(self, *arguments, **options):
        return super().start(*arguments, environment={"TMPDIR": str(self.scratch)}, **options)

    def open_without_field(self, *arguments):
        viewer = self.start(*arguments)
        viewer.wait_for_window()
        return viewer

    def assert_ends_well(self, viewer):
        super().assert_ends_well(viewer)
        self.assertEqual(list(self.scratch.iterdir()), [], "nothing half written is left")


class OpeningTest(OpeningCase):
    def test_without_a_file_it_waits_for_one_that_is_dropped_on_it_or_that_it_remembers(self):
        viewer = self.open_without_field("--panel", "field")
        self.assertIn("Welcome/hills", viewer.controls())
        for file in (self.field("hills"), self.mesh()):
            with self.subTest(file=file.name):
                self.drop(viewer, file)
                viewer.wait_for_value("Field/File", lambda shown: shown == str(file),
                                      "it shows what was dropped")
        self.assert_ends_well(viewer)
        self.assert_ends_well(self.open(self.field(name="other.sward")))
        viewer = self.open_without_field("--panel", "field")
        viewer.click("Field/other.sward")
        viewer.wait_for_field()
        self.assertTrue(viewer.shows("Field/File").endswith("other.sward"))
        self.assert_ends_well(viewer)

    def test_a_window_that_opens_a_ground_does_not_say_that_there_is_none_and_bakes_it_again(self):
        viewer = self.start(self.mesh(), "--panel", "field", "--meadow", "grass")
        seen = {}
        viewer.wait(lambda: seen.update(viewer.controls()) or "Field/File" in seen, "it is open")
        self.assertIn("Field/Opening", seen)
        for name in ("Field/No field", "Welcome/hills"):
            self.assertNotIn(name, seen)
        viewer.wait_for_field()
        viewer.open_panel("Meadow")
        viewer.wait(lambda: (viewer.shows("Meadow/Ground") or "").endswith("plane.glb"), "it names its ground")
        before = viewer.shows("Status/Numbers").split(" blades")[0].split(" of ")[1]
        viewer.set("Slope to", "Meadow", 0.02)
        viewer.set("Random seed", "Meadow", 0.5)
        viewer.press("Bake again", panel="Meadow")
        viewer.wait_for_value("Meadow/Blades", lambda shown: shown.startswith(before),
                              "it tells the numbers before and after")
        self.assertIn("roots kept", viewer.shows("Meadow/Report"))
        viewer.press("Show before", panel="Meadow")
        viewer.wait_for_value("Meadow/Show before", lambda shown: shown == "on", "it shows it")
        self.assert_ends_well(viewer)

    def test_a_bake_of_a_damaged_ground_or_one_that_is_killed_or_cancelled_harms_nothing(self):
        (self.folder / "broken.glb").write_bytes(b"glTF no more")
        viewer = self.open(self.field("hills"))
        viewer.type_anew("Ground", "Meadow", "broken.glb")
        viewer.press("Bake again", panel="Meadow")
        viewer.wait_for_value("Message/Error", lambda shown: "broken.glb" in shown, "it complains")
        viewer.open_panel("Field")
        self.assertTrue(viewer.shows("Field/File").endswith("hills.sward"), "the field is kept")
        viewer.click("Message/Close")
        viewer.wait(lambda: "Message/Error" not in viewer.controls(), "the message is gone")

        viewer.type_anew("Ground", "Meadow", "hills")
        # As many blades as take a while.
        viewer.set("Count", "Meadow", 0.3)
        viewer.wait_for_value("Meadow/Count", lambda shown: int(shown) > 10**6, "many blades")
        for end in ("kill", "cancel"):
            with self.subTest(end=end):
                viewer.press("Bake again", panel="Meadow")
                child = viewer.wait(lambda: child_of(viewer), "the baker runs")
                if end == "kill":
                    os.kill(child, signal.SIGKILL)
                    viewer.wait_for_value("Message/Error", lambda shown: "signal 9" in shown,
                                          "it tells of the signal")
                    viewer.click("Message/Close")
                else:
                    viewer.click("Meadow/Cancel")
                    viewer.wait(lambda: "Meadow/Cancel" not in viewer.controls(), "it has ended")
                self.assertIsNone(viewer.process.poll())
        self.assert_ends_well(viewer)

    def test_what_is_watched_is_opened_again(self):
        field = self.field("hills")
        viewer = self.open(field, "--watch", "--panel", "field")
        self.assertEqual(viewer.shows("Field/Blades"), "1 500")
        subprocess.run([SWARD, "bake", "hills", "--count", "700", "--blade-scale", "8", "-o",
                        field, "--force", "-q"], check=True)
        viewer.wait_for_value("Field/Blades", lambda shown: shown == "700", "it shows the new one")
        # A damaged, then deleted file: the last valid field stays.
        other = self.folder / "damaged"
        other.write_bytes(field.read_bytes()[:2000])
        other.rename(field)
        viewer.wait_for_value("Message/Error", lambda shown: "hills.sward" in shown, "it complains")
        field.unlink()
        viewer.wait_for_value("Message/Error", lambda shown: "was removed" in shown, "it is told")
        self.assertEqual(viewer.shows("Field/Blades"), "700")
        self.assert_ends_well(viewer)

    def test_a_mesh_is_baked_again_when_it_or_its_meadow_changes(self):
        mesh, meadow = self.mesh(), self.folder / "own.json"
        sparse = json.loads((ROOT / "assets/meadows/lawn.json").read_text()) | {"cover_from_above": 0.01}
        meadow.write_text(json.dumps(sparse))
        viewer = self.open(mesh, "--meadow", meadow, "--watch", "--panel", "field")
        blades = viewer.shows("Field/Blades")
        self.assertIn("Field/bluegrass", viewer.controls())
        # Other grass of the same height: the species identify the meadow.
        text = meadow.read_text()
        meadow.write_text(text.replace('"bluegrass"', '"moorgrass"'))
        viewer.wait(lambda: "Field/moorgrass" in viewer.controls(), "the other meadow is sown")
        self.assertEqual(viewer.shows("Field/Blades"), blades)
        subprocess.run([SWARD, "terrain", "hills", "-o", mesh, "--force"], check=True)
        viewer.wait_for_value("Field/Blades", lambda shown: shown != blades, "the other ground bears")
        self.assertIn("Field/moorgrass", viewer.controls())
        self.assert_ends_well(viewer)


class LongOpeningTest(OpeningCase):
    def test_a_disk_that_is_full_ends_a_bake_and_a_picture_and_harms_nothing(self):
        # Limit the file size; writing then fails with an error, because the signal stays ignored.
        viewer = self.open(self.field("hills"), restore_signals=False)
        limit = lambda most: resource.prlimit(viewer.process.pid, resource.RLIMIT_FSIZE, (most, highest))
        _, highest = resource.prlimit(viewer.process.pid, resource.RLIMIT_FSIZE)
        viewer.type_anew("Ground", "Meadow", "hills")
        limit(100_000)
        viewer.press("Bake again", panel="Meadow")
        viewer.wait_for_value("Message/Error", lambda shown: "field.sward" in shown, "it complains")
        viewer.open_panel("Field")
        self.assertTrue(viewer.shows("Field/File").endswith("hills.sward"), "the field is kept")
        viewer.click("Message/Close")
        limit(50_000)
        viewer.key("p")
        viewer.wait_for_value("Message/Error", lambda shown: "sward.png" in shown, "it complains")
        self.assertEqual(list(self.folder.glob("*.png*")), [], "nothing half written is left")
        self.assert_ends_well(viewer)

    def test_a_file_that_is_cut_and_removed_while_it_is_shown_harms_nothing(self):
        field = self.field("hills")
        viewer = self.open(field, "--camera", "top", "--resolution", "0.4", "--panel", "field")
        viewer.key("space")
        # Overwrite in place, as `cp` does: a program that maps the file would get a signal.
        os.truncate(field, 100)
        for x in range(450, 700, 16):
            viewer.click_at(x, 260)
            if viewer.shows("Blade/Id"):
                break
        self.assertIn("Blade/Id", viewer.controls(), "a blade is met")
        viewer.click("Blade/Deselect")
        field.unlink()
        viewer.wait_for_value("Message/Error", lambda shown: "hills.sward: the file was removed" in shown,
                              "it is told")
        self.assertEqual(viewer.shows("Field/Blades"), "1 500")
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
