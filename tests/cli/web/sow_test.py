"""Fields with seeds in a page: web/dist/sow.wasm is the sower of src/field/seeds, compiled by web/sow/build."""

import hashlib
import json
import platform
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from support import CliTest, ROOT

from needs import needs

HERE = Path(__file__).resolve().parent
MODULE = ROOT / "web/dist/sow.wasm"
MAX_BYTES = 60_000  # compressed


class Sources(unittest.TestCase):
    def test_the_module_is_of_these_sources(self):
        """The hashes of all files that its build has read."""
        lines = (ROOT / "web/dist/sow.sources").read_text(encoding="ascii").splitlines()
        self.assertGreater(len(lines), 50)
        changed = []
        for line in lines:
            known, path = line.split("  ", 1)
            file = ROOT / path
            if not file.is_file() or hashlib.sha256(file.read_bytes()).hexdigest() != known:
                changed.append(path)
        self.assertEqual(changed, [], "changed since web/dist/sow.wasm was made: run web/sow/build, and commit both")

    def test_the_module_is_small(self):
        import gzip
        self.assertLess(len(gzip.compress(MODULE.read_bytes(), 9)), MAX_BYTES)


class SownUnits(CliTest):
    def assert_sown_as_by_sward(self, *ground):
        """All units together are the field that `sward grow` writes, in packed bytes."""
        needs("node")
        seeds = self.bake(*ground, "--budget", "300", "--seeds", "always", to="seeds.sward")
        grown = self.folder / "grown.sward"
        self.sward("grow", seeds, "-o", grown)
        done = subprocess.run(["node", str(HERE / "sow_units.mjs"), str(seeds), str(grown)], capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.assertGreater(found["units"], 10)
        self.assertEqual(found["sown"], found["all"])
        for fault in ("different", "unbounded", "again", "torn"):
            self.assertEqual(found[fault], 0, fault)

    def test_units_of_hills_are_those_of_sward(self):
        self.assert_sown_as_by_sward("hills", "--density", "8", "--meadow", "daisies")

    def test_units_of_a_planet_are_those_of_sward(self):
        self.assert_sown_as_by_sward("sphere", "--density", "8", "--ground-up", "radial")


class LongModule(CliTest):
    def test_the_module_is_what_clang_makes(self):
        needs("clang wasm32")
        system = platform.freedesktop_os_release()
        if (system.get("ID"), system.get("VERSION_ID")) != ("debian", "12"):
            self.skipTest("other versions of the compiler write other bytes")
        done = subprocess.run([str(ROOT / "web/sow/build"), str(self.folder)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("sow.wasm", "sow.sources"):
            self.assertEqual((self.folder / name).read_bytes(), (ROOT / "web/dist" / name).read_bytes(), name)


if __name__ == "__main__":
    unittest.main()
