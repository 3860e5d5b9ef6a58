"""Scenes are measured by `sward-view bench` and by scripts/bench, and what was measured becomes tables and plots."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

import numpy as np

from png import picture_of
from soon import SOON, programs_that_repeat_themselves

ROOT = Path(__file__).resolve().parents[3]
sys.path.append(str(ROOT / "scripts"))
from png_light import LINEAR, mean_light  # noqa: E402

VIEWER = Path(os.environ["SWARD_VIEW_PROGRAM"])
SVG = "{http://www.w3.org/2000/svg}"
SIZE = (64, 36)
BLADES = 600

SCENE = {"about": "A small meadow.", "ground": {"kind": "plane", "size": [20, 20]},
         "meadow": {"species": [{"name": "blade", "height_m": [0.6, 1.2], "width_m": [0.08, 0.08]}]},
         "bake": ["--count", str(BLADES), "--sky-rays", "0", "--blade-scale", "1"],
         "camera": {"eye": [0, 3, 10], "target": [0, 0, 0]}, "draw": ["--draw-distance", "41", "--samples", "1"],
         "moving": [{"time": 0, "eye": [0, 3, 10], "target": [0, 0, 0]}, {"time": 1, "eye": [8, 3, 6], "target": [0, 0, 0]}]}


class BenchTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-bench-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def scene(self, name="tiny", **changes):
        kept = {key: value for key, value in {**SCENE, **changes}.items() if value is not None}
        (self.folder / f"{name}.json").write_text(json.dumps(kept), encoding="utf-8")
        return f"{name}.json"

    def bench(self, *arguments, code=0):
        done = subprocess.run([VIEWER, "bench", *map(str, arguments)], capture_output=True, text=True, timeout=600, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def stats(self, *arguments):
        return json.loads(self.bench(*arguments, "--size", "64x36", "--frames", 3, "--warmup", 0, "--json", "-q", *SOON).stdout)

    def require_bands(self, *bands_of_heights, drawing):
        """Seen from each height, nearly all grass is in its band."""
        self.stats(self.scene(), "--fields", ".")
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

        def bands(height):
            """Share of each band where the eye looks down from so high, always at the same ground."""
            Path("c.json").write_text(json.dumps({"eye": [0, height, 0], "target": [0, 0, 0], "up": [0, 0, -1],
                                                  "fov_y_deg": 2 * math.degrees(math.atan(1.6 / height))}), encoding="utf-8")
            total, shares = 0.0, []
            for mode in ("near", "middle", "far"):
                subprocess.run([VIEWER, "render", "tiny.sward", "--size", "64x36", "--camera", "c.json", "--draw-distance", "100",
                                "--samples", "4", "--debug", mode, "-o", "p.png", "--force", "-q", "--validation", *drawing], check=True)
                light = np.array(LINEAR)[picture_of(Path("p.png"))]
                np.testing.assert_allclose(mean_light(Path("p.png")), light.mean(axis=(0, 1)), atol=1e-9)
                total, shares = total + light.sum(axis=-1), shares + list(light.mean(axis=(0, 1)))
            self.assertLessEqual(total.max(), 1.01)
            self.assertEqual(shares[8], 0)
            return np.array(shares[:8]), total.mean()

        # Limits 1 · 100^(k/8): 1.8, 3.2, 5.6, 10, 18, 32, 56, 100 m.
        for height, band in bands_of_heights:
            with self.subTest(height=height, drawing=drawing):
                shares, total = bands(height)
                self.assertGreater(total, 0.01, "some grass is seen")
                self.assertGreater(shares[band], 0.9 * total)


class Scenes(BenchTest):
    """The program."""

    def test_a_scene_is_baked_where_it_has_no_field_and_found_where_it_has(self):
        scene = self.scene()
        stats = self.stats(scene)
        self.assertEqual((stats["blades"]["resident"], stats["samples"]), (BLADES, 1))
        self.assertEqual({path.name for path in self.folder.iterdir()}, {scene})
        self.stats(scene, "--fields", "kept")
        field = self.folder / "kept" / "tiny.sward"
        written = field.stat().st_mtime_ns
        self.stats(scene, "--fields", "kept")
        self.assertEqual(field.stat().st_mtime_ns, written)
        shutil.copy(field, self.folder / "tiny.sward")
        self.scene(ground="none such")
        self.assertEqual(self.stats(scene)["blades"]["resident"], BLADES)

    def test_a_scene_may_look_otherwise_at_the_field_of_another(self):
        self.scene()
        self.scene("far", of="tiny", ground=None, meadow=None, bake=None, moving=None,
                   camera={"eye": [0, 3, 4000], "target": [0, 3, 8000]})
        near, far = self.stats("tiny.json", "--fields", "."), self.stats("far.json", "--fields", ".")
        self.assertFalse((self.folder / "far.sward").exists())
        self.assertGreater(near["blades"]["drawn"], 0)
        self.assertEqual((far["blades"]["resident"], far["blades"]["drawn"]), (BLADES, 0))
        # Missing keys come from the other scene.
        self.assertGreater(self.stats("far.json", "--fields", ".", "--moving")["blades"]["drawn"], 0)

    def test_the_command_line_wins_over_a_scene(self):
        scene = self.scene(settings={"culling": {"distance": True}, "detail": {"thin_and_widen": False}})
        drawn = self.stats(scene, "--fields", ".")["blades"]["drawn"]
        self.assertGreater(drawn, 0)
        self.assertEqual(self.stats(scene, "--fields", ".", "--samples", 4)["samples"], 4)
        self.assertEqual(self.stats(scene, "--fields", ".", "--draw-distance", 0.1)["blades"]["drawn"], 0)
        (self.folder / "away.json").write_text('{"eye": [0, 3, 400], "target": [0, 3, 800]}', encoding="utf-8")
        self.assertEqual(self.stats(scene, "--fields", ".", "--camera", "away.json")["blades"]["drawn"], 0)
        # Both scenes may be looked at from where they stand, and from where they go.
        self.assertNotEqual(self.stats(scene, "--fields", ".", "--moving", "--fixed-dt", "1/3")["blades"]["drawn"], drawn)

    def test_it_warms_up_for_half_a_second_and_moves_nothing_by_that(self):
        scene, shown = self.scene(), ("--size", "64x36", "--frames", 2, "--moving", "--fixed-dt", "1/3", "--fields", ".", "--json", "-q",
                                      *SOON)
        stats = {frames: json.loads(self.bench(scene, *shown, "--warmup", frames).stdout) for frames in (0, 2)}
        self.assertEqual(stats[0]["warmup"]["frames"], 0)
        self.assertGreater(stats[2]["warmup"]["frames"], 2)
        self.assertGreaterEqual(stats[2]["warmup"]["seconds"], 0.5)
        # The last frame is 3 with the warm-up, however often the first was repeated.
        last = json.loads(self.bench(scene, *shown[:3], 4, *shown[4:], "--warmup", 0).stdout)
        self.assertEqual(stats[2]["blades"]["drawn"], last["blades"]["drawn"])

    def test_a_wrong_scene_is_refused_by_file_key_value_and_bound(self):
        for changes, code, says in (
                ({"grund": "plane", "ground": None}, 3, ["tiny.json", "ground", "missing"]),
                ({"camra": "eye"}, 3, ["tiny.json", "camra", "camera"]),
                ({"draw": ["--samples", "3"]}, 3, ["tiny.json: draw", "3", "1 or 4"]),
                ({"draw": ["--no-such"]}, 3, ["tiny.json: draw", "--no-such"]),
                ({"draw": "--samples 1"}, 3, ["tiny.json: draw", "array"]),
                ({"camera": {"eye": [0, 3, 10], "target": [0, 0, 0], "fov_y_deg": 200}}, 3, ["tiny.json: camera: fov_y_deg", "200", "170"]),
                ({"moving": [{"time": 1, "eye": [0, 3, 1], "target": [0, 0, 0]}] * 2}, 3, ["tiny.json: moving[1]: time", "1"]),
                ({"moving": None}, 3, ["tiny.json", "moving", "missing"]),
                ({"settings": {"look": {"clouds": 7}}}, 3, ["tiny.json: settings", "clouds", "7"]),
                ({"ground": "meshes/none.glb"}, 2, ["tiny.json: ground", "meshes/none.glb"]),
                ({"ground": {"kind": "plane", "size": [-1, 20]}}, 3, ["tiny.json", "size", "-1"]),
                ({"bake": ["--count", "many"]}, 1, ["tiny.json", "many"]),
                ({"of": "other"}, 2, ["other.json"])):
            with self.subTest(changes=changes):
                shutil.rmtree(self.folder / "new", ignore_errors=True)
                done = self.bench(self.scene(**changes), "--moving", "--fields", "new", code=code) if "moving" in changes else \
                    self.bench(self.scene(**changes), "--fields", "new", "--size", "16x9", "--frames", 1, "--warmup", 0, code=code)
                for word in says:
                    self.assertIn(word, done.stderr)
        self.assertIn("--moving", self.bench("x.sward", "--moving", code=1).stderr)
        self.assertIn("FILE", self.bench(code=1).stderr)

    def test_copies_have_a_bandwidth(self):
        copies = json.loads(self.bench("--copy-bandwidth", "--frames", 5, "--json", "-q").stdout)
        times = copies["copy_ms"]
        self.assertEqual(times, min(copies["command_ms"], copies["shader_ms"], key=lambda way: way["median"]))
        self.assertEqual(times, copies[copies["by"] + "_ms"])
        self.assertTrue(0 < times["min"] <= times["median"] <= times["p99"], times)
        self.assertAlmostEqual(copies["gb_per_s"], 2 * copies["bytes"] / times["median"] / 1e6, delta=1e-6 * copies["gb_per_s"])

    def test_every_place_of_a_picture_counts_for_one_band_of_distance(self):
        self.require_bands((25, 5), drawing=SOON)


class ReportTest(BenchTest):
    """The script."""

    programs = VIEWER.parent

    def run_script(self, *arguments):
        done = subprocess.run([sys.executable, ROOT / "scripts" / "bench", *map(str, arguments)], capture_output=True, text=True, timeout=1700)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines()[-1], str(self.folder / arguments[arguments.index("--out") + 1] / "README.md"))

    def measured(self, group, *scenes, blades=BLADES, size=SIZE):
        """Runs of a group on scenes that are thin, each with where it is from; its tables and plots."""
        out = self.folder / "out"
        self.run_script("--groups", group, "--programs", self.programs, "--fields", self.folder, "--size", "%dx%d" % size, "--frames", 2,
                        "--warmup", 0, "--count", blades, "--out", out, *scenes)
        result = json.loads((out / "measured.json").read_text(encoding="utf-8"))
        self.assertGreater(len(result["runs"]), 0)
        for run in result["runs"]:
            for key in ("device", "driver", "commit", "command"):
                self.assertTrue(run[key], f"{run['scene']}, {run['way']} has {key}")
            self.assertIn("sward-view ", run["command"])
            self.assertEqual(tuple(run["stats"]["size"]), size)
            for name, times in run["stats"]["gpu_ms"].items():
                self.assertTrue(0 <= times["min"] <= times["median"] <= times["p99"], f"{name}: {times}")
        # The kept field suffices to draw it again.
        self.run_script("--redraw", out / "measured.json", "--out", self.folder / "again")
        names = {path.name for path in out.iterdir()}
        self.assertEqual(names - {"measured.json"}, {path.name for path in (self.folder / "again").iterdir()})
        for name in names - {"measured.json"}:
            self.assertEqual((out / name).read_bytes(), (self.folder / "again" / name).read_bytes(), name)
        text = (out / "README.md").read_text(encoding="utf-8")
        self.assertIn(result["runs"][0]["device"], text)
        self.assertIn(result["commit"], text)
        return result["runs"], text, out

    def marks(self, plot, kind, **attributes):
        tree = xml.etree.ElementTree.parse(plot)
        self.assertIn("commit", tree.find(SVG + "desc").text)
        self.assertIn("sward-view bench", tree.find(SVG + "desc").text)
        return [mark for mark in tree.iter(SVG + kind) if all(mark.get(key) == value for key, value in attributes.items())]

    def require_growth(self):
        """Each field of the group has its mark and its row."""
        runs, text, out = self.measured("growth")
        self.assertEqual([run["x"] for run in runs], [1, 4, 16, 1, 4, 16])
        self.assertEqual(len(self.marks(out / "growth.svg", "circle")), len(runs))
        self.assertIn("| outside, 1× |", text)
        # A camera that looks outwards sees the same ground for any field size: three fields, not six.
        self.assertEqual({path.name for path in self.folder.glob("*.sward")}, {"1M.sward", "growth-outside-4.sward", "16M.sward"})


class Reports(ReportTest):
    """What the script makes of what it is told; LongBench has the program tell it."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-bench-")
        cls.addClassCleanup(folder.cleanup)
        cls.programs = programs_that_repeat_themselves(Path(folder.name) / "programs")

    def test_every_group_becomes_tables_and_plots(self):
        groups = ("table", "visible", "levels", "culling", "coverage")
        runs, text, out = self.measured(",".join(groups), "other")
        self.assertEqual({run["group"] for run in runs}, set(groups))
        self.assertEqual({run["moving"] for run in runs if run["group"] == "table"}, {False, True})
        for run in runs:
            if run["group"] in ("table", "culling"):
                self.assertIn(f"| {run['way']} |", text)
        for group in ("visible", "levels"):
            self.assertEqual(len(self.marks(out / f"{group}.svg", "circle")), sum(run["group"] == group for run in runs))
        for plot in ("other", "culling-other"):
            self.assertGreater(len(self.marks(out / f"{plot}.svg", "rect", **{"class": "bar"})), 0)

    def test_a_scene_whose_camera_has_no_way_to_go_is_measured_standing(self):
        self.scene(moving=None)
        runs, text, _ = self.measured("table", "tiny", "--scenes", self.folder)
        self.assertEqual({run["moving"] for run in runs}, {False})
        self.assertNotIn("tiny, moving", text)

    def test_time_against_resident_blades_has_a_mark_for_each_field(self):
        self.require_growth()


class LongBench(ReportTest):
    """Groups of the script with ten to thirty runs of the program each, and each band as any way draws it."""

    def test_each_way_is_measured_standing_and_moving_with_the_bounds_beside_it(self):
        runs, text, out = self.measured("table", "other")
        self.assertEqual(len(runs), len({(run["way"], run["moving"]) for run in runs}))
        self.assertEqual({run["moving"] for run in runs}, {False, True})
        for run in runs:
            self.assertEqual("--moving" in run["command"], run["moving"])
            self.assertEqual(run["stats"]["blades"]["resident"], BLADES)
            self.assertIn(f"| {run['way']} | {BLADES} | {run['stats']['blades']['simulated']} |", text)
        whole, = (run["stats"]["blades"] for run in runs if "all moved" in run["way"] and not run["moving"])
        self.assertEqual((whole["drawn"], whole["simulated"]), (BLADES, BLADES))
        self.assertIn(f"| other | {BLADES} |", text.split("against the bandwidth")[1])
        fast = [run for run in runs if not run["moving"] and not run["way"].startswith("tessellation")]
        bars = self.marks(out / "other.svg", "rect", **{"class": "bar"})
        self.assertEqual(len(bars) % len(fast), 0)
        # As long as the passes take.
        parts = len(bars) // len(fast)
        lengths = [sum(float(bar.get("width")) for bar in bars[parts * i:parts * (i + 1)]) for i in range(len(fast))]
        times = [sum(run["stats"]["gpu_ms"][name]["median"] for name in ("cull", "update", "pyramid", "blades", "shadow", "resolve", "ground"))
                 for run in fast]
        for length, time in zip(lengths, times):
            self.assertAlmostEqual(length / max(lengths), time / max(times), delta=0.01)

    def test_time_against_resident_blades_is_measured_for_each_field(self):
        self.require_growth()

    def test_time_against_drawn_blades_has_more_of_them_the_farther_they_are_drawn(self):
        runs, _, out = self.measured("visible", "1M")
        self.assertEqual(len(self.marks(out / "visible.svg", "circle")), len(runs))
        for way in {run["way"] for run in runs}:
            drawn = [run["stats"]["blades"]["drawn"] for run in runs if run["way"] == way]
            self.assertEqual(drawn, sorted(drawn))
            self.assertLess(drawn[0], drawn[-1])

    def test_time_against_segments_draws_the_same_blades_at_each_level(self):
        runs, _, out = self.measured("levels", "1M")
        self.assertEqual(len(self.marks(out / "levels.svg", "circle")), len(runs))
        self.assertEqual({run["stats"]["blades"]["drawn"] for run in runs}, {BLADES})
        self.assertTrue({1, 7, 21} <= {run["x"] for run in runs if run["way"] == "tessellation"})

    def test_culling_tests_are_measured_alone_and_together(self):
        runs, text, out = self.measured("culling", "other")
        self.assertEqual([run["way"] for run in runs], ["none", "patch", "orientation", "frustum", "distance", "occlusion", "all", "all, thinned"])
        for run in runs:
            counts = run["stats"]["blades"]
            self.assertEqual(counts["drawn"] + counts["lod"] + sum(counts["culled"].values()), counts["resident"])
            for test, count in counts["culled"].items():
                if not run["way"].startswith(("all", test)):
                    self.assertEqual(count, 0, f"{run['way']}: {test}")
            self.assertIn(f"| {run['way']} | {counts['culled']['patch']} |", text)
        self.assertEqual(len(self.marks(out / "culling-other.svg", "rect", **{"class": "bar"})) % len(runs), 0)

    def test_coverage_is_told_by_bands_of_distance_that_add_up(self):
        # One sample for each of a few hundred grass pixels is too noisy.
        runs, text, _ = self.measured("coverage", "other", blades=10 * BLADES, size=(160, 90))
        for run in runs:
            found, reference = run["coverage"]["found"], run["coverage"]["reference"]
            self.assertEqual((len(found), len(reference), len(run["limits"])), (8, 8, 8))
            self.assertEqual(run["limits"], sorted(run["limits"]))
            for shares in (found, reference):
                self.assertTrue(0.02 < sum(shares) <= 1.001, shares)
            self.assertAlmostEqual(sum(found) / sum(reference), 1.0, delta=0.05)
            self.assertIn(f"{100 * sum(reference):.3f}", text)

    def test_every_place_of_a_picture_counts_for_one_band_of_distance_in_any_way(self):
        for drawing in (SOON, ("--geometry", "raster")):
            self.require_bands((9, 3), (25, 5), (50, 6), drawing=drawing)


if __name__ == "__main__":
    unittest.main()
