"""The .ply and .usda exports, read back by code that is not the exporter's and held against the CSV,
and the command."""

import os
import subprocess
import sys
import unittest
from pathlib import Path

import numpy

sys.path.append(str(Path(__file__).resolve().parents[1]))

import node_readers
import ply_points
import usda_layer
from export_tables import ExportTest, PLACE_ERROR, front, linear, turned
from support import IO, PROGRAM, ROOT, UNSUPPORTED, USAGE

from needs import needs


class PlyExport(ExportTest):
    def check(self, field, place_error):
        path = self.export(field, "points.ply")
        points, _ = ply_points.read_points(path)
        table = self.table(field)
        points = points[numpy.argsort(points["id"])]
        for name, column in (("id", "id"), ("x", "x"), ("y", "y"), ("z", "z")):
            self.assert_near(points[name], table[column], place_error)
        for name, column in (("nx", "ux"), ("ny", "uy"), ("nz", "uz"), *((c, c) for c in (
                "facing", "height", "width", "stiffness", "exposure", "species", "clump"))):
            self.assert_near(points[name].astype(float), table[column], 1e-7 * 8)
        for name, column in (("red", "tint_r"), ("green", "tint_g"), ("blue", "tint_b")):
            self.assert_near(points[name] / 255.0, table[column], 0.5001 / 255)
        return path, table

    def test_ply_points_are_the_blades(self):
        self.check(self.bake("torus", "--count", "20000"), 1e-9)

    def test_open3d_reads_places_normals_and_colours(self):
        needs("open3d")
        import open3d
        for field in (self.bake("hills", "--count", "5000"), self.far_field()):
            with self.subTest(field=field.name):
                path, table = self.check(field, 2e-9)
                cloud = open3d.io.read_point_cloud(str(path))
                # Open3D keeps the order of the file, which is that of the field and of the CSV.
                rows = numpy.loadtxt(self.folder / "table.csv", delimiter=",", skiprows=1)
                self.assertEqual(len(rows), len(table["id"]))
                self.assert_near(numpy.asarray(cloud.points), rows[:, 1:4], 2e-9)
                self.assert_near(numpy.asarray(cloud.normals), rows[:, 4:7], 1e-6)
                self.assert_near(numpy.asarray(cloud.colors), rows[:, 13:16], 0.5001 / 255)

    def test_ply_without_blades_has_no_points(self):
        field = self.bake("plane", "--density", "1", "--altitude", "5:")
        points, lines = ply_points.read_points(self.export(field, "none.ply"))
        self.assertEqual(len(points), 0)
        self.assertIn("element vertex 0", lines)


class UsdaExport(ExportTest):
    def layer(self, field):
        return usda_layer.Layer(self.export(field, "field.usda").read_text(encoding="utf-8"))

    def check(self, field):
        layer = self.layer(field)
        self.assertEqual(usda_layer.complaints(layer), [])
        root = layer.prims["/Field"]
        groups = [prim for prim in root.children if prim.kind == "PointInstancer"]
        names = ("ids", "protoIndices", "primvars:stiffness", "primvars:exposure", "primvars:clump",
                 "orientations", "scales", "primvars:tint")
        found = {name: numpy.concatenate([group[name] for group in groups]) for name in names}
        found["places"] = numpy.concatenate(
            [root["xformOp:translate"] + group["xformOp:translate"] + group["positions"]
             for group in groups])
        table = self.table(field)
        order = numpy.argsort(found["ids"])
        found = {name: values[order] for name, values in found.items()}
        self.assertTrue(numpy.array_equal(found["ids"], table["id"].astype(numpy.int64)))
        self.assert_near(found["places"], self.columns(table, "x", "y", "z"), PLACE_ERROR)
        self.assert_near(found["scales"], self.scales(table), 1e-7)
        for name, column in (("protoIndices", "species"), ("primvars:stiffness", "stiffness"),
                             ("primvars:exposure", "exposure"), ("primvars:clump", "clump")):
            self.assert_near(found[name].astype(float), table[column], 1e-7)
        # Half precision: 2^-11 a component, twice that in an angle.
        up = self.columns(table, "ux", "uy", "uz")
        halves = found["orientations"].astype(float)[:, [1, 2, 3, 0]]
        halves /= numpy.linalg.norm(halves, axis=1, keepdims=True)
        self.assert_near(turned(halves, (0, 1, 0)), up, 1.5e-3)
        self.assert_near(turned(halves, (0, 0, 1)), front(up, table["facing"]), 1.5e-3)
        self.assert_near(found["primvars:tint"],
                         linear(self.columns(table, "tint_r", "tint_g", "tint_b")), 1e-5)
        return layer

    def test_usda_instances_are_the_blades(self):
        layer = self.check(self.bake("hills", "--count", "50000", "--sky-rays", "0"))
        kinds = [prim.kind for prim in layer.prims.values()]
        self.assertGreater(kinds.count("PointInstancer"), 1)

    def test_usda_places_far_away_keep_their_micrometres(self):
        self.check(self.far_field())

    def test_usda_of_a_planet(self):
        self.check(self.bake("sphere", "--count", "5000"))

    def test_tinyusdz_understands_it_as_it_is_meant(self):
        field = self.bake("hills", "--count", "10000", "--sky-rays", "0")
        self.check_by_tinyusdz(self.export(field, "field.usda"))
        few = self.bake("plane", "--count", "2000", "--sky-rays", "0", to="few.sward")
        self.check_by_tinyusdz(self.export(few, "compact.usda", "--compact"))

    def check_by_tinyusdz(self, path):
        text, meshes = node_readers.usd_text(path)
        self.assertEqual(meshes, 5, "the species of the default meadow")
        # Its own way of saying "in this layer".
        theirs = usda_layer.Layer(text.replace("@@<", "<"))
        ours = usda_layer.Layer(path.read_text(encoding="utf-8"))
        self.assertEqual(theirs.prims.keys(), ours.prims.keys())
        for prim in ours.prims.values():
            same = theirs.prims[prim.path]
            self.assertEqual((same.specifier, same.kind, same.interpolation),
                             (prim.specifier, prim.kind, prim.interpolation))
            for name, (kind, value) in prim.properties.items():
                # It loses digits of 64-bit integers when it writes them as text.
                if value is None or kind == "int64[]":
                    continue
                self.assertEqual(same.properties[name][0], kind, f"{prim.path} {name}")
                if isinstance(value, numpy.ndarray):
                    self.assertEqual(same[name].shape, value.shape)
                    # A half may be rounded to either side.
                    error = (1e-3, 1e-7) if kind == "quath[]" else (1e-6, 1e-9)
                    self.assertTrue(numpy.allclose(same[name], value, *error), name)
                else:
                    self.assertEqual(same[name], value, name)

    def test_tinyusdz_is_awake(self):
        path = self.export(self.bake("plane", "--count", "100"), "field.usda")
        text = path.read_text(encoding="utf-8")
        for old, new in (("quath[] orientations", "quatz[] orientations"),
                         ("positions = [(", "positions = [(1, 2), (")):
            with self.subTest(new=new):
                path.write_text(text.replace(old, new, 1), encoding="utf-8")
                self.assertIsNone(node_readers.usd_text(path))

    def test_usda_without_blades_has_prototypes_only(self):
        layer = self.layer(self.bake("plane", "--density", "1", "--altitude", "5:"))
        self.assertEqual(usda_layer.complaints(layer), [])
        self.assertNotIn("PointInstancer", [prim.kind for prim in layer.prims.values()])

    def test_the_check_of_the_schema_is_awake(self):
        text = self.export(self.bake("plane", "--count", "300"), "f.usda").read_text(encoding="utf-8")
        self.assertEqual(usda_layer.complaints(usda_layer.Layer(text)), [])
        group = "/Field/group_0/Prototypes/species_0"
        for old, new, reason in (
                ("int[] protoIndices = [", "int[] protoIndices = [7, ", "protoIndices"),
                ("point3f[] positions = [(", "point3f[] positions = [(999, 0, 0), (", "instances"),
                ("point3f[] positions", "float3[] positions", "positions is no point3f[]"),
                ("rel prototypes = [<" + group, "rel prototypes = [<" + group + "0", "does not exist"),
                ("</Field/Blades/species_0", "</Field/Blades/species_9", "does not exist"),
                ("interpolation = \"varying\"", "interpolation = \"constant\"", "not varying"),
                ("metersPerUnit = 1", "metersPerUnit = 0.01", "metersPerUnit"),
                ("faceVertexCounts = [3", "faceVertexCounts = [4", "do not sum"),
                ("quath[] orientations = [(", "quath[] orientations = [(9", "unit quaternions")):
            with self.subTest(reason=reason, new=new):
                self.assertIn(old, text)
                self.assertIn(reason, "\n".join(usda_layer.complaints(
                    usda_layer.Layer(text.replace(old, new, 1)))))
        for old, new in (("[(", "[(("), ("upAxis", "\"upAxis"), ("def Xform \"Field\"", "def Xform Field-1"),
                         ("int64[] ids = [", "int64[] ids = [1.5, "), ("#usda 1.0", "#usda 2.0"),
                         ("float3[] scales", "float7[] scales"), ("scales = [", "scales = [nan, ")):
            with self.subTest(new=new), self.assertRaises(ValueError):
                usda_layer.Layer(text.replace(old, new, 1))


class CompactUsda(ExportTest):
    """What docs/exports.md states of --compact."""

    TURN = numpy.radians(1.3)
    STRETCH = 0.0055  # with the rounding of a half
    SCALE = 0.5 / 99.0  # of the largest of the species in the group

    def layer(self, field, *options):
        path = self.export(field, "field.usda", "--compact", *options)
        layer = usda_layer.Layer(path.read_text(encoding="utf-8"))
        self.assertEqual(usda_layer.complaints(layer, length_error=self.STRETCH), [])
        return layer, path.stat().st_size

    def check(self, field):
        layer, _ = self.layer(field, "--with-ids")
        root = layer.prims["/Field"]
        groups = [prim for prim in root.children if prim.kind == "PointInstancer"]
        self.assertGreater(len(groups), 0)
        table = self.table(field)
        seen = 0
        for group in groups:
            rows = numpy.searchsorted(table["id"], group["ids"])
            self.assertTrue(numpy.array_equal(table["id"][rows], group["ids"]))
            seen += len(rows)
            own = {name: values[rows] for name, values in table.items()}
            unit = group["xformOp:scale"]
            extent = max(numpy.ptp(own[axis]) for axis in "xyz")
            place_error = (0.5 / 256.0 if extent <= 8.0 else 0.5 / 128.0) + 2e-6
            places = root["xformOp:translate"] + group["xformOp:translate"] + unit * group["positions"]
            self.assert_near(places, self.columns(own, "x", "y", "z"), place_error)
            # A prototype's scale applies before that of the instance, and the instancer's after it.
            steps = numpy.stack([layer.prims[path]["xformOp:scale"] for path in group["prototypes"]])
            species = group["protoIndices"]
            self.assertTrue(numpy.array_equal(species, own["species"].astype(int)))
            real = self.scales(own)
            largest = numpy.stack([numpy.max(real[species == s], axis=0, initial=0.0) for s in range(len(steps))])
            error = numpy.abs(unit * group["scales"] * steps[species] - real) / largest[species]
            self.assertLessEqual(error.max(), self.SCALE * 1.001)
            turns = group["orientations"].astype(float)[:, [1, 2, 3, 0]]
            turns /= numpy.linalg.norm(turns, axis=1, keepdims=True)
            up = self.columns(own, "ux", "uy", "uz")
            for axis, expected in (((0, 1, 0), up), ((0, 0, 1), front(up, own["facing"]))):
                chord = numpy.linalg.norm(turned(turns, axis) - expected, axis=1).max()
                self.assertLessEqual(2.0 * numpy.arcsin(chord / 2.0), self.TURN)
            for name in ("stiffness", "exposure", "clump"):
                self.assert_near(usda_layer.values_of(group, f"primvars:{name}").astype(float), own[name], 1e-7)
            self.assert_near(usda_layer.values_of(group, "primvars:tint"),
                             linear(self.columns(own, "tint_r", "tint_g", "tint_b")), 1e-5)
        self.assertEqual(seen, len(table["id"]))

    def test_blades_are_those_of_the_field(self):
        self.check(self.bake("hills", "--count", "20000"))

    def test_blades_of_a_planet(self):
        self.check(self.bake("sphere", "--count", "5000", "--sky-rays", "0"))

    def test_blades_far_away_stand_where_they_are(self):
        self.check(self.far_field())

    def test_a_blade_takes_less_than_60_bytes(self):
        field = self.bake(ROOT / "assets/meshes/landscape.glb", "--count", "60000", "--bare-names", "none",
                          "--sky-rays", "0")
        layer, size = self.layer(field)
        self.assertLessEqual(size, 60 * 60000)
        group = layer.prims["/Field/group_0"]
        self.assertFalse({"ids", "primvars:clump"} & group.properties.keys())


class ExportCommand(ExportTest):
    def test_nothing_is_overwritten_unasked(self):
        self.bake("plane", "--count", "50")
        for name in ("f.glb", "f.ply", "f.usda"):
            (self.folder / name).write_text("precious")
            self.refused("export", "field.sward", "-o", name, code=IO, names=[name, "--force"])
            self.assertEqual((self.folder / name).read_text(), "precious")

    def test_the_field_itself_is_never_overwritten(self):
        (self.folder / self.bake("plane", "--count", "50")).rename(self.folder / "field.ply")
        before = (self.folder / "field.ply").read_bytes()
        self.refused("export", "field.ply", "-o", "./field.ply", "--force", code=USAGE, names=["field.ply"])
        self.assertEqual((self.folder / "field.ply").read_bytes(), before)

    def test_only_a_glb_takes_the_ground_along(self):
        self.bake("plane", "--count", "50")
        for name in ("f.csv", "f.ply", "f.usda"):
            self.refused("export", "field.sward", "-o", name, "--with-ground", code=USAGE,
                         names=[name, "--with-ground", ".glb"])

    def test_a_missing_field_leaves_nothing(self):
        self.refused("export", "no.sward", "-o", "f.glb", code=IO, names=["no.sward"])
        self.refused("export", "no.sward", "-o", "f.gltf", code=UNSUPPORTED, names=[".gltf", ".glb"])

    def peak(self, *arguments):
        """Largest resident memory of a run [bytes]."""
        running = subprocess.Popen([str(PROGRAM), *map(str, arguments)], cwd=self.folder,
                                   stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(running.returncode, 0)
        return 1024 * usage.ru_maxrss

    def test_blades_are_streamed(self):
        field = self.bake("hills", "--count", "500000", "--sky-rays", "0")
        # Reading and verifying the field is what every command needs.
        reading = self.peak("validate", field)
        for name in ("f.csv", "f.glb", "f.ply", "f.usda"):
            with self.subTest(name=name):
                beyond = self.peak("export", field, "-o", name) - reading
                size = (self.folder / name).stat().st_size
                self.assertGreater(size, 34e6)
                self.assertLess(beyond, 24e6)


if __name__ == "__main__":
    unittest.main()
