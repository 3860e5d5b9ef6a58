"""Manual pages and completions say what --help says."""

import os
import re
import shlex
import subprocess
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


if __name__ == "__main__":
    unittest.main()
