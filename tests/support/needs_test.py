"""Tests that a machine cannot run are left out with a reason; CI demands them."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))
import needs

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("SWARD_TEST_BUILD", ROOT / "build/release"))

# A test file as others are, on a machine that lacks a thing.
GUEST = """
import sys, unittest
sys.path.insert(0, {support!r})
import needs
needs.NEEDS["moon"] = needs.Need("the moon", ("moonlight",), lambda: False)
needs.NEEDS["sun"] = needs.Need("the sun", ("daylight",), lambda: True)
needs.ABSENT = {absent!r}
needs.platform.freedesktop_os_release = lambda: {{"ID": "some", "VERSION_ID": "1"}}
class Guest(unittest.TestCase):
    def test_night(self): needs.needs("moon")
    def test_day(self): needs.needs("sun")
    def test_eclipse(self): needs.leave_out("sun", "it is hidden")
    def test_wrong(self): self.fail("wrong")
unittest.main()
"""
ABSENT = {("some", "1"): {"moonlight"}}


class InCtest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-needs-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_ctest(self, *tests, absent=None, **environment):
        """The words with which ctest ends its line for a test of the guest's `tests`, and all that it printed."""
        guest = self.folder / "guest.py"
        guest.write_text(GUEST.format(support=str(ROOT / "tests/support"), absent=absent or {}), encoding="utf-8")
        names = " ".join(f'"Guest.test_{test}"' for test in tests)
        (self.folder / "CTestTestfile.cmake").write_text(
            f'add_test(guest "{sys.executable}" "-B" "{guest}" {names})\n'
            f"set_tests_properties(guest PROPERTIES SKIP_REGULAR_EXPRESSION [==[{needs.SKIPPED}]==])\n", encoding="utf-8")
        clean = {name: value for name, value in os.environ.items() if name != "CI"}
        done = subprocess.run(["ctest", "--output-on-failure"], cwd=self.folder, capture_output=True, text=True,
                              env={**clean, **environment})
        words = next(line for line in done.stdout.splitlines() if "1/1" in line)
        return words, done.stdout

    def test_a_test_without_its_need_is_skipped_and_the_reason_is_told(self):
        words, text = self.run_ctest("night")
        self.assertIn("Skipped", words)
        self.assertRegex(text, r"did not run:\n\s*1 - guest \(Skipped\)")
        said = subprocess.run([ROOT / "tests/support/needs.py", self.folder / "Testing/Temporary/LastTest.log"],
                              capture_output=True, text=True).stdout
        self.assertEqual(said, "Left out: guest: needs the moon: install moonlight (scripts/install-dependencies --test)\n")

    def test_in_ci_it_fails(self):
        words, text = self.run_ctest("night", CI="true")
        self.assertIn("Failed", words)
        self.assertIn("needs the moon", text)
        self.assertIn("Failed", self.run_ctest("eclipse", CI="true")[0])

    def test_what_a_distribution_does_not_have_is_left_out_in_ci_too(self):
        self.assertIn("Skipped", self.run_ctest("night", absent=ABSENT, CI="true")[0])
        # Another package of the same machine is demanded all the same.
        self.assertIn("Failed", self.run_ctest("eclipse", absent=ABSENT, CI="true")[0])

    def test_a_test_with_its_need_passes_and_a_failure_is_never_hidden(self):
        self.assertIn("Passed", self.run_ctest("day", CI="true")[0])
        self.assertIn("Skipped", self.run_ctest("eclipse")[0])
        self.assertIn("Failed", self.run_ctest("wrong", "night")[0])


class Registered(unittest.TestCase):
    def test_every_test_that_may_be_left_out_is_listed_as_skipped(self):
        # Not by ctest itself: in this build folder it would write over the log of the run that this test is part of.
        registered = "".join(file.read_text(encoding="utf-8") for file in BUILD.rglob("CTestTestfile.cmake"))
        texts = {path: path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("*.py") if path.parent != ROOT / "tests/support"}
        users = {path.stem for path, text in texts.items() if re.search(r"\b(needs|leave_out)\(", text)}
        imports = re.compile(rf"^(?:import|from) (?:{'|'.join(sorted(users))})\b", re.M)
        tests = {f"{path.parent.name}/{path.name}" for path, text in texts.items()
                 if path.stem.endswith("_test") and (path.stem in users or imports.search(text))}
        checked = 0
        for name, command in re.findall(r"^add_test\((\S+) (.*)\)$", registered, re.M):
            if (file := re.search(r"(\w+/\w+_test\.py)\"", command)) and file[1] in tests:
                properties = re.search(rf"^set_tests_properties\({re.escape(name)} PROPERTIES (.*)\)$", registered, re.M)[1]
                written = needs.SKIPPED.replace("\\", "\\\\")
                self.assertIn(f'SKIP_REGULAR_EXPRESSION "{written}"', properties, name)
                checked += 1
        self.assertGreater(checked, 50)


class Lists(unittest.TestCase):
    def test_every_need_is_installed_for_tests(self):
        said = subprocess.run([ROOT / "scripts/install-dependencies", "--test", "--print"], capture_output=True, text=True, check=True)
        installed = set(said.stdout.split())
        for need in needs.NEEDS.values():
            self.assertLessEqual(set(need.packages), installed, need.what)

    def test_what_is_absent_is_something_that_a_need_names(self):
        known = {package for need in needs.NEEDS.values() for package in need.packages}
        for system, packages in needs.ABSENT.items():
            self.assertLessEqual(packages, known, system)

    def test_a_machine_that_lacks_something_says_so_before_the_tests(self):
        with mock.patch.dict(needs.NEEDS, {"moon": needs.Need("the moon", ("moonlight",), lambda: False)}, clear=True), \
                mock.patch("builtins.print") as said:
            needs.main([])
        said.assert_called_once_with("Left out: tests that need the moon: install moonlight (scripts/install-dependencies --test)")


if __name__ == "__main__":
    unittest.main()
