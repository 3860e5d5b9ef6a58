"""What a window on a CPU does while nothing changes: it draws a fine picture, and then nothing. How soon it
answers is in pace_test.py."""

import math
import re
import subprocess
import sys
import time
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display, share_that_differs, wait_until  # noqa: E402
from viewer import processor_seconds  # noqa: E402
from window_case import VIEWER, WindowCase  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parents[1] / "cli/view"))
from png import picture_of  # noqa: E402

# Of the window at rest to the reference picture, which has 256 samples and no level of detail, in dB. It is
# nearer to that than a picture that render makes, with 31.8.
LEAST_PSNR = 31.5

# Of the window at rest to a picture of render, above that of the moving window, in dB; it is 6.9 above it.
FINER = 5.0

IDLE_SHARE = 0.05  # of a processor, for the window's own ten looks a second at its input


def psnr(first, second):
    squares = (first.astype(float) - second) ** 2
    return 10 * math.log10(255 ** 2 / max(squares.mean(), 1e-9))


class RestCase(WindowCase):
    SIZE = (240, 150)

    def open(self, *arguments, size=None):
        # The cursor lies beside the window.
        self.display.xdotool("mousemove", Display.WIDTH - 1, Display.HEIGHT - 1)
        viewer = self.start("--camera", "eye", *arguments, size=size, rests=True)
        viewer.wait_for_title()
        return viewer

    def pictures(self, viewer):
        """Pictures in the mean that the title tells; nothing while the window moves."""
        time.sleep(0.2)
        told = re.search(r"(\d+) of \d+ pictures at rest", viewer.window.title())
        return int(told.group(1)) if told else None

    def wait_for_the_end(self, viewer):
        viewer.wait(lambda: self.pictures(viewer) == 16, "the picture is fine")

    def open_calm_hills(self):
        hills = self.field("hills", 20000, 3)
        return hills, self.open(hills, "--panel", "off", "--wind-strength", "0")

    def render(self, field, *arguments):
        picture = self.folder / "render.png"
        subprocess.run([VIEWER, "render", field, "--camera", "eye", "--size", "{}x{}".format(*self.SIZE),
                        "--wind-strength", "0", "-q", "--force", "-o", picture, *arguments], check=True)
        return picture_of(picture)[..., ::-1]  # (blue, green, red), as Display.picture() has them


class RestTest(RestCase):
    def test_it_shows_the_picture_that_render_makes_and_then_rests(self):
        hills, viewer = self.open_calm_hills()
        moving = viewer.window.picture()
        self.wait_for_the_end(viewer)
        fine = viewer.window.picture()
        rendered = self.render(hills)
        at_rest, before = (psnr(picture, rendered) for picture in (fine, moving))
        print(f"PSNR to render: {at_rest:.1f} dB at rest, {before:.1f} before")
        self.assertGreater(at_rest, before + FINER)

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
        self.assert_ends_well(viewer)

    def test_time_stands_still_until_something_changes(self):
        viewer = self.open(self.field(), "--wind-strength", "8", size=(440, 320))
        self.wait_for_the_end(viewer)
        before = viewer.window.picture()
        time.sleep(1)
        self.assertEqual(share_that_differs(before, viewer.window.picture()), 0.0)
        self.assertEqual(self.pictures(viewer), 16)
        viewer.window.wheel(2)
        viewer.wait(lambda: self.pictures(viewer) != 16, "the wheel begins it anew")
        self.wait_for_the_end(viewer)
        after = viewer.window.picture()
        self.assertGreater(share_that_differs(before, after), 0.05)
        # A switch lets it draw on.
        viewer.press("Refine at rest", panel="Profile")
        viewer.wait(lambda: self.pictures(viewer) is None, "it moves again")
        time.sleep(2)
        self.assertIsNone(self.pictures(viewer))
        self.assert_ends_well(viewer)


class LongRestTest(RestCase):
    """A reference picture takes half a minute; other pictures at rest."""

    def test_its_picture_is_nearer_to_the_reference_than_that_of_render(self):
        hills, viewer = self.open_calm_hills()
        moving = viewer.window.picture()
        self.wait_for_the_end(viewer)
        fine = viewer.window.picture()
        reference = self.render(hills, "--reference")
        at_rest, before, rendered = (psnr(picture, reference) for picture in (fine, moving, self.render(hills)))
        print(f"PSNR to the reference: {at_rest:.1f} dB at rest, {before:.1f} before, "
              f"{rendered:.1f} by render")
        self.assertGreater(at_rest, LEAST_PSNR)
        self.assertGreater(at_rest, rendered)
        self.assertLess(before, LEAST_PSNR)
        self.assert_ends_well(viewer)

    def test_a_pause_and_another_size_begin_it_anew(self):
        viewer = self.open(self.field(), "--wind-strength", "8", size=(440, 320))
        self.wait_for_the_end(viewer)
        before = viewer.window.picture()
        for name, change in (("a pause", lambda: viewer.key("space")),
                             ("another size", lambda: viewer.window.resize(460, 330))):
            change()
            viewer.wait(lambda: self.pictures(viewer) != 16, f"{name} begins it anew")
            self.wait_for_the_end(viewer)
        viewer.key("space")
        after = viewer.window.picture()[:before.shape[0], :before.shape[1]]
        self.assertGreater(share_that_differs(before, after), 0.05)
        self.assert_ends_well(viewer)

    def test_the_fine_picture_appears_as_a_whole(self):
        viewer = self.open(self.field("hills", 4000, 4), "--panel", "off", "--wind-strength", "0", size=(440, 320))
        shown = [viewer.window.picture()]
        end = lambda: self.pictures(viewer) == 16
        while not end():
            picture = viewer.window.picture()
            # Twice the same: not while the server copies it.
            if np.array_equal(picture, viewer.window.picture()) and not np.array_equal(picture, shown[-1]):
                shown.append(picture)
        shown.append(viewer.window.picture())
        fine = [picture for picture in shown if psnr(picture, shown[-1]) > 30]
        self.assertLessEqual(len(fine), 7, "one for each doubling, and no tiles")
        self.assert_ends_well(viewer)

    def test_the_status_tells_the_blades_that_are_left_by_a_stroke(self):
        self.display.xdotool("mousemove", Display.WIDTH - 1, Display.HEIGHT - 1)
        viewer = self.start(self.field(), "--ground", "plane", "--panel", "paint", "--camera", "top",
                            "--wind-strength", "0", size=(900, 500), rests=True)
        viewer.wait_for_field()
        viewer.click("Paint/Start painting")
        viewer.wait(lambda: "Paint/Kind" in viewer.controls(), "painting begins")
        number = lambda text: int(re.search(r"([0-9 ]+)(?: blades drawn|$)", text.split(" of ")[-1]).group(1)
                                  .replace(" ", ""))
        total = lambda: number(viewer.shows("Paint/Blades"))
        before = total()
        viewer.click("Paint/Kind")
        viewer.wait(lambda: "Paint/Kind Remove grass" in viewer.controls(), "the list is open")
        viewer.wait_frames(2)
        viewer.click("Paint/Kind Remove grass")
        viewer.drag((600, 300), (760, 260))
        viewer.wait(lambda: 0 < total() < before, "blades are gone")
        viewer.wait(lambda: viewer.shows("Status/Refined"), "it rests")
        viewer.wait(lambda: number(viewer.shows("Status/Numbers")) == total(), "the status bar follows")
        viewer.wait(lambda: f"of {total()} blades" in viewer.window.title(), "the title does")
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
