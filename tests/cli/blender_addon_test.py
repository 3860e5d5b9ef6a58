"""The add-on of examples/blender, in Blender without a window. Its laws are in blender_addon_checks.py."""

import os
import subprocess
import unittest

from support import CliTest, PROGRAM, ROOT
from needs import needs

CHECKS = ROOT / "tests/cli/blender_addon_checks.py"


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
