"""What every command line of the program keeps to."""

import re
import unittest

from support import CliTest, IO, UNSUPPORTED, USAGE, ROOT

COMMANDS = ("bake", "info", "validate", "compare", "export", "terrain")


class CommandLine(CliTest):
    def test_version_is_one_line(self):
        self.assertEqual(self.sward("--version").stdout, "sward 0.1.0\n")

    def test_help_names_every_command(self):
        text = self.sward("--help").stdout
        for command in COMMANDS:
            self.assertRegex(text, rf"(?m)^ +{command} ")

    def test_help_of_each_command_has_an_example_of_itself(self):
        for command in COMMANDS:
            with self.subTest(command=command):
                done = self.sward(command, "--help")
                self.assertRegex(done.stdout, rf"Example:\n +sward {command} \S")
                self.assertEqual(done.stderr, "")

    def test_no_command_is_wrong_usage_with_help_on_stderr(self):
        done = self.sward(code=USAGE)
        self.assertEqual(done.stdout, "")
        self.assertIn("bake", done.stderr)

    def test_unknown_options_are_refused_and_the_nearest_is_named(self):
        self.refused("bake", "plane", "-o", "f.sward", "--densty", "3", code=USAGE,
                     names=["--densty", "--density"])
        self.refused("bkae", code=USAGE, names=["bkae", "bake"])

    def test_options_of_later_versions_are_unknown_now(self):
        for option in ("--spacing", "--border", "--curvature", "--above-water", "--exclude", "--set"):
            with self.subTest(option=option):
                self.refused("bake", "plane", "-o", "f.sward", option, "1", code=USAGE, names=[option])
        self.refused("bake", "plane", "-o", "f.sward", "--sampling", "poisson", code=USAGE,
                     names=["poisson"])

    def test_values_that_make_no_sense_are_wrong_usage(self):
        cases = [("--slope", "10"), ("--slope", "60:20"), ("--density", "-1"), ("--density", "many"),
                 ("--count", "-5"), ("--align", "sideways"), ("--ground-up", "w"), ("--units", "miles"),
                 ("--up-axis", "q"), ("--scale", "0"), ("--sides", "left"), ("--threads", "-1"),
                 ("--blade-scale", "small"), ("--mask", "vertex-color:X"), ("--progress", "maybe")]
        for option, value in cases:
            with self.subTest(option=option, value=value):
                # "unit" in the message is as good as "--units".
                word = option.lstrip("-").replace("-", ".").rstrip("s")
                done = self.refused("bake", "plane", "-o", "f.sward", option, value, code=USAGE,
                                    names=[])
                self.assertRegex(done.stderr, word)

    def test_masks_of_later_versions_are_unsupported(self):
        self.refused("bake", "plane", "-o", "f.sward", "--mask", "texture:m.png:R", code=UNSUPPORTED,
                     names=["texture"])

    def test_unknown_names_list_the_known_ones(self):
        self.refused("bake", "hilz", "-o", "f.sward", code=IO, names=["hilz", "hills"])
        self.refused("bake", "plane", "-o", "f.sward", "--meadow", "jungle", code=IO,
                     names=["jungle", "meadow"])

    def test_printed_settings_are_the_effective_ones_and_nothing_is_baked(self):
        done = self.sward("bake", "plane", "-o", "f.sward", "--print-config", "--density", "12",
                          "--slope", "5:40~2")
        self.assertEqual(self.files(), set())
        self.write_json("x", 0)
        (self.folder / "settings.json").write_text(done.stdout)
        settings = self.read_json("settings.json")
        self.assertEqual(settings["bake"]["density"], 12)
        self.assertEqual(settings["bake"]["slope"], [5, 40, 2])
        self.assertEqual(settings["ground"]["units"], "m")
        self.assertGreater(len(settings["bake"]["meadow"]["species"]), 0)

    def test_results_are_on_stdout_and_the_log_on_stderr(self):
        done = self.sward("bake", "plane", "-o", "f.sward", "--count", "1000", "--slope", "0:90")
        self.assertRegex(done.stdout,
                         r"^f\.sward: 1000 blades in \d+ patches, [\d.]+ kB, [\d.]+ s\n$")
        self.assertIn("kept 1000 of", done.stderr)
        quiet = self.sward("bake", "plane", "-o", "g.sward", "--count", "1000", "-q")
        self.assertEqual(quiet.stderr, "")
        self.assertIn("1000 blades", quiet.stdout)

    def test_no_progress_bar_without_a_terminal_unless_asked_for(self):
        done = self.sward("bake", "plane", "-o", "f.sward", "--count", "1000")
        self.assertNotIn("\r", done.stderr)
        forced = self.sward("bake", "plane", "-o", "g.sward", "--count", "1000", "--progress", "always")
        self.assertIn("%", forced.stderr)

    def test_programs_know_the_version_of_the_project(self):
        text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        version = re.search(r"project\(sward VERSION (\S+)", text).group(1)
        self.assertEqual(self.sward("--version").stdout, f"sward {version}\n")


if __name__ == "__main__":
    unittest.main()
