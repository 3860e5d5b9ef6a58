"""`sward trace`: paths of light over a field, as a picture."""

import math
import struct
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from exr import read_exr
from support import CliTest, INPUT, IO, USAGE, digest

SMALL = ("--size", "32x18", "--samples", "4")
VIEW = ("--eye", "0,1.5,4", "--target", "0,0,0", "--fov", "30")
LAYERS = {"albedo": "RGB", "normal": "XYZ", "depth": "Z", "direct": "RGB", "indirect": "RGB",
          "visibility": "Y", "sun": "RGB", "sky": "RGB"}


class Trace(CliTest):
    def setUp(self):
        super().setUp()
        self.bake("plane", "--scale", "0.2", "--count", "4000", "--meadow", "grass", "--blade-scale", "1",
                  to="f.sward")

    def trace(self, *options, to="p.exr", **how):
        self.sward("trace", "f.sward", "-o", to, *SMALL, *options, "--force", **how)
        return self.folder / to

    def pixels(self, *options):
        return read_exr(self.trace(*options))[1]

    def mean(self, values):
        return sum(values) / len(values)

    def test_an_exr_holds_linear_light_and_the_layers_that_are_asked_for(self):
        size, channels = read_exr(self.trace(*VIEW))
        self.assertEqual(size, (32, 18))
        self.assertEqual(set(channels), {"R", "G", "B"})
        _, channels = read_exr(self.trace(*VIEW, "--layers", "all"))
        names = {f"{layer}.{letter}" for layer, letters in LAYERS.items() for letter in letters}
        self.assertEqual(set(channels), {"R", "G", "B", "blade.id"} | names)
        for i in range(32 * 18):
            for letter in "RGB":
                light = channels[letter][i]
                self.assertAlmostEqual(channels[f"sun.{letter}"][i] + channels[f"sky.{letter}"][i], light, 4)
                self.assertAlmostEqual(channels[f"direct.{letter}"][i] + channels[f"indirect.{letter}"][i], light, 4)
            seen = channels["blade.id"][i] > 0
            self.assertEqual(math.isfinite(channels["depth.Z"][i]), seen)
        # Blades are numbered from 2 in the order of the export.
        rows = self.blades(self.folder / "f.sward")
        numbers = [number for number in channels["blade.id"] if number >= 2]
        self.assertGreater(len(numbers), 20)
        self.assertLess(max(numbers), len(rows) + 2)
        middle = channels["blade.id"].index(numbers[len(numbers) // 2])
        x, _, z = rows[channels["blade.id"][middle] - 2].root
        eye, depth = (0.0, 1.5, 4.0), channels["depth.Z"][middle]
        self.assertLess(abs(math.dist((x, 0, z), eye) - depth), 1.0)

    def test_bare_ground_has_the_radiance_of_the_formula(self):
        # White lacks texture: albedo times (cosine of the sun times its colour + 1.25 times the sky's).
        self.bake("plane", "--scale", "0.2", "--count", "0", "--force", to="f.sward")
        channels = self.pixels("--eye", "0,1,0", "--target", "0,0,0", "--up", "0,0,-1", "--fov", "20",
                               "--sun", "0,2,0", "--sun-color", "1,2,3", "--sky-color", "0.4,0,0.8",
                               "--layers", "albedo,sun,direct")
        self.assertEqual(set(channels["sun.R"]) - {0.0}, set(channels["sun.R"]))
        for letter, light in (("R", 1 + 1.25 * 0.4), ("G", 2.0), ("B", 3 + 1.25 * 0.8)):
            for albedo, radiance in zip(channels[f"albedo.{letter}"], channels[letter]):
                self.assertAlmostEqual(radiance, albedo * light, delta=2e-4 * max(light, 1))

    def test_the_picture_depends_on_the_seed_and_not_on_threads(self):
        one = digest(self.trace(*VIEW, "--threads", "1", "--layers", "all", to="a.exr"))
        self.assertEqual(one, digest(self.trace(*VIEW, "--threads", "2", "--layers", "all", to="b.exr")))
        self.assertEqual(one, digest(self.trace(*VIEW, "--progressive", "--layers", "all", to="c.exr")))
        self.assertNotEqual(one, digest(self.trace(*VIEW, "--seed", "7", "--layers", "all", to="d.exr")))

    def test_light_can_be_switched_off_in_parts(self):
        dark = self.pixels(*VIEW, "--sun-color", "0,0,0", "--sky-color", "0,0,0", "--ground-color", "0,0,0")
        self.assertEqual(max(map(max, dark.values())), 0.0)
        usual = self.mean(self.pixels(*VIEW)["G"])
        for less in (("--bounces", "0"), ("--translucency", "0"), ("--sun-color", "0,0,0")):
            self.assertLess(self.mean(self.pixels(*VIEW, *less)["G"]), usual, less)

    def test_a_png_is_developed_and_brighter_with_more_exposure(self):
        sizes = []
        for exposure in ((), ("--exposure", "0.0001")):
            data = self.trace(*VIEW, *exposure, to="p.png").read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(struct.unpack(">II", data[16:24]), (32, 18))
            sizes.append(len(data))
        self.assertGreater(sizes[0], 2 * sizes[1])  # black packs well

    def test_cameras_by_name_and_file_differ(self):
        self.write_json("c.json", {"eye": [0, 1.5, 4], "target": [0, 0, 0], "fov_y_deg": 30})
        self.assertEqual(digest(self.trace("--camera", "c.json", to="a.exr")),
                         digest(self.trace(*VIEW, to="b.exr")))
        self.assertEqual(len({digest(self.trace("--camera", name, to="a.exr"))
                              for name in ("fit", "eye", "top", "c.json")}), 4)

    def test_blades_of_a_dump_stand_as_it_says(self):
        rows = ["id,x,y,z,v1x,v1y,v1z,v2x,v2y,v2z,ux,uy,uz,eta,lod_width,cull_result"]
        for blade in self.blades(self.folder / "f.sward"):
            x, y, z = blade.root
            h = blade.height
            place = f"{blade.id},{x},{y},{z},{x},{y + 0.5 * h},{z},{x},{y + h},{z}"
            rows.append(f"{place},0,1,0,0,1,drawn")
        (self.folder / "d.csv").write_text("\n".join(rows) + "\n")
        top = ("--eye", "0,4,0", "--target", "0,0,0", "--up", "0,0,-1", "--fov", "20", "--layers", "blade")
        resting = self.pixels(*top)["blade.id"]
        upright = self.pixels(*top, "--blades", "d.csv")["blade.id"]
        # Upright blades hide hardly any ground from an eye above.
        hidden = [sum(number > 1 for number in picture) for picture in (resting, upright)]
        self.assertGreater(2 * hidden[0], 3 * hidden[1])
        (self.folder / "d.csv").write_text("\n".join(rows[:-1]) + "\n")
        self.refused("trace", "f.sward", "-o", "q.exr", "--blades", "d.csv", code=INPUT, names=["d.csv", "3999"])
        self.refused("trace", "f.sward", "-o", "q.exr", "--blades", "no.csv", code=IO, names=["no.csv"])

    def test_wrong_values_are_refused_before_any_work(self):
        for options, names in (
                (("--size", "0x9"), ["--size", "0x9"]),
                (("--size", "99999x9"), ["--size", "16384"]),
                (("--size", "16384x16384"), ["--size", "67108864"]),
                (("--samples", "0"), ["--samples", "from 1 to"]),
                (("--samples", "-3"), ["--samples", "-3"]),
                (("--bounces", "1001"), ["--bounces", "1000"]),
                (("--seed", "-1"), ["--seed", "-1"]),
                (("--layers", "albedo,deep"), ["--layers", "'deep'", "depth"]),
                (("--eye", "nan,0,0", "--target", "0,0,0"), ["--eye", "nan"]),
                (("--eye", "1,2", "--target", "0,0,0"), ["--eye", "1,2"]),
                (("--eye", "1,2,3"), ["--eye", "--target"]),
                (("--eye", "1,2,3", "--target", "0,0,0", "--camera", "fit"), ["--eye", "--camera"]),
                (("--eye", "1,2,3", "--target", "1,2,3"), ["target", "eye"]),
                (("--eye", "0,2,0", "--target", "0,0,0"), ["up-vector"]),
                (("--camera", "eya"), ["--camera", "eya"]),
                (("--fov", "0"), ["--fov", "0.01"]),
                (("--sun", "0,0,0"), ["--sun"]),
                (("--sun-color", "1,-1,1"), ["--sun-color", "-1"]),
                (("--gloss", "2"), ["--gloss", "2"]),
                (("--exposure", "2"), ["--exposure", ".png"]),
                (("--threads", "1025"), ["--threads"])):
            with self.subTest(options=options):
                self.refused("trace", "f.sward", "-o", "q.exr", *options, code=USAGE, names=names)
        self.refused("trace", "f.sward", "-o", "q.png", "--layers", "all", code=USAGE, names=["--layers", ".exr"])
        self.refused("trace", "f.sward", "-o", "q.jpg", code=USAGE, names=["q.jpg", ".exr"])
        self.refused("trace", "f.sward", code=USAGE, names=["--output"])

    def test_files_that_are_wrong_are_named(self):
        self.refused("trace", "no.sward", "-o", "q.exr", code=IO, names=["no.sward"])
        self.refused("trace", "f.sward", "-o", "no/q.exr", code=IO, names=["no/q.exr"])
        self.refused("trace", "f.sward", "-o", "/proc/q.exr", code=IO, names=["/proc/q.exr"])
        self.refused("trace", "f.sward", "-o", "f.sward", "--force", code=USAGE, names=["f.sward"])
        (self.folder / "p.exr").write_text("precious")
        self.refused("trace", "f.sward", "-o", "p.exr", code=IO, names=["p.exr", "--force"])
        self.assertEqual((self.folder / "p.exr").read_text(), "precious")
        whole = (self.folder / "f.sward").read_bytes()
        (self.folder / "cut.sward").write_bytes(whole[:len(whole) // 2])
        self.refused("trace", "cut.sward", "-o", "q.exr", code=INPUT, names=["cut.sward"])
        for text, word in (('{"eye": [0, 1, 2]}', "target"), ('{"eye": [0, 1, null], "target": [0, 0, 0]}', "eye"),
                           ('{"eye": [0, 1, 2], "target": [0, 0, 0], "fov": 3}', "fov"), ("{", "c.json")):
            (self.folder / "c.json").write_text(text)
            self.refused("trace", "f.sward", "-o", "q.exr", "--camera", "c.json", code=INPUT, names=["c.json", word])

    def test_a_field_without_anything_shows_its_sky(self):
        self.bake("plane", "--scale", "0.2", "--count", "0", "--force", to="f.sward")
        channels = self.pixels("--eye", "0,1,0", "--target", "0,2,1", "--sun-color", "0,0,0", "--fov", "20")
        self.assertAlmostEqual(min(channels["B"]), 1.25 * 0.92, 5)


class Cycles(CliTest):
    """Numbers that Blender's Cycles 3.4.1 has found on the same blades: 8 bounces, 36 to 64 samples; sure to 3 %."""

    SUNS = (  # direction, colour; share of the sun that what is seen gets, blue relative to green
        ("0.353553,0.866025,0.353553", "3.544,3.06459,2.40309", 0.70, 0.117),
        ("0,0.258819,-0.965926", "2.86493,2.11206,1.20374", 0.34, 0.110))
    SKY, SKY_WITHOUT_TRANSLUCENCY = 0.096, 0.068  # luminance of the light from the sky

    def trace(self, *options):
        self.sward("trace", "f.sward", "-o", "p.exr", "--force", "--size", "160x90", "--samples", "8", "--gloss", "0",
                   "--eye", "0,1.6,3.9", "--target", "0,1.09486,2.9", "--fov", "24",
                   "--layers", "sky,visibility,blade", *options)
        return read_exr(self.folder / "p.exr")[1]

    def test_the_light_in_a_meadow_is_what_another_tracer_finds(self):
        self.bake("plane", "--scale", "0.4", "--meadow", "grass", "--blade-scale", "1", "--set", "wide_variation=0",
                  to="f.sward")
        for direction, color, share, blue in self.SUNS:
            with self.subTest(sun=direction):
                light = self.trace("--sun", direction, "--sun-color", color)
                seen = [y for y, blade in zip(light["visibility.Y"], light["blade.id"]) if blade >= 2]
                self.assertAlmostEqual(sum(seen) / len(seen), share, delta=0.015)
                self.assertAlmostEqual(sum(light["B"]) / sum(light["G"]), blue, delta=0.003)
                self.assertAlmostEqual(self.sky_of(light) / self.SKY, 1.0, delta=0.03)
        dark = self.trace("--sun-color", "0,0,0", "--translucency", "0")
        self.assertAlmostEqual(self.sky_of(dark) / self.SKY_WITHOUT_TRANSLUCENCY, 1.0, delta=0.03)

    def sky_of(self, light):
        return sum(weight * sum(light[f"sky.{letter}"]) / len(light["R"])
                   for letter, weight in zip("RGB", (0.2126, 0.7152, 0.0722)))


if __name__ == "__main__":
    unittest.main()
