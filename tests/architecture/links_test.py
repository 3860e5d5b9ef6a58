"""The two programs share the field file and nothing else: the baker loads no Vulkan, the viewer no
mesh library.

    links_test.py SWARD SWARD_VIEW
"""

import re
import subprocess
import sys
import unittest
from pathlib import Path

SWARD, SWARD_VIEW = sys.argv[1:3]


def needed(program):
    """Shared libraries that the program asks the loader for."""
    text = subprocess.run(["readelf", "--dynamic", "--wide", program], capture_output=True,
                          text=True, check=True).stdout
    return re.findall(r"\(NEEDED\).*\[(.+)\]", text)


class Links(unittest.TestCase):
    def assert_free_of(self, program, pattern):
        libraries = needed(program)
        self.assertIn("libc.so.6", libraries, f"{program} is not linked as expected")
        self.assertEqual([name for name in libraries if re.search(pattern, name)], [])

    def test_the_offline_program_loads_neither_vulkan_nor_a_window(self):
        self.assert_free_of(SWARD, r"vulkan|glfw|imgui|X11|wayland")

    def test_the_viewer_loads_no_mesh_library(self):
        self.assert_free_of(SWARD_VIEW, r"(?i)openmesh|embree|tinygltf|tbb")

    def test_only_the_viewer_has_controls(self):
        # Dear ImGui is a static library, so that no table of libraries names it.
        has = lambda program: b"Dear ImGui" in Path(program).read_bytes()
        self.assertTrue(has(SWARD_VIEW), "the check does not see what is linked")
        self.assertFalse(has(SWARD))

    def test_the_check_sees_what_is_linked(self):
        self.assertTrue(any("vulkan" in name for name in needed(SWARD_VIEW)), "no Vulkan in the viewer?")
        self.assertTrue(any("embree" in name for name in needed(SWARD)), "no Embree in the baker?")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
