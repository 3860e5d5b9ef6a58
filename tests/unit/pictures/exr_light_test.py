"""scripts/exr_light.py reads what it writes, and what other programs write."""

import itertools
import struct
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "scripts"))
import exr_light  # noqa: E402


def split(block):
    """Even bytes, then odd ones, as differences: what ZIP and RLE pack. OpenEXR's ImfZip.cpp, in words."""
    values = np.frombuffer(block, np.uint8)
    values = np.concatenate([values[0::2], values[1::2]]).astype(int)
    values[1:] = np.diff(values) + 128
    return values.astype(np.uint8).tobytes()


def runs(block):
    """Alternately what repeats and what does not, one byte at least."""
    packed = b""
    for value, same in itertools.groupby(block):
        count = len(list(same))
        while count > 0:
            part = min(count, 128)
            packed += struct.pack("b", part - 1) + bytes([value]) if part > 1 else struct.pack("b", -1) + bytes([value])
            count -= part
    return packed


class Exr(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-exr-")
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "a.exr"
        random = np.random.default_rng(1)
        # Mostly nothing, so that packing pays.
        self.channels = {name: (random.normal(0.0, 5.0, (37, 23)) * (random.random((37, 23)) < 0.05)).astype(np.float32)
                         for name in ("R", "G", "B", "View.sun.R", "a name of more than thirty-one letters")}

    def assert_same(self, read):
        self.assertEqual(set(read), set(self.channels))
        for name, wanted in self.channels.items():
            np.testing.assert_array_equal(read[name], wanted)

    def test_what_is_written_is_read(self):
        exr_light.write(self.path, self.channels)
        self.assert_same(exr_light.read(self.path))

    def packed(self, compression, lines, pack):
        """The same file with packed blocks."""
        exr_light.write(self.path, self.channels)
        content = self.path.read_bytes()
        mark = b"compression\0compression\0" + struct.pack("<i", 1)
        at = content.index(mark) + len(mark)
        header_end = exr_light.attributes(content, self.path)[1]
        line, first = 4 * 23 * len(self.channels) + 8, header_end + 8 * 37
        rows = [content[first + y * line + 8:first + (y + 1) * line] for y in range(37)]
        blocks = [pack(split(b"".join(rows[y:y + lines]))) for y in range(0, 37, lines)]
        head = content[:at] + bytes([compression]) + content[at + 1:header_end]
        place, table, body = header_end + 8 * len(blocks), b"", b""
        for i, block in enumerate(blocks):
            table += struct.pack("<Q", place + len(body))
            body += struct.pack("<ii", i * lines, len(block)) + block
        self.path.write_bytes(head + table + body)

    def test_packed_blocks_are_read(self):
        for compression, lines, pack in ((1, 1, runs), (2, 1, zlib.compress), (3, 16, zlib.compress)):
            self.packed(compression, lines, pack)
            self.assert_same(exr_light.read(self.path))

    def test_runs_are_unpacked(self):
        self.assertEqual(exr_light.unpacked_runs(b"\x03a\xfexy\x00z"), b"aaaaxyz")

    def test_a_layer_has_a_colour(self):
        exr_light.write(self.path, {f"L.{letter}": np.full((2, 3), i) for i, letter in enumerate("RGB")})
        np.testing.assert_array_equal(exr_light.color(exr_light.read(self.path), "L")[1, 2], [0, 1, 2])
        with self.assertRaisesRegex(ValueError, "no channel R; there are L.B, L.G, L.R"):
            exr_light.color(exr_light.read(self.path))

    def test_other_files_are_refused_with_a_reason(self):
        exr_light.write(self.path, self.channels)
        good = self.path.read_bytes()
        mark = good.index(b"compression\0compression\0") + 28
        for content, reason in ((b"\x89PNG", "not an OpenEXR file"), (good[:5000], "damaged or cut off"),
                                (good[:5] + b"\x02" + good[6:], "tiles"),
                                (good[:mark] + b"\x04" + good[mark + 1:], "compression PIZ")):
            self.path.write_bytes(content)
            with self.assertRaisesRegex(ValueError, reason):
                exr_light.read(self.path)


if __name__ == "__main__":
    unittest.main()
