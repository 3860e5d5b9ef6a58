"""Two readers that share no line agree on every file: Sward, and NumPy (numpy_ground.py). The files come from seeds
and hold what formats allow: corpus_files.py."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import corpus_files
import numpy_ground

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = os.environ.get("SWARD_GROUND_FIGURES", ROOT / "build/release/bin/ground_figures")
FIRST = int(os.environ.get("SWARD_CORPUS_FIRST", 0))  # seed of the first file

# Relative, of areas: Sward keeps positions in single precision, within 2 km of the file's origin.
AREA_ERROR = 2e-4
COLOR_ERROR = 1e-3
# Of the mean tint of 600 blades: half of a step of 5 bits, and four times the error of a mean of numbers in [0, 1].
TINT_ERROR = 1 / 62 + 4 * 0.5 / 600 ** 0.5


class CorpusTest(unittest.TestCase):
    def require_agreement(self, numbers):
        """On triangles, area and tint of the files of these numbers."""
        with tempfile.TemporaryDirectory(prefix="sward-corpus-") as name:
            folder = Path(name)
            files = [corpus_files.write(folder, number) for number in numbers]
            lines = ["\t".join([str(folder / file)] + [f"{k}={','.join(map(str, v)) if isinstance(v, tuple) else v}"
                                                       for k, v in options.items()]) for file, options in files]
            done = subprocess.run([PROGRAM], input="\n".join(lines) + "\n", capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr[-2000:])
            told = [json.loads(line) for line in done.stdout.splitlines()]
            self.assertEqual(len(told), len(files))
            wrong = []
            for (file, options), sward in zip(files, told):
                own = numpy_ground.figures(folder / file, **options)
                if reason := self.difference(own, sward):
                    wrong.append(f"{file} {options}: {reason}")
            if wrong and os.environ.get("SWARD_KEEP_CORPUS"):
                subprocess.run(["cp", "-r", name, os.environ["SWARD_KEEP_CORPUS"]])
            self.assertFalse(wrong, f"{len(wrong)} of {len(files)}; SWARD_KEEP_CORPUS=FOLDER keeps the files\n" + "\n".join(wrong[:40]))
            # A corpus that is bare of colours or kinds shows nothing.
            self.assertGreater(len({Path(file).suffix for file, _ in files}), 11)
            self.assertGreater(len({tuple(np.round(t["color"], 2)) for t in told}), len(files) // 3)

    def difference(self, own, sward):
        if "error" in sward:
            return sward["error"]
        if own["triangles"] != sward["triangles"]:
            return f"{own['triangles']} triangles, not {sward['triangles']}"
        if abs(own["area"] - sward["area"]) > AREA_ERROR * own["area"]:
            return f"{own['area']} m2, not {sward['area']}"
        if np.abs(own["color"] - sward["color"]).max() > COLOR_ERROR:
            return f"colour {own['color']}, not {sward['color']}"
        if np.abs(own["tint"] - sward["tint"]).max() > TINT_ERROR:
            return f"tint {own['tint']}, not {sward['tint']}"
        return None


class Corpus(CorpusTest):
    def test_both_readers_agree_on_sixty_files_of_all_kinds(self):
        # From here on each of the twelve endings occurs.
        self.require_agreement(range(FIRST + 371, FIRST + 431))


class LongCorpus(CorpusTest):
    """Forty seconds. After changes of the readers, and before each release."""

    def test_both_readers_agree_on_five_hundred_files(self):
        self.require_agreement(range(FIRST, FIRST + 500))


if __name__ == "__main__":
    unittest.main()
