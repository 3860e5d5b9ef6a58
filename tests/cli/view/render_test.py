"""`sward-view render`, `bench` and `devices` by their contract, without any display."""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from soon import SOON

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
BLADES = 2000
SIZE = ["--size", "64x36"]
PASSES = {"update", "cull", "pyramid", "blades", "shadow", "resolve", "grass", "ground", "total"}
CULL_RESULTS = {"drawn", "patch", "orientation", "frustum", "distance", "occlusion", "lod"}
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}


def png_size(path):
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG"
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


class RenderCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-render-")
        cls.addClassCleanup(folder.cleanup)
        cls.field = Path(folder.name) / "hills.sward"
        subprocess.run([SWARD, "bake", "hills", "--count", str(BLADES), "--meadow", "grass", "-o", cls.field, "-q"],
                       check=True)
        cls.plain = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-render-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def viewer(self, *arguments, code=0, environment=None):
        done = subprocess.run([VIEWER, *map(str, arguments)], cwd=self.folder, text=True,
                              env={**ENVIRONMENT, **(environment or {})}, capture_output=True)
        self.assertEqual(done.returncode, code,
                         f"sward-view {' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
        return done

    def render(self, *arguments, **how):
        size = [] if "--size" in arguments else SIZE
        return self.viewer("render", self.field, *size, *arguments, **how)

    def refused(self, *arguments, code, says, leaves=()):
        """What must fail with `code`, name the trouble, and leave nothing behind."""
        done = self.render(*arguments, code=code)
        self.assertEqual(done.stdout, "")
        self.assertIn(says, done.stderr)
        self.assertEqual({path.name for path in self.folder.iterdir()}, set(leaves))

    def stats(self, *arguments):
        self.render("-o", "s.png", "--stats", "s.json", "--force", *arguments)
        return json.loads((self.folder / "s.json").read_text(encoding="utf-8"))


class RenderTest(RenderCase):
    def test_colours_by_reason_change_no_count(self):
        shown = ("--camera", "eye", "--frames", "0:3", *SOON)
        plain = self.stats(*shown)["blades"]
        by_reason = self.stats(*shown, "--debug", "reason", "--validation")["blades"]
        self.assertEqual(by_reason, plain)
        self.assertLess(plain["drawn"], plain["total"], "some blade must be left out")

    def plain_stats(self):
        """Those of a picture without any wish, drawn once; its size is the one that was asked for."""
        if self.plain is None:
            type(self).plain = self.stats("--validation")
            self.assertEqual(png_size(self.folder / "s.png"), (64, 36))
        return self.plain

    def test_the_picture_has_its_size_and_the_stats_every_key_and_counts_that_add_up(self):
        stats = self.plain_stats()
        self.assertEqual(set(stats), {"device", "driver", "size", "samples", "geometry",
                                      "geometry_reason", "blades", "gpu_ms", "cpu_ms",
                                      "memory_bytes", "validation_messages"})
        self.assertEqual(stats["size"], [64, 36])
        self.assertEqual(stats["samples"], 4)
        self.assertEqual(stats["validation_messages"], 0)
        self.assertEqual(set(stats["gpu_ms"]), PASSES)
        for times in [*stats["gpu_ms"].values(), stats["cpu_ms"]["record"]]:
            self.assertEqual(list(times), ["min", "median", "p99"])
            self.assertLessEqual(times["min"], times["median"])
            self.assertLessEqual(times["median"], times["p99"])
        self.assertGreater(stats["gpu_ms"]["total"]["min"], 0)
        self.assertGreater(stats["memory_bytes"]["device"], 16 * BLADES)
        blades = stats["blades"]
        self.assertEqual(blades["total"], BLADES)
        self.assertEqual(blades["total"], blades["resident"] + blades["streamed_out"])
        self.assertEqual(blades["resident"],
                         blades["drawn"] + blades["lod"] + sum(blades["culled"].values()))

    def test_a_field_larger_than_its_budget_is_shown_in_part(self):
        field, blades = self.folder / "wide.sward", 100_000
        subprocess.run([SWARD, "bake", "plane", "--count", str(blades), "--meadow", "grass", "--sky-rays", "0", "-o", field, "-q"],
                       check=True)

        def stats(*arguments, code=0):
            done = self.viewer("render", field, *SIZE, "-o", "s.png", "--stats", "s.json", "--force",
                               "--geometry", "raster", "--camera", "eye", *arguments, code=code)
            if code:
                return done.stderr
            return json.loads((self.folder / "s.json").read_text(encoding="utf-8"))

        whole = stats("--gpu-memory", "1T")
        self.assertEqual(whole["blades"]["streamed_out"], 0)
        budget = whole["memory_bytes"]["device"] - 24 * blades
        part = stats("--gpu-memory", budget, "--validation")
        self.assertLessEqual(part["memory_bytes"]["device"], budget)
        counts = part["blades"]
        self.assertGreater(counts["streamed_out"], blades // 4)
        self.assertGreater(counts["drawn"], 0)
        self.assertEqual(counts["total"], counts["resident"] + counts["streamed_out"])
        self.assertEqual(counts["resident"],
                         counts["drawn"] + counts["lod"] + sum(counts["culled"].values()))
        # The same again, byte for byte; and each reason in its colour, of what is there.
        first = (self.folder / "s.png").read_bytes()
        stats("--gpu-memory", budget)
        self.assertEqual((self.folder / "s.png").read_bytes(), first)
        self.assertGreater(stats("--gpu-memory", budget, "--debug", "reason")["blades"]["drawn"], 0)

        for asks in (["--dump-blades", "d.csv"], ["--reference"]):
            self.assertIn("--gpu-memory", stats("--gpu-memory", budget, *asks, code=1))
        self.assertIn("at least", stats("--gpu-memory", "1M", code=4))
        for wrong in ("much", "1K", "-2G", "2GB"):
            self.assertIn("--gpu-memory", stats("--gpu-memory", wrong, code=1))

    def test_a_frame_beyond_the_largest_time_is_refused(self):
        self.refused("-o", "t.png", "--fixed-dt", "1000000", "--frames", "8590:8590", code=1, says="8589934592 s")

    def test_the_dump_has_one_row_per_blade_and_the_cull_results_of_the_stats(self):
        stats = self.stats("--dump-blades", "d.csv", "--camera", "eye", *SOON)
        with open(self.folder / "d.csv", encoding="ascii", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), "id,x,y,z,v1x,v1y,v1z,v2x,v2y,v2z,ux,uy,uz,eta,lod_width,cull_result"
                         .split(","))
        self.assertEqual(len({row["id"] for row in rows}), BLADES)
        counts = {cull_result: sum(1 for row in rows if row["cull_result"] == cull_result) for cull_result in CULL_RESULTS}
        self.assertEqual(sum(counts.values()), BLADES)
        self.assertEqual(counts["drawn"], stats["blades"]["drawn"])
        self.assertEqual(counts["lod"], stats["blades"]["lod"])
        for kind, count in stats["blades"]["culled"].items():
            self.assertEqual(counts[kind], count, kind)

    def test_after_300_frames_of_wind_no_blade_is_under_its_own_ground(self):
        self.render("-o", "w.png", "--frames", "300:300", "--dump-blades", "d.csv", *SOON)
        with open(self.folder / "d.csv", encoding="ascii", newline="") as file:
            for row in csv.DictReader(file):
                root, v1, v2, up = ([float(row[p + c]) for c in "xyz"] for p in ("", "v1", "v2", "u"))
                length = (2 * math.dist(v2, root) + math.dist(v1, root) + math.dist(v2, v1)) / 3
                above = sum((a - b) * u for a, b, u in zip(v2, root, up))
                self.assertGreaterEqual(above, -1e-4 * length, f"blade {row['id']}")

    def test_wind_moves_blades_from_frame_to_frame_and_calm_does_not(self):
        frames = ("--frames", "3:12", "--fixed-dt", "1/10", "--camera", "eye", "--geometry", "raster", "--force")
        for strength, moved in (("4", True), ("0", False)):
            with self.subTest(strength=strength):
                self.render("-o", "f_%02d.png", *frames, "--wind-strength", strength)
                self.assertEqual(len(list(self.folder.glob("f_*.png"))), 10)
                first, last = ((self.folder / f"f_{i:02d}.png").read_bytes() for i in (3, 12))
                self.assertEqual(first != last, moved)
                if moved:
                    # Without a number in the name the last frame is written.
                    self.render("-o", "one.png", *frames, "--wind-strength", strength)
                    self.assertEqual((self.folder / "one.png").read_bytes(), last)

    def test_an_existing_output_is_refused_whole_and_overwritten_by_force(self):
        names = ("a.png", "s.json", "d.csv")
        outputs = ["-o", "a.png", "--stats", "s.json", "--dump-blades", "d.csv"]
        for name in names:
            with self.subTest(name=name):
                path = self.folder / name
                path.write_text("old")
                self.refused(*outputs, code=2, says=name, leaves=[name])
                self.assertEqual(path.read_text(), "old")
                path.unlink()
        for name in names:
            (self.folder / name).write_text("old")
        self.render(*outputs, "--force", *SOON)
        self.assertEqual({path.name for path in self.folder.iterdir()}, set(names))
        for name in names:
            self.assertNotEqual((self.folder / name).read_bytes(), b"old")

    def test_wrong_command_lines_are_refused_with_their_code(self):
        for arguments, code, says in (
                (["-o", "a.jpg"], 1, "a.jpg"),
                (["-o", "a_%s.png"], 1, "a_%s.png"),
                (["-o", "nowhere/a.png"], 2, "nowhere"),
                (["-o", "a.png", "--size", "0x5"], 1, "0x5"),
                (["-o", "a.png", "--frames", "5:2"], 1, "5:2"),
                (["-o", "a.png", "--samples", "3"], 1, "3"),
                (["-o", "a.png", "--cull", "patsch"], 1, "patch?"),
                (["-o", "a.png", "--sise", "4x4"], 1, "--size?"),
                (["-o", "a.png", "--device", "no such device"], 1, "no such device"),
                (["-o", "a.png", "--camera", "fitt"], 1, "fitt"),
                (["-o", "a.png", "--camera", "./missing.json"], 2, "missing.json"),
                (["-o", "a.png", "--geometry", "points"], 1, "points"),
                (["-o", "a.png", "--debug", "reasons"], 1, "reasons")):
            with self.subTest(arguments=arguments):
                self.refused(*arguments, code=code, says=says)

    def test_ground_is_refused_with_the_command_that_bakes_it(self):
        subprocess.run([SWARD, "terrain", "plane", "-o", self.folder / "x.glb"], check=True, capture_output=True)
        for command in (("render", "-o", "x.png"), ("bench",)):
            for ground, field in (("x.glb", "x.sward"), ("hills", "hills.sward")):
                with self.subTest(command=command, ground=ground):
                    done = self.viewer(*command, ground, code=3)
                    self.assertIn(f"'sward bake {ground} -o {field}'", done.stderr)
        self.assertFalse((self.folder / "x.png").exists())

    def test_a_wrong_field_is_refused_with_its_code(self):
        whole = self.field.read_bytes()
        (self.folder / "cut.sward").write_bytes(whole[:len(whole) // 2])
        for name, code in (("cut.sward", 3), ("missing.sward", 2)):
            with self.subTest(name=name):
                done = self.viewer("render", name, "-o", "a.png", code=code)
                self.assertIn(name, done.stderr)
        self.assertFalse((self.folder / "a.png").exists())

    def test_bench_prints_the_stats_on_stdout(self):
        done = self.viewer("bench", self.field, *SIZE, "--frames", "5", "--warmup", "2", "--json", *SOON)
        stats = json.loads(done.stdout)
        self.assertEqual(set(stats["gpu_ms"]), PASSES)
        self.assertEqual(stats["blades"]["total"], BLADES)
        self.assertGreater(stats["gpu_ms"]["grass"]["median"], 0)

    def test_devices_lists_the_device_that_draws(self):
        listed = self.viewer("devices").stdout
        self.assertIn(self.plain_stats()["device"], listed)

    def test_without_a_driver_it_names_the_package_that_has_one(self):
        nothing = {"VK_ICD_FILENAMES": "/nonexistent.json", "VK_DRIVER_FILES": "/nonexistent.json"}
        for command in (["devices"], ["render", self.field, "-o", "a.png"]):
            with self.subTest(command=command[0]):
                done = self.viewer(*command, code=5, environment=nothing)
                self.assertIn("mesa-vulkan-drivers", done.stderr)

    def test_every_command_has_help_with_an_example(self):
        for command in ([], ["render"], ["bench"], ["devices"]):
            with self.subTest(command=command):
                text = self.viewer(*command, "--help").stdout
                self.assertIn("Example:\n  sward-view", text)
        self.assertRegex(self.viewer("--version").stdout, r"^sward-view \d+\.\d+\.\d+\n$")


class LongRender(RenderCase):
    """The shaders of a reference, with all its samples, take eight seconds to start on lavapipe."""

    def test_a_reference_draws_every_blade(self):
        stats = self.stats("--reference", "--camera", "eye", "--size", "16x9")
        self.assertEqual(stats["blades"]["drawn"], BLADES)


if __name__ == "__main__":
    unittest.main()
