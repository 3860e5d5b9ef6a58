"""The add-on for Godot, without Godot: a twin of its arithmetic over a file of the exporter, held against the CSV; and
what its files say. `scripts/try-godot` runs the add-on itself."""

import configparser
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

import numpy

sys.path.append(str(Path(__file__).resolve().parents[1]))
sys.path.append(str(Path(__file__).resolve().parents[1] / "export"))

import gltf_instances
import godot_twin as twin
from export_tables import ExportTest, PLACE_ERROR, front
from support import ROOT

ADDON = ROOT / "addons/sward"

# Names of Godot's interface that came after 4.4.
NEWER = ("decode_as_", "encode_new_accessor_from_", "SHADOW_CASTING_SETTING_MAX", "to_vector4_array", "@abstract",
         "get_value_from_json", "FoldableContainer", "duplicate_deep", "set_deferred_async", "ResourceFormatLoaderCrypto")


def text_of(name):
    return (ADDON / name).read_text(encoding="utf-8")


class GodotImport(ExportTest):
    def setUp(self):
        super().setUp()
        self.field = self.bake("hills", "--count", "12000", "--sky-rays", "2")
        self.glb = gltf_instances.Glb.read(self.export(self.field, "b.glb", "--for-engines"))
        self.extras = self.glb.json["nodes"][self.glb.json["scenes"][0]["nodes"][0]]["extras"]["sward"]

    def imported(self, kept=lambda buffer: buffer):
        """All instances by id, as the shader gets them."""
        columns = {}
        origin = numpy.array(self.glb.json["nodes"][self.glb.json["scenes"][0]["nodes"][0]]["translation"])
        for node, attributes in self.glb.instanced_nodes():
            found = twin.unpacked(kept(twin.multimesh_buffer(self.glb, attributes)))
            found["place"] = found["place"] + node["translation"] + origin
            words = self.glb.raw(attributes["_ROOT_ID"]).astype(numpy.uint64)
            found["id"] = sum(words[:, k] << numpy.uint64(16 * k) for k in range(4))
            found["root_byte"] = self.glb.numbers(attributes["_ROOT_COLOR"])[:, :3]
            found["tip_byte"] = self.glb.numbers(attributes["_TIP_COLOR"])[:, :3]
            for name, values in found.items():
                columns.setdefault(name, []).append(values)
        order = numpy.argsort(numpy.concatenate(columns["id"]))
        return {name: numpy.concatenate(values)[order] for name, values in columns.items()}

    def test_blades_stand_where_the_field_has_them(self):
        found, table = self.imported(), self.table(self.field)
        self.assertTrue(numpy.array_equal(found["id"], table["id"].astype(numpy.uint64)))
        self.assert_near(found["place"], self.columns(table, "x", "y", "z"), PLACE_ERROR)
        self.assert_near(found["height"], table["height"], 2e-7)
        scales = self.scales(table)
        self.assert_near(found["width"], scales[:, 0], 2e-7)
        up = self.columns(table, "ux", "uy", "uz")
        self.assert_near(found["up"] / found["height"][:, None], up, 3e-6)
        self.assert_near(found["front"] / found["height"][:, None], front(up, table["facing"]), 5e-6)
        # The shader makes the front of the two others.
        self.assert_near(numpy.cross(found["side"] / found["width"][:, None], up), front(up, table["facing"]), 5e-6)

    def test_what_a_blade_is_passes_through_halves(self):
        table = self.table(self.field)
        for name, kept, error in (("Forward+", lambda buffer: buffer, 1e-6), ("Compatibility", twin.as_halves, 2 ** -10)):
            with self.subTest(renderer=name):
                found = self.imported(kept)
                # The field has stiffness in 63 steps and exposure in 31: nothing is lost.
                self.assert_near(found["stiffness"], table["stiffness"], 1e-6)
                self.assert_near(found["exposure"], table["exposure"], 1e-6)
                self.assert_near(found["tip"], twin.linear(found["tip_byte"]), error)
                # Five bits of red and blue, six of green.
                self.assert_near(found["root"], found["root_byte"], 8.0 / 255.0)
                exact = self.imported()
                self.assert_near(found["rank"], exact["rank"], error)
                self.assert_near(found["leaf_area"], exact["leaf_area"], 8.0 * error)

    def test_thinning_draws_all_that_are_left_and_few_others(self):
        for _, attributes in self.glb.instanced_nodes():
            ranks = self.glb.numbers(attributes["_RANK"])[:, 0].astype(numpy.float32)
            counts = twin.counts_of(ranks)
            for share in numpy.concatenate([numpy.geomspace(1 / 256, 1.0, 60), [1.1]]):
                drawn = twin.visible_of(counts, share)
                left = int((twin.width_factor(ranks, share) > 0.0).sum())
                self.assertGreaterEqual(drawn, left)
                self.assertLessEqual(drawn, (ranks < 2 ** 0.25 * share * 1.001).sum() if share < 1 else len(ranks))

    def test_wider_blades_keep_the_area_of_those_left_out(self):
        found = self.imported()
        area = (found["width"] * found["height"])
        for share in (0.05, 0.1, 0.2, 0.5, 0.95, 1.0, 1.1):
            drawn = (area * twin.width_factor(found["rank"], share)).sum() / area.sum()
            self.assertLess(abs(drawn - 1.0), 0.05, share)

    def test_the_curve_of_a_mesh_is_the_resting_blade(self):
        gravity = self.extras["gravity"]
        for species, mesh in zip(self.extras["species"], self.glb.json["meshes"]):
            (primitive,) = mesh["primitives"]
            places, uvs = (self.glb.numbers(primitive["attributes"][name]) for name in ("POSITION", "TEXCOORD_0"))
            v1, v2, first = twin.curve_of(places, uvs)
            for t in (0.25, 0.75):
                row = numpy.abs(uvs[:first, 1] - t) < 1e-4
                self.assert_near(places[:first][row].mean(axis=0), 2 * t * (1 - t) * v1 + t * t * v2, 1e-6)
            self.assertEqual(species["plant"], first < len(uvs), species["name"])
            # The shader poses each blade so, from its own stiffness.
            tip = twin.rest_tip(numpy.array(species["mean_stiffness"]), gravity["strength"], gravity["forward"],
                                self.extras["recovery"])
            self.assert_near(v2[[2, 1]] / numpy.linalg.norm(v2), tip, 2e-3)


class AddonFiles(unittest.TestCase):
    def test_the_plugin_names_files_that_exist(self):
        plugin = configparser.ConfigParser()
        plugin.read_string(text_of("plugin.cfg"))
        self.assertEqual(set(plugin["plugin"]), {"name", "description", "author", "version", "script"})
        self.assertTrue((ADDON / plugin["plugin"]["script"].strip('"')).is_file())
        version = re.search(r"project\([^)]*VERSION\s+([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.S)[1]
        self.assertEqual(plugin["plugin"]["version"].strip('"'), version)

    def test_every_path_in_the_add_on_and_the_sample_exists(self):
        files = [path for folder in (ADDON, ROOT / "examples/godot") for path in folder.rglob("*")
                 if path.suffix in (".gd", ".gdshader", ".tscn", ".cfg", ".godot")]
        self.assertGreater(len(files), 6)
        for path in files:
            for named in re.findall(r"res://(addons/[\w./-]+)", path.read_text(encoding="utf-8")):
                self.assertTrue((ROOT / named).exists(), f"{path.name} names {named}")

    def test_constants_of_the_shader_are_those_of_the_renderer(self):
        shader = text_of("blade.gdshader")
        numbers = lambda text: [float(n) for n in re.findall(r"\d+\.\d+(?:e-?\d+)?", text)]
        shared = {name: (ROOT / "shaders/shared" / name).read_text(encoding="utf-8")
                  for name in ("culling.h", "cover.h", "wind.h", "noise.h", "pose.h", "look/blade_colors.h", "bezier.h")}
        for own, header, name in (("LOD_FADE", "culling.h", "lodFade"), ("LOD_FULL_SHARE", "culling.h", "lodFullShare"),
                                  ("LOWEST_SUN", "cover.h", "lowestSun"), ("SKY_EXTINCTION", "cover.h", "skyExtinction"),
                                  ("THROUGH_TINT", "look/blade_colors.h", "throughTint"),
                                  ("THROUGH_SHARE", "look/blade_colors.h", "throughShare"),
                                  ("FINE_NOISE_START", "wind.h", "fineNoiseStart"),
                                  ("FINE_NOISE_SCALE", "wind.h", "fineNoiseScale")):
            here = re.search(rf"const \w+ {own} = ([^;]+);", shader)[1]
            there = re.search(rf"SHARED_CONST \w+ {name} = ([^;]+);", shared[header])[1]
            self.assertEqual(numbers(here), numbers(there), own)
        for constant in re.findall(r"0x[0-9a-f]{8}u", shared["noise.h"].split("latticePoint")[0].split("mixUint(uint x)")[1].split("}")[1]):
            self.assertIn(constant, shader)
        correction = shared["pose.h"].split("float lengthCorrection(float side)")[1].split("\n}")[0]
        own = shader.split("float length_correction(float side)")[1].split("\n}")[0]
        self.assertEqual(numbers(own), numbers(correction))
        wave = shared["wind.h"].split("float windWaveAt(")[1].split("\n}")[0]
        self.assertEqual(numbers(shader.split("float wave_at(")[1].split("\n}")[0])[1:], numbers(wave)[1:])
        self.assertEqual((twin.LOD_FADE, twin.FULL_SHARE), (0.1, 1.0 / 0.9))

    def test_the_importer_knows_the_exporters_version_and_attributes(self):
        extras = (ROOT / "src/interchange/engine/engine_extras.h").read_text(encoding="utf-8")
        version = int(re.search(r"engineExtrasVersion = (\d+)", extras)[1])
        self.assertEqual(int(re.search(r"const VERSION := (\d+)", text_of("gltf_grass.gd"))[1]), version)
        exported = (ROOT / "src/interchange/instance_attributes.cpp").read_text(encoding="utf-8")
        for name in re.findall(r'"(_[A-Z_]+)"', text_of("blade_instances.gd")):
            self.assertIn(f'{{"{name}"', exported)
        instances = text_of("blade_instances.gd")
        for name, value in (("NUMBERS", twin.NUMBERS), ("STEPS", twin.STEPS), ("STEPS_PER_OCTAVE", twin.STEPS_PER_OCTAVE)):
            self.assertEqual(int(re.search(rf"const {name} := (\d+)", instances)[1]), value)
        # The shader has each parameter that the importer sets.
        shader = text_of("blade.gdshader") + text_of("ground.gdshader")
        for file in ("gltf_grass.gd", "sward_field.gd"):
            set_here = re.findall(r'set_shader_parameter\("(\w+)"|_tell\("(\w+)"|^\t\t"(\w+)":', text_of(file), re.M)
            for name in {name for names in set_here for name in names if name}:
                self.assertRegex(shader, rf"uniform \w+ {name}\b", f"{file} sets {name}")

    def test_the_zip_has_the_same_bytes_twice_and_all_files_in_their_place(self):
        with tempfile.TemporaryDirectory() as folder:
            packed = []
            for name in ("a.zip", "b.zip"):
                subprocess.run([ROOT / "scripts/godot-addon", "-o", Path(folder, name)], check=True, capture_output=True)
                packed.append(Path(folder, name).read_bytes())
            self.assertEqual(*packed)
            names = zipfile.ZipFile(Path(folder, "a.zip")).namelist()
            self.assertEqual({str(Path(*Path(name).parts[:2])) for name in names}, {"addons/sward"})
            self.assertIn("addons/sward/LICENSE", names)
            for path in ADDON.glob("*.gd"):
                self.assertIn(f"addons/sward/{path.name}", names)
            # The extensions of the build, which is there when tests run.
            self.assertIn("addons/sward/native/libsward_godot_native.so", names)
            # Into a project: the same files.
            Path(folder, "project.godot").touch()
            subprocess.run([ROOT / "scripts/godot-addon", "--into", folder], check=True, capture_output=True)
            self.assertEqual(sorted(names), sorted(str(path.relative_to(folder)) for path in Path(folder, "addons").rglob("*") if path.is_file()))

    def test_nothing_is_newer_than_godot_4_4(self):
        for path in ADDON.glob("*.gd"):
            text = path.read_text(encoding="utf-8")
            for name in NEWER:
                self.assertNotIn(name, text, path.name)

    def test_errors_name_the_file_and_every_property_has_a_tooltip(self):
        self.assertRegex(text_of("gltf_grass.gd"), r'push_error\("Sward: %s: %s" % \[_name\(state\), text\]\)')
        lines = text_of("sward_field.gd").splitlines()
        exported = [i for i, line in enumerate(lines) if re.match(r"@export(_range\(.*\))? var ", line)]
        self.assertGreater(len(exported), 7)
        for i in exported:
            self.assertTrue(lines[i - 1].startswith("## "), lines[i])


if __name__ == "__main__":
    unittest.main()
