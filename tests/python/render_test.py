"""sward.Renderer: the pictures of `sward-view render`, as arrays."""

import json
import os
import signal
import unittest
import warnings

import numpy
import sward

from case import VIEWER, PythonCase, needs

SIZE = (64, 36)
CAMERA = {"eye": [0, 3, 12], "target": [0, 0, 0], "fov_y_deg": 50}


def pixels(path):
    needs("pillow")
    from PIL import Image
    return numpy.asarray(Image.open(path).convert("RGB"))


class Pictures(PythonCase):
    @classmethod
    def setUpClass(cls):
        cls.field = sward.bake("hills", count=2000, meadow="grass")
        cls.renderer = sward.Renderer(cls.field)

    def viewer(self, *options, picture="program.png"):
        path = self.folder / "hills.sward"
        if not path.exists():
            self.field.save(path)
        self.program("render", path, "-o", picture, "--size", "64x36", "--force", *options, program=VIEWER)
        return self.folder / picture

    def test_they_are_the_png_files_of_the_viewer(self):
        (self.folder / "camera.json").write_text(json.dumps(CAMERA), encoding="utf-8")
        picture = self.renderer.render(CAMERA, 0.0, SIZE)
        self.assertEqual((picture.shape, picture.dtype), ((36, 64, 3), numpy.uint8))
        numpy.testing.assert_array_equal(picture, pixels(self.viewer("--camera", "camera.json")))
        numpy.testing.assert_array_equal(self.renderer.render(self.folder / "camera.json", size=SIZE),
                                         self.renderer.render(CAMERA, size=SIZE))

    def test_blades_move_as_in_frames_of_the_viewer(self):
        renderer = sward.Renderer(self.field, wind_strength=8)
        for frame in range(3):
            renderer.advance(frame * 0.25)
        picture = renderer.render("eye", 0.75, SIZE)
        path = self.viewer("--camera", "eye", "--frames", "3:3", "--fixed-dt", "0.25", "--wind-strength", 8)
        numpy.testing.assert_array_equal(picture, pixels(path))
        self.assertFalse((picture == renderer.render("eye", 0.0, SIZE)).all())

    def test_linear_pictures_are_radiance(self):
        picture = self.renderer.render("fit", 0.0, SIZE, dtype=numpy.float32)
        self.assertEqual((picture.shape, picture.dtype), ((36, 64, 3), numpy.float32))
        self.assertTrue(numpy.isfinite(picture).all())
        self.assertTrue((picture == picture.astype(numpy.float16)).all())
        film = self.renderer.render("fit", 0.0, SIZE).mean(axis=2).ravel()
        self.assertGreater(numpy.corrcoef(numpy.sqrt(picture.mean(axis=2).ravel()), film)[0, 1], 0.9)

    def test_layers_say_what_pixels_show(self):
        large = (160, 90)
        renderer = sward.Renderer(self.field, wind_strength=0, samples=1)
        picture = renderer.render(CAMERA, 0.0, large)
        drawn = renderer.render(CAMERA, 0.0, large, layers=["depth", "normal", "id", "class", "species"])
        numpy.testing.assert_array_equal(drawn.pop("color"), picture)
        self.assertEqual({name: (array.shape, array.dtype.name) for name, array in drawn.items()},
                         {"depth": ((90, 160), "float32"), "normal": ((90, 160, 3), "float16"), "id": ((90, 160), "uint64"),
                          "class": ((90, 160), "uint8"), "species": ((90, 160), "uint8")})
        isBlade = drawn["class"] == 2
        self.assertGreater(isBlade.sum(), 20)
        numpy.testing.assert_array_equal(drawn["id"] != 0, isBlade)
        numpy.testing.assert_array_equal(numpy.isfinite(drawn["depth"]), drawn["class"] != 0)
        blades = self.field.blades()
        row_of = {int(name): row for row, name in enumerate(blades["id"])}
        rows = [row_of[int(name) & (2**53 - 1)] for name in drawn["id"][isBlade]]
        numpy.testing.assert_array_equal(drawn["species"][isBlade], blades["species"][rows] + 1)
        far = numpy.linalg.norm(blades["root"][rows] - CAMERA["eye"], axis=1)
        self.assertLess(numpy.abs(far - drawn["depth"][isBlade]).max(), 2 * blades["height"].max())
        lengths = numpy.linalg.norm(drawn["normal"].astype("f4"), axis=2)[drawn["class"] != 0]
        numpy.testing.assert_allclose(lengths, 1.0, atol=0.01)

    def test_flow_is_that_from_the_picture_before(self):
        renderer = sward.Renderer(self.field, wind_strength=0, samples=1)
        moved = {**CAMERA, "eye": [0.2, 3, 12], "target": [0.2, 0, 0]}
        renderer.render(CAMERA, 0.0, SIZE, layers=["flow-backward"])
        still = renderer.render(CAMERA, 0.02, SIZE, layers=["flow-backward", "class"])
        self.assertLess(numpy.nanmax(numpy.abs(still["flow-backward"][still["class"] != 0])), 0.01)
        panned = renderer.render(moved, 0.04, SIZE, layers=["flow-backward", "planar-depth", "class"])
        ground = panned["class"] == 1
        # A camera that goes to the right: what it sees stood farther to the right before, by f·x / depth.
        focal = 0.5 * SIZE[1] / numpy.tan(numpy.radians(25))
        numpy.testing.assert_allclose(panned["flow-backward"][ground][:, 0], 0.2 * focal / panned["planar-depth"][ground], atol=0.02)
        numpy.testing.assert_allclose(panned["flow-backward"][ground][:, 1], 0.0, atol=0.02)
        self.assert_one_past(renderer, moved)
        for wrong, kind in ((["flow-forward"], ValueError), (["colour"], ValueError), ("depth", TypeError), (7, TypeError)):
            with self.assertRaises(kind):
                renderer.render(CAMERA, size=SIZE, layers=wrong)
        self.assertEqual(len(renderer.render(CAMERA, size=SIZE, layers="all")), 13)

    def assert_one_past(self, renderer, moved):
        """Flow is that from the moment before, whatever kind of picture showed it."""
        def flows(kinds):  # time falls at the first picture: blades settle
            drawn = [renderer.render(camera, time, SIZE, layers=["flow-backward"], dtype=kind, settings={"wind": [{"strength": 3}]})
                     for camera, time, kind in kinds]
            return [one["flow-backward"] for one in drawn[-2:]]
        film, linear = "uint8", "float32"
        expected = flows([(CAMERA, 0, film), (moved, 0.02, film), (CAMERA, 0.03, film)])
        self.assertGreater(numpy.nanmax(numpy.abs(expected[0])), 0.2)
        found = [*flows([(CAMERA, 0, film), (moved, 0.02, linear), (CAMERA, 0.03, film)]),
                 *flows([(CAMERA, 0, linear), (moved, 0.02, film), (CAMERA, 0.03, linear)]),
                 # Both kinds of one moment:
                 *flows([(CAMERA, 0, film), (CAMERA, 0, linear), (moved, 0.02, linear), (moved, 0.02, film)])]
        for flow, right in zip(found, [*expected, *expected, *[expected[0]] * 2]):
            numpy.testing.assert_allclose(flow, right, atol=0.01)

    def test_fields_are_drawn_together(self):
        fields = [sward.bake(numpy.full((5, 5), height), extent=(side, side), count=3000, meadow="grass", seed=seed)
                  for height, side, seed in ((0.0, 2, 1), (0.1, 1, 2))]
        path = self.folder / "above.sward"
        fields[1].save(path)
        ids = sward.Renderer([fields[0], path], samples=1).render({"eye": [0, 0.4, 1.2], "target": [0, 0.1, 0]},
                                                                       size=(160, 90), layers=["id"])["id"]
        for number, field in enumerate(fields):
            shown = ids[ids >> 53 == number + 1] & (2**53 - 1)
            self.assertGreater(len(shown), 5)
            self.assertTrue(numpy.isin(shown, field.blades()["id"]).all())

    def test_warnings_of_settings_are_warnings(self):
        odd = {"detail": {"least_width": 1}}
        with self.assertWarnsRegex(sward.Warning, "settings: .*least_width"):
            self.renderer.render(size=SIZE, settings=odd)
        with self.assertWarnsRegex(sward.Warning, "settings: .*least_width"):
            sward.Renderer(self.field, settings=odd)

    def test_settings_of_one_picture_change_no_other(self):
        still = self.renderer.render("top", 0.0, SIZE)
        for settings in ({"look": {"sun": {"elevation": 8}}},
                         {"colliders": [{"centre": [0, 1, 0], "radius": 3}]}):
            self.assertFalse((still == self.renderer.render("top", 0.0, SIZE, settings=settings)).all(), settings)
        numpy.testing.assert_array_equal(self.renderer.render("top", 0.0, SIZE), still)

    def test_sizes_change_on_the_open_device(self):
        for size in ((16, 16), (40, 20), (16, 16)):
            self.assertEqual(self.renderer.render("fit", size=size).shape, (size[1], size[0], 3))


class Refused(PythonCase):
    @classmethod
    def setUpClass(cls):
        cls.field = sward.bake("plane", count=100)
        cls.renderer = sward.Renderer(cls.field)

    def test_what_is_no_camera_size_time_or_option(self):
        render = self.renderer.render
        with self.assertRaisesRegex(sward.Error, "'fitt' is not fit, eye, top or edge"):
            render("fitt")
        with self.assertRaisesRegex(sward.Error, "camera: target"):
            render({"eye": [0, 1, 2]})
        with self.assertRaisesRegex(TypeError, "camera is a name"):
            render(3)
        with self.assertRaisesRegex(ValueError, "size is 0x36"):
            render(size=(0, 36))
        with self.assertRaisesRegex(TypeError, "size is"):
            render(size=64)
        with self.assertRaisesRegex(sward.Error, r"the time of a frame is nan s, beyond ±\d+ s"):
            render(time=float("nan"))
        with self.assertRaisesRegex(TypeError, "time is 'x'; a number"):
            render(time="x")
        with self.assertRaisesRegex(ValueError, r"camera: eye\[0\]: nan; all numbers must be finite"):
            render({"eye": numpy.array([numpy.nan, 0, 0]), "target": [0, 0, 0]})
        with self.assertRaisesRegex(ValueError, "settings: look: sun: elevation: inf; all"):
            render(settings={"look": {"sun": {"elevation": numpy.float32("inf")}}})
        with self.assertRaisesRegex(TypeError, "settings of a picture are a dict"):
            render(settings="settings.json")
        with self.assertRaisesRegex(sward.Error, "geometry tessellation is asked for"):
            sward.Renderer(self.field, geometry="tessellation").render(size=SIZE, layers=["id"])
        with self.assertRaisesRegex(TypeError, "neither uint8 nor float32"):
            render(dtype=numpy.float64)
        with self.assertRaisesRegex(sward.Error, "settings: "):
            render(settings={"wimd": 1})
        with self.assertRaisesRegex(sward.Error, "--collider"):
            sward.Renderer(self.field, collider=["cube:1"])
        with self.assertRaisesRegex(TypeError, "did you mean 'samples'"):
            sward.Renderer(self.field, sample=4)
        with self.assertRaisesRegex(sward.Error, "--samples: '3' is not 1 or 4"):
            sward.Renderer(self.field, samples=3)
        with self.assertRaisesRegex(ValueError, "empty list"):
            sward.Renderer([])

    def test_a_forked_process_is_told(self):
        child = os.fork()
        if child == 0:
            signal.alarm(20)
            try:
                self.renderer.render(size=SIZE)
            except sward.Error as error:
                os._exit(error.exit_code if "spawn" in str(error) else 1)
            os._exit(1)
        self.assertEqual(os.waitpid(child, 0)[1], 5 << 8)

    def test_layers_of_no_name_are_a_dict(self):
        self.assertEqual(list(self.renderer.render(size=SIZE, layers=[])), ["color"])


class LongSeeds(PythonCase):
    def test_a_field_with_seeds_is_sown(self):
        field = sward.bake("hills", seeds="always", budget=2000, density=3)
        path = self.folder / "seeds.sward"
        field.save(path)
        self.program("render", path, "-o", "seeds.png", "--size", "64x36", "--camera", "eye", program=VIEWER)
        numpy.testing.assert_array_equal(sward.Renderer(field).render("eye", size=SIZE), pixels(self.folder / "seeds.png"))


if __name__ == "__main__":
    unittest.main()
