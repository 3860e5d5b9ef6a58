"""The hosts in examples/, built against the installed package: what they draw, without a message of
the validation layer."""

import math
import re
import unittest

from package_test import BUILD, COMPILER, ExampleTest, GuestTest, PREFIX, ROOT, needs


class EmbedTest(ExampleTest):
    """examples/embed: a host with a Vulkan of its own."""

    soil = (30, 90, 320, 230)

    def field(self):
        return self.bake("--count", 30000, "--blade-scale", 2.5, "--force")

    def assert_looks_as_accepted(self, picture):
        """Half as large, tile by tile as the golden picture: single blades are the affair of other
        tests. `scripts/accept-golden embed` takes the new one over."""
        from PIL import Image
        drawn = BUILD / "golden/embed/actual.png"
        drawn.parent.mkdir(parents=True, exist_ok=True)
        picture.resize((320, 180), Image.BOX).save(drawn)
        golden = Image.open(ROOT / "tests/golden/images/embed.png").convert("RGB")
        tiles = [list(image.resize((16, 9), Image.BOX).getdata())
                 for image in (golden, Image.open(drawn))]
        worst = max(abs(a - b) for one, other in zip(*tiles) for a, b in zip(one, other))
        self.assertLessEqual(worst, 10, f"of 255, see {drawn}")

    def picture_of(self, field, *options):
        self.assertRegex(self.run_example(field, "SYNCHRONIZATION_VALIDATION", *options),
                         r"^llvmpipe.* drew \d+ blades\n$")
        picture = self.picture()
        self.assertEqual(picture.size, (640, 360))
        return picture

    def assert_alike(self, picture, other):
        """But for single pixels where two depths are nearly one."""
        from PIL import ImageChops
        difference = ImageChops.difference(picture, other).convert("L").histogram()
        self.assertLess(sum(difference[8:]), 0.005 * 640 * 360)


class LongEmbed(EmbedTest):
    """Six pictures of 640×360 that are alike."""

    def test_embed_draws_the_same_in_any_way(self):
        needs("pillow")
        self.build_example("embed")
        field = self.field()
        picture = self.picture_of(field)
        # Whatever the depth's convention, the scope and the way to draw, the picture is the same.
        for options in (["forward"], ["render-pass"], ["forward", "render-pass"],
                        ["raster"], ["raster", "forward", "render-pass"]):
            with self.subTest(options=options):
                self.assert_alike(self.picture_of(field, *options), picture)


class Embed(EmbedTest):
    def test_embed_draws_on_its_own_device_without_a_validation_message(self):
        needs("pillow")
        self.build_example("embed")
        field = self.field()
        picture = self.picture_of(field)
        self.assert_looks_as_accepted(picture)

        # Background sky; a post in front of some grass and behind other grass.
        red, _, blue = picture.getpixel((320, 20))
        self.assertGreater(blue, red)
        self.assertGreater(self.green_share(picture, self.soil), 0.2)

        # All that is not the default at once.
        self.assert_alike(self.picture_of(field, "raster", "forward", "render-pass"), picture)

        # The layer has listened: it has much to say when asked for advice. Without blades the boxes
        # are bare: what was green before was grass.
        bald = self.bake("--count", 0, "--force")
        self.assertIn("BestPractices", self.run_example(bald, "BEST_PRACTICES"))
        self.assertLess(self.green_share(self.picture(), self.soil), 0.02)


class Sources(GuestTest):
    """The other examples are built and run by long tests."""

    def test_embed_msaa_and_embed_paint_fit_the_installed_headers(self):
        flags = self.run_here("pkg-config", "--cflags", "sward-bake", "sward-render",
                              PKG_CONFIG_PATH=str(PREFIX / "lib/pkgconfig")).split()
        (self.folder / "shaders").mkdir()
        for example in ("embed_msaa", "embed_paint"):
            for stage in ("vert", "frag"):
                self.run_here("glslangValidator", "-V", "--quiet", "--vn", f"box{stage.title()}", "-o",
                              f"shaders/box.{stage}.h", ROOT / "examples" / example / f"box.{stage}")
            self.run_here(COMPILER, "-std=c++20", "-fsyntax-only", "-Wall", "-Werror", "-I.", *flags,
                          ROOT / "examples" / example / "main.cpp")


class EmbedMsaaTest(ExampleTest):
    """examples/embed_msaa: two views, four samples, a render pass, forward Z, a budget."""

    halves = ((0, 96, 256, 288), (256, 96, 512, 288))

    def picture_and_pages(self, field, *options):
        """The picture, and by their names the numbers that the host prints of streaming."""
        said = self.run_example(field, "SYNCHRONIZATION_VALIDATION", *options)
        number = r"(\d+(?:\.\d+)?)"
        found = re.fullmatch(
            rf"llvmpipe.* drew \d+ and \d+ blades\n{number} pages, {number} fit, {number} resident, "
            rf"{number} wanted, {number} missing, thinning {number}, (settled|not settled)\n", said)
        self.assertIsNotNone(found, said)
        names = ("pages", "fit", "resident", "wanted", "missing", "thinning")
        picture = self.picture()
        self.assertEqual(picture.size, (512, 288))
        return picture, dict(zip(names, map(float, found.groups()))) | {"settled": found[7] == "settled"}

    @staticmethod
    def decibels(picture, other):
        """Their peak signal-to-noise ratio."""
        from PIL import ImageChops, ImageStat
        squares = ImageStat.Stat(ImageChops.difference(picture, other)).sum2
        mean = sum(squares) / (3 * picture.size[0] * picture.size[1])
        return 10 * math.log10(255 ** 2 / max(mean, 1e-9))


class LongEmbedMsaa(EmbedMsaaTest):
    """A minute of pictures: each run draws two views 36 times."""

    def test_embed_msaa_streams_for_two_views_without_a_validation_message(self):
        needs("pillow")
        self.build_example("embed_msaa")
        field = self.bake("--count", 120000, "--blade-scale", 1.5, "--force")
        whole, pages = self.picture_and_pages(field)
        self.assertEqual(pages["pages"], 0, "without a budget nothing streams")
        for half in self.halves:
            self.assertGreater(self.green_share(whole, half), 0.5)

        # Half of the field fits, and all that is seen at the end. Blades that were missing on the way
        # have another past, so that they do not bend quite alike.
        within, pages = self.picture_and_pages(field, "--budget", 4)
        self.assertLess(pages["fit"], 0.7 * pages["pages"])
        self.assertLess(pages["wanted"], pages["resident"] + 1)
        self.assertEqual((pages["missing"], pages["thinning"], pages["settled"]), (0, 1, True))
        self.assertGreater(self.decibels(whole, within), 33)
        for half in self.halves:
            self.assertGreater(self.green_share(within, half), 0.4)

        # What is seen does not fit: fewer blades, which are wider, in both views.
        thin, pages = self.picture_and_pages(field, "--budget", 2)
        self.assertGreater(pages["missing"], 0)
        self.assertGreater(pages["thinning"], 2)
        self.assertLess(self.decibels(whole, thin), 28)
        for half in self.halves:
            self.assertGreater(self.green_share(thin, half), 0.4)

        # Neither the convention of depth nor the way to draw changes the picture.
        self.assertGreater(self.decibels(whole, self.picture_and_pages(field, "--reversed")[0]), 45)
        rastered, _ = self.picture_and_pages(field, "--raster", "--budget", 4)
        self.assertGreater(self.decibels(within, rastered), 36)

        # Without blades the ground is bare, and the layer has listened (see Embed).
        bald = self.bake("--count", 0, "--force")
        self.assertIn("BestPractices", self.run_example(bald, "BEST_PRACTICES", "--raster"))
        for half in self.halves:
            self.assertLess(self.green_share(self.picture(), half), 0.02)


class LongEmbedPaint(ExampleTest):
    """examples/embed_paint: a bake that stays open, and grass that is edited while it is drawn, in many frames."""

    burned = (455, 62, 490, 82)
    track = (180, 270, 240, 320)
    meadow = (400, 200, 460, 250)

    def test_embed_paint_changes_and_takes_back_without_a_validation_message(self):
        needs("pillow")
        from PIL import Image, ImageChops, ImageStat
        self.build_example("embed_paint", bakes=True)
        said = self.run_example("painted.png", "SYNCHRONIZATION_VALIDATION")
        found = re.fullmatch(r"llvmpipe.* drew (\d+) and (\d+) blades; 11 edits baked (\d+) cells again\n", said)
        self.assertIsNotNone(found, said)
        few, many, cells = map(int, found.groups())
        self.assertLess(few, many)
        self.assertLess(cells, 11 * 16, "an edit bakes some cells, not all")
        painted = Image.open(self.folder / "painted.png").convert("RGB")
        undone = self.picture()

        def brightness(picture, box):
            return sum(ImageStat.Stat(picture.crop(box)).mean)

        def change(box):
            return sum(ImageStat.Stat(ImageChops.difference(painted.crop(box), undone.crop(box))).mean)
        # Where nothing is painted the wind alone changes the grass. Trodden grass is as bright as the shaded grass that
        # stood there, but looks otherwise.
        share = {name: brightness(painted, box) / brightness(undone, box) for name, box in
                 (("burned", self.burned), ("meadow", self.meadow))}
        self.assertLess(share["burned"], 0.6)
        self.assertGreater(change(self.track), 2 * change(self.meadow))
        self.assertAlmostEqual(share["meadow"], 1.0, delta=0.03)


if __name__ == "__main__":
    unittest.main()
