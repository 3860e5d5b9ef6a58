"""scripts/judge: what it gives Cycles, what it finds, and what it says. A stand-in draws for Blender, except in the long test."""

import importlib.machinery
import importlib.util
import json
import math
import os
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests/support")]
import exr_light  # noqa: E402
import flip  # noqa: E402
from needs import needs  # noqa: E402
from truth import field_arrays, figures, page, scenes  # noqa: E402

SWARD, VIEWER = (Path(os.environ[name]) for name in ("SWARD_PROGRAM", "SWARD_VIEW_PROGRAM"))
CAMERA = {"eye": [0, 1.2, 1.4], "target": [0, 0.2, 0], "fov_y_deg": 30}

# Draws pictures that are even: the sun's light 0.2, the sky's 0.05, and sky in the uppermost row.
STAND_IN = """
    import json, sys
    sys.path.insert(0, {scripts!r})
    import numpy as np, exr_light
    work = json.load(open(sys.argv[-1]))
    arrays = np.load(work["arrays"])
    assert arrays["faces"].max() < len(arrays["vertices"]) == len(arrays["reflected"]) == len(arrays["gloss"])
    for view in work["views"]:
        width, height = work["size"]
        alpha = np.ones((height, width)); alpha[0] = 0
        exr_light.write(view["output"], {{"ViewLayer.Combined.A": alpha, **{{
            f"ViewLayer.Combined_{{light}}.{{letter}}": np.full((height, width), value)
            for light, value in (("sun", 0.2), ("sky", 0.05)) for letter in "RGB"}}}})
    """


def the_script(name="judge"):
    """scripts/judge, or another, as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(ROOT / "scripts" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


class JudgeTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-judge-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.field, cls.camera = cls.folder / "small.sward", cls.folder / "camera.json"
        cls.camera.write_text(json.dumps(CAMERA), encoding="utf-8")
        (cls.folder / "plane.json").write_text('{"kind": "plane", "size": [1, 1], "cells": [2, 2]}', encoding="ascii")
        subprocess.run([SWARD, "bake", cls.folder / "plane.json", "--meadow", "grass", "--blade-scale", "1", "--set", "species.*.gloss=0",
                        "-o", cls.field, "-q"], check=True)
        cls.blender = cls.folder / "blender"
        cls.blender.write_text("#!/usr/bin/python3" + textwrap.dedent(STAND_IN.format(scripts=str(ROOT / "scripts"))), encoding="utf-8")
        cls.blender.chmod(0o755)

    def judge(self, *arguments, code=0, out="out"):
        done = subprocess.run([ROOT / "scripts/judge", "--out", self.folder / out, "--programs", SWARD.parent, *map(str, arguments)],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def one(self, *arguments, **how):
        """The small field from one place under one sun."""
        said = self.judge(self.field, "--camera", self.camera, "--sun", "135,60", *arguments, **how)
        return said, json.loads((self.folder / how.get("out", "out") / "report.json").read_text(encoding="utf-8"))

    def dumped(self):
        dump, settings = self.folder / "blades.csv", self.folder / "rest.json"
        settings.write_text('{"wind": []}', encoding="ascii")
        subprocess.run([VIEWER, "render", self.field, "-o", self.folder / "rest.png", "--size", "32x18", "--settings", settings,
                        "--dump-blades", dump, "--force", "-q"], check=True)
        return dump


class Arrays(JudgeTest):
    def test_blades_have_their_area_and_their_height(self):
        arrays, known = field_arrays.arrays_of(self.field, self.dumped())
        told = json.loads(subprocess.run([SWARD, "info", self.field, "--json"], check=True, capture_output=True, text=True).stdout)
        self.assertEqual(known["blades"], told["blades"])
        corners = arrays["vertices"][arrays["faces"]].astype(float)
        area = 0.5 * np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1).sum()
        # The outlines' area on 1 m²; chords of bent blades are shorter than their curves.
        self.assertAlmostEqual(area, known["leaf_area_index"], delta=0.08 * known["leaf_area_index"])
        self.assertGreater(corners[..., 1].min(), -1e-4)
        # Leaves that give more light than they get are rare: dry ones, in red, by a twentieth.
        self.assertLess(known["largest_albedo"], 1.1)
        self.assertLess((arrays["reflected"] + arrays["through"] > 1.0).mean(), 1e-3)
        self.assertEqual(np.ptp(arrays["ground"][:, 1]), 0.0)
        self.assertGreater(len(arrays["ground"]), 3 * 2 * (1 / 0.05) ** 2)

    def test_blades_of_another_field_are_refused(self):
        dump = self.dumped()
        lines = dump.read_text(encoding="ascii").splitlines()
        dump.write_text("\n".join([lines[0], lines[2], lines[1], *lines[3:]]) + "\n", encoding="ascii")
        with self.assertRaisesRegex(ValueError, "not the blades of .*small.sward"):
            field_arrays.arrays_of(self.field, dump)

    def test_noise_is_that_of_the_shaders(self):
        # By hand, at a point of the lattice: its hash alone.
        point = (3 * 0x9e3779b1 + 5 * 0x85ebca77 + 7 * 0xc2b2ae3d) % 2 ** 32
        height = (point ^ point >> 11) * 0x31848bab % 2 ** 32
        with np.errstate(over="ignore"):
            self.assertAlmostEqual(field_arrays.value_noise(np.array([[3.0, 5.0, 7.0]]))[0], height / 2 ** 32, places=6)

    def test_subdivision_keeps_the_area(self):
        soup = field_arrays.subdivided(np.array([[[0.0, 0, 0], [3, 0, 0], [0, 2, 0]]]), 0.3)
        sides = np.linalg.norm(np.roll(soup, -1, axis=1) - soup, axis=2)
        self.assertLessEqual(sides.max(), 0.3)
        self.assertAlmostEqual(0.5 * np.linalg.norm(np.cross(soup[:, 1] - soup[:, 0], soup[:, 2] - soup[:, 0]), axis=1).sum(), 3.0)


class Figures(unittest.TestCase):
    def test_they_are_those_of_each_third(self):
        truth = np.full((30, 8, 3), 0.2)
        mine = truth.copy()
        mine[:10] *= 1.5                 # far
        mine[20:, ::2] *= 0.5            # near: 0.1 and 0.2
        mine[10:20, :, 2] *= 2.0         # middle: blue
        shown = np.ones((30, 8), bool)
        pictures = {light: mine for light in figures.LIGHTS}
        real = {light: truth for light in figures.LIGHTS}
        found = figures.compared(pictures, real, [real, real], shown, flip.PIXELS_PER_DEGREE)["all"]
        self.assertAlmostEqual(found["far"]["ours"]["mean"], 0.3)
        self.assertAlmostEqual(found["near"]["ours"]["mean"], 0.15)
        self.assertAlmostEqual(found["near"]["ours"]["contrast"], 1.0 / 3.0)
        self.assertAlmostEqual(found["middle"]["ours"]["blue_green"], 2.0)
        self.assertAlmostEqual(found["all"]["truth"]["contrast"], 0.0)
        self.assertEqual(found["far"]["noise"], 0.0)
        bounds = {"mean": 0.3, "flip": None}
        missed = figures.missed("p", {"all": found}, bounds)
        self.assertEqual([line.split(":")[0] for line in missed], ["p, all, far"])
        self.assertIn("mean is 1.500 of the truth's; at most 0.3 off", missed[0])

    def test_sky_does_not_count(self):
        truth = np.full((12, 8, 3), 0.2)
        mine = truth.copy()
        mine[:4] = 9.0
        shown = np.ones((12, 8), bool)
        shown[:4] = False
        found = figures.compared({"all": mine}, {"all": truth}, [{"all": truth}] * 2, shown, 67.0)
        self.assertEqual(found["all"]["all"]["flip"], 0.0)
        self.assertEqual(found["all"]["far"]["ours"]["pixels"], 0)
        self.assertEqual(figures.missed("p", found, {"mean": 0.0, "contrast": 0.0, "flip": 0.0}), [])

    def test_noise_is_no_contrast(self):
        random = np.random.default_rng(1)
        even = np.full((90, 160, 3), 0.2)
        even[:, ::2] *= 1.5              # contrast 0.2
        halves = [{"all": even + random.normal(0.0, 0.1, even.shape[:2])[..., None]} for _ in "ab"]
        noisy = {"all": 0.5 * (halves[0]["all"] + halves[1]["all"])}
        shown = np.ones(even.shape[:2], bool)
        found = figures.compared(noisy, noisy, halves, shown, 67.0, halves)["all"]["all"]
        self.assertAlmostEqual(found["truth"]["contrast"], 0.2, delta=0.01)
        self.assertEqual(found["ours"]["contrast"], found["truth"]["contrast"])
        # Of a picture whose samples are not known the noise counts.
        self.assertGreater(figures.compared(noisy, noisy, halves, shown, 67.0)["all"]["all"]["ours"]["contrast"], 0.3)

    def test_a_pixel_is_the_mean_of_its_samples(self):
        samples = np.arange(4 * 6 * 3, dtype=float).reshape(4, 6, 3)
        mean, (white, black) = the_script().reduced(samples, 2)
        np.testing.assert_allclose(mean, samples.reshape(2, 2, 3, 2, 3).mean(axis=(1, 3)))
        np.testing.assert_allclose(white[0, 1], 0.5 * (samples[0, 2] + samples[1, 3]))
        np.testing.assert_allclose(0.5 * (white + black), mean)
        self.assertEqual(the_script().reduced(samples, 1)[1], [])

    def test_cameras_look_at_the_middle_from_their_distance(self):
        for scene in scenes.SCENES.values():
            for distance in scenes.DISTANCES:
                camera = scenes.camera_at(scene, distance)
                ray = np.subtract(camera["target"], camera["eye"])
                self.assertAlmostEqual(float(np.linalg.norm(ray)), distance)
                self.assertLess(ray[2], 0.0)


class Shimmer(unittest.TestCase):
    """scripts/shimmer: second differences along the motion."""

    def setUp(self):
        self.script = the_script("shimmer")
        self.depths = np.linspace(2.0, 1.0, 12)
        self.shifts = 0.5 / self.depths
        x = np.arange(64.0)
        # What stands at a depth moves to the left as the camera goes to the right.
        self.moved = [0.5 + 0.2 * np.sin(0.6 * (x + i * self.shifts[:, None])) for i in range(5)]

    def test_what_moves_with_the_surface_does_not_shimmer(self):
        self.assertLess(self.script.shimmer(self.moved, self.shifts), 1e-3)
        self.assertGreater(self.script.shimmer(self.moved, 0.0 * self.shifts), 3e-3)
        self.assertGreater(self.script.shimmer(self.moved, -self.shifts), 1e-2)

    def test_what_flickers_does(self):
        flicker = [picture + 0.01 * (-1) ** i for i, picture in enumerate(self.moved)]
        self.assertAlmostEqual(self.script.shimmer(flicker, self.shifts), 0.04, delta=1e-3)

    def test_rows_are_as_far_away_as_the_surface(self):
        camera = {"eye": [0.0, 3.2, 4.0], "target": [0.0, 0.2, 0.0], "fov_y_deg": 30.0}
        rows = self.script.depth_of_rows(camera, 0.2, 101)
        self.assertAlmostEqual(rows[50], 5.0)
        self.assertGreater(rows[0], rows[100])


class Command(JudgeTest):
    def test_pictures_are_compared_and_bounds_are_kept(self):
        said, report = self.one("--blender", self.blender, "--size", "64x36", "--supersample", "1", "--segments", "3")
        found = report["pictures"]["small.0.0"]
        for light, wanted in (("sun", 0.2), ("sky", 0.05), ("all", 0.25)):
            self.assertAlmostEqual(found[light]["all"]["truth"]["mean"], wanted, places=5)
            self.assertEqual(found[light]["far"]["truth"]["pixels"], 11 * 64)
            self.assertGreater(found[light]["all"]["ours"]["mean"], 0.01)
            self.assertGreater(found[light]["all"]["flip"], 0.0)
            self.assertLessEqual(found[light]["all"]["flip"], 1.0)
        # The sun and the sky are what the whole is made of.
        ours = {light: found[light]["all"]["ours"]["mean"] for light in found}
        self.assertAlmostEqual(ours["sun"] + ours["sky"], ours["all"], places=6)
        self.assertIn("| small.0.0 | sky |", (self.folder / "out/report.md").read_text(encoding="utf-8"))
        self.assertTrue((self.folder / "out/small.0.0.pair.png").exists())

        # What was traced is there: no Blender is started, until something else is asked for.
        same = ("--size", "64x36", "--supersample", "1", "--segments", "3", "--blender", "false")
        said, report = self.one(*same, "--contrast", "0.1", code=7)
        self.assertIn("contrast is ", said)
        self.assertTrue(report["missed"])
        self.assertEqual(report["pictures"]["small.0.0"], found)
        self.judge(self.field, "--camera", self.camera, "--sun", "135,59", *same, code=4)

        # A page of it, with the figures before.
        needs("pillow")
        page.write(self.folder / "page.md", self.folder / "out", report, [report], {"small.0.0": found})
        text = (self.folder / "page.md").read_text(encoding="utf-8")
        self.assertIn("![small.0.0: ours, the truth, four times the difference](truth/pair-small.jpg)", text)
        self.assertRegex(text, r"\| small\.0\.0 \| (\d\.\d\d) → \1 \|")
        self.assertGreater((self.folder / "truth/pair-small.jpg").stat().st_size, 500)
        self.assertRegex(text, r"64×36 pixels, 64 samples of a pixel by Cycles and 4 of ours, drawn on \w+")
        self.assertIn("Aims and how many of the 1 pictures meet them: luminance within 0.05 in ", text)
        nearer, farther = ({"size": None, "samples": samples, "supersample": 2, "fields": {}, "pictures": {f"lawn.{samples}.high": found}}
                           for samples in (2, 20))
        self.assertEqual(page.described_by_distance([nearer, farther]),
                         "2 m: 2 samples of a pixel by Cycles and 4 of ours;\n20 m: 20 samples of a pixel by Cycles and 4 of ours")

    def test_a_picture_of_others_is_compared(self):
        picture = self.folder / "picture.exr"
        layers = {f"{light}.{letter}": np.full((36, 64), value) for light, value in (("sun", 0.2), ("sky", 0.05)) for letter in "RGB"}
        exr_light.write(picture, layers)
        _, report = self.one("--blender", self.blender, "--size", "64x36", "--picture", picture, "--mean", "1e-5", "--flip", "1e-5", out="other")
        self.assertEqual(report["missed"], [])

    def test_a_direction_is_a_sun_too(self):
        judge = the_script()
        by_angles, by_direction = judge.parsed_sun("90,30"), judge.parsed_sun("1.7320508,1,0")
        np.testing.assert_allclose(by_direction["sun"], by_angles["sun"], atol=1e-6)
        np.testing.assert_allclose(by_direction["sun"], [math.cos(math.radians(30)), 0.5, 0.0], atol=1e-6)
        # The usual sun has the usual colour; a lower one is redder.
        np.testing.assert_allclose(judge.parsed_sun("0.72,0.62,-0.42")["color"], judge.USUAL_COLOR, rtol=1e-6)
        low = judge.parsed_sun("0,10")["color"]
        self.assertGreater(low[0] / low[2], 1.2 * judge.USUAL_COLOR[0] / judge.USUAL_COLOR[2])

    def test_the_film_is_inverted(self):
        judge = the_script()
        radiance = np.linspace(0.0, 3.0, 50)
        np.testing.assert_allclose(judge.unfilmed(judge.filmed(radiance)), radiance, atol=1e-9)

    def test_it_says_what_is_wrong(self):
        for arguments, code, words in (
                ([self.field, "--camera", self.camera, "--sun", "1,2", "--blender", "no-such-program"], 5, "install blender"),
                ([self.field], 1, "a field needs --camera and --sun"),
                (["--scenes", "lawn", "--only", "lawn.2.high,grass.2.high"], 1, "no picture 'grass.2.high' of these"), (["--scenes", "moon"], 1, "'moon' is none of grass"),
                ([self.field, "--camera", self.camera, "--sun", "high"], 1, "neither AZIMUTH,ELEVATION nor x,y,z"),
                ([self.camera, "--camera", self.camera, "--sun", "1,2", "--blender", self.blender], 4, "sward-view fails with code 3")):
            self.assertIn(words, self.judge(*arguments, code=code, out="wrong"))


class LongJudge(JudgeTest):
    def test_cycles_draws_the_same_blades(self):
        needs("blender")
        _, report = self.one("--size", "160x90", "--samples", "32", out="cycles")
        found = report["pictures"]["small.0.0"]
        for light in figures.LIGHTS:
            ratio = found[light]["all"]["ours"]["mean"] / found[light]["all"]["truth"]["mean"]
            self.assertGreater(ratio, 0.5, light)
            self.assertLess(ratio, 1.3, light)
        # The same blades are where they are: pictures of other blades have no correlation.
        picture, *_ = (exr_light.read(self.folder / "cycles" / f"small.0.0.truth.{half}.exr") for half in "ab")
        sky = exr_light.color(picture, "ViewLayer.Combined_sky") @ figures.LUMINANCE
        self.assertGreater(sky.std(), 0.0)
        # Cycles' noise is that of its samples: with 4 times as many it is less.
        _, finer = self.one("--size", "160x90", "--samples", "128", out="cycles")
        self.assertLess(finer["pictures"]["small.0.0"]["all"]["all"]["noise"], 0.8 * found["all"]["all"]["noise"])


if __name__ == "__main__":
    unittest.main()
