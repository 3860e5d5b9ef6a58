"""A host in C reads a field and draws it by the rasteriser and by the tessellator."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path


class CInterface(unittest.TestCase):
    def test_a_host_in_c_reads_and_draws(self):
        with tempfile.TemporaryDirectory(prefix="sward-c-") as folder:
            field, damaged = Path(folder) / "plane.sward", Path(folder) / "damaged.sward"
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
                done = subprocess.run([os.environ["SWARD_C_HOST"], field, damaged, delta],
                                      capture_output=True, text=True, timeout=300)
                session.stdin.close()
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr, "")
            self.assertIn("tessellated: ", done.stdout)
            self.assertIn("edited: ", done.stdout)


if __name__ == "__main__":
    unittest.main()
