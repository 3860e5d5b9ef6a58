"""What README promises can be typed as it stands there."""

import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from support import CliTest, PROGRAM, ROOT


def commands(document=ROOT / "README.md"):
    """Lines of a document's shell blocks that run the offline program, in their order."""
    text = document.read_text(encoding="utf-8")
    blocks = re.findall(r"(?ms)^```(?:sh|bash|shell|console)?\n(.*?)^```", text)
    lines = "\n".join(blocks).replace("\\\n", " ").splitlines()
    found = [re.match(r"\s*(?:\$ )?(?:build/\w+/bin/)?(sward (?!-).+)", line) for line in lines]
    return [match.group(1) for match in found if match]


def cells(text):
    """Cells of all tables, but for the rules below their heads."""
    rows = [line for line in text.splitlines() if line.startswith("|")]
    parts = [re.split(r"(?<!\\)\|", row)[1:-1] for row in rows]
    return [cell.strip() for row in parts for cell in row if not re.fullmatch(r"[ :-]*", cell)]


class ReadmeText(unittest.TestCase):
    def setUp(self):
        self.text = (ROOT / "README.md").read_text(encoding="utf-8")

    def test_it_is_short(self):
        lines = self.text.splitlines()
        self.assertLessEqual(len(lines), 110)
        self.assertEqual([line for line in lines if len(line) > 160], [])

    def test_cells_of_tables_are_short(self):
        self.assertGreater(len(cells(self.text)), 20, "it has tables")
        self.assertEqual([cell for cell in cells(self.text) if len(cell.split()) > 20], [])

    def test_pictures_have_texts_and_links_lead_somewhere(self):
        pictures = re.findall(r"!\[([^\]]*)\]\(([^)]+)\)", self.text)
        self.assertGreater(len(pictures), 1)
        for alternative, path in pictures:
            self.assertGreater(len(alternative.split()), 4, path)
        for link in re.findall(r"\]\(([^)#]+)[^)]*\)", self.text):
            if "://" not in link:
                self.assertTrue((ROOT / link).exists(), link)

    def test_its_measurements_stand_in_the_tables_of_docs(self):
        tables = "\n".join((ROOT / "docs" / name).read_text(encoding="utf-8")
                           for name in ("BENCHMARKS.md", "bench/README.md"))
        measured = [float(number) for number in re.findall(r"\d+\.\d+", tables)]
        table = self.text[self.text.index("| device |"):self.text.index("[How it was measured]")]
        rows = [line for line in table.splitlines() if re.search(r"\d \|$", line)]
        self.assertGreater(len(rows), 5)
        for number in re.findall(r"(?<=\| )\d+\.\d+(?= \|)", "\n".join(rows)):
            # Written with as many digits as the reader needs.
            digits = len(number.partition(".")[2])
            self.assertIn(float(number), [round(value, digits) for value in measured], number)


class ReadmeTest(CliTest):
    def run_commands(self, *more):
        """All commands in a folder, those that bake with more words."""
        self.assertGreater(len(commands()), 0, "README shows how to run sward")
        (self.folder / "assets").symlink_to(ROOT / "assets")
        environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"}
        for command in commands():
            if command.startswith("sward bake "):
                command = " ".join([command, *more])
            with self.subTest(command=command):
                done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=environment,
                                      stdin=subprocess.DEVNULL, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)


class LongReadme(ReadmeTest):
    """Millions of blades."""

    def test_its_commands_run_one_after_the_other_as_they_stand(self):
        self.run_commands()


class Readme(ReadmeTest):
    def test_its_commands_run_one_after_the_other_for_fewer_blades(self):
        self.run_commands("--budget", "50000")

    def test_its_quick_start_is_the_two_scripts(self):
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        for script in ("scripts/demo", "scripts/test"):
            self.assertIn(script, text)
            self.assertTrue((ROOT / script).is_file())


if __name__ == "__main__":
    unittest.main()
