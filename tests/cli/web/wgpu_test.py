"""The renderer by WebGPU of web/: its translation to WGSL; long tests hold poses and pictures in Chromium against the
viewer's."""

import base64
import csv
import json
import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "view"))

from support import CliTest, PROGRAM, ROOT

from file_server import FolderServer
from needs import needs

sys.path.insert(0, str(ROOT / "scripts"))

HERE = Path(__file__).resolve().parent
VIEWER = Path(os.environ.get("SWARD_VIEWER", PROGRAM.with_name("sward-view"))).resolve()
SOFTWARE = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader",
            "--disable-vulkan-surface"]

# In grass, and of the whole field.
CAMERAS = [{"eye": [-2.0, 1.2, -6.0], "target": [0.0, 0.0, 0.0], "up": [0, 1, 0], "fov_y_deg": 45},
           {"eye": [8.1, 19.2, -57.9], "target": [-1.9, 1.2, 0.2], "up": [0, 1, 0], "fov_y_deg": 40}]
LARGEST_FLIP = 0.03
LARGEST_STRAY = 2e-4  # [m] of a control point, of ribbons 1 m long; measured: 7e-5 for 99 of 100 blades, 1.3e-4 at most


class Translation(CliTest):
    def test_shaders_become_wgsl(self):
        """Statements that differ between the languages, places of uniforms, limits; the script has the same text."""
        needs("node")
        done = subprocess.run(["node", str(HERE / "wgsl_checks.mjs"), str(ROOT), str(self.folder)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout), [])


class LongWebGpu(CliTest):
    def setUp(self):
        super().setUp()
        needs("chromium")

    def export(self, *grown):
        self.field = self.bake(*grown)
        self.sward("export", self.field, "-o", "page/", "--force")
        self.page = self.folder / "page"
        (self.page / "checks.html").write_bytes((HERE / "wgpu_checks.html").read_bytes())

    def check(self, name, **settings):
        """What a check of wgpu_checks.html finds. Fails if an error stands on the console."""
        (self.page / "settings.json").write_text(json.dumps({"check": name, **settings}), encoding="ascii")
        with FolderServer(self.page) as server:
            browser = subprocess.Popen(
                ["chromium", "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                 "--ignore-gpu-blocklist", "--disable-background-networking", "--no-first-run", *SOFTWARE,
                 f"--user-data-dir={self.folder / 'profile'}", "--enable-logging=stderr", f"{server.address}/checks.html"],
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
            try:
                found = json.loads(server.posted.get(timeout=900))
            finally:
                os.killpg(browser.pid, signal.SIGTERM)
                said = browser.communicate()[1]
        self.assertNotIn("failed", found, found.get("failed"))
        self.assertEqual(found["errors"], [])
        self.assertEqual([line for line in said.splitlines() if "ERROR:CONSOLE" in line], [])
        return found

    def assert_pictures(self, cameras, size=(480, 300)):
        """Pictures and curves are the viewer's, whose culling and poses are the CPU's."""
        from flip import flip, to_linear
        from png import picture_of

        found = self.check("picture", cameras=cameras, size=size)
        for i, camera in enumerate(cameras):
            self.write_json("camera.json", camera)
            (self.folder / "web.png").write_bytes(base64.b64decode(found["pictures"][i]))
            subprocess.run([str(VIEWER), "render", str(self.field), "-o", "view.png", "--size", f"{size[0]}x{size[1]}",
                            "--camera", "camera.json", "--dump-blades", "blades.csv", "--force"], cwd=self.folder,
                           check=True, capture_output=True)
            ours, theirs = (picture_of(self.folder / name) / 255.0 for name in ("web.png", "view.png"))
            self.assertGreater(float(numpy.std(ours)), 0.02, "the picture is not blank")
            self.assertLess(float(flip(to_linear(theirs[..., :3]), to_linear(ours[..., :3])).mean()), LARGEST_FLIP)
            self.assert_curves(found["curves"][i])

    def assert_curves(self, curves):
        """The blades that are drawn are the viewer's, with their curves."""
        with open(self.folder / "blades.csv", encoding="ascii", newline="") as file:
            rows = {row["id"]: row for row in csv.DictReader(file)}
        ours = {str(row[0]): numpy.array(row[1:]) for row in curves}
        drawn = {name for name, row in rows.items() if row["cull_result"] == "drawn"}
        # At ridges: SwiftShader places the ground's corners to 1/16 of a pixel, the viewer to 1/256. Measured: 5e-3.
        self.assertLess(len(drawn ^ set(ours)), 1e-2 * len(drawn) + 1)
        columns = [f"{point}{axis}" for point in ("", "v1", "v2") for axis in "xyz"]
        stray = [max(abs(ours[name][i] - float(rows[name][column])) for i, column in enumerate(columns))
                 for name in drawn & set(ours)]
        self.assertLess(float(numpy.percentile(stray, 99)), LARGEST_STRAY)

    def test_ten_thousand_blades_are_those_of_the_viewer(self):
        self.export("hills", "--count", "20000")
        self.assert_pictures(CAMERAS)

    def test_plants_on_a_planet_are_those_of_the_viewer(self):
        self.export("sphere", "--count", "6000", "--ground-up", "radial", "--meadow", "daisies")
        self.assert_pictures([{"eye": [14, 8, 20], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 46}])

    def test_a_lost_device_is_replaced(self):
        self.export("hills", "--count", "2000")
        found = self.check("lost")
        self.assertEqual((found["first"], found["second"]), ("webgpu", "webgl"))
        self.assertIn("The graphics device was lost. Now WebGL draws.", found["said"])
        self.assertTrue(found["keepsCamera"])
        self.assertTrue(found["labelled"])
        self.assertEqual(found["canvases"], 1)

    def test_software_draws_by_webgl_unless_a_page_asks(self):
        self.export("hills", "--count", "2000")
        found = self.check("chosen")
        self.assertEqual(found["kind"], "webgl")
        self.assertIn("no WebGPU", found["said"])


if __name__ == "__main__":
    unittest.main()
