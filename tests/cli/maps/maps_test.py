"""Maps as ground, masks and excluded areas: GeoTIFF, GeoJSON and GeoPackage, written by GDAL's own Python."""

import json
import math
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import numpy as np

from support import CliTest, INPUT, IO, PROGRAM, UNSUPPORTED, USAGE, digest

from needs import needs

try:
    from osgeo import gdal, ogr, osr
    gdal.UseExceptions()
    ogr.UseExceptions()
except ImportError:
    gdal = None

EAST, NORTH, STEP, SIDE = 500000.0, 4649776.0, 2.0, 101
Y, X = np.mgrid[0:SIDE, 0:SIDE]
HEIGHTS = (300 + 10 * np.sin(X / 15) + 8 * np.cos(Y / 12)).astype("f4")
UTM = 32633


def height_at(east, north):
    """Bilinear between the samples, at pixel centres."""
    column = np.clip((east - EAST) / STEP - 0.5, 0, SIDE - 1)
    row = np.clip((NORTH - north) / STEP - 0.5, 0, SIDE - 1)
    i, j = np.minimum(np.floor([column, row]).astype(int), SIDE - 2)
    a, b = column - i, row - j
    h = HEIGHTS
    return (1 - b) * ((1 - a) * h[j, i] + a * h[j, i + 1]) + b * ((1 - a) * h[j + 1, i] + a * h[j + 1, i + 1])


def bow_tie(at, side):
    """An outline that crosses itself, `at` metres east and south of the corner."""
    a, b, c, d = EAST + at, EAST + at + side, NORTH - at, NORTH - at - side
    return f"POLYGON(({a} {c},{b} {d},{b} {c},{a} {d},{a} {c}))"


class Maps(CliTest):
    @classmethod
    def setUpClass(cls):
        needs("gdal")
        super().setUpClass()

    def tif(self, name, values, place=(EAST, STEP, 0, NORTH, 0, -STEP), epsg=UTM, kind="Float32", no_data=None,
            scale=None, offset=None, unit=None, options=()):
        bands = values if values.ndim == 3 else values[None]
        made = gdal.GetDriverByName("GTiff").Create(str(self.folder / name), bands.shape[2], bands.shape[1], len(bands), getattr(gdal, f"GDT_{kind}"),
                                                    options=list(options))
        if place:
            made.SetGeoTransform(place)
        if epsg:
            system = osr.SpatialReference()
            system.ImportFromEPSG(epsg)
            made.SetProjection(system.ExportToWkt())
        for number, one in enumerate(bands, 1):
            band = made.GetRasterBand(number)
            if no_data is not None:
                band.SetNoDataValue(no_data)
            if scale is not None:
                band.SetScale(scale)
                band.SetOffset(offset)
            if unit:
                band.SetUnitType(unit)
            band.WriteArray(one)
        made = None
        return name

    def rows(self, *options, code=0):
        self.sward("bake", *options, "--count", "1500", "-o", "f.sward", "--force", "-q", code=code)
        self.sward("export", "f.sward", "-o", "f.csv", "--force", "-q")
        return np.genfromtxt(self.folder / "f.csv", delimiter=",", names=True)

    def assert_on_heights(self, rows, delta):
        np.testing.assert_allclose(rows["y"], height_at(rows["x"], -rows["z"]), atol=delta)

    def test_heights_lie_where_the_map_has_them(self):
        rows = self.rows(self.tif("a.tif", HEIGHTS))
        # A cell is two triangles: the surface differs from a bilinear one by a fourth of its twist.
        self.assert_on_heights(rows, 0.03)
        self.assertGreater(rows["x"].min(), EAST)
        self.assertLess(rows["x"].max(), EAST + SIDE * STEP)
        self.assertGreater(-rows["z"].min(), NORTH - SIDE * STEP)

    def test_any_storage_of_the_same_heights_is_the_same_ground(self):
        whole = digest(self.folder / self.bake(self.tif("a.tif", HEIGHTS), "--count", "500"))
        for options in (("TILED=YES", "COMPRESS=DEFLATE", "PREDICTOR=3"), ("BIGTIFF=YES", "COMPRESS=LZW"), ("ENDIANNESS=BIG",)):
            self.tif("b.tif", HEIGHTS, options=options)
            (self.folder / "a.tif").write_bytes((self.folder / "b.tif").read_bytes())
            self.assertEqual(digest(self.bake("a.tif", "--count", "500", "--force")), whole, options)
        # South up, and turned by a quarter: the same places by another order of samples.
        flipped = self.tif("c.tif", HEIGHTS[::-1].copy(), place=(EAST, STEP, 0, NORTH - SIDE * STEP, 0, STEP))
        self.assert_on_heights(self.rows(flipped), 0.03)
        turned = self.tif("d.tif", HEIGHTS.T.copy(), place=(EAST, 0, STEP, NORTH, -STEP, 0))
        self.assert_on_heights(self.rows(turned), 0.03)

    def test_integers_with_scale_and_offset_feet_and_missing_samples(self):
        whole = np.round((HEIGHTS - 300) * 100).astype("i2")
        self.assert_on_heights(self.rows(self.tif("i.tif", whole, kind="Int16", scale=0.01, offset=300.0)), 0.04)
        for unit, metres in (("ft", 0.3048), ("Centimetre", 0.01)):
            self.assert_on_heights(self.rows(self.tif("ft.tif", HEIGHTS / metres, unit=unit)), 0.03)
        self.tif("odd.tif", HEIGHTS, unit="furlong")
        self.assertIn('odd.tif: its heights are in "furlong"', self.sward("bake", "odd.tif", "--count", "9", "-o", "x.sward").stderr)
        self.tif("nan.tif", HEIGHTS, scale=math.nan, offset=3)
        self.refused("bake", "nan.tif", "--count", "9", "-o", "y.sward", code=INPUT, names=("nan.tif", "the scale nan and the offset 3"))
        holed = HEIGHTS.copy()
        holed[:, :50] = -7
        rows = self.rows(self.tif("hole.tif", holed, no_data=-7))
        self.assertGreater(rows["x"].min(), EAST + 50 * STEP)
        self.assert_on_heights(rows, 0.03)

    def test_degrees_become_metres_around_the_middle(self):
        # Squares of a thousandth of a degree at 60° north are half as wide as high.
        d = 1e-4
        wide, high = SIDE * d * 111_412.84 * math.cos(math.radians(60.0 - SIDE * d / 2)), SIDE * d * 111_412.24
        # The second and the third lie across 180°.
        for west in (180.0 - SIDE * d / 3, SIDE * d / 3 - 360.0, 25.0):
            rows = self.rows(self.tif("deg.tif", HEIGHTS, place=(west, d, 0, 60.0, 0, -d), epsg=4326))
            self.assertAlmostEqual(np.ptp(rows["x"]), wide, delta=0.03 * wide)
            self.assertAlmostEqual(np.ptp(rows["z"]), high, delta=0.03 * high)
            self.assertLess(abs(rows["x"].mean()), 0.05 * wide)
        self.tif("feet.tif", HEIGHTS, place=(6e6, 3, 0, 2.1e6, 0, -3), epsg=2227)
        said = self.sward("bake", "feet.tif", "--count", "5", "-o", "y.sward").stderr
        self.assertRegex(said, r"feet.tif: .*ftUS.* at its middle, longitude -122\.\d{6}, latitude 37\.\d{6}")
        self.assertIn("not in metres", self.sward("bake", "deg.tif", "--count", "5", "-o", "x.sward").stderr)

    def test_maps_are_joined_in_the_system_of_the_first(self):
        self.tif("a.tif", HEIGHTS)
        systems = []
        for epsg in (UTM, 4326):
            systems.append(osr.SpatialReference())
            systems[-1].ImportFromEPSG(epsg)
            systems[-1].SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        longitude, latitude = osr.CoordinateTransformation(*systems).TransformPoint(EAST + 250, NORTH)[:2]
        self.tif("deg.tif", np.full_like(HEIGHTS, 5), place=(longitude, 2e-5, 0, latitude, 0, -2e-5), epsg=4326)
        rows = self.rows("a.tif", "deg.tif")
        second = rows["y"] < 100
        self.assertGreater(second.sum(), 300)
        self.assert_on_heights(rows[~second], 0.03)
        self.assertGreater(rows["x"][second].min(), EAST + 249)
        self.assertLess(rows["x"][second].max(), EAST + 250 + 2e-5 * SIDE * 111_320)
        self.assertLess(-rows["z"][second].max(), NORTH - 0.9 * 2e-5 * SIDE * 111_050)
        self.tif("bare.tif", HEIGHTS, epsg=None)
        for order in (("a.tif", "bare.tif"), ("bare.tif", "a.tif"), ("a.tif", "--occluder", "bare.tif")):
            self.refused("bake", *order, "--count", "10", "-o", "x.sward", code=INPUT, names=("bare.tif", "names no coordinate system", "-a_srs"))
        self.tif("b.tif", HEIGHTS)
        said = self.sward("bake", "a.tif", "b.tif", "--count", "10", "-o", "x.sward").stderr
        self.assertIn("lie on one another over 200 x 200 m: grass grows on both", said)

    def test_land_cover_is_a_mask_by_its_classes(self):
        cover = np.where(X < 50, 30, np.where(Y < 50, 40, 10)).astype("u1")
        self.tif("cover.tif", cover, kind="Byte")
        rows = self.rows(self.tif("a.tif", HEIGHTS), "--mask", "raster:cover.tif:30,40")
        column, row = (rows["x"] - EAST) / STEP, (NORTH + rows["z"]) / STEP
        self.assertTrue(((column < 50) | (row < 50)).all())
        self.assertTrue(((column > 50) & (row < 50)).any())
        inverse = self.rows("a.tif", "--mask", "raster:cover.tif:30,40:invert")
        self.assertTrue((((inverse["x"] - EAST) / STEP > 50) & ((NORTH + inverse["z"]) / STEP > 50)).all())
        # Nothing grows without data and beyond the map's edge, inverted or not.
        self.tif("part.tif", np.where(X < 30, 10, cover)[:80].astype("u1"), kind="Byte", no_data=10)
        inverse = self.rows("a.tif", "--mask", "raster:part.tif:40:invert")
        column, row = (inverse["x"] - EAST) / STEP, (NORTH + inverse["z"]) / STEP
        self.assertTrue(((column >= 30) & (column <= 50) & (row <= 80)).all())
        # Classes are compared as the file has them.
        self.tif("long.tif", np.where(X < 50, 2 ** 24, 2 ** 24 + 1).astype("u4"), kind="UInt32")
        self.assertTrue(((self.rows("a.tif", "--mask", "raster:long.tif:16777217")["x"] - EAST) / STEP > 49.9).all())
        self.tif("share.tif", np.where(X < 50, 0.3, 0.4))
        self.assertTrue(((self.rows("a.tif", "--mask", "raster:share.tif:0.3")["x"] - EAST) / STEP < 50.1).all())
        self.refused("bake", "a.tif", "--mask", "raster:share.tif:16777217", "--count", "9", "-o", "x.sward", code=INPUT, names=("share.tif", "class 16777217", "2^24"))
        # In degrees, as land cover of a continent is: brought to the ground's system.
        gdal.Warp(str(self.folder / "wgs.tif"), str(self.folder / "cover.tif"), dstSRS="EPSG:4326", xRes=1e-5, yRes=1e-5, dstNodata=0)
        there = self.rows("a.tif", "--mask", "raster:wgs.tif:30,40")
        inside = ((there["x"] - EAST) / STEP < 51) | ((NORTH + there["z"]) / STEP < 51)
        self.assertTrue(inside.all())

    def test_a_band_of_numbers_is_a_density(self):
        canopy = np.stack([np.zeros_like(HEIGHTS), np.tile(np.linspace(0, 60, SIDE, dtype="f4"), (SIDE, 1))])
        self.tif("canopy.tif", canopy)
        self.tif("a.tif", np.full_like(HEIGHTS, 5))
        self.sward("bake", "a.tif", "--density", "2", "--mask", "raster:canopy.tif:b2:0..60", "-o", "f.sward", "-q")
        self.sward("export", "f.sward", "-o", "f.csv", "-q")
        rows = np.genfromtxt(self.folder / "f.csv", delimiter=",", names=True)
        share = (rows["x"] - EAST - STEP / 2) / (STEP * (SIDE - 1))
        # Linear in x: the mean of x is 2/3, half of the blades lie beyond √½; of 40 000 candidates.
        self.assertAlmostEqual(share.mean(), 2 / 3, delta=0.01)
        self.assertAlmostEqual(np.mean(share > math.sqrt(0.5)), 0.5, delta=0.015)
        self.assertAlmostEqual(len(rows), (STEP * (SIDE - 1)) ** 2, delta=0.02 * (STEP * (SIDE - 1)) ** 2)

    def shapes(self, name, driver, epsg=UTM):
        system = osr.SpatialReference()
        system.ImportFromEPSG(epsg)
        system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        utm = osr.SpatialReference()
        utm.ImportFromEPSG(UTM)
        utm.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        made = ogr.GetDriverByName(driver).CreateDataSource(str(self.folder / name))
        layer = made.CreateLayer("paths", system, ogr.wkbUnknown)
        for text in (f"POLYGON(({EAST + 50} {NORTH - 50},{EAST + 150} {NORTH - 50},{EAST + 150} {NORTH - 150},"
                     f"{EAST + 50} {NORTH - 150},{EAST + 50} {NORTH - 50}),({EAST + 80} {NORTH - 80},{EAST + 80} {NORTH - 120},"
                     f"{EAST + 120} {NORTH - 120},{EAST + 120} {NORTH - 80},{EAST + 80} {NORTH - 80}))",
                     f"LINESTRING({EAST} {NORTH - 20},{EAST + 200} {NORTH - 20})", bow_tie(160, 30)):
            shape = ogr.CreateGeometryFromWkt(text)
            shape.AssignSpatialReference(utm)
            shape.TransformTo(system)
            feature = ogr.Feature(layer.GetLayerDefn())
            feature.SetGeometry(shape)
            layer.CreateFeature(feature)
        if driver == "GPKG":  # QGIS stores styles beside the areas, in a table without a system
            made.CreateLayer("layer_styles", None, ogr.wkbNone)
        made = None
        return name

    def many(self, name, driver):
        """A layer "areas" of 400 squares, larger than some pages of a database."""
        system = osr.SpatialReference()
        system.ImportFromEPSG(UTM)
        made = ogr.GetDriverByName(driver).CreateDataSource(str(self.folder / name))
        layer = made.CreateLayer("areas", system, ogr.wkbPolygon)
        for i in range(400):
            feature = ogr.Feature(layer.GetLayerDefn())
            feature.SetGeometry(ogr.CreateGeometryFromWkt(f"POINT({EAST + i % 20} {NORTH - i // 20})").Buffer(0.3))
            layer.CreateFeature(feature)
        layer = made = None
        return self.folder / name

    def geojson(self, name, *shapes, system=f"urn:ogc:def:crs:EPSG::{UTM}"):
        crs = {"crs": {"type": "name", "properties": {"name": system}}} if system else {}
        self.write_json(name, {"type": "FeatureCollection", **crs, "features": [
            {"type": "Feature", "properties": {}, "geometry": json.loads(ogr.CreateGeometryFromWkt(shape).ExportToJson())} for shape in shapes]})
        return name

    def test_areas_and_paths_are_excluded_with_a_margin(self):
        self.tif("a.tif", HEIGHTS)
        whole = None
        for name, driver, epsg in (("p.gpkg", "GPKG", UTM), ("p.geojson", "GeoJSON", 4326)):
            rows = self.rows("a.tif", "--exclude", f"{self.shapes(name, driver, epsg)}:margin 3")
            east, south = rows["x"] - EAST, NORTH + rows["z"]
            ring = (abs(east - 100) < 52.9) & (abs(south - 100) < 52.9) & ~((abs(east - 100) < 17.1) & (abs(south - 100) < 17.1))
            self.assertFalse(ring.any(), name)
            self.assertFalse((abs(south - 20) < 2.9).any(), name)
            self.assertFalse(((abs(south - 175) < abs(east - 175)) & (abs(east - 175) < 17)).any(), "both halves of an outline that crosses itself")
            self.assertTrue(((abs(east - 100) < 16) & (abs(south - 100) < 16)).any(), "the hole grows")
            self.assertTrue(((abs(south - 20) > 3.1) & (abs(south - 20) < 6)).any(), "beside the path grows grass")
            whole = len(rows) if whole is None else whole
        self.assertIn("margin", self.sward("bake", "a.tif", "--exclude", "p.gpkg", "-o", "x.sward", code=INPUT).stderr)

    def tiles(self, tiles, *options):
        """The field of a bake in tiles, and what the plan says."""
        said = self.sward("plan", *options, "--tiles", tiles, "-o", "plan.json", "--force")
        shutil.rmtree(self.folder / "parts", ignore_errors=True)
        for index in range(tiles):
            self.sward("tile", "plan.json", "--index", index, "-o", "parts", "-q")
        self.sward("merge", "plan.json", "parts", "-o", "t.sward", "--force", "-q")
        return said

    def test_tiles_read_their_windows_and_are_the_whole(self):
        """Tiles read the file, not a copy of the ground, and have the bytes of one bake."""
        d = 2e-5
        degrees = {"place": (25.0, d, 0, 60.0, 0, -d), "epsg": 4326}
        turned = (EAST, 0.8 * STEP, 0.6 * STEP, NORTH, 0.6 * STEP, -0.8 * STEP)
        holed = HEIGHTS.copy()
        holed[40:60, 30:70] = holed[::9, ::7] = holed[:, :20] = -9999
        self.tif("deg.tif", HEIGHTS, **degrees)
        self.tif("turned.tif", HEIGHTS, place=turned)
        self.tif("holed.tif", holed, no_data=-9999, options=("TILED=YES", "COMPRESS=DEFLATE", "BLOCKXSIZE=32", "BLOCKYSIZE=16"))
        self.tif("whole.tif", np.round((HEIGHTS - 300) * 100).astype("i2"), kind="Int16", scale=0.01, offset=300.0, options=("BIGTIFF=YES",))
        self.tif("cover.tif", np.where((X // 10 + Y // 10) % 2, 1, 0).astype("u1"), **degrees, kind="Byte")
        # A mask under a part of the ground: most tiles do not meet it.
        corner = self.tif("corner.tif", np.full((30, 25), 7, "u1"), place=(EAST + 5, STEP, 0, NORTH - 9, 0, -STEP), kind="Byte")
        canopy = self.tif("canopy.tif", np.tile(np.linspace(0, 60, SIDE, dtype="f4"), (SIDE, 1)), place=(EAST - 3, 2.3, 0, NORTH + 5, 0, -2.3))
        for options in (("deg.tif", "--density", "2", "--mask", "raster:cover.tif:1"), ("turned.tif", "--density", "1"),
                        ("holed.tif", "--density", "2", "--mask", f"raster:{corner}:7"),
                        ("holed.tif", "--spacing", "0.9", "--mask", f"raster:{canopy}:0..60"), ("holed.tif", "--density", "3", "--height", "0:2"),
                        ("whole.tif", "--density", "40", "--seeds", "always", "--budget", "20000")):
            with self.subTest(options):
                whole = digest(self.bake(*options, "--force"))
                self.tiles(3, *options)
                self.assertEqual(digest(self.folder / "t.sward"), whole)
                self.assertLess(sum(one.stat().st_size for one in self.folder.glob("plan.parts/part-*")), 30000)

    def test_a_map_that_changed_after_the_plan_is_refused(self):
        self.tif("a.tif", HEIGHTS)
        self.tif("cover.tif", np.full((9, 9), 30, "u1"), place=(EAST, 30, 0, NORTH, 0, -30), kind="Byte")
        self.many("areas.shp", "ESRI Shapefile")
        self.sward("plan", "a.tif", "--density", "0.1", "--mask", "raster:cover.tif:30", "--exclude", "areas.shp:1", "--tiles", 2, "-o", "plan.json", "-q")
        for name in ("cover.tif", "areas.shp", "areas.prj"):
            before = (self.folder / name).read_bytes()
            (self.folder / name).write_bytes(before[:-1] + bytes([before[-1] ^ 1]) if name != "areas.prj" else before.replace(b"33", b"32"))
            self.refused("tile", "plan.json", "--index", "0", "-o", "parts", code=INPUT,
                         leaves=["parts"], names=[name.replace("prj", "shp") + ": has changed", "plan.json"])
            (self.folder / name).write_bytes(before)
        self.sward("tile", "plan.json", "--index", "0", "-o", "parts")

    def test_a_map_beyond_one_ground_is_baked_by_windows(self):
        """A ground of 20 million samples, most of them missing, has the blades of the rest alone."""
        wide, high, at = 5000, 4000, (3333, 2100)
        place = (EAST, STEP, 0, NORTH, 0, -STEP)
        large = gdal.GetDriverByName("GTiff").Create(str(self.folder / "large.tif"), wide, high, 1, gdal.GDT_Float32,
                                                     options=["SPARSE_OK=YES", "TILED=YES", "COMPRESS=DEFLATE"])
        large.SetGeoTransform(place)
        system = osr.SpatialReference()
        system.ImportFromEPSG(UTM)
        large.SetProjection(system.ExportToWkt())
        large.GetRasterBand(1).SetNoDataValue(0)
        large.GetRasterBand(1).WriteArray(HEIGHTS, *at)
        large = None
        self.tif("part.tif", HEIGHTS, place=(EAST + at[0] * STEP, STEP, 0, NORTH - at[1] * STEP, 0, -STEP))
        said = self.sward("bake", "large.tif", "-o", "x.sward", code=UNSUPPORTED).stderr
        for word in ("20000000 samples", "sward plan --tiles", "window by window", "gdal_translate"):
            self.assertIn(word, said)
        # A mask as large as the ground is read by windows, too.
        shutil.copy(self.folder / "large.tif", self.folder / "mask.tif")
        options = ("--density", "4", "--mask", "raster:mask.tif:300..320")
        said = self.tiles(4, "large.tif", *options).stderr
        self.assertIn("shows one sample of 3", said)
        self.sward("export", "t.sward", "-o", "t.csv", "--force", "-q")
        self.bake("part.tif", *options, "--force")
        self.sward("export", "field.sward", "-o", "w.csv", "--force", "-q")
        one, many = (sorted((self.folder / name).read_text().splitlines()[1:]) for name in ("w.csv", "t.csv"))
        self.assertGreater(len(one), 10000)
        self.assertEqual(len(one), len(many))
        for a, b in zip(one, many):
            a, b = a.split(","), b.split(",")
            self.assertEqual(a[0], b[0])
            np.testing.assert_allclose([float(x) for x in a[1:4]], [float(x) for x in b[1:4]], atol=2e-3)
        # No root is hidden under the shown ground.
        ground = json.loads(self.sward("info", "t.sward", "--json").stdout)
        self.assertGreater(ground["ground"]["triangles"], 1000)
        self.refused("plan", "large.tif", "--tiles", "4", "--count", "9", "-o", "p.json", code=UNSUPPORTED, names=("large.tif", "--count"))
        self.refused("plan", "large.tif", "--tiles", "4", "--scale", "2", "-o", "p.json", code=USAGE, names=("large.tif", "--scale would move it"))
        # A file that changes after the plan is noticed.
        changed = gdal.Open(str(self.folder / "large.tif"), gdal.GA_Update)
        changed.GetRasterBand(1).WriteArray(HEIGHTS + 1, *at)
        changed = None
        shutil.rmtree(self.folder / "parts")
        said = [subprocess.run([PROGRAM, "tile", "plan.json", "--index", str(i), "-o", "parts", "-q"], cwd=self.folder, capture_output=True,
                               text=True) for i in range(4)]
        self.assertIn(INPUT, {one.returncode for one in said})
        self.assertIn("plan again", "".join(one.stderr for one in said))

    def test_a_tile_refuses_a_map_that_changed(self):
        """Each height counts, to the last row and column, and where the file lies."""
        self.tif("a.tif", HEIGHTS)
        self.tiles(2, "a.tif", "--density", "0.01")
        east, south = HEIGHTS.copy(), HEIGHTS.copy()
        east[50, -1] += 1
        south[-1, 50] += 1
        for heights, changes, tiles, words in (
                (HEIGHTS, {"place": (EAST + 1000, STEP, 0, NORTH, 0, -STEP)}, 2, ("its middle lies at east 501101", "500101")),
                (HEIGHTS, {"place": (EAST, STEP, 0, NORTH, 0, -1.5 * STEP)}, 2, ("is 200 x 300 m", "was 200 x 200")),
                (HEIGHTS, {"epsg": 32632}, 2, ("names EPSG:32632", "named EPSG:32633")), (HEIGHTS, {"epsg": None}, 2, ("no coordinate system",)),
                (HEIGHTS[:-1], {}, 2, ("101 x 100 samples", "had 101 x 101")),
                (east, {}, 1, ("columns 96 to 100",)), (south, {}, 1, ("rows 96 to 100",))):
            with self.subTest(words):
                self.tif("a.tif", heights, **changes)
                said = [subprocess.run([PROGRAM, "tile", "plan.json", "--index", str(i), "-o", "parts", "-q", "--force"], cwd=self.folder,
                                       capture_output=True, text=True) for i in range(2)]
                refused = [one.stderr for one in said if one.returncode == INPUT]
                self.assertGreaterEqual(len(refused), tiles)
                for word in ("a.tif", "not the map that the plan was made of", *words):
                    self.assertIn(word, refused[0])

    def test_what_is_wrong_is_named(self):
        self.tif("a.tif", HEIGHTS)
        self.tif("bare.tif", HEIGHTS, epsg=None)
        self.tif("nowhere.tif", HEIGHTS, place=None, epsg=None)
        self.tif("far.tif", HEIGHTS, place=(900000, STEP, 0, NORTH, 0, -STEP))
        self.tif("complex.tif", HEIGHTS, kind="CFloat32")
        self.tif("large.tif", np.zeros((2, 2), "u1"), kind="Byte")
        gdal.GetDriverByName("GTiff").Create(str(self.folder / "huge.tif"), 30000, 30000, 1, gdal.GDT_Byte,
                                             options=["SPARSE_OK=YES", "COMPRESS=DEFLATE"]).SetGeoTransform((0, 1, 0, 0, 0, -1))
        (self.folder / "cut.tif").write_bytes((self.folder / "a.tif").read_bytes()[:4000])
        (self.folder / "text.tif").write_text("no map")
        (self.folder / "text.geojson").write_text("{}")
        # A page of the database is overwritten; half of the shapes are missing.
        database = self.many("torn.gpkg", "GPKG")
        pages = database.read_bytes()
        torn = max(at for at in range(0, len(pages), 4096) if pages[at] == 13 and b"GP\0" in pages[at:at + 4096])
        database.write_bytes(pages[:torn] + b"\xaa" * 4096 + pages[torn + 4096:])
        shapefile = self.many("half.shp", "ESRI Shapefile")
        shapefile.write_bytes(shapefile.read_bytes()[:shapefile.stat().st_size // 2])
        self.geojson("mixed.geojson", f"GEOMETRYCOLLECTION({bow_tie(9, 9)},POINT({EAST} {NORTH}))")
        self.geojson("unknown.geojson", bow_tie(9, 9), system="urn:ogc:def:crs:EPSG::99999")
        self.geojson("metres.geojson", bow_tie(9, 9), system=None)
        cases = [(("cut.tif",), INPUT, ("cut.tif", "damaged or truncated")), (("text.tif",), INPUT, ("text.tif", "GeoTIFF")),
                 (("none.tif",), IO, ("none.tif",)), (("huge.tif",), UNSUPPORTED, ("900000000 samples", "17000000", "sward plan --tiles 300", "gdal_translate")),
                 (("complex.tif",), UNSUPPORTED, ("complex",)),
                 (("a.tif", "--mask", "raster:bare.tif"), INPUT, ("bare.tif", "no coordinate system", "gdal_edit.py -a_srs")),
                 (("a.tif", "--mask", "raster:nowhere.tif"), INPUT, ("nowhere.tif", "no geotransform")),
                 (("a.tif", "--mask", "raster:far.tif"), INPUT, ("far.tif", "east 900000 to 900202", "do not meet")),
                 (("a.tif", "--mask", "raster:a.tif:b2"), INPUT, ("a.tif", "1 bands", "number 2")),
                 (("a.tif", "--mask", "raster:none.tif:3"), IO, ("none.tif",)),
                 (("a.tif", "--exclude", "none.gpkg"), IO, ("none.gpkg",)),
                 (("a.tif", "--exclude", "text.geojson"), INPUT, ("text.geojson",)),
                 *((("a.tif", *option), USAGE, ("a.tif", f"{option[0]} would move it")) for option in
                   (("--extent", "50", "50"), ("--flip-rows",), ("--up-axis", "z"), ("--units", "cm"), ("--scale", "2"))),
                 ((self.tif("round.tif", HEIGHTS, epsg=4978),), INPUT, ("round.tif", "WGS 84", "geocentric")),
                 (("a.tif", "--exclude", "torn.gpkg:1"), INPUT, ("torn.gpkg", "damaged", '"areas"')),
                 (("a.tif", "--exclude", "half.shp"), INPUT, ("half.shp", "damaged", "first 19")),
                 (("a.tif", "--exclude", "mixed.geojson"), INPUT, ("mixed.geojson", "feature 0", "a point", "margin M")),
                 (("a.tif", "--exclude", "unknown.geojson"), INPUT, ("unknown.geojson", "coordinate system that is not known")),
                 (("a.tif", "--exclude", "metres.geojson"), INPUT, ("metres.geojson", "500009 to 500018", "in WGS 84 (degrees", "UTM zone 33N")),
                 (("plane", "--exclude", self.shapes("deg.geojson", "GeoJSON", 4326) + ":1"), INPUT, ("deg.geojson", "not in metres"))]
        for options, code, names in cases:
            with self.subTest(options):
                self.refused("bake", *options, "--count", "10", "-o", "x.sward", code=code, names=names)
        said = self.sward("bake", "bare.tif", "--count", "10", "-o", "x.sward").stderr
        self.assertIn("names no coordinate system", said)

    def test_words_behind_a_map_are_named(self):
        self.tif("a.tif", HEIGHTS)
        for words, names in (("30..30", ('"30..30" is no range',)), ("nan..1", ('"nan..1" is no range',)), ("0..inf", ("finite",)),
                             ("b2:-1e308..1e308", ("is no range",)), ("a", ('"a" is not one of bN',)), ("30,,40", ('"30,,40"', "commas")),
                             ("b0:30", ('"b0" is no band', "b1")), ("30:b1", ('"30" stands too early', "bN, V,V or A..B, and invert")), ("inverts", ("invert",))):
            self.refused("bake", "a.tif", "--mask", f"raster:a.tif:{words}", "--count", "9", "-o", "x.sward", code=USAGE, names=("raster:a.tif", *names))
        # A file may be called so.
        shutil.copy(self.folder / "a.tif", self.folder / "a.tif:30..30")
        self.sward("bake", "a.tif", "--mask", "raster:a.tif:30..30", "--count", "9", "-o", "x.sward", "-q")

    def test_without_the_library_maps_are_refused(self):
        self.tif("a.tif", HEIGHTS)
        # A copy of the program alone: nothing lies beside it.
        lone = self.folder / "alone/sward"
        lone.parent.mkdir()
        shutil.copy(PROGRAM, lone)
        done = subprocess.run([lone, "bake", "a.tif", "--count", "9", "-o", "x.sward"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, UNSUPPORTED, done.stderr)
        self.assertIn("libsward_maps.so", done.stderr)


if __name__ == "__main__":
    unittest.main()
