"""docs/troubleshooting.md quotes what the programs say, and what it proposes helps."""

import re
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from meshes import grey_png
from support import CliTest, ROOT

PAGE = ROOT / "docs/troubleshooting.md"


def rows():
    """What the user sees, and what to do, of every row of the tables."""
    text = PAGE.read_text(encoding="utf-8")
    return re.findall(r"(?m)^\| (?!what you see|---)(.+?) \| .+? \| (.+?) \|$", text)


def said_by_sources():
    """The text literals of all sources, those that follow one another joined."""
    text = ""
    for folder in ("src", "terrain"):
        for file in sorted((ROOT / folder).rglob("*.cpp")):
            source = re.sub(r'"\s*\n\s*"', "", file.read_text(encoding="utf-8"))
            text += "\n".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', source)) + "\n"
    return text


class TroubleshootingPage(unittest.TestCase):
    def test_its_messages_are_those_of_the_programs(self):
        sources = said_by_sources()
        quoted = [see.strip("`") for see, _ in rows() if re.fullmatch(r"`[^`]+`", see)]
        self.assertGreater(len(quoted), 15)
        for message in quoted:
            with self.subTest(message=message):
                # A number of the page stands for a placeholder of the source.
                pattern = re.sub(r"\d+", r"(?:\\d+|\\{[^}]*\\})", re.escape(message))
                self.assertRegex(sources, pattern)

    def test_its_links_lead_somewhere(self):
        for link in re.findall(r"\]\(([^)#]+)[^)]*\)", PAGE.read_text(encoding="utf-8")):
            self.assertTrue((PAGE.parent / link).exists(), link)


class Remedies(CliTest):
    def remedy_of(self, message):
        """What the page says to a message."""
        found = [do for see, do in rows() if see.strip("`") in message]
        self.assertEqual(len(found), 1, message)
        return found[0]

    def test_what_the_page_proposes_ends_the_warning(self):
        half = [0] * 32 + [65535] * 32
        (self.folder / "white.png").write_bytes(grey_png(64, 1, [65535] * 64))
        (self.folder / "black.png").write_bytes(grey_png(64, 1, [0] * 64))
        (self.folder / "height.png").write_bytes(grey_png(64, 2, half * 2))
        cases = ((("plane", "--mask", "texture:black.png:R"), (":invert",), ("plane", "--mask", "texture:black.png:R:invert")),
                 (("height.png", "--height", "0:1"), ("--extent",), ("height.png", "--height", "0:1", "--extent", "9", "9")),
                 (("plane", "--budget", "1000"), ("--density",), ("plane", "--density", "1")))
        for wrong, proposed, right in cases:
            with self.subTest(wrong=wrong):
                count = () if "--budget" in wrong else ("--count", "300")
                said = self.sward("bake", *wrong, *count, "-o", "f.sward", "--force").stderr
                warning = next(line for line in said.splitlines() if line.startswith("warning") and
                               any(see.strip("`") in line for see, _ in rows()))
                for option in proposed:
                    self.assertIn(option, self.remedy_of(warning))
                count = () if "--density" in right else ("--count", "300")
                self.assertNotIn(warning, self.sward("bake", *right, *count, "-o", "f.sward", "--force").stderr)


if __name__ == "__main__":
    unittest.main()
