"""web/, the npm package: its reader of fields, held against `sward` blade by blade. It runs the built script that is
committed, by Node.js alone."""

import csv
import ctypes
import json
import struct
import subprocess
import sys
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from support import CliTest

from file_server import FolderServer
from needs import needs

HERE = Path(__file__).resolve().parent
EXACT = ("id", "species", "clump", "patch")

# Where things stand in a file: docs/field_format.md.
TABLE, ENTRY = 64, 64


def xxh3(data):
    library = ctypes.CDLL("libxxhash.so.0")
    library.XXH3_64bits.restype = ctypes.c_uint64
    library.XXH3_64bits.argtypes = [ctypes.c_char_p, ctypes.c_size_t]
    return library.XXH3_64bits(data, len(data))


def node(*arguments, **how):
    done = subprocess.run(["node", str(HERE / "read_field.mjs"), *map(str, arguments)], capture_output=True, **how)
    if done.returncode:
        raise AssertionError(done.stderr.decode())
    return done.stdout


class WebFields(CliTest):
    def setUp(self):
        super().setUp()
        needs("node")

    def assert_same_as_the_export(self, field, place=None):
        path = self.folder / "rows.csv"
        self.sward("export", field, "-o", path, "--force")
        with open(path, encoding="ascii", newline="") as file:
            rows = list(csv.DictReader(file))
        table = numpy.frombuffer(node("rows", place or field), "<f8").reshape(-1, len(rows[0]))
        self.assertEqual(len(table), len(rows))
        for values, name in zip(table.T, rows[0]):
            if name in EXACT:
                self.assertEqual([int(v) for v in values], [int(row[name]) for row in rows], name)
            else:
                numpy.testing.assert_allclose(values, [float(row[name]) for row in rows],
                                              rtol=1e-6, atol=2e-6, err_msg=name)

    def error_of(self, place):
        return json.loads(node("errors", place))[0]

    def assert_refused(self, damages, code):
        """All of these contents are refused, with the message of `sward validate`. `code`: exit codes by name, or 3."""
        paths = {name: self.folder / f"damaged {name}.sward" for name in damages}
        for name, path in paths.items():
            path.write_bytes(damages[name])
        for (name, path), error in zip(paths.items(), json.loads(node("errors", *paths.values()))):
            with self.subTest(name):
                said = self.sward("validate", path, code=code.get(name, 3)).stderr
                self.assertIn(error.get("message", "no error"), said)
                self.assertEqual(error["kind"], "unsupported" if name in code else "input")

    def test_blades_of_a_sphere_are_those_of_the_csv_export(self):
        self.assert_same_as_the_export(self.bake("sphere", "--count", "3000", "--ground-up", "radial"))

    def test_blades_of_hills_are_those_of_the_csv_export(self):
        self.assert_same_as_the_export(self.bake("hills", "--count", "5000"))

    def test_blades_of_plants_are_those_of_the_csv_export(self):
        self.assert_same_as_the_export(self.bake("plane", "--count", "1500", "--meadow", "daisies"))

    def test_blades_by_ranges_are_those_of_the_csv_export(self):
        field = self.bake("hills", "--count", "20000")
        with FolderServer(self.folder) as server:
            self.assert_same_as_the_export(field, f"{server.address}/field.sward")
        self.assertGreater(sum(1 for _, asked in server.requests if asked), 5)

    def test_a_server_without_ranges_sends_the_whole_file(self):
        field = self.bake("hills", "--count", "2000")
        with FolderServer(self.folder, ranges=False) as server:
            self.assert_same_as_the_export(field, f"{server.address}/field.sward")
            self.assertEqual(len(server.requests), 1)

    def test_pages_come_without_the_rest_of_the_blades(self):
        self.bake("plane", "--count", "60000")
        with FolderServer(self.folder) as server:
            seen = json.loads(node("pages", f"{server.address}/field.sward", 2, 5))
        self.assertEqual(seen["here"], 3)
        self.assertTrue(seen["has"])
        self.assertEqual(seen["after"] - seen["before"], 3 * 1024 * 16)
        self.assertLess(seen["after"], 0.5 * (self.folder / "field.sward").stat().st_size)

    def test_hashes_are_those_of_xxhash(self):
        lengths = [*range(0, 300), 1023, 1024, 1025, 2048, 2049, 70000, 300001]
        said = node("hash", input="\n".join(map(str, lengths)).encode()).decode().split()
        numbers = numpy.arange(max(lengths), dtype="u8")
        data = (numbers * numbers % 251).astype("u1").tobytes()
        self.assertEqual([int(one) for one in said], [xxh3(data[:n]) for n in lengths])

    def test_damaged_fields_are_refused_as_sward_refuses_them(self):
        field = self.bake("hills", "--count", "800")
        whole = field.read_bytes()
        chunks = {whole[at:at + 8].decode().rstrip(): struct.unpack_from("<QQ", whole, at + 8)
                  for at in range(TABLE, TABLE + ENTRY * struct.unpack_from("<I", whole, 24)[0], ENTRY)}

        def changed(at, new):
            return whole[:at] + new + whole[at + len(new):]

        blades, patches = chunks["BLADES"][0], chunks["PATCHES"][0]
        damages = {
            "empty": b"",
            "short": whole[:40],
            "truncated": whole[:-100],
            "longer": whole + bytes(64),
            "no field": changed(0, b"GRASS"),
            "newer": changed(8, b"\x02"),
            "version 0": changed(8, b"\x00"),
            "byte order": changed(12, b"\x01\x02\x03\x04"),
            "table": changed(TABLE + 9, b"\x7f"),
            "blades": changed(blades + 5, bytes([whole[blades + 5] ^ 1])),
            "patches": changed(patches + 60, bytes([whole[patches + 60] ^ 1])),
            "keys": changed(chunks["KEYS"][0] + 9, bytes([whole[chunks["KEYS"][0] + 9] ^ 1])),
        }
        self.assert_refused(damages, {"newer": 5})

    def test_numbers_out_of_range_are_refused_as_sward_refuses_them(self):
        """Damage under hashes that are right again."""
        field = self.bake("hills", "--count", "800")
        whole = bytearray(field.read_bytes())
        count = struct.unpack_from("<I", whole, 24)[0]
        entries = {bytes(whole[at:at + 8]).decode().rstrip(): at
                   for at in range(TABLE, TABLE + ENTRY * count, ENTRY)}
        cases = [("PATCHES", 28, struct.pack("<I", 600)), ("PATCHES", 44, struct.pack("<f", -1.0)),
                 ("PATCHES", 60, struct.pack("<f", 2.0)), ("PATCHES", 96, struct.pack("<f", 1.5)),
                 ("PATCHES", 80, struct.pack("<I", 7)), ("BLADES", 14, b"\xff")]
        damages = {}
        for name, offset, new in cases:
            data = bytearray(whole)
            start, stored = struct.unpack_from("<QQ", data, entries[name] + 8)
            data[start + offset:start + offset + len(new)] = new
            struct.pack_into("<Q", data, entries[name] + 32, xxh3(bytes(data[start:start + stored])))
            end = TABLE + ENTRY * count
            struct.pack_into("<Q", data, 56, xxh3(bytes(data[:56]) + bytes(8) + bytes(data[64:end])))
            damages[f"{name} {offset}"] = bytes(data)
        self.assert_refused(damages, {})

    def test_a_truncated_field_is_refused_by_ranges_too(self):
        field = self.bake("hills", "--count", "20000")
        field.write_bytes(field.read_bytes()[:-5000])
        with FolderServer(self.folder) as server:
            error = self.error_of(f"{server.address}/field.sward")
        self.assertEqual(error["kind"], "input")
        self.assertRegex(error["message"], r"field\.sward: \d+ bytes instead of \d+: truncated")

    def test_a_missing_file_is_told(self):
        with FolderServer(self.folder) as server:
            error = self.error_of(f"{server.address}/none.sward")
        self.assertEqual(error["kind"], "io")
        self.assertIn("none.sward: the server answers 404", error["message"])

    def test_a_field_with_seeds_shows_its_stored_blades(self):
        field = self.bake("hills", "--density", "100", "--budget", "3000", "--seeds", "always")
        self.assert_same_as_the_export(field)


if __name__ == "__main__":
    import unittest

    unittest.main()
