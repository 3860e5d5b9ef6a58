"""scripts/bundle --archive writes one file, which a user unpacks and runs on any newer Linux."""

import importlib.machinery
import importlib.util
import os
import re
import subprocess
import tarfile
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("SWARD_TEST_BUILD", ROOT / "build/release"))
LARGEST = 60_000_000  # bytes
START = 0.3  # [s] until a program has begun
# What archives promise; on a distribution with a newer C library only archives for the like of it can be made.
PROMISED = (2, 36)


def numbers(version):
    return tuple(map(int, version.split(".")))


def versions_in(section, file, name):
    """Symbol versions `name`_X.Y in one part of what objdump says: definitions or References."""
    text = subprocess.run(["objdump", "-p", file], capture_output=True, text=True, check=True).stdout
    part = re.search(rf"^Version {section}:\n((?:.+\n)*)", text, re.M)
    return [numbers(version) for version in re.findall(rf"\b{name}_(\d[.\d]*)\b", part[1])] if part else []


class Archive(unittest.TestCase):
    """What needs no whole archive. The program of a bundle, which an archive holds too: bundle_test.py."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-archive-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_an_archive_that_would_need_a_newer_c_library_is_refused(self):
        done = subprocess.run([ROOT / "scripts/bundle", "--archive", "--build", BUILD, "--out", self.folder / "none", "--glibc", "2.2"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"need glibc 2\.\d+, newer than 2\.2")
        self.assertFalse((self.folder / "none").exists())

    def test_the_same_files_give_the_same_bytes(self):
        loader = importlib.machinery.SourceFileLoader("bundle", str(ROOT / "scripts/bundle"))
        bundle = importlib.util.module_from_spec(importlib.util.spec_from_loader("bundle", loader))
        loader.exec_module(bundle)
        written = []
        for order, names in enumerate((["a", "b"], ["b", "a"])):
            folder = self.folder / str(order) / "folder"
            folder.mkdir(parents=True)
            for name in names:
                (folder / name).write_text(name)
                (folder / name).chmod(0o644 if order else 0o600)
                os.utime(folder / name, (order, order))
            bundle.write_archive(folder, self.folder / f"{order}.tgz")
            written.append((self.folder / f"{order}.tgz").read_bytes())
        self.assertEqual(*written)


class LongArchive(unittest.TestCase):
    """A whole archive: twenty seconds to pack and to look at. Before each release it is what users get."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-archive-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        here = numbers(os.confstr("CS_GNU_LIBC_VERSION").split()[1])
        cls.glibc = max(PROMISED, here)
        done = subprocess.run([ROOT / "scripts/bundle", "--archive", "--build", BUILD, "--out", cls.folder, "--glibc",
                               ".".join(map(str, cls.glibc))], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.archive, = cls.folder.glob("*.tar.gz")
        cls.unpacked = cls.folder / "un packed"
        with tarfile.open(cls.archive) as tar:
            cls.entries = tar.getmembers()
            tar.extractall(cls.unpacked)
        cls.top = cls.unpacked / cls.archive.name.removesuffix(".tar.gz")

    def run_bare(self, *command, code=0, cwd="/"):
        """In an empty environment, but for the paths of a bare system, the driver and its compiled shaders."""
        driver = {name: os.environ[name] for name in ("VK_ICD_FILENAMES", "VK_DRIVER_FILES", "XDG_CACHE_HOME")
                  if name in os.environ}
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=cwd, timeout=600,
                              env={"PATH": "/usr/bin:/bin", **driver})
        self.assertEqual(done.returncode, code, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def binaries(self):
        files = [file for part in ("bin", "lib") for file in (self.top / part).rglob("*") if file.is_file()]
        self.assertGreater(len(files), 10)
        return files

    def test_it_unpacks_to_one_folder_of_plain_files(self):
        self.assertRegex(self.archive.name, r"^sward-\d+\.\d+\.\d+-linux-x86_64\.tar\.gz$")
        self.assertLessEqual(self.archive.stat().st_size, LARGEST)
        for entry in self.entries:
            self.assertEqual(entry.name.split("/")[0], self.top.name)
            self.assertNotIn("..", entry.name.split("/"))
            self.assertTrue(entry.isfile() or entry.isdir(), f"{entry.name} may point to nothing elsewhere")
            self.assertEqual((entry.uid, entry.gid, entry.mode & 0o022), (0, 0, 0), entry.name)

    def test_it_needs_no_newer_c_library_than_it_says(self):
        needed = {file.name: max(versions_in("References", file, "GLIBC"), default=(0,)) for file in self.binaries()}
        self.assertGreater(max(needed.values()), (2, 2), "symbol versions were read")
        for name, version in needed.items():
            self.assertLessEqual(version, self.glibc, name)
        self.assertIn(f"glibc {'.'.join(map(str, self.glibc))} ", (self.top / "README.txt").read_text(encoding="utf-8"))

    def test_its_c_plus_plus_library_has_all_that_its_binaries_need(self):
        library = self.top / "lib/spare/libstdc++.so.6/libstdc++.so.6"
        for name in ("GLIBCXX", "CXXABI"):
            needed = max(version for file in self.binaries() for version in versions_in("References", file, name))
            self.assertLessEqual(needed, max(versions_in("definitions", library, name)), name)

    def test_programs_start_from_another_folder_and_through_a_link(self):
        elsewhere = self.folder / "else where"
        elsewhere.mkdir()
        link = elsewhere / "grow grass"
        link.symlink_to(self.top / "sward")
        self.run_bare(link, "bake", "plane", "--count", 500, "-o", "plane.sward", "-q", cwd=elsewhere)
        self.run_bare(self.top / "sward-view", "render", "plane.sward", "-o", "plane.png", "--size", "64x36", cwd=elsewhere)
        self.assertEqual((elsewhere / "plane.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(self.run_bare("sh", self.top / "run", "sward", "--version"), self.run_bare(self.top / "sward", "--version"))

    def test_programs_start_at_once(self):
        times = []
        for _ in range(9):
            begin = time.monotonic()
            self.run_bare(self.top / "sward-view", "--version")
            times.append(time.monotonic() - begin)
        self.assertLessEqual(min(times), START)

    def test_pages_and_completions_are_those_of_the_programs(self):
        for program in ("sward", "sward-view"):
            self.assertEqual((self.top / f"share/man/man1/{program}.1").read_text(), self.run_bare(self.top / program, "--man"))
            self.assertEqual((self.top / f"share/bash-completion/completions/{program}").read_text(),
                             self.run_bare(self.top / program, "--completion"))
        for name in ("README.md", "docs/settings.md", "examples/read_field.py", "assets/meadows/lawn.json", "assets/settings"):
            self.assertTrue((self.top / "share/doc/sward" / name).exists(), name)

    def test_every_library_comes_with_its_licence(self):
        self.assertIn("Sward", (self.top / "LICENSE").read_text(encoding="utf-8"))
        common = {path.name for path in Path("/usr/share/common-licenses").iterdir()}
        for file in (self.top / "lib").rglob("*.so*"):
            if file.is_file():
                said = subprocess.run(["dpkg-query", "--search", f"*/{file.name}*"], capture_output=True, text=True).stdout
                nonEmptyPatches = {line.split(":")[0] for line in said.splitlines()}
                self.assertTrue(any((self.top / "licenses" / owner).is_file() for owner in nonEmptyPatches), f"{file.name}: {nonEmptyPatches}")
        for file in (self.top / "licenses").glob("*"):
            if file.is_file():
                for name in re.findall(r"/usr/share/common-licenses/([\w.-]*\w)", file.read_text(encoding="utf-8", errors="replace")):
                    if name in common:
                        self.assertTrue((self.top / "licenses/common-licenses" / name).is_file(), f"{file.name}: {name}")


if __name__ == "__main__":
    unittest.main()
