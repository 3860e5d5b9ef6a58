"""What every command line of the program keeps to."""

import json
import re
import unittest

from support import CliTest, INPUT, IO, USAGE, ROOT

COMMANDS = ("bake", "info", "validate", "compare", "export", "terrain", "plan", "tile", "merge", "trace", "grow", "lidar")


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
                self.assertRegex(done.stdout, r"\n  -q, --quiet +Print warnings and errors only")
                self.assertEqual(done.stderr, "")

    def test_no_command_is_wrong_usage_with_help_on_stderr(self):
        done = self.sward(code=USAGE)
        self.assertEqual(done.stdout, "")
        self.assertIn("bake", done.stderr)

    def test_unknown_options_are_refused_and_the_nearest_is_named(self):
        self.refused("bake", "plane", "-o", "f.sward", "--densty", "3", code=USAGE,
                     names=["--densty", "--density"])
        self.refused("bkae", code=USAGE, names=["bkae", "bake"])

    def test_ground_where_a_field_is_read_is_named_with_the_command_that_bakes_it(self):
        self.bake("plane", "--count", "5", to="f.sward")
        self.sward("terrain", "plane", "-o", "x.glb")
        for command in (("info", "x.glb"), ("validate", "x.glb"), ("export", "x.glb", "-o", "x.csv"),
                        ("trace", "x.glb", "-o", "x.exr"), ("compare", "f.sward", "x.glb"), ("compare", "x.glb", "f.sward")):
            with self.subTest(command=command):
                self.refused(*command, code=INPUT, names=["'sward bake x.glb -o x.sward'"])

    def test_quiet_commands_print_their_result_alone(self):
        self.bake("plane", "--count", "5", to="f.sward")
        for command in (("info", "f.sward"), ("validate", "f.sward"), ("compare", "f.sward", "f.sward"),
                        ("export", "f.sward", "-o", "f.csv"), ("terrain", "plane", "-o", "p.glb")):
            with self.subTest(command=command):
                done = self.sward(*command, "-q")
                self.assertEqual(done.stderr, "")
                self.assertNotEqual(done.stdout, "")

    def test_the_former_name_of_an_option_means_the_same_with_a_warning(self):
        one = self.bake("hills", "--count", "500", "--sky-rays", "3", to="one.sward")
        done = self.sward("bake", "hills", "--count", "500", "--exposure", "3", "-o", "two.sward")
        self.assertIn("--exposure is now called --sky-rays", done.stderr)
        self.assertEqual(one.read_bytes(), (self.folder / "two.sward").read_bytes())
        self.assertNotIn("--exposure", self.sward("bake", "--help").stdout)
        self.refused("bake", "hills", "-o", "f.sward", "--exposure", "3", "--sky-rays", "3", code=USAGE,
                     names=["--exposure", "--sky-rays"])
        self.refused("bake", "hills", "-o", "f.sward", "--exposure", "1025", code=USAGE, names=["--sky-rays", "1024"])
        # A plan keeps the new name, so that its tiles do not warn again.
        self.sward("plan", "plane", "--count", "50", "--exposure", "3", "--tiles", "1", "-o", "p.json")
        self.assertIn("--sky-rays=3", (self.folder / "p.json").read_text())
        self.assertEqual(self.sward("tile", "p.json", "--index", "0", "-o", "tiles").stderr.count("warning"), 0)

    def test_values_that_make_no_sense_are_wrong_usage(self):
        cases = [("--slope", "10"), ("--slope", "60:20"), ("--density", "-1"), ("--density", "many"),
                 ("--count", "-5"), ("--align", "sideways"), ("--ground-up", "w"), ("--units", "miles"),
                 ("--up-axis", "q"), ("--scale", "0"), ("--sides", "left"), ("--threads", "-1"),
                 ("--blade-scale", "small"), ("--mask", "vertex-color:X"), ("--progress", "maybe"),
                 ("--mask", "texture:"), ("--mask", "material-texture"), ("--curvature", "0"),
                 ("--border", "1:2"), ("--above-water", "wet"), ("--min-island", "-1"),
                 ("--sky", "1:0"), ("--exclude", "pond.glb:margin -1"), ("--set", "clump_size_m"),
                 ("--set", "clump_size=1"), ("--set", "species.oak.share=1"),
                 ("--set", "species.bent.share=-1"), ("--set", "species.bent.slope=steep")]
        for option, value in cases:
            with self.subTest(option=option, value=value):
                # "unit" in the message is as good as "--units".
                word = option.lstrip("-").replace("-", ".").rstrip("s")
                done = self.refused("bake", "plane", "-o", "f.sward", option, value, code=USAGE,
                                    names=[])
                self.assertRegex(done.stderr, word)

    def test_a_mask_that_is_not_there_is_named(self):
        self.refused("bake", "plane", "-o", "f.sward", "--mask", "texture:m.png:R", code=IO,
                     names=["m.png"])
        self.refused("bake", "plane", "-o", "f.sward", "--mask", "vertex-color:R", code=INPUT,
                     names=["vertex colours"])

    def test_an_excluded_area_that_is_not_there_is_named(self):
        self.refused("bake", "plane", "-o", "f.sward", "--exclude", "pond.glb:margin", "2", code=IO,
                     names=["pond.glb"])

    def test_assignments_change_the_meadow_and_name_what_they_do_not_know(self):
        def meadow(*options):
            done = self.sward("bake", "plane", "--print-config", *options)
            return json.loads(done.stdout)["bake"]["meadow"]

        plain = meadow()
        changed = meadow("--set", "clump_size_m=0.25", "--set", "species.bent.height_m=[0.1,0.2]",
                         "--set", "species.0.share=5", "--set", "species.*.facing=shared",
                         "--set", "species.bent.slope=:30~5", "--set", "name=mine")
        self.assertEqual(changed["clump_size_m"], 0.25)
        self.assertEqual(changed["name"], "mine")
        by_name = {species["name"]: species for species in changed["species"]}
        self.assertEqual(by_name["bent"]["height_m"], [0.1, 0.2])
        self.assertEqual(by_name["bent"]["slope"], "0:30~5")
        self.assertEqual(changed["species"][0]["share"], 5)
        self.assertEqual({s["facing"] for s in changed["species"]}, {"shared"})
        self.assertEqual(by_name["fescue"]["height_m"], plain["species"][1]["height_m"])
        self.refused("bake", "plane", "-o", "f.sward", "--set", "clump_size=1", code=USAGE,
                     names=["clump_size", "clump_size_m"])
        self.refused("bake", "plane", "-o", "f.sward", "--set", "species.oak.share=1", code=USAGE,
                     names=["oak", "ryegrass"])

    def test_a_meadow_reads_what_was_printed(self):
        done = self.sward("bake", "plane", "--print-config", "--set", "species.*.clumping=0.125")
        self.write_json("mine.json", json.loads(done.stdout)["bake"]["meadow"])
        again = self.sward("bake", "plane", "--print-config", "--meadow", "mine.json")
        self.assertEqual(json.loads(again.stdout)["bake"], json.loads(done.stdout)["bake"])

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

    def test_whatever_is_printed_ends_with_a_whole_line(self):
        self.bake("plane", "--count", "500", to="f.sward")
        self.sward("plan", "plane", "--count", "500", "--tiles", "1", "-o", "p.json")
        cases = [(0, "--version"), (0, "--help"), (0, "--man"), (0, "--completion"), (USAGE,),
                 *((0, command, "--help") for command in COMMANDS),
                 (0, "bake", "plane", "--print-config"), (0, "bake", "plane", "--dry-run", "-v"),
                 (0, "bake", "plane", "-o", "g.sward", "--count", "9", "-v", "--force"),
                 (0, "info", "f.sward"), (0, "info", "f.sward", "--json"),
                 (0, "info", "f.sward", "--histogram"), (0, "validate", "f.sward"),
                 (0, "compare", "f.sward", "f.sward"), (7, "compare", "f.sward", "g.sward"),
                 (0, "export", "f.sward", "-o", "f.csv"), (0, "terrain", "plane", "-o", "t.glb"),
                 (0, "tile", "p.json", "--index", "0", "-o", "tiles"),
                 (0, "tile", "p.json", "--index", "0", "-o", "tiles"),
                 (0, "merge", "p.json", "tiles", "-o", "m.sward"),
                 (USAGE, "bake", "--slope"), (USAGE, "bake"), (IO, "info", "none.sward"),
                 (INPUT, "validate", "t.glb"), (USAGE, "bake", "plane")]
        for code, *words in cases:
            with self.subTest(words=words):
                done = self.sward(*words, code=code)
                self.assertNotEqual(done.stdout + done.stderr, "")
                for text in (done.stdout, done.stderr):
                    self.assertIn(text[-1:], ("\n", ""))
                    self.assertNotEqual(text[-2:], "\n\n", "no line is empty at the end")

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
