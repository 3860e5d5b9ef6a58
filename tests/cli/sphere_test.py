"""Grass all around a ball: no code may believe that up is y."""

import math
import unittest

import numpy

from meshes import dot, length, unit
from support import CliTest


class Sphere(CliTest):
    def setUp(self):
        super().setUp()
        self.sward("terrain", "sphere", "-o", "s.glb")

    def test_roots_are_even_over_halves_and_bands_of_equal_area(self):
        field = self.bake("s.glb", "--count", "100000", "--sky-rays", "0")
        self.sward("export", field, "-o", "s.csv")
        roots = numpy.loadtxt(self.folder / "s.csv", delimiter=",", skiprows=1, usecols=(1, 2, 3))
        self.assertEqual(roots.shape, (100000, 3))
        for axis in range(3):
            self.assertLess(abs((roots[:, axis] < 0.0).mean() - 0.5), 0.01, f"axis {axis}")
        # Archimedes: slices of equal height have equal area.
        slices, _ = numpy.histogram(numpy.clip(roots[:, 1], -10.0, 10.0), bins=20, range=(-10.0, 10.0))
        chi_square = ((slices - 5000.0) ** 2 / 5000.0).sum()
        # 19 degrees of freedom: 43.8 has probability 0.001. The facets change a slice by 0.2 %.
        self.assertLess(chi_square, 43.8, slices)

    def test_blades_stand_radially_on_the_sphere(self):
        blades = self.blades(self.bake("s.glb", "--count", "20000"))
        radius = 10.0
        for blade in blades:
            # Facets of 2.8° lie at most 3 mm inside.
            self.assertLess(abs(length(blade.root) - radius), 0.01)
            # Half a facet's turn (2°), and the rounding of up to 16 bits (0.64°).
            self.assertGreater(dot(blade.up, unit(blade.root)), math.cos(math.radians(2.7)))
            self.assertAlmostEqual(length(blade.up), 1.0, places=5)

    def test_slope_of_90_leaves_nothing_below(self):
        blades = self.blades(self.bake("s.glb", "--count", "20000", "--slope", "0:90"))
        self.assertEqual(len(blades), 20000)
        self.assertGreater(min(blade.root[1] for blade in blades), -1e-3)
        # All above is still grown over, the belt at the equator like the cap.
        low = sum(blade.root[1] < 5.0 for blade in blades)
        self.assertLess(abs(low / 20000 - 0.5), 0.02)

    def test_radial_ground_up_makes_a_planet_level_everywhere(self):
        blades = self.blades(
            self.bake("s.glb", "--count", "5000", "--ground-up", "radial", "--slope", "0:5"))
        below = sum(blade.root[1] < 0.0 for blade in blades)
        self.assertLess(abs(below / 5000 - 0.5), 0.05)

    def test_undersides_are_warned_of_with_the_option_that_removes_them(self):
        done = self.sward("bake", "s.glb", "-o", "f.sward", "--count", "1000")
        self.assertRegex(done.stderr, r"warning: .*--slope")
        filtered = self.sward("bake", "s.glb", "-o", "g.sward", "--count", "1000", "--slope", "0:90")
        self.assertNotIn("--slope", filtered.stderr)


if __name__ == "__main__":
    unittest.main()
