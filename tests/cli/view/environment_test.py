"""Gravity, wind and colliders of `sward-view render`, by what they do to the blades and pictures."""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
# The way that starts soonest, for what is computed and not seen.
SMALL = ("--size", "64x36", "--geometry", "tessellation", "--samples", "1")
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}


def vector(row, prefix):
    return [float(row[prefix + axis]) for axis in "xyz"]


class EnvironmentTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-environment-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def bake(self, ground, *arguments):
        # Blades alone: a ribbon's tip follows its stalk.
        subprocess.run([SWARD, "bake", ground, "--meadow", "grass", *map(str, arguments), "-o", "f.sward", "-q"],
                       check=True, cwd=self.folder)

    def render(self, *arguments, code=0):
        shape = () if "--geometry" in arguments else SMALL
        done = subprocess.run([VIEWER, "render", "f.sward", "--force", *shape, *map(str, arguments)], cwd=self.folder,
                              text=True, env=ENVIRONMENT, capture_output=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def dump(self, *arguments):
        self.render("-o", "d.png", "--dump-blades", "d.csv", *arguments)
        with open(self.folder / "d.csv", encoding="ascii", newline="") as file:
            return {row["id"]: row for row in csv.DictReader(file)}

    def settings(self, name, content):
        (self.folder / name).write_text(json.dumps(content), encoding="utf-8")
        return name

    def test_gravity_pushes_no_tip_of_a_torus_below_its_ground(self):
        self.bake("torus", "--count", 3000)
        strong = self.settings("g.json", {"wind": [], "recovery": 1,
                                          "gravity": {"direction": [0, -1, 0], "strength": 60}})
        bent = 0
        for row in self.dump("--settings", strong, "--frames", "60:60", "--cull", "none", "--validation").values():
            root, v1, v2, up = (vector(row, prefix) for prefix in ("", "v1", "v2", "u"))
            length = (2 * math.dist(v2, root) + math.dist(v1, root) + math.dist(v2, v1)) / 3
            above = sum((a - b) * u for a, b, u in zip(v2, root, up))
            self.assertGreaterEqual(above, -1e-4 * length, f"blade {row['id']}")
            bent += above < 0.5 * length
        self.assertGreater(bent, 500)

    def test_blades_move_after_eleven_days_as_after_a_minute(self):
        self.bake("plane", "--count", 1000, "--blade-scale", 1)
        moved = []
        for time in (100, 999998):
            tips = [[vector(row, "v2") for row in self.dump("--fixed-dt", time + step, "--frames", "1:1", "--cull", "none").values()]
                    for step in (0, 0.03)]
            moved.append(sum(map(math.dist, *tips)) / len(tips[0]))
        self.assertGreater(moved[0], 1e-4)
        self.assertLess(0.3 * moved[0], moved[1])
        self.assertLess(moved[1], 3 * moved[0])

    def test_a_planet_pulls_its_blades_to_its_centre(self):
        self.bake("sphere", "--count", 1000, "--ground-up", "radial", "--set", "wide_variation=0")
        # Nothing leans to any side but forward: every tip is as high as on the other side.
        calm = self.settings("c.json", {"wind": [], "gravity": {"forward": 0}})
        for row in self.dump("--settings", calm, "--frames", "30:30", "--cull", "none", "--validation").values():
            root, v2, up = (vector(row, prefix) for prefix in ("", "v2", "u"))
            above = sum((a - b) * u for a, b, u in zip(v2, root, up))
            self.assertGreater(above, 0.98 * math.dist(v2, root), f"blade {row['id']}")

    def test_a_rolling_ball_presses_blades_down_and_they_rise_again(self):
        self.bake("plane", "--count", 3000)
        ball = self.settings("b.json", {"wind": [], "colliders": [
            {"centre": [-20, 0.1, 0], "radius": 0.3,
             "path": [{"time": 0, "move": [0, 0, 0]}, {"time": 4, "move": [40, 0, 0]}]}]})
        calm = self.settings("c.json", {"wind": []})
        step = ("--fixed-dt", "1/30", "--cull", "none")
        rest = self.dump("--settings", calm, *step)
        rolled = self.dump("--settings", ball, *step, "--frames", "120:120", "--validation")
        later = self.dump("--settings", ball, *step, "--frames", "600:600")
        hit = [name for name, row in rolled.items() if float(row["eta"]) > 0.05]
        self.assertGreater(len(hit), 10)
        self.assertLess(len(hit), 2000)
        moved = [math.dist(vector(rolled[name], "v2"), vector(rest[name], "v2")) for name in hit]
        self.assertGreater(max(moved), 0.05)
        self.assertEqual({row["eta"] for row in later.values()}, {"0"})
        back = [math.dist(vector(later[name], "v2"), vector(rest[name], "v2")) for name in hit]
        # Soft ones may have been sent to their other side.
        self.assertLess(sorted(back)[int(0.9 * len(back))], 0.01)

    def test_between_two_colliders_at_rest_no_picture_differs_from_the_next(self):
        self.bake("plane", "--count", 1500)
        near = self.settings("cam.json", {"eye": [0, 1.5, 3], "target": [0, 0, 0]})
        # Of two blades at one depth the tessellator shows the one listed first, and that changes.
        still = ("--geometry", "raster", "--size", "96x54", "--wind-strength", 0, "--camera", near)
        self.render("-o", "f_%d.png", *still, "--fixed-dt", "1/30", "--frames", "300:304",
                    "--collider", "sphere:0,0.2,0,0.6", "--collider", "capsule:0.3,0.2,-1,0.8,0.2,1,0.4")
        first = (self.folder / "f_300.png").read_bytes()
        for frame in range(301, 305):
            self.assertEqual((self.folder / f"f_{frame}.png").read_bytes(), first, frame)
        self.render("-o", "free.png", *still, "--validation")
        self.assertNotEqual((self.folder / "free.png").read_bytes(), first)

    def test_the_wind_is_painted(self):
        self.bake("plane", "--count", 500)
        self.render("-o", "plain.png")
        self.render("-o", "wind_%d.png", "--debug", "wind", "--frames", "0:20", "--validation")
        pictures = {(self.folder / name).read_bytes() for name in ("plain.png", "wind_0.png", "wind_20.png")}
        self.assertEqual(len(pictures), 3)

    def test_256_colliders_are_taken_and_257_are_not(self):
        self.bake("plane", "--count", 500)
        balls = [{"centre": [0.1 * i, 0.2, 0.05 * i], "radius": 0.2} for i in range(257)]
        self.render("-o", "a.png", "--settings", self.settings("a.json", {"colliders": balls[:256]}),
                    "--validation")
        for arguments, code in (
                (["--settings", self.settings("b.json", {"colliders": balls})], 3),
                (["--settings", "a.json", "--collider", "sphere:0,0,0,1"], 1)):
            done = self.render("-o", "b.png", *arguments, code=code)
            self.assertIn("257", done.stderr)

    def test_wrong_settings_and_colliders_are_refused_with_the_key(self):
        self.bake("plane", "--count", 100)
        for content, says in (({"wnd": []}, '"wind"'),
                              ({"wind": [{"kind": "nose"}]}, '"noise"'),
                              ({"wind": [{"kind": "radial", "direction": [1, 0, 0]}]}, "direction"),
                              ({"wind": [{"size": 0}]}, "size"),
                              ({"wind": [{}] * 9}, "8"),
                              ({"gravity": {"direction": [0, 0, 0]}}, "direction"),
                              ({"colliders": [{"from": [0, 0, 0], "radius": 1}]}, "to"),
                              ({"colliders": [{"centre": [0, 0, 0], "radius": 1, "path": [
                                  {"time": 1}, {"time": 1}]}]}, "time")):
            with self.subTest(content=content):
                done = self.render("-o", "a.png", "--settings", self.settings("s.json", content),
                                   code=3)
                self.assertIn("s.json", done.stderr)
                self.assertIn(says, done.stderr)
        for text in ("ball:0,0,0,1", "sphere:0,0,0", "sphere:0,0,0,0", "capsule:0,0,0,1", "sphere"):
            with self.subTest(text=text):
                done = self.render("-o", "a.png", "--collider", text, code=1)
                self.assertIn("--collider", done.stderr)


if __name__ == "__main__":
    unittest.main()
