"""What the programs say of themselves: --help, manual pages, completions, docs/cli.md, and a terminal."""

import json
import os
import pty
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "scripts"))
sys.path.append(str(ROOT / "tests/support"))
from help_pages import help_of, pages  # noqa: E402
from needs import needs  # noqa: E402
from soon import SOON  # noqa: E402

SWARD = os.environ["SWARD_PROGRAM"]
SWARD_VIEW = os.environ["SWARD_VIEW_PROGRAM"]
PROGRAMS = {"sward": SWARD, "sward-view": SWARD_VIEW}
COMMANDS = {"sward": ["bake", "info", "export", "merge"], "sward-view": ["render", "bench"]}


def said(*arguments):
    return subprocess.run(arguments, capture_output=True, text=True, check=True).stdout


def complete(program, name, *words):
    """What bash proposes behind these words."""
    script = (said(program, "--completion") + f"\nCOMP_WORDS=({' '.join(map(shlex.quote, [name, *words]))})\n"
              f"COMP_CWORD={len(words)}\n_{name.replace('-', '_')} 2>/dev/null\n"
              'printf "%s\\n" "${COMPREPLY[@]}"\n')
    return said("bash", "-c", script).split()


def said_on_a_terminal(*arguments, stdout=False, **environment):
    """What a program says on stderr where that is a terminal; with `stdout` on both streams."""
    ours, theirs = pty.openpty()
    done = subprocess.Popen(arguments, stdin=subprocess.DEVNULL,
                            stdout=theirs if stdout else subprocess.DEVNULL, stderr=theirs, env={**os.environ, "TERM": "xterm", **environment})
    os.close(theirs)
    text = b""
    while True:
        try:
            part = os.read(ours, 4096)
        except OSError:  # the other end is closed
            part = b""
        if not part:
            break
        text += part
    os.close(ours)
    done.wait()
    return text.decode()


def screen(text):
    """The finished lines that a terminal shows, and the line on which its cursor is left."""
    lines, line, column = [], [], 0
    for part in re.findall(r"\033\[[0-9;]*[A-Za-z]|.", text, re.S):
        if part == "\n":
            lines.append("".join(line).rstrip())
            line, column = [], 0
        elif part == "\r":
            column = 0
        elif part == "\033[K":
            line = line[:column]
        elif not part.startswith("\033"):
            line[column:column + 1] = [part]
            column += 1
    return lines, "".join(line)


def without_numbers(lines):
    """Times, and names of temporary folders, differ from run to run."""
    return [re.sub(r" *\d+(\.\d+)?", " N", re.sub(r"sward-view\.\w+", "", line)) for line in lines]


class HelpTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages = pages(PROGRAMS)

    def test_pages_fit_a_terminal_of_80_columns(self):
        for name, command in self.pages:
            for line in help_of(PROGRAMS[name], command).splitlines():
                self.assertLess(len(line), 81, f"{name} {command}: {line}")
                self.assertEqual(line, line.rstrip())

    def test_every_option_has_a_text_and_every_value_a_name(self):
        for page in self.pages.values():
            self.assertGreater(len(page.options), 0)
            for option in page.options:
                with self.subTest(page=page.name, option=option.usage):
                    self.assertRegex(option.text, r"^[A-Z].*[^.,;]$")
                    self.assertNotIn(":FLOAT", option.value)
                    self.assertNotRegex(option.usage, r"\b(INT|UINT|FLOAT|TEXT)\b")

    def test_stated_defaults_are_the_defaults(self):
        # Prose values have no command-line spelling.
        words = {"unlimited", "any", "all", "auto"}
        plain = said(SWARD, "bake", "plane", "--print-config")
        options = [option for option in self.pages["sward", "bake"].options
                   if re.fullmatch(r"[\w:.-]+", option.default) and option.default not in words]
        self.assertGreater(len(options), 10)
        for option in options:
            with self.subTest(option=option.usage):
                stated = f"{option.names[-1]}={option.default}"
                self.assertEqual(said(SWARD, "bake", "plane", "--print-config", stated), plain)

    def test_stated_ranges_are_the_ranges(self):
        number = r"(\d[\d.]*(?:e-?\d+)?)"
        tried = 0
        for (name, command), page in self.pages.items():
            for option in page.options:
                text = re.sub(r"(\d+) (million|billion)\b",
                              lambda found: found[1] + {"million": "0" * 6, "billion": "0" * 9}[found[2]], option.text)
                found = re.search(rf"{number} to {number}(?![\d.]*[x\w])", text)
                if option.value not in ("N", "M", "F", "S", "X", "auto|F") or not found:
                    continue
                low, high = found.groups()
                beyond = [f"{float(high) * 1.001 + 1:.0f}", "-1"]
                if float(low) > 0:
                    beyond.append(f"{float(low) / 2}")
                for text, fits in [(low, True), (high, True), *((v, False) for v in beyond)]:
                    with self.subTest(page=page.name, option=option.usage, value=text):
                        self.assertEqual(self.accepts(name, command, option.names[-1], text), fits)
                        tried += 1
        self.assertGreater(tried, 60)

    @staticmethod
    def accepts(name, command, option, value):
        """Whether the command line is understood; no work is done."""
        rest = {"bake": ["plane", "--print-config"], "plan": ["none.glb", "-o", "/proc/none/p.json"],
                "compare": ["none.sward", "none.sward"], "tile": ["none.json", "-o", "none"],
                "grow": ["none.sward", "-o", "grown.sward"], "export": ["none.sward", "-o", "none.csv"],
                "render": ["none.sward", "-o", "none.png"], "dataset": ["none.json", "-o", "none"], "trace": ["none.sward", "-o", "none.png"],
                "lidar": ["none.sward", "-o", "none.npy",
                          *(("--scanner", "0,0,0") if option in ("--rings", "--columns") else ("--airborne", "5"))]}.get(command, ["none.sward"])
        needed = {"plan": ["--tiles", "1"], "tile": ["--index", "0"]}.get(command, [])
        if option in needed:
            needed = []
        words = [PROGRAMS[name], *([command] if command else []), *rest, *needed, f"{option}={value}"]
        done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        return done.returncode != 1

    def test_the_page_of_the_command_line_is_what_help_says(self):
        done = subprocess.run([ROOT / "scripts" / "cli-tables", "--check", Path(SWARD).parent],
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class OptionsInDocs(unittest.TestCase):
    def test_pages_name_only_options_that_there_are(self):
        # Of cmake, blender and pkg-config; and what no --help lists.
        known = {"--build", "--install", "--prefix", "--small", "--release", "--factory-startup", "--python", "--libs", "--man", "--completion",
                 "--option", "--no-save"}
        for page in pages(PROGRAMS).values():
            known |= {name for option in page.options for name in option.names}
        for script in [*(ROOT / "scripts").iterdir(), *(ROOT / "web/bench").iterdir()]:
            if script.is_file():
                known |= set(re.findall(r"--[a-z][a-z0-9-]+", script.read_text(encoding="utf-8")))
        documents = [ROOT / "README.md", *(ROOT / "docs").glob("*.md"), *(ROOT / "docs/algorithms").glob("*.md")]
        self.assertGreater(len(documents), 20)
        for document in documents:
            named = set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]+", document.read_text(encoding="utf-8")))
            self.assertEqual(sorted(named - known), [], document.relative_to(ROOT))


class PagesTest(unittest.TestCase):
    def test_the_manual_page_has_every_option_of_every_command(self):
        for name, program in PROGRAMS.items():
            page = said(program, "--man").replace("\\-", "-")
            for command in COMMANDS[name]:
                options = set(re.findall(r"^  (?:-\w, )?(--[a-z-]+)", said(program, command,
                                                                           "--help"), re.M))
                self.assertGreater(len(options), 2)
                missing = [option for option in options if option not in page]
                self.assertEqual(missing, [], f"{name} {command}")

    def test_the_manual_page_is_roff_without_a_warning(self):
        needs("groff")
        for program in PROGRAMS.values():
            page = said(program, "--man")
            done = subprocess.run(["groff", "-Kutf8", "-man", "-Tutf8", "-ww", "-z"], input=page, text=True,
                                  capture_output=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_manual_page_has_defaults_groups_and_the_usual_sections(self):
        for name, program in PROGRAMS.items():
            page = said(program, "--man").replace("\\-", "-")
            sections = re.findall(r"^\.SH (.*)$", page, re.M)
            self.assertEqual(sections, ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "COMMANDS", "EXIT STATUS",
                                        "ENVIRONMENT", "SEE ALSO"])
            other, = PROGRAMS.keys() - {name}
            self.assertIn(f".BR {other} (1)", page)
            for variable in re.findall(r"environment:\s+(\w+)", said(program, "--help")):
                self.assertIn(f".TP\n.B {variable}\n", page[page.index(".SH ENVIRONMENT"):])
            for code in (0, 1, 2, 3, 4, 5, 7, 130):
                self.assertIn(f".TP\n.B {code}\n", page)
            for command in COMMANDS[name]:
                text = page[page.index(f".SS {name} {command}\n"):]
                found = pages({name: program})[name, command]
                for option in found.options:
                    if option.default:
                        self.assertIn(f"default: {option.default}", text.replace("\\e", "\\"), option.usage)
                titles = [title for title in found.groups if title not in ("Arguments", "Options")]
                places = [text.index(f"\n.B {title}:\n") for title in titles]
                self.assertEqual(places, sorted(places), f"{name} {command}: {titles}")

    def test_bash_completes_commands_options_and_words(self):
        self.assertEqual(complete(SWARD, "sward", "ba"), ["bake"])
        self.assertEqual(complete(SWARD, "sward", "bake", "--dens"), ["--density"])
        self.assertEqual(complete(SWARD_VIEW, "sward-view", "render", "--sett"), ["--settings"])
        self.assertEqual(complete(SWARD_VIEW, "sward-view", "bench", "--samples", ""), ["1", "4"])
        self.assertNotIn("--density", complete(SWARD, "sward", "info", "--"))

    def test_help_is_free_of_colours_and_has_examples(self):
        for name, program in PROGRAMS.items():
            whole = said(program, "--help")
            commands = re.findall(r"^  ([a-z]+) ", whole[whole.index("Commands:"):], re.M)
            self.assertLessEqual(set(COMMANDS[name]), set(commands))
            for command in commands:
                text = said(program, command, "--help")
                self.assertNotIn("\033", text)
                self.assertIn("Example", text, f"{name} {command}")

    def test_only_a_terminal_has_colours_and_never_with_no_color(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-pages-")
        self.addCleanup(folder.cleanup)
        field, picture = f"{folder.name}/f.sward", f"{folder.name}/p.png"
        color = re.compile(r"\033\[[0-9;]*m")
        for arguments in ((SWARD, "bake", "plane", "--count", "50", "-o", field, "--force"),
                          (SWARD_VIEW, "render", field, "-o", picture, "--size", "16x16", "--force", *SOON)):
            with self.subTest(program=arguments[0]):
                self.assertRegex(said_on_a_terminal(*arguments, NO_COLOR=""), color)
                without = said_on_a_terminal(*arguments, NO_COLOR="1")
                self.assertNotRegex(without, color)
                self.assertIn(" 100 %", without, "the bar is there without its colour")
                dumb = said_on_a_terminal(*arguments, NO_COLOR="", TERM="dumb")
                piped = subprocess.run(arguments, capture_output=True, text=True).stderr
                self.assertNotIn("\033", dumb + piped)

    def test_lines_on_a_terminal_are_those_without_a_bar(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-pages-")
        self.addCleanup(folder.cleanup)
        field, picture = f"{folder.name}/f.sward", f"{folder.name}/p.png"
        scene = Path(folder.name, "s.json")
        scene.write_text(json.dumps({"about": "A plane.", "ground": {"kind": "plane"},
                                     "bake": ["--count", "5000"]}))
        for arguments in ((SWARD, "bake", "hills", "--count", "50000", "-o", field, "--force", "-v"),
                          (SWARD, "bake", "none.glb", "-o", field, "--force"),
                          (SWARD, "export", field, "-o", f"{folder.name}/f.csv", "--force"),
                          (SWARD_VIEW, "bench", scene, "--size", "64x64", "--frames", "3", *SOON),
                          (SWARD_VIEW, "render", field, "-o", picture, "--size", "64x64", "--force", *SOON)):
            with self.subTest(arguments=arguments[:2]):
                shown = said_on_a_terminal(*arguments, "--progress", "always", stdout=True)
                plain = said_on_a_terminal(*arguments, "--progress", "never", stdout=True)
                lines, rest = screen(shown)
                self.assertEqual(rest, "", "the cursor stands on an empty line")
                self.assertEqual(without_numbers(lines), without_numbers(screen(plain)[0]))


if __name__ == "__main__":
    unittest.main()
