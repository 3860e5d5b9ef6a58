"""Runs `sward` as a user would: in a folder of its own, by its command line, looking at what is left."""

import csv
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Folder of needs.py.
sys.path.append(str(ROOT / "tests/support"))
PROGRAM = Path(os.environ.get("SWARD_PROGRAM", ROOT / "build/release/bin/sward")).resolve()

# The contract's exit codes.
DONE, USAGE, IO, INPUT, RUNTIME, UNSUPPORTED, DIFFERENCE, INTERRUPTED = 0, 1, 2, 3, 4, 5, 7, 130


class Blade:
    """A row of the CSV export with numbers in place of texts."""

    def __init__(self, row):
        self.id = int(row["id"])
        self.root = (float(row["x"]), float(row["y"]), float(row["z"]))
        self.up = (float(row["ux"]), float(row["uy"]), float(row["uz"]))
        self.height = float(row["height"])
        self.patch = int(row["patch"])
        self.row = row


class CliTest(unittest.TestCase):
    """A test with a folder that is thrown away, and words for what a user does there."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-cli-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def sward(self, *arguments, code=DONE, folder=None, environment=None, before=None):
        """Runs the program and demands its exit code; returns the finished process."""
        done = subprocess.run([str(PROGRAM), *map(str, arguments)], cwd=folder or self.folder,
                              env={**os.environ, **(environment or {})}, preexec_fn=before,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="surrogateescape")
        self.assertEqual(done.returncode, code,
                         f"sward {' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
        return done

    def bake(self, ground, *options, to="field.sward", **how):
        """Bakes quietly and returns the field's path."""
        self.sward("bake", ground, "-o", to, "-q", *options, **how)
        return (how.get("folder") or self.folder) / to

    def refused(self, *arguments, code, names, leaves=()):
        """Runs what must fail: with `code`, a message on stderr that has every text of `names`,
        nothing on stdout, and no file in the folder beside `leaves` and those that were there."""
        before = self.files()
        done = self.sward(*arguments, code=code)
        self.assertEqual(done.stdout, "")
        for name in names:
            self.assertIn(str(name), done.stderr)
        self.assertEqual(self.files(), before | set(leaves))
        return done

    def files(self):
        """Names of all that lies in the folder, hidden and temporary files too."""
        return {path.relative_to(self.folder).as_posix() for path in self.folder.rglob("*")}

    def blades(self, field):
        """The field's blades, by way of the CSV export."""
        rows = field.with_suffix(".csv")
        self.sward("export", field, "-o", rows, "--force")
        with open(rows, encoding="ascii", newline="") as file:
            return [Blade(row) for row in csv.DictReader(file)]

    def info(self, field):
        return json.loads(self.sward("info", field, "--json").stdout)

    def report(self, ground, *options, to="field.sward", dry=False):
        """Bakes, or estimates, and returns the report."""
        target = ["--dry-run"] if dry else ["-o", to, "--force"]
        self.sward("bake", ground, *target, "--report", "report.json", "--force", "-q", *options)
        return self.read_json("report.json")

    def read_json(self, name):
        return json.loads((self.folder / name).read_text(encoding="utf-8"))

    def write_json(self, name, value):
        path = self.folder / name
        path.write_text(json.dumps(value), encoding="utf-8")
        return path


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()
