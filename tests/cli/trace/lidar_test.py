"""`sward lidar`: a field as a range sensor measures it."""

import struct
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import numpy as np

from support import CliTest, INPUT, IO, UNSUPPORTED, USAGE, digest

SCANNER = ("--scanner", "0,0", "--above", "1.5", "--rings", "16", "--columns", "256", "--elevation", "-60:5")
PLY = np.dtype([(name, "<f8") for name in "xyz"] + [(name, "<f4") for name in ("range", "intensity", "incidence")] +
               [(name, "u1") for name in ("number", "returns", "class", "species")] + [("beam", "<f8"), ("id", "<f8")])
LAS = np.dtype([("place", "<i4", 3), ("intensity", "<u2"), ("number", "u1"), ("flags", "u1"), ("class", "u1"),
                ("species", "u1"), ("angle", "<i2"), ("source", "<u2"), ("beam", "<f8")])


class Lidar(CliTest):
    def setUp(self):
        super().setUp()
        self.bake("hills", "--scale", "0.2", "--count", "8000", to="f.sward")

    def lidar(self, *options, to="p.npy", **how):
        return self.sward("lidar", "f.sward", "-o", to, *options, "--force", **how).stderr

    def points(self, *options):
        self.lidar(*options)
        return np.load(self.folder / "p.npy")

    def test_points_lie_on_their_beams_and_name_blades_of_the_field(self):
        points = self.points(*SCANNER)
        self.assertGreater(len(points), 1000)
        leaves, ground = points[points["class"] == 3], points[points["class"] == 2]
        self.assertGreater(len(leaves), 50)
        self.assertGreater(len(ground), 100)
        self.assertEqual(set(ground["id"]), {-1})
        self.assertEqual(set(ground["species"]), {255})
        rows = {row.id: row for row in self.blades(self.folder / "f.sward")}
        for point in leaves[::17]:
            row = rows[int(point["id"])]
            # A blade's root is not farther than its height, and the resolution of the sensor.
            self.assertLess(np.linalg.norm(np.subtract([point[axis] for axis in "xyz"], row.root)), 3 * row.height + 0.3)
        table = np.genfromtxt(self.folder / "f.csv", delimiter=",", names=True)
        species = dict(zip(table["id"].astype(np.int64), table["species"]))
        self.assertEqual([species[name] for name in leaves["id"]], list(leaves["species"]))
        # Beam 0 is the lowest ring, towards +X from 1.5 m above the ground.
        eye_y = points["y"][0] + points["range"][0] * np.sin(np.radians(60))
        places = np.stack([points[axis] for axis in "xyz"], 1)
        ranges = np.linalg.norm(places - [0, eye_y, 0], axis=1)
        np.testing.assert_allclose(ranges, points["range"], atol=1e-3)
        ring = points["beam"] % 16
        np.testing.assert_allclose((places[:, 1] - eye_y) / ranges, np.sin(np.radians(-60 + 65 / 15 * ring)), atol=1e-3)
        self.assertTrue((np.diff(points["beam"].astype(np.int64)) >= 0).all())
        self.assertTrue((points["number"] <= points["returns"]).all())

    def test_all_formats_hold_the_same_points(self):
        npy = self.points(*SCANNER, "--resolution", "0.05")
        self.lidar(*SCANNER, "--resolution", "0.05", to="p.ply")
        self.lidar(*SCANNER, "--resolution", "0.05", to="p.las")
        head, body = (self.folder / "p.ply").read_bytes().split(b"end_header\n", 1)
        self.assertEqual(int(head.split(b"element vertex ")[1].split()[0]), len(npy))
        ply = np.frombuffer(body, PLY)
        for name in npy.dtype.names:
            np.testing.assert_array_equal(ply[name], npy[name].astype(PLY[name]), name)
        las = (self.folder / "p.las").read_bytes()
        self.assertEqual((las[:4], las[24:26], las[104]), (b"LASF", b"\1\4", 6))
        offset, size = struct.unpack_from("<IBH", las, 96)[0], struct.unpack_from("<H", las, 105)[0]
        scale, shift = np.frombuffer(las, "<f8", 3, 131), np.frombuffer(las, "<f8", 3, 155)
        self.assertEqual(struct.unpack_from("<Q", las, 247)[0], len(npy))
        self.assertEqual(size, LAS.itemsize)
        points = np.frombuffer(las, LAS, offset=offset)
        places = points["place"] * scale + shift
        np.testing.assert_allclose(places, np.stack([npy["x"], -npy["z"], npy["y"]], 1), atol=6e-4)
        self.assertEqual(list(points["number"]), [n | m << 4 for n, m in zip(npy["number"], npy["returns"])])
        by_number = struct.unpack_from("<15Q", las, 255)
        self.assertEqual(list(by_number[:3]), [int((npy["number"] == n).sum()) for n in (1, 2, 3)])
        high, low = np.frombuffer(las, "<f8", 6, 179).reshape(3, 2).T
        np.testing.assert_allclose(high, places.max(0), atol=1e-9)
        np.testing.assert_allclose(low, places.min(0), atol=1e-9)
        np.testing.assert_allclose(points["intensity"] / 65535, npy["intensity"], atol=1e-5)

    def test_beams_come_from_arrays_and_tables(self):
        rng = np.random.default_rng(1)
        beams = np.concatenate([rng.uniform(-3, 3, (500, 3)) + [0, 6, 0], np.tile([0.0, -2.0, 0.1], (500, 1))], 1)
        np.save(self.folder / "b.npy", beams)
        a = self.points("--beams", "b.npy")
        np.savetxt(self.folder / "b.csv", beams[:, [3, 4, 5, 0, 1, 2]], delimiter=", ", header="dx,dy,dz, x,y,z", comments="", fmt="%.17g")
        np.testing.assert_array_equal(self.points("--beams", "b.csv"), a)
        # As spreadsheets write them: a byte order mark, quotes, signs.
        rows = [",".join(f'"{number:+.17g}"' for number in beam) for beam in beams]
        (self.folder / "b.csv").write_text("\n".join(['\ufeff"x","y","z","dx","dy","dz"', *rows]), encoding="utf-8")
        np.testing.assert_array_equal(self.points("--beams", "b.csv"), a)
        np.save(self.folder / "b.npy", beams.astype("<f4"))
        single = self.points("--beams", "b.npy")
        self.assertEqual(len(single) // 50, len(a) // 50)
        self.assertEqual(set(a["beam"]) <= set(range(500)), True)

    def test_wrong_beams_are_refused_by_row_and_number(self):
        good = np.tile([0.0, 5.0, 0.0, 0.0, -1.0, 0.0], (10, 1))
        cases = []
        for name, change, kind, words in (
                ("nan", lambda b: b.__setitem__((3, 1), np.nan), INPUT, "row 3: y is nan"),
                ("still", lambda b: b.__setitem__((7, slice(3, 6)), 0), INPUT, "row 7: dx dy dz are 0, 0, 0"),
                ("far", lambda b: b.__setitem__((2, 0), 1e13), INPUT, "row 2: x is 10000000000000"),
                ("all", lambda b: b.fill(0), INPUT, "row 0: dx dy dz are 0, 0, 0")):
            beams = good.copy() if name != "all" else np.tile(good, (1000, 1))
            change(beams)
            np.save(self.folder / f"{name}.npy", beams)
            cases.append((f"{name}.npy", kind, words))
        np.save(self.folder / "five.npy", good[:, :5])
        np.save(self.folder / "flat.npy", good.ravel())
        np.save(self.folder / "deep.npy", good.reshape(10, 6, 1))
        np.save(self.folder / "whole.npy", good.astype("<i8"))
        np.save(self.folder / "fortran.npy", np.asfortranarray(good))
        (self.folder / "cut.npy").write_bytes((self.folder / "nan.npy").read_bytes()[:-20])
        (self.folder / "text.npy").write_text("no array")
        (self.folder / "columns.csv").write_text("x,y,z\n1,2,3\n")
        (self.folder / "cells.csv").write_text("x,y,z,dx,dy,dz\n1,2,3,0,-1,0\n1,2,3\n")
        (self.folder / "word.csv").write_text("x,y,z,dx,dy,dz\n1,2,three,0,-1,0\n")
        (self.folder / "empty.csv").write_text("")
        cases += [("five.npy", INPUT, "(N, 6)"), ("flat.npy", INPUT, "(N, 6)"), ("deep.npy", INPUT, "(N, 6)"),
                  ("whole.npy", UNSUPPORTED, "float32 or float64"), ("fortran.npy", UNSUPPORTED, "Fortran"),
                  ("cut.npy", INPUT, "10 rows by its header"), ("text.npy", INPUT, ".npy file"), ("columns.csv", INPUT, "column dx"),
                  ("cells.csv", INPUT, "line 3 has 3 cells"), ("word.csv", INPUT, "z is 'three'"), ("empty.csv", INPUT, "is empty"),
                  ("none.csv", IO, "none.csv"), ("beams.txt", USAGE, "neither .npy nor .csv")]
        for name, kind, words in cases:
            with self.subTest(name):
                said = self.lidar("--beams", name, to="wrong.npy", code=kind)
                self.assertIn(words, said)
                self.assertIn(name, said)
                self.assertFalse((self.folder / "wrong.npy").exists())

    def test_options_that_contradict_each_other_are_refused(self):
        for options, words in ((("--scanner", "0,0"), "X,Y,Z without"), (("--scanner", "0,1,0", "--above", "1"), "X,Z with --above"),
                               ((), "exactly one of"), (("--airborne", "5", "--scanner", "0,1,0"), "exactly one of"),
                               (("--scanner", "900,900", "--above", "1"), "no ground at 900,900"),
                               (("--airborne", "5", "--leaf-reflectance", "moss=0.5"), "no species 'moss'"),
                               (("--airborne", "5", "--range", "5:5"), "--range"), (("--airborne", "0"), "--airborne"),
                               (("--airborne", "5", "--spacing", "0.0001", "--tilt", "90"), "--tilt"),
                               (("--airborne", "5", "--rings", "8"), "--rings is of --scanner"),
                               (("--airborne", "5", "--elevation", "-9:9"), "--elevation is of --scanner"),
                               (("--beams", "b.npy", "--above", "1"), "--above is of --scanner"),
                               (("--scanner", "0,9,0", "--spacing", "0.1"), "--spacing is of --airborne")):
            with self.subTest(options):
                self.assertIn(words, self.lidar(*options, to="wrong.npy", code=USAGE))
        self.assertIn(".laz", self.lidar("--airborne", "5", to="wrong.laz", code=USAGE))

    def test_the_points_are_the_same_for_any_number_of_threads(self):
        self.lidar("--airborne", "20", "--spacing", "0.05", "--threads", "1", to="a.npy")
        self.lidar("--airborne", "20", "--spacing", "0.05", "--threads", "2", to="b.npy")
        self.assertEqual(digest(self.folder / "a.npy"), digest(self.folder / "b.npy"))

    def test_reflectance_is_that_of_the_species(self):
        bright = self.points("--airborne", "20", "--rays", "1", "--leaf-reflectance", "0.8", "--ground-reflectance", "0.1")
        dark = self.points("--airborne", "20", "--rays", "1", "--leaf-reflectance", "0.2", "--ground-reflectance", "0.1")
        leaves = bright["class"] == 3
        np.testing.assert_allclose(bright["intensity"][leaves], 4 * dark["intensity"][leaves], rtol=1e-4)
        np.testing.assert_array_equal(bright["intensity"][~leaves], dark["intensity"][~leaves])
        np.testing.assert_allclose(bright["intensity"][leaves], 0.8 * np.cos(np.radians(bright["incidence"][leaves])), atol=1e-4)


if __name__ == "__main__":
    unittest.main()
