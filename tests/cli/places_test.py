"""Where grass grows: slope, altitude, clearance, roles, and the space a file is read into."""

import math
import unittest

from meshes import Mesh, glb_bytes, obj_text, square
from support import CliTest


def ramp(degrees, side=10.0):
    """A square that falls to the east."""
    mesh = square(side)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    mesh.positions = [(x * c, -x * s, z) for x, _, z in mesh.positions]
    return mesh


def scene(parts):
    """A GLB with one named node and material for each (name, mesh)."""
    positions, triangles, nodes, meshes = [], [], [], []
    for name, mesh in parts:
        first = len(positions)
        positions += mesh.positions
        begin = len(triangles)
        triangles += [tuple(i + first for i in t) for t in mesh.triangles]
        nodes.append({"mesh": len(meshes), "name": name})
        meshes.append((begin, len(mesh.triangles)))
    corners = 12 * len(positions)
    accessors = [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
                  "min": [min(p[k] for p in positions) for k in range(3)],
                  "max": [max(p[k] for p in positions) for k in range(3)]}]
    primitives = []
    for begin, count in meshes:
        primitives.append({"primitives": [{"attributes": {"POSITION": 0}, "indices": len(accessors),
                                           "material": len(primitives)}]})
        accessors.append({"bufferView": 1, "byteOffset": 12 * begin, "componentType": 5125,
                          "count": 3 * count, "type": "SCALAR"})
    return glb_bytes(Mesh(positions, triangles), document={
        "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": primitives,
        "materials": [{"name": f"{name}_material"} for name, _ in parts], "accessors": accessors,
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": corners},
                        {"buffer": 0, "byteOffset": corners, "byteLength": 12 * len(triangles)}]})


def lifted(mesh, x=0.0, y=0.0):
    return Mesh([(p[0] + x, p[1] + y, p[2]) for p in mesh.positions], mesh.triangles)


class Places(CliTest):
    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return name

    def grown(self, ground, *options):
        return self.blades(self.bake(ground, "--count", "4000", "--force", *options))

    def kept(self, ground, *options):
        return self.report(ground, "--density", "20", "--blade-scale", "1", *options)["roots"]

    def test_slope_is_measured_in_degrees_from_ground_up(self):
        self.write("ramp.glb", glb_bytes(ramp(30)))
        self.assertGreater(self.kept("ramp.glb", "--slope", "29:31")["kept"], 1900)
        below = self.kept("ramp.glb", "--slope", "0:29")
        self.assertEqual(below["kept"], 0)
        self.assertEqual(below["rejected"]["slope"], below["proposed"])
        self.assertGreater(self.kept("ramp.glb", "--slope", "59:61", "--ground-up", "x")["kept"], 1900)

    def test_a_soft_slope_thins_out(self):
        self.write("ramp.glb", glb_bytes(ramp(30)))
        roots = self.kept("ramp.glb", "--slope", "0:25~10")
        # Half way through the soft part half of all stay: ±5 standard deviations of 2000 tries.
        self.assertLess(abs(roots["kept"] / roots["proposed"] - 0.5), 0.06)

    def test_altitude_cuts_at_the_metre(self):
        self.write("ramp.glb", glb_bytes(ramp(30)))
        for blade in self.grown("ramp.glb", "--altitude", "-1:0.5"):
            self.assertTrue(-1.001 <= blade.root[1] <= 0.501, blade.root)
        self.assertGreater(max(b.root[1] for b in self.grown("ramp.glb", "--altitude", "0:")), 2.0)

    def test_grass_does_not_grow_below_a_roof_without_clearance(self):
        roof = lifted(square(4.0), y=0.3)
        self.write("house.glb", scene([("ground", square(10.0)), ("roof", roof)]))
        blades = self.grown("house.glb", "--node", "ground", "--clearance", "1")
        inside = [b for b in blades if abs(b.root[0]) < 1.99 and abs(b.root[2]) < 1.99]
        self.assertEqual(inside, [])
        self.assertTrue(all(abs(b.root[1]) < 0.001 for b in blades))
        free = self.grown("house.glb", "--node", "ground", "--clearance", "0.2")
        self.assertGreater(sum(abs(b.root[0]) < 1.99 and abs(b.root[2]) < 1.99 for b in free), 300)

    def test_an_occluder_blocks_and_bears_nothing(self):
        self.write("ground.glb", glb_bytes(square(10.0)))
        self.write("roof.glb", glb_bytes(lifted(square(4.0), y=0.3)))
        blades = self.grown("ground.glb", "--occluder", "roof.glb", "--clearance", "1")
        self.assertTrue(all(abs(b.root[1]) < 0.001 for b in blades))
        self.assertFalse(any(abs(b.root[0]) < 1.99 and abs(b.root[2]) < 1.99 for b in blades))
        # It is shown all the same.
        self.assertEqual(self.info(self.folder / "field.sward")["ground"]["triangles"], 4 * 64)

    def test_nodes_and_materials_are_chosen_by_globs(self):
        self.write("two.glb", scene([("meadow_west", lifted(square(4.0), x=-10)),
                                     ("rock_east", lifted(square(4.0), x=10))]))
        for options, west in ((("--node", "meadow*"), True), (("--node", "*east"), False),
                              (("--material", "rock_*"), False), (("--occlude-node", "rock*"), True)):
            with self.subTest(options=options):
                self.assertTrue(all((b.root[0] < 0) == west for b in self.grown("two.glb", *options)))

    def test_a_glob_that_matches_nothing_is_warned_of(self):
        self.write("ground.glb", glb_bytes(square(4.0)))
        done = self.sward("bake", "ground.glb", "-o", "f.sward", "--count", "10", "--node", "tree*")
        self.assertRegex(done.stderr, r"warning: .*tree\*")

    def test_units_and_scale_lead_to_metres(self):
        self.write("ground.glb", glb_bytes(square(1000.0)))
        for options, side in ((("--units", "cm"), 10.0), (("--units", "mm"), 1.0),
                              (("--units", "ft", "--scale", "0.01"), 3.048)):
            with self.subTest(options=options):
                report = self.report("ground.glb", "--count", "10", *options)
                self.assertAlmostEqual(report["input"]["area_m2"] / side**2, 1.0, places=5)

    def test_a_file_with_z_up_is_turned_not_mirrored(self):
        # A ramp in a file whose z points up: east stays east, and what was up is up.
        mesh = ramp(30)
        turned = Mesh([(x, -z, y) for x, y, z in mesh.positions], mesh.triangles)
        self.write("y.obj", obj_text(mesh))
        self.write("z.obj", obj_text(turned))
        self.bake("y.obj", "--count", "500", to="y.sward")
        self.bake("z.obj", "--count", "500", "--up-axis", "z", to="z.sward")
        self.sward("compare", "y.sward", "z.sward")

    def test_the_back_bears_grass_only_when_asked(self):
        self.write("ground.glb", glb_bytes(square(10.0)))
        for sides, ups in (("front", {1}), ("back", {-1}), ("both", {1, -1})):
            with self.subTest(sides=sides):
                blades = self.grown("ground.glb", "--sides", sides)
                self.assertEqual({round(blade.up[1]) for blade in blades}, ups)

    def test_alignment_turns_blades_from_the_normal_to_the_vertical(self):
        self.write("ramp.glb", glb_bytes(ramp(30)))
        for align, degrees in (("normal", 30), ("vertical", 0), ("blend:0.5", 15)):
            with self.subTest(align=align):
                for blade in self.grown("ramp.glb", "--align", align):
                    angle = math.degrees(math.acos(min(1.0, blade.up[1])))
                    self.assertLess(abs(angle - degrees), 1.0)

    def test_exposure_is_less_beside_a_wall(self):
        wall = Mesh([(0, 0, -5), (0, 0, 5), (0, 6, 5), (0, 6, -5)], [(0, 1, 2), (0, 2, 3)])
        self.write("ground.glb", glb_bytes(square(10.0)))
        self.write("wall.glb", glb_bytes(wall))
        blades = self.grown("ground.glb", "--occluder", "wall.glb", "--exposure", "32")
        near = [float(b.row["exposure"]) for b in blades if abs(b.root[0]) < 0.5]
        far = [float(b.row["exposure"]) for b in blades if abs(b.root[0]) > 4.0]
        self.assertLess(sum(near) / len(near), sum(far) / len(far) - 0.05)


if __name__ == "__main__":
    unittest.main()
