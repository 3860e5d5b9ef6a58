"""Seeds by the command line: `sward bake --seeds` and `sward grow`."""

import json
import unittest

import numpy

from support import INPUT, IO, USAGE, CliTest

# 40 m of hills; without rays and filters, a bake and its seeds agree blade by blade.
HILLS = ("hills", "--density", 60, "--sky-rays", 0, "--slope", "0:180", "--seed", 9)


class Grow(CliTest):
    def seeded(self, *options, to="seeded.sward"):
        return self.bake(*HILLS, "--seeds", "always", *options, to=to)

    def grow(self, field, *options, to="grown.sward"):
        self.sward("grow", field, "-o", to, "-q", "--force", *options)
        return self.folder / to

    def roots(self, field):
        self.sward("export", field, "-o", "f.csv", "-q", "--force")
        return numpy.genfromtxt(self.folder / "f.csv", delimiter=",", skip_header=1, usecols=(0, 1, 2, 3))

    def test_the_blades_are_those_of_a_plain_bake(self):
        grown = self.grow(self.seeded())
        self.sward("validate", grown)
        told = self.sward("compare", self.bake(*HILLS, to="plain.sward"), grown, "--match", "id",
                          code=7).stdout
        self.assertRegex(told, r"only in A +0\n")
        self.assertRegex(told, r"only in B +0\n")
        # Single precision decides anew which of two clumps is nearer.
        self.assertRegex(told, r"blades of different traits +\d\n")

    def test_strokes_are_sown(self):
        strokes = self.write_json("strokes.json", {"format": "sward strokes 1", "strokes": [
            {"kind": "erase", "radius_m": 3, "points": [[-4, 0, 0], [6, 0, 2]]},
            {"kind": "add", "radius_m": 4, "ceiling": 2, "points": [[8, 0, -8]]},
            {"kind": "height", "radius_m": 3, "factor": 1.5, "points": [[-8, 0, 8]]}]})
        options = ("--paint", strokes.name)
        grown = self.grow(self.seeded(*options))
        self.sward("validate", self.folder / "seeded.sward")
        told = self.sward("compare", self.bake(*HILLS, *options, to="plain.sward"), grown, "--match", "id",
                          code=7).stdout
        self.assertRegex(told, r"only in A +\d\n")
        self.assertRegex(told, r"only in B +\d\n")

    def test_growing_twice_gives_the_same_bytes(self):
        seeded = self.seeded()
        once = self.grow(seeded, "--threads", 1, to="a.sward").read_bytes()
        self.assertEqual(once, self.grow(seeded, "--threads", 3, to="b.sward").read_bytes())
        self.assertEqual(seeded.read_bytes(), self.seeded("--threads", 1, to="again.sward").read_bytes())

    def test_regions_share_out_the_blades(self):
        seeded = self.seeded()
        whole = self.roots(self.grow(seeded))
        parts = [self.roots(self.grow(seeded, f"--region={region}"))
                 for region in ("-100:1.5,-100:100", "1.5:100,-100:-4", "1.5:100,-4:100")]
        joined = numpy.concatenate(parts)
        self.assertEqual(len(joined), len(whole))
        numpy.testing.assert_array_equal(numpy.sort(joined[:, 0]), numpy.sort(whole[:, 0]))
        near = self.roots(self.grow(seeded, "--around", "3,0,-2,6"))
        far = numpy.linalg.norm(near[:, 1:] - (3, 0, -2), axis=1)
        self.assertLess(far.max(), 6.001)
        inside = numpy.linalg.norm(whole[:, 1:] - (3, 0, -2), axis=1) < 5.999
        self.assertGreaterEqual(len(near), inside.sum())

    def test_every_share_is_evenly_spread(self):
        seeded = self.bake("plane", "--density", 800, "--sky-rays", 0, "--blade-scale", 1, "--set",
                           "species.*.share=1", "--meadow", "grass", "--seeds", "always")
        for share in (1.0, 0.25, 0.0625):
            roots = self.roots(self.grow(seeded, "--share", share))
            low, high = roots[:, (1, 3)].min(axis=0), roots[:, (1, 3)].max(axis=0)
            cells = int(numpy.sqrt(len(roots) / 16))
            counts = numpy.histogram2d(roots[:, 1], roots[:, 3], bins=cells,
                                       range=[(low[0], high[0]), (low[1], high[1])])[0]
            # Of independent roots it would be 1.
            with self.subTest(share=share, roots=len(roots)):
                self.assertGreater(len(roots), 300)
                self.assertLess(counts.var() / counts.mean(), 0.8)

    def test_fields_with_seeds_are_compared(self):
        seeded = self.seeded()
        told = self.sward("compare", seeded, self.seeded("--threads", 1, to="again.sward")).stdout
        self.assertRegex(told, r"cells that differ +0\n")
        self.assertIn("the same\n", told)
        other = self.seeded("--set", "drifts=0", to="other.sward")
        told = self.sward("compare", seeded, other, code=7).stdout
        self.assertRegex(told, r"different: the meadows of the seeds differ.*drifts 0\.8\d* and 0\.0\n")
        told = self.sward("compare", seeded, self.bake(*HILLS, to="plain.sward"), code=7).stdout
        self.assertIn("different: only the first field has seeds\n", told)
        self.write_json("still.json", {"translation": [1e-9, 0, 0]})
        told = self.sward("compare", seeded, seeded, "--transform", "still.json").stdout
        self.assertIn("not compared", told)
        self.assertIn("the same but for the seeds\n", told)

    def test_exports_grow_the_blades_or_say_that_they_do_not(self):
        seeded = self.seeded("--budget", 3000)
        stored = self.info(seeded)["blades"]
        done = self.sward("export", seeded, "-o", "stored.csv")
        self.assertRegex(done.stderr, r"only the stored blades are exported, 0\.0\d+ of.*--around")
        self.assertEqual(len((self.folder / "stored.csv").read_text().splitlines()), stored + 1)
        grown = self.grow(seeded, "--around", "3,0,-2,6")
        done = self.sward("export", seeded, "-o", "near.csv", "--around", "3,0,-2,6")
        self.assertNotIn("stored", done.stderr)
        self.sward("export", grown, "-o", "grown.csv")
        self.assertEqual((self.folder / "near.csv").read_bytes(), (self.folder / "grown.csv").read_bytes())
        picture = ("--size", "16x9", "--samples", "2", "--eye", "3,6,6", "--target", "3,0,-2")
        done = self.sward("trace", seeded, "-o", "near.exr", *picture, "--around", "3,0,-2,6")
        self.assertNotIn("stored", done.stderr)
        self.sward("trace", grown, "-o", "grown.exr", *picture)
        self.assertEqual((self.folder / "near.exr").read_bytes(), (self.folder / "grown.exr").read_bytes())
        done = self.sward("trace", seeded, "-o", "stored.exr", *picture)
        self.assertIn("only the stored blades are traced", done.stderr)
        plain = self.bake(*HILLS, to="plain.sward")
        for command, to in (("export", "a.csv"), ("trace", "a.exr")):
            self.refused(command, plain, "-o", to, "--share", 1, code=USAGE, names=["plain.sward", "seeds"])
            self.refused(command, seeded, "-o", to, "--around", "1,2", code=USAGE, names=["--around"])
            self.refused(command, seeded, "-o", to, "--share", 1, "--max-blades", 10, code=INPUT,
                         names=["--max-blades"])

    def test_programs_tell_of_seeds(self):
        told = self.sward("bake", *HILLS, "-o", "f.sward", "--seeds", "always", "--budget", 5000, "--report",
                          "r.json").stdout
        self.assertIn("seeds of", told)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertGreater(report["seeds"]["cells"], 3)
        self.assertIn("seeds", self.sward("info", "f.sward").stdout)
        told = json.loads(self.sward("info", "f.sward", "--json").stdout)
        self.assertEqual(told["seeds"]["cells"], report["seeds"]["cells"])
        self.assertLess(told["blades"] + told["ribbons"], 5200)
        # The stored blades tell how many there would be, to a few in a hundred.
        self.assertEqual(told["seeds"]["stored"], report["seeds"]["stored"])
        all_blades = told["seeds"]["blades"] + told["seeds"]["ribbons"]
        self.assertAlmostEqual(all_blades, report["seeds"]["blades"], delta=2)
        grown = self.info(self.grow("f.sward"))
        self.assertAlmostEqual(grown["blades"] / told["seeds"]["blades"], 1.0, delta=0.05)
        self.assertIn("seeds in", self.sward("validate", "f.sward").stdout)
        # What cannot be grown is refused before it is tried.
        told = self.refused("grow", "f.sward", "-o", "g.sward", "--max-blades", 20, code=INPUT, names=["--max-blades"])

    def test_what_cannot_be_done_is_refused(self):
        self.refused("bake", *HILLS, "-o", "f.sward", "--seeds", "maybe", code=USAGE, names=["--seeds", "maybe"])
        self.refused("bake", "hills", "-o", "f.sward", "--count", 10, "--seeds", "always", code=USAGE,
                     names=["--seeds", "--count"])
        self.refused("bake", "hills", "--dry-run", "--seeds", "always", code=USAGE, names=["--dry-run", "--seeds"])
        plain = self.bake("hills", "--density", 1)
        self.refused("grow", plain, "-o", "g.sward", code=USAGE, names=[str(plain), "seeds"])
        seeded = self.seeded()
        for option, value in (("--region", "0:1"), ("--region", "0:1,b:2"), ("--around", "1,2,3"),
                              ("--around", "1,2,3,-4"), ("--share", "2")):
            self.refused("grow", seeded, "-o", "g.sward", f"{option}={value}", code=USAGE, names=[option])
        self.refused("grow", seeded, "-o", "g.sward", "--max-blades", 10, code=INPUT, names=["--max-blades"])
        self.refused("grow", "no.sward", "-o", "g.sward", code=IO, names=["no.sward"])
        self.refused("grow", seeded, "-o", seeded, "--force", code=USAGE, names=["seeded.sward"])


if __name__ == "__main__":
    unittest.main()
