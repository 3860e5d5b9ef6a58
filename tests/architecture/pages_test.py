"""What holds for every page: short lines, links that lead somewhere, no picture without a text, and an engine page that
is read at one sitting."""

import re
import unittest
from pathlib import Path

from files_test import ROOT, tracked_files

LONGEST_LINE = 200
LONGEST_ENGINE_PAGE = 350


def pages():
    return [path for path in tracked_files() if path.endswith(".md")]


def text_of(path):
    return (ROOT / path).read_text(encoding="utf-8")


def without_code(text):
    """The text without its blocks of code, line by line."""
    lines, is_code = [], False
    for line in text.splitlines():
        is_fence = line.lstrip().startswith("```")
        lines.append("" if is_code or is_fence else line)
        is_code ^= is_fence
    return "\n".join(lines)


def links_of(text):
    """Targets of links and pictures; code in quotes is none."""
    prose = re.sub(r"`[^`]*`", lambda code: "`" + re.sub(r"[^\n]", "x", code[0][1:-1]) + "`", without_code(text))
    return re.findall(r"\]\(([^()\s]+)\)", prose)


def anchors_of(text):
    """Anchors of the headings, as web sites of repositories make them."""
    anchors = set()
    for heading in re.findall(r"(?m)^#+ +(.+?)\s*$", without_code(text)):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        anchors.add(re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-"))
    return anchors | set(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", text))


def cannot_be_broken(line):
    """A row of a table with a link, or with a command in one piece, that is too long by itself."""
    whole = [part for part in re.findall(r"!?\[[^\]]*\]\([^)]*\)|`[^`]*`", line) if len(part) > LONGEST_LINE // 4]
    return line.lstrip().startswith("|") and len(line) - sum(len(part) for part in whole) <= LONGEST_LINE // 4


class Pages(unittest.TestCase):
    def test_lines_are_short(self):
        long = [f"{path}:{number}: {len(line)} characters" for path in pages()
                for number, line in enumerate(text_of(path).splitlines(), 1)
                if len(line) > LONGEST_LINE and not cannot_be_broken(line)]
        self.assertEqual(long, [], f"no line has more than {LONGEST_LINE} characters")

    def test_only_links_and_commands_make_a_row_long(self):
        link = "[" + "x" * 90 + "](" + "y" * 120 + ")"
        self.assertTrue(cannot_be_broken(f"| {link} | a word |"))
        self.assertFalse(cannot_be_broken(link))
        self.assertFalse(cannot_be_broken("| " + "word " * 50 + " |"))

    def test_the_engine_page_is_short(self):
        self.assertLessEqual(len(text_of("docs/engine.md").splitlines()), LONGEST_ENGINE_PAGE)

    def test_links_lead_somewhere(self):
        wrong, count = [], 0
        for path in pages():
            for link in links_of(text_of(path)):
                if "://" in link or link.startswith("mailto:"):
                    continue
                file, _, anchor = link.partition("#")
                target = (ROOT / path).parent / file if file else ROOT / path
                count += 1
                if not target.exists():
                    wrong.append(f"{path}: {link}: no such file")
                elif anchor and anchor not in anchors_of(target.read_text(encoding="utf-8")):
                    wrong.append(f"{path}: {link}: no such heading")
        self.assertGreater(count, 100, "pages have links")
        self.assertEqual(wrong, [])

    def test_links_and_anchors_are_recognised(self):
        self.assertEqual(links_of("[a](b.md) `[c](d.md)`\n```\n[e](f.md)\n```\n![g](h.png)"), ["b.md", "h.png"])
        self.assertEqual(anchors_of("# One `two`, three\n```\n# none\n```\n"), {"one-two-three"})

    def test_files_that_texts_name_exist(self):
        """Comments and scripts that send a reader to a page of docs/."""
        wrong = []
        for path in tracked_files():
            if not path.endswith((".h", ".cpp", ".py", ".comp", ".glsl", ".cmake", ".txt")) and not path.startswith("scripts/"):
                continue
            text = (ROOT / path).read_bytes().decode("utf-8", "ignore")
            wrong += [f"{path}: {page}" for page in re.findall(r"(?<![\w./-])docs/[\w/-]+\.md\b", text)
                      if not (ROOT / page).is_file()]
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    unittest.main()
