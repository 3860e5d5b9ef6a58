"""What can be opened in the viewer's window, and what goes wrong with it."""

import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display  # noqa: E402
from viewer import Viewer  # noqa: E402

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ROOT = Path(__file__).resolve().parents[2]


class OpeningTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-view-")
        cls.addClassCleanup(folder.cleanup)
        cls.whole = Path(folder.name) / "whole.sward"
        subprocess.run([SWARD, "bake", "hills", "--count", "1500", "--blade-scale", "8", "-o",
                        cls.whole, "-q"], check=True)
        cls.mesh = Path(folder.name) / "plane.glb"
        subprocess.run([SWARD, "terrain", "plane", "-o", cls.mesh], check=True)

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-view-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.field = self.folder / "hills.sward"
        shutil.copy(self.whole, self.field)
        self.display = Display()
        self.addCleanup(self.display.close)
        # Where a bake writes its field before it is shown.
        self.scratch = self.folder / "scratch"
        self.scratch.mkdir()

    def open(self, *arguments, field=True, **process):
        viewer = Viewer(VIEWER, self.display, self.folder, [*arguments, "--size", "800x600"],
                        {"TMPDIR": str(self.scratch)}, **process)
        self.addCleanup(viewer.close)
        if field:
            viewer.wait_for_field()
        else:
            viewer.wait_for_window()
            viewer.wait(viewer.controls, "it tells of its controls")
        return viewer

    def assert_ends_well(self, viewer):
        code, said = viewer.end()
        self.assertEqual(code, 0, said)
        self.assertIn("0 validation messages", said)
        self.assertEqual(list(self.scratch.iterdir()), [], "nothing half written is left")

    def set_ground(self, viewer, name):
        """Types the name of a ground into the panel Meadow."""
        viewer.press("Ground", panel="Meadow")
        self.display.xdotool("key", "--window", viewer.window.number, "ctrl+a")
        viewer.wait_frames(2)
        self.display.xdotool("type", "--window", viewer.window.number, "--delay", "150", name)
        viewer.wait_for_value("Meadow/Ground", lambda shown: shown == name, "it is typed")

    def test_without_a_file_it_waits_for_one_and_remembers_it(self):
        viewer = self.open(field=False)
        self.assertIn("Welcome/hills", viewer.controls())
        self.assert_ends_well(viewer)
        self.assert_ends_well(self.open(self.field))
        viewer = self.open("--panel", "field", field=False)
        viewer.click("Field/hills.sward")
        viewer.wait_for_field()
        self.assertTrue(viewer.shows("Field/File").endswith("hills.sward"))
        self.assert_ends_well(viewer)

    def test_it_is_baked_again_and_the_difference_is_told(self):
        viewer = self.open(self.mesh, "--panel", "meadow", "--meadow", "grass")
        self.assertTrue(viewer.shows("Meadow/Ground").endswith("plane.glb"))
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

    def test_a_damaged_ground_tells_why_and_keeps_the_field(self):
        (self.folder / "broken.glb").write_bytes(b"glTF no more")
        viewer = self.open(self.field)
        self.set_ground(viewer, "broken.glb")
        viewer.press("Bake again", panel="Meadow")
        viewer.wait_for_value("Message/Error", lambda shown: "broken.glb" in shown, "it complains")
        viewer.open_panel("Field")
        self.assertTrue(viewer.shows("Field/File").endswith("hills.sward"), "the field is kept")
        viewer.click("Message/Close")
        viewer.wait(lambda: "Message/Error" not in viewer.controls(), "the message is gone")
        self.assert_ends_well(viewer)

    def test_the_window_is_there_in_a_second_and_usable_before_its_field(self):
        begin = time.monotonic()
        viewer = self.open(self.mesh, field=False)
        # No slow work precedes the window: it opens in a tenth of this limit.
        self.assertLess(time.monotonic() - begin, 1.0)
        baker = viewer.wait(lambda: self.child_of(viewer), "the baker runs")
        os.kill(baker, signal.SIGSTOP)
        self.assertEqual(viewer.shows("Status/Numbers"), "no field")
        self.assertIn("Baking", viewer.shows("Message/Notice"))
        viewer.open_panel("Physics")
        viewer.set("Recovery", "Physics", 0.9)
        self.assertGreater(float(viewer.shows("Physics/Recovery")), 20)
        viewer.key("h")
        self.assertIn("Keys/Close", viewer.controls())
        viewer.key("h")
        os.kill(baker, signal.SIGCONT)
        viewer.wait_for_field()
        self.assert_ends_well(viewer)

    def test_a_bake_that_is_killed_or_cancelled_harms_nothing(self):
        viewer = self.open(self.field)
        self.set_ground(viewer, "hills")
        # As many blades as take a while.
        viewer.set("Count", "Meadow", 0.3)
        viewer.wait_for_value("Meadow/Count", lambda shown: int(shown) > 10**6, "many blades")
        for end in ("kill", "cancel"):
            with self.subTest(end=end):
                viewer.press("Bake again", panel="Meadow")
                if end == "kill":
                    child = viewer.wait(lambda: self.child_of(viewer), "the baker runs")
                    os.kill(child, signal.SIGKILL)
                    viewer.wait_for_value("Message/Error", lambda shown: "signal 9" in shown,
                                          "it tells of the signal")
                    viewer.click("Message/Close")
                else:
                    viewer.wait(lambda: self.child_of(viewer), "the baker runs")
                    viewer.click("Meadow/Cancel")
                    viewer.wait(lambda: "Meadow/Cancel" not in viewer.controls(), "it has ended")
                self.assertIsNone(viewer.process.poll())
        self.assert_ends_well(viewer)

    def test_a_disk_that_is_full_ends_a_bake_and_harms_nothing(self):
        # Limit the file size; writing then fails with an error, because the signal stays ignored.
        viewer = self.open(self.field, restore_signals=False)
        self.set_ground(viewer, "hills")
        _, most = resource.prlimit(viewer.process.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(viewer.process.pid, resource.RLIMIT_FSIZE, (100_000, most))
        viewer.press("Bake again", panel="Meadow")
        viewer.wait_for_value("Message/Error", lambda shown: "field.sward" in shown, "it complains")
        viewer.open_panel("Field")
        self.assertTrue(viewer.shows("Field/File").endswith("hills.sward"), "the field is kept")
        self.assert_ends_well(viewer)

    def child_of(self, viewer):
        """The process of the baker, stopped so that it does not end before we act."""
        children = subprocess.run(["pgrep", "-P", str(viewer.process.pid), "-x", "sward"],
                                  capture_output=True, text=True).stdout.split()
        return int(children[0]) if children else None

    def test_a_field_and_a_mesh_are_dropped_on_the_window(self):
        viewer = self.open("--panel", "field", field=False)
        for file in (self.field, self.mesh):
            with self.subTest(file=file.name):
                # Use a separate process: Xlib ends the whole program on an error.
                subprocess.run([sys.executable, Path(__file__).with_name("drop.py"),
                                self.display.name, viewer.window.number, file.as_uri()], check=True)
                viewer.wait_for_value("Field/File", lambda shown: shown == str(file),
                                      "it shows what was dropped")
        self.assert_ends_well(viewer)

    def test_what_is_watched_is_opened_again(self):
        viewer = self.open(self.field, "--watch", "--panel", "field")
        self.assertEqual(viewer.shows("Field/Blades"), "1 500")
        subprocess.run([SWARD, "bake", "hills", "--count", "700", "--blade-scale", "8", "-o",
                        self.field, "--force", "-q"], check=True)
        viewer.wait_for_value("Field/Blades", lambda shown: shown == "700", "it shows the new one")
        # A damaged, then deleted file: the last valid field stays.
        other = self.folder / "damaged"
        other.write_bytes(self.field.read_bytes()[:2000])
        other.rename(self.field)
        viewer.wait_for_value("Message/Error", lambda shown: "hills.sward" in shown, "it complains")
        self.field.unlink()
        viewer.wait_for_value("Message/Error", lambda shown: "was removed" in shown, "it is told")
        self.assertEqual(viewer.shows("Field/Blades"), "700")
        self.assert_ends_well(viewer)

    def test_a_file_that_is_cut_and_removed_while_it_is_shown_harms_nothing(self):
        viewer = self.open(self.field, "--camera", "top", "--panel", "field")
        viewer.key("space")
        # Overwrite in place, as `cp` does: a program that maps the file would get a signal.
        os.truncate(self.field, 100)
        for x in range(450, 700, 16):
            viewer.click_at(x, 260)
            if viewer.shows("Blade/Id"):
                break
        self.assertIn("Blade/Id", viewer.controls(), "a blade is met")
        viewer.click("Blade/Deselect")
        self.field.unlink()
        viewer.wait_for_value("Message/Error", lambda shown: "hills.sward: the file was removed" in shown,
                              "it is told")
        self.assertEqual(viewer.shows("Field/Blades"), "1 500")
        self.assert_ends_well(viewer)

    def test_a_mesh_is_baked_again_when_it_or_its_meadow_changes(self):
        mesh, meadow = self.folder / "ground.glb", self.folder / "own.json"
        shutil.copy(self.mesh, mesh)
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

    def test_a_picture_that_cannot_be_written_is_told(self):
        # Limit the file size; writing then fails with an error, because the signal stays ignored.
        viewer = self.open(self.field, "--panel", "capture", restore_signals=False)
        _, most = resource.prlimit(viewer.process.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(viewer.process.pid, resource.RLIMIT_FSIZE, (50_000, most))
        viewer.key("p")
        viewer.wait_for_value("Message/Error", lambda shown: "sward.png" in shown, "it complains")
        self.assertEqual(list(self.folder.glob("*.png*")), [], "nothing half written is left")
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
