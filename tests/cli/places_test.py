"""Where grass grows: slope, altitude, clearance, roles, and the space a file is read into."""

import json
import math
import unittest

from meshes import Mesh, color_png, glb_bytes, grey_png, obj_text, png, square, textured_gltf
from support import CliTest, INPUT, USAGE


def ramp(degrees, side=10.0):
    """A square that falls to the east."""
    mesh = square(side)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    mesh.positions = [(x * c, -x * s, z) for x, _, z in mesh.positions]
    return mesh


def scene(parts, node=None, document=None):
    """A GLB with one named node and material for each (name, mesh); `node` changes the last node."""
    positions, triangles, nodes, meshes = [], [], [], []
    for name, mesh in parts:
        first = len(positions)
        positions += mesh.positions
        begin = len(triangles)
        triangles += [tuple(i + first for i in t) for t in mesh.triangles]
        nodes.append({"mesh": len(meshes), "name": name})
        meshes.append((begin, len(mesh.triangles)))
    nodes[-1].update(node or {})
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
                        {"buffer": 0, "byteOffset": corners, "byteLength": 12 * len(triangles)}],
        **(document or {})})


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

    def test_a_texture_mask_lies_where_the_file_says(self):
        mesh = square(8.0)
        uvs = [(p[0] / 8 + 0.5, p[2] / 8 + 0.5) for p in mesh.positions]
        document = json.loads(textured_gltf(mesh, uvs, "left.png"))
        texture = document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
        texture["extensions"] = {"KHR_texture_transform": {"scale": [8, 8]}}
        self.write("a.gltf", json.dumps(document))
        self.write("left.png", color_png(2, 1, bytes([255] * 3 + [0] * 3)))
        left = {}
        for form in ("texture:left.png", "texture:left.png:uv0", "texture:left.png:transform",
                     "material-texture:R"):
            blades = self.grown("a.gltf", "--mask", form)
            left[form] = sum(b.root[0] < 0 for b in blades) / len(blades)
        # Between the middles of two pixels the mask falls evenly: three quarters stand in the left half.
        self.assertGreater(left["texture:left.png"], 0.7)
        self.assertEqual(left["texture:left.png"], left["texture:left.png:uv0"])
        self.assertLess(left["texture:left.png:transform"], 0.6)
        self.assertLess(left["material-texture:R"], 0.6)
        masks = self.report("a.gltf", "--count", "10", "--mask", "texture:left.png:G")["masks"]
        self.assertEqual(masks, [{"mask": "texture:left.png:G", "reads": "TEXCOORD_0"}])
        self.refused("bake", "a.gltf", "-o", "b.sward", "--mask", "texture:left.png:uv1", code=INPUT,
                     names=["a.gltf: mesh 0, primitive 0", "\"painted\"", "TEXCOORD_1"])

    def test_hidden_and_repeated_ground_bears_once(self):
        parts = [("hill", square(4.0)), ("helper", lifted(square(4.0), x=9))]
        document = {"extensionsUsed": ["KHR_node_visibility"]}
        for visible, count in ((True, 640), (False, 320)):
            content = scene(parts, node={"extensions": {"KHR_node_visibility": {"visible": visible}}},
                            document=document)
            self.write("a.glb", content)
            report = self.report("a.glb", "--density", "20", "--blade-scale", "1")
            self.assertEqual(report["roots"]["kept"], count)
            self.assertEqual(any("hidden" in w for w in report["warnings"]), not visible)
        self.write("twin.glb", scene([("hill", square(4.0)), ("hill_physics", square(4.0))]))
        self.write("hill.obj", obj_text(square(4.0)))
        for inputs in (["twin.glb"], ["hill.obj", "hill.obj"]):
            report = self.report(*inputs, "--density", "20", "--blade-scale", "1")
            self.assertEqual(report["roots"]["kept"], 320)
            self.assertTrue(any("128 triangles" in w for w in report["warnings"]), report["warnings"])

    def test_nothing_grows_in_cut_outs(self):
        mesh = square(8.0)
        uvs = [(p[0] / 8 + 0.5, p[2] / 8 + 0.5) for p in mesh.positions]
        document = json.loads(textured_gltf(mesh, uvs, "leaf.png"))
        # Opaque, and nearly clear.
        self.write("leaf.png", png(2, 1, 8, 6, bytes([90, 120, 40, 255, 90, 120, 40, 20])))
        for mode, cutoff, share in (("OPAQUE", None, 1.0), ("BLEND", None, 1.0), ("MASK", None, 0.5),
                                    ("MASK", 0.05, 1.0), ("MASK", 1.0, 0.25)):
            document["materials"][0]["alphaMode"] = mode
            if cutoff is not None:
                document["materials"][0]["alphaCutoff"] = cutoff
            self.write("a.gltf", json.dumps(document))
            roots = self.kept("a.gltf")
            # Between the middles of the two pixels alpha falls evenly, and rises again behind them.
            self.assertEqual(roots["rejected"]["cutout"], roots["proposed"] - roots["kept"])
            if mode != "MASK" or cutoff == 0.05:
                self.assertEqual(roots["kept"], roots["proposed"])
            elif cutoff is None:
                self.assertTrue(0.4 < roots["kept"] / roots["proposed"] < 0.6)
            else:
                self.assertLess(roots["kept"], 0.1 * roots["proposed"])

    def test_heightmaps_that_lie_on_one_another_are_a_warning(self):
        self.write("a.png", grey_png(5, 5, [1000 * (i % 5) for i in range(25)]))
        self.write("b.png", grey_png(5, 5, [900 * (i // 5) for i in range(25)]))
        report = self.report("a.png", "b.png", "--density", "20", "--blade-scale", "1")
        self.assertTrue(any("a.png" in w and "b.png" in w and "lie on one another" in w
                            for w in report["warnings"]), report["warnings"])

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

    def test_names_that_match_nothing_are_refused_with_those_that_there_are(self):
        self.write("two.glb", scene([("meadow_west", square(4.0)), ("rock_east", lifted(square(4.0), x=10))]))
        for option in ("--node", "--material"):
            for command in (("bake", "two.glb", "-o", "f.sward"), ("bake", "two.glb", "--dry-run"),
                            ("plan", "two.glb", "--tiles", "1", "-o", "p.json")):
                with self.subTest(option=option, command=command):
                    self.refused(*command, option, "gras*", "Meadow*", code=INPUT,
                                 names=["two.glb", option, "gras*, Meadow*", "meadow_west", "rock_east"])
        # Ground without names of its own.
        self.refused("bake", "plane", "-o", "f.sward", "--node", "gras*", code=INPUT, names=["plane", "gras*"])

    def test_one_name_of_several_that_matches_nothing_is_warned_of(self):
        self.write("two.glb", scene([("meadow_west", square(4.0)), ("rock_east", lifted(square(4.0), x=10))]))
        self.write("far.glb", scene([("shore", lifted(square(4.0), x=30))]))
        bake = ("bake", "-o", "f.sward", "--count", "10", "--force", "--node")
        done = self.sward(*bake, "meadow*", "tree*", "--", "two.glb")
        self.assertRegex(done.stderr, r"warning: .*tree\*.*rock_east")
        # Of several files some may have no such node.
        done = self.sward(*bake, "meadow*", "--", "two.glb", "far.glb")
        self.assertRegex(done.stderr, r"warning: far.glb: .*meadow\*.*shore")
        self.refused(*bake, "tree*", "--", "two.glb", "far.glb", code=INPUT, names=["tree*", "rock_east"])
        done = self.sward("bake", "two.glb", "-o", "f.sward", "--count", "10", "--force", "--occlude-node", "wall")
        self.assertRegex(done.stderr, r'warning: .*"wall".*rock_east')

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
        blades = self.grown("ground.glb", "--occluder", "wall.glb", "--sky-rays", "32")
        near = [float(b.row["exposure"]) for b in blades if abs(b.root[0]) < 0.5]
        far = [float(b.row["exposure"]) for b in blades if abs(b.root[0]) > 4.0]
        self.assertLess(sum(near) / len(near), sum(far) / len(far) - 0.05)

    def test_a_texture_paints_where_grass_grows(self):
        # Black at the west, white at the east; a heightmap carries the image over all of it.
        self.write("flat.png", grey_png(9, 9, [0] * 81))
        self.write("mask.png", grey_png(2, 1, [0, 65535]))
        ground = ("flat.png", "--extent", "20", "20", "--height", "0:1", "--blade-scale", "1")
        blades = self.blades(self.bake(*ground, "--density", "10", "--mask", "texture:mask.png"))
        west = sum(-6 < b.root[0] < -4 for b in blades)
        east = sum(4 < b.root[0] < 6 for b in blades)
        self.assertGreater(east, 300)
        self.assertLess(west, east / 8)
        inverted = self.blades(self.bake(*ground, "--density", "10", "--force", "--mask",
                                         "texture:mask.png:R:invert"))
        self.assertLess(abs(len(blades) + len(inverted) - 4000), 300)

    def test_the_ground_s_own_green_bears_grass(self):
        # Green at the west, rock at the east; between 0 and 1 m the colours mix.
        green, rock = (0.1, 0.3, 0.05, 1.0), (0.3, 0.3, 0.3, 1.0)
        self.write("isle.glb", glb_bytes(square(16.0, 16, lambda x, z: green if x <= 0 else rock)))
        done = self.sward("bake", "isle.glb", "-o", "all.sward", "--report", "all.json", "--density", "40", "--mask", "none")
        self.assertNotIn("is green", done.stderr)
        colors = self.read_json("all.json")["ground_colors"]
        self.assertAlmostEqual(colors["green"], 0.53, delta=0.03)
        self.assertAlmostEqual(colors["green"] + colors["bare"], 1.0, delta=0.04)
        self.assertFalse(colors["chosen_mask"])
        self.assertGreater(sum(b.root[0] > 4 for b in self.blades(self.folder / "all.sward")), 500)

        roots = [b.root[0] for b in self.grown("isle.glb", "--mask", "ground:green")]
        self.assertLess(max(roots), 1.0)
        self.assertLess(abs(sum(x < -4 for x in roots) / len(roots) - 0.5), 0.06)
        self.assertGreater(min(b.root[0] for b in self.grown("isle.glb", "--mask", "ground:green:invert")),
                           0.0)
        done = self.sward("bake", "isle.glb", "-o", "some.sward", "--mask", "ground:green", "--report",
                          "some.json", "--density", "40")
        self.assertNotIn("is green", done.stderr)
        self.assertFalse(self.read_json("some.json")["ground_colors"]["chosen_mask"])
        self.assertEqual(self.info("some.sward")["provenance"]["settings"]["masks"], ["ground:green"])

    def test_a_ground_that_is_green_in_part_bears_grass_there(self):
        """By its image; the same as with the mask, and one line says so."""
        def hill(name, left, right):
            self.write(f"{name}.png", color_png(2, 1, bytes([*left, *right])))
            mesh = square(16.0, 8)
            self.write(f"{name}.gltf", textured_gltf(mesh, [(x / 16.0 + 0.5, z / 16.0 + 0.5) for x, _, z in mesh.positions],
                                                     f"{name}.png", {"wrapS": 33071, "wrapT": 33071}))
            return f"{name}.gltf"

        green, grey, brown = (70, 125, 50), (128, 128, 128), (110, 80, 50)
        half = hill("half", green, grey)
        done = self.sward("bake", half, "-o", "half.sward", "--report", "half.json", "--density", "40")
        lines = [line for line in done.stderr.splitlines() if "is green" in line]
        self.assertEqual(len(lines), 1)
        self.assertIn("--mask none grows it on all", lines[0])
        self.assertTrue(self.read_json("half.json")["ground_colors"]["chosen_mask"])
        self.assertLess(max(b.root[0] for b in self.blades(self.folder / "half.sward")), 4.0)
        self.bake(half, "--density", "40", "--mask", "ground:green", to="f.sward")
        self.assertEqual((self.folder / "f.sward").read_bytes(), (self.folder / "half.sward").read_bytes())
        # What a meadow file says of masks, and --mask none, wins.
        for wish in (("--mask", "none"), ("--set", "species.0.mask=ground:green:invert"), ("--mask", "material-texture:G")):
            with self.subTest(wish=wish):
                done = self.sward("bake", half, "-o", "f.sward", "--density", "40", "--force", *wish)
                self.assertNotIn("is green", done.stderr)
                self.assertGreater(max(b.root[0] for b in self.blades(self.folder / "f.sward")), 7.0)
        for name, colors in (("green", (green, green)), ("brown", (brown, brown))):
            with self.subTest(name=name):
                done = self.sward("bake", hill(name, *colors), "-o", "f.sward", "--density", "40", "--force")
                self.assertNotIn("is green", done.stderr)
                self.assertEqual(self.info("f.sward")["provenance"]["settings"]["masks"], [])
        self.refused("bake", half, "-o", "g.sward", "--mask", "none", "--mask", "ground:green", code=USAGE, names=["--mask none"])

    def test_a_ground_without_colours_has_no_green(self):
        for ground in ("hills", self.write("plain.glb", glb_bytes(square(4.0)))):
            self.refused("bake", ground, "-o", "f.sward", "--mask", "ground:green", code=USAGE,
                         names=["--mask ground:green", "no colours"])
        self.refused("bake", "hills", "-o", "f.sward", "--mask", "ground:blue", code=USAGE,
                     names=["ground:blue", "ground:green", "vertex-color:C"])

    def test_names_leave_rock_bare_and_say_so(self):
        self.write("two.glb", scene([("west", lifted(square(4.0), x=-10)),
                                     ("SmallRocks2", lifted(square(4.0), x=10))]))
        done = self.sward("bake", "two.glb", "-o", "f.sward", "--report", "f.json", "--count", "100")
        for text in (done.stderr, self.read_json("f.json")["warnings"][0]):
            self.assertRegex(text, r'two.glb: 50 % of the ground .*"SmallRocks2_material".*--bare-names none')
        self.assertTrue(all(b.root[0] < 0 for b in self.grown("two.glb")))
        for options in (("--bare-names", "none"), ("--node", "*", "--material", "*")):
            with self.subTest(options=options):
                self.assertTrue(any(b.root[0] > 0 for b in self.grown("two.glb", *options)))
        self.refused("bake", "two.glb", "-o", "x.sward", "--bare-names", "rock", code=USAGE,
                     names=["--bare-names", "rock", "auto", "known", "none"])

    def test_a_painted_mask_counts_more_than_names(self):
        paint = square(4.0, color_of=lambda x, z: (1.0, 1.0, 1.0, 1.0))
        document = {"nodes": [{"mesh": 0, "name": "lawn", "translation": [-10, 0, 0]},
                              {"mesh": 0, "name": "rock", "translation": [10, 0, 0]}],
                    "scenes": [{"nodes": [0, 1]}]}
        self.write("two.glb", glb_bytes(paint, document=document))
        for options, east in (((), False), (("--mask", "vertex-color:R"), True),
                              (("--mask", "vertex-color:R", "--bare-names", "known"), False)):
            with self.subTest(options=options):
                self.assertEqual(any(b.root[0] > 0 for b in self.grown("two.glb", *options)), east)

    def test_a_material_without_an_image_is_named(self):
        self.write("two.glb", scene([("moss", square(4.0))]))
        done = self.refused("bake", "two.glb", "-o", "f.sward", "--mask", "material-texture:R",
                            code=INPUT, names=["moss_material", "image", "--material"])
        self.assertIn("moss_material", done.stderr)

    def test_a_border_stays_bare(self):
        self.write("ground.glb", glb_bytes(square(10.0)))
        for blade in self.grown("ground.glb", "--border", "1.5"):
            self.assertLessEqual(max(abs(blade.root[0]), abs(blade.root[2])), 3.501)
        self.assertGreater(self.kept("ground.glb", "--border", "2")["rejected"]["border"], 1000)

    def test_a_closed_ground_has_no_border(self):
        roots = self.kept("sphere", "--border", "3", "--ground-up", "radial")
        self.assertEqual(roots["rejected"]["border"], 0)

    def test_small_islands_bear_nothing(self):
        self.write("two.glb", scene([("large", lifted(square(8.0), x=-10)),
                                     ("small", lifted(square(2.0), x=10))]))
        self.assertTrue(all(b.root[0] < 0 for b in self.grown("two.glb", "--min-island", "5")))
        self.assertTrue(any(b.root[0] > 0 for b in self.grown("two.glb", "--min-island", "3")))

    def test_nothing_grows_below_water(self):
        self.write("ramp.glb", glb_bytes(ramp(30)))
        for blade in self.grown("ramp.glb", "--above-water", "0.5~1"):
            self.assertGreaterEqual(blade.root[1], 0.499)
        self.assertGreater(self.kept("ramp.glb", "--above-water", "0.5")["rejected"]["water"], 1000)

    def test_curvature_is_one_over_the_radius(self):
        # The built-in sphere has a radius of 10 m.
        for limits, share in (("0.09:0.11", 1.0), (":0.09", 0.0), ("-0.11:-0.09", 0.0)):
            with self.subTest(limits=limits):
                roots = self.kept("sphere", "--curvature", limits, "--ground-up", "radial")
                self.assertLess(abs(roots["kept"] / roots["proposed"] - share), 0.01)
        roots = self.kept("sphere", "--curvature", "-0.11:-0.09", "--sides", "back")
        self.assertEqual(roots["kept"], roots["proposed"])

    def test_excluded_areas_keep_their_margin(self):
        self.write("ground.glb", glb_bytes(square(10.0)))
        self.write("pond.glb", glb_bytes(lifted(square(4.0), y=-0.5)))
        for margin, half in (((), 2.0), (("margin", "1"), 2.8)):
            with self.subTest(margin=margin):
                area = ":".join(["pond.glb", *margin[:1]])
                blades = self.grown("ground.glb", "--exclude", area, *margin[1:])
                inside = [b for b in blades if abs(b.root[0]) < half - 0.01 and
                          abs(b.root[2]) < 1.99]
                self.assertEqual(inside, [])
        self.assertGreater(self.kept("ground.glb", "--exclude", "pond.glb")["rejected"]["excluded"], 250)

    def test_an_occluder_buries_what_is_inside_it(self):
        self.write("ground.glb", glb_bytes(square(10.0)))
        low, high = -1.0, 1.0
        corners = [(x, y, z) for x in (low, high) for y in (low, high) for z in (low, high)]
        faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7),
                 (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
        self.write("rock.glb", glb_bytes(Mesh(corners, faces)))
        roots = self.kept("ground.glb", "--occluder", "rock.glb")
        self.assertGreater(roots["rejected"]["occluder"], 50)
        for blade in self.grown("ground.glb", "--occluder", "rock.glb"):
            self.assertFalse(max(abs(blade.root[0]), abs(blade.root[2])) < 0.999, blade.root)

    def test_the_sky_is_asked_for_by_its_share(self):
        self.write("ground.glb", glb_bytes(square(10.0)))
        self.write("roof.glb", glb_bytes(lifted(square(6.0), y=0.4)))
        options = ("--occluder", "roof.glb", "--sky-rays", "16")
        for blade in self.grown("ground.glb", *options, "--sky", "0.5:"):
            self.assertFalse(max(abs(blade.root[0]), abs(blade.root[2])) < 2.4, blade.root)
        shade = self.kept("ground.glb", *options, "--sky", ":0.5")
        self.assertGreater(shade["rejected"]["exposure"], 900)

    def test_species_keep_to_their_habitats(self):
        self.write("ramp.glb", glb_bytes(ramp(30)))
        self.write_json("meadow.json", {"species": [
            {"name": "dry"}, {"name": "wet", "priority": 1, "altitude": ":0~1"}]})
        blades = self.grown("ramp.glb", "--meadow", "meadow.json")
        kinds = {kind: [b.root[1] for b in blades if b.row["species"] == kind] for kind in "01"}
        self.assertLessEqual(max(kinds["1"]), 1.0)
        self.assertGreaterEqual(min(kinds["0"]), 0.0)
        self.assertGreater(len(kinds["1"]), 1500)

    def test_what_no_species_takes_stays_bare(self):
        self.write("ground.glb", glb_bytes(square(10.0)))
        roots = self.kept("ground.glb", "--meadow", "grass", "--set", "species.*.cover=0.125")
        # Three species, an eighth each.
        self.assertLess(abs(roots["kept"] / roots["proposed"] - 0.375), 0.06)


if __name__ == "__main__":
    unittest.main()
