"""Tests that a machine cannot run are left out with a reason; CI demands them."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import needs  # noqa: E402

BUILD = Path(os.environ.get("SWARD_TEST_BUILD", ROOT / "build/release"))

# A test file as others are, on a machine that lacks a thing.
GUEST = textwrap.dedent("""
    import sys, unittest
    sys.path.insert(0, {support!r})
    import needs
    needs.NEEDS["moon"] = needs.Need("the moon", ("moonlight",), lambda: False)
    needs.NEEDS["comet"] = needs.Need("a comet", ("perihelion",), lambda: False, "--dev")
    needs.NEEDS["sun"] = needs.Need("the sun", ("daylight",), lambda: True)
    needs.ABSENT = {absent!r}
    needs.platform.freedesktop_os_release = lambda: {{"ID": "some", "VERSION_ID": "1"}}
    class Guest(unittest.TestCase):
        def test_night(self): needs.needs("moon")
        def test_day(self): needs.needs("sun")
        def test_years(self): needs.needs("comet")
        def test_eclipse(self): needs.leave_out("sun", "it is hidden")
        def test_wrong(self): self.fail("wrong")
    unittest.main()
    """)
ABSENT = {("some", "1"): {"moonlight"}}


def is_own(path):
    """Whether a file is about leaving out, rather than a user of it."""
    return path.parent == ROOT / "tests/support" or path == Path(__file__).resolve()


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
        self.assertEqual(said, "Left out: guest Guest.test_night: needs the moon: install moonlight (scripts/install-dependencies --test)\n")

    def test_in_ci_it_fails(self):
        words, text = self.run_ctest("night", CI="true")
        self.assertIn("Failed", words)
        self.assertIn("needs the moon", text)
        self.assertIn("Failed", self.run_ctest("eclipse", CI="true")[0])

    def test_what_a_distribution_does_not_have_is_left_out_in_ci_too(self):
        self.assertIn("Skipped", self.run_ctest("night", absent=ABSENT, CI="true")[0])
        # Another package of the same machine is demanded all the same.
        self.assertIn("Failed", self.run_ctest("eclipse", absent=ABSENT, CI="true")[0])

    def test_what_only_developers_install_is_left_out_in_ci_too(self):
        self.assertIn("Skipped", self.run_ctest("years", CI="true")[0])
        log = (self.folder / "Testing/Temporary/LastTest.log").read_text(encoding="utf-8")
        self.assertIn("install perihelion (scripts/install-dependencies --dev)", log)

    def test_a_test_with_its_need_passes_and_a_failure_is_never_hidden(self):
        self.assertIn("Passed", self.run_ctest("day", CI="true")[0])
        self.assertIn("Skipped", self.run_ctest("eclipse")[0])
        self.assertIn("Failed", self.run_ctest("wrong", "night")[0])


class Registered(unittest.TestCase):
    def test_every_test_that_may_be_left_out_is_listed_as_skipped(self):
        # Not by ctest itself: in this build folder it would write over the log of the run that this test is part of.
        registered = "".join(file.read_text(encoding="utf-8") for file in BUILD.rglob("CTestTestfile.cmake"))
        texts = {path: path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("*.py") if not is_own(path)}
        users = {path.stem for path, text in texts.items() if re.search(r"\b(needs|leave_out)\(", text)}
        # Those that import a user, or what imports one.
        while True:
            imports = re.compile(rf"^(?:import|from) (?:{'|'.join(sorted(users))})\b", re.M)
            more = {path.stem for path, text in texts.items() if imports.search(text)} - users
            if not more:
                break
            users |= more
        tests = {f"{path.parent.name}/{path.name}" for path in texts if path.stem.endswith("_test") and path.stem in users}
        checked = 0
        for name, command in re.findall(r"^add_test\((\S+) (.*)\)$", registered, re.M):
            if (file := re.search(r"(\w+/\w+_test\.py)\"", command)) and file[1] in tests:
                properties = re.search(rf"^set_tests_properties\({re.escape(name)} PROPERTIES (.*)\)$", registered, re.M)[1]
                written = needs.SKIPPED.replace("\\", "\\\\")
                self.assertIn(f'SKIP_REGULAR_EXPRESSION "{written}"', properties, name)
                checked += 1
        self.assertGreater(checked, 25)

    def test_every_way_of_leaving_out_is_told(self):
        # unittest's own skips print no reason that the end of a run could tell.
        own = re.compile(r"skipTest\(|unittest\.skip|SkipTest|SKIP_RETURN_CODE|DISABLED_|\bDISABLED\b")
        for path in [*(ROOT / "tests").rglob("*.py"), *(ROOT / "tests").rglob("*.cpp"),
                     *(ROOT / "tests").rglob("CMakeLists.txt")]:
            if not is_own(path):
                self.assertIsNone(own.search(path.read_text(encoding="utf-8")), path)

    def test_what_a_googletest_skips_is_told_and_demanded(self):
        with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
            log.write("1/1 Test: gpu.Some\nCommand: x\nOutput:\n[ RUN      ] Some.Law\n/a/some_test.cpp:7: Skipped\nit rains\n\n[  SKIPPED ] Some.Law\n")
            log.flush()
            for demanded in ("", "true"):
                done = subprocess.run([ROOT / "tests/support/needs.py", log.name], capture_output=True, text=True,
                                      env={**os.environ, "CI": demanded})
                self.assertEqual((done.stdout, done.returncode), ("Left out: Some.Law: it rains\n", int(bool(demanded))))


class Script(unittest.TestCase):
    """scripts/test itself in a tree whose build and ctest are stand-ins, on a PATH without a tool."""

    def run_script(self, *arguments, installs=True, script="scripts/test", **environment):
        with tempfile.TemporaryDirectory(prefix="sward-needs-") as name:
            folder = Path(name)
            for part in ("scripts", "tests", ".ci"):
                (folder / part).mkdir()
            shutil.copy(ROOT / "scripts/test", folder / "scripts")
            shutil.copy(ROOT / ".ci/run", folder / ".ci")
            (folder / "tests/support").symlink_to(ROOT / "tests/support")
            stand_ins = {
                "scripts/install-dependencies": f"exit {int(not installs)}", "scripts/build": "exit 0",
                "bin/node": "exit 0",
                # Runs one test as ctest does: a file in LastTest.log, a word on what it was.
                "bin/ctest": f"""case " $* " in *" -N "*) echo "Total Tests: 3"; exit 0 ;; esac
                                 mkdir -p build/release/Testing/Temporary
                                 echo "1/1 Test: guest" > build/release/Testing/Temporary/LastTest.log
                                 /usr/bin/python3 -B {folder}/guest.py 2>> build/release/Testing/Temporary/LastTest.log"""}
            for file, text in stand_ins.items():
                (folder / file).parent.mkdir(exist_ok=True)
                (folder / file).write_text(f"#!/bin/bash\n{text}\n", encoding="utf-8")
                (folder / file).chmod(0o755)
            (folder / "guest.py").write_text(
                f"import sys, unittest\nsys.path.insert(0, {str(ROOT / 'tests/support')!r})\nimport needs\n"
                "class Guest(unittest.TestCase):\n    def test(self): needs.needs('parallel')\nunittest.main()\n", encoding="utf-8")
            # Only these tools are found: GNU parallel is not among them.
            for tool in ("bash", "env", "dirname", "readlink", "sed", "nproc", "mkdir", "echo"):
                (folder / "bin" / tool).symlink_to(shutil.which(tool))
            clean = {key: value for key, value in os.environ.items() if key != "CI"}
            return subprocess.run([folder / script, *arguments], capture_output=True, text=True,
                                  env={**clean, "PATH": str(folder / "bin"), **environment})

    def test_it_says_before_and_after_what_is_left_out_and_why(self):
        done = self.run_script()
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertIn("Left out: 3 suites with the label long (scripts/test --long runs them)", lines)
        self.assertIn("Left out: tests that need GNU parallel: install parallel (scripts/install-dependencies --test)", lines)
        self.assertEqual(lines[-1], "Left out: guest Guest.test: needs GNU parallel: install parallel (scripts/install-dependencies --test)")

    def test_complete_and_ci_demand_it(self):
        for how in ({"script": ".ci/run"}, {"CI": "true"}):
            self.assertNotEqual(self.run_script(**how).returncode, 0, how)
        self.assertNotEqual(self.run_script("--complete").returncode, 0)

    def test_packages_that_cannot_be_installed_are_told_or_demanded(self):
        done = self.run_script(installs=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Left out: what the missing packages bring; they could not be installed", done.stdout)
        self.assertEqual(self.run_script("--complete", installs=False).returncode, 1)


class Lists(unittest.TestCase):
    def test_every_need_is_installed_by_the_option_that_it_names(self):
        installed = {}
        for option in ("--test", "--dev"):
            said = subprocess.run([ROOT / "scripts/install-dependencies", option, "--print"], capture_output=True, text=True, check=True)
            installed[option] = set(said.stdout.split())
        for need in needs.NEEDS.values():
            self.assertLessEqual(set(need.packages), installed[need.option], need.what)

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
