"""The export of 3D Tiles, read back by a reader of its own: every blade, the tree, errors, and the command."""

import json
import resource
import signal
import sys
import unittest
from pathlib import Path

import numpy

sys.path.append(str(Path(__file__).resolve().parents[1]))

import gltf_instances
import node_readers
import tilesets
from export_tables import ExportTest, PLACE_ERROR
from support import IO, USAGE

PLACE = 2.0 ** -12  # [m] half a step of compact places
SCALE = 1.0 / 256.0  # of the largest of a node
LARGEST = 65536  # blades of a leaf
WIDENING = 8.0

# Places on WGS84 and earth-centred ones that are known: pole, equator, and EPSG's Guidance Note 7-2, 4.1.1.
KNOWN = (((0.0, 0.0, 0.0), (6378137.0, 0.0, 0.0)),
         ((90.0, 0.0, 100.0), (0.0, 6378237.0, 0.0)),
         ((0.0, 90.0, 0.0), (0.0, 0.0, 6356752.3142)),
         ((2 + 7 / 60 + 46.38 / 3600, 53 + 48 / 60 + 33.82 / 3600, 73.0), (3771793.968, 140253.342, 5124304.349)))


class TilesExport(ExportTest):
    def tiles(self, field, name, *options):
        self.sward("export", field, "-o", name, "--tiles", "--force", *options)
        return tilesets.Tileset(self.folder / name)

    def instances(self, path):
        glb = gltf_instances.Glb(node_readers.unpacked(path))
        self.assertEqual(gltf_instances.complaints(glb), [])
        return gltf_instances.instances(glb)

    def check(self, field, *options):
        """The leaves hold every blade of the CSV once, in their cubes; all other tiles hold some, widened."""
        tiles = self.tiles(field, "tiles", "--with-ids", *options)
        table = self.table(field)
        leaves = set(tiles.leaves())
        seen = []
        for tile, path in tiles.tiles.items():
            if path is None:
                continue
            found = self.instances(path)
            rows = numpy.searchsorted(table["id"], found["id"][:, 0])
            self.assertTrue(numpy.array_equal(table["id"][rows], found["id"][:, 0]))
            self.assertEqual(len(numpy.unique(rows)), len(rows))
            own = {name: values[rows] for name, values in table.items()}
            places = tilesets.z_up(found["place"])
            low, high = tiles.box(tile)
            self.assertTrue((places >= low - PLACE).all() and (places <= high + PLACE).all(), tile)
            world = places @ tiles.transform[:3, :3].T + tiles.transform[:3, 3]
            if "--at" not in options:
                real = tilesets.z_up(self.columns(own, "x", "y", "z"))
                self.assert_near(world, real, PLACE + PLACE_ERROR)
            scales = self.scales(own)
            self.assert_near(found["SCALE"][:, 1], scales[:, 1], SCALE * scales[:, 1].max() * 1.001)
            is_blade = scales[:, 0] != scales[:, 1]
            wider = found["SCALE"][is_blade, 0] / scales[is_blade, 0]
            if tile in leaves:
                seen.append(found["id"][:, 0])
                self.assertLessEqual(len(rows), LARGEST)
                self.assertAlmostEqual(float(numpy.median(wider)), 1.0, delta=0.02)
            else:
                self.assertGreater(float(numpy.median(wider)), 1.5)
                self.assertLess(float(numpy.median(wider)), WIDENING * 1.02)
        seen = numpy.sort(numpy.concatenate(seen))
        self.assertTrue(numpy.array_equal(seen, table["id"].astype(numpy.uint64)))
        return tiles

    def test_leaves_hold_every_blade_and_inner_tiles_representatives(self):
        field = self.bake("hills", "--count", "100000", "--sky-rays", "0", "--meadow", "grass")
        tiles = self.check(field)
        self.assertGreaterEqual(len(tiles.leaves()), 4)
        # A tile with children shows as much as they do: its blades are fewer and as much wider.
        root = self.instances(tiles.tiles[(0, 0, 0, 0)])
        table = self.table(field)
        covered = (root["SCALE"][:, 0] * root["SCALE"][:, 1]).sum()
        self.assertAlmostEqual(covered / (table["width"] * table["height"]).sum(), 1.0, delta=0.03)
        # Where it is refined, its blades are about a pixel wide.
        deepest = max(tile[0] for tile in tiles.tiles) - 1
        wide = numpy.mean([self.instances(path)["SCALE"][:, 0].mean() for tile, path in tiles.tiles.items()
                           if tile[0] == deepest and tile not in set(tiles.leaves())])
        self.assertAlmostEqual(tiles.error((deepest, 0, 0, 0)) / wide / 16.0, 1.0, delta=0.35)

    def test_dense_grass_has_many_levels(self):
        tiles = self.tiles(self.bake("plane", "--count", "500000", "--sky-rays", "0", "--meadow", "grass"), "deep")
        counts = {}
        for tile, path in tiles.tiles.items():
            content = path.read_bytes()
            glb = json.loads(content[20:20 + int.from_bytes(content[12:16], "little")])
            counts[tile] = sum(glb["accessors"][node["extensions"][gltf_instances.EXTENSION]["attributes"]["SCALE"]]
                               ["count"] for node in glb["nodes"] if "mesh" in node)
        self.assertGreater(tiles.levels, tiles.subtree_levels, "there is more than one file of subtrees")
        leaves = set(tiles.leaves())
        self.assertEqual(sum(counts[tile] for tile in leaves), 500000)
        for tile in tiles.tiles.keys() - leaves:
            self.assertLess(counts[tile], 1.5 * 32768)

    def test_tiles_of_a_planet(self):
        self.check(self.bake("sphere", "--count", "70000", "--sky-rays", "0"))

    def test_tiles_far_away_keep_their_places(self):
        self.check(self.far_field())

    def test_a_field_of_few_blades_is_one_tile(self):
        tiles = self.check(self.bake("plane", "--count", "300"))
        self.assertEqual(list(tiles.tiles), [(0, 0, 0, 0)])

    def test_no_blades_make_a_tileset_without_content(self):
        tiles = self.tiles(self.bake("plane", "--density", "1", "--altitude", "5:"), "none")
        self.assertEqual(list(tiles.tiles.values()), [None])

    def test_contents_pass_the_validator(self):
        tiles = self.tiles(self.bake("hills", "--count", "40000", "--sky-rays", "0"), "tiles")
        for path in list(tiles.tiles.values())[:3]:
            found = node_readers.gltf_issues(path)
            self.assertEqual((found["numErrors"], found["numWarnings"]), (0, 0), found["messages"])

    def test_a_place_on_the_earth_is_where_it_is(self):
        field = self.bake("plane", "--count", "20")
        for (longitude, latitude, height), expected in KNOWN:
            with self.subTest(latitude=latitude):
                tiles = self.tiles(field, "earth", "--at", f"{longitude!r},{latitude!r},{height}")
                # The world's origin, in the tileset's axes, is the negative of the field's origin.
                origin = numpy.array(self.info(field).get("origin", [0.0, 0.0, 0.0]), float)
                own = numpy.array([-origin[0], origin[2], -origin[1], 1.0])
                root = (tiles.transform @ own)[:3]
                self.assertLess(numpy.linalg.norm(root - expected), 0.01)
                east, north, up = tiles.transform[:3, :3].T
                self.assert_near(tiles.transform[:3, :3] @ tiles.transform[:3, :3].T, numpy.eye(3), 1e-14)
                # Up is the normal of the ellipsoid, and east is level and at right angles to the axis.
                normal = (numpy.array(expected) / numpy.array([6378137.0 ** 2] * 2 + [6356752.314245 ** 2]))
                self.assertGreater(numpy.dot(up, normal / numpy.linalg.norm(normal)), 1.0 - 1e-8)
                self.assertAlmostEqual(east[2], 0.0, delta=1e-15)
                self.assertGreaterEqual(north[2], 0.0)

    def test_folders_appear_whole_and_are_replaced_with_force_only(self):
        field = self.bake("plane", "--count", "50")
        self.sward("export", field, "-o", "tiles/", "--tiles")
        before = (self.folder / "tiles/tileset.json").read_bytes()
        self.refused("export", field, "-o", "tiles", "--tiles", code=IO, names=["tiles", "--force"])
        (self.folder / "tiles/old").write_text("old")
        self.sward("export", field, "-o", "tiles", "--tiles", "--force")
        self.assertFalse((self.folder / "tiles/old").exists(), "the former tileset is gone")
        self.assertEqual((self.folder / "tiles/tileset.json").read_bytes(), before)
        # A folder that holds something else, and a file.
        (self.folder / "mine").mkdir()
        (self.folder / "mine/precious").write_text("precious")
        (self.folder / "file").write_text("precious")
        for name in ("mine", "file", "missing/tiles"):
            self.refused("export", field, "-o", name, "--tiles", "--force", code=IO, names=[name])
        self.assertEqual((self.folder / "mine/precious").read_text(), "precious")
        # The field itself is never removed with the folder.
        (self.folder / "tiles/field.sward").write_bytes(Path(field).read_bytes())
        self.refused("export", "tiles/field.sward", "-o", "tiles", "--tiles", "--force", code=USAGE,
                     names=["tiles/field.sward"])

    def test_a_full_disk_leaves_the_former_folder(self):
        def small_files_only():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

        field = self.bake("plane", "--count", "5000", "--sky-rays", "0")
        self.tiles(field, "tiles")
        before = {path: path.read_bytes() for path in (self.folder / "tiles").rglob("*") if path.is_file()}
        for name, options in (("tiles", ["--force"]), ("new", [])):
            self.sward("export", field, "-o", name, "--tiles", *options, code=IO, before=small_files_only)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"field.sward", "tiles"})
        after = {path: path.read_bytes() for path in (self.folder / "tiles").rglob("*") if path.is_file()}
        self.assertEqual(after, before)

    def test_options_that_do_not_fit_are_refused(self):
        self.bake("plane", "--count", "50")
        for options, words in ((["-o", "t", "--tiles", "--at", "1,2"], ["--at", "LON,LAT,H"]),
                               (["-o", "t", "--tiles", "--at", "1,91,0"], ["--at", "91", "90"]),
                               (["-o", "t", "--tiles", "--compact"], ["--compact", "--tiles"]),
                               (["-o", "t", "--tiles", "--with-ground"], ["--with-ground", "--tiles"]),
                               (["-o", "t.glb", "--at", "1,2,3"], ["--at", "--tiles"])):
            with self.subTest(options=options):
                self.refused("export", "field.sward", *options, code=USAGE, names=words)

    def test_the_check_of_the_rules_is_awake(self):
        self.tiles(self.bake("hills", "--count", "40000", "--sky-rays", "0"), "tiles")
        root = self.folder / "tiles/subtrees/0/0/0/0.subtree"
        whole = root.read_bytes()
        for at, bit in ((len(whole) - 8, 1), (0, 1), (8, 8)):
            with self.subTest(at=at):
                root.write_bytes(whole[:at] + bytes([whole[at] ^ bit]) + whole[at + 1:])
                with self.assertRaises((ValueError, OSError)):
                    tilesets.Tileset(self.folder / "tiles")
        root.write_bytes(whole)
        content = next((self.folder / "tiles/content").rglob("*.glb"))
        content.rename(self.folder / "tiles/content/other.glb")
        with self.assertRaises(ValueError):
            tilesets.Tileset(self.folder / "tiles")


if __name__ == "__main__":
    unittest.main()
