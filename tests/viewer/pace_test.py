"""How the window does on a CPU: the sample terrain at 1280x720, with fewer pixels where that is what
it takes. Counted is the processor's time: how many frames a second that is depends on who else asks
for it."""

import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from display import Display  # noqa: E402
from viewer import Viewer  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]

# What scripts/demo shows.
OPTIONS = ["--material", "meadow*", "--material", "rock_cliff", "--material", "rock_arch", "--mask",
           "vertex-color:R", "--density", "420", "--slope", "0:50~15", "--clearance", "0.4",
           "--seed", "1"]
# Two processors that have nothing else to do hold six frames a second then. What else a machine does costs a frame up
# to two thirds more of a processor, so that only long tests, which run alone, ask for that; the others see a frame that
# has become twice as dear.
ALONE = bool(os.environ.get("SWARD_LONG_TESTS"))
MAX_SECONDS = 2 / 6 if ALONE else 4 / 6  # of a processor, for a frame


def processor_seconds(pid):
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class UpdateRateTest(unittest.TestCase):
    def test_two_processors_hold_six_frames_a_second_on_the_sample_terrain(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-pace-")
        self.addCleanup(folder.cleanup)
        place = Path(folder.name)
        field = place / "landscape.sward"
        subprocess.run([SWARD, "bake", ROOT / "assets/meshes/landscape.glb", "-o", field, *OPTIONS,
                        "-q"], check=True)
        display = Display()
        self.addCleanup(display.close)
        # The validation layer would be counted too.
        viewer = Viewer(VIEWER, display, place,
                        [field, "--camera", ROOT / "assets/scenes/landscape.camera.json", "--size",
                         "1280x720"], validated=False)
        self.addCleanup(viewer.close)
        viewer.wait_for_field()
        viewer.wait_for_value("Status/Resolution", lambda shown: int(shown) <= 52, "it draws less")
        time.sleep(3)

        begin, used = time.monotonic(), processor_seconds(viewer.process.pid)
        rates = []
        while time.monotonic() < begin + 6:
            time.sleep(0.6)
            told = re.search(r"drawn, ([\d.]+) ms", viewer.window.title())
            rates.append(1000 / float(told.group(1)))
        seconds = time.monotonic() - begin
        used = processor_seconds(viewer.process.pid) - used
        rate = sum(rates) / len(rates)
        a_frame = used / seconds / rate
        print(f"{rate:.1f} frames/s with {used / seconds:.2f} processors, {1000 * a_frame:.0f} ms "
              f"of a processor for each, at {viewer.shows('Status/Resolution')} %")
        self.assertLess(a_frame, MAX_SECONDS)
        if ALONE:
            self.assertGreaterEqual(rate, 6)


if __name__ == "__main__":
    unittest.main()
