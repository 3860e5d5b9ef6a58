"""The cookbook's commands, typed as they stand there on a landscape as Blender exports it."""

import os
import struct
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from meshes import blender_glb, grey_png, square
from readme_test import commands
from support import CliTest, PROGRAM, ROOT

COOKBOOK = ROOT / "docs/cookbook.md"


class Cookbook(CliTest):
    def setUp(self):
        super().setUp()
        # Painted red where x > 0: a thirty-third of the vertices lies on the edge of the paint.
        mesh = square(8.0, cells=32, color_of=lambda x, z: (float(x > 0), 0.0, 0.0, 1.0))
        uvs = [(x / 8.0 + 0.5, z / 8.0 + 0.5) for x, _, z in mesh.positions]
        (self.folder / "landscape.glb").write_bytes(blender_glb(mesh, uvs))
        (self.folder / "mask.png").write_bytes(grey_png(64, 1, [0] * 32 + [65535] * 32))

    def test_its_commands_grow_grass_where_paint_is(self):
        environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"}
        typed = commands(COOKBOOK)
        self.assertGreater(len(typed), 3)
        for command in typed:
            with self.subTest(command=command):
                done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=environment,
                                      stdin=subprocess.DEVNULL, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("warning", done.stderr)
        for name in ("meadow.sward", "by_image.sward"):
            blades = self.blades(self.folder / name)
            # Half of 64 m² at 600 per m², and the fading edge of the paint.
            self.assertAlmostEqual(len(blades) / (32 * 600), 1.0, delta=0.05, msg=name)
            # An image repeats: its white edge shines half a pixel round the other side.
            self.assertFalse([b.root for b in blades if -3.9 < b.root[0] < -0.3], name)
        self.assertGreater(self.read_json("report.json")["roots"]["rejected"]["mask"], 15000)

    def test_its_files_are_there(self):
        text = COOKBOOK.read_text(encoding="utf-8")
        for name in ("examples/blender/painted_landscape.py", "examples/blender/painted_landscape.camera.json"):
            self.assertIn(name, text)
            self.assertTrue((ROOT / name).is_file(), name)
        picture = (ROOT / "docs/images/cookbook.png").read_bytes()
        self.assertEqual(struct.unpack(">2I", picture[16:24]), (640, 360))
        self.assertLess(len(picture), 300_000)


if __name__ == "__main__":
    unittest.main()
