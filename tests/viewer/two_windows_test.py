"""Two windows at once, each on an X server of its own: what one does leaves the work of the other alone."""

import json
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display  # noqa: E402
from viewer import Viewer  # noqa: E402
from window_case import FEW_PIXELS, VIEWER, WindowCase  # noqa: E402


class TwoWindowsCase(WindowCase):
    SIZE = (900, 700)

    @classmethod
    def setUpClass(cls):
        cls.second = Display()
        cls.addClassCleanup(cls.second.close)

    def other(self, *arguments):
        """A viewer on the second server."""
        viewer = Viewer(VIEWER, self.second, self.folder,
                        (*arguments, "--size", "{}x{}".format(*self.SIZE), "--resolution", FEW_PIXELS))
        self.addCleanup(viewer.close)
        viewer.wait_for_field()
        return viewer

    def begin(self, viewer):
        viewer.key("space")
        viewer.click("Paint/Start painting")
        viewer.wait(lambda: {"Paint/Kind", "Question/Text"} & set(viewer.controls()), "it begins or asks")

    def paint(self, viewer, y, count):
        viewer.drag((600, y), (760, y), steps=2)
        viewer.wait_for_value("Paint/Count", lambda shown: shown == str(count), f"{count} strokes")

    @staticmethod
    def strokes(file):
        return len(json.loads(file.read_text())["strokes"]) if file.exists() else 0


class TwoWindowsTest(TwoWindowsCase):
    def test_each_has_its_own_autosave(self):
        field = self.field("plane", 6000, 4, "--sky-rays", "0", name="meadow.sward")
        own, others = (self.folder / f"meadow.strokes.autosave{n}.json" for n in ("", "-2"))
        opens = (field, "--ground", "plane", "--panel", "paint", "--camera", "top")
        one, other = self.open(*opens), self.other(*opens)
        self.begin(one)
        for count, y in ((1, 300), (2, 340)):
            self.paint(one, y, count)
        one.wait(lambda: self.strokes(own) == 2, "it is saved by itself")
        self.begin(other)
        self.assertIn("Paint/Kind", other.controls(), "the work of the first is not offered")
        self.paint(other, 400, 1)
        other.wait(lambda: self.strokes(others) == 1, "it has a file of its own")
        other.key("ctrl+z")
        other.wait(lambda: not others.exists(), "nothing is left of it")
        self.assertEqual(self.strokes(own), 2)
        # What a killed one leaves is offered to the other.
        one.process.kill()
        one.process.wait()
        self.assertEqual(self.strokes(own), 2)
        other.click("Paint/Stop painting")
        other.wait(lambda: "Paint/Start painting" in other.controls(), "it has stopped")
        other.wait_frames(3)
        other.click("Paint/Start painting")
        other.wait(lambda: "2 strokes" in (other.shows("Question/Text") or ""), "it offers them")
        other.wait_frames(3)
        other.click("Question/Load them")
        other.wait_for_value("Paint/Count", lambda shown: shown == "2", "they are loaded")
        self.assertEqual(self.strokes(own), 2)
        self.assert_ends_well(other)
        self.assertFalse(own.exists(), "closed without saving")


class LongTwoWindowsTest(TwoWindowsCase):
    def test_bookmarks_of_both_are_kept(self):
        one, other = self.field("plane", name="a.sward"), self.field("plane", name="b.sward")
        first, second = self.open(one), self.other(other)
        told = self.folder / "state/sward/bookmarks.json"

        def numbers():
            try:
                return {Path(key).name: sorted(value) for key, value in json.loads(told.read_text()).items()}
            except (OSError, ValueError):
                return {}
        for viewer, key in ((first, 5), (second, 7), (first, 6)):
            viewer.key(f"ctrl+{key}")
            viewer.wait(lambda: any(str(key) in found for found in numbers().values()), f"{key} is set")
        self.assertEqual(numbers(), {"a.sward": ["5", "6"], "b.sward": ["7"]})
        # An entry that is no camera is named, and stays.
        places = json.loads(told.read_text())
        places[str(other)]["8"] = {"eye": [1e300, 0, 0], "target": [0, 0, 0]}
        told.write_text(json.dumps(places))
        second.key("7")
        second.wait(lambda: "b.sward: 8" in (second.shows("Message/Error") or ""), "it is named")
        second.key("ctrl+9")
        second.wait(lambda: "9" in numbers().get("b.sward", []), "9 is set")
        self.assertEqual(numbers(), {"a.sward": ["5", "6"], "b.sward": ["7", "8", "9"]})
        self.assertEqual(json.loads(told.read_text())[str(other)]["8"]["eye"][0], 1e300)


if __name__ == "__main__":
    unittest.main()
