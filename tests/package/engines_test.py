"""The examples of docs/engines.md, as far as they can run without the engines: what reads fields there is compiled
against the installed libsward.so, and tells the same blades as `sward export` does."""

import csv
import math
import re
import shutil
import unittest

from package_test import COMPILER, PREFIX, ROOT, GuestTest

ENGINES = ROOT / "examples/engines"

CPP = """#include "SwardPlace.h"
#include <cstdio>
#include <vector>
int main(int argc, char** argv)
{
    sward_field* field = nullptr;
    sward_field_info info = {};
    if (argc != 2 || sward_field_open(argv[1], &field) != SWARD_OK || sward_field_get_info(field, &info) != SWARD_OK) {
        std::printf("%s\\n", sward_last_error());
        return 1;
    }
    std::vector<sward_blade> rows(info.blade_count);
    if (sward_field_read_blades(field, 0, rows.size(), rows.data()) != SWARD_OK)
        return 1;
    for (const sward_blade& row : rows) {
        const sward_unreal::Place p = sward_unreal::placeOf(info, row);
        std::printf("%llu %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\\n", static_cast<unsigned long long>(row.id),
                    p.position[0], p.position[1], p.position[2], double(p.rotation[0]), double(p.rotation[1]),
                    double(p.rotation[2]), double(p.rotation[3]), double(p.scale[0]), double(p.scale[2]));
    }
    sward_field_destroy(field);
}
"""

CSHARP = """using System;
using System.Globalization;
static class Program
{
    static int Main(string[] names)
    {
        try {
            using (var field = new Sward.Field(names[0])) {
                var rows = new Sward.Blade[field.Info.BladeCount];
                field.Read(0, rows);
                var turn = new float[4];
                for (int i = 0; i < rows.Length; ++i) {
                    Sward.Field.Rotation(ref rows[i], turn);
                    Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                        "{0} {1:R} {2:R} {3:R} {4:R} {5:R} {6:R} {7:R} {8:R} {9:R}", rows[i].Id, rows[i].X, rows[i].Y, rows[i].Z,
                        turn[0], turn[1], turn[2], turn[3], rows[i].Width, rows[i].Height));
                }
                if (field.SpeciesName(0) == "")
                    return 3;
            }
        } catch (InvalidOperationException fault) {
            Console.WriteLine(fault.Message);
            return 2;
        }
        return 0;
    }
}
"""

RUST = """#[path = "PLACE/bevy/src/sward.rs"]
mod sward;
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let field = match sward::Field::open(&path) {
        Ok(field) => field,
        Err(message) => { println!("{message}"); std::process::exit(2) }
    };
    let mut ribbons = sward::Ribbons::default();
    for row in field.blades(0, field.info.blade_count).unwrap() {
        let q = row.rotation();
        ribbons.add(field.info.origin, &row);
        let tip = ribbons.positions.last().unwrap();
        assert!((tip[1] as f64) < 10.0 && tip[1].is_finite());
        println!("{} {} {} {} {} {} {} {} {} {}", row.id, row.root[0], row.root[1], row.root[2], q[0], q[1], q[2], q[3], row.width, row.height);
    }
    let last = *ribbons.indices.iter().max().unwrap() as usize;
    assert!(last + 1 == ribbons.positions.len() && ribbons.normals.len() == ribbons.colors.len());
}
"""


def turned(q, v):
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]]


class EngineTest(GuestTest):
    def setUp(self):
        super().setUp()
        self.run_here(PREFIX / "bin/sward", "bake", "hills", "--meadow", "lawn", "--count", "1000", "-o", "hills.sward", "-q")
        self.run_here(PREFIX / "bin/sward", "export", "hills.sward", "-o", "hills.csv", "-q")
        with open(self.folder / "hills.csv", encoding="utf-8") as table:
            self.rows = {int(row["id"]): {name: float(value) for name, value in row.items()} for row in csv.DictReader(table)}
        (self.folder / "broken.sward").write_bytes((self.folder / "hills.sward").read_bytes()[:5000])
        self.environment = {"LD_LIBRARY_PATH": str(next(PREFIX.glob("lib*/**/libsward.so")).parent)}

    def told(self, *program):
        """{id: nine numbers} that a program tells of the field; it complains of a broken one, and names it."""
        complaint = self.run_here(*program, "broken.sward", succeeds=False, **self.environment)
        self.assertIn("broken.sward", complaint)
        self.assertRegex(complaint, r"\d+ bytes|shorter|ends|length")
        lines = self.run_here(*program, "hills.sward", **self.environment).splitlines()
        told = {int(line.split()[0]): [float(word) for word in line.split()[1:]] for line in lines}
        self.assertEqual(set(told) & set(self.rows), set(self.rows))
        return told

    def assert_stands(self, row, front, up):
        """Front and up-vector of a blade, by the frame of Duff et al. (JCGT 2017)."""
        n = [row["ux"], row["uy"], row["uz"]]
        for got, expected in zip(up, n):
            self.assertAlmostEqual(got, expected, delta=2e-5)
        sign = math.copysign(1, n[2])
        a = -1 / (sign + n[2])
        tangent = [1 + sign * n[0] * n[0] * a, sign * n[0] * n[1] * a, -sign * n[0]]
        bitangent = [n[0] * n[1] * a, sign + n[1] * n[1] * a, -n[1]]
        wide = [math.cos(row["facing"]) * t + math.sin(row["facing"]) * b for t, b in zip(tangent, bitangent)]
        expected = [n[1] * wide[2] - n[2] * wide[1], n[2] * wide[0] - n[0] * wide[2], n[0] * wide[1] - n[1] * wide[0]]
        for got, wanted in zip(front, expected):
            self.assertAlmostEqual(got, wanted, delta=2e-5)

    def assert_same_in_swards_axes(self, told):
        for name, row in self.rows.items():
            x, y, z, *turn, width, height = told[name]
            for got, expected in zip((x, y, z, width, height), (row["x"], row["y"], row["z"], row["width"], row["height"])):
                self.assertAlmostEqual(got, expected, delta=1e-6)
            self.assert_stands(row, turned(turn, [0, 0, 1]), turned(turn, [0, 1, 0]))


class SharedLibrary(EngineTest):
    def test_it_exports_the_functions_of_the_headers_in_c_and_nothing_else(self):
        library = next(PREFIX.glob("lib*/**/libsward.so"))
        names = {line.split()[-1] for line in self.run_here("nm", "-D", "--defined-only", library).splitlines()}
        declared = set()
        for header in (PREFIX / "include/sward/c").glob("*.h"):
            text = re.sub(r"/\*.*?\*/", "", header.read_text(encoding="utf-8"), flags=re.S)
            declared |= set(re.findall(r"\b(sward_[a-z0-9_]+)\(", text)) - set(re.findall(r"typedef[^;]*\(\*(\w+)\)", text))
        self.assertEqual(names, declared)

    def test_the_places_for_unreal_are_those_of_the_field_in_its_axes(self):
        (self.folder / "main.cpp").write_text(CPP, encoding="utf-8")
        library = next(PREFIX.glob("lib*/**/libsward.so")).parent
        self.run_here(COMPILER, "-std=c++17", "-Wall", "-Wextra", "-Werror", "-I", PREFIX / "include",
                      "-I", ENGINES / "unreal", "main.cpp", "-L", library, "-lsward", "-o", "places")
        told = self.told("./places")
        low = [min(row[axis] for row in self.rows.values()) for axis in "xyz"]
        for name, row in self.rows.items():
            x, y, z, *turn, width, height = told[name]
            for got, expected in zip((x, z, y, width, height), (row["x"], row["y"], row["z"], row["width"], row["height"])):
                self.assertAlmostEqual(got, 100 * expected, delta=1e-4)
            # The blade stands along +Z and leans to +Y there; Sward's axes are those with y and z exchanged.
            up, front = turned(turn, [0, 0, 1]), turned(turn, [0, 1, 0])
            self.assert_stands(row, [front[0], front[2], front[1]], [up[0], up[2], up[1]])
        self.assertLess(low[0], 0)


class LongLanguages(EngineTest):
    """Debian's mono-mcs and rustc (scripts/install-dependencies --dev)."""

    def test_the_reader_in_c_sharp_tells_the_fields_blades(self):
        (self.folder / "Program.cs").write_text(CSHARP, encoding="utf-8")
        self.run_here("mcs", "-warnaserror", "-out:read.exe", "Program.cs", ENGINES / "unity/SwardField.cs")
        self.assert_same_in_swards_axes(self.told("mono", "read.exe"))

    def test_the_reader_in_rust_tells_the_fields_blades(self):
        (self.folder / "main.rs").write_text(RUST.replace("PLACE", str(ENGINES)), encoding="utf-8")
        compiler = "/usr/bin/rustc" if shutil.which("/usr/bin/rustc") else "rustc"
        self.run_here(compiler, "--edition", "2021", "-A", "dead_code", "main.rs", "-L", self.environment["LD_LIBRARY_PATH"],
                      "-o", "read")
        self.assert_same_in_swards_axes(self.told("./read"))


if __name__ == "__main__":
    unittest.main()
