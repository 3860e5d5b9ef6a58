"""The add-on of examples/blender, in Blender without a window. Its laws are in blender_addon_checks.py."""

import importlib
import os
import subprocess
import sys
import types
import unittest
from pathlib import Path
from unittest import mock

sys.path.append(str(Path(__file__).resolve().parents[1]))

from support import CliTest, PROGRAM, ROOT
from needs import needs

CHECKS = ROOT / "tests/cli/blender/blender_addon_checks.py"


class BlenderAddonTest(CliTest):
    def setUp(self):
        needs("blender")
        super().setUp()

    def holds(self, name):
        # With sound, Blender's PulseAudio leaves a folder behind.
        done = subprocess.run(["blender", "-b", "-noaudio", "--factory-startup", "--python-exit-code", "3",
                               "-P", CHECKS, "--", name],
                              env={**os.environ, "SWARD_PROGRAM": str(PROGRAM), "TMPDIR": str(self.folder)},
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"holds: {name}", done.stdout)
        self.assertNotIn("Traceback", done.stdout + done.stderr)
        # Blender has removed its temporary folder, and the fields in it.
        self.assertEqual(self.files(), set())


class Options(CliTest):
    """What the panel asks of `sward bake`, without Blender: a stand-in has the classes that the panel derives from."""

    def setUp(self):
        super().setUp()
        named = {name: mock.MagicMock() for name in ("bpy", "bpy.app", "bpy.app.handlers", "bpy_extras",
                                                     "bpy_extras.io_utils", "mathutils", "numpy")}
        bpy = named["bpy"]
        bpy.props = mock.MagicMock()
        for kind in ("Float", "Int", "String", "Bool", "Enum"):
            setattr(bpy.props, f"{kind}Property", lambda **about: about)
        for base in ("AddonPreferences", "PropertyGroup", "Operator", "Panel"):
            setattr(bpy.types, base, type(base, (), {}))
        named["bpy_extras.io_utils"].ExportHelper = type("ExportHelper", (), {})
        self.enterContext(mock.patch.dict(sys.modules, named))
        self.enterContext(mock.patch.object(sys, "path", [str(ROOT / "examples/blender"), *sys.path]))
        sys.modules.pop("sward_addon.panel", None)
        self.panel = importlib.import_module("sward_addon.panel")
        self.addCleanup(lambda: [sys.modules.pop(name) for name in list(sys.modules) if name.startswith("sward_addon")])

    def options(self, **given):
        """Options with the settings as the panel has them at first, but for some."""
        about = self.panel.SwardSettings.__annotations__
        first = {name: what.get("default", what["items"][0][0] if "items" in what else 0 if name == "seed" else "")
                 for name, what in about.items()}
        bpy = sys.modules["bpy"]
        bpy.path.abspath = lambda path: path
        return self.panel.bake_options(types.SimpleNamespace(**{**first, **given}))

    def test_blades_have_their_natural_size_on_small_ground(self):
        (self.folder / "small.obj").write_text(
            "v -2 0 -2\nv -2 0 2\nv 2 0 2\nv 2 0 -2\nf 1 2 3 4\n", encoding="utf-8")
        counts = {}
        for options in ("", "--blade-scale auto"):
            self.bake("small.obj", *self.options(options=options), "--force")
            counts[options] = self.info("field.sward")["blades"]
        self.assertLess(counts[""], 50_000)
        self.assertGreater(counts["--blade-scale auto"], 10 * counts[""])

    def test_the_setting_and_the_further_options_are_handed_on(self):
        self.assertEqual(self.options()[-2:], ["--blade-scale", "1"])
        self.assertEqual(self.options(blade_scale=0.5)[-2:], ["--blade-scale", "0.5"])
        for own in ("--blade-scale 2", "--blade-scale=2"):
            self.assertEqual(self.options(options=own).count("--blade-scale"), own.count(" "))


class BlenderAddon(BlenderAddonTest):
    def test_it_registers_and_unregisters_twice(self):
        self.holds("registers")

    def test_blades_stand_on_a_plane(self):
        self.holds("stands_on_a_plane")


class LongBlenderAddon(BlenderAddonTest):
    """Each test starts Blender. After changes of examples/blender, and before each release."""

    def test_blades_stand_on_a_sphere_that_is_turned_scaled_mirrored_and_moved(self):
        self.holds("stands_on_a_moved_sphere")

    def test_lengths_follow_the_units_of_the_scene(self):
        self.holds("follows_units")

    def test_grass_grows_by_groups_and_attributes(self):
        self.holds("grows_by_its_mask")

    def test_bad_input_is_told_and_leaves_nothing(self):
        self.holds("refuses_bad_input")

    def test_a_bake_can_be_cancelled(self):
        self.holds("can_be_cancelled")

    def test_a_second_bake_takes_the_place_of_the_first(self):
        self.holds("takes_the_place_of_the_former")


if __name__ == "__main__":
    unittest.main()
