"""What a window on a CPU does while nothing changes: it draws a fine picture without keeping its user
waiting, and then nothing."""

import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display, share_that_differs, wait_until  # noqa: E402
from viewer import Viewer  # noqa: E402

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]

# Of the window at rest to the reference picture, which has 256 samples and no level of detail, in dB. It is nearer to
# that than a picture that render makes, with 31.8.
LEAST_PSNR = 31.5

# From an input to the first moving picture, seconds; a whole fine picture takes longer on two processors.
LONGEST_ANSWER = 1.0

IDLE_SHARE = 0.05  # of a processor, for the window's own ten looks a second at its input


def processor_seconds(pid):
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def read_png(path):
    """Rows of (blue, green, red), as Display.picture() has them."""
    data = Path(path).read_bytes()
    place, packed = 8, b""
    while place < len(data):
        size, kind = int.from_bytes(data[place:place + 4], "big"), data[place + 4:place + 8]
        content = data[place + 8:place + 8 + size]
        if kind == b"IHDR":
            width, height = (int.from_bytes(content[k:k + 4], "big") for k in (0, 4))
            channels = {2: 3, 6: 4}[content[9]]
        elif kind == b"IDAT":
            packed += content
        place += 12 + size
    raw, stride = zlib.decompress(packed), channels * width
    rows, above = [], bytes(stride)
    for y in range(height):
        mode, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = line[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            line[i] = (line[i] + predicted(mode, left, above[i], corner)) & 255
        rows.append([(line[i + 2], line[i + 1], line[i]) for i in range(0, stride, channels)])
        above = bytes(line)
    return rows


def predicted(mode, left, up, corner):
    """What PNG's filters of a row subtract."""
    if mode < 3:
        return (0, left, up)[mode]
    if mode == 3:
        return (left + up) // 2
    return min((left, up, corner), key=lambda value: abs(left + up - corner - value))


def psnr(first, second):
    squares = [(a - b) ** 2 for row, other in zip(first, second)
               for pixel, twin in zip(row, other) for a, b in zip(pixel, twin)]
    return 10 * math.log10(255 ** 2 / max(statistics.fmean(squares), 1e-9))


class RestTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-rest-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.field = cls.folder / "hills.sward"
        subprocess.run([SWARD, "bake", "hills", "--count", "20000", "--blade-scale", "3", "-o",
                        cls.field, "-q"], check=True)

    def start(self, *arguments):
        self.display = Display()
        self.addCleanup(self.display.close)
        # The cursor lies beside the window.
        self.display.xdotool("mousemove", Display.WIDTH - 1, Display.HEIGHT - 1)
        viewer = Viewer(VIEWER, self.display, self.folder,
                        [self.field, "--camera", "eye", *arguments], rests=True)
        self.addCleanup(viewer.close)
        viewer.window = viewer.wait(lambda: self.display.find("Sward.*blades drawn"),
                                    "the title tells how many blades are drawn")
        return viewer

    def pictures(self, viewer):
        """Pictures in the mean that the title tells; nothing while the window moves."""
        time.sleep(0.2)
        told = re.search(r"(\d+) of \d+ pictures at rest", viewer.window.title())
        return int(told.group(1)) if told else None

    def wait_for_the_end(self, viewer):
        viewer.wait(lambda: self.pictures(viewer) == 16, "the picture is fine")

    def test_it_shows_the_picture_that_render_makes_and_then_rests(self):
        size = "240x150"
        viewer = self.start("--size", size, "--panel", "off", "--wind-strength", "0")
        moving = viewer.window.picture()
        self.wait_for_the_end(viewer)
        fine = viewer.window.picture()
        render = [VIEWER, "render", self.field, "--camera", "eye", "--size", size,
                  "--wind-strength", "0", "-q", "-o"]
        subprocess.run([*render, self.folder / "four.png"], check=True)
        subprocess.run([*render, self.folder / "all.png", "--reference"], check=True)
        reference = read_png(self.folder / "all.png")
        at_rest, before, rendered = (psnr(picture, reference) for picture in (
            fine, moving, read_png(self.folder / "four.png")))
        print(f"PSNR to the reference: {at_rest:.1f} dB at rest, {before:.1f} before, "
              f"{rendered:.1f} by render")
        self.assertGreater(at_rest, LEAST_PSNR)
        self.assertGreater(at_rest, rendered)
        self.assertLess(before, LEAST_PSNR)

        begin, used = time.monotonic(), processor_seconds(viewer.process.pid)
        time.sleep(3)
        share = (processor_seconds(viewer.process.pid) - used) / (time.monotonic() - begin)
        print(f"{100 * share:.1f} % of a processor at rest")
        self.assertLess(share, IDLE_SHARE)

        # What the server has forgotten is drawn again.
        viewer.window.hide()
        time.sleep(0.5)
        viewer.window.show()
        wait_until(lambda: share_that_differs(fine, viewer.window.picture()) < 0.01,
                   "it is shown again")
        self.assertEqual(viewer.end()[0], 0)

    def test_time_stands_still_until_something_changes(self):
        viewer = self.start("--size", "480x440", "--wind-strength", "8")
        self.wait_for_the_end(viewer)
        before = viewer.window.picture()
        time.sleep(1)
        self.assertEqual(share_that_differs(before, viewer.window.picture()), 0.0)
        self.assertEqual(self.pictures(viewer), 16)
        for name, change in (("the wheel", lambda: viewer.window.wheel(2)),
                             ("a pause", lambda: viewer.key("space")),
                             ("another size", lambda: viewer.window.resize(500, 450))):
            change()
            viewer.wait(lambda: self.pictures(viewer) != 16, f"{name} begins it anew")
            self.wait_for_the_end(viewer)
        viewer.key("space")
        self.assertGreater(share_that_differs(before, viewer.window.picture()), 0.05)
        # A switch lets it draw on.
        viewer.press("Refine at rest", panel="Profile")
        viewer.wait(lambda: self.pictures(viewer) is None, "it moves again")
        time.sleep(2)
        self.assertIsNone(self.pictures(viewer))
        self.assertEqual(viewer.end()[0], 0)

    def test_input_is_answered_while_it_refines(self):
        viewer = self.start("--size", "1280x720")
        answers = []
        for i in range(5):
            viewer.wait(lambda: viewer.shows("Status/Refined"), "it refines")
            begin = time.monotonic()
            viewer.window.wheel(1 if i % 2 else -1)
            viewer.wait(lambda: not viewer.shows("Status/Refined"), "it moves")
            answers.append(time.monotonic() - begin)
        print("answers after", ", ".join(f"{1000 * answer:.0f}" for answer in answers), "ms")
        self.assertLess(statistics.median(answers), LONGEST_ANSWER)
        self.assertEqual(viewer.end()[0], 0)


if __name__ == "__main__":
    unittest.main()
