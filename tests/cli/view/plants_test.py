"""Compound plants: ribbons stay on their stalks in wind, and both ways of drawing show the same."""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from png import pixels_of

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}

PETALS = 12
# Petals at the tip, leaves along the stalk.
MEADOW = {"name": "flowers", "species": [
    {"name": "grass", "share": 0.5, "height_m": [0.1, 0.2], "width_m": [0.006, 0.008]},
    {"name": "flower", "share": 0.5, "height_m": [0.25, 0.4], "width_m": [0.003, 0.004], "stiffness": [0.4, 0.8],
     "organs": [
         {"name": "petal", "count": PETALS, "place": [1, 1], "pitch_deg": [80, 80], "length": [0.15, 0.15],
          "root_color": [0.8, 0.8, 0.8], "tip_color": [0.9, 0.9, 0.9]},
         {"name": "leaf", "count": 4, "place": [0, 0.6], "pitch_deg": [100, 50], "length": [0.5, 0.2]}]}]}


def place_of(row, name):
    return [float(row[name + axis]) for axis in "xyz"]


def on_curve(points, t):
    return [(1 - t) ** 2 * a + 2 * t * (1 - t) * b + t * t * c for a, b, c in zip(*points)]


class PlantsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-plants-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "m.json").write_text(json.dumps(MEADOW), encoding="utf-8")

    def run_program(self, *arguments):
        done = subprocess.run(arguments, cwd=self.folder, env=ENVIRONMENT, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def bake(self, count):
        self.run_program(SWARD, "bake", "plane", "--meadow", "m.json", "--count", str(count), "-o", "f.sward", "--force")

    def curves_after(self, frames):
        """The control points of every blade, in the order of the file."""
        self.run_program(VIEWER, "render", "f.sward", "-o", "p.png", "--force", "--size", "64x64", "--frames",
                         f"{frames}:{frames}", "--wind-strength", "4", "--dump-blades", "b.csv",
                         "--geometry", "tessellation", "--samples", "1")
        with open(self.folder / "b.csv", encoding="utf-8", newline="") as table:
            rows = list(csv.DictReader(table))
        return [[place_of(row, name) for name in ("", "v1", "v2")] for row in rows]

    def test_ribbons_are_attached_to_their_stalks_after_300_frames_of_wind(self):
        self.bake(300)
        info = json.loads(self.run_program(SWARD, "info", "--json", "f.sward"))
        ribbons = PETALS + 4
        self.assertGreater(info["ribbons"], 50 * ribbons)
        self.assertEqual(info["ribbons"] % ribbons, 0)
        self.assertEqual(info["blades"], 300)
        flowers = info["ribbons"] // ribbons
        before, after = (self.curves_after(frames) for frames in (0, 300))
        found = 0
        moved = 0
        for i in range(len(after) - ribbons):
            stalk = after[i]
            length = math.dist(stalk[0], stalk[1]) + math.dist(stalk[1], stalk[2])
            # Petals begin at the tip of their stalk, and nothing else does.
            if any(math.dist(stalk[2], after[i + k][0]) > 2e-5 * length for k in range(1, PETALS + 1)):
                continue
            found += 1
            moved += math.dist(stalk[2], before[i][2]) > 0.01 * length
            for k in range(4):
                leaf = after[i + 1 + PETALS + k]
                self.assertLess(math.dist(leaf[0], on_curve(stalk, 0.2 * k)), 2e-5 * length)
            for k in range(1, ribbons + 1):
                self.assertGreater(min(point[1] for point in after[i + k]), min(stalk[0][1], 0) - 1e-4)
        self.assertEqual(found, flowers)
        self.assertGreater(moved, flowers // 2, "the wind moves them")

    def test_both_ways_of_drawing_show_the_same(self):
        self.bake(3000)
        camera = {"eye": [1.2, 0.9, 1.5], "target": [0, 0.2, 0], "up": [0, 1, 0], "fov_y_deg": 40}
        (self.folder / "camera.json").write_text(json.dumps(camera), encoding="utf-8")
        # The graphics pipeline draws the ground before the blades that would shade it.
        (self.folder / "plain.json").write_text(json.dumps({"look": {"blade_shadows": False}}), encoding="utf-8")
        pictures = []
        for way in ("raster", "tessellation"):
            self.run_program(VIEWER, "render", "f.sward", "-o", f"{way}.png", "--size", "320x240", "--camera",
                             "camera.json", "--frames", "10:10", "--geometry", way, "--settings", "plain.json")
            pictures.append(pixels_of(self.folder / f"{way}.png"))
        error = ((pictures[0] - pictures[1]) ** 2).mean()
        self.assertGreater(10 * math.log10(255 ** 2 / max(error, 1e-9)), 37)


if __name__ == "__main__":
    unittest.main()
