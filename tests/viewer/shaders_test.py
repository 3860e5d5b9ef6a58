"""A shader that changes while the window is open: the picture follows, and outlives one that does not
compile."""

import shutil
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window_case import ROOT, WindowCase  # noqa: E402

SKY = (660, 460, 120, 90)  # left, top, width, height of a part of the picture that shows the sky
SUM = "vec3 color = withClouds(skyRadiance(ray), ray);"
RED = "\n    color *= vec3(1.0, 0.1, 0.1);"
MISTAKE = "\n    this is none"


class LongShadersTest(WindowCase):
    SIZE = (800, 600)

    def setUp(self):
        super().setUp()
        self.shaders = self.folder / "shaders"
        shutil.copytree(ROOT / "shaders", self.shaders)
        self.viewer = self.open(self.field("hills", 500), "--shaders", self.shaders, "--panel", "profile")

    def sky(self):
        """Mean red, green and blue of the sky."""
        x, y, _, _ = self.viewer.window.geometry()
        left, top, width, height = SKY
        blue, green, red = self.display.picture(x + left, y + top, width, height).mean(axis=(0, 1))
        return red, green, blue

    def rewrite(self, path, before, after):
        # Replace the file, as editors do.
        text = (self.shaders / path).read_text()
        self.assertIn(before, text)
        new = self.folder / "new"
        new.write_text(text.replace(before, after, 1))
        new.rename(self.shaders / path)

    def test_the_picture_follows_and_a_mistake_keeps_the_last_good_one(self):
        viewer = self.viewer
        red, green, blue = self.sky()
        self.assertGreater(blue, red)

        # Change a colour in an included file.
        sky = "common/sky_light.glsl"
        self.rewrite(sky, SUM, SUM + RED)
        viewer.wait(lambda: self.sky()[0] > self.sky()[2] + 60, "the sky is red")

        # Garbage: told with file and line, and the picture stays.
        self.rewrite(sky, RED, MISTAKE + RED)
        viewer.wait_for_value("Message/Shaders", lambda told: "sky_light.glsl:" in told, "it is told")
        line = (self.shaders / sky).read_text().splitlines().index(MISTAKE[1:])
        # The next line is where it ends to make sense.
        self.assertRegex(viewer.shows("Message/Shaders"), f"sky_light.glsl:({line + 1}|{line + 2}):")
        viewer.wait_frames(4)
        self.assertGreater(self.sky()[0], self.sky()[2] + 60, "the last good picture stays")

        # Something right elsewhere does not hide the mistake.
        self.rewrite("preview/film.frag", "#version 460", "#version 460\n")
        viewer.wait_frames(20)
        self.assertIn("sky_light.glsl:", viewer.shows("Message/Shaders"))

        # After the repair it works again.
        self.rewrite(sky, MISTAKE + RED, "")
        viewer.wait(lambda: self.sky()[2] > self.sky()[0], "the sky is blue again")
        viewer.wait(lambda: "Message/Shaders" not in viewer.controls(), "nothing is wrong any more")
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
