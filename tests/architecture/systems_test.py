"""What differs between Linux and Windows stands in twins of core, NAME_posix.cpp and NAME_windows.cpp, and nowhere else.

tests/architecture/includes_test.py says who may see windows.h.
"""

import re
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCES = (".cpp", ".h", ".c")

# Macros by which compilers name a system, in a line of the preprocessor.
SYSTEM_ASKED = re.compile(r"^\s*#\s*(?:if|elif|ifdef|ifndef)\b.*\b(?:_WIN32|_WIN64|WIN32|_MSC_VER|__MINGW\w*|__CYGWIN__|"
                          r"__linux__|__unix__|__APPLE__)\b")
POSIX = re.compile(r"^\s*#\s*include\s*<(?:sys/\w+|unistd|fcntl|spawn|poll|dlfcn|pthread)\.h>")
# What is compiled for both systems, besides core.
COMMON = ("terrain/", "src/field/", "src/interchange/", "src/trace/", "src/bake/", "src/gpu/", "src/render/", "src/presentation/",
          "src/c/", "src/apps/")
# What Windows alone has.
ALONE = {"src/core/system/native_windows.cpp", "src/core/system/narrow_text_windows.cpp"}


def complaints(root):
    """What is wrong below `root`, as file:line: reason or file: reason."""
    wrong = []
    for top in ("src", "terrain", "shaders/shared"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in SOURCES:
                continue
            path = file.relative_to(root).as_posix()
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                if SYSTEM_ASKED.match(line):
                    wrong.append(f"{path}:{number}: asks for the system")
                if POSIX.match(line) and (path.startswith(COMMON) or path.startswith("src/core/")
                                          and not path.endswith(("_posix.cpp", "_windows.cpp"))):
                    wrong.append(f"{path}:{number}: a header of Linux outside of a twin")
            for own, other in (("_posix.cpp", "_windows.cpp"), ("_windows.cpp", "_posix.cpp")):
                if not path.endswith(own) or path in ALONE:
                    continue
                stem = path[: -len(own)]
                if not path.startswith("src/core/"):
                    wrong.append(f"{path}: a twin outside of core")
                if not (root / (stem + other)).is_file():
                    wrong.append(f"{path}: {stem + other} is missing")
                if not (root / (stem + ".h")).is_file():
                    wrong.append(f"{path}: {stem}.h is missing")
    return wrong


class Systems(unittest.TestCase):
    def test_what_differs_stands_in_twins_of_core(self):
        self.assertEqual(complaints(ROOT), [])
        self.assertGreaterEqual(len(list((ROOT / "src/core").rglob("*_windows.cpp"))), 10, "are they read?")

    def test_the_build_compiles_both_twins(self):
        text = (ROOT / "src/core/CMakeLists.txt").read_text(encoding="utf-8")
        for file in (ROOT / "src/core").rglob("*_windows.cpp"):
            name = file.relative_to(ROOT / "src/core").as_posix().removesuffix("_windows.cpp")
            self.assertIn(name, text)

    def test_each_offence_is_found(self):
        twins = {"src/core/a.h": "", "src/core/a_posix.cpp": "#include <unistd.h>\n", "src/core/a_windows.cpp": "#include <windows.h>\n"}
        planted = (
            ({}, []),
            ({"src/field/b.cpp": "int a;\n#ifdef _WIN32\n"}, ["src/field/b.cpp:2: asks for the system"]),
            ({"terrain/b.h": "# if !defined(__linux__)\n"}, ["terrain/b.h:1: asks for the system"]),
            ({"src/core/b.cpp": "#include <unistd.h>\n"}, ["src/core/b.cpp:1: a header of Linux outside of a twin"]),
            ({"src/gpu/b.cpp": "#include <sys/mman.h>\n"}, ["src/gpu/b.cpp:1: a header of Linux outside of a twin"]),
            ({"src/core/b.h": "", "src/core/b_posix.cpp": ""}, ["src/core/b_posix.cpp: src/core/b_windows.cpp is missing"]),
            ({"src/core/b_posix.cpp": "", "src/core/b_windows.cpp": ""},
             ["src/core/b_posix.cpp: src/core/b.h is missing", "src/core/b_windows.cpp: src/core/b.h is missing"]),
            ({"src/gpu/b.h": "", "src/gpu/b_posix.cpp": "", "src/gpu/b_windows.cpp": ""},
             ["src/gpu/b_posix.cpp: a twin outside of core", "src/gpu/b_windows.cpp: a twin outside of core"]),
            ({"src/apps/sward_view/files/b.cpp": "#include <unistd.h>\n#if defined(__x86_64__)\n"},
             ["src/apps/sward_view/files/b.cpp:1: a header of Linux outside of a twin"]),
            ({"src/godot/b.cpp": "#include <unistd.h>\n"}, []),
        )
        for files, wanted in planted:
            with self.subTest(files=files), tempfile.TemporaryDirectory() as folder:
                for path, text in {**twins, **files}.items():
                    (Path(folder) / path).parent.mkdir(parents=True, exist_ok=True)
                    (Path(folder) / path).write_text(text, encoding="utf-8")
                self.assertEqual(complaints(Path(folder)), wanted)


if __name__ == "__main__":
    unittest.main()
