"""Fields with seeds in a page: web/dist/sow.wasm is the sower of src/field/seeds, compiled by web/sow/build."""

import hashlib
import json
import os
import platform
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from support import CliTest, ROOT

from browser import look
from needs import leave_out, needs

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


class LongMemory(CliTest):
    """A page does not grow: not on the device, and not in its heap. SWARD_WEB_SECONDS states how long it is used."""

    def assert_memory_stays(self, field, room):
        needs("chromium")
        self.sward("export", field, "-o", "page/")
        page = self.folder / "page"
        shutil.copy(HERE / "checks.html", page)
        seconds = float(os.environ.get("SWARD_WEB_SECONDS", "0"))
        settings = {"check": "memory", "rounds": 8, "room": room, "seconds": seconds}
        (page / "settings.json").write_text(json.dumps(settings), encoding="ascii")
        found = look(self, page, "checks.html", "--enable-precise-memory-info", "--js-flags=--expose-gc",
                     timeout=400 + seconds)
        rounds = found["rounds"]
        print(f"{len(rounds)} rounds in {found['seconds']:.0f} s, {found['frames']} frames; heap "
              f"{[round(one['heap'] / 1e6, 1) for one in rounds[::max(len(rounds) // 8, 1)]]} MB; "
              f"blades sown {rounds[-1]['sown']}; objects {rounds[-1]['objects']}")
        # Pictures of both sizes, in motion and at rest, come and go in the first two rounds.
        for one in rounds[2:] + [{"objects": found["after"]}]:
            self.assertEqual(one["objects"], rounds[1]["objects"])
        heaps = [one["heap"] for one in rounds[2:]]
        self.assertLess(max(heaps[len(heaps) // 2:]), 1.05 * max(heaps[:len(heaps) // 2]) + 2e6)
        self.assertEqual(found["drawnHidden"], 0)
        return rounds

    def test_a_page_of_stored_blades_does_not_grow(self):
        self.assert_memory_stays(self.bake("hills", "--count", "20000"), 1)

    def test_a_page_that_sows_does_not_grow(self):
        """Its room is a fraction of what the rounds want, so units come and go."""
        field = self.bake("hills", "--density", "25", "--budget", "1500", "--seeds", "always", to="seeds.sward")
        rounds = self.assert_memory_stays(field, 40_000)
        self.assertGreater(rounds[-1]["sown"], 1000)
        self.assertLessEqual(max(one["sown"] for one in rounds), 40_960)


class LongModule(CliTest):
    def test_the_module_is_what_clang_makes(self):
        needs("clang wasm32")
        system = platform.freedesktop_os_release()
        if (system.get("ID"), system.get("VERSION_ID")) != ("debian", "12"):
            leave_out("clang wasm32", "the compilers of other systems write other bytes than Debian 12's")
        done = subprocess.run([str(ROOT / "web/sow/build"), str(self.folder)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("sow.wasm", "sow.sources"):
            self.assertEqual((self.folder / name).read_bytes(), (ROOT / "web/dist" / name).read_bytes(), name)


if __name__ == "__main__":
    unittest.main()
