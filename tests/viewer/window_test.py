"""The viewer's window, on a real X server, under the validation layer, steered like a user would."""

import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import share_that_differs, wait_until  # noqa: E402
from window_case import VIEWER, WindowCase  # noqa: E402


class WindowTest(WindowCase):
    SIZE = (480, 320)

    def start(self, *arguments):
        return super().start(*arguments, "--panel", "off", "--resolution", "1")

    def open(self, *arguments):
        """Starts the viewer and waits until it draws."""
        viewer = self.start(*(arguments or [self.field("hills", 2000, 6)]))
        viewer.wait_for_title()
        return viewer, viewer.window

    def stop_time(self, viewer):
        """Pauses; returns the picture once it stands still."""
        viewer.window.key("space")
        return self.settled(viewer)

    def settled(self, viewer):
        """The picture once it has stood still for some frames."""
        last = [viewer.window.picture()]

        def stands():
            viewer.wait_frames(5)
            before, last[0] = last[0], viewer.window.picture()
            return share_that_differs(before, last[0]) == 0

        wait_until(stands, "the picture stands still")
        return last[0]

    def assert_ends(self, viewer, code=0, says="0 validation messages"):
        viewer.process.wait(timeout=60)
        self.assertEqual(viewer.process.returncode, code, viewer.said())
        self.assertIn(says, viewer.said())

    def test_grass_is_seen_the_wind_blows_until_time_is_stopped_and_escape_ends_it(self):
        viewer, window = self.open(self.field("hills", 2000, 6), "--camera", "eye", "--wind-strength", "8")
        before = window.picture()
        blue, green, red = before[..., 0], before[..., 1], before[..., 2]
        self.assertGreater(((green > red + 10) & (green > blue + 10)).mean(), 0.02, "no grass is to be seen")
        colours = {tuple(pixel) for row in before.tolist() for pixel in row}
        self.assertGreater(len(colours), 200, "the picture has hardly any colours")
        wait_until(lambda: share_that_differs(before, window.picture()) > 0.01, "blades move")
        self.stop_time(viewer)
        window.key("Escape")
        self.assert_ends(viewer)

    def test_the_mouse_moves_the_camera_home_returns_and_an_interrupt_ends_it_with_130(self):
        viewer, window = self.open()
        start = self.stop_time(viewer)
        moves = {"turn": lambda: window.drag((100, 100), (300, 180)),
                 "pan": lambda: window.drag((200, 200), (260, 150), button=2),
                 "dolly": lambda: window.wheel(5)}
        for name, move in moves.items():
            with self.subTest(move=name):
                move()
                wait_until(lambda: share_that_differs(start, window.picture()) > 0.1, "it has moved")
                self.settled(viewer)
                window.key("Home")
                wait_until(lambda: share_that_differs(start, window.picture()) < 0.005,
                           "it has returned")
        viewer.process.send_signal(signal.SIGINT)
        self.assert_ends(viewer, code=130, says="interrupted")

    def test_it_survives_ten_sizes_and_being_hidden_and_its_close_button_ends_it(self):
        viewer, window = self.open()
        is_filled = lambda: (window.picture()[:, -1].max(axis=1) > 0).all()
        for i in range(10):
            width, height = 200 + 61 * i, 640 - 53 * i
            window.resize(width, height)
            wait_until(lambda: window.geometry()[2:] == (width, height), "the window has its size")
            # The whole new area is drawn: its last column is not the server's black.
            wait_until(is_filled, "it fills it")
        window.hide()
        time.sleep(0.5)
        self.assertIsNone(viewer.process.poll())
        window.show()
        wait_until(is_filled, "it is drawn again")
        window.ask_to_close()
        self.assert_ends(viewer)

    def test_a_mesh_is_baked_first_and_it_closes_by_itself_when_told_to(self):
        viewer = self.start(self.mesh(), "--exit-after", "0.5")
        self.assert_ends(viewer)
        self.assertIn("baking it first", viewer.said())

    def test_a_mesh_that_cannot_be_baked_ends_with_the_baker_s_code(self):
        broken = self.folder / "broken.glb"
        broken.write_bytes(b"glTF no more")
        for mesh, code in ((broken, 3), (self.folder / "missing.glb", 2)):
            with self.subTest(mesh=mesh.name):
                self.assert_ends(self.start(mesh), code=code, says=mesh.name)

    def test_a_broken_field_is_refused(self):
        broken = self.field(name="broken.sward")
        broken.write_bytes(broken.read_bytes()[:1000])
        self.assert_ends(self.start(broken), code=3, says="broken.sward")

    def test_without_a_display_it_points_to_render(self):
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = subprocess.run([VIEWER, self.field()], env=environment, capture_output=True, text=True, timeout=60,
                              check=False)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("sward-view render", done.stderr)


if __name__ == "__main__":
    unittest.main()
