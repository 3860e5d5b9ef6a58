"""Exports, read back by code that is not the exporter's and held against the CSV."""

import json
import os
import struct
import subprocess
import unittest

import numpy
import open3d

import gltf_instances
import gltf_validation
import ply_points
import usda_layer
from meshes import bumps, container, glb_bytes, square
from support import CliTest, IO, PROGRAM, UNSUPPORTED, USAGE

# A float of up to 64 m, the size of a group, rounds by half of this [m]; the CSV by 1e-9.
PLACE_ERROR = 4e-6


def front(up, facing):
    """Where a blade looks: by the basis of Duff et al., JCGT 2017, about its up-vector."""
    x, y, z = up.T
    s = numpy.where(z >= 0.0, 1.0, -1.0)
    a = -1.0 / (s + z)
    tangent = numpy.stack([1.0 + s * x * x * a, s * x * y * a, -s * x], axis=1)
    bitangent = numpy.stack([x * y * a, s + y * y * a, -y], axis=1)
    axis = tangent * numpy.cos(facing)[:, None] + bitangent * numpy.sin(facing)[:, None]
    return numpy.cross(up, axis)


def turned(quaternions, vector):
    """`vector` turned by unit quaternions x y z w."""
    u, w = quaternions[:, :3], quaternions[:, 3:]
    v = numpy.broadcast_to(numpy.array(vector, float), u.shape)
    return v + 2.0 * numpy.cross(u, numpy.cross(u, v) + w * v)


def linear(x):
    return numpy.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


class ExportTest(CliTest):
    def export(self, field, name, *options):
        self.sward("export", field, "-o", name, "--force", *options)
        return self.folder / name

    def table(self, field):
        """The CSV as columns, by id."""
        path = self.export(field, "table.csv")
        names = path.read_text(encoding="ascii").split("\n", 1)[0].split(",")
        rows = numpy.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
        rows = rows[numpy.argsort(rows[:, 0])]
        self.assertEqual(len(numpy.unique(rows[:, 0])), len(rows))
        return {name: rows[:, i] for i, name in enumerate(names)}

    @staticmethod
    def columns(table, *names):
        return numpy.stack([table[name] for name in names], axis=1)

    def assert_near(self, values, expected, error):
        self.assertEqual(values.shape, expected.shape)
        if len(values):
            self.assertLessEqual(float(numpy.abs(values - expected).max()), error)

    def far_field(self, *options):
        """Hills a thousand kilometres away."""
        (self.folder / "far.glb").write_bytes(
            glb_bytes(bumps(), node={"translation": [1e6 + 7.25, 250.5, -1e6 - 3.5]}))
        return self.bake("far.glb", "--count", "5000", *options, to="far.sward")


class GlbExport(ExportTest):
    def check(self, field, name="blades.glb"):
        """All instances of the file are the blades of the CSV."""
        glb = gltf_instances.Glb.read(self.export(field, name))
        self.assertEqual(gltf_instances.complaints(glb), [])
        table = self.table(field)
        found = gltf_instances.instances(glb)
        order = numpy.argsort(found["id"][:, 0])
        found = {key: values[order] for key, values in found.items()}
        self.assertTrue(numpy.array_equal(found["id"][:, 0], table["id"].astype(numpy.uint64)))
        self.assert_near(found["place"], self.columns(table, "x", "y", "z"), PLACE_ERROR)
        up = self.columns(table, "ux", "uy", "uz")
        self.assert_near(turned(found["ROTATION"], (0, 1, 0)), up, 2e-6)
        self.assert_near(turned(found["ROTATION"], (0, 0, 1)), front(up, table["facing"]), 4e-6)
        self.assert_near(found["SCALE"], self.columns(table, "width", "height", "height"), 1e-8)
        for attribute, column in (("_HEIGHT", "height"), ("_WIDTH", "width"),
                                  ("_STIFFNESS", "stiffness"), ("_EXPOSURE", "exposure"),
                                  ("_SPECIES", "species"), ("_CLUMP", "clump"),
                                  ("mesh", "species")):
            self.assert_near(found[attribute][:, 0], table[column], 1e-8)
        self.assert_near(found["_TINT"][:, :3], self.columns(table, "tint_r", "tint_g", "tint_b"),
                         0.5001 / 255)
        return glb

    def test_glb_instances_are_the_blades(self):
        glb = self.check(self.bake("hills", "--count", "150000", "--exposure", "0"))
        counts = {}
        for node, attributes in glb.instanced_nodes():
            group = tuple(node["translation"])
            counts[group] = counts.get(group, 0) + glb.json["accessors"][attributes["SCALE"]]["count"]
        self.assertGreater(len(counts), 4, "so many blades are more than one group")
        self.assertLessEqual(max(counts.values()), 32768)

    def test_blades_of_a_planet_stand_on_every_side(self):
        self.check(self.bake("sphere", "--count", "20000"))

    def test_glb_places_far_away_keep_their_micrometres(self):
        glb = self.check(self.far_field())
        root = glb.json["nodes"][glb.json["scenes"][0]["nodes"][0]]
        self.assertEqual(root["extras"]["origin_m"], root["translation"])
        self.assertTrue(all(x % 32 == 0 for x in root["translation"]))
        for node, _ in glb.instanced_nodes():
            origin, place = (numpy.array(n["translation"]) for n in (root, node))
            # A consumer in single precision adds them without error.
            single = origin.astype(numpy.float32) + place.astype(numpy.float32)
            self.assertTrue(numpy.array_equal(single.astype(float), origin + place))

    def test_blade_meshes_are_one_long_and_one_wide(self):
        glb = gltf_instances.Glb.read(self.export(self.bake("plane", "--count", "500"), "b.glb"))
        self.assertEqual(len(glb.json["meshes"]), 3, "the default meadow has three species")
        for mesh in glb.json["meshes"]:
            (primitive,) = mesh["primitives"]
            points = glb.numbers(primitive["attributes"]["POSITION"])
            self.assertTrue(numpy.array_equal(points[:2], [[-0.5, 0, 0], [0.5, 0, 0]]))
            centres = numpy.array([points[points[:, 1] == y].mean(axis=0) for y in sorted(set(points[:, 1]))])
            steps = numpy.linalg.norm(numpy.diff(centres, axis=0), axis=1)
            self.assertAlmostEqual(steps.sum(), 1.0, delta=0.01)
            material = glb.json["materials"][primitive["material"]]
            red, green, blue, _ = material["pbrMetallicRoughness"]["baseColorFactor"]
            self.assertGreater(green + red, 3 * blue, "grass is not blue")
            self.assertTrue(material["doubleSided"])

    def test_the_ground_comes_along_when_asked_for(self):
        field = self.bake("hills", "--count", "200")
        bare = gltf_instances.Glb.read(self.export(field, "bare.glb"))
        self.assertNotIn("ground", [node["name"] for node in bare.json["nodes"]])
        self.check(field)
        glb = gltf_instances.Glb.read(self.export(field, "ground.glb", "--with-ground"))
        self.assertEqual(gltf_instances.complaints(glb), [])
        (ground,) = [node for node in glb.json["nodes"] if node["name"] == "ground"]
        primitives = glb.json["meshes"][ground["mesh"]]["primitives"]
        triangles = sum(glb.json["accessors"][p["indices"]]["count"] for p in primitives) // 3
        self.assertEqual(triangles, self.info(field)["ground"]["triangles"])
        # The ground alone is ground again: the same triangles bear the same blades.
        self.sward("bake", "ground.glb", "--node", "ground", "--count", "200", "-o", "again.sward", "-q")

    def test_the_copyright_of_the_ground_passes_on(self):
        (self.folder / "g.glb").write_bytes(
            glb_bytes(square(4.0), document={"asset": {"version": "2.0", "copyright": "CC0 © Ä. \"B\""}}))
        glb = gltf_instances.Glb.read(self.export(self.bake("g.glb", "--count", "10"), "b.glb"))
        self.assertEqual(glb.json["asset"]["copyright"], "CC0 © Ä. \"B\"")
        self.assertEqual(glb.json["asset"]["generator"], "sward 0.1.0")

    def test_glb_without_blades_needs_no_extension(self):
        field = self.bake("plane", "--count", "50", "--altitude", "5:")
        glb = gltf_instances.Glb.read(self.export(field, "none.glb"))
        self.assertEqual(gltf_instances.complaints(glb), [])
        self.assertNotIn("extensionsUsed", glb.json)

    def test_khronos_validator_finds_nothing(self):
        field = self.bake("hills", "--count", "2000")
        empty = self.bake("plane", "--count", "50", "--altitude", "5:", to="none.sward")
        for path in (self.export(field, "blades.glb"), self.export(empty, "none.glb"),
                     self.export(field, "ground.glb", "--with-ground"),
                     self.export(self.far_field(), "far-blades.glb")):
            with self.subTest(path=path.name):
                found = gltf_validation.issues(path)
                codes = {message["code"] for message in found["messages"]}
                self.assertEqual((found["numErrors"], found["numWarnings"]), (0, 0), found["messages"])
                self.assertLessEqual(codes, gltf_validation.EXPECTED)

    def test_khronos_validator_is_awake(self):
        path = self.export(self.bake("plane", "--count", "50"), "blades.glb")
        glb = gltf_instances.Glb.read(path)
        glb.json["accessors"][0]["max"][1] += 1.0
        path.write_bytes(container(json.dumps(glb.json).encode(), glb.binary))
        self.assertGreater(gltf_validation.issues(path)["numErrors"], 0)

    def test_the_check_of_the_instancing_rules_is_awake(self):
        whole = self.export(self.bake("plane", "--count", "300"), "blades.glb").read_bytes()
        glb = gltf_instances.Glb(whole)
        node, attributes = next(glb.instanced_nodes())
        at = glb.json["nodes"].index(node)

        def accessor(json_, name):
            return json_["accessors"][attributes[name]]

        def put(glb_, name, kind, value):
            view = glb_.json["bufferViews"][accessor(glb_.json, name)["bufferView"]]
            changed = bytearray(glb_.binary)
            struct.pack_into(kind, changed, view["byteOffset"], value)
            glb_.binary = bytes(changed)

        extension = gltf_instances.EXTENSION
        broken = {
            "extensionsUsed": lambda g: g.json["extensionsUsed"].clear(),
            "extensionsRequired": lambda g: g.json.pop("extensionsRequired"),
            "has no mesh": lambda g: g.json["nodes"][at].pop("mesh"),
            "has no attributes": lambda g: g.json["nodes"][at]["extensions"][extension]["attributes"].clear(),
            "extension has no attributes": lambda g: g.json["nodes"][at]["extensions"][extension].clear(),
            "counts differ": lambda g: accessor(g.json, "SCALE").update(count=accessor(g.json, "SCALE")["count"] - 1),
            "TRANSLATION is a VEC4": lambda g: accessor(g.json, "TRANSLATION").update(type="VEC4"),
            "ROTATION is a VEC4 of 5121": lambda g: accessor(g.json, "ROTATION").update(componentType=5121),
            "ROTATION is a VEC4 of 5122": lambda g: accessor(g.json, "ROTATION").update(componentType=5122),
            "SCALE is a SCALAR": lambda g: accessor(g.json, "SCALE").update(type="SCALAR"),
            "unsigned integers of 32 bits": lambda g: accessor(g.json, "_CLUMP").update(componentType=5125),
            "not aligned": lambda g: accessor(g.json, "_CLUMP").update(componentType=5121),
            "does not fit": lambda g: accessor(g.json, "_CLUMP").update(type="VEC4"),
            "does not begin with an underscore": lambda g: g.json["nodes"][at]["extensions"][extension]
            ["attributes"].update(HEIGHT=attributes["_HEIGHT"]),
            "unit quaternion": lambda g: put(g, "ROTATION", "<f", 1.5),
            "not finite": lambda g: put(g, "_WIDTH", "<f", float("nan")),
            "SCALE is not positive": lambda g: put(g, "SCALE", "<f", 0.0),
            "min of TRANSLATION": lambda g: put(g, "TRANSLATION", "<f", -1000.0),
            "max of POSITION": lambda g: g.json["accessors"][0]["max"].__setitem__(1, 1.5),
            "no min and max": lambda g: g.json["accessors"][0].pop("min"),
            "longer than the binary": lambda g: g.json["buffers"][0].update(byteLength=1 << 30),
        }
        for reason, change in broken.items():
            with self.subTest(reason=reason):
                changed = gltf_instances.Glb(whole)
                self.assertEqual(gltf_instances.complaints(changed), [])
                change(changed)
                self.assertIn(reason, "\n".join(gltf_instances.complaints(changed)))


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
        field = self.bake("plane", "--count", "50", "--altitude", "5:")
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
        self.assert_near(found["scales"], self.columns(table, "width", "height", "height"), 1e-7)
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
        layer = self.check(self.bake("hills", "--count", "50000", "--exposure", "0"))
        kinds = [prim.kind for prim in layer.prims.values()]
        self.assertGreater(kinds.count("PointInstancer"), 1)

    def test_usda_places_far_away_keep_their_micrometres(self):
        self.check(self.far_field())

    def test_usda_of_a_planet(self):
        self.check(self.bake("sphere", "--count", "5000"))

    def test_usda_without_blades_has_prototypes_only(self):
        layer = self.layer(self.bake("plane", "--count", "50", "--altitude", "5:"))
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


class ExportCommand(ExportTest):
    def test_nothing_is_overwritten_unasked(self):
        self.bake("plane", "--count", "50")
        for name in ("f.glb", "f.ply", "f.usda"):
            (self.folder / name).write_text("precious")
            self.refused("export", "field.sward", "-o", name, code=IO, names=[name, "--force"])
            self.assertEqual((self.folder / name).read_text(), "precious")

    def test_the_field_itself_is_never_overwritten(self):
        self.bake("plane", "--count", "50", to="field.ply")
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
        field = self.bake("hills", "--count", "500000", "--exposure", "0")
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
