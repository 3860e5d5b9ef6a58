"""examples/python/labels.py, small."""

import json
import os
import subprocess
import sys
import unittest

import numpy
import sward

from case import ROOT, PythonCase


class Labels(PythonCase):
    def run_example(self, *options, **environment):
        done = subprocess.run([sys.executable, ROOT / "examples/python/labels.py", self.folder / "out", "--small", *options],
                              capture_output=True, text=True, env={**os.environ, **environment})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return self.folder / "out"

    def test_it_writes_what_it_says(self):
        out = self.run_example()
        self.assertEqual({path.name for path in out.iterdir()},
                         {"meadow.sward", "frame_00.png", "frame_01.png", "frame_00.npz", "frame_01.npz", "leaf_area.png", "labels.json"})
        labels = json.loads((out / "labels.json").read_text(encoding="utf-8"))
        field = sward.read(out / "meadow.sward")
        self.assertEqual(sum(one["blades"] for one in labels.values()), len(field))
        self.assertGreater(labels["meadow"]["leaf_area_index"], labels["damp hollow"]["leaf_area_index"])
        for number in range(2):
            frame = numpy.load(out / f"frame_0{number}.npz")
            self.assertEqual(set(frame), {"depth", "id", "species", "flow-backward", "cover"})
            numpy.testing.assert_array_equal(frame["cover"] > 0, frame["id"] > 0)
            self.assertTrue(set((frame["id"][frame["id"] > 0] & (2**53 - 1)).tolist()) <= set(field.blades()["id"].tolist()))
            self.assertGreater((frame["cover"] == 2).sum(), (frame["cover"] == 1).sum(), "more of the meadow than of the path")
        # The mask is sampled between its pixels, so that a few blades stand on the border of the path.
        self.assertLess(labels["path"]["leaf_area_index"], 0.25 * labels["meadow"]["leaf_area_index"])

    def test_leaf_areas_by_height_sum_up(self):
        sys.path.insert(0, str(ROOT / "examples/python"))
        import labels
        field = sward.bake("plane", count=500, meadow="hay")
        edges, area = labels.leaf_area_by_height(field)
        self.assertAlmostEqual(area.sum() / field.blades()["area"].sum(), 1, delta=1e-4)
        labels.write_png(self.folder / "own.png", labels.numpy.zeros((4, 5, 3), labels.numpy.uint8))
        self.assertEqual((self.folder / "own.png").read_bytes()[16:24], b"\0\0\0\5\0\0\0\4")


if __name__ == "__main__":
    unittest.main()
