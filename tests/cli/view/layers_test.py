"""`sward-view render --layers`: the same numbers in every kind of file, of blades that --dump-blades knows."""

import csv
import os
import subprocess
import struct
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1] / "trace"))

from exr import read_parts

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
WIDTH, HEIGHT = 64, 36
BLADE = 2**53


def words_of(path):
    """The numbers of a PNG of 16 bits that Sward writes: all rows have the filter of differences."""
    data = path.read_bytes()
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    assert depth == 16, path
    channels = {0: 1, 2: 3, 6: 4}[kind]
    packed, at = b"", 8
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        assert zlib.crc32(data[at + 4:at + 8 + length]) == struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0]
        packed += data[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, -1)
    assert (rows[:, 0] == 1).all()
    bytes_ = rows[:, 1:].reshape(height, width, channels, 2).cumsum(axis=1, dtype=np.uint8).astype(np.uint16)
    return (bytes_[..., 0] << 8 | bytes_[..., 1]).squeeze()


class LayersCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-layers-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.run_program(SWARD, "bake", "plane", "--scale", "0.2", "--count", "3000", "--blade-scale", "1", "-o", "f.sward")
        cls.render("-o", "f.npz", "--layers", "all", "--frames", "1:1", "--dump-blades", "d.csv")
        cls.arrays = np.load(cls.folder / "f.npz")

    @classmethod
    def run_program(cls, *arguments, code=0):
        done = subprocess.run(list(map(str, arguments)), cwd=cls.folder, env=ENVIRONMENT, text=True,
                              capture_output=True)
        assert done.returncode == code, (arguments, done.stdout, done.stderr)
        return done

    @classmethod
    def render(cls, *arguments, fields=("f.sward",), code=0):
        return cls.run_program(VIEWER, "render", *fields, "--size", f"{WIDTH}x{HEIGHT}", "--samples", "1",
                               "--camera", "eye", "--wind-strength", "4", *arguments, code=code)


class Layers(LayersCase):
    def test_arrays_have_their_forms(self):
        forms = {"color": ("f2", 3), "depth": ("f4", 0), "planar-depth": ("f4", 0), "normal": ("f2", 3),
                 "albedo": ("f2", 3), "id": ("u8", 0), "plant": ("u8", 0), "species": ("u1", 0), "patch": ("u4", 0),
                 "class": ("u1", 0), "flow-backward": ("f4", 2), "flow-forward": ("f4", 2), "coverage": ("f2", 0),
                 "sun": ("f2", 0)}
        self.assertEqual(set(self.arrays.files), set(forms))
        for name, (kind, channels) in forms.items():
            array = self.arrays[name]
            self.assertEqual(array.dtype, np.dtype("<" + kind), name)
            self.assertEqual(array.shape, (HEIGHT, WIDTH) + ((channels,) if channels else ()), name)

    def test_layers_agree_with_each_other_and_with_the_dump(self):
        a = {name: self.arrays[name] for name in self.arrays.files}
        blade, sky = a["class"] == 2, a["class"] == 0
        self.assertGreater(blade.mean(), 0.2)
        self.assertGreater(sky.mean(), 0.05)
        for name in ("id", "plant", "species", "patch", "coverage"):
            self.assertTrue(((a[name] != 0) == blade).all(), name)
        self.assertTrue((np.isinf(a["depth"]) == sky).all())
        seen = ~sky
        self.assertTrue((a["planar-depth"][seen] <= a["depth"][seen] * (1 + 1e-6)).all())
        lengths = np.linalg.norm(a["normal"].astype(float), axis=2)
        self.assertLess(abs(lengths[seen] - 1).max(), 2e-3)
        self.assertTrue((lengths[sky] == 0).all())
        self.assertTrue(((0 <= a["sun"]) & (a["sun"] <= 1)).all())
        self.assertTrue((a["id"][blade] // BLADE == 1).all())
        with open(self.folder / "d.csv", encoding="utf-8") as file:
            drawn = {int(row["id"]) for row in csv.DictReader(file) if row["cull_result"] == "drawn"}
        self.assertLessEqual({int(i) % BLADE for i in np.unique(a["id"][blade])}, drawn)
        # The camera stands still: only what the wind moves does.
        for flow in ("flow-backward", "flow-forward"):
            self.assertTrue((np.abs(a[flow][a["class"] == 1]) < 1e-3).all())
            self.assertGreater(np.abs(a[flow][blade]).max(), 0.01)

    def test_every_file_has_the_same_numbers(self):
        self.render("-o", "f.exr", "--layers", "all", "--frames", "1:1")
        parts = read_parts(self.folder / "f.exr")
        self.assertEqual(list(parts)[0], "color")
        self.assertEqual(set(parts), set(self.arrays.files))
        for name, (size, channels) in parts.items():
            self.assertEqual(size, (WIDTH, HEIGHT))
            expected = self.arrays[name].reshape(WIDTH * HEIGHT, -1)
            if name in ("id", "plant"):
                found = np.array(channels["low"], np.uint64) | np.array(channels["high"], np.uint64) << np.uint64(32)
                self.assertTrue((found == expected[:, 0]).all(), name)
                continue
            order = ["R", "G", "B"] if "R" in channels else sorted(channels)
            found = np.stack([np.array(channels[channel]) for channel in order], axis=1)
            np.testing.assert_array_equal(found.astype(expected.dtype), expected, name)

        self.render("-o", "f.png", "--layers", "depth,normal,id,flow-backward,class,sun", "--frames", "1:1")
        depth = words_of(self.folder / "f.depth.png")
        far = np.isinf(self.arrays["depth"])
        self.assertTrue((depth[far] == 65535).all())
        np.testing.assert_allclose(depth[~far], np.clip(1000 * self.arrays["depth"][~far], 0, 65535), atol=0.51)
        normal = words_of(self.folder / "f.normal.png") / 32767.5 - 1
        np.testing.assert_allclose(normal, self.arrays["normal"].astype(float), atol=2e-5)
        ids = words_of(self.folder / "f.id.png").astype(np.uint64)
        self.assertTrue((sum(ids[..., i] << np.uint64(16 * i) for i in range(4)) == self.arrays["id"]).all())
        flow = (words_of(self.folder / "f.flow-backward.png")[..., :2].astype(float) - 32768) / 64
        np.testing.assert_allclose(flow, self.arrays["flow-backward"], atol=1 / 127)
        self.assertTrue((words_of(self.folder / "f.class.png") == self.arrays["class"]).all())
        self.assertFalse((self.folder / "f.albedo.png").exists())

    def test_ids_tell_the_fields_apart_that_are_drawn_together(self):
        self.run_program(SWARD, "bake", "plane", "--scale", "0.2", "--count", "200", "--blade-scale", "1", "-o", "g.sward")
        self.render("-o", "two.npz", "--layers", "id", fields=("f.sward", "g.sward"))
        ids = np.load(self.folder / "two.npz")["id"]
        self.assertEqual(set(np.unique(ids // BLADE)), {0, 1, 2})

    def test_wrong_words_are_refused(self):
        self.assertIn("'colour' is not all or one of depth", self.render("-o", "x.npz", "--layers", "depth,colour", code=1).stderr)
        self.assertIn("--reference", self.render("-o", "x.exr", "--layers", "id", "--reference", code=1).stderr)
        self.render("-o", "x.npz", "--layers", "id", "--geometry", "tessellation", code=5)
        self.assertEqual(list(self.folder.glob("x.*")), [])


class LongLayers(LayersCase):
    """gpu.frame.LayersTest says the same of the renderer."""

    def test_layers_leave_the_picture_as_it_is(self):
        self.render("-o", "p_%d.png", "--frames", "0:2")
        self.render("-o", "l_%d.png", "--frames", "0:2", "--layers", "flow-forward,id")
        for frame in range(3):
            self.assertEqual((self.folder / f"p_{frame}.png").read_bytes(), (self.folder / f"l_{frame}.png").read_bytes())


if __name__ == "__main__":
    unittest.main()
