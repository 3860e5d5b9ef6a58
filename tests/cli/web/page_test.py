"""`sward export -o page/`: the page of a field. Long tests open it in Chromium and hold its pictures against the
viewer's."""

import base64
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "view"))

from support import CliTest, INPUT, IO, PROGRAM, ROOT, USAGE

from browser import chromium, look
from file_server import FolderServer
from needs import needs

sys.path.insert(0, str(ROOT / "scripts"))

HERE = Path(__file__).resolve().parent
VIEWER = Path(os.environ.get("SWARD_VIEWER", PROGRAM.with_name("sward-view"))).resolve()
FILES = {"index.html", "sward.js", "field.sward", "field.cover"}

# A view in grass, and one of the whole field.
CAMERAS = [{"eye": [-2.0, 1.2, -6.0], "target": [0.0, 0.0, 0.0], "up": [0, 1, 0], "fov_y_deg": 45},
           {"eye": [8.1, 19.2, -57.9], "target": [-1.9, 1.2, 0.2], "up": [0, 1, 0], "fov_y_deg": 40}]
LARGEST_FLIP = 0.03  # measured: 0.018 in grass
LARGEST_SOWN_FLIP = 0.04  # measured: 0.029, in a smaller picture
LARGEST_STRAY = 3e-4  # [m] of a control point, of ribbons 1 m long; measured: 1.1e-4 for 99 of 100 blades


class Page(CliTest):
    def setUp(self):
        super().setUp()
        self.field = self.bake("hills", "--count", "3000", to="a<b>&.sward")

    def test_a_page_has_field_script_and_title(self):
        said = self.sward("export", self.field, "-o", "page/").stdout
        self.assertIn("page/: ", said)
        page = self.folder / "page"
        self.assertEqual({path.name for path in page.iterdir()}, FILES)
        self.assertEqual((page / "field.sward").read_bytes(), self.field.read_bytes())
        self.assertEqual((page / "sward.js").read_bytes(), (ROOT / "web/dist/sward.js").read_bytes())
        text = (page / "index.html").read_text(encoding="utf-8")
        self.assertIn("<title>a&lt;b&gt;&amp;</title>", text)
        self.assertNotIn("{{", text)
        # Nothing comes from elsewhere, and without a poster there is no picture.
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:)', text), [])
        self.assertEqual(re.findall(r"https?://(?!localhost)\S+", text), [])

    def test_a_field_with_seeds_has_its_sower(self):
        seeds = self.bake("hills", "--density", "20", "--budget", "500", "--seeds", "always", to="seeds.sward")
        said = self.sward("export", seeds, "-o", "page/").stderr
        self.assertNotIn("warning", said)
        page = self.folder / "page"
        self.assertEqual({path.name for path in page.iterdir()}, FILES | {"sow.wasm"})
        self.assertEqual((page / "sow.wasm").read_bytes(), (ROOT / "web/dist/sow.wasm").read_bytes())
        # A grown part has no seeds.
        self.sward("export", seeds, "-o", "part/", "--share", "0.5")
        self.assertEqual({path.name for path in (self.folder / "part").iterdir()}, FILES)

    def test_a_cover_belongs_to_its_field(self):
        """It has hashes of itself and of the field's blades; the script compares both."""
        needs("node")
        self.sward("export", self.field, "-o", "page/")
        self.sward("export", self.bake("plane", "--count", "500", to="other.sward"), "-o", "other/")
        own = (self.folder / "page/field.cover").read_bytes()
        covers = {"own": own, "other": (self.folder / "other/field.cover").read_bytes(), "short": own[:100], "cut": own[:-4],
                  "old": own[32:], "empty": b""}
        for at in (8, 20, 40, len(own) - 1):
            covers[f"bit {at}"] = own[:at] + bytes([own[at] ^ 4]) + own[at + 1:]
        files = []
        for name, data in covers.items():
            files.append(self.folder / f"{name}.cover")
            files[-1].write_bytes(data)
        done = subprocess.run(["node", str(HERE / "read_field.mjs"), "covers", str(self.field), *map(str, files)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = dict(zip(covers, json.loads(done.stdout)))
        self.assertEqual(found.pop("own"), {})
        for name, error in found.items():
            self.assertEqual(error.get("kind"), "input", name)
            self.assertIn(f"{name}.cover: ", error["message"])
        self.assertIn("another field", found["other"]["message"])
        self.assertIn("hash", found["bit 40"]["message"])
        self.assertIn("sward export", found["old"]["message"])

    def test_a_poster_becomes_a_small_jpeg(self):
        from PIL import Image
        rng = numpy.random.default_rng(1)
        noise = rng.integers(0, 256, (900, 1600, 3), dtype=numpy.uint8)  # the worst that a picture can be
        Image.fromarray(noise).save(self.folder / "poster.png")
        self.sward("export", self.field, "-o", "page/", "--poster", "poster.png")
        jpeg = self.folder / "page/poster.jpg"
        self.assertLessEqual(jpeg.stat().st_size, 150_000)
        with Image.open(jpeg) as picture:
            self.assertEqual(picture.format, "JPEG")
            self.assertLessEqual(max(picture.size), 1280)
            self.assertAlmostEqual(picture.size[0] / picture.size[1], 16 / 9, delta=0.02)
        text = (self.folder / "page/index.html").read_text(encoding="utf-8")
        self.assertIn('src="poster.jpg" alt="A picture of the field a&lt;b&gt;&amp;"', text)

    def test_what_is_no_poster_is_refused(self):
        (self.folder / "text.png").write_text("no picture", encoding="ascii")
        self.refused("export", self.field, "-o", "page/", "--poster", "text.png", code=INPUT, names=["text.png"])
        self.refused("export", self.field, "-o", "page/", "--poster", "none.png", code=IO, names=["none.png"])
        self.refused("export", self.field, "-o", "x.csv", "--poster", "text.png", code=USAGE, names=["--poster", "NAME/"])
        self.assertFalse((self.folder / "page").exists())

    def test_a_full_folder_is_kept_without_force(self):
        self.sward("export", self.field, "-o", "page/")
        (self.folder / "page/index.html").write_text("mine", encoding="ascii")
        self.refused("export", self.field, "-o", "page/", code=IO, names=["page/", "--force"])
        self.assertEqual((self.folder / "page/index.html").read_text(encoding="ascii"), "mine")
        self.sward("export", self.field, "-o", "page/", "--force")
        self.assertIn("<title>", (self.folder / "page/index.html").read_text(encoding="utf-8"))

    def test_a_place_that_takes_no_folder_is_refused_with_the_reason(self):
        (self.folder / "file").touch()
        for name, why in (("file/", "is no folder"), ("file/page/", "file is no folder"), ("missing/page/", "folder missing does not exist")):
            self.refused("export", self.field, "-o", name, "--force", code=IO, names=[name.rstrip("/"), why])
        self.assertFalse((self.folder / "missing").exists())

    def test_a_page_takes_no_option_of_other_formats(self):
        self.refused("export", self.field, "-o", "page/", "--with-ground", code=USAGE, names=["page/", ".glb"])

    def test_the_script_is_small(self):
        """Compressed, as servers send it."""
        import gzip
        self.assertLess(len(gzip.compress((ROOT / "web/dist/sward.js").read_bytes(), 9)), 150_000)


class Shaders(CliTest):
    def test_the_script_has_the_shaders_of_the_repository(self):
        """They are the viewer's text in GLSL ES; a change of that text belongs to a new build of the script."""
        needs("node")
        done = subprocess.run(["node", str(HERE / "shader_texts.mjs"), str(self.folder)], capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout), [], "other text than shaders/: run `npm ci && npm run build` in web/")
        stages = sorted(self.folder.iterdir())
        self.assertGreater(len(stages), 10)
        for stage in stages:
            done = subprocess.run(["glslangValidator", str(stage)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, f"{stage.name} as GLSL ES: {done.stdout}")


class LongPackage(CliTest):
    def test_the_script_is_what_npm_builds(self):
        """Types are right, too."""
        from export.node_readers import installed
        packages = installed(ROOT / "web", "web")
        made = shutil.ignore_patterns("node_modules", "generated", "dist")
        shutil.copytree(ROOT / "web", self.folder / "web", ignore=made)
        (self.folder / "shaders").symlink_to(ROOT / "shaders")
        (self.folder / "web/node_modules").symlink_to(packages)
        for command in (["node", "build.mjs"], ["node", "node_modules/typescript/bin/tsc", "--noEmit", "-p", "."]):
            done = subprocess.run(command, cwd=self.folder / "web", capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual((self.folder / "web/dist/sward.js").read_text(encoding="utf-8"),
                         (ROOT / "web/dist/sward.js").read_text(encoding="utf-8"))


class LongBrowser(CliTest):
    def setUp(self):
        super().setUp()
        needs("chromium")
        self.field = self.bake("hills", "--count", "20000")
        self.sward("export", self.field, "-o", "page/")
        self.page = self.folder / "page"
        (self.page / "checks.html").write_bytes((HERE / "checks.html").read_bytes())

    def check(self, name, *switches, ranges=True, **settings):
        """What a check of checks.html finds. Fails if anything stands on the console."""
        (self.page / "settings.json").write_text(json.dumps({"check": name, **settings}), encoding="ascii")
        return look(self, self.page, "checks.html", *switches, ranges=ranges)

    def assert_picture(self, camera):
        """The picture of a camera, each sample alone, and the curves of its blades are the viewer's."""
        from flip import flip, to_linear
        from png import picture_of

        width, height = 480, 300
        self.write_json("camera.json", camera)
        found = self.check("picture", camera=camera, size=[width, height])
        (self.folder / "web.png").write_bytes(base64.b64decode(found["picture"]))
        subprocess.run([str(VIEWER), "render", str(self.field), "-o", "view.png", "--size", f"{width}x{height}",
                        "--camera", "camera.json", "--dump-blades", "blades.csv", "--force"], cwd=self.folder,
                       check=True, capture_output=True)
        ours, theirs = (picture_of(self.folder / name) / 255.0 for name in ("web.png", "view.png"))
        self.assertGreater(float(numpy.std(ours)), 0.02, "the picture is not blank")
        self.assertLess(float(flip(to_linear(theirs), to_linear(ours)).mean()), LARGEST_FLIP)
        self.assert_curves(found["curves"])

    def test_pictures_are_those_of_the_viewer(self):
        for camera in CAMERAS:
            with self.subTest(camera["fov_y_deg"]):
                self.assert_picture(camera)

    def test_a_planet_is_that_of_the_viewer(self):
        self.field = self.bake("sphere", "--count", "20000", "--ground-up", "radial", to="planet.sward")
        self.sward("export", self.field, "-o", "page/", "--force")
        self.assert_picture({"eye": [14, 8, 20], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 46})

    def test_a_field_with_seeds_is_sown_as_in_the_viewer(self):
        """All that the camera wants, within a stated difference; and by few stored blades."""
        from flip import flip, to_linear
        from png import picture_of

        field = self.bake("hills", "--density", "25", "--budget", "1500", "--seeds", "always", to="seeds.sward")
        self.sward("export", field, "-o", "page/", "--force")
        width, height = 240, 150
        self.write_json("camera.json", CAMERAS[0])
        found = self.check("sown", camera=CAMERAS[0], size=[width, height])
        self.assertEqual(found["thinning"], 1)
        self.assertGreater(found["sown"], 20_000)
        (self.folder / "web.png").write_bytes(base64.b64decode(found["picture"]))
        subprocess.run([str(VIEWER), "render", str(field), "-o", "view.png", "--size", f"{width}x{height}", "--camera",
                        "camera.json", "--force"], cwd=self.folder, check=True, capture_output=True)
        ours, theirs = (picture_of(self.folder / name) / 255.0 for name in ("web.png", "view.png"))
        self.assertLess(float(flip(to_linear(theirs), to_linear(ours)).mean()), LARGEST_SOWN_FLIP)

    def assert_curves(self, curves):
        """Every blade that the viewer draws is drawn, with its curve; others are those that the ground hides."""
        with open(self.folder / "blades.csv", encoding="ascii", newline="") as file:
            rows = {row["id"]: row for row in csv.DictReader(file)}
        ours = {str(row[0]): numpy.array(row[1:]) for row in curves}
        drawn = {name for name, row in rows.items() if row["cull_result"] == "drawn"}
        self.assertLess(len(drawn - set(ours)), 1e-3 * len(drawn) + 1)
        # The ground hides whole patches, too. A few lie on a limit.
        others = [name for name in set(ours) - drawn if rows[name]["cull_result"] not in ("occlusion", "patch")]
        self.assertLess(len(others), 1e-3 * len(drawn) + 1)
        columns = [f"{point}{axis}" for point in ("", "v1", "v2") for axis in "xyz"]
        stray = [max(abs(ours[name][i] - float(rows[name][column])) for i, column in enumerate(columns))
                 for name in drawn & set(ours)]
        self.assertLess(float(numpy.percentile(stray, 99)), LARGEST_STRAY)

    def test_a_page_is_used_by_mouse_touch_and_keys(self):
        found = self.check("use")
        for act in ("posterGoes", "drag", "pinch", "wheel", "arrow", "walk", "restored", "complete"):
            self.assertTrue(found[act], act)
        self.assertEqual(found["resized"], [320, 300])
        self.assertEqual(found["drawnAtRest"], 0)
        self.assertTrue(all(found["labels"]))
        # A walker stands on the ground, which is at most 4 m high here.
        self.assertLess(abs(found["walker"][1]), 6.0)

    def test_a_host_sets_and_sees_all(self):
        found = self.check("host", "--force-device-scale-factor=2")
        self.assertEqual(found["ratio"], 2)
        for style, *size, width, height in found["sizes"]:
            self.assertEqual(size, [max(2 * width, 1), max(2 * height, 1)], style)
        # Without a height of its own an element is as high as a picture of 16:9.
        self.assertEqual([row[3:] for row in found["sizes"][:4]], [[120, 90], [160, 90], [120, 100], [0, 0]])
        self.assertEqual(found["drawnHidden"], 0)
        self.assertTrue(found["isFramed"] and found["keepsView"])
        # Unfolded where there is room, until someone folds it.
        self.assertEqual(found["folded"], [False, True, False])
        self.assertEqual(found["shown"], ["50 %", "12:30", "×0.05"])
        self.assertEqual(found["aria"], found["shown"])
        self.assertEqual(found["pressed"], ["Fly"])
        words = [("wind", "-1", "0 to 10"), ("hour", '"9"', "5 to 19"), ("detail", "0", "0.01 to 100"), ("swim", "orbit, fly"), ("fovYDeg",),
                 ("showField", "undefined", "field, cover"), ("field", "undefined"), ("field", "7"), ("renderer", '"vulkan"', '"webgpu" or "webgl"'),
                 ("render", "renderer"), ("camera", "eye, target"), ("panel", "1", "true or false"), ("sow", "true", "false"),
                 ("sow", "blades", "0"), ("field.sward", "not a cover"), ("element", "null"), ("gl", "null"), ("undefined", "address")]
        self.assertEqual(len(found["refused"]), len(words), found["refused"])
        for said, expected in zip(found["refused"], words):
            self.assertRegex(said, "^(usage|input): ")
            for word in expected:
                self.assertIn(word, said)
        self.assertEqual((found["both"], found["canvases"], found["stopped"]), (["rejected", "fulfilled"], 1, True))

    def test_far_fields_of_a_long_page_give_their_contexts_away(self):
        found = self.check("crowd", count=10)
        self.assertEqual(found["texts"], [""])
        self.assertLessEqual(found["held"], 8)

    def test_a_page_without_its_script_says_so(self):
        (self.page / "sward.js").unlink()
        with FolderServer(self.page) as server:
            browser = chromium(f"{server.address}/index.html", self.folder / "profile", "--dump-dom", "--virtual-time-budget=10000")
            text = browser.communicate(timeout=120)[0]
        self.assertIn("sward.js cannot be loaded: the server answers 404", text)
        self.assertIn('role="alert"', text)

    def test_a_server_without_ranges_is_enough(self):
        self.assertTrue(self.check("use", ranges=False)["complete"])

    def test_a_truncated_field_is_told(self):
        field = self.page / "field.sward"
        field.write_bytes(field.read_bytes()[:-1000])
        said = self.check("refused")["message"]
        self.assertRegex(said["text"], r"field\.sward: \d+ bytes instead of \d+: truncated")
        self.assertEqual(said["role"], "alert")

    def test_a_browser_without_webgl_is_told(self):
        self.assertIn("no WebGL 2", self.check("without")["message"]["text"])

    def test_a_page_that_is_opened_as_a_file_says_what_to_do(self):
        browser = chromium((self.page / "index.html").as_uri(), self.folder / "profile", "--dump-dom")
        text = browser.communicate(timeout=120)[0]
        self.assertIn("python3 -m http.server", text)


if __name__ == "__main__":
    unittest.main()
