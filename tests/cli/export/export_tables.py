"""What the tests of the exports share: a field as columns, and the geometry of a blade written anew."""

import json

import numpy

from meshes import bumps, glb_bytes
from support import CliTest, ROOT

SPECIES = json.loads((ROOT / "assets/meadows/meadow.json").read_text(encoding="utf-8"))["species"]

# A float of up to 64 m, the size of a group, rounds by half of this [m]; the CSV by 1e-9.
PLACE_ERROR = 4e-6


def front(up, facing):
    """Where a blade looks: by the basis of Duff et al., JCGT 2017, about its up-vector."""
    x, y, z = up.T
    s = numpy.where(z >= 0.0, 1.0, -1.0)
    a = -1.0 / (s + z)
    tangent = numpy.stack([1.0 + s * x * x * a, s * x * y * a, -s * x], axis=1)
    bitangent = numpy.stack([x * y * a, s + y * y * a, -y], axis=1)
    axis = tangent * numpy.cos(facing)[:, None] + bitangent * numpy.sin(facing)[:, None]
    return numpy.cross(up, axis)


def turned(quaternions, vector):
    """`vector` turned by unit quaternions x y z w."""
    u, w = quaternions[:, :3], quaternions[:, 3:]
    v = numpy.broadcast_to(numpy.array(vector, float), u.shape)
    return v + 2.0 * numpy.cross(u, numpy.cross(u, v) + w * v)


def linear(x):
    return numpy.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


class ExportTest(CliTest):
    def export(self, field, name, *options):
        self.sward("export", field, "-o", name, "--force", *options)
        return self.folder / name

    def table(self, field):
        """The CSV as columns, by id."""
        path = self.export(field, "table.csv")
        names = path.read_text(encoding="ascii").split("\n", 1)[0].split(",")
        rows = numpy.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
        rows = rows[numpy.argsort(rows[:, 0])]
        self.assertEqual(len(numpy.unique(rows[:, 0])), len(rows))
        return {name: rows[:, i] for i, name in enumerate(names)}

    @staticmethod
    def columns(table, *names):
        return numpy.stack([table[name] for name in names], axis=1)

    @staticmethod
    def scales(table):
        """Of the default meadow's instances: a compound plant is scaled by its height alone."""
        plants = [slot for slot, species in enumerate(SPECIES) if "organs" in species]
        across = numpy.where(numpy.isin(table["species"], plants), table["height"], table["width"])
        return numpy.stack([across, table["height"], table["height"]], axis=1)

    def assert_near(self, values, expected, error):
        self.assertEqual(values.shape, expected.shape)
        if len(values):
            self.assertLessEqual(float(numpy.abs(values - expected).max()), error)

    def far_field(self, *options):
        """Hills a thousand kilometres away."""
        (self.folder / "far.glb").write_bytes(
            glb_bytes(bumps(), node={"translation": [1e6 + 7.25, 250.5, -1e6 - 3.5]}))
        return self.bake("far.glb", "--count", "5000", *options, to="far.sward")
