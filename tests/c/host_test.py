"""A host in C reads a field and draws it by the rasteriser and by the tessellator."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path


class CInterface(unittest.TestCase):
    def test_a_host_in_c_reads_and_draws(self):
        with tempfile.TemporaryDirectory(prefix="sward-c-") as folder:
            field, damaged = Path(folder) / "plane.sward", Path(folder) / "damaged.sward"
            subprocess.run([os.environ["SWARD_PROGRAM"], "bake", "plane", "--count", "20000", "--blade-scale", "4",
                            "-o", field, "-q"], check=True)
            content = bytearray(field.read_bytes())
            content[len(content) // 2] ^= 1
            damaged.write_bytes(content)
            done = subprocess.run([os.environ["SWARD_C_HOST"], field, damaged],
                                  capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr, "")
            self.assertIn("tessellated: ", done.stdout)


if __name__ == "__main__":
    unittest.main()
