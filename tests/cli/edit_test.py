"""`sward edit`: a bake that stays open, told by JSON lines what is painted."""

import json
import math
import os
import signal
import struct
import subprocess
import unittest
from pathlib import Path

from support import CliTest, INPUT, INTERRUPTED, IO, PROGRAM, USAGE, digest

HEADER = struct.Struct("<8sQQ3dQ")
CELL = struct.Struct("<3q2Q")
PATCH, BLADE, KEY = 104, 16, 8


def stroke(kind, *points, radius=3.0, **more):
    """A hard stroke on level ground."""
    return {"kind": kind, "radius_m": radius, "hardness": 1, "points": [list(p) for p in points],
            "normals": [[0, 1, 0]], **more}


def cells_of(delta):
    """{cell: number of blades} of a delta, read by what docs/editing.md says."""
    data = Path(delta).read_bytes()
    magic, size, _, *origin, count = HEADER.unpack_from(data)
    assert (magic, size, origin) == (b"SWDELTA1", len(data), [0, 0, 0])
    at, cells = HEADER.size, {}
    for _ in range(count):
        x, y, z, patches, blades = CELL.unpack_from(data, at)
        at += CELL.size
        cells[x, y, z] = (patches, blades)
    assert at + sum(PATCH * p + (BLADE + KEY) * b for p, b in cells.values()) == size
    return {cell: blades for cell, (_, blades) in cells.items()}


class Session:
    """A running `sward edit`."""

    def __init__(self, folder, *arguments, environment=None):
        self.process = subprocess.Popen([str(PROGRAM), "edit", *map(str, arguments)], cwd=folder, text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        env={**os.environ, **(environment or {})})
        self.ready = self.answer()

    def answer(self):
        return json.loads(self.process.stdout.readline())

    def ask(self, request):
        line = request if isinstance(request, str) else json.dumps(request)
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        return self.answer()

    def paint(self, keep, *strokes):
        return self.ask({"id": 1, "do": "paint", "keep": keep, "strokes": list(strokes)})

    def end(self):
        """Closes the input; returns the exit code."""
        _, self.errors = self.process.communicate(timeout=60)
        return self.process.returncode


class Edit(CliTest):
    def session(self, *arguments, **how):
        session = Session(self.folder, *arguments, **how)
        self.addCleanup(session.process.wait)
        self.addCleanup(session.process.kill)
        for pipe in ("stdin", "stdout", "stderr"):
            self.addCleanup(getattr(session.process, pipe).close)
        return session

    def ground(self):
        return self.write_json("ground.json", {"kind": "plane", "size": [160, 130], "cells": [40, 32]}).name

    def painted(self, ground, strokes, to):
        """A bake with strokes, for comparison."""
        path = self.write_json("wanted.json", {"format": "sward strokes 1", "strokes": strokes})
        return digest(self.bake(ground, "--density", "3", "--paint", path.name, "--force", to=to))

    def test_a_saved_field_is_a_bake_of_its_strokes(self):
        ground = self.ground()
        session = self.session(ground, "--density", "3", "-q")
        self.assertEqual(session.ready["format"], "sward edit 1")
        self.assertFalse(session.ready["reused"])
        a, b = stroke("erase", (0, 0, 0), (30, 0, 9), radius=5), stroke("add", (-20, 0, 5), radius=9, ceiling=3)
        erased = session.paint(0, a)
        self.assertLess(erased["total"], session.ready["blades"])
        added = session.paint(1, b)
        self.assertEqual((added["strokes"], added["id"]), (2, 1))
        self.assertGreater(added["total"], erased["total"])
        session.ask({"id": 2, "do": "save", "path": "both.sward"})
        self.assertEqual(digest(self.folder / "both.sward"), self.painted(ground, [a, b], "wanted.sward"))
        # Undone, done again, and the first undone below the second.
        self.assertEqual(session.paint(1)["total"], erased["total"])
        self.assertEqual(session.paint(1, b)["total"], added["total"])
        session.paint(0, b)
        session.ask({"id": 3, "do": "save", "path": "both.sward", "overwrite": True})
        self.assertEqual(digest(self.folder / "both.sward"), self.painted(ground, [b], "wanted.sward"))
        session.ask({"id": 4, "do": "save_strokes", "path": "strokes.json"})
        self.assertEqual(len(self.read_json("strokes.json")["strokes"]), 1)
        self.assertEqual(session.ask({"id": "end", "do": "quit"}), {"id": "end", "ended": True})
        self.assertEqual(session.end(), 0)

    def test_deltas_tell_what_changes(self):
        session = self.session(self.ground(), "--density", "3", "--meadow", "grass", "-q")
        answer = session.paint(0, stroke("erase", (0, 0, 0), radius=4))
        cells = cells_of(answer["delta"])
        self.assertEqual((len(cells), sum(cells.values())), (answer["cells"], answer["blades"]))
        self.assertLess(answer["cells"], session.ready["cells"])
        self.assertAlmostEqual(session.ready["blades"] - answer["total"], math.pi * 16 * 3, delta=30)
        # Nothing to tell.
        self.assertIsNone(session.paint(1, stroke("erase", (900, 0, 0)))["delta"])
        # A cell that goes bare.
        bare = cells_of(session.paint(0, stroke("erase", (16, 0, 16), radius=30))["delta"])
        self.assertEqual(bare[0, 0, 0], 0)
        folder = Path(answer["delta"]).parent
        self.assertTrue(folder.is_dir())
        self.assertEqual(session.end(), 0)
        self.assertFalse(folder.exists())

    def test_it_goes_on_from_a_field(self):
        ground = self.ground()
        field = self.bake(ground, "--density", "3")
        session = self.session(ground, "--density", "3", "--field", field, "--deltas", self.folder, "-q")
        self.assertEqual((session.ready["reused"], session.ready["warnings"]), (True, []))
        one = stroke("height", (5, 0, 5), factor=2)
        self.assertEqual(Path(session.paint(0, one)["delta"]).parent, self.folder)
        session.ask({"id": 1, "do": "save", "path": "painted.sward"})
        self.assertEqual(digest(self.folder / "painted.sward"), self.painted(ground, [one], "wanted.sward"))
        self.assertEqual(session.end(), 0)
        self.assertEqual([name for name in self.files() if name.endswith(".swdelta")], [])
        # The field tells the options of its bake.
        taken = self.session(ground, "--field", "painted.sward", "--as-baked", "--paint", "wanted.json", "-q")
        self.assertEqual((taken.ready["reused"], taken.ready["warnings"], taken.ready["strokes"]), (True, [], 1))
        self.assertEqual(taken.end(), 0)
        self.refused("edit", ground, "--field", "painted.sward", "--as-baked", code=INPUT, names=["--paint"])
        self.refused("edit", ground, "--as-baked", code=USAGE, names=["--field"])
        self.refused("edit", ground, "--field", field, "--as-baked", "--density", "3", code=USAGE,
                     names=["--as-baked", "--density"])
        # Other options than those of the field.
        other = self.session(ground, "--density", "4", "--field", field, "-q")
        self.assertFalse(other.ready["reused"])
        self.assertIn("other options", other.ready["warnings"][-1])
        self.assertEqual(other.end(), 0)

    def test_fields_with_seeds_are_painted(self):
        ground = self.ground()
        options = ("--density", "3", "--seeds", "always")
        field = self.bake(ground, *options)
        session = self.session(ground, "--field", field, "--as-baked", "-q")
        self.assertEqual((session.ready["reused"], session.ready["seeds"]), (True, True))
        strokes = [stroke("erase", (0, 0, 0), (9, 0, 2)), stroke("add", (20, 0, 5), ceiling=2)]
        answer = session.paint(0, *strokes)
        self.assertLessEqual(answer["cells"], 4)
        self.assertEqual(Path(answer["delta"]).read_bytes()[:8], b"SWDELTA2")
        session.ask({"id": 1, "do": "save", "path": "painted.sward"})
        session.paint(0)
        session.ask({"id": 1, "do": "save", "path": "undone.sward"})
        self.assertEqual(session.end(), 0)
        path = self.write_json("wanted.json", {"format": "sward strokes 1", "strokes": strokes})
        wanted = self.bake(ground, *options, "--paint", path.name, to="wanted.sward")
        self.assertEqual(digest(self.folder / "painted.sward"), digest(wanted))
        self.assertEqual(digest(self.folder / "undone.sward"), digest(field))

    def heights(self, name, hill):
        """A heightmap of 65 x 65 samples, 2 m apart, with a hill of 6 m in one corner, or without."""
        rows = [[4000 + (hill and max(0, 6553 - 800 * ((x - 8) ** 2 + (y - 8) ** 2))) for x in range(65)]
                for y in range(65)]
        (self.folder / name).write_bytes(b"".join(struct.pack("<65H", *row) for row in rows))

    MAP = ("--size", "65x65", "--extent", "130", "130", "--height", "0:60", "--density", "3", "-q")

    def test_changed_ground_is_baked_again_where_it_differs(self):
        self.heights("map.r16", False)
        one = stroke("height", (-45, 3.66, -45), (40, 3.66, 40), factor=2)
        del one["normals"]
        session = self.session("map.r16", *self.MAP)
        session.paint(0, one)
        same = session.ask({"id": 1, "do": "ground"})
        self.assertEqual((same["id"], same["delta"], same["cells"]), (1, None, 0))
        self.heights("map.r16", True)
        answer = session.ask({"id": 2, "do": "ground"})
        self.assertEqual((answer["strokes"], answer["origin"]), (1, session.ready["origin"]))
        self.assertFalse([warning for warning in answer["warnings"] if "stroke" in warning])
        cells = cells_of(answer["delta"])
        self.assertEqual(len(cells), answer["cells"])
        self.assertLess(answer["cells"], session.ready["cells"])
        session.ask({"id": 3, "do": "save", "path": "hill.sward"})
        strokes = self.write_json("wanted.json", {"format": "sward strokes 1", "strokes": [one]})
        wanted = self.bake("map.r16", *self.MAP, "--paint", strokes.name, to="wanted.sward")
        self.assertEqual(digest(self.folder / "hill.sward"), digest(wanted))
        # What cannot replace the ground leaves it as it was.
        (self.folder / "map.r16").write_bytes(b"")
        broken = session.ask({"id": 4, "do": "ground"})
        self.assertEqual((broken["id"], broken["error"]), (4, "input"))
        self.assertIn("map.r16", broken["message"])
        (self.folder / "map.r16").unlink()
        self.assertEqual(session.ask({"id": 5, "do": "ground"})["error"], "io")
        self.assertEqual(session.ask({"id": 6, "do": "ground", "path": "x"})["error"], "usage")
        session.ask({"id": 7, "do": "save", "path": "hill.sward", "overwrite": True})
        self.assertEqual(digest(self.folder / "hill.sward"), digest(wanted))
        self.assertEqual(session.end(), 0)

    def test_strokes_that_a_new_ground_has_lost_are_told_and_moved(self):
        def flat(height):
            (self.folder / "map.r16").write_bytes(struct.pack("<4225H", *[height] * 4225))
        flat(4000)
        level = 4000 / 65535 * 60
        on, far = stroke("erase", (-40, level, 0), (40, level, 0)), stroke("erase", (0, level + 9, 0))
        session = self.session("map.r16", *self.MAP)
        self.assertEqual(session.ready["lost"], [])
        self.assertEqual(session.paint(0, {**on, "name": "Path"})["lost"], [])
        session.paint(1)
        answer = session.paint(1, far)
        self.assertEqual(answer["lost"], [{"stroke": 1, "points": 1, "lost": 1, "share": 1.0}])
        self.assertIn("strokes[1]", answer["warnings"][0])
        session.paint(1)
        flat(12000)
        answer = session.ask({"id": 1, "do": "ground"})
        self.assertEqual(answer["lost"], [{"stroke": 0, "points": 2, "lost": 2, "share": 1.0}])
        self.assertIn('strokes[0] "Path"', answer["warnings"][0])
        bare = answer["total"]
        kept = session.ask({"id": 2, "do": "move", "distance": 5})
        self.assertEqual((kept["moved"], kept["delta"], len(kept["lost"])), ([], None, 1))
        answer = session.ask({"id": 3, "do": "move", "distance": 8})
        self.assertEqual((answer["lost"], answer["strokes"]), ([], 1))
        self.assertLess(answer["total"], bare - 1000)
        [moved] = answer["moved"]
        self.assertEqual((moved["index"], moved["stroke"]["name"]), (0, "Path"))
        self.assertAlmostEqual(moved["stroke"]["points"][1][1], 12000 / 65535 * 60, delta=0.001)
        session.ask({"id": 4, "do": "save_strokes", "path": "moved.json"})
        self.assertEqual(self.read_json("moved.json")["strokes"], [moved["stroke"]])
        session.ask({"id": 4, "do": "save", "path": "moved.sward"})
        wanted = self.bake("map.r16", *self.MAP, "--paint", "moved.json", to="wanted.sward")
        self.assertEqual(digest(self.folder / "moved.sward"), digest(wanted))
        for bad in ({}, {"distance": 0}, {"distance": "2"}, {"distance": 2, "far": 1}):
            self.assertEqual(session.ask({"id": 5, "do": "move", **bad})["error"], "usage")
        self.assertEqual(session.end(), 0)
        told = self.session("map.r16", *self.MAP, "--paint", self.write_json(
            "lost.json", {"format": "sward strokes 1", "strokes": [on]}).name)
        self.assertEqual([one["stroke"] for one in told.ready["lost"]], [0])
        self.assertIn("strokes[0]", told.ready["warnings"][0])
        self.assertEqual(told.end(), 0)

    def test_the_species_that_a_line_of_sight_meets_is_told(self):
        session = self.session("plane", "--density", "400", "--meadow", "daisies", "-q")
        names = session.ready["species"]
        look = {"id": 1, "do": "species", "eye": [0, 5, 0], "direction": [0, -2, 0], "distance": 5, "spread": 0.01}
        for name in names[:2]:
            session.paint(0, stroke("species", (0, 0, 0), species=name, radius=2))
            self.assertEqual(session.ask(look)["species"], name)
        session.paint(0, stroke("erase", (0, 0, 0), radius=2))
        self.assertIsNone(session.ask(look)["species"])
        self.assertIsNone(session.ask({**look, "direction": [0, 1, 0]})["species"])
        for bad in ({"eye": 3}, {"direction": [0, 0, 0]}, {"distance": -1}, {"spread": 2}, {"eye": [0, "x", 0]}, {"x": 1}):
            self.assertEqual(session.ask({**look, **bad})["error"], "usage", bad)
        self.assertEqual(session.end(), 0)

    def test_ground_of_other_triangles_or_with_too_many_blades_is_refused(self):
        ground = self.ground()
        session = self.session(ground, "--density", "3", "--max-blades", "70000", "--meadow", "grass", "-q")
        before = session.ready["blades"]
        for size, names in (([160, 131], ["2560", "2640"]), ([160, 200], ["--max-blades 70000"])):
            cells = [40, 33] if size[1] == 131 else [40, 32]
            self.write_json("ground.json", {"kind": "plane", "size": size, "cells": cells})
            answer = session.ask({"id": 1, "do": "ground"})
            self.assertEqual(answer.get("error"), "input", answer)
            for name in names:
                self.assertIn(name, answer["message"])
        self.assertEqual(session.paint(0)["total"], before)
        self.ground()
        self.assertEqual(session.ask({"id": 2, "do": "ground"})["cells"], 0)
        self.assertEqual(session.end(), 0)

    def test_a_request_that_fails_changes_nothing(self):
        session = self.session("plane", "--density", "30", "--meadow", "grass", "--max-blades", "15000", "-q")
        before = session.paint(0, stroke("erase", (0, 0, 0)))

        def refused(request, kind, *names):
            answer = session.ask(request)
            self.assertEqual(answer.get("error"), kind, answer)
            for name in names:
                self.assertIn(name, answer["message"])
            return answer

        paint = {"id": 7, "do": "paint", "keep": 1}
        self.assertEqual(refused({**paint, "keep": 2}, "usage", "keep", "[0, 1]")["id"], 7)
        refused({**paint, "keep": -1}, "usage", "keep")
        refused({**paint, "keep": 1.5}, "usage", "keep")
        refused({"id": 7, "do": "paint"}, "usage", "keep")
        refused({**paint, "stroke": []}, "usage", "\"stroke\"")
        refused({**paint, "strokes": {}}, "input", "strokes")
        refused({**paint, "strokes": [stroke("mow", (0, 0, 0))]}, "input", "strokes[0]", "mow")
        refused({**paint, "strokes": [stroke("erase", (0, 0, 0), radius=1e9)]}, "input", "radius_m", "1000")
        refused({**paint, "strokes": [stroke("species", (0, 0, 0), species="moss")]}, "input", "moss")
        refused({**paint, "strokes": [stroke("add", (0, 0, 0), radius=9, ceiling=8)]}, "input", "--max-blades 15000")
        refused({**paint, "strokes": [stroke("erase", *[(0, 0, 0)] * 1_000_001)]}, "input", "1000000")
        refused("[1]", "input", "object")
        refused("{\"id\":", "input", "JSON")
        refused("x" * (65 << 20), "input", "67108864")
        refused({"id": [], "do": "quit"}, "usage", "id")
        refused({"id": 1, "do": "fly"}, "usage", "fly", "save_strokes")
        refused({"id": 1, "do": "save"}, "usage", "path")
        refused({"id": 1, "do": "save", "path": "a.png"}, "usage", "a.png")
        refused({"id": 1, "do": "save", "path": "none/a.sward"}, "io", "none")
        refused({"id": 1, "do": "save_strokes", "path": "a.sward"}, "usage", "a.sward")
        self.assertEqual(self.files(), set())
        (self.folder / "kept.sward").write_text("kept")
        refused({"id": 1, "do": "save", "path": "kept.sward"}, "io", "kept.sward")
        self.assertEqual((self.folder / "kept.sward").read_text(), "kept")
        after = session.paint(1)
        self.assertEqual((after["total"], after["strokes"]), (before["total"], 1))
        self.assertEqual(session.end(), 0)

    def test_a_bad_start_is_refused(self):
        self.refused("edit", code=USAGE, names=["INPUT"])
        self.refused("edit", "plane", "-o", "x.sward", code=USAGE, names=["-o"])
        self.refused("edit", "plane", "--deltas", "none", code=IO, names=["none"])
        self.refused("edit", "plane", "--field", "none.sward", code=IO, names=["none.sward"])

    def test_a_signal_ends_it_and_leaves_nothing(self):
        places = self.folder / "tmp"
        places.mkdir()
        session = self.session("plane", "--density", "30", "-q", environment={"TMPDIR": str(places)})
        session.paint(0, stroke("erase", (0, 0, 0)))
        self.assertEqual(len(list(places.iterdir())), 1)
        session.process.send_signal(signal.SIGTERM)
        self.assertEqual(session.process.wait(10), INTERRUPTED)
        self.assertEqual(list(places.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
