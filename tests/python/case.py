"""What tests of the Python module share: it, the programs, and a folder that is thrown away."""

import os
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy
import sward

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/support"))
from needs import needs  # for the tests, which import it from here

PROGRAM = os.environ.get("SWARD_PROGRAM", str(ROOT / "build/release/bin/sward"))
VIEWER = os.environ.get("SWARD_VIEW_PROGRAM", str(ROOT / "build/release/bin/sward-view"))


def hills(side=33, extent=32.0):
    """(z, x) heights of a smooth ground [m], in single precision."""
    x, z = numpy.meshgrid(numpy.linspace(0, 6, side), numpy.linspace(0, 5, side))
    return (2.0 * numpy.sin(x) * numpy.cos(z) + 0.02 * extent * x).astype(numpy.float32)


def grid(side=9):
    """(vertices, triangles) of a bumpy square of 16 m, in single precision."""
    x, z = numpy.meshgrid(numpy.linspace(-8, 8, side), numpy.linspace(-8, 8, side))
    y = numpy.sin(x) + numpy.cos(z)
    vertices = numpy.stack([x, y, z], axis=-1).reshape(-1, 3).astype(numpy.float32)
    corner = (numpy.arange(side - 1)[:, None] * side + numpy.arange(side - 1)).reshape(-1, 1)
    triangles = numpy.concatenate([corner + [0, side, 1], corner + [1, side, side + 1]])
    return vertices, triangles


def write_ply(path, vertices, triangles, colors=None):
    """A binary .ply of single precision; colours are uint8."""
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
    header += "".join(f"property float {axis}\n" for axis in "xyz")
    fields = [("place", "<f4", 3)]
    if colors is not None:
        header += "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
        fields.append(("color", "u1", 3))
    header += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    rows = numpy.zeros(len(vertices), fields)
    rows["place"] = vertices
    if colors is not None:
        rows["color"] = colors
    faces = numpy.zeros(len(triangles), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, triangles
    Path(path).write_bytes(header.encode() + rows.tobytes() + faces.tobytes())


class PythonCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-python-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore", sward.Warning)

    def program(self, *arguments, code=0, program=PROGRAM):
        done = subprocess.run([program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, code, f"{' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
        return done

    def by_program(self, ground, *options):
        """Bytes of the field that `sward bake` writes."""
        path = self.folder / "program.sward"
        self.program("bake", ground, *options, "-o", path, "-q", "--force")
        return path.read_bytes()

    def bytes_of(self, field):
        """Bytes of the file that a field is saved as."""
        path = self.folder / "python.sward"
        field.save(path, force=True)
        return path.read_bytes()


if __name__ == "__main__":
    sys.exit("no tests here")
