"""Manual pages and completions say what --help says."""

import os
import pty
import re
import shlex
import subprocess
import tempfile
import unittest

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


def said_on_a_terminal(*arguments, **environment):
    """What a program says on stderr where that is a terminal."""
    ours, theirs = pty.openpty()
    done = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                            stderr=theirs, env={**os.environ, "TERM": "xterm", **environment})
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


class PagesTest(unittest.TestCase):
    def test_the_manual_page_has_every_option_of_every_command(self):
        for name, program in PROGRAMS.items():
            page = said(program, "--man").replace("\\-", "-")
            for command in COMMANDS[name]:
                options = set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", said(program, command,
                                                                          "--help"), re.M))
                self.assertGreater(len(options), 2)
                missing = [option for option in options if option not in page]
                self.assertEqual(missing, [], f"{name} {command}")

    def test_the_manual_page_is_roff_without_a_warning(self):
        for program in PROGRAMS.values():
            page = said(program, "--man")
            done = subprocess.run(["groff", "-Kutf8", "-man", "-Tutf8", "-ww", "-z"], input=page, text=True,
                                  capture_output=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_bash_completes_commands_options_and_words(self):
        self.assertEqual(complete(SWARD, "sward", "ba"), ["bake"])
        self.assertEqual(complete(SWARD, "sward", "bake", "--dens"), ["--density"])
        self.assertEqual(complete(SWARD_VIEW, "sward-view", "render", "--sett"), ["--settings"])
        self.assertEqual(complete(SWARD_VIEW, "sward-view", "bench", "--samples", ""), ["1", "4"])
        self.assertNotIn("--density", complete(SWARD, "sward", "info", "--"))

    def test_help_is_free_of_colours_and_has_examples(self):
        for name, program in PROGRAMS.items():
            whole = said(program, "--help")
            commands = re.findall(r"^  ([a-z]+) ", whole[whole.index("Subcommands:"):], re.M)
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
                          (SWARD_VIEW, "render", field, "-o", picture, "--size", "16x16", "--force")):
            with self.subTest(program=arguments[0]):
                self.assertRegex(said_on_a_terminal(*arguments, NO_COLOR=""), color)
                without = said_on_a_terminal(*arguments, NO_COLOR="1")
                self.assertNotRegex(without, color)
                self.assertIn(" 100 %", without, "the bar is there without its colour")
                dumb = said_on_a_terminal(*arguments, NO_COLOR="", TERM="dumb")
                piped = subprocess.run(arguments, capture_output=True, text=True).stderr
                self.assertNotIn("\033", dumb + piped)


if __name__ == "__main__":
    unittest.main()
