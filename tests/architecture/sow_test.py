"""The shared text of sown blades is GLSL, too: no shader of the project includes it yet, so it is compiled here."""

import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

SHADER = """#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "{header}"
layout(local_size_x = 1) in;
void main() {{}}
"""


class Sow(unittest.TestCase):
    def test_every_header_compiles_as_a_shader(self):
        headers = sorted((ROOT / "shaders/shared/sow").glob("*.h"))
        self.assertGreater(len(headers), 4)
        with tempfile.TemporaryDirectory() as folder:
            for header in headers:
                shader = Path(folder) / "one.comp"
                shader.write_text(SHADER.format(header=header.relative_to(ROOT)))
                done = subprocess.run(["glslangValidator", "-V", "--target-env", "vulkan1.3", f"-I{ROOT}", str(shader),
                                       "-o", str(Path(folder) / "one.spv")], capture_output=True, text=True)
                with self.subTest(header=header.name):
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_floats_are_neither_divided_nor_rooted_but_in_exact_functions(self):
        # Vulkan rounds + - * correctly, and nothing else.
        for header in sorted((ROOT / "shaders/shared/sow").glob("*.h")):
            if header.name == "exact.h":
                continue
            text = "\n".join(line.split("//")[0] for line in header.read_text(encoding="utf-8").splitlines()
                             if not line.lstrip().startswith("#"))
            for word in ("normalize(", "sqrt(", "dot(", "length(", "mix(", "fma(", "inversesqrt(", "cos(", "sin(",
                         "cross("):
                found = [i for i in range(len(text)) if text.startswith(word, i) and not text[i - 1].isalnum()]
                with self.subTest(header=header.name, word=word):
                    self.assertEqual(found, [])
            divisions = [line.strip() for line in text.splitlines() if "/" in line and "/ 255u" not in line]
            with self.subTest(header=header.name):
                self.assertEqual(divisions, [])


if __name__ == "__main__":
    unittest.main()
