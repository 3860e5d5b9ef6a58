"""What holds for every file of the repository: length, folder, licence, and no word about a machine."""

import re
import statistics
import subprocess
import unittest
from collections import Counter
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

SHADERS = (".comp", ".vert", ".tesc", ".tese", ".frag")
SOURCES = (".cpp", ".h", ".py", ".cmake") + SHADERS

LONGEST_SOURCE = 600
LONGEST_HEADER = 150
LARGEST_MEDIAN = 199
MAX_FILES = 25
# Folders that hold more, and how many they may. These numbers only fall.
LARGER_FOLDERS = {
    "shaders/shared": 34,
    "src/render/field": 32,
    "tests/gpu/frame": 30,
}


def tracked_files():
    """What git holds or would hold, as paths relative to the root; without git, what lies there."""
    # The folder may belong to another user than the one who tests.
    command = ["git", "-c", "safe.directory=*", "ls-files", "-z", "--cached", "--others",
               "--exclude-standard"]
    try:
        listed = subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout
        paths = sorted(set(listed.decode().split("\0")) - {""})
    except (OSError, subprocess.CalledProcessError):
        paths = sorted(file.relative_to(ROOT).as_posix() for file in ROOT.rglob("*")
                       if not file.relative_to(ROOT).parts[0] in ("build", ".git"))
    return [path for path in paths if (ROOT / path).is_file()]


def is_binary(path):
    # What fuzzers have found is no text, whatever it looks like.
    return path.startswith("tests/fuzz/corpus/") or b"\0" in (ROOT / path).read_bytes()[:65536]


def lines_of(path):
    return (ROOT / path).read_bytes().count(b"\n")


class Sizes(unittest.TestCase):
    def setUp(self):
        self.sources = [path for path in tracked_files() if Path(path).suffix in SOURCES]
        self.assertGreater(len(self.sources), 100, "the project has more sources than that")

    def test_no_source_is_too_long(self):
        long = [f"{path}: {lines_of(path)} lines" for path in self.sources
                if lines_of(path) > LONGEST_SOURCE]
        self.assertEqual(long, [], f"no source has more than {LONGEST_SOURCE} lines")

    def test_headers_are_short(self):
        # A header of shaders/shared is a source: the only place of the functions in it.
        long = [f"{path}: {lines_of(path)} lines" for path in self.sources
                if path.endswith(".h") and not path.startswith("shaders/")
                and lines_of(path) > LONGEST_HEADER]
        self.assertEqual(long, [], f"no header has more than {LONGEST_HEADER} lines")

    def test_bounds_are_named_max_and_min(self):
        # Keys of settings files (snake_case) are older, and are kept for those who wrote them.
        named = [f"{path}: {name}" for path in self.sources
                 for name in re.findall(r"\b(?:most|least)[A-Z]\w*", (ROOT / path).read_text(encoding="utf-8"))]
        self.assertEqual(named, [], "names of bounds begin with max and min")

    def test_the_median_source_is_short(self):
        for suffixes in (SOURCES, (".cpp",), SHADERS):
            lengths = [lines_of(path) for path in self.sources if Path(path).suffix in suffixes]
            with self.subTest(suffixes=suffixes, files=len(lengths)):
                self.assertLessEqual(statistics.median(lengths), LARGEST_MEDIAN)


def crowded(paths, larger):
    """What is wrong with the number of files in each folder: those below are not counted."""
    counts = Counter(path.rpartition("/")[0] for path in paths
                     if path.startswith(("src/", "terrain/", "shaders/", "tests/"))
                     and not path.startswith("tests/fuzz/corpus/"))  # what fuzzers have found
    wrong = [f"{folder}: {count} files of its own, {larger.get(folder, MAX_FILES)} are allowed"
             for folder, count in sorted(counts.items()) if count > larger.get(folder, MAX_FILES)]
    return wrong + [f"{folder}: {counts[folder]} files need no exception"
                    for folder in sorted(larger) if counts[folder] <= MAX_FILES]


class Folders(unittest.TestCase):
    def test_no_folder_is_crowded(self):
        self.assertEqual(crowded(tracked_files(), LARGER_FOLDERS), [], f"a folder holds {MAX_FILES} files at most")

    def test_a_crowded_folder_is_found(self):
        full = [f"src/bake/{i}.cpp" for i in range(MAX_FILES)]
        below = [f"src/bake/plan/{i}.cpp" for i in range(MAX_FILES)]
        self.assertEqual(crowded(full + below, {}), [])
        self.assertIn("src/bake: 26 files", crowded([*full, *below, "src/bake/CMakeLists.txt"], {})[0])
        self.assertEqual(crowded([*full, "src/bake/one.h"], {"src/bake": 26}), [])
        self.assertIn("src/bake: 27 files", crowded([*full, "src/bake/one.h", "src/bake/two.h"], {"src/bake": 26})[0])
        self.assertIn("no exception", crowded(full, {"src/bake": 26})[0])


class Licences(unittest.TestCase):
    def test_every_binary_file_is_listed(self):
        text = (ROOT / "assets/LICENSES.md").read_text(encoding="utf-8")
        # Paths stand in backquotes, from the root or from assets/; * stands for many.
        listed = set(re.findall(r"`([^`\s]+)`", text))
        binaries = [path for path in tracked_files() if is_binary(path)]
        self.assertNotEqual(binaries, [], "the sample terrain is a binary file")
        unlisted = [path for path in binaries
                    if not any(fnmatch(path, name) or fnmatch(path, "assets/" + name)
                               for name in listed)]
        self.assertEqual(unlisted, [], "assets/LICENSES.md must list these, with SPDX and origin")

    def test_nothing_listed_is_missing(self):
        text = (ROOT / "assets/LICENSES.md").read_text(encoding="utf-8")
        rows = [line.split("|")[1] for line in text.splitlines() if line.startswith("|")]
        for name in re.findall(r"`([^`\s]+)`", "\n".join(rows)):
            found = list(ROOT.glob(name)) or list(ROOT.glob("assets/" + name))
            self.assertTrue(found, f"assets/LICENSES.md lists {name}, which does not exist")


class Texts(unittest.TestCase):
    # Folders of one machine. Written so that this line does not find itself.
    MACHINE_PATH = re.compile(r"(?<![\w.:/~-])/(?:work|root|tmp|home|Users|mnt)/\w")

    def test_no_text_names_a_machine(self):
        found = []
        for path in tracked_files():
            if is_binary(path):
                continue
            text = (ROOT / path).read_text(encoding="utf-8")
            for number, line in enumerate(text.splitlines(), 1):
                if self.MACHINE_PATH.search(line):
                    found.append(f"{path}:{number}: {line.strip()}")
        self.assertEqual(found, [])

    def test_machine_paths_are_recognised(self):
        for text in ("/".join(["", "tmp", "x"]), "in " + "/".join(["", "home", "me", "sward"])):
            self.assertTrue(self.MACHINE_PATH.search(text), text)
        for text in ("build/tmp/x", "https://example.org/home/x", "~/home/x"):
            self.assertFalse(self.MACHINE_PATH.search(text), text)

    def test_all_json_is_written_by_one_function(self):
        # nlohmann's dump() throws at a name that is not UTF-8. json.cpp writes ASCII for messages.
        writers = {"src/core/json/json_text.cpp", "terrain/gltf/file/json.cpp"}
        found = [path for path in tracked_files()
                 if path.startswith(("src/", "terrain/")) and path.endswith((".cpp", ".h"))
                 and path not in writers
                 and re.search(r"[.>]dump\(", (ROOT / path).read_text(encoding="utf-8"))]
        self.assertEqual(found, [], "core/json/json_text.h has jsonText()")

    def test_scripts_can_be_run(self):
        for path in tracked_files():
            is_module = path.endswith(".py")  # what several scripts import
            if path.startswith(("scripts/", ".ci/")) and not is_module:
                with self.subTest(path=path):
                    self.assertTrue((ROOT / path).stat().st_mode & 0o111, "the run bit is missing")
                    if is_binary(path) or not (ROOT / path).read_bytes().startswith(b"#!"):
                        self.fail("a script begins with #!")


if __name__ == "__main__":
    unittest.main()
