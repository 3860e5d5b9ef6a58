"""The site of the documentation: it is written without a warning, and holds what it shall."""

import os
import re
import subprocess
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ["SWARD_TEST_BUILD"])


class SiteTest(unittest.TestCase):
    def test_the_site_is_written_without_a_warning(self):
        done = subprocess.run(["cmake", "--build", BUILD, "--target", "docs"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("warning", done.stdout + done.stderr)
        site = BUILD / "site/html"
        text = {page.name: page.read_text() for page in site.glob("*.html")}
        everything = "".join(text.values())
        for wanted in ("Sward in your engine", "Resource states", "Level of detail",
                       "The field file", "FieldRenderer::record", "readField"):
            self.assertIn(wanted, everything)
        # Gallery: images are in the page's folder, so their names must be unique.
        shown = set(re.findall(r'<img src="([^"]+)"', everything))
        self.assertIn("landscape.jpg", shown)
        names = [path.name for path in (SOURCE / "docs").glob("**/*.[jp][pn]g")]
        self.assertEqual(len(names), len(set(names)), "two pictures of one name")
        for image in shown:
            self.assertTrue((site / image).exists(), image)


if __name__ == "__main__":
    unittest.main()
