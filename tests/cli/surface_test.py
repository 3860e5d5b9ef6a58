"""Roots lie on the surface, evenly, however large, small or far away its triangles are."""

import math
import unittest

import numpy

from meshes import Mesh, bumps, cross, glb_bytes, length, obj_text, subtract, unit
from support import CliTest

# Areas of the test's triangles [m²], 1000:1.
AREAS = (1000.0, 400.0, 100.0, 30.0, 10.0, 3.0, 1.0)
SPACING = 100.0


def scattered_triangles():
    """One tilted triangle of each area, standing apart along x: a root's x tells its triangle."""
    points, triangles = [], []
    for i, area in enumerate(AREAS):
        leg = math.sqrt(2.0 * area)
        # Two perpendicular directions, turned differently for each.
        u = unit((math.cos(i), 0.3 * math.sin(2 * i), math.sin(i)))
        v = unit(cross(u, unit((0.2 * math.cos(3 * i), -1.0, 0.4))))
        first = len(points)
        points += [(i * SPACING, 0, 0), tuple(i * SPACING * (k == 0) + leg * u[k] for k in range(3)),
                   tuple(i * SPACING * (k == 0) + leg * v[k] for k in range(3))]
        triangles.append((first, first + 1, first + 2))
    return Mesh(points, triangles)


def coordinates(mesh, index, points):
    """Barycentric coordinates of the points' feet on a triangle, a row for each, and the distances from its plane."""
    a, b, c = (numpy.array(mesh.positions[i]) for i in mesh.triangles[index])
    normal = numpy.cross(b - a, c - a)
    square = normal @ normal
    offsets = numpy.asarray(points) - a
    v = numpy.cross(offsets, c - a) @ normal / square
    w = numpy.cross(b - a, offsets) @ normal / square
    return numpy.stack([1.0 - v - w, v, w], axis=1), abs(offsets @ normal) / math.sqrt(square)


def distances(mesh, points):
    """From each point to each triangle, if its foot is on that; else far."""
    found = []
    for index in range(len(mesh.triangles)):
        barycentric, heights = coordinates(mesh, index, points)
        # A root at the very edge may be rounded a step beyond it.
        slack = 0.0015 / math.sqrt(mesh.area(index))
        found.append(numpy.where(barycentric.min(axis=1) >= -slack, heights, math.inf))
    return numpy.stack(found, axis=1)


def sub_triangles(barycentric):
    """Which of the sixteen congruent parts of a triangle holds each point."""
    rows = numpy.clip((4 * barycentric).astype(int), 0, 3)
    # Inside a cell of the 4×4 grid the sum of the whole parts tells the upper from the lower part.
    upper = (4 * barycentric).astype(int).sum(axis=1) == 3
    return (rows[:, 0] * 4 + rows[:, 1]) * 2 + upper


class Surface(CliTest):
    def assert_on_surface(self, mesh, blades, offset=(0, 0, 0)):
        """Every root within max(0.5 mm, extent of its patch / 65535) of the nearest triangle."""
        roots = numpy.array([blade.root for blade in blades])
        patches = numpy.array([blade.patch for blade in blades])
        bounds = numpy.zeros(len(roots))
        for patch in numpy.unique(patches):
            bounds[patches == patch] = max(0.0005, numpy.ptp(roots[patches == patch], axis=0).max() / 65535)
        nearest = distances(mesh, roots - offset).min(axis=1)
        self.assertGreater(len(roots), 0)
        worst = numpy.argmax(nearest - bounds)
        self.assertLessEqual(nearest[worst], bounds[worst], f"root {roots[worst]}")

    def test_each_triangle_gets_the_share_of_its_area(self):
        mesh = scattered_triangles()
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh))
        count = 60000
        blades = self.blades(self.bake("m.glb", "--count", count))
        self.assertEqual(len(blades), count)
        nearest = distances(mesh, [blade.root for blade in blades]).argmin(axis=1)
        counts = numpy.bincount(nearest, minlength=len(AREAS))
        expected = [count * area / sum(AREAS) for area in AREAS]
        chi_square = sum((n - e) ** 2 / e for n, e in zip(counts, expected))
        # 6 degrees of freedom: 22.5 has probability 0.001.
        self.assertLess(chi_square, 22.5, list(zip(counts, expected)))

    def test_roots_are_uniform_inside_a_triangle(self):
        mesh = Mesh([(0, 0, 0), (7, 1, 2), (-1, 3, 5)], [(0, 1, 2)])
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh))
        blades = self.blades(self.bake("m.glb", "--count", "40000", "--sides", "both"))
        barycentric, _ = coordinates(mesh, 0, [blade.root for blade in blades])
        parts = numpy.bincount(sub_triangles(barycentric))
        # Roots that rounding carried over an edge make parts of their own; they are few.
        counts = sorted(parts, reverse=True)[:16]
        self.assertGreater(sum(counts), 39900)
        chi_square = sum((n - 2500) ** 2 / 2500 for n in counts)
        # 15 degrees of freedom: 37.7 has probability 0.001.
        self.assertLess(chi_square, 37.7, parts)

    def test_roots_lie_on_the_surface(self):
        mesh = scattered_triangles()
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh))
        self.assert_on_surface(mesh, self.blades(self.bake("m.glb", "--count", "10000")))

    def test_roots_lie_on_the_surface_a_thousand_kilometres_away(self):
        mesh = scattered_triangles()
        offset = (1e6, -2e5, 1e6)
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh, node={"translation": list(offset)}))
        blades = self.blades(self.bake("m.glb", "--count", "10000"))
        self.assert_on_surface(mesh, blades, offset)

    def test_a_far_obj_keeps_its_millimetres(self):
        mesh = bumps(6.0, 6)
        offset = (1e6, 0.0, 1e6)
        text = obj_text(mesh)
        far = [f"v {float(x) + offset[0]:.7f} {y} {float(z) + offset[2]:.7f}" for x, y, z in
               (line.split()[1:] for line in text.splitlines() if line.startswith("v"))]
        (self.folder / "far.obj").write_text(
            "\n".join(far + [line for line in text.splitlines() if line.startswith("f")]) + "\n")
        self.assert_on_surface(mesh, self.blades(self.bake("far.obj", "--count", "3000")), offset)

    def test_blades_stand_on_the_surface_s_own_normal(self):
        mesh = scattered_triangles()
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh))
        blades = self.blades(self.bake("m.glb", "--count", "5000"))
        nearest = distances(mesh, [blade.root for blade in blades]).argmin(axis=1)
        for blade, index in zip(blades, nearest):
            a, b, c = (mesh.positions[i] for i in mesh.triangles[index])
            normal = unit(cross(subtract(b, a), subtract(c, a)))
            # The rounding of up to 16 bits.
            self.assertLess(length(subtract(blade.up, normal)), 0.02)


if __name__ == "__main__":
    unittest.main()
