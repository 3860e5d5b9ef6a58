"""examples/web: Sward's grass in scenes of three.js and Babylon.js. Long: it runs them in Chromium."""

import base64
import shutil
import sys
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "view"))

from support import CliTest, ROOT

from browser import look
from needs import needs

HERE = Path(__file__).resolve().parent
EXAMPLES = ROOT / "examples/web"


class Examples(unittest.TestCase):
    def test_examples_fetch_nothing_from_elsewhere(self):
        for name in ("three", "babylon"):
            text = (EXAMPLES / name / "index.html").read_text(encoding="utf-8")
            self.assertNotIn("https://", text)
            self.assertIn("Grass.open(", text)


class LongExamples(CliTest):
    def pictures_of(self, name):
        from export.node_readers import installed
        from png import picture_of
        needs("chromium")
        folder = self.folder / name
        folder.mkdir()
        shutil.copy(EXAMPLES / name / "index.html", folder)
        shutil.copy(HERE / "embed_checks.html", folder)
        (folder / "node_modules").symlink_to(installed(EXAMPLES / name, f"web-{name}"))
        ground = self.write_json("ground.json", {"kind": "hills", "extent": [6, 6], "cells": [48, 48], "seed": 3,
                                                 "height": 0.3, "width": 3, "octaves": 3})
        self.sward("export", self.bake(ground, "--count", "20000"), "-o", f"{folder}/page/")
        found = look(self, folder, "embed_checks.html", greets=["Babylon.js v"])
        pictures = {}
        for key, data in found["pictures"].items():
            file = self.folder / f"{name}-{key}.png"
            file.write_bytes(base64.b64decode(data))
            pictures[key] = picture_of(file)[:, :, :3].astype(float) / 255.0
        return pictures

    def assert_depth_is_shared(self, name):
        """The ball hides the grass behind it, and grass before it hides the ball."""
        pictures = self.pictures_of(name)
        red = {key: (p[:, :, 0] > 0.3) & (p[:, :, 0] > 2.0 * p[:, :, 1]) for key, p in pictures.items()}
        ball = red["ball"]
        self.assertGreater(int(ball.sum()), 500)
        self.assertEqual(int(red["grass"].sum()), 0)
        rows = numpy.flatnonzero(ball.any(axis=1))
        third = (rows[-1] - rows[0] + 1) // 3
        top = numpy.zeros_like(ball)
        top[rows[0]:rows[0] + third] = True
        foot = numpy.zeros_like(ball)
        foot[rows[-1] + 1 - third:rows[-1] + 1] = True
        # Without the ball there is grass where its upper part is; with it, none of that shows.
        self.assertGreater(float(red["both"][ball & top].mean()), 0.98)
        behind = numpy.abs(pictures["grass"] - pictures["ball"]).max(axis=2)
        self.assertGreater(float((behind[ball & top] > 0.1).mean()), 0.9)
        # Its foot stands in grass: partly hidden, and partly seen between the blades.
        seen = float(red["both"][ball & foot].mean())
        self.assertLess(seen, 0.95)
        self.assertGreater(seen, 0.1)
        # The host finds its context as it was: its own picture is the same before and after.
        self.assertLess(float(numpy.abs(pictures["again"] - pictures["ball"]).max()), 2.5 / 255.0)

    def test_three(self):
        self.assert_depth_is_shared("three")

    def test_babylon(self):
        self.assert_depth_is_shared("babylon")


if __name__ == "__main__":
    unittest.main()
