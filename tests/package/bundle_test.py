"""scripts/bundle packs what runs on a machine without packages."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("SWARD_TEST_BUILD", ROOT / "build/release"))
LARGEST = 50_000_000  # bytes
# What a system has.
SYSTEM = {"ld-linux-x86-64.so.2", "libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1"}


class Bundle(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-bundle-")
        cls.addClassCleanup(folder.cleanup)
        cls.made = Path(folder.name) / "made"
        done = subprocess.run([ROOT / "scripts/bundle", "--build", BUILD, "--out", cls.made], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        # Move it away from its build folder.
        cls.bundle = Path(folder.name) / "else where"
        cls.made.rename(cls.bundle)

    def run_bare(self, *command, **environment):
        """In an empty environment, but for the paths of a bare system, the driver and its compiled shaders."""
        driver = {name: os.environ[name] for name in ("VK_ICD_FILENAMES", "VK_DRIVER_FILES", "XDG_CACHE_HOME")
                  if name in os.environ}
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd="/", timeout=600,
                              env={"PATH": "/usr/bin:/bin", **driver, **environment})
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def test_it_is_small_and_knows_its_commit(self):
        size = sum(file.stat().st_size for file in self.bundle.rglob("*") if file.is_file())
        self.assertLessEqual(size, LARGEST)
        self.assertTrue((self.bundle / "COMMIT").read_text(encoding="ascii").strip())
        for file in self.bundle.rglob("*"):
            self.assertFalse(file.is_symlink(), f"{file} may point to nothing elsewhere")

    def test_its_libraries_are_all_that_its_programs_need_beside_a_system(self):
        work = tempfile.TemporaryDirectory(prefix="sward-work-")
        self.addCleanup(work.cleanup)
        folder = self.run_bare(self.bundle / "run", "libraries", SWARD_WORK=work.name).strip()
        programs = [self.bundle / "bin" / name for name in ("sward", "sward-view")]
        folders = [f"{folder}/own", *map(str, Path(folder).glob("spare/*"))]
        self.assertGreater(len(folders), 5)
        said = self.run_bare("ldd", *programs, LD_LIBRARY_PATH=":".join(folders))
        self.assertNotIn("not found", said)
        self.assertNotIn(str(BUILD), said)
        for name, file in re.findall(r"^\s*(?:\S*/)?([^/\s]+\.so\S*) => (.+?) \(0x", said, re.M):
            if name not in SYSTEM:
                self.assertTrue(file.startswith(folder), f"{name} is that of this machine: {file}")

    def test_it_bakes_and_measures(self):
        with tempfile.TemporaryDirectory(prefix="sward-work-") as work:
            self.assertRegex(self.run_bare(self.bundle / "run", "sward", "--version", SWARD_WORK=work), r"^sward \d+\.\d+\.\d+\n$")
            self.run_bare(self.bundle / "run", "bench", "--count", "500", "--size", "64x36", "--frames", "1", "--warmup", "0",
                          "--groups", "culling", "other", SWARD_WORK=work, TMPDIR=work)
            text = (Path(work) / "report/README.md").read_text(encoding="utf-8")
            commit = (self.bundle / "COMMIT").read_text(encoding="ascii").strip()
            self.assertIn(f"commit {commit}", text)
            self.assertIn("| all |", text)
        self.assertFalse((self.bundle / "work").exists(), "fields, reports and libraries lie where they were wanted")


if __name__ == "__main__":
    unittest.main()
