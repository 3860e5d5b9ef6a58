"""What the program says about a field file, sound or damaged, and what it exports."""

import math
import re
import time
import unittest

from meshes import dot
from support import CliTest, INPUT, IO, ROOT, UNSUPPORTED

HEADER = ("id,x,y,z,ux,uy,uz,facing,height,width,stiffness,species,exposure,tint_r,tint_g,tint_b,"
          "clump,patch")


class FieldFile(CliTest):
    def setUp(self):
        super().setUp()
        self.field = self.bake("hills", "--count", "3000", "--slope", "0:60")

    def test_a_sound_field_is_valid_in_one_line(self):
        done = self.sward("validate", "field.sward")
        self.assertRegex(done.stdout, r"^field\.sward: valid, 3000 blades in \d+ patches\n$")

    def test_damage_is_found_by_every_command(self):
        whole = self.field.read_bytes()
        flipped = bytearray(whole)
        flipped[len(whole) // 2] ^= 1
        damaged = {"empty": b"", "short": whole[:40], "half": whole[:len(whole) // 2],
                   "cut": whole[:-1], "flipped": bytes(flipped), "long": whole + b"\0",
                   "other": b"PNG" + whole[3:], "text": b"once upon a time " * 100}
        for name, content in damaged.items():
            path = self.folder / f"{name}.sward"
            path.write_bytes(content)
            for command in (("validate", path.name), ("info", path.name),
                            ("export", path.name, "-o", "x.csv"), ("compare", path.name, "field.sward")):
                with self.subTest(name=name, command=command[0]):
                    self.refused(*command, code=INPUT, names=[path.name])

    def test_flipped_bytes_all_over_the_file_are_found(self):
        whole = self.field.read_bytes()
        for position in range(0, len(whole), len(whole) // 40):
            content = bytearray(whole)
            content[position] ^= 0x10
            (self.folder / "bad.sward").write_bytes(content)
            with self.subTest(position=position):
                done = self.sward("validate", "bad.sward",
                                  code=UNSUPPORTED if position in self.version_bytes() else INPUT)
                self.assertIn("bad.sward", done.stderr)

    @staticmethod
    def version_bytes():
        """Where docs/field_format.md puts the major version."""
        text = (ROOT / "docs/field_format.md").read_text(encoding="utf-8")
        offset = int(re.search(r"(?m)^\|\s*(\d+)\s*\|[^|]*\|[^|]*major", text).group(1))
        return range(offset, offset + 2)

    def test_a_newer_version_is_unsupported_and_both_versions_are_named(self):
        content = bytearray(self.field.read_bytes())
        content[self.version_bytes().start] += 1
        (self.folder / "new.sward").write_bytes(content)
        old = self.field.read_bytes()[self.version_bytes().start]
        self.refused("validate", "new.sward", code=UNSUPPORTED, names=["new.sward", old, old + 1])

    def test_info_counts_what_is_there(self):
        info = self.info(self.field)
        self.assertEqual(info["blades"], 3000)
        self.assertEqual(info["bytes"], self.field.stat().st_size)
        self.assertAlmostEqual(info["bytes_per_blade"], self.field.stat().st_size / 3000)
        self.assertEqual(sum(species["blades"] for species in info["species"]), 3000)
        self.assertEqual(info["provenance"]["tool"], "sward 0.1.0")
        self.assertGreater(info["ground"]["triangles"], 1000)
        low, high = info["bounds"]
        for blade in self.blades(self.field):
            self.assertTrue(all(l <= x <= h for l, x, h in zip(low, blade.root, high)), blade.root)

    def test_info_for_people_has_the_same_numbers(self):
        text = self.sward("info", "field.sward").stdout
        for word in ("3000", "species", "ground", "settings", str(self.field.stat().st_size)):
            self.assertIn(word, text)

    def test_info_for_people_has_a_row_for_every_setting_of_the_bake(self):
        field = self.bake("hills", "--count", "3000", "--altitude", "-50:~1.5", "--border", "2~1",
                          "--ground-up", "radial:0,-900,0", "--exclude", "sphere:margin 2",
                          "--set", "species.bent.slope=:30~5", "--meadow", "meadow", to="f.sward")
        text = self.sward("info", field).stdout
        provenance = self.info(field)["provenance"]
        settings = provenance["settings"]
        keys = [*settings, *(key for key in settings["meadow"] if key != "species"),
                *settings["meadow"]["species"][0]]
        for key in keys:
            with self.subTest(key=key):
                self.assertRegex(text, rf"(?m)^ +{key.removesuffix('_m').replace('_', ' ')}( |$)")
        for row in (r"input hash +[0-9a-f]{16}", r"altitude +at least -50 m, fading over 1.5 m",
                    r"border +at least 3 m, fading over 1 m", r"curvature +unlimited",
                    r"density +none", r"slope +0 to 180 degrees", r"ground up +radial from 0, -900, 0"):
            self.assertRegex(text, rf"(?m)^ +{row}$")
        self.assertRegex(text, r"(?m)^ +slope +0:180 +0:180 +0:30~5$")
        for letters in "{}[]\"":
            self.assertNotIn(letters, text)
        self.assertNotRegex(text, r"1e\+?300")

    def test_info_for_people_lists_masks_and_organs_of_species(self):
        field = self.bake(ROOT / "assets/meshes/landscape.glb", "--count", "300", "--meadow", "daisies", "--set",
                          "species.daisy.mask=vertex-color:R:or-white", to="f.sward")
        text = self.sward("info", field).stdout
        species = self.info(field)["provenance"]["settings"]["meadow"]["species"]
        daisy = next(one for one in species if one["name"] == "daisy")
        self.assertRegex(text, r"(?m)^ +mask +none +none +1 below$")
        self.assertRegex(text, rf"(?m)^ +organs .*{len(daisy['organs'])} below")
        self.assertIn("  masks of daisy\n    vertex-color:R:or-white\n", text)
        table = text.split("  organs of daisy\n")[1].split("\n  ")[0]
        for organ in daisy["organs"]:
            self.assertIn(organ["name"], table)
        self.assertRegex(text, r"(?m)^    pitch +-?\d+( to -?\d+)? degrees")
        self.assertLess(max(map(len, text.splitlines())), 120)

    def test_the_csv_has_the_contract_s_header_and_a_row_for_each_blade(self):
        self.sward("export", "field.sward", "-o", "f.csv")
        lines = (self.folder / "f.csv").read_text().splitlines()
        self.assertEqual(lines[0], HEADER)
        self.assertEqual(len(lines), 1 + 3000)
        self.assertTrue(all(line.count(",") == HEADER.count(",") for line in lines))

    def test_rows_are_within_their_ranges(self):
        info = self.info(self.field)
        blades = self.blades(self.field)
        self.assertEqual(len({blade.id for blade in blades}), 3000)
        for blade in blades:
            row = {key: float(value) for key, value in blade.row.items()}
            self.assertLess(blade.id, 1 << 53)
            self.assertAlmostEqual(dot(blade.up, blade.up), 1.0, places=5)
            self.assertTrue(0.0 <= row["facing"] < 2 * math.pi)
            self.assertTrue(0.0 < row["width"] < row["height"])
            for key in ("stiffness", "exposure", "tint_r", "tint_g", "tint_b"):
                self.assertTrue(0.0 <= row[key] <= 1.0, key)
            self.assertIn(row["species"], range(len(info["species"])))
            self.assertIn(row["patch"], range(info["patches"]))
            self.assertIn(row["clump"], range(256))

    def test_positions_have_nine_decimals(self):
        self.sward("export", "field.sward", "-o", "f.csv")
        for line in (self.folder / "f.csv").read_text().splitlines()[1:]:
            self.assertRegex(line, r"^\d+(,-?\d+\.\d{9}){3},")

    def test_a_quarter_of_a_million_rows_are_written_in_seconds(self):
        field = self.bake("hills", "--count", "250000", "--sky-rays", "0", to="large.sward")
        begin = time.monotonic()
        self.sward("export", field, "-o", "large.csv")
        self.assertLess(time.monotonic() - begin, 5.0)
        with open(self.folder / "large.csv", "rb") as file:
            self.assertEqual(sum(1 for _ in file), 250001)

    def test_an_unknown_extension_names_those_that_exist(self):
        for name in ("f.abc", "f", "f.CSV2"):
            self.refused("export", "field.sward", "-o", name, code=UNSUPPORTED,
                         names=[name, ".glb", ".ply", ".usda", ".csv", "NAME/" if "." in name else "f/", "--tiles"])

    def test_an_existing_export_is_refused(self):
        (self.folder / "f.csv").write_text("precious")
        self.refused("export", "field.sward", "-o", "f.csv", code=IO, names=["f.csv", "--force"])
        self.assertEqual((self.folder / "f.csv").read_text(), "precious")
        self.sward("export", "field.sward", "-o", "f.csv", "--force")


if __name__ == "__main__":
    unittest.main()
