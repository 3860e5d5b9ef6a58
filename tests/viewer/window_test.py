"""The viewer's window, on a real X server, under the validation layer, steered like a user would."""

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display, share_that_differs, wait_until  # noqa: E402

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
SIZE = (480, 320)


class WindowTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-view-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.field = cls.folder / "hills.sward"
        subprocess.run([SWARD, "bake", "hills", "--count", "2000", "--blade-scale", "6", "-o",
                        cls.field, "-q"], check=True)

    def setUp(self):
        self.display = Display()
        self.addCleanup(self.display.close)

    def start(self, *arguments):
        """Starts the viewer; whatever happens, it does not outlive the test."""
        viewer = subprocess.Popen(
            [VIEWER, *map(str, arguments), "--validation", "--panel", "off", "--resolution",
             "1", "--size", "{}x{}".format(*SIZE)],
            env={**os.environ, "DISPLAY": self.display.name,
                 "XDG_STATE_HOME": str(self.folder / "state")},
            stderr=subprocess.PIPE, text=True)
        self.addCleanup(viewer.stderr.close)
        self.addCleanup(viewer.wait)
        self.addCleanup(viewer.kill)
        return viewer

    def open(self, *arguments):
        """Starts the viewer and waits until it draws."""
        viewer = self.start(*(arguments or [self.field]))

        def drawing():
            if viewer.poll() is not None:
                self.fail(f"ended with {viewer.returncode}: {viewer.stderr.read()}")
            return self.display.find("Sward.*blades drawn")

        return viewer, wait_until(drawing, "the title tells how many blades are drawn")

    def stop_time(self, window):
        """Pauses; returns the picture once it stands still."""
        window.key("space")
        return self.settled(window)

    def settled(self, window):
        """The picture once it has stood still for longer than a frame takes on a busy machine."""
        last, since = [window.picture()], [time.monotonic()]

        def stands():
            time.sleep(0.1)
            before, last[0] = last[0], window.picture()
            if share_that_differs(before, last[0]) > 0:
                since[0] = time.monotonic()
            return time.monotonic() - since[0] > 1.5

        wait_until(stands, "the picture stands still")
        return last[0]

    def assert_ends(self, viewer, code=0, says="0 validation messages"):
        text = viewer.communicate(timeout=60)[1]
        self.assertEqual(viewer.returncode, code, text)
        self.assertIn(says, text)

    def test_grass_is_seen_and_escape_ends_it(self):
        viewer, window = self.open(self.field, "--camera", "eye")
        pixels = [pixel for row in window.picture() for pixel in row]
        green = sum(1 for blue, green, red in pixels if green > red + 10 and green > blue + 10)
        self.assertGreater(green / len(pixels), 0.02, "no grass is to be seen")
        self.assertGreater(len(set(pixels)), 200, "the picture has hardly any colours")
        window.key("Escape")
        self.assert_ends(viewer)

    def test_its_close_button_ends_it(self):
        viewer, window = self.open()
        window.ask_to_close()
        self.assert_ends(viewer)

    def test_the_mouse_moves_the_camera_and_home_returns(self):
        viewer, window = self.open()
        start = self.stop_time(window)
        moves = {"turn": lambda: window.drag((100, 100), (300, 180)),
                 "pan": lambda: window.drag((200, 200), (260, 150), button=2),
                 "dolly": lambda: window.wheel(5)}
        for name, move in moves.items():
            with self.subTest(move=name):
                move()
                wait_until(lambda: share_that_differs(start, window.picture()) > 0.1, "it has moved")
                self.settled(window)
                window.key("Home")
                wait_until(lambda: share_that_differs(start, window.picture()) < 0.005,
                           "it has returned")
        window.key("Escape")
        self.assert_ends(viewer)

    def test_the_wind_blows_until_time_is_stopped(self):
        viewer, window = self.open(self.field, "--camera", "eye", "--wind-strength", "8")
        before = window.picture()
        wait_until(lambda: share_that_differs(before, window.picture()) > 0.01, "blades move")
        self.stop_time(window)
        window.key("Escape")
        self.assert_ends(viewer)

    def test_it_survives_ten_sizes_and_being_hidden(self):
        viewer, window = self.open()
        for i in range(10):
            width, height = 200 + 61 * i, 640 - 53 * i
            window.resize(width, height)
            wait_until(lambda: window.geometry()[2:] == (width, height), "the window has its size")
            # The whole new area is drawn: its last column is not the server's black.
            wait_until(lambda: all(max(row[-1]) > 0 for row in window.picture()), "it fills it")
        window.hide()
        time.sleep(0.5)
        self.assertIsNone(viewer.poll())
        window.show()
        wait_until(lambda: all(max(row[-1]) > 0 for row in window.picture()), "it is drawn again")
        window.key("Escape")
        self.assert_ends(viewer)

    def test_it_closes_by_itself_when_told_to(self):
        self.assert_ends(self.start(self.field, "--exit-after", "0.5"))

    def test_an_interrupt_ends_it_with_130(self):
        viewer, _ = self.open()
        viewer.send_signal(signal.SIGINT)
        self.assert_ends(viewer, code=130, says="interrupted")

    def test_a_mesh_is_baked_first(self):
        mesh = self.folder / "plane.glb"
        subprocess.run([SWARD, "terrain", "plane", "-o", mesh], check=True)
        viewer = self.start(mesh, "--exit-after", "0.5")
        self.assert_ends(viewer, says="baking it first")

    def test_a_mesh_that_cannot_be_baked_ends_with_the_baker_s_code(self):
        broken = self.folder / "broken.glb"
        broken.write_bytes(b"glTF no more")
        for mesh, code in ((broken, 3), (self.folder / "missing.glb", 2)):
            with self.subTest(mesh=mesh.name):
                self.assert_ends(self.start(mesh), code=code, says=mesh.name)

    def test_a_broken_field_is_refused(self):
        broken = self.folder / "broken.sward"
        broken.write_bytes(self.field.read_bytes()[:1000])
        self.assert_ends(self.start(broken), code=3, says="broken.sward")

    def test_without_a_display_it_points_to_render(self):
        viewer = self.start_without_display()
        self.assert_ends(viewer, code=4, says="sward-view render")

    def start_without_display(self):
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        viewer = subprocess.Popen([VIEWER, str(self.field)], env=environment,
                                  stderr=subprocess.PIPE, text=True)
        self.addCleanup(viewer.stderr.close)
        self.addCleanup(viewer.wait)
        self.addCleanup(viewer.kill)
        return viewer


if __name__ == "__main__":
    unittest.main()
