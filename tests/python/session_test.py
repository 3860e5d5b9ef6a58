"""sward.Session: painted and changed ground, byte for byte as a whole bake."""

import unittest
import warnings

import numpy
import sward

from case import PythonCase, grid, hills

ERASE = {"kind": "erase", "radius_m": 3, "points": [[0, 0, 0], [4, 1, 4]]}
TALL = {"kind": "height", "radius_m": 2, "factor": 1.5, "points": [[-4, 0, -4]]}


class Painting(PythonCase):
    def test_strokes_give_the_bytes_of_a_whole_bake(self):
        session = sward.Session("hills", density=2)
        bare = self.bytes_of(session.field())
        self.assertEqual(bare, self.bytes_of(sward.bake("hills", density=2)))
        change = session.paint([ERASE])
        self.assertTrue(change["cells"] and change["blades"] > 0)
        session.paint([TALL])
        self.assertEqual(len(session.strokes), 2)
        self.assertEqual(self.bytes_of(session.field()), self.bytes_of(sward.bake("hills", density=2, paint=[ERASE, TALL])))
        session.paint([], keep=0)
        self.assertEqual(self.bytes_of(session.field()), bare)
        session.save(self.folder / "saved.sward")
        self.assertEqual((self.folder / "saved.sward").read_bytes(), bare)

    def test_a_fault_changes_nothing(self):
        session = sward.Session("hills", density=2)
        count = len(session)
        with self.assertRaisesRegex(sward.Error, "strokes"):
            session.paint([{**ERASE, "radius_m": -1}])
        with self.assertRaisesRegex(sward.Error, "keep is 3"):
            session.paint([ERASE], keep=3)
        for strokes in (None, ERASE, "strokes.json"):
            with self.assertRaisesRegex(TypeError, "strokes: a list of dicts"):
                session.paint(strokes)
        with self.assertRaisesRegex(ValueError, r"strokes: strokes\[0\]: points\[1\]\[0\]: nan; all numbers"):
            session.paint([{**ERASE, "points": [[0, 0, 0], numpy.array([numpy.nan, 0, 0])]}])
        with self.assertRaisesRegex(TypeError, "keep is 1.5; a whole number"):
            session.paint([], keep=1.5)
        with self.assertRaisesRegex(sward.Error, f"keep is {2**70}, and there are 0 strokes"):
            session.paint([], keep=2**70)
        with self.assertRaisesRegex(TypeError, "takes arrays, or nothing"):
            session.replace_ground("hills")
        self.assertEqual((len(session), session.strokes), (count, []))

    def test_nor_does_a_warning_that_is_an_error(self):
        ground = hills()
        session = sward.Session(ground, extent=(16, 16), density=2)
        before = self.bytes_of(session.field())
        warnings.simplefilter("error")
        with self.assertRaisesRegex(sward.Warning, "strokes"):
            session.paint([TALL, {**ERASE, "points": [[0, 500, 0]]}])
        self.assertEqual((session.strokes, self.bytes_of(session.field())), ([], before))

    def test_a_call_during_another_one_is_refused(self):
        session = sward.Session("hills", density=2)
        with self.assertRaisesRegex(sward.Error, "busy with another call"):
            session.paint([ERASE], progress=lambda fraction, text: session.field())
        self.assertEqual(len(session), len(session.field()))

    def test_lost_strokes_are_told(self):
        session = sward.Session("hills", density=1)
        with self.assertWarnsRegex(sward.Warning, "strokes"):
            session.paint([{**ERASE, "points": [[0, 500, 0]]}])

    def test_a_baked_field_is_used(self):
        field = sward.bake("hills", density=2)
        field.save(self.folder / "hills.sward")
        for given in (field, self.folder / "hills.sward"):
            self.assertTrue(sward.Session("hills", density=2, field=given).has_reused)

    def test_it_names_no_output(self):
        with self.assertRaisesRegex(TypeError, "a session writes nothing"):
            sward.Session("hills", output="no.sward")


class ChangedGround(PythonCase):
    def test_heights(self):
        heights = hills()
        session = sward.Session(heights, extent=(64, 64), density=2)
        heights[10:14, 10:14] += 1
        change = session.replace_ground(heights)
        self.assertTrue(change["cells"])
        self.assertEqual(self.bytes_of(session.field()),
                         self.bytes_of(sward.bake(heights, extent=(64, 64), density=2)))

    def test_vertices(self):
        vertices, triangles = grid()
        session = sward.Session((vertices, triangles), density=3)
        vertices[40, 1] += 0.5
        session.replace_ground((vertices, triangles))
        # A warning that is an error comes before the change: of vertices that single precision rounds.
        before = self.bytes_of(session.field())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(sward.Warning):
                session.replace_ground((vertices + numpy.float32(2e6), triangles))
        self.assertEqual(self.bytes_of(session.field()), before)
        self.assertEqual(len(session), len(session.field()))
        with self.assertRaises(sward.Error):
            session.replace_ground((vertices, triangles[1:]))


if __name__ == "__main__":
    unittest.main()
