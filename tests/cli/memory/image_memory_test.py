"""Memory follows the data: what a header claims is believed only as far as data follow.

A reader takes no more than 64 bytes for each byte that it has really read or unpacked, and 64 MB, beyond what the program
takes of itself. Each file here claims much and holds little; each message is the program's own."""

import os
import struct
import subprocess
import sys
import unittest
import zlib
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from image_files import asc, attribute, bmp, chunk, exr, jpeg, png, ramp, tga
from support import CliTest, DONE, INPUT, PROGRAM
from own_words import foreign_words  # support knows its folder

MEGABYTE = 1 << 20
SIDE = 4000  # samples, within the limits of a heightmap


class MemoryFollowsTheData(CliTest):
    @classmethod
    def setUpClass(cls):
        cls.own = cls.peak_of([PROGRAM, "bake", "plane", "--dry-run", "--count", "10", "-q"])[1]

    @staticmethod
    def peak_of(command, folder=None):
        """Exit code, peak memory in bytes, and what the program said."""
        with subprocess.Popen(list(map(str, command)), cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE) as running:
            said = running.stderr.read().decode("utf-8", "replace")
            _, status, usage = os.wait4(running.pid, 0)
            running.returncode = os.waitstatus_to_exitcode(status)
        return running.returncode, usage.ru_maxrss * 1024, said

    def follows(self, name, content, *options, code=INPUT, says=(), unpacked=None, ground=None):
        """Bakes a file, or `ground` with the file's name at the end of the options."""
        path = self.folder / name
        path.write_bytes(content)
        command = [PROGRAM, "bake", ground or name, "-o", "o.sward", "--force", "--count", "10", *options]
        with self.subTest(file=name, options=options):
            ended, peak, said = self.peak_of(command, self.folder)
            self.assertEqual(ended, code, said)
            for text in says:
                self.assertIn(text, said)
            self.assertEqual(foreign_words(said), "", said)
            limit = 64 * max(len(content), unpacked or 0) + 64 * MEGABYTE
            self.assertLess(peak - self.own, limit, said)
            # Little files take little.
            if unpacked is None and len(content) < 4096:
                self.assertLess(peak, self.own + 40 * MEGABYTE, said)

    def test_png(self):
        huge = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 8, 16, 0, 0, 0, 0))
        for name in (b"tEXt", b"iTXt", b"zTXt", b"iCCP", b"IDAT", b"PLTE", b"eXIf"):
            self.follows("text.png", huge + struct.pack(">I", 0x7fffffff) + name + b"ab", says=["truncated"])
        for depth, kind in ((1, 0), (8, 0), (16, 0), (16, 6), (8, 3)):
            palette = chunk(b"PLTE", b"abc" * 4) if kind == 3 else b""
            for interlaced in (0, 1):
                self.follows("claim.png", png(SIDE, SIDE, bytes(5), depth, kind, interlaced, palette), says=["truncated"])
        self.follows("wide.png", png(100000, 100000, bytes(5)), says=["100000x100000"])

    def test_what_a_png_holds_beside_pixels_is_not_unpacked(self):
        bomb = zlib.compress(bytes(300 * MEGABYTE), 9)
        for part in (chunk(b"zTXt", b"Comment\0\0" + bomb), chunk(b"iCCP", b"name\0\0" + bomb),
                     chunk(b"iTXt", b"Comment\0\1\0\0\0" + bomb)):
            self.follows("bomb.png", png(33, 33, ramp(), before=part), code=DONE, unpacked=0)

    def test_masks(self):
        (self.folder / "ground.png").write_bytes(png(33, 33, ramp()))
        for name, content in (("a.png", png(11000, 11000, bytes(5), 8, 6)), ("a.bmp", bmp(11000, 11000)),
                              ("a.tga", tga(11000, 11000)), ("b.tga", tga(11000, 11000, True)),
                              ("a.jpg", jpeg(11000, 11000)), ("b.jpg", jpeg(11000, 11000, True))):
            self.follows(name, content, "--mask", f"texture:{name}:R", ground="plane", says=["truncated"])
        for name, content in (("h.png", png(SIDE, SIDE, bytes(5))), ("h.bmp", bmp(11000, 11000)),
                              ("h.tga", tga(11000, 11000)), ("h.jpg", jpeg(11000, 11000))):
            self.follows(name, content, "--hole-mask", name, ground="ground.png")

    def test_exr(self):
        for compression in range(10):
            self.follows("claim.exr", exr(SIDE, SIDE, compression=compression))
        self.follows("tiles.exr", exr(SIDE, SIDE, tile=(1, 1)), says=["truncated"])
        self.follows("tile.exr", exr(SIDE, SIDE, tile=(4096, 4096), data=bytes(100)))
        self.follows("wide.exr", exr(2000000000, 2000000000), says=["2000000000x2000000000"])
        for kind in (b"string", b"preview", b"stringvector", b"opaque", b"floatvector"):
            self.follows("text.exr", exr(8, 8, attribute(b"note", kind, b"ab", 0x7ffffff0)), says=["truncated"])
        inner = struct.pack("<ii", 0x7ffffff0, 1)
        for kind in (b"preview", b"stringvector", b"idmanifest"):
            self.follows("inner.exr", exr(8, 8, attribute(b"note", kind, inner)))

    def test_grids_and_raw_heights(self):
        self.follows("claim.asc", asc(SIDE, SIDE), says=["truncated"])
        self.follows("rows.asc", asc(2, 8000000))
        self.follows("claim.r16", bytes(10), "--size", "4000x4000", says=["4000x4000"])
        self.follows("a.hgt", bytes(10), says=["10 bytes"])

    def test_json(self):
        deep = b"[" * 100000
        self.follows("deep.json", deep, says=["deep"])
        wide = b'{"species": [' + b"0," * (7 << 20) + b"0]}"
        self.follows("wide.json", wide, "--meadow", "wide.json", ground="plane")
        self.follows("long.json", b'{"name": "' + b"a" * (4 << 20), "--meadow", "long.json", ground="plane", says=["truncated"])
        self.follows("strokes.json", deep, "--paint", "strokes.json", ground="plane", says=["deep"])


if __name__ == "__main__":
    unittest.main()
