"""sward.Field: views without copies, unpacked blades, what is told of it; compare, validate, export."""

import copy
import csv
import gc
import json
import os
import pickle
import unittest

import numpy
import sward

from case import PythonCase


class Views(PythonCase):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "hills.sward"
        self.field = sward.bake("hills", count=3000, meadow="grass", output=self.path)

    def test_they_are_the_bytes_of_the_file(self):
        packed = self.field.packed
        self.assertEqual((packed.dtype.itemsize, packed.shape), (16, (3000,)))
        self.assertIn(packed.tobytes(), self.path.read_bytes())
        patches = self.field.patches
        self.assertEqual(patches.dtype.itemsize, 104)
        self.assertEqual(patches["blade_count"].sum(), 3000)
        self.assertEqual(self.field.keys.shape, (3000,))
        self.assertEqual(patches["parent"][0], 0xffffffff)

    def test_they_are_no_copies(self):
        first, second = self.field.packed, self.field.packed
        self.assertTrue(numpy.shares_memory(first, second))
        self.assertEqual(first.__array_interface__["data"][0], second.__array_interface__["data"][0])
        self.assertIsNotNone(first.base)
        # The address lies in the file's mapping.
        place = first.__array_interface__["data"][0]
        with open("/proc/self/maps", encoding="utf-8") as maps:
            spans = [line.split()[0] for line in maps if line.rstrip().endswith("hills.sward")]
        ends = [[int(end, 16) for end in span.split("-")] for span in spans]
        self.assertTrue(any(low <= place < high for low, high in ends), (hex(place), spans))

    def test_they_keep_the_map_alive(self):
        packed = sward.read(self.path).packed
        expected = self.field.packed.copy()
        self.path.unlink()
        gc.collect()
        for _ in range(3):
            numpy.zeros(1_000_000)  # other memory comes and goes
        self.assertTrue((packed == expected).all())

    def test_they_are_read_only(self):
        for view in (self.field.packed, self.field.patches, self.field.keys):
            self.assertFalse(view.flags.writeable)
            with self.assertRaises(ValueError):
                view.setflags(write=True)

    def test_a_field_in_memory_has_the_same(self):
        other = sward.bake("hills", count=3000, meadow="grass")
        self.assertFalse(other.is_mapped)
        for name in ("packed", "patches", "keys"):
            self.assertTrue((getattr(other, name) == getattr(self.field, name)).all(), name)
        packed = other.packed
        expected = packed.copy()
        del other
        gc.collect()
        self.assertTrue((packed == expected).all())


class ChangedFiles(PythonCase):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "plane.sward"
        self.baked = sward.bake("plane", count=300, meadow="hay")
        self.baked.save(self.path)
        self.data = self.path.read_bytes()

    def assert_is_told(self, field):
        for use in (field.blades, field.curves, field.info, lambda: field.packed, lambda: sward.compare(field, field),
                    lambda: field.export(self.folder / "no.ply"), lambda: sward.Session("plane", field=field),
                    lambda: sward.Renderer(field), lambda: pickle.dumps((field, field.bounds))):
            with self.assertRaisesRegex(sward.Error, "plane.sward: has been written to in place") as raised:
                use()
            self.assertEqual(raised.exception.kind, "io")

    def test_a_truncated_one_is_told_and_does_not_end_python(self):
        field = sward.read(self.path)
        os.truncate(self.path, 4096)
        self.assert_is_told(field)

    def test_so_is_one_that_is_overwritten(self):
        field = sward.read(self.path)
        self.path.write_bytes(self.data + b" ")
        self.assert_is_told(field)

    def test_indices_in_changed_pages_are_checked(self):
        for number in (0, 255):
            field = sward.read(self.path)
            field._stamp = None  # as if the file's time had not changed
            with open(self.path, "r+b") as file:
                file.write(bytes([number]) * len(self.data))
            for use in (field.blades, field.curves):
                with self.assertRaisesRegex(sward.Error, "changed in place"):
                    use()
            self.path.write_bytes(self.data)

    def test_one_that_is_replaced_or_deleted_stays_as_it_was(self):
        field = sward.read(self.path)
        other = self.folder / "other.sward"
        sward.bake("plane", count=5).save(other)
        other.replace(self.path)
        self.assertTrue((field.blades() == self.baked.blades()).all())
        self.path.unlink()
        self.assertTrue((field.blades() == self.baked.blades()).all())

    def test_a_copy_does_not_depend_on_its_file(self):
        field = sward.read(self.path, copy=True)
        self.assertFalse(field.is_mapped)
        os.truncate(self.path, 10)
        self.assertTrue((field.blades() == self.baked.blades()).all())
        field.save(self.folder / "again.sward")
        self.assertEqual((self.folder / "again.sward").read_bytes(), self.data)
        with self.assertRaisesRegex(sward.Error, "plane.sward: 10 bytes"):
            sward.read(self.path, copy=True)


class Pickled(PythonCase):
    def test_a_field_in_memory_is_its_bytes(self):
        field = sward.bake("plane", count=100)
        again = pickle.loads(pickle.dumps(field))
        self.assertEqual(self.bytes_of(again), self.bytes_of(field))
        self.assertEqual((again.name, again.report), (field.name, field.report))
        self.assertEqual(self.bytes_of(pickle.loads(pickle.dumps(again))), self.bytes_of(field))
        self.assertIs(copy.deepcopy(field), field)

    def test_a_mapped_one_is_its_path_and_must_be_the_same(self):
        path = self.folder / "plane.sward"
        field = sward.bake("plane", count=100, output=path)
        data = pickle.dumps(field)
        self.assertLess(len(data), 10000)
        again = pickle.loads(data)
        self.assertTrue(again.is_mapped and (again.packed == field.packed).all())
        sward.bake("plane", count=100, seed=3, output=path, force=True)
        with self.assertRaisesRegex(sward.Error, "plane.sward: is not the field that was pickled"):
            pickle.loads(data)


class Names(PythonCase):
    def test_that_are_no_utf_8(self):
        folder = os.fsencode(self.folder)
        field = sward.bake("plane", count=10, meadow="grass", output=os.fsdecode(folder + b"/gr\xfcn.sward"))
        self.assertTrue(field.name.endswith("gr\udcfcn.sward"))
        name = next(name for name in os.listdir(self.folder) if name.startswith("gr"))
        self.assertEqual(len(sward.read(self.folder / name)), 10)
        field.export(self.folder / name.replace(".sward", ".csv"))
        self.assertEqual(sward.read(self.folder / name).info()["blades"], 10)
        with self.assertRaisesRegex(sward.Error, "no\udcff.sward"):
            sward.read("no\udcff.sward")
        for name in ("", "a\0b"):
            with self.assertRaises(ValueError):
                sward.read(name)


class Blades(PythonCase):
    def test_they_are_those_of_the_csv_export(self):
        field = sward.bake("hills", count=2000, meadow="grass")
        field.export(self.folder / "blades.csv")
        with open(self.folder / "blades.csv", encoding="ascii", newline="") as file:
            rows = list(csv.DictReader(file))
        blades = field.blades()
        blades = blades[~blades["ribbon"]]
        self.assertEqual([int(row["id"]) for row in rows], blades["id"].tolist())
        for name, values in (("x", blades["root"][:, 0]), ("y", blades["root"][:, 1]), ("z", blades["root"][:, 2]),
                             ("ux", blades["up"][:, 0]), ("facing", blades["facing"]), ("height", blades["height"]),
                             ("width", blades["width"]), ("stiffness", blades["stiffness"]),
                             ("species", blades["species"]), ("exposure", blades["exposure"]),
                             ("tint_g", blades["tint"][:, 1]), ("clump", blades["clump"]), ("patch", blades["patch"])):
            numpy.testing.assert_allclose([float(row[name]) for row in rows], values, rtol=1e-6, atol=1e-8, err_msg=name)

    def test_a_range_is_a_part_of_all(self):
        field = sward.bake("hills", count=2000, meadow="grass")
        self.assertTrue((field.blades(700, 900) == field.blades()[700:1600]).all())
        self.assertTrue((field.curves(700, 900) == field.curves()[700:1600]).all())
        self.assertEqual(len(field.blades(2000)), 0)
        with self.assertRaises(sward.Error):
            field.blades(1999, 2)
        for first, count in ((2**64, None), (1999, 2**64), (2**70, 2**70)):
            with self.assertRaisesRegex(sward.Error, "are asked for, and it has 2000"):
                field.blades(first, count)
        with self.assertRaises(ValueError):
            field.blades(-1)
        with self.assertRaisesRegex(TypeError, "count is 2.0; a whole number"):
            field.curves(1, 2.0)

    def test_curves_begin_at_roots_and_are_as_long_as_blades(self):
        field = sward.bake("hills", count=500, meadow="grass")
        blades, curves = field.blades(), field.curves()
        numpy.testing.assert_allclose(curves[:, 0], blades["root"], atol=1e-5)
        v0, v1, v2 = curves[:, 0], curves[:, 1], curves[:, 2]
        t = numpy.linspace(0, 1, 200)[:, None, None]
        points = (1 - t) ** 2 * v0 + 2 * t * (1 - t) * v1 + t**2 * v2
        lengths = numpy.linalg.norm(numpy.diff(points, axis=0), axis=2).sum(axis=0)
        numpy.testing.assert_allclose(lengths, blades["height"], rtol=0.02)

    def test_areas_are_between_half_and_whole(self):
        blades = sward.bake("hills", count=500, meadow="grass").blades()
        share = blades["area"] / (blades["height"] * blades["width"])
        self.assertTrue(((share > 0.45) & (share <= 1.0001)).all())


class Told(PythonCase):
    def test_info_is_that_of_the_program(self):
        path = self.folder / "hills.sward"
        field = sward.bake("hills", count=1000, meadow="grass", output=path)
        said = json.loads(self.program("info", path, "--json").stdout)
        self.assertEqual(sward.read(path).info(), said)
        self.assertIn("histogram", field.info(histograms=True))
        self.assertEqual(field.provenance["tool"], "sward " + sward.__version__)
        self.assertEqual(len(field), 1000)
        self.assertEqual(field.file_bytes, path.stat().st_size)
        self.assertEqual(field.report["roots"]["kept"], 1000)
        self.assertIsNone(sward.read(path).report)
        self.assertEqual(field.bounds.shape, (2, 3))
        self.assertTrue((field.bounds[0] < field.bounds[1]).all())
        self.assertEqual(len(field.species), len(said["species"]))

    def test_a_damaged_file_is_refused_as_by_the_program(self):
        path = self.folder / "hills.sward"
        sward.bake("hills", count=1000, output=path)
        data = bytearray(path.read_bytes())
        data[len(data) // 2] ^= 1
        path.write_bytes(data)
        done = self.program("validate", path, code=3)
        for read in (sward.read, sward.validate):
            with self.assertRaises(sward.Error) as raised:
                read(path)
            self.assertIn(str(raised.exception), done.stderr)
            self.assertEqual((raised.exception.kind, raised.exception.exit_code), ("input", 3))
        again = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual((str(again), again.kind, again.exit_code), (str(raised.exception), "input", 3))

    def test_ground_is_no_field(self):
        with self.assertRaisesRegex(sward.Error, "is ground, not a field"):
            sward.read("hills")
        with self.assertRaises(sward.Error) as raised:
            sward.read(self.folder / "nothing.sward")
        self.assertEqual(raised.exception.kind, "io")


class CompareAndExport(PythonCase):
    def test_compare(self):
        first = sward.bake("hills", count=500)
        self.assertTrue(sward.compare(first, sward.bake("hills", count=500)).same)
        other = sward.compare(first, sward.bake("hills", count=500, seed=5))
        self.assertFalse(other.same)
        self.assertGreater(other["only_first"] + other["traits_differ"], 0)
        moved = sward.compare(first, first, transform={"translation": [1, 0, 0]})
        self.assertAlmostEqual(moved["largest_root_distance"], 1, delta=0.01)
        self.assertTrue(sward.compare(first, first, transform=numpy.eye(4), match="order").same)
        with self.assertRaisesRegex(sward.Error, "transform: "):
            sward.compare(first, first, transform=numpy.diag([1, 2, 3, 1]))
        with self.assertRaisesRegex(ValueError, r"transform\[1\]\[2\]: inf; all numbers must be finite"):
            sward.compare(first, first, transform=[[1, 0, 0], [0, 1, numpy.inf], [0, 0, 1]])
        with self.assertRaisesRegex(TypeError, "tolerance is 'x'; a number"):
            sward.compare(first, first, tolerance="x")

    def test_exports_are_those_of_the_program(self):
        path = self.folder / "hills.sward"
        field = sward.bake("hills", count=300, output=path)
        for kind in (".glb", ".ply", ".usda", ".csv"):
            field.export(self.folder / f"own{kind}")
            self.program("export", path, "-o", f"program{kind}")
            self.assertEqual((self.folder / f"own{kind}").read_bytes(),
                             (self.folder / f"program{kind}").read_bytes(), kind)
        with self.assertRaisesRegex(sward.Error, "cannot export to '.obj'") as raised:
            field.export(self.folder / "own.obj")
        self.assertEqual(raised.exception.exit_code, 5)
        with self.assertRaises(sward.Error):
            field.export(self.folder / "own.ply")


if __name__ == "__main__":
    unittest.main()
