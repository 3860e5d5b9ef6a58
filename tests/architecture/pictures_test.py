"""Pictures of the window in the documentation are those of this window: scripts/viewer-screenshots makes them all
anew, and tells which tabs they show."""

import json
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docs" / "images" / "viewer"


class PicturesTest(unittest.TestCase):
    def setUp(self):
        self.told = json.loads((FOLDER / "pictures.json").read_text())

    def test_they_show_the_tabs_of_the_window(self):
        panels = (ROOT / "src/apps/sward_view/panels/panels.h").read_text()
        tabs = re.findall(r'{"(\w+)", "', panels[panels.index("> panels{"):])
        self.assertGreater(len(tabs), 8)
        self.assertEqual(self.told["tabs"], sorted(tabs), "scripts/viewer-screenshots renews the pictures")

    def test_each_is_made_by_the_script_and_shown_on_a_page(self):
        there = sorted(path.name for path in FOLDER.iterdir() if path.suffix != ".json")
        self.assertEqual(self.told["pictures"], there)
        pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
        text = "".join(page.read_text() for page in pages)
        for name in there:
            self.assertIn(f"viewer/{name}", text)


if __name__ == "__main__":
    unittest.main()
