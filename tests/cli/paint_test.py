"""`--paint`: strokes of a file raise, thin and change the grass that they reach, and no other."""

import math
import struct
import unittest

from support import CliTest, INPUT, IO, ROOT, UNSUPPORTED, USAGE, digest

EXAMPLE = ROOT / "examples/paint/strokes.json"


def stroke(kind, *points, radius=3.0, **more):
    """A hard stroke on level ground."""
    return {"kind": kind, "radius_m": radius, "hardness": 1, "points": [list(p) for p in points],
            "normals": [[0, 1, 0]], **more}


class Paint(CliTest):
    def paint(self, *strokes, name="strokes.json"):
        return self.write_json(name, {"format": "sward strokes 1", "strokes": list(strokes)}).name

    def roots(self, *options):
        self.bake("plane", "--density", "300", "--report", "report.json", "--force", "--sky-rays", "0", *options)
        return self.read_json("report.json")["roots"]

    def test_strokes_thin_and_thicken_and_are_counted(self):
        disk = math.pi * 9.0 * 300.0
        erased = self.roots("--paint", self.paint(stroke("erase", (0, 0, 0))))
        self.assertEqual(erased["kept"] + erased["rejected"]["paint"], erased["proposed"])
        self.assertEqual(erased["proposed"], 120000)
        self.assertAlmostEqual(erased["rejected"]["paint"], disk, delta=0.02 * disk)
        added = self.roots("--paint", self.paint(stroke("add", (0, 0, 0), ceiling=3)))
        self.assertEqual(sum(added["rejected"].values()), 0)
        self.assertAlmostEqual(added["kept"] - 120000, 2 * disk, delta=0.02 * disk)

    def test_blades_stand_where_they_stood(self):
        def blades(*options):
            return {blade.id: blade for blade in self.blades(
                self.bake("plane", "--density", "40", "--force", *options))}
        before = blades()
        after = blades("--paint", self.paint(stroke("erase", (-5, 0, -5), (5, 0, 5))))
        self.assertLess(set(after), set(before))
        for key, blade in after.items():
            x, _, z = blade.root
            along = min(max((x + z) / 2.0, -5.0), 5.0)
            self.assertGreater(math.hypot(x - along, z - along), 2.999)
            self.assertLess(math.dist(blade.root, before[key].root), 0.002)

    def test_the_order_of_strokes_counts(self):
        erase, put = stroke("erase", (0, 0, 0)), stroke("set", (0, 0, 0))
        unpainted = self.roots()["kept"]
        self.assertEqual(self.roots("--paint", self.paint(erase, put))["kept"], unpainted)
        self.assertLess(self.roots("--paint", self.paint(put, erase))["kept"], unpainted - 8000)

    def test_a_paint_mask_in_place_of_the_strokes_grows_the_same_blades(self):
        # Soft edges 2 m wide, texels of 2 cm: by docs/painting.md the density differs by less than 1/510 + 0.0003.
        strokes = self.paint(stroke("erase", (-6, 0, -6), (-4, 0, 7), radius=2.5, hardness=0.2),
                             stroke("set", (4, 0, 2), radius=4, hardness=0.5, density=0.4))
        def blades(*options):
            field = self.bake("plane", "--density", "300", "--force", "--sky-rays", "0", *options)
            self.sward("export", field, "-o", "ids.csv", "--force")
            lines = (self.folder / "ids.csv").read_text(encoding="ascii").splitlines()
            return {line.split(",", 1)[0] for line in lines[1:]}
        painted = blades("--paint", strokes, "--paint-mask", "mask.png")
        head = (self.folder / "mask.png").read_bytes()[:26]
        self.assertEqual(head[12:26], b"IHDR" + struct.pack(">IIBB", 1024, 1024, 8, 0))
        masked = blades("--mask", "texture:mask.png")
        self.assertLess(len(painted), 110000)
        # An image repeats: a texel round the edge mixes with the other side.
        self.assertLess(len(painted ^ masked), 120000 * (1 / 510 + 0.0003) + 120000 * 2 / 1024)
        # The same bytes again, by another number of threads, and of the size that is asked for.
        first = digest(self.folder / "mask.png")
        self.sward("bake", "plane", "--dry-run", "--paint", strokes, "--paint-mask", "again.png", "--threads", 3)
        self.assertEqual(digest(self.folder / "again.png"), first)
        self.sward("bake", "plane", "--dry-run", "--paint", strokes, "--paint-mask", "small.png", "--paint-mask-size", 7)
        self.assertEqual((self.folder / "small.png").read_bytes()[16:24], struct.pack(">II", 7, 7))

    def test_a_paint_mask_that_cannot_be_made_leaves_nothing(self):
        strokes = self.paint(stroke("erase", (0, 0, 0)))
        (self.folder / "bare.obj").write_text("v 0 0 0\nv 0 0 5\nv 5 0 0\nf 1 2 3\n", encoding="ascii")
        bake = ("bake", "bare.obj", "-o", "out.sward", "--density", "10", "--paint-mask")
        self.refused(*bake, "out.png", "--paint", strokes, code=INPUT, names=["--paint-mask", "no texture coordinates", "bare.obj"])
        self.refused(*bake, "out.png", code=USAGE, names=["--paint-mask out.png", "--paint is missing"])
        self.refused(*bake, "out.jpg", "--paint", strokes, code=USAGE, names=["out.jpg", ".png"])
        self.refused(*bake, "out.png", "--paint-mask-size", "8193", "--paint", strokes, code=USAGE, names=["--paint-mask-size", "8192"])
        (self.folder / "out.png").write_bytes(b"mine")
        self.refused(*bake, "out.png", "--paint", strokes, code=IO, names=["out.png", "--force"])
        self.assertEqual((self.folder / "out.png").read_bytes(), b"mine")
        self.refused("plan", "plane", "--tiles", 2, "-o", "plan.json", "--paint", strokes, "--paint-mask", "p.png",
                     code=USAGE, names=["--paint-mask"])

    def test_the_example_bakes_in_any_number_of_threads(self):
        fields = {digest(self.bake("plane", "--density", "60", "--paint", EXAMPLE, "--threads", threads,
                                   to=f"{threads}.sward")) for threads in (1, 2, 7)}
        self.assertEqual(len(fields), 1)
        self.assertNotEqual(fields, {digest(self.bake("plane", "--density", "60"))})

    def test_tiles_are_together_what_one_bake_is(self):
        ground = self.write_json("hills.json", {"kind": "plane", "size": [160, 130], "cells": [80, 65]}).name
        options = ("--density", "1.5", "--paint", self.paint(
            stroke("add", (-80, 0, -50), (0, 0, 10), (80, 0, 60), radius=9, ceiling=4),
            stroke("trodden", (-60, 0, 50), (60, 0, -60), radius=2),
            stroke("smooth", (0, 0, 0), radius=12)))
        whole = self.bake(ground, *options)
        self.sward("plan", ground, "--tiles", 5, "-o", "plan.json", "-q", *options)
        for index in range(5):
            self.sward("tile", "plan.json", "--index", index, "-o", "tiles")
        self.sward("merge", "plan.json", "tiles", "-o", "merged.sward", "-q")
        self.assertEqual(digest(self.folder / "merged.sward"), digest(whole))
        # Tiles of other strokes would not fit together.
        self.paint(stroke("erase", (0, 0, 0)))
        self.refused("tile", "plan.json", "--index", 1, "-o", "tiles", "--force", code=INPUT,
                     names=["strokes.json", "plan.json"])

    def test_a_count_is_what_grows_without_strokes(self):
        self.bake("plane", "--count", "100000", "--report", "report.json", "--paint",
                  self.paint(stroke("erase", (0, 0, 0), radius=5)))
        kept = self.read_json("report.json")["roots"]["kept"]
        self.assertAlmostEqual(kept, 100000 * (1 - math.pi * 25 / 400), delta=500)

    def test_more_than_max_blades_with_strokes_is_refused(self):
        strokes = self.paint(stroke("add", (0, 0, 0), radius=5, ceiling=4))
        self.refused("bake", "plane", "--density", "100", "--max-blades", "70000", "-o", "out.sward",
                     "--paint", strokes, code=INPUT, names=["strokes.json", "--max-blades 70000"])
        self.bake("plane", "--density", "100", "--max-blades", "70000")

    def test_a_dry_run_counts_strokes(self):
        # More than the 400000 blades that an estimate samples.
        options = ("--density", "1100", "--sky-rays", "0", "--paint", self.paint(
            stroke("add", (-5, 0, 0), radius=4, ceiling=3), stroke("erase", (5, 0, 5), radius=3)))
        wanted = self.report("plane", *options)["roots"]["kept"]
        estimate = self.report("plane", *options, dry=True)["roots"]["kept"]
        self.assertAlmostEqual(estimate, wanted, delta=0.05 * wanted)
        self.assertGreater(wanted, 467500)

    def test_the_field_knows_what_was_painted(self):
        def provenance(*strokes):
            field = self.bake("plane", "--density", "5", "--paint", self.paint(*strokes), "--force")
            return self.info(field)["provenance"]["settings"]["paint"]
        one = provenance(stroke("erase", (0, 0, 0)))
        self.assertEqual(one["strokes"], 1)
        self.assertNotEqual(one["hash"], provenance(stroke("erase", (0, 0, 0.001)))["hash"])

    def test_bad_strokes_are_refused_by_name(self):
        def refused(code, *names, paint):
            self.refused("bake", "plane", "-o", "out.sward", "--paint", paint, code=code, names=names)
        refused(IO, "none.json", paint="none.json")
        refused(INPUT, "s.json", "strokes[1]", "radius_m", "[0.001, 1000]",
                paint=self.paint(stroke("erase", (0, 0, 0)), stroke("erase", (0, 0, 0), radius=0), name="s.json"))
        refused(INPUT, "s.json", "strokes[0]", "radius_m", "1000000000",
                paint=self.paint(stroke("erase", (0, 0, 0), radius=1e9), name="s.json"))
        refused(INPUT, "s.json", "strokes[0]", "kind", "mow",
                paint=self.paint(stroke("mow", (0, 0, 0)), name="s.json"))
        refused(INPUT, "s.json", "JSON", paint=self.paint(stroke("erase", (0, math.nan, 0)), name="s.json"))
        refused(INPUT, "s.json", "strokes[0]", "species", "no \"moss\"", "ryegrass",
                paint=self.paint(stroke("species", (0, 0, 0), species="moss"), name="s.json"))
        refused(UNSUPPORTED, "new.json", "sward strokes 2", "sward strokes 1",
                paint=self.write_json("new.json", {"format": "sward strokes 2", "strokes": []}).name)
        (self.folder / "long.json").write_text(
            '{"format": "sward strokes 1", "strokes": [{"kind": "erase", "points": [' +
            ",".join(["[0,0,0]"] * 10_000_000) + "]}]}")
        refused(INPUT, "long.json", "67108864", paint="long.json")

    def test_strokes_without_effect_are_warned_of(self):
        done = self.sward("bake", "plane", "-o", "a.sward", "--density", "5", "--paint",
                          self.paint(stroke("erase", (0, 0, 0)), stroke("erase", (500, 0, 0))))
        self.assertIn("1 of 2 strokes touch no ground and paint nothing: strokes[1]; 50 % of all points",
                      done.stderr)
        done = self.sward("bake", "plane", "-o", "b.sward", "--spacing", "0.5", "--paint",
                          self.paint(stroke("add", (0, 0, 0), ceiling=2)))
        self.assertIn("--sampling uniform", done.stderr)


    def valley(self, name, height):
        """A valley along z, at this height."""
        steps = [x - 10 for x in range(21)]
        lines = [f"v {x} {0.06 * x * x + height} {z}" for z in steps for x in steps]
        for row in range(20):
            for column in range(20):
                a = 21 * row + column + 1
                lines += [f"f {a} {a + 21} {a + 1}", f"f {a + 1} {a + 21} {a + 22}"]
        (self.folder / name).write_text("\n".join(lines) + "\n", encoding="ascii")
        return name

    def test_strokes_that_touch_no_ground_are_told_and_moved_onto_it(self):
        strokes = self.paint({"kind": "erase", "radius_m": 1.0, "name": "Path", "normals": [[0, 1, 0]],
                              "points": [[0, 0, -5], [0, 0, 5]]},
                             stroke("erase", (3, 0.54, 0), radius=1), stroke("erase", (0, -2, -8), radius=1))
        bake = ("--density", "50", "--blade-scale", "1", "--sky-rays", "0", "--force", "--paint", strokes)

        def grown(ground, *options):
            done = self.sward("bake", ground, "-o", "out.sward", *bake, *options)
            return self.info(self.folder / "out.sward")["blades"], done.stderr
        here, sunk = self.valley("here.obj", 0), self.valley("sunk.obj", -2)
        wanted, said = grown(here)
        self.assertIn("1 of 3 strokes touch no ground and paint nothing: strokes[2]; 25 %", said)
        lost, said = grown(sunk)
        self.assertIn('2 of 3 strokes touch no ground and paint nothing: strokes[0] "Path", strokes[1]; 75 %', said)
        self.assertIn("--move-strokes", said)
        self.assertNotEqual(lost, wanted)
        # Both fields with all three strokes on their ground.
        moved, said = grown(sunk, "--move-strokes", 2.5)
        self.assertIn("2 of 3 strokes are moved onto the ground: 3 points, by up to 2 m", said)
        self.assertNotIn("touch no ground", said)
        self.assertEqual(moved, grown(here, "--move-strokes", 2.5)[0])
        self.assertEqual(grown(sunk, "--move-strokes", 1.5)[0], lost)
        self.refused("bake", here, "-o", "out.sward", "--force", "--move-strokes", 1, code=USAGE, names=["--paint"])
        self.refused("bake", here, "-o", "out.sward", *bake, "--move-strokes", 0, code=USAGE,
                     names=["--move-strokes", "0.001"])
        self.refused("plan", here, "--tiles", 2, "-o", "plan.json", "--paint", strokes, "--move-strokes", 1,
                     code=USAGE, names=["--move-strokes"])

    def test_a_name_changes_nothing(self):
        one = stroke("erase", (0, 0, 0))
        plain = self.bake("plane", "--density", "5", "--paint", self.paint(one), to="a.sward")
        named = self.bake("plane", "--density", "5", "--paint", self.paint({**one, "name": "a \"path\""}), to="b.sward")
        self.assertEqual(digest(plain), digest(named))
        self.refused("bake", "plane", "-o", "out.sward", "--paint", self.paint({**one, "name": "x" * 201}), code=INPUT,
                     names=["strokes[0]", "name", "200"])
        self.refused("bake", "plane", "-o", "out.sward", "--paint", self.paint({**one, "name": 3}), code=INPUT,
                     names=["strokes[0]", "name"])


if __name__ == "__main__":
    unittest.main()
