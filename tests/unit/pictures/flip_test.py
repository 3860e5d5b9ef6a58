"""scripts/flip.py against cases computed by hand, and its invariants. docs/algorithms/truth.md"""

import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "scripts"))
import exr_light  # noqa: E402
import flip  # noqa: E402
import light_pictures  # noqa: E402


def even(*color, size=40):
    return np.broadcast_to(np.array(color, float), (size, size, 3))


def noise(seed, size=64):
    return np.random.default_rng(seed).random((size, size, 3))


def step(place, low=0.1, high=0.6, size=64):
    """Dark left of the column `place`, bright from there on."""
    picture = np.full((size, size, 3), low)
    picture[:, place:] = high
    return picture


class EvenPictures(unittest.TestCase):
    """Without features FLIP is the colour error alone, and filters change nothing."""

    def expect(self, a, b, wanted):
        error = flip.flip(even(*a), even(*b))
        np.testing.assert_allclose(error, wanted, atol=2e-5)

    def test_equal_pictures_have_no_error(self):
        self.expect((0.3, 0.2, 0.7), (0.3, 0.2, 0.7), 0.0)
        self.assertEqual(flip.flip(noise(1), noise(1)).max(), 0.0)

    def test_two_greys(self):
        # L* = 116 ∛0.2 − 16 = 51.8372 and 116 ∛0.3 − 16 = 61.6542; 9.8170^0.7 = 4.94804; the knee is at 0.4 · 41.2755 =
        # 16.5102, so 0.95 / 16.5102 · 4.94804 = 0.28471, below it.
        self.expect((0.2, 0.2, 0.2), (0.3, 0.3, 0.3), 0.95 / 16.51019 * 9.81698 ** 0.7)
        self.expect((0.2, 0.2, 0.2), (0.3, 0.3, 0.3), 0.28468)

    def test_black_and_white(self):
        # ΔL* = 100: 100^0.7 = 25.1189, above the knee: 0.95 + 0.05 · (25.1189 − 16.5102) / (41.2755 − 16.5102).
        self.expect((0, 0, 0), (1, 1, 1), 0.96738)

    def test_green_and_blue_differ_most(self):
        self.expect((0, 1, 0), (0, 0, 1), 1.0)
        # By hand: green L* 87.735, a* −86.183, b* 83.179; blue 32.297, 79.188, −107.860; a* and b* times 0.01 L*:
        # −75.613, 72.977 and 25.575, −34.836; HyAB = 55.438 + √(101.188² + 107.813²) = 203.299; to the power 0.7.
        self.assertAlmostEqual(flip.largest_color_error(), 203.299 ** 0.7, delta=2e-3)

    def test_colour_counts_less_in_the_dark(self):
        # The Hunt effect: the same distance in a* at a tenth of the lightness.
        dark, bright = flip.hunted(np.array([[10.0, 20.0, 0.0], [100.0, 20.0, 0.0]]))
        self.assertAlmostEqual(dark[1], 2.0)
        self.assertAlmostEqual(bright[1], 20.0)

    def test_light_beyond_the_screen_is_cut_off(self):
        self.expect((1, 1, 1), (7, 7, 7), 0.0)


class Features(unittest.TestCase):
    def test_an_edge_is_as_strong_as_its_step(self):
        edges, points = flip.features(step(30)[..., 1], flip.PIXELS_PER_DEGREE)
        # Beside the step all weights of one sign see the bright side: they sum to 1.
        self.assertAlmostEqual(edges[32, 30], 0.5, places=12)
        self.assertLess(np.abs(edges[:, :15]).max(), 1e-12)
        self.assertLess(np.abs(points[:, 50:]).max(), 1e-12)

    def test_a_shifted_edge_shows_beside_it_and_nowhere_else(self):
        error = flip.flip(step(30), step(31))
        farther = flip.flip(step(30), step(34))
        self.assertEqual(error[:, :8].max(), 0.0)
        self.assertEqual(error[:, 53:].max(), 0.0)
        self.assertGreater(error[32, 30], 0.1)
        self.assertGreater(farther.mean(), 1.5 * error.mean())
        # Rows are alike, as the pictures' rows are.
        self.assertLess(np.ptp(error, axis=0).max(), 1e-12)

    def test_a_line_is_a_point_and_no_edge(self):
        # σ = 0.5 · 0.082 · 67 = 2.747; (x²/σ² − 1)·exp(−x²/2σ²) is −1 at 0, −0.8119 at ±1, −0.3605 at ±2 and positive farther
        # away: the weight at 0 is −1/3.3448.
        line = np.full((64, 64), 0.25)
        line[:, 30] = 0.75
        edges, points = flip.features(line, flip.PIXELS_PER_DEGREE)
        self.assertAlmostEqual(points[32, 30], 0.5 / 3.3448, delta=2e-5)
        self.assertAlmostEqual(edges[32, 30], 0.0, places=12)
        picture = np.repeat(line[..., None], 3, axis=2)
        error = flip.feature_error(picture, np.full((64, 64, 3), 0.25), flip.PIXELS_PER_DEGREE)
        self.assertAlmostEqual(error[32, 30], math.sqrt(0.5 / 3.3448 / math.sqrt(2.0)), delta=2e-5)

    def test_features_only_add(self):
        a, b = step(30), step(31)
        color = flip.color_error(a, b, flip.PIXELS_PER_DEGREE)
        self.assertTrue((flip.flip(a, b) >= color - 1e-15).all())

    def test_the_error_is_the_colour_error_to_one_less_the_feature_error(self):
        a, b = noise(1), 0.5 * noise(1) + 0.5 * noise(2)
        wanted = flip.color_error(a, b, 67.0) ** (1.0 - flip.feature_error(a, b, 67.0))
        np.testing.assert_allclose(flip.flip(a, b), wanted)


class Invariants(unittest.TestCase):
    def test_it_grows_with_the_error(self):
        for other in (even(0.9, 0.5, 0.1, size=64), noise(3)):
            errors = [flip.flip(noise(1), (1 - share) * noise(1) + share * other).mean() for share in np.linspace(0, 1, 8)]
            self.assertEqual(errors, sorted(errors))
            self.assertEqual(errors[0], 0.0)

    def test_it_is_symmetric_and_within_zero_and_one(self):
        for a, b in ((noise(1), noise(2)), (step(20), noise(4)), (even(1, 0, 0, size=64), noise(5))):
            there, back = flip.flip(a, b), flip.flip(b, a)
            np.testing.assert_allclose(there, back, atol=1e-12)
            self.assertGreaterEqual(there.min(), 0.0)
            self.assertLessEqual(there.max(), 1.0)

    def test_it_turns_and_mirrors_with_the_pictures(self):
        there = flip.flip(noise(1), noise(2))
        np.testing.assert_allclose(flip.flip(noise(1)[:, ::-1], noise(2)[:, ::-1]), there[:, ::-1], atol=1e-12)
        turned = flip.flip(np.swapaxes(noise(1), 0, 1), np.swapaxes(noise(2), 0, 1))
        np.testing.assert_allclose(turned, there.T, atol=1e-12)

    def test_what_no_eye_resolves_is_no_error(self):
        fine = (np.indices((64, 64)).sum(axis=0) % 2)[..., None] * 0.4 + np.full((1, 1, 3), 0.3)
        # Within the filters' reach of the rim, which continues, the pattern is another one.
        near, far = (flip.color_error(fine, even(0.5, 0.5, 0.5, size=64), ppd)[20:-20, 20:-20].mean() for ppd in (10.0, 120.0))
        self.assertLess(far, 1e-4)
        self.assertGreater(near, 1000 * far)

    def test_gratings_fade_as_contrast_sensitivity_does(self):
        # 16 pixels a period: 67/16 = 4.1875 cycles per degree. exp(−0.0047 · 17.535) and exp(−0.0053 · 17.535). In the plane
        # a·√(π/b)·exp(−π² r²/b) has the volume a·√(b/π), so the two terms weigh 34.1·0.2 = 6.82 and 13.5·0.15811 = 2.1345:
        # (6.82 · exp(−0.7014) + 2.1345 · exp(−0.4384)) / 8.9545.
        wave = np.cos(2.0 * np.pi * np.arange(96) / 16.0)
        for channel, wanted in ((0, 0.92088), (1, 0.91125), (2, 0.53146)):
            color = np.zeros((64, 96, 3))
            color[..., 0] = 50.0
            color[..., channel] += 10.0 * wave
            seen = flip.seen_color(flip.from_opponent(color), flip.PIXELS_PER_DEGREE)[32, 32:64, channel]
            self.assertAlmostEqual(np.ptp(seen) / 20.0, wanted, delta=0.004)

    def test_pictures_of_other_sizes_are_refused(self):
        with self.assertRaisesRegex(ValueError, r"\(64, 64, 3\) and \(40, 40, 3\)"):
            flip.flip(noise(1), even(0, 0, 0))


class HighDynamicRange(unittest.TestCase):
    def test_exposures_show_the_brightest_and_the_median(self):
        picture = even(1.0, 1.0, 1.0) * 0.25
        picture[3, 3] = 6.0
        first, last, count = flip.exposure_range(picture)
        self.assertAlmostEqual(float(flip.tone_mapped(2.0 ** first * 6.0)), 0.85, places=6)
        self.assertAlmostEqual(float(flip.tone_mapped(2.0 ** last * 0.25)), 0.85, places=6)
        # log2(6 / 0.25) = 4.58 stops.
        self.assertAlmostEqual(last - first, math.log2(24.0), places=9)
        self.assertEqual(count, 5)

    def test_an_even_picture_is_compared_at_one_exposure(self):
        # The tone mapper makes 0.85 of the reference's luminance.
        scale = 2.0 ** flip.exposure_range(even(4, 4, 4))[0]
        brighter = float(flip.tone_mapped(scale * 5.0))
        wanted = flip.flip(even(0.85, 0.85, 0.85), even(brighter, brighter, brighter))
        np.testing.assert_allclose(flip.hdr_flip(even(4, 4, 4), even(5, 5, 5)), wanted, atol=1e-6)

    def test_the_unit_of_radiance_is_of_no_account(self):
        a, b = noise(1) ** 4, noise(2) ** 4
        np.testing.assert_allclose(flip.hdr_flip(a, b), flip.hdr_flip(1000.0 * a, 1000.0 * b), atol=1e-9)

    def test_errors_in_dark_and_in_bright_places_count(self):
        # The median is dark, so that the last exposure shows the dark side.
        reference = step(50, 0.01, 4.0)
        for changed in (step(50, 0.02, 4.0), step(50, 0.01, 6.0)):
            self.assertGreater(flip.hdr_flip(reference, changed).max(), 0.15)
        # A screen alone shows neither the one nor the other so well.
        self.assertLess(flip.flip(reference, step(50, 0.01, 6.0)).max(), 1e-9)

    def test_no_exposure_shows_more(self):
        a, b = noise(1) ** 4, noise(2) ** 4
        whole = flip.hdr_flip(a, b)
        self.assertEqual(flip.hdr_flip(a, a).max(), 0.0)
        for exposure in np.linspace(*flip.exposure_range(a)):
            one = flip.flip(flip.tone_mapped(2.0 ** exposure * a), flip.tone_mapped(2.0 ** exposure * b))
            self.assertTrue((one <= whole + 1e-12).all())

    def test_a_black_reference_has_an_exposure(self):
        self.assertEqual(flip.hdr_flip(even(0, 0, 0), even(0, 0, 0)).max(), 0.0)
        self.assertGreater(flip.hdr_flip(even(0, 0, 0), even(1, 1, 1)).min(), 0.9)


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-flip-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_command(self, *arguments, code=0):
        done = subprocess.run([ROOT / "scripts/picture-error", "--flip", *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout + done.stderr

    def test_it_tells_the_mean_and_draws_the_errors(self):
        a, b, drawn = (self.folder / name for name in ("a.png", "b.png", "map.png"))
        light_pictures.write_png(a, np.zeros((20, 30, 3), np.uint8))
        light_pictures.write_png(b, np.full((20, 30, 3), 255, np.uint8))
        self.assertEqual(self.run_command(a, b, a, "--ppd", "40"), f"0.96738 {b}\n0.00000 {a}\n")
        self.run_command(a, b, "--map", drawn)
        self.assertGreater(light_pictures.read(drawn).min(), 0.4)  # pale
        self.run_command(a, a, "--map", drawn)
        self.assertLess(light_pictures.read(drawn).max(), 0.01)

    def test_exr_files_are_compared_by_hdr_flip(self):
        paths = [self.folder / "a.exr", self.folder / "b.exr"]
        pictures = [noise(1), noise(2)]
        for path, picture in zip(paths, pictures):
            exr_light.write(path, {letter: picture[..., i] for i, letter in enumerate("RGB")})
        self.assertEqual(self.run_command(*paths).split()[0], f"{flip.hdr_flip(*pictures).mean():.5f}")
        light_pictures.write_png(self.folder / "c.png", np.zeros((64, 64, 3), np.uint8))
        self.assertIn("PNG files or EXR files", self.run_command(paths[0], self.folder / "c.png", code=1))


if __name__ == "__main__":
    unittest.main()
