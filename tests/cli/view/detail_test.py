"""What may be left out of a picture, and how little of it may be missing then."""
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from png import picture_of

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
SYSTEMS = sorted((Path(__file__).resolve().parents[3] / "assets" / "settings").glob("*.json"))

SIDE = 60.0  # [m] of the flat field
EYE_HEIGHT = 3.0
SIZE = (160, 96)
# The way that starts soonest, for what is counted and not seen.
COUNTED = ("--geometry", "tessellation", "--samples", "1")


class DetailCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-detail-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments):
        done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=120,
                              cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def file(self, name, content):
        (self.folder / name).write_text(json.dumps(content), encoding="utf-8")
        return name

    def bake(self, *arguments):
        # Blades alone, so that the numbers of blades are those of the bake.
        meadow = [] if "--meadow" in arguments else ["--meadow", "grass"]
        self.run_program(SWARD, "bake", *arguments, *meadow, "-o", "f.sward", "--force", "-q")

    def bake_flat(self, count):
        self.bake(self.file("plane.json", {"kind": "plane", "size": [SIDE, SIDE], "cells": [6, 6]}),
                  "--count", count)

    def rim_camera(self, shift=0.0):
        """Over one rim of the flat field, so that its far end lies 59 m away."""
        return self.file("c.json", {"eye": [shift, EYE_HEIGHT, SIDE / 2 - 1], "target": [shift, 0, SIDE / 4],
                                    "fov_y_deg": 40})

    def render(self, *arguments, size=SIZE):
        self.run_program(VIEWER, "render", "f.sward", "-o", "p.png", "--size", f"{size[0]}x{size[1]}", "--force", "-q",
                         "--stats", "s.json", *arguments)
        return picture_of(self.folder / "p.png")

    def count(self, *arguments):
        """Counts of a small picture."""
        self.render(*COUNTED, *arguments, size=(64, 40))
        return self.counts()

    def counts(self):
        stats = json.loads((self.folder / "s.json").read_text(encoding="utf-8"))
        self.assertEqual(stats["validation_messages"], 0)
        return stats["blades"]

    def require_no_change_by_orientation(self, *kinds):
        """Of any byte of a picture, for each number of samples and camera."""
        self.bake("hills", "--count", 12_000, "--blade-scale", 2)
        # By compute shaders: where blades are equally deep, the graphics pipeline draws now this one
        # and now that, whatever is culled.
        for samples, camera in kinds:
            with self.subTest(samples=samples, camera=camera):
                drawing = ("--geometry", "raster", "--samples", samples, "--camera", camera)
                without = self.render(*drawing, "--cull", "patch,frustum,distance,occlusion")
                kept = self.counts()["drawn"]
                self.assertTrue((self.render(*drawing) == without).all())
                self.assertGreater(self.counts()["culled"]["orientation"], 0)
                self.assertLess(self.counts()["drawn"], kept)

    def require_wind(self, file):
        early, late = (self.tips_after(frame, file) for frame in (30, 90))
        self.assertGreater(np.linalg.norm(late - early, axis=1).max(), 0.01, "the wind moves some blade")

    def tips_after(self, frame, settings):
        """Where the tips of all blades are, in the order of the field."""
        self.count("--camera", self.rim_camera(), "--settings", settings, "--frames", f"{frame}:{frame}",
                   "--dump-blades", "d.csv")
        return np.loadtxt(self.folder / "d.csv", delimiter=",", skiprows=1, usecols=(7, 8, 9))

class DetailTest(DetailCase):
    def test_orientation_culling_changes_no_byte_by_default(self):
        self.require_no_change_by_orientation(("4", "eye"))

    def test_cull_results_add_up_to_the_resident_blades(self):
        self.bake("hills", "--count", 1_000)
        tests = ("patch", "orientation", "frustum", "distance", "occlusion")
        few = self.file("few.json", {"culling": {"draw_distance": 25, "edge_on_cosine": 0.9}})
        for camera in ("fit", "eye", "top", "edge"):
            for cull in ("all", *(("none", *tests) if camera == "eye" else ())):
                with self.subTest(camera=camera, cull=cull):
                    blades = self.count("--camera", camera, "--cull", cull, "--settings", few, "--wind-strength", 0)
                    self.assertEqual(blades["drawn"] + blades["lod"] + sum(blades["culled"].values()),
                                     blades["resident"])
                    self.assertEqual(blades["resident"] + blades["streamed_out"], blades["total"])
                    for test in tests:
                        if cull not in ("all", test):
                            self.assertEqual(blades["culled"][test], 0, test)
                    # From the middle of the field much is behind the camera, edge-on or far away.
                    if cull in ("orientation", "frustum", "distance"):
                        self.assertGreater(blades["culled"][cull], 0)
                    if cull == "none":
                        self.assertEqual(blades["drawn"] + blades["lod"], blades["total"])

    def drawn(self, culling, *arguments):
        return self.count("--camera", self.rim_camera(), "--settings",
                          self.file("x.json", {"culling": culling, "detail": {"thin_and_widen": False}}), *arguments)["drawn"]

    def test_switches_of_a_file_count_and_those_of_the_command_line_win(self):
        self.bake_flat(3_000)
        off = {"patch": False, "orientation": False, "frustum": False, "distance": False, "occlusion": False}
        self.assertEqual(self.drawn(off), 3_000)
        for test in ("frustum", "distance"):
            with self.subTest(test=test):
                self.assertLess(self.drawn({**off, test: True, "draw_distance": 30}), 3_000)
        self.assertEqual(self.drawn({"draw_distance": 1}, "--cull", "none"), 3_000)
        self.assertLess(self.drawn(off, "--cull", "all"), 3_000)
        edge_on = [self.drawn({**off, "orientation": True, "edge_on_cosine": cosine}) for cosine in (0.5, 0.9, 1)]
        # Blades face every way: the share whose cosine is below c is 2 asin(c)/π.
        for count, share in zip(edge_on, (1 / 3, 2 / math.pi * math.asin(0.9), 1.0)):
            self.assertAlmostEqual(count / 3_000, share, delta=0.03)
        # Thinning is on again where the command line asks for it.
        self.assertLess(self.drawn(off, "--lod", "on"), 3_000)

    def test_buckets_leave_fewer_blades_the_farther_they_stand_in_steps(self):
        self.bake_flat(8_000)
        only = {"patch": False, "orientation": False, "frustum": False, "distance": True, "occlusion": False,
                "draw_distance": 1e6, "buckets": {"count": 4, "distance": 40}}
        self.count("--camera", self.rim_camera(), "--settings",
                   self.file("b.json", {"culling": only, "detail": {"thin_and_widen": False}}), "--dump-blades", "d.csv")
        kept, there = np.zeros(5), np.zeros(5)
        with open(self.folder / "d.csv", encoding="ascii") as file:
            names = file.readline().strip().split(",")
            column = {name: names.index(name) for name in ("x", "y", "z", "cull_result")}
            for line in file:
                row = line.strip().split(",")
                x, y, z = (float(row[column[axis]]) for axis in "xyz")
                step = int(math.dist((x, y, z), (0, EYE_HEIGHT, SIDE / 2 - 1)) / 10)
                there[min(step, 4)] += 1
                kept[min(step, 4)] += row[column["cull_result"]] == "drawn"
        # floor(4 (1 − distance/40)) of 4 are left: three beyond the eye, none in the last 10 m.
        for share, wanted in zip(kept / there, (0.75, 0.5, 0.25, 0.0, 0.0)):
            self.assertAlmostEqual(share, wanted, delta=0.05, msg=str(kept / there))

    def test_blades_move_as_often_as_their_distance_says(self):
        self.bake_flat(8_000)
        everything = {"patch": False, "frustum": False}
        def simulated(frame, **updateRate):
            # Blades that are thinned out stand still at any updateRate.
            return self.count("--camera", self.rim_camera(), "--lod", "off", "--frames", f"{frame}:{frame}", "--settings",
                              self.file("p.json", {"culling": everything, "detail": updateRate}))["simulated"]
        self.assertEqual(simulated(6, move_every_frame=1e6), 8_000)
        self.assertEqual(simulated(6, move_every_frame=0, move_every_third=0), 0)
        thirds = [simulated(frame, move_every_frame=0, move_every_third=1e6) for frame in (6, 7, 8)]
        self.assertEqual(sum(thirds), 8_000)
        for count in thirds:
            self.assertAlmostEqual(count / 8_000, 1 / 3, delta=0.06)
        near = simulated(6, move_every_frame=15, move_every_third=15)
        both = simulated(6, move_every_frame=15, move_every_third=40)
        self.assertTrue(0 < near < both < 8_000, (near, both))

    def test_segments_of_a_file_are_seen(self):
        self.bake("plane", "--count", 300, "--blade-scale", 6)
        # Of two blades at equal depth, the tessellator shows the first in the list.
        def picture(**detail):
            return self.render("--camera", "eye", "--geometry", "raster", "--settings", self.file("s1.json", {"detail": detail, "wind": []}))
        one, seven = picture(segments=1), picture(segments=7)
        self.assertFalse((one == seven).all())
        steps = [{"distance": 1e-3, "segments": 1}, {"distance": 1e6, "segments": 7}]
        self.assertTrue((picture(steps=steps) == seven).all())
        self.assertFalse((picture(segments=1, min_width=0) == one).all())

    def test_the_known_systems_are_drawn_and_keep_to_their_distances(self):
        self.bake_flat(2_000)
        self.assertGreaterEqual(len(SYSTEMS), 4)
        for file in SYSTEMS:
            with self.subTest(file=file.name):
                blades = self.count("--camera", self.rim_camera(), "--settings", file)
                self.assertGreater(blades["drawn"], 0)
                self.assertGreater(blades["culled"]["orientation"], 0)
                self.assertEqual(blades["culled"]["patch"] + blades["culled"]["occlusion"] + blades["lod"], 0)
                culling = json.loads(file.read_text(encoding="utf-8"))["culling"]
                self.assertEqual(blades["culled"]["distance"] > 0, culling["distance"])

    def test_the_settings_of_a_known_system_blow(self):
        self.bake_flat(300)
        self.require_wind(SYSTEMS[-1])


class LongDetail(DetailCase):
    """More of the same: each picture starts the program anew."""

    def test_orientation_culling_changes_no_byte_for_any_camera_and_samples(self):
        self.require_no_change_by_orientation(("1", "fit"), ("4", "fit"), ("1", "eye"))

    def test_the_settings_of_each_known_system_blow(self):
        self.bake_flat(300)
        for file in SYSTEMS:
            with self.subTest(file=file.name):
                self.require_wind(file)


if __name__ == "__main__":
    unittest.main()
