"""A message is the program's own: in plain words, with line and column, and never a library's."""

import json
import random
import struct
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from image_files import chunk, exr, png, ramp
from support import CliTest, DONE, INPUT, IO, PROGRAM, UNSUPPORTED, USAGE
from own_words import foreign_words  # support knows its folder

STROKES = {"format": "sward strokes 1", "strokes": [
    {"kind": "erase", "radius_m": 2, "points": [[0, 0, 0]], "normals": [[0, 1, 0]]}]}
MEADOW = {"name": "m", "species": [{"name": "a", "height_m": [0.2, 0.4]}]}


def again(text, key):
    """JSON in which the first `key` of the text stands twice."""
    at = text.index(f'"{key}"')
    return text[:at] + f'"{key}": 1,\n ' + text[at:]


class Messages(CliTest):
    def written(self, name, content):
        data = content if isinstance(content, bytes) else content.encode("utf-8")
        (self.folder / name).write_bytes(data)
        return name

    def test_keys_that_stand_twice_are_named_with_their_lines(self):
        self.bake("plane", "--count", "20")
        plane = json.dumps({"kind": "plane", "size": [4, 4]}, indent=1)
        self.sward("plan", "plane", "-o", "plan.json", "--count", "20", "--tiles", "1")
        plan = (self.folder / "plan.json").read_text(encoding="utf-8")
        turn = json.dumps({"translation": [0, 0, 0], "scale": 1}, indent=1)
        for text, key, command in (
                (json.dumps(STROKES, indent=1), "kind", ["bake", "plane", "-o", "o.sward", "--paint", "twice.json"]),
                (json.dumps(MEADOW, indent=1), "height_m", ["bake", "plane", "-o", "o.sward", "--meadow", "twice.json"]),
                (plane, "size", ["bake", "twice.json", "-o", "o.sward"]),
                (plane, "size", ["terrain", "twice.json", "-o", "o.glb"]),
                (plan, "tiles", ["tile", "twice.json", "--index", "0", "-o", "tiles"]),
                (turn, "scale", ["compare", "field.sward", "field.sward", "--transform", "twice.json"])):
            with self.subTest(command=command):
                self.written("twice.json", again(text, key))
                self.refused(*command, code=INPUT, names=[f'"{key}" stands twice', "twice.json", ": line "])

    def test_species_of_one_name_are_an_error(self):
        self.written("twins.json", json.dumps({"species": [{"name": "rye"}, {"name": "oat"}, {"name": "rye"}]}))
        self.refused("bake", "plane", "-o", "o.sward", "--meadow", "twins.json", code=INPUT, names=["species[0]", "species[2]", '"rye"'])
        self.refused("bake", "plane", "-o", "o.sward", "--meadow", "daisies", "--set", "species.*.name=rye", code=USAGE, names=['"rye"'])

    def test_a_mask_whose_words_are_mistyped_is_told_which(self):
        for mask, names in (("rock.png:inverts", ["texture:rock.png", '"invert"']), ("texture:a.png:R:inverts", ['"inverts"', '"invert"']),
                            ("texture:a.png:r", ['"r"', '"R"']), ("texture:a.png:invert:R", ["order"]),
                            ("vertex-color:R:invret", ['"invret"', '"invert"']), ("material-texture:Q", ['"Q"', "R, G, B, A"]),
                            ("textur:a.png:R", ['"texture"']), ("ground:gren", ['"green"'])):
            with self.subTest(mask=mask):
                self.refused("bake", "plane", "-o", "o.sward", "--mask", mask, code=USAGE, names=names)

    def test_defaults_of_a_heightmap_have_no_noise_of_rounding(self):
        self.written("a.png", png(47, 33, ramp(47, 33)))
        said = self.sward("bake", "a.png", "-o", "o.sward", "--count", "10").stderr
        self.assertIn("4.6 m", said)
        self.assertEqual(foreign_words(said), "", said)

    def test_a_color_image_proposes_its_encoding(self):
        heights = [[100 + 0.5 * (i + j) for i in range(9)] for j in range(7)]
        rows = b"".join(b"\0" + b"".join(struct.pack(">I", int((h + 32768) * 256))[1:] for h in row) for row in heights)
        self.written("a.png", png(9, 7, rows, depth=8, kind=2))
        self.assertIn("--encoding terrarium", self.sward("bake", "a.png", "-o", "o.sward", "--count", "10").stderr)
        low, high = self.heights_of("a.png", "--encoding", "terrarium")
        self.assertGreaterEqual(low, 99.9)
        self.assertLessEqual(high, 107.1)
        self.assertIn("terrain-rgb", self.refused("bake", "a.png", "-o", "p.sward", "--encoding", "terain-rgb", code=USAGE, names=[]).stderr)

    def test_a_pixel_outside_its_palette_is_named(self):
        palette = b"abcdef" # two colours
        bmp = b"BM" + struct.pack("<IHHIIiiHHIIiiII", 70, 0, 0, 62, 40, 2, 2, 1, 8, 0, 0, 0, 0, 2, 0) + palette + b"gh"
        tga = struct.pack("<BBBHHBHHHHBB", 0, 1, 1, 0, 2, 24, 0, 0, 2, 2, 8, 32) + palette
        for good in (True, False):
            last = 1 if good else 2
            files = {"a.png": png(2, 2, bytes([0, 0, 1, 0, 1, last]), depth=8, kind=3, before=chunk(b"PLTE", palette)),
                     "a.bmp": bmp + bytes([0, 1, 0, 0, last, 1, 0, 0]), "a.tga": tga + bytes([0, 1, 1, last]),
                     "b.tga": tga[:2] + b"\x09" + tga[3:] + bytes([0x81, 0, 0x81, last])}
            for name, content in files.items():
                with self.subTest(name=name, good=good):
                    self.written(name, content)
                    command = ("bake", "plane", "-o", "o.sward", "--count", "10", "--mask", f"texture:{name}:R", "--force")
                    if good:
                        self.sward(*command)
                        (self.folder / "o.sward").unlink()
                    else:
                        self.refused(*command, code=INPUT, names=[name, "palette of 2"])

    def heights_of(self, *options):
        ys = [blade.root[1] for blade in self.blades(self.bake(options[0], "--count", "200", "--force", *options[1:]))]
        return min(ys), max(ys)

    def test_damaged_files_of_every_kind_are_told_in_own_words(self):
        samples = {"a.png": png(33, 33, ramp()), "a.exr": exr(4, 4, compression=0, data=bytes(200)),
                   "a.asc": b"ncols 3\nnrows 2\ncellsize 1\n1 2 3\n4 5 6\n",
                   "recipe.json": json.dumps({"kind": "hills", "size": 20}).encode("ascii"),
                   "meadow.json": json.dumps(MEADOW).encode("ascii"), "strokes.json": json.dumps(STROKES).encode("ascii")}
        commands = {"meadow.json": ["plane", "--meadow", "meadow.json"], "strokes.json": ["plane", "--paint", "strokes.json"]}
        for name, content in samples.items():
            for seed in range(12):
                chance = random.Random(f"{name}/{seed}")
                data = bytearray(content)
                for _ in range(chance.choice((1, 1, 3))):
                    at = chance.randrange(len(data))
                    way = chance.randrange(3)
                    if way == 0:
                        data[at] ^= 1 << chance.randrange(8)
                    elif way == 1:
                        del data[at:at + chance.choice((1, 4, 40))]
                    else:
                        data[at:at] = chance.choice((b"\"", b"{", b"\xff", b"1e999", b"nan", b",,"))
                    data = data or bytearray(b" ")
                self.written(name, bytes(data))
                done = subprocess.run([str(PROGRAM), "bake", *commands.get(name, [name]), "-o", "o.sward", "--force", "--count", "5"],
                                      cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
                with self.subTest(file=name, seed=seed):
                    self.assertIn(done.returncode, (DONE, USAGE, IO, INPUT, UNSUPPORTED), done.stderr)
                    self.assertEqual(foreign_words(done.stderr, data.decode("latin-1")), "", done.stderr)


if __name__ == "__main__":
    unittest.main()
