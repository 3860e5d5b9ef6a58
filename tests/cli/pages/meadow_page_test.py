"""docs/meadow_files.md says what the reader of meadow files knows: keys, defaults and ranges."""

import json
import re
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from readme_test import commands
from support import CliTest, INPUT, ROOT

PAGE = ROOT / "docs/meadow_files.md"
LEVELS = ("The meadow", "A species", "An organ")


def tables():
    """For each level of a meadow file its keys, and of each its range and its default as written."""
    text = PAGE.read_text(encoding="utf-8")
    found = {}
    for level in LEVELS:
        section = re.split(r"(?m)^## ", text[text.index(f"\n## {level}\n") + 4:])[0]
        rows = re.findall(r"(?m)^\| `(\w+)` \| (.+?) \| (.+?) \| (.+?) \|$", section)
        found[level] = {key: (bounds, default) for key, bounds, default, _ in rows}
        assert len(found[level]) == len(rows), f"{level}: a key stands twice"
    return found


def number(text):
    return float(text) if "." in text else int(text)


def samples(bounds):
    """Values at the ends of a range, and values just outside of it."""
    words = re.findall(r"`([^`]+)`", bounds)
    if words:
        return words, ["sheep", 1]
    if bounds == "text":
        return ["x"], [1]
    if bounds == "true or false":
        return [True, False], [1, "true"]
    if bounds == "soft range":
        return [":", "1:2", "1:2~0.5", ":2", "1:", [1, 2]], ["2:1", "1", 5, [2, 1]]
    if bounds == "mask or list of masks":
        return ["vertex-color:G", []], ["vertex-color:X", 1]
    kind, low, high = re.fullmatch(r"(?:(.+), )?(-?[\d.]+) to (-?[\d.]+)", bounds).groups()
    low, high = number(low), number(high)
    below, above = (low - 1, high + 1) if kind == "whole number" else (low - abs(low) / 2 - (low == 0), high * 1.01 + (high == 0))
    if kind in (None, "whole number"):
        return [low, high], [below, above, "1", [low]] + ([low + 0.5] if kind else [])
    if kind == "three numbers":
        return [[low, high, low], "#8090a0"], ["green", "#80", [below, high, low], [low, above, low], [low, low], low]
    wrong = [[below, high], [low, above], [low], below, "1"]
    return [[low, high], [low, low], low], wrong + ([[high, low]] if kind == "two numbers" else [])


class MeadowPage(CliTest):
    def setUp(self):
        super().setUp()
        self.tables = tables()

    def config(self, meadow, **how):
        (self.folder / "m.json").write_text(json.dumps(meadow), encoding="utf-8")
        return self.sward("bake", "plane", "--meadow", "m.json", "--print-config", **how)

    def known(self):
        """What the reader makes of a meadow without any keys, level by level."""
        meadow = json.loads(self.config({"species": [{"organs": [{}]}]}).stdout)["bake"]["meadow"]
        species = meadow["species"][0]
        return dict(zip(LEVELS, (meadow, species, species["organs"][0])))

    @staticmethod
    def meadow_with(level, key, value):
        if level == "The meadow":
            return {"species": [{}], key: value}
        return {"species": [{key: value} if level == "A species" else {"organs": [{key: value}]}]}

    def test_its_keys_are_those_of_the_reader(self):
        for level, known in self.known().items():
            self.assertEqual(set(self.tables[level]), set(known), level)

    def test_its_defaults_are_those_of_the_reader(self):
        compared = 0
        for level, known in self.known().items():
            for key, (_, default) in self.tables[level].items():
                if default.startswith("`"):
                    with self.subTest(level=level, key=key):
                        self.assertEqual(json.loads(default.strip("`")), known[key])
                        compared += 1
        self.assertGreater(compared, 55)

    def test_its_ranges_end_where_values_are_refused(self):
        tried = 0
        for level, keys in self.tables.items():
            for key, (bounds, _) in keys.items():
                if key in ("species", "organs"):
                    continue
                right, wrong = samples(bounds)
                for value in right:
                    with self.subTest(level=level, key=key, right=value):
                        self.config(self.meadow_with(level, key, value))
                for value in wrong:
                    with self.subTest(level=level, key=key, wrong=value):
                        done = self.config(self.meadow_with(level, key, value), code=INPUT)
                        self.assertIn("m.json", done.stderr)
                        self.assertIn(key, done.stderr)
                        tried += 1
        self.assertGreater(tried, 150)

    def test_lists_have_the_lengths_that_it_says(self):
        self.config({"species": [{}] * 8})
        for count in (0, 9):
            self.assertIn("species", self.config({"species": [{}] * count}, code=INPUT).stderr)
        self.config({"species": [{"organs": [{}] * 32}]})
        self.assertIn("organs", self.config({"species": [{"organs": [{}] * 33}]}, code=INPUT).stderr)
        self.assertIn("63", self.config({"species": [{"organs": [{"count": 60}, {"count": 4}]}]}, code=INPUT).stderr)

    def test_its_example_is_baked(self):
        text = PAGE.read_text(encoding="utf-8")
        example, = re.findall(r"(?ms)^```json\n(.*?)^```", text)
        (self.folder / "FILE.json").write_text(example, encoding="utf-8")
        field = self.bake("hills", "--meadow", "FILE.json", "--count", "500")
        self.assertEqual([one["name"] for one in self.info(field)["species"]], ["fescue", "reed"])
        changed = self.bake("hills", "--meadow", "FILE.json", "--count", "500", "--set", "species.reed.share=1e6",
                            to="changed.sward")
        self.assertNotEqual(field.read_bytes(), changed.read_bytes())
        self.assertEqual(commands(PAGE), [])


if __name__ == "__main__":
    unittest.main()
