"""The launcher of bundles chooses between the libraries of the machine and those that it brings."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMPILER = os.environ.get("SWARD_TEST_CXX", "c++")
# Symbol versions of the small library that represents a driver's libraries.
OLD = "V1 { global: first; local: *; };\n"
NEW = OLD + "V2 { global: second; } V1;\n"


class Launcher(unittest.TestCase):
    """In place of Sward stands a program that prints where its libraries come from: libdriver, which the
    machine may have too, and libown, which only Sward uses."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward launcher-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bundle = self.folder / "the bundle"
        self.machine = self.folder / "machine"
        (self.bundle / "bin").mkdir(parents=True)
        driver = self.driver(self.bundle / "lib/spare/libdriver.so.1", "bundle", NEW)
        own = self.own(self.bundle / "lib/own", "bundle")
        self.compile(self.source("""
            #include <stdio.h>
            const char* second(void);
            const char* own(void);
            int main(int count, char** words)
            {
                printf("driver %s own %s\\n", second(), own());
                for (int i = 1; i < count; ++i) printf("<%s>", words[i]);
                return 3;
            }"""), "-x", "none", driver, own, "-o", self.bundle / "bin/sward")
        shutil.copy(self.bundle / "bin/sward", self.bundle / "bin/sward-view")
        launcher = (ROOT / "cmake/package/launcher.sh").read_text(encoding="utf-8").replace("@GLIBC@", "2.36")
        for name in ("run", "sward", "sward-view"):
            (self.bundle / name).write_text(launcher, encoding="utf-8")
            (self.bundle / name).chmod(0o755)

    def source(self, text):
        path = self.folder / f"source{len(list(self.folder.glob('source*')))}.c"
        path.write_text(text, encoding="utf-8")
        return path

    def compile(self, source, *arguments):
        done = subprocess.run([COMPILER, "-x", "c", *map(str, [source, *arguments])], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def library(self, folder, name, place, functions, *options):
        folder.mkdir(parents=True, exist_ok=True)
        text = "".join(f'const char* {function}(void) {{ return "{place}"; }}\n' for function in functions)
        self.compile(self.source(text), "-shared", "-fPIC", f"-Wl,-soname,{name}", *options, "-o", folder / name)
        return folder / name

    def driver(self, folder, place, versions):
        functions = ["first", "second"] if versions == NEW else ["first"]
        return self.library(folder, "libdriver.so.1", place, functions, f"-Wl,--version-script={self.source(versions)}")

    def own(self, folder, place):
        return self.library(folder, "libown.so.1", place, ["own"])

    def run_it(self, *command, code=3, **environment):
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, cwd="/",
                              env={"PATH": "/usr/bin:/bin", **environment})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code == 3 else done.stderr

    def test_a_library_that_the_machine_lacks_is_that_of_the_bundle(self):
        self.assertEqual(self.run_it(self.bundle / "sward"), "driver bundle own bundle\n")

    def test_a_library_that_the_machine_has_is_that_of_the_machine(self):
        self.driver(self.machine, "machine", NEW)
        self.assertEqual(self.run_it(self.bundle / "sward", LD_LIBRARY_PATH=str(self.machine)), "driver machine own bundle\n")

    def test_a_library_of_the_machine_that_is_too_old_is_replaced(self):
        self.driver(self.machine, "machine", OLD)
        self.assertEqual(self.run_it(self.bundle / "sward", LD_LIBRARY_PATH=str(self.machine)), "driver bundle own bundle\n")

    def test_a_library_of_sward_alone_is_never_that_of_the_machine(self):
        self.own(self.machine, "machine")
        self.assertEqual(self.run_it(self.bundle / "sward", LD_LIBRARY_PATH=str(self.machine)), "driver bundle own bundle\n")

    def test_words_and_exit_code_pass_through_a_symbolic_link_and_every_shell(self):
        link = self.folder / "a link"
        link.symlink_to(self.bundle / "sward-view")
        words = ["a b", "*", "$HOME", "", "-n"]
        wanted = "driver bundle own bundle\n" + "".join(f"<{word}>" for word in words)
        self.assertEqual(self.run_it(link, *words), wanted)
        self.assertEqual(self.run_it("bash", link, *words), wanted)
        self.assertEqual(self.run_it("dash", self.bundle / "run", "sward", *words), wanted)
        self.assertEqual(self.run_it("a link", *words, PATH=f"{self.folder}:/usr/bin:/bin"), wanted)

    def test_a_folder_whose_name_the_dynamic_linker_cannot_take_is_refused(self):
        there = self.bundle.rename(self.folder / "a:b")
        self.assertIn("a:b", self.run_it(there / "sward", code=2))

    def test_an_older_c_library_is_named(self):
        """A program that wants a glibc of the far future."""
        program = self.bundle / "bin/sward"
        text = program.read_bytes()
        versions = sorted(set(subprocess.run(["strings", program], capture_output=True, text=True).stdout.split()))
        version = [name for name in versions if name.startswith("GLIBC_2.")][-1].encode()
        program.write_bytes(text.replace(b"\0" + version + b"\0", b"\0GLIBC_9." + b"9" * (len(version) - 8) + b"\0"))
        self.assertIn("glibc 2.36", self.run_it(self.bundle / "sward", code=5))


if __name__ == "__main__":
    unittest.main()
