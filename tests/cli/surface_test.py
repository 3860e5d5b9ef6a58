"""Roots lie on the surface, evenly, however large, small or far away its triangles are."""

import math
import unittest

from meshes import Mesh, bumps, cross, dot, glb_bytes, length, obj_text, subtract, unit
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


def coordinates(mesh, index, point):
    """Barycentric coordinates of the point's foot on a triangle, and its distance from the plane."""
    a, b, c = (mesh.positions[i] for i in mesh.triangles[index])
    normal = cross(subtract(b, a), subtract(c, a))
    square = dot(normal, normal)
    offset = subtract(point, a)
    v = dot(cross(offset, subtract(c, a)), normal) / square
    w = dot(cross(subtract(b, a), offset), normal) / square
    return (1.0 - v - w, v, w), abs(dot(offset, normal)) / math.sqrt(square)


def sub_triangle(barycentric):
    """Which of the sixteen congruent parts of a triangle holds the point."""
    rows = [min(3, max(0, int(4 * x))) for x in barycentric]
    # Inside a cell of the 4×4 grid the sum of the whole parts tells the upper from the lower part.
    return rows[0], rows[1], sum(int(4 * x) for x in barycentric) == 3


class Surface(CliTest):
    def assert_on_surface(self, mesh, blades, offset=(0, 0, 0)):
        """Every root within max(0.5 mm, extent of its patch / 65535) of the nearest triangle."""
        extents = {}
        for blade in blades:
            low, high = extents.setdefault(blade.patch, (list(blade.root), list(blade.root)))
            for k in range(3):
                low[k], high[k] = min(low[k], blade.root[k]), max(high[k], blade.root[k])
        for blade in blades:
            low, high = extents[blade.patch]
            bound = max(0.0005, max(h - l for l, h in zip(low, high)) / 65535)
            point = subtract(blade.root, offset)
            nearest = min(self.distance(mesh, i, point) for i in range(len(mesh.triangles)))
            self.assertLessEqual(nearest, bound, f"root {blade.root}")

    @staticmethod
    def distance(mesh, index, point):
        """Distance to a triangle for a point whose foot is on it; else far."""
        barycentric, height = coordinates(mesh, index, point)
        # A root at the very edge may be rounded a step beyond it.
        slack = 0.0015 / math.sqrt(mesh.area(index))
        return height if min(barycentric) >= -slack else math.inf

    def test_each_triangle_gets_the_share_of_its_area(self):
        mesh = scattered_triangles()
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh))
        count = 60000
        blades = self.blades(self.bake("m.glb", "--count", count))
        self.assertEqual(len(blades), count)
        counts = [0] * len(AREAS)
        for blade in blades:
            nearest = min(range(len(AREAS)), key=lambda i: self.distance(mesh, i, blade.root))
            counts[nearest] += 1
        expected = [count * area / sum(AREAS) for area in AREAS]
        chi_square = sum((n - e) ** 2 / e for n, e in zip(counts, expected))
        # 6 degrees of freedom: 22.5 has probability 0.001.
        self.assertLess(chi_square, 22.5, list(zip(counts, expected)))

    def test_roots_are_uniform_inside_a_triangle(self):
        mesh = Mesh([(0, 0, 0), (7, 1, 2), (-1, 3, 5)], [(0, 1, 2)])
        (self.folder / "m.glb").write_bytes(glb_bytes(mesh))
        blades = self.blades(self.bake("m.glb", "--count", "40000", "--sides", "both"))
        parts = {}
        for blade in blades:
            part = sub_triangle(coordinates(mesh, 0, blade.root)[0])
            parts[part] = parts.get(part, 0) + 1
        # Roots that rounding carried over an edge make parts of their own; they are few.
        counts = sorted(parts.values(), reverse=True)[:16]
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
        for blade in self.blades(self.bake("m.glb", "--count", "5000")):
            index = min(range(len(AREAS)), key=lambda i: self.distance(mesh, i, blade.root))
            a, b, c = (mesh.positions[i] for i in mesh.triangles[index])
            normal = unit(cross(subtract(b, a), subtract(c, a)))
            # The rounding of up to 16 bits.
            self.assertLess(length(subtract(blade.up, normal)), 0.02)


if __name__ == "__main__":
    unittest.main()
