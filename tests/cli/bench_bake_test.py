"""scripts/bench-bake at small sizes: every row is measured, and what it says of roots is so."""

import json
import os
import subprocess
import unittest

from support import PROGRAM, ROOT, CliTest

SCRIPT = ROOT / "scripts/bench-bake"
# All but the tiles.
ROWS = ("uniform", "sky", "poisson", "sustained", "dense", "count", "glb", "clearance", "read", "memory")


class BenchEdit(CliTest):
    def test_it_measures_sessions_and_strokes(self):
        done = subprocess.run([str(ROOT / "scripts/bench-edit"), "--side", "60", "--cells", "20", "--density", "3",
                               "--strokes", "4", "--programs", str(PROGRAM.parent)],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout.splitlines()[-1])
        self.assertEqual((told["blades"], told["triangles"]), (10800, 800))
        self.assertLessEqual(told["median_ms"], told["p99_ms"])
        self.assertGreater(min(told["median_ms"], told["start_s"], told["cells"], told["blades_a_stroke"]), 0)


class BenchBake(CliTest):
    def bench(self, *arguments, code=0, path=None):
        done = subprocess.run([str(SCRIPT), "--out", str(self.folder / "out"), "--programs", str(PROGRAM.parent), "--rounds", "1",
                               *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              env={**os.environ, "PATH": f"{path}:{os.environ['PATH']}"} if path else None)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def measured(self, *arguments, path=None):
        done = self.bench(*arguments, path=path)
        found = json.loads((self.folder / "out/measured.json").read_text(encoding="utf-8"))
        self.assertEqual((self.folder / "out/README.md").read_text(encoding="utf-8"), done.stdout)
        self.assertNotIn("measured.sward", os.listdir(self.folder / "out"))
        return done.stdout, found["rows"]

    def require_figures(self, rows, table):
        for row in rows:
            self.assertGreater(row["figure"], 0.0, row)
            self.assertIn(f"| {row['work']} | {row['figure']:.3g} {row['unit']} |", table)

    def test_each_row_measures_what_it_names(self):
        table, rows = self.measured("--scale", "0.002", "--without", "blender,open3d", "--rows", ",".join(ROWS))
        self.assertEqual(list(dict.fromkeys(row["row"] for row in rows)), list(ROWS))
        self.require_figures(rows, table)
        of = {row["row"]: row for row in rows}
        self.assertEqual(of["uniform"]["blades"], 4_000)
        self.assertEqual(of["count"]["roots"], 2_000)
        self.assertEqual(of["glb"]["blades"], 2_000)
        for name, number in (("poisson", 2_000), ("sustained", 40_000), ("dense", 2_000)):
            self.assertAlmostEqual(of[name]["roots"] / number, 1.0, delta=0.04)
        for name in ("poisson", "sustained", "dense", "count"):
            if of[name]["rho"] is not None:  # SciPy is installed
                self.assertGreaterEqual(of[name]["rho"], 0.69, name)
                self.assertLess(of[name]["rho"], 1.0, name)

    def test_tiles_go_on_where_they_ended(self):
        command = ("--scale", "0.0002", "--rows", "tiles")
        _, rows = self.measured(*command, "--seconds", "0")
        self.assertEqual(rows, [])
        self.assertEqual((self.folder / "out/tiles/plan.json").is_file(), True)
        table, rows = self.measured(*command, "--seconds", "100")
        self.assertEqual([row["row"] for row in rows], ["tiles"])
        self.require_figures(rows, table)
        self.assertGreater(rows[0]["peak_bytes"], 1 << 20)
        self.assertFalse((self.folder / "out/tiles").exists())

    def test_another_program_is_compared_by_points(self):
        # In Blender's place stands what prints its line.
        (self.folder / "blender").write_text("#!/bin/sh\necho starting\necho '{\"seconds\": 0.5, \"points\": 20000, \"triangles\": 1}'\n")
        (self.folder / "blender").chmod(0o755)
        _, rows = self.measured("--scale", "0.02", "--without", "open3d", "--rows", "poisson", path=self.folder)
        self.assertEqual((rows[0]["other"], rows[0]["other_points"]), ("Blender", 20_000))
        self.assertAlmostEqual(rows[0]["other_us"], 25.0)
        self.assertAlmostEqual(rows[0]["times"], 25.0 / rows[0]["figure"])

    def test_a_wrong_argument_is_named(self):
        for arguments, said in ((("--rows", "nothing"), "no row 'nothing'"), (("--scale", "0"), "--scale"),
                                (("--without", "houdini"), "houdini"), (("--programs", self.folder), "no program")):
            self.assertIn(said, self.bench(*arguments, code=1).stderr)


if __name__ == "__main__":
    unittest.main()
