"""What a host sees of the library: how many headers, and nothing of how the passes are made."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Headers of ours that render/grass.h brings, itself included.
MAX_OF_GRASS = 20

# All headers that `cmake --install` installs, those of the C interface included.
MAX_INSTALLED = 102

INCLUDE = re.compile(r'^ *# *include "([^"]+)"', re.M)


def text_of(header):
    """The text of a header by its name in includes."""
    path = next(ROOT / base / header for base in ("src", ".") if (ROOT / base / header).is_file())
    return path.read_text(encoding="utf-8")


def carried_by(doors):
    """The headers of ours that these bring, themselves included."""
    found, todo = [], list(doors)
    while todo:
        header = todo.pop()
        if header not in found:
            found.append(header)
            todo += INCLUDE.findall(text_of(header))
    return sorted(found)


def installed_doors():
    text = (ROOT / "cmake/install.cmake").read_text(encoding="utf-8")
    return re.search(r"\nset\(doors\n(.*?)\)", text, re.S)[1].split()


class Doors(unittest.TestCase):
    def test_the_engine_door_brings_few_headers(self):
        headers = carried_by(["render/grass.h"])
        self.assertLessEqual(len(headers), MAX_OF_GRASS, headers)
        self.assertGreater(len(headers), 10, "are the includes read?")

    def test_the_engine_door_shows_neither_shaders_nor_passes(self):
        folders = {header.rpartition("/")[0] for header in carried_by(["render/grass.h"])}
        self.assertEqual(folders - {"core", "field", "render", "render/frame", "render/host",
                                    "render/resident", "render/tessellation"}, set())

    def test_few_headers_are_installed(self):
        headers = carried_by(installed_doors())
        self.assertLessEqual(len(headers), MAX_INSTALLED, headers)
        self.assertIn("c/grass.h", headers)

    def test_no_installed_header_shows_members_of_the_passes(self):
        for header in carried_by(installed_doors()):
            with self.subTest(header=header):
                self.assertNotIn("parts()", text_of(header))

    def test_a_target_hides_its_pipelines(self):
        self.assertNotIn("Pipeline", text_of("render/tessellation/blade_target.h"))

    def test_public_names_have_no_rooms_and_are_told_apart(self):
        """As cmake/install_headers.cmake names them."""
        names = [re.sub(r"^(core|field|terrain|bake|gpu|render)/.*/", r"\1/", header)
                 for header in carried_by(installed_doors())]
        self.assertEqual(len(set(names)), len(names))

    def test_pages_and_examples_include_what_is_installed(self):
        names = {re.sub(r"^(core|field|terrain|bake|gpu|render)/.*/", r"\1/", header)
                 for header in carried_by(installed_doors())} | {"version.h"}
        texts = [ROOT / "docs/engine.md", *(ROOT / "docs").glob("*.md"), *(ROOT / "examples").rglob("*.cpp")]
        told = {(path.name, name) for path in texts
                for name in re.findall(r"<sward/([^>]+\.h)>", path.read_text(encoding="utf-8"))}
        self.assertGreater(len(told), 20)
        self.assertEqual({(page, name) for page, name in told if name not in names}, set())


if __name__ == "__main__":
    unittest.main()
