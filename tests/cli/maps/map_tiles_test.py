"""3D Tiles of fields that lie on a map: every root where PROJ has it, in three kinds of projection."""

import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]
sys.path += [str(HERE), str(HERE / "export")]

import numpy

import gltf_instances
import node_readers
import tilesets
from export_tables import ExportTest, turned
from support import INPUT, PROGRAM, UNSUPPORTED, USAGE

from needs import needs

try:
    from osgeo import gdal, osr
    gdal.UseExceptions()
    osr.UseExceptions()
except ImportError:
    gdal = None

# Half a step of compact places along each axis, and the bend [m]; tiles wider than 8 km have larger steps.
ROOT_ERROR, WIDE_ERROR = 0.001, 0.003


def system(name):
    made = osr.SpatialReference()
    made.SetFromUserInput(name)
    made.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    return made


def degrees_of(name, places):
    change = osr.CoordinateTransformation(system(name), system("EPSG:4326"))
    return numpy.array(change.TransformPoints(places.tolist()))[:, :2]


def earth_centred(degrees, heights):
    """By PROJ: from longitude, latitude and height on WGS84 to EPSG:4978."""
    change = osr.CoordinateTransformation(system("EPSG:4979"), system("EPSG:4978"))
    return numpy.array(change.TransformPoints(numpy.column_stack([degrees, heights]).tolist()))


class MapTiles(ExportTest):
    @classmethod
    def setUpClass(cls):
        needs("gdal")
        super().setUpClass()

    def tif(self, name, epsg, west, north, step, side=65):
        y, x = numpy.mgrid[0:side, 0:side]
        heights = (300 + 80 * numpy.sin(x / 9) + 60 * numpy.cos(y / 7)).astype("f4")
        made = gdal.GetDriverByName("GTiff").Create(str(self.folder / name), side, side, 1, gdal.GDT_Float32)
        made.SetGeoTransform((west, step, 0, north, 0, -step))
        made.SetProjection(system(f"EPSG:{epsg}").ExportToWkt())
        made.GetRasterBand(1).WriteArray(heights)
        return name

    def placed(self, field, *options):
        """Earth-centred roots and blade axes of all leaves, and the rows of the CSV, by id."""
        self.sward("export", field, "-o", "tiles", "--tiles", "--with-ids", "--force", "-q", *options)
        tiles = tilesets.Tileset(self.folder / "tiles")
        ids, places, ups = [], [], []
        for tile in tiles.leaves():
            glb = gltf_instances.Glb(node_readers.unpacked(tiles.tiles[tile]))
            found = gltf_instances.instances(glb)
            low, high = tiles.box(tile)
            local = tilesets.z_up(found["place"])
            self.assertTrue(((local >= low - WIDE_ERROR) & (local <= high + WIDE_ERROR)).all(), "blades lie in their tiles")
            places.append(local @ tiles.transform[:3, :3].T + tiles.transform[:3, 3])
            ups.append(tilesets.z_up(turned(found["ROTATION"], (0, 1, 0))) @ tiles.transform[:3, :3].T)
            ids.append(found["id"][:, 0])
        order = numpy.argsort(numpy.concatenate(ids))
        table = self.table(field)
        self.assertTrue(numpy.array_equal(numpy.concatenate(ids)[order], table["id"].astype(numpy.uint64)))
        return numpy.concatenate(places)[order], numpy.concatenate(ups)[order], table

    def assert_on_earth(self, name, places, table, start=(0.0, 0.0), above=0.0, error=ROOT_ERROR):
        east_north = numpy.column_stack([table["x"] + start[0], -table["z"] + start[1]])
        expected = earth_centred(degrees_of(name, east_north), table["y"] + above)
        self.assertLess(float(numpy.linalg.norm(places - expected, axis=1).max()), error)
        return expected

    def test_roots_stand_where_the_map_has_them(self):
        # 19 km across in UTM, whose scale and north change, and in an equal-area projection, which also distorts.
        for epsg, west, north, step in ((32633, 430000, 5700000, 300), (3035, 3000000, 4200000, 300), (3413, 300000, -900000, 50)):
            with self.subTest(epsg=epsg):
                self.sward("bake", self.tif("a.tif", epsg, west, north, step), "--count", "1500", "--sky-rays", "0", "--align",
                           "vertical", "-o", "f.sward", "--force", "-q")
                self.assertEqual(json.loads(self.sward("info", "f.sward", "--json").stdout)["provenance"]["map_system"], f"EPSG:{epsg}")
                places, ups, table = self.placed("f.sward")
                expected = self.assert_on_earth(f"EPSG:{epsg}", places, table, error=WIDE_ERROR if step == 300 else ROOT_ERROR)
                # A level blade stands along the normal of the ellipsoid, to the steps of rotations.
                normals = expected / numpy.array([6378137.0 ** 2] * 2 + [6356752.314245 ** 2])
                normals /= numpy.linalg.norm(normals, axis=1)[:, None]
                level = table["uy"] > 0.9999
                self.assertGreater(level.sum(), 100)
                self.assertGreater(float((normals * ups).sum(axis=1)[level].min()), numpy.cos(numpy.radians(1.5)))
                self.assertLess(numpy.abs((normals * ups).sum(axis=1) - table["uy"])[~level].max(initial=0.0), 0.03)

    def test_the_projection_can_be_named_and_its_heights_shifted(self):
        field = self.bake(self.tif("a.tif", 25832, 560000, 5930000, 40), "--count", "800", "--sky-rays", "0")
        places, _, table = self.placed(field, "--crs", "EPSG:25832", "--geoid", "39.5")
        self.assert_on_earth("EPSG:25832", places, table, above=39.5)
        # Degrees are baked in a projection of their own, which the field tells.
        field = self.bake(self.tif("deg.tif", 4326, 9.9, 53.6, 1e-3), "--count", "800", "--sky-rays", "0", to="d.sward")
        baked = json.loads(self.sward("info", field, "--json").stdout)["provenance"]["map_system"]
        places, _, table = self.placed(field)
        self.assert_on_earth(baked, places, table)
        longitude, latitude = degrees_of(baked, numpy.column_stack([table["x"], -table["z"]])).T
        self.assertTrue((longitude > 9.89).all() and (longitude < 9.97).all() and (latitude > 53.53).all() and (latitude < 53.61).all())

    def test_ground_that_is_no_map_is_put_on_one(self):
        field = self.bake("hills", "--count", "1000", "--sky-rays", "0")
        places, _, table = self.placed(field, "--crs", "EPSG:27700", "--at", "-3.2,55.94,250")
        change = osr.CoordinateTransformation(system("EPSG:4326"), system("EPSG:27700"))
        self.assert_on_earth("EPSG:27700", places, table, change.TransformPoint(-3.2, 55.94)[:2], 250.0)

    def test_a_map_can_be_left_out(self):
        field = self.bake(self.tif("a.tif", 32633, 430000, 5700000, 10), "--count", "50")
        for options, turn in ((["--crs", "none"], numpy.eye(3)), (["--at", "15,51,0"], None)):
            self.sward("export", field, "-o", "t", "--tiles", "--force", *options)
            transform = tilesets.Tileset(self.folder / "t").transform
            if turn is not None:
                self.assertTrue(numpy.array_equal(transform[:3, :3], turn))
                origin = self.info(field)["origin"]
                self.assertEqual(transform[:3, 3].tolist(), [origin[0], -origin[2], origin[1]])

    def test_what_is_wrong_is_named(self):
        self.bake("plane", "--count", "20")
        self.sward("bake", self.tif("far.tif", 32633, 430000, 5700000, 10), "--count", "20", "-o", "far.sward")
        tiles = ["-o", "t", "--tiles"]
        for field, options, code, words in (
                ("field", [*tiles, "--crs", "EPSG:99999"], USAGE, ["--crs", "EPSG:99999", "no such coordinate system"]),
                ("field", [*tiles, "--crs", "/etc/passwd"], USAGE, ["--crs", "/etc/passwd", "EPSG:N"]),
                ("field", [*tiles, "--crs", "EPSG:4326"], USAGE, ["EPSG:4326", "WGS 84", "not in metres"]),
                ("field", [*tiles, "--crs", "EPSG:4978"], USAGE, ["EPSG:4978"]),
                ("field", [*tiles, "--crs", "EPSG:2263"], USAGE, ["EPSG:2263", "not in metres"]),
                ("field", [*tiles, "--crs", "EPSG:5555"], USAGE, ["EPSG:5555", "heights of its own"]),
                ("field", [*tiles, "--crs", "EPSG:2048"], USAGE, ["EPSG:2048", "to the west"]),
                ("field", [*tiles, "--crs", "EPSG:32633"], INPUT, ["middle of the field", "longitude 10.5", "zone 33N", "12 to 18"]),
                ("field", [*tiles, "--crs", "EPSG:32633", "--at", "2,50,0"], USAGE, ["--at", "longitude 2", "12 to 18"]),
                ("far", [*tiles, "--crs", "EPSG:27700"], INPUT, ["middle of the field", "British National Grid"]),
                ("field", [*tiles, "--geoid", "40"], USAGE, ["--geoid", "--crs"]),
                ("far", [*tiles, "--geoid", "400"], USAGE, ["--geoid", "200"]),
                ("far", [*tiles, "--geoid", "40", "--at", "1,2,3"], USAGE, ["--geoid", "--at"]),
                ("field", ["-o", "t.glb", "--crs", "EPSG:32633"], USAGE, ["--crs", "--tiles"])):
            with self.subTest(options=options):
                self.refused("export", f"{field}.sward", *options, code=code, names=words)
        # A copy of the program alone: nothing lies beside it.
        lone = self.folder / "alone/sward"
        lone.parent.mkdir()
        shutil.copy(PROGRAM, lone)
        for field, options, code in (("far", [], UNSUPPORTED), ("field", ["--crs", "EPSG:32633"], UNSUPPORTED), ("far", ["--crs", "none"], 0)):
            done = subprocess.run([lone, "export", f"{field}.sward", *tiles, *options], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, code, done.stderr)
            if code:
                self.assertIn("libsward_maps.so", done.stderr)


if __name__ == "__main__":
    unittest.main()
