"""What the window writes and reads again: pictures, films, paths of the camera, settings and bookmarks."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import share_that_differs  # noqa: E402
from window_case import VIEWER, WindowCase  # noqa: E402


def grass(display, viewer):
    """The picture beside an open panel."""
    x, y, _, _ = viewer.window.geometry()
    return display.picture(x + 440, y + 20, 440, 500)


class CaptureTest(WindowCase):
    def test_wind_is_turned_and_settings_are_saved_and_loaded(self):
        field = self.field()
        viewer = self.open(field, "--panel", "wind")
        viewer.set("Total strength", "Wind", 0.9)
        stormy = float(viewer.shows("Wind/Total strength"))
        self.assertGreater(stormy, 20)
        viewer.press("Save settings", panel="Capture")
        saved = self.folder / "settings.json"
        viewer.wait(saved.exists, "the settings are written")
        strength = sum(wind["strength"] for wind in json.loads(saved.read_text())["wind"])
        self.assertAlmostEqual(strength, stormy, delta=0.01 * stormy)

        viewer.set("Total strength", "Wind", 0.1)
        self.assertLess(float(viewer.shows("Wind/Total strength")), 10)
        viewer.press("Load settings", panel="Capture")
        viewer.open_panel("Wind")
        viewer.wait_for_value("Wind/Total strength",
                              lambda shown: abs(float(shown) - stormy) < 0.01 * stormy,
                              "the wind is as it was saved")
        self.assert_ends_well(viewer)
        # The other program of the window takes the same file.
        subprocess.run([VIEWER, "render", field, "-o", self.folder / "storm.png", "--settings",
                        saved, "--size", "32x32", "-q"], check=True)

    def test_a_picture_is_taken_without_panels(self):
        viewer = self.open(self.field(), "--panel", "capture", environment={"PATH": ""})
        viewer.press("Video", panel="Capture")
        self.assertEqual(viewer.shows("Capture/Video"), "off", "there is no ffmpeg")
        viewer.key("p")
        picture = self.folder / "sward.png"
        viewer.wait(picture.exists, "the picture is written")
        width, height = (int.from_bytes(picture.read_bytes()[at:at + 4], "big") for at in (16, 20))
        self.assertEqual((width, height), self.SIZE, "with every pixel of the window")
        self.assert_ends_well(viewer)

    def test_a_path_is_recorded_and_render_takes_it(self):
        field = self.field()
        viewer = self.open(field, "--panel", "camera")
        viewer.key("r")
        viewer.wait_for_value("Camera/Record", lambda shown: shown == "on", "it records")
        viewer.drag((600, 200), (700, 220), steps=8)
        viewer.key("r")
        path = self.folder / "camera_path.json"
        viewer.wait(path.exists, "the path is written")
        stops = json.loads(path.read_text())
        self.assertGreater(len(stops), 3)
        self.assertNotEqual(stops[0]["eye"], stops[-1]["eye"])
        # Played, it ends where it was left.
        viewer.key("Home")
        viewer.press("Replay", panel="Camera")
        self.assert_ends_well(viewer)
        subprocess.run([VIEWER, "render", field, "-o", self.folder / "way_%d.png", "--frames",
                        "0:1", "--fixed-dt", str(stops[-1]["time"]), "--camera", path, "--size",
                        "32x32", "-q"], check=True)
        self.assertNotEqual((self.folder / "way_0.png").read_bytes(),
                            (self.folder / "way_1.png").read_bytes())

    def test_a_bookmark_is_there_in_the_next_run(self):
        calm = (self.field(), "--wind-strength", "0", "--panel", "meadow", "--resolution", "0.4")
        viewer = self.open(*calm)
        # The panel initially shows the settings of the field's bake.
        self.assertEqual((viewer.shows("Meadow/Amount"), viewer.shows("Meadow/Count")),
                         ("count", "1500"))
        home = grass(self.display, viewer)
        viewer.drag((600, 200), (720, 240))
        viewer.key("ctrl+7")
        viewer.wait_frames(6)
        set_there = grass(self.display, viewer)
        self.assertGreater(share_that_differs(home, set_there), 0.1)
        self.assert_ends_well(viewer)
        viewer = self.open(*calm)
        viewer.wait(lambda: share_that_differs(home, grass(self.display, viewer)) < 0.02, "it is at home")
        viewer.key("7")
        viewer.wait(lambda: share_that_differs(set_there, grass(self.display, viewer)) < 0.05,
                    "it shows the place that was set")
        self.assert_ends_well(viewer)


class LongFilmTest(WindowCase):
    def ffmpeg(self, script):
        """A program of that name in a folder of its own; the variable PATH with it in front."""
        programs = self.folder / "programs"
        programs.mkdir(exist_ok=True)
        (programs / "ffmpeg").write_text("#!/bin/sh\n" + script)
        (programs / "ffmpeg").chmod(0o755)
        return {"PATH": f"{programs}:{os.environ['PATH']}"}

    def take_video(self, viewer):
        viewer.press("Video", panel="Capture")
        viewer.set("Pictures", "Capture", 0.02)
        viewer.wait_for_value("Capture/Pictures", lambda shown: int(shown) < 5, "few pictures")
        self.pictures = int(viewer.shows("Capture/Pictures"))
        viewer.press("Take sequence", panel="Capture")

    def test_a_film_is_made_by_ffmpeg_and_one_that_cannot_be_written_is_told(self):
        # A replacement for ffmpeg: records its arguments and its input.
        path = self.ffmpeg('for last; do :; done; echo "$@" >asked.txt; cat >"$last"')
        viewer = self.open(self.field(), "--panel", "capture", "--resolution", "1", "--wind-strength", "0",
                           environment=path)
        self.take_video(viewer)
        film = self.folder / "sward.mp4"
        viewer.wait(film.exists, "the film is there")
        self.assertEqual(film.stat().st_size, self.pictures * self.SIZE[0] * self.SIZE[1] * 4)
        asked = (self.folder / "asked.txt").read_text()
        self.assertIn("-video_size {}x{} -framerate 30 ".format(*self.SIZE), asked)
        # It shows what the window shows beside the panel, with that part in the middle.
        viewer.away()
        raw = np.frombuffer(film.read_bytes(), np.uint8)[-4 * self.SIZE[0] * self.SIZE[1]:]
        filmed = raw.reshape(self.SIZE[1], self.SIZE[0], 4)[60:-40, :, 2::-1].astype(np.int16)
        begin = round(viewer.controls()["Panel/Width"]["x"])
        shown = viewer.window.picture()[60:-40, begin:]
        differs = lambda shift: np.abs(filmed[:, begin - shift:self.SIZE[0] - shift] - shown).mean()
        self.assertLess(differs(begin // 2), 2)
        self.assertGreater(differs(0), 10)
        self.assertEqual(list(self.folder.glob("*.part*")), [])

        self.ffmpeg('for last; do :; done; echo half >"$last"; echo "No space left on device" >&2; exit 1')
        film.unlink()
        viewer.press("Take sequence", panel="Capture")
        viewer.wait_for_value("Message/Error", lambda shown: "No space left" in shown, "it complains")
        self.assertEqual(list(self.folder.glob("*.part*")), [], "nothing half written is left")
        self.assertFalse(film.exists())
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
