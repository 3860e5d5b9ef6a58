"""A turned mesh bakes to the turned field, and `sward compare` tells."""

import json
import re
import unittest

from meshes import bumps, glb_bytes, obj_text, rotation
from support import CliTest, DIFFERENCE, INPUT, IO, USAGE

AXIS, ANGLE = (1.0, 2.0, -0.5), 2.1
# By default a heightfield bears no grass on cliffs, and what is a cliff depends on the direction up.
# The slow waves and the wide variation of a meadow lie in the world, and a turned mesh lies in others of them.
COUNT = ("--count", "20000", "--slope", "0:180", "--set", "height_waves=0", "--set", "drifts=0", "--set",
         "wide_variation=0")


class Turned(CliTest):
    def assert_same_when_turned(self, first, second, transform):
        done = self.sward("compare", first, second, "--transform", transform, "--match", "id",
                          "--tolerance", "1e-3")
        # A turn changes the last bits of areas: one blade in ten thousand may move to a neighbour.
        matched = int(re.search(r"matched by id +(\d+)\n", done.stdout)[1])
        self.assertGreaterEqual(matched, 20000 - 2)
        # The turn matters: without it nothing fits.
        self.sward("compare", first, second, "--match", "id", code=DIFFERENCE)

    def test_a_node_s_rotation_turns_the_field(self):
        rows, quaternion = rotation(AXIS, ANGLE)
        mesh = bumps()
        (self.folder / "a.glb").write_bytes(glb_bytes(mesh))
        (self.folder / "b.glb").write_bytes(glb_bytes(mesh, node={"rotation": quaternion}))
        self.bake("a.glb", *COUNT, to="a.sward")
        self.bake("b.glb", *COUNT, to="b.sward")
        self.write_json("turn.json", {"rotation": quaternion})
        self.assert_same_when_turned("a.sward", "b.sward", "turn.json")
        self.write_json("rows.json", {"matrix": rows})
        self.assert_same_when_turned("a.sward", "b.sward", "rows.json")

    def test_turned_vertices_of_an_obj_turn_the_field(self):
        rows, _ = rotation(AXIS, ANGLE)
        mesh = bumps()
        (self.folder / "a.obj").write_text(obj_text(mesh))
        (self.folder / "b.obj").write_text(obj_text(mesh.moved(rows)))
        self.bake("a.obj", *COUNT, to="a.sward")
        self.bake("b.obj", *COUNT, to="b.sward")
        self.write_json("turn.json", rows)
        self.assert_same_when_turned("a.sward", "b.sward", "turn.json")

    def test_the_sphere_upside_down_with_a_translation(self):
        self.sward("terrain", "sphere", "-o", "a.glb")
        quaternion, shift = [1.0, 0.0, 0.0, 0.0], [3.0, -40.0, 7.0]
        self.turn_root("a.glb", "b.glb", {"rotation": quaternion, "translation": shift})
        self.bake("a.glb", *COUNT, to="a.sward")
        self.bake("b.glb", *COUNT, to="b.sward")
        self.write_json("turn.json", {"rotation": quaternion, "translation": shift})
        self.assert_same_when_turned("a.sward", "b.sward", "turn.json")

    def turn_root(self, source, target, placing):
        """Rewrites a GLB with a new root node above its scene."""
        from struct import unpack

        from meshes import container
        content = (self.folder / source).read_bytes()
        size = unpack("<I", content[12:16])[0]
        document = json.loads(content[20:20 + size])
        roots = document["scenes"][document.get("scene", 0)]["nodes"]
        document["nodes"].append({"name": "turn", "children": list(roots), **placing})
        roots[:] = [len(document["nodes"]) - 1]
        (self.folder / target).write_bytes(
            container(json.dumps(document).encode(), content[20 + size + 8:]))


class Compare(CliTest):
    def setUp(self):
        super().setUp()
        self.bake("hills", "--count", "2000", "--seed", "1", to="a.sward")

    def test_a_field_is_the_same_as_itself(self):
        done = self.sward("compare", "a.sward", "a.sward")
        self.assertIn("the same\n", done.stdout)
        self.sward("compare", "a.sward", "a.sward", "--match", "order", "--tolerance", "0")

    def test_unrelated_fields_differ_with_code_7_and_a_reason(self):
        self.bake("hills", "--count", "2000", "--seed", "2", to="b.sward")
        for match in ("id", "order"):
            with self.subTest(match=match):
                done = self.sward("compare", "a.sward", "b.sward", "--match", match, code=DIFFERENCE)
                self.assertIn("different: ", done.stdout)

    def test_a_subset_differs(self):
        self.bake("hills", "--count", "1000", "--seed", "1", to="b.sward")
        self.sward("compare", "a.sward", "b.sward", code=DIFFERENCE)

    def test_other_blades_on_the_same_roots_differ(self):
        self.bake("hills", "--count", "2000", "--seed", "1", "--align", "vertical", to="b.sward")
        done = self.sward("compare", "a.sward", "b.sward", code=DIFFERENCE)
        self.assertRegex(done.stdout, r"matched by id +2000\n")
        self.assertIn("up", done.stdout.split("different: ", 1)[1])

    def test_roots_farther_apart_than_the_tolerance_differ(self):
        self.write_json("shift.json", {"translation": [0.01, 0, 0]})
        self.sward("compare", "a.sward", "a.sward", "--transform", "shift.json", code=DIFFERENCE)
        self.sward("compare", "a.sward", "a.sward", "--transform", "shift.json", "--tolerance", "0.011")

    def test_every_way_to_write_a_transform_means_the_same(self):
        rows, quaternion = rotation(AXIS, ANGLE)
        shift = [5.0, -3.0, 2.0]
        nested = [row + [t] for row, t in zip(rows, shift)] + [[0, 0, 0, 1]]
        flat = [nested[row][column] for column in range(4) for row in range(4)]
        self.write_json("reference.json", {"rotation": quaternion, "translation": shift, "scale": 1})
        mesh = bumps()
        (self.folder / "a.glb").write_bytes(glb_bytes(mesh))
        (self.folder / "b.glb").write_bytes(
            glb_bytes(mesh, node={"rotation": quaternion, "translation": shift}))
        self.bake("a.glb", *COUNT, to="level.sward")
        self.bake("b.glb", *COUNT, to="turned.sward")
        for form in (nested, flat, {"matrix": nested}, {"matrix": flat},
                     {"rotation": quaternion, "translation": shift}):
            with self.subTest(form=form):
                self.write_json("turn.json", form)
                self.sward("compare", "level.sward", "turned.sward", "--transform",
                           "turn.json")

    def test_what_is_not_a_rotation_with_uniform_scale_is_invalid(self):
        zero = [[0, 0, 0]] * 3
        cases = {
            "shear": [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]],
            "mirror": [[-1, 0, 0], [0, 1, 0], [0, 0, 1]],
            "uneven": [[2, 0, 0], [0, 1, 0], [0, 0, 1]],
            "nothing": zero,
            "perspective": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0.1, 1]],
            "short": [1, 2, 3],
            "texts": {"matrix": ["a"] * 16},
            "quaternion": {"rotation": [1, 1, 1, 1]},
            "unknown": {"rotate": [0, 0, 0, 1]},
            "number": 5,
        }
        for name, value in cases.items():
            with self.subTest(name=name):
                self.write_json(f"{name}.json", value)
                self.refused("compare", "a.sward", "a.sward", "--transform", f"{name}.json",
                             code=INPUT, names=[f"{name}.json"])
        (self.folder / "broken.json").write_text('{"matrix": [1, ')
        self.refused("compare", "a.sward", "a.sward", "--transform", "broken.json", code=INPUT,
                     names=["broken.json"])
        self.refused("compare", "a.sward", "a.sward", "--transform", "none.json", code=IO,
                     names=["none.json"])

    def test_wrong_usage_is_not_a_difference(self):
        self.refused("compare", "a.sward", code=USAGE, names=["B"])
        self.refused("compare", "a.sward", "a.sward", "--match", "colour", code=USAGE, names=["--match"])
        self.refused("compare", "a.sward", "b.sward", code=IO, names=["b.sward"])


if __name__ == "__main__":
    unittest.main()
