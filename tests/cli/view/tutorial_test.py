"""docs/tutorial.md as its reader types it, with fewer blades and pixels."""

import csv
import importlib.util
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from soon import programs_that_start_soon

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs/tutorial.md"
SWARD = Path(os.environ["SWARD_PROGRAM"]).resolve()
SMALLER = {"--budget 4000000": "--budget 60000", "--size 960x540": "--size 160x90"}


def valley():
    """The script that writes the images, as a module."""
    spec = importlib.util.spec_from_file_location("make_valley", ROOT / "examples/tutorial/make_valley.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def png_size(path):
    head = path.read_bytes()[:24]
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


class Tutorial(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-tutorial-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "examples").symlink_to(ROOT / "examples")
        self.text = PAGE.read_text(encoding="utf-8")

    def run_blocks(self):
        """Runs the shell blocks in their order; returns what they print."""
        programs_that_start_soon(self.folder / "bin")
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"}
        said = ""
        blocks = re.findall(r"(?ms)^```sh\n(.*?)^```", self.text)
        self.assertGreater(len(blocks), 5)
        for block in blocks:
            for usual, smaller in SMALLER.items():
                block = block.replace(usual, smaller)
            with self.subTest(block=block):
                done = subprocess.run(["bash", "-ec", block], cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                said += done.stdout + done.stderr
        return said

    def blades(self, name):
        rows = self.folder / "blades.csv"
        subprocess.run([SWARD, "export", self.folder / name, "-o", rows, "--force"], check=True, capture_output=True)
        with open(rows, encoding="ascii", newline="") as file:
            return list(csv.DictReader(file))

    def test_its_commands_grow_grass_beside_the_road_and_draw_it(self):
        said = self.run_blocks()
        needed = re.search(r"22 million", self.text)
        estimated = [int(number) for number in re.findall(r"\b(\d{8})\b", said)]
        self.assertTrue(needed and any(22e6 < number < 23e6 for number in estimated), said)

        make = valley()
        for name in ("first.sward", "valley.sward"):
            blades = self.blades(name)
            self.assertGreater(len(blades), 30000)
            on_road = [b for b in blades if make.from_road(float(b["x"]), float(b["z"])) < 1.1]
            self.assertEqual(on_road, [], name)
        meadow, heath, verge = ([b for b in blades if b["species"] == number] for number in "012")
        self.assertGreater(min(float(b["y"]) for b in heath), 4.5)
        self.assertLess(max(make.from_road(float(b["x"]), float(b["z"])) for b in verge), 6.8)
        # Nine to three above the soft edge, away from the verge.
        high = [sum(float(b["y"]) > 8.5 for b in ones) for ones in (heath, meadow)]
        self.assertAlmostEqual(high[0] / sum(high), 0.75, delta=0.12)
        for name in ("first.png", "valley_road.png"):
            self.assertEqual(png_size(self.folder / name), (160, 90))

    def test_its_picture_and_its_links_are_there(self):
        for alternative, path in re.findall(r"!\[([^\]]*)\]\(([^)]+)\)", self.text):
            self.assertGreater(len(alternative.split()), 4)
            self.assertLess((PAGE.parent / path).stat().st_size, 300_000)
        for link in re.findall(r"\]\(([^)#]+)[^)]*\)", self.text):
            self.assertTrue((PAGE.parent / link).exists(), link)


if __name__ == "__main__":
    unittest.main()
