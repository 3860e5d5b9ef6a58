"""Shapes that the files of the corpus hold."""

import numpy as np


def turned(chance):
    """A random rotation as quaternion x, y, z, w."""
    q = np.array([chance.gauss(0, 1) for _ in range(4)])
    return q / np.linalg.norm(q)


def rotate(quaternion, points):
    v, w = np.asarray(quaternion[:3]), quaternion[3]
    return points + 2 * np.cross(v, np.cross(v, points) + w * points)


def polygon(chance, corners):
    """A plane star around its centre: concave as a rule, never crossed."""
    angles = (np.arange(corners) + np.array([chance.uniform(0.1, 0.9) for _ in range(corners)])) * 2 * np.pi / corners
    radii = np.array([chance.uniform(0.35, 1.0) for _ in range(corners)])
    flat = np.column_stack([radii * np.cos(angles), radii * np.sin(angles), np.zeros(corners)])
    return rotate(turned(chance), flat)


def polygons(chance, most=11):
    """Polygons far from one another, each with a colour in [0, 1]: a list of corners and colour."""
    found = []
    for i in range(chance.randint(3, 9)):
        place = np.array([4.0 * i, chance.uniform(-2, 2), chance.uniform(-2, 2)])
        corners = np.round(polygon(chance, chance.randint(3, most)) * chance.uniform(0.5, 1.8) + place, 6)
        found.append((corners, [chance.uniform(0.05, 1.0) for _ in range(3)]))
    return found


def grid(chance, columns, rows):
    """Points of a bumpy field, row by row, (rows × columns)×3."""
    x, z = np.meshgrid(np.linspace(0, columns - 1, columns), np.linspace(0, rows - 1, rows))
    y = np.array([chance.uniform(-0.4, 0.4) for _ in range(columns * rows)])
    return np.column_stack([x.ravel(), y, z.ravel()]) * chance.uniform(0.5, 2.0)


def grid_triangles(columns, rows):
    return [t for j in range(rows - 1) for i in range(columns - 1)
            for a in [j * columns + i] for t in ((a, a + columns, a + 1), (a + 1, a + columns, a + columns + 1))]
