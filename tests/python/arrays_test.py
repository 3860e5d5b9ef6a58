"""Arrays that a bake takes or refuses: shape, dtype, NaN, strides, read-only, empty, indices."""

import unittest

import numpy
import sward
from sward._arrays import mask_of

from case import PythonCase, grid, hills


class AnyLayoutGivesTheSameField(PythonCase):
    def assert_same_fields(self, fields):
        first = self.bytes_of(fields[0])
        for field in fields[1:]:
            self.assertEqual(self.bytes_of(field), first)

    def test_of_heights(self):
        heights = hills()
        frozen = heights.copy()
        frozen.setflags(write=False)
        wide = numpy.zeros((33, 66), numpy.float32)
        wide[:, ::2] = heights
        forms = [heights, frozen, wide[:, ::2], numpy.asfortranarray(heights), heights[::-1][::-1],
                 heights.astype(numpy.float64), heights.astype(">f4"), heights.tolist()]
        self.assert_same_fields([sward.bake(form, extent=(32, 24), count=500) for form in forms])
        self.assertTrue((frozen == heights).all())

    def test_of_whole_metres(self):
        whole = numpy.rint(hills()).astype(numpy.int16)
        self.assert_same_fields([sward.bake(form, extent=(32, 24), count=500)
                                 for form in (whole, whole.astype(numpy.float32), whole.astype(numpy.int64))])

    def test_of_meshes(self):
        vertices, triangles = grid()
        pairs = [(vertices, triangles), (numpy.asfortranarray(vertices), triangles.astype(numpy.uint8)),
                 (vertices, triangles.astype(numpy.uint64)), (vertices.tolist(), triangles.tolist()),
                 (vertices[::-1][::-1], numpy.asfortranarray(triangles, numpy.int32))]
        self.assert_same_fields([sward.bake(pair, count=500) for pair in pairs])

    def test_of_colours(self):
        vertices, triangles = grid()
        bytes3 = numpy.tile(numpy.array([[0, 51, 255]], numpy.uint8), (len(vertices), 1))
        bytes4 = numpy.concatenate([bytes3, numpy.full((len(vertices), 1), 255, numpy.uint8)], axis=1)
        self.assert_same_fields([sward.bake((vertices, triangles, colors), count=500, mask="vertex-color:G")
                                 for colors in (bytes3, bytes4, (bytes3 / 255).astype(numpy.float32))])


class NoHeight(PythonCase):
    def test_is_a_hole(self):
        heights = numpy.zeros((33, 33))
        heights[:, :16] = numpy.nan
        blades = sward.bake(heights, extent=(32, 32), count=500).blades()
        self.assertGreaterEqual(blades["root"][:, 0].min(), -0.01)

    def test_may_be_a_value(self):
        heights = numpy.zeros((33, 33))
        heights[:, :16] = -7
        blades = sward.bake(heights, extent=(32, 32), count=500, no_data=-7).blades()
        self.assertGreaterEqual(blades["root"][:, 0].min(), -0.01)

    def test_may_be_masked(self):
        heights = hills()
        masked = numpy.ma.masked_array(heights, mask=heights > 2)
        fields = [sward.bake(ground, extent=(32, 24), count=300) for ground in (masked, numpy.where(heights > 2, numpy.nan, heights))]
        self.assertEqual(self.bytes_of(fields[0]), self.bytes_of(fields[1]))
        self.assertTrue(sward.bake(masked.astype(int), extent=(32, 24), count=10))

    def test_is_no_number_of_an_array(self):
        for height in (-9999, -32768, 0):
            blades = sward.bake(numpy.full((5, 5), float(height)), extent=(4, 4), count=20).blades()
            numpy.testing.assert_allclose(blades["root"][:, 1], height, atol=0.01)

    def test_everywhere_is_an_error(self):
        with self.assertRaises(sward.Error) as raised:
            sward.bake(numpy.full((9, 9), numpy.nan), extent=(8, 8), count=10)
        self.assertEqual(raised.exception.kind, "input")


class RefusedGround(PythonCase):
    def refused(self, kind, says, ground, **options):
        with self.assertRaisesRegex(kind, says):
            sward.bake(ground, count=10, **options)

    def test_heights(self):
        self.refused(ValueError, r"heights: has shape \(9,\)", numpy.zeros(9))
        self.refused(ValueError, r"heights: has shape \(9, 9, 3\)", numpy.zeros((9, 9, 3)))
        self.refused(ValueError, r"heights: has shape \(1, 9\)", numpy.zeros((1, 9)))
        self.refused(ValueError, "heights: is empty", numpy.zeros((0, 9)))
        self.refused(TypeError, "heights: has dtype object", numpy.array([[None, 1], [2, 3]]))
        self.refused(TypeError, "heights: has dtype complex", numpy.zeros((9, 9), complex))
        self.refused(TypeError, "heights: has dtype bool", numpy.zeros((9, 9), bool))
        self.refused(TypeError, "heights: has dtype <U1", numpy.full((9, 9), "x"))
        self.refused(TypeError, "heights: ", [[1, 2], [3]])
        self.refused(TypeError, "the ground is a path", None)
        self.refused(TypeError, "the ground is a path", {"heights": 1})
        self.refused(TypeError, "a mesh is a tuple", list(grid()))
        self.refused(TypeError, "lists ndarray beside a path", ["hills", numpy.zeros((9, 9))])
        self.refused(ValueError, "empty path", "")
        for number in (numpy.inf, -numpy.inf, 1e300, -5e6):
            bad = numpy.zeros((9, 9))
            bad[2, 7] = number
            self.refused(ValueError, rf"heights: {number} at \[2, 7\]; from -1000000 to 1000000 m".replace("+", r"\+"), bad)
        self.refused(ValueError, r"heights: inf at \[0, 1\]", numpy.array([[0, numpy.inf], [1, 2]], numpy.float16))
        self.refused(sward.Error, "--height 0:10000000 is not a range", numpy.zeros((9, 9)), height=(0, 1e7))

    def test_vertices(self):
        vertices, triangles = grid()
        self.refused(ValueError, r"vertices: has shape \(81, 2\), not \(n, 3\)", (vertices[:, :2], triangles))
        self.refused(ValueError, "vertices: is empty", (vertices[:0], triangles))
        self.refused(TypeError, "vertices: has dtype object", (vertices.astype(object), triangles))
        for number in (numpy.nan, numpy.inf):
            bad = vertices.copy()
            bad[5, 1] = number
            self.refused(ValueError, rf"vertices: {number} at \[5, 1\]; all numbers must be finite", (bad, triangles))
        self.refused(sward.Error, "coordinate|reach|30000000|3e\\+07", (vertices.astype(float) * 1e9, triangles))

    def test_triangles(self):
        vertices, triangles = grid()
        self.refused(ValueError, r"triangles: has shape \(128, 2\), not \(m, 3\)", (vertices, triangles[:, :2]))
        self.refused(TypeError, "triangles: has dtype float64; integers", (vertices, triangles.astype(float)))
        self.refused(ValueError, "triangles: is empty", (vertices, triangles[:0]))
        for index in (-1, 81, 2**40):
            bad = triangles.astype(numpy.int64)
            bad[7, 2] = index
            self.refused(ValueError, f"triangle 7 names vertex {index}, but there are 81", (vertices, bad))
        flat = numpy.zeros_like(triangles)
        self.refused(sward.Error, "mesh: none of the 128 triangles has an area", (vertices, flat))

    def test_colours(self):
        vertices, triangles = grid()
        colors = numpy.ones((81, 3))
        self.refused(ValueError, r"colors: has shape \(80, 3\)", (vertices, triangles, colors[1:]))
        self.refused(ValueError, "colors: from 1.0 to 2.0", (vertices, triangles, colors + numpy.eye(81, 3)))
        self.refused(TypeError, "colors: has dtype int64", (vertices, triangles, colors.astype(numpy.int64)))

    def test_attributes(self):
        vertices, triangles = grid()
        with self.assertRaisesRegex(ValueError, "begins with _"):
            sward.Mesh(vertices, triangles, attributes={"wet": numpy.ones(81)})
        with self.assertRaisesRegex(ValueError, r"attributes\['_WET'\]: has shape \(80, 1\)"):
            sward.Mesh(vertices, triangles, attributes={"_WET": numpy.ones(80)})
        with self.assertRaisesRegex(ValueError, r"attributes\['_WET'\]: 1e\+300 at \[7, 0\] is too large"):
            sward.Mesh(vertices, triangles, attributes={"_WET": numpy.where(numpy.arange(81) == 7, 1e300, 0)})
        with self.assertRaisesRegex(TypeError, "vertices: is a masked array"):
            sward.Mesh(numpy.ma.masked_array(vertices, mask=vertices > 7), triangles)
        with self.assertRaisesRegex(ValueError, "uvs: "):
            sward.Mesh(vertices, triangles, uvs=numpy.full((81, 2), numpy.nan))
        self.refused(sward.Error, "mesh: material .* has no vertex attribute _DRY", (vertices, triangles),
                     mask="vertex-color:_DRY")


class Words(unittest.TestCase):
    """What masks become: words of 16 bits."""

    def test_of_any_byte_order(self):
        words = numpy.array([[0, 258, 65535]], numpy.uint16)
        for form in ("<u2", ">u2"):
            self.assertEqual(mask_of("mask", words.astype(form)).tolist(), words.tolist())

    def test_of_floats_of_any_size(self):
        for form in ("f2", "f4", "f8", ">f8", "longdouble"):
            self.assertEqual(mask_of("mask", numpy.array([[1, 0.5, 0.25, 0]], form)).tolist(), [[65535, 32768, 16384, 0]])

    def test_of_what_is_masked(self):
        for numbers in (numpy.ones((1, 2)), numpy.ones((1, 2), bool), numpy.full((1, 2), 255, numpy.uint8)):
            masked = numpy.ma.masked_array(numbers, mask=[[True, False]])
            self.assertEqual(mask_of("mask", masked).tolist(), [[0, 65535]])


class RefusedMasks(PythonCase):
    def test_of_other_shapes_types_and_values(self):
        for kind, says, mask in ((ValueError, "mask: has shape", numpy.ones(5)),
                                 (ValueError, "mask: is empty", numpy.ones((0, 3))),
                                 (ValueError, "mask: from 0.0 to 1.5", numpy.array([[0, 1.5]])),
                                 (ValueError, "mask: nan at", numpy.array([[0, numpy.nan]])),
                                 (TypeError, "mask: has dtype int64", numpy.ones((3, 3), numpy.int64)),
                                 (ValueError, "mask 1: ", [numpy.ones((2, 2)), numpy.ones(3)])):
            with self.subTest(says=says), self.assertRaisesRegex(kind, says):
                sward.bake(numpy.zeros((5, 5)), extent=(4, 4), count=10, mask=mask)


if __name__ == "__main__":
    unittest.main()
