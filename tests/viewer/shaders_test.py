"""A shader that changes while the window is open: the picture follows, and outlives one that does not
compile."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display  # noqa: E402
from viewer import Viewer  # noqa: E402

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ROOT = Path(__file__).resolve().parents[2]
SKY = (660, 460, 120, 90)  # left, top, width, height of a part of the picture that shows the sky
SUM = "vec3 color = withClouds(skyRadiance(ray), ray);"


class ShadersTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-view-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.shaders = self.folder / "shaders"
        shutil.copytree(ROOT / "shaders", self.shaders)
        field = self.folder / "hills.sward"
        subprocess.run([SWARD, "bake", "hills", "--count", "500", "--blade-scale", "8", "-o", field,
                        "-q"], check=True)
        self.display = Display()
        self.addCleanup(self.display.close)
        self.viewer = Viewer(VIEWER, self.display, self.folder,
                             [field, "--shaders", self.shaders, "--size", "800x600", "--panel",
                              "profile", "--resolution", "0.4"])
        self.addCleanup(self.viewer.close)
        self.viewer.wait_for_field()

    def sky(self):
        """Mean red, green and blue of the sky."""
        x, y, _, _ = self.viewer.window.geometry()
        left, top, width, height = SKY
        pixels = [pixel for row in self.display.picture(x + left, y + top, width, height)
                  for pixel in row]
        blue, green, red = (sum(channel) / len(pixels) for channel in zip(*pixels))
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
        sky = "preview/sky_light.glsl"
        self.rewrite(sky, SUM, SUM + "\n    color *= vec3(1.0, 0.1, 0.1);")
        viewer.wait(lambda: self.sky()[0] > self.sky()[2] + 60, "the sky is red")

        # Garbage: told with file and line, and the picture stays.
        self.rewrite(sky, SUM, SUM + "\n    this is none")
        viewer.wait_for_value("Message/Shaders", lambda told: "sky_light.glsl:" in told, "it is told")
        line = (self.shaders / sky).read_text().splitlines().index("    this is none")
        # The next line is where it ends to make sense.
        self.assertRegex(viewer.shows("Message/Shaders"), f"sky_light.glsl:({line + 1}|{line + 2}):")
        viewer.wait_frames(4)
        self.assertGreater(self.sky()[0], self.sky()[2] + 60, "the last good picture stays")

        # Something right elsewhere does not hide the mistake.
        self.rewrite("preview/film.frag", "#version 460", "#version 460\n")
        viewer.wait_frames(20)
        self.assertIn("sky_light.glsl:", viewer.shows("Message/Shaders"))

        # After the repair it works again.
        self.rewrite(sky, "    this is none\n", "")
        self.rewrite(sky, "vec3(1.0, 0.1, 0.1)", "vec3(0.1, 1.0, 0.1)")
        viewer.wait(lambda: self.sky()[1] > self.sky()[0] + 60, "the sky is green")
        viewer.wait(lambda: "Message/Shaders" not in viewer.controls(), "nothing is wrong any more")
        code, said = viewer.end()
        self.assertEqual(code, 0, said)
        self.assertIn("0 validation messages", said)


if __name__ == "__main__":
    unittest.main()
