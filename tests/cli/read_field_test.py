"""examples/read_field.py, which knows fields by docs/field_format.md alone, held against `sward`."""

import csv
import subprocess
import sys
import unittest

import numpy

from support import CliTest, ROOT

sys.path.insert(0, str(ROOT / "examples"))
import read_field

EXACT = ("id", "species", "clump", "patch")


class ReadField(CliTest):
    def export(self, field):
        rows = field.with_suffix(".csv")
        self.sward("export", field, "-o", rows, "--force")
        with open(rows, encoding="ascii", newline="") as file:
            return list(csv.DictReader(file))

    def assert_same_as_the_export(self, field, table):
        """Numbers are the same to the last bits of single precision, texts exactly."""
        rows = self.export(field)
        self.assertEqual(list(rows[0]), list(table))
        self.assertEqual(len(rows), len(table["id"]))
        for name, values in table.items():
            if name in EXACT:
                self.assertEqual([int(row[name]) for row in rows], [int(v) for v in values], name)
            else:
                numpy.testing.assert_allclose(numpy.asarray(values, float),
                                              [float(row[name]) for row in rows],
                                              rtol=1e-6, atol=2e-6, err_msg=name)

    def test_every_blade_is_that_of_the_csv_export(self):
        field = self.bake("hills", "--count", "5000")
        self.assert_same_as_the_export(field, read_field.blades(read_field.read_field(field)))

    def test_up_vectors_of_all_directions_are_read(self):
        ball = self.bake("sphere", "--count", "4000", "--ground-up", "radial")
        table = read_field.blades(read_field.read_field(ball))
        self.assertLess(table["uy"].min(), -0.9)
        self.assert_same_as_the_export(ball, table)

    def test_a_far_origin_is_read(self):
        far = self.folder / "far.obj"
        far.write_text("v 900000 5 -700000\nv 900000 5 -699990\nv 900010 5 -700000\nf 1 2 3\n",
                       encoding="ascii")
        field = self.bake(far, "--count", "200")
        table = read_field.blades(read_field.read_field(field))
        self.assertGreater(table["x"].min(), 900000)
        rows = self.export(field)
        for axis in "xyz":
            numpy.testing.assert_allclose(table[axis], [float(row[axis]) for row in rows],
                                          rtol=0, atol=1e-5)

    def test_ground_and_images_are_read(self):
        path = self.bake(ROOT / "assets/meshes/landscape.glb", "--count", "100")
        field = read_field.read_field(path)
        info = self.info(path)
        vertices, indices = field["GVERTICE"], field["GINDICES"]
        self.assertGreater(len(vertices), 100)
        self.assertLess(indices.max(), len(vertices))
        self.assertEqual(field["GRANGES"]["count"].sum(), len(indices))
        pictures = read_field.images(field["GIMAGES"])
        used = [m["image"] for m in field["GMATERIA"] if m["image"] != 0xffffffff]
        self.assertTrue(used and max(used) < len(pictures))
        normals = read_field.octahedral(*(vertices["normal"].T.astype(float) / 32767))
        corners = vertices["position"][indices.reshape(-1, 3)].astype(float)
        faces = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        agrees = (faces * normals[indices[::3]]).sum(axis=1) > 0
        self.assertGreater(agrees.mean(), 0.95)
        self.assertEqual(info["blades"], 100)

    def test_the_page_names_every_key_of_the_texts(self):
        page = (ROOT / "docs/field_format.md").read_text(encoding="utf-8")
        field = read_field.read_field(self.bake("hills", "--count", "10"))
        defaults = field["DEFAULTS"]
        keys = {*field["SPECIES"][0], *defaults, *defaults["wind"], *defaults["gravity"],
                *field["PROVENAN"]} | {key for camera in defaults["cameras"] for key in camera}
        self.assertGreater(len(keys), 20)
        self.assertEqual([key for key in sorted(keys) if f"`{key}`" not in page], [])

    def test_the_command_writes_rows_and_refuses_what_is_damaged(self):
        field = self.bake("plane", "--count", "50")
        script = [sys.executable, str(ROOT / "examples/read_field.py")]
        subprocess.run([*script, field, self.folder / "rows.csv"], check=True)
        with open(self.folder / "rows.csv", encoding="ascii", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["id"] for row in rows], [row["id"] for row in self.export(field)])
        whole = field.read_bytes()
        for place in range(8, len(whole), max(1, len(whole) // 40)):
            broken = bytearray(whole)
            broken[place] ^= 1
            field.write_bytes(broken)
            with self.subTest(place=place), self.assertRaises(read_field.BadField):
                read_field.read_field(field)
        done = subprocess.run([*script, field], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn(field.name, done.stderr)


if __name__ == "__main__":
    unittest.main()
