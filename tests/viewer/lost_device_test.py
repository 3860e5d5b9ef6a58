"""The programs report a lost device by a message and exit code 4, and leave no partial file.
Our own layer simulates the loss after a number of submissions."""

import os
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window_case import VIEWER, WindowCase  # noqa: E402

RUNTIME = 4


def losing_after(submissions):
    return {**os.environ, "VK_ADD_LAYER_PATH": os.environ["SWARD_TEST_LAYERS"],
            "VK_INSTANCE_LAYERS": "VK_LAYER_SWARD_lost_device",
            "SWARD_LOST_AFTER": str(submissions)}


class LostDeviceTest(WindowCase):
    def setUp(self):
        super().setUp()
        self.hills = self.field("hills", 1000)

    def assert_told(self, code, said):
        self.assertEqual(code, RUNTIME, said)
        self.assertIn("the device was lost", said)
        self.assertEqual(len([line for line in said.splitlines() if "error" in line]), 1, said)

    def test_a_picture_is_whole_or_not_there(self):
        # While it uploads, while it draws the first picture, between pictures.
        for submissions in (0, 2, 6, 12):
            with self.subTest(submissions=submissions):
                done = subprocess.run(
                    [VIEWER, "render", self.hills, "-o", self.folder / "p_%d.png", "--frames",
                     "0:20", "--size", "48x32"], env=losing_after(submissions),
                    capture_output=True, text=True, timeout=120)
                self.assert_told(done.returncode, done.stderr)
                self.assertEqual(done.stdout, "")
                written = sorted(path.name for path in self.folder.iterdir())
                written.remove(self.hills.name)
                self.assertEqual(written, [f"p_{i}.png" for i in range(len(written))])
                for name in written:
                    picture = (self.folder / name).read_bytes()
                    self.assertTrue(picture.endswith(b"IEND\xaeB`\x82"), f"{name} is cut off")
                    (self.folder / name).unlink()

    def test_the_window_tells_and_ends(self):
        begin = time.monotonic()
        done = subprocess.run(
            [VIEWER, self.hills, "--size", "320x240", "--exit-after", "100"],
            env={**losing_after(30), "DISPLAY": self.display.name,
                 "XDG_STATE_HOME": str(self.folder / "state")},
            capture_output=True, text=True, timeout=120)
        self.assert_told(done.returncode, done.stderr)
        self.assertLess(time.monotonic() - begin, 90, "it has not waited to be closed")
        self.assertEqual(list(self.folder.glob("**/*.part*")), [])


if __name__ == "__main__":
    unittest.main()
