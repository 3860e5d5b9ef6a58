"""A host in C reads a field and draws it by the rasteriser and by the tessellator."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path


class CInterface(unittest.TestCase):
    def test_a_host_in_c_reads_and_draws(self):
        with tempfile.TemporaryDirectory(prefix="sward-c-") as folder:
            field, damaged = Path(folder) / "plane.sward", Path(folder) / "damaged.sward"
            seeded = Path(folder) / "seeded.sward"
            subprocess.run([os.environ["SWARD_PROGRAM"], "bake", "plane", "--density", "60", "--blade-scale", "4", "--sky-rays", "0",
                            "--seeds", "always", "--budget", "5000", "-o", seeded, "-q"], check=True)
            baked = ["plane", "--count", "20000", "--blade-scale", "4"]
            subprocess.run([os.environ["SWARD_PROGRAM"], "bake", *baked, "-o", field, "-q"], check=True)
            content = bytearray(field.read_bytes())
            content[len(content) // 2] ^= 1
            damaged.write_bytes(content)
            # Erases a part of the grass.
            stroke = {"kind": "erase", "radius_m": 12, "hardness": 1, "points": [[0, 0, 0]]}
            with subprocess.Popen([os.environ["SWARD_PROGRAM"], "edit", *baked, "--field", field, "-q"], text=True,
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE) as session:
                self.assertIn('"reused":true', session.stdout.readline())
                print(json.dumps({"id": 1, "do": "paint", "keep": 0, "strokes": [stroke]}), file=session.stdin,
                      flush=True)
                delta = json.loads(session.stdout.readline())["delta"]
                done = subprocess.run([os.environ["SWARD_C_HOST"], field, damaged, delta, seeded],
                                      capture_output=True, text=True, timeout=300)
                session.stdin.close()
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr, "")
            self.assertIn("tessellated: ", done.stdout)
            self.assertIn("edited: ", done.stdout)
            self.assertIn("sown: ", done.stdout)

    def test_a_reader_of_fields_in_c_needs_no_vulkan_and_knows_ribbons(self):
        program = os.environ["SWARD_C_FIELDS"]
        loaded = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
        self.assertNotIn("vulkan", loaded.lower())
        symbols = subprocess.run(["nm", "-C", program], capture_output=True, text=True, check=True).stdout
        self.assertNotRegex(symbols, r" vk[A-Z]|sward::(gpu|render)::")
        with tempfile.TemporaryDirectory(prefix="sward-c-") as folder:
            field, table = Path(folder) / "plants.sward", Path(folder) / "plants.csv"
            subprocess.run([os.environ["SWARD_PROGRAM"], "bake", "plane", "--meadow", "daisies", "--count", "3000",
                            "--blade-scale", "1", "-o", field, "-q"], check=True)
            subprocess.run([os.environ["SWARD_PROGRAM"], "export", field, "-o", table], check=True, capture_output=True)
            said = subprocess.run([program, field], capture_output=True, text=True, check=True).stdout
            rows, ribbons = map(int, re.fullmatch(r"(\d+) rows, (\d+) ribbons\n", said).groups())
            self.assertGreater(ribbons, 0)
            # CSV leaves ribbons out.
            self.assertEqual(rows - ribbons, len(table.read_text(encoding="utf-8").splitlines()) - 1)


if __name__ == "__main__":
    unittest.main()
