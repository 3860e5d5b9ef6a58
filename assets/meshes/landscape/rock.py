# SPDX-License-Identifier: MIT
"""Cliff, arch and boulder: signed distances (negative inside), polygonised by surface nets so that they really overhang."""

import itertools

import numpy as np

from .ground import HALF, behind_cliff, shelter
from .noise import blend, fbm, gradient_noise, hash_lattice, smooth_max, smooth_min, smoothstep, unit, worley

CELL = 0.195                                             # edge of a polygonisation cell in metres
LOW, HIGH = np.array((-6.0, -1.6, -20.0)), np.array((17.0, 11.0, 15.5))


def facets(u, v, seed):
    """A wall broken into Voronoi blocks whose flat faces are set back and tilted, each in its own way; about -0.5..0.5."""
    p = np.stack([u, v], -1)
    base = np.floor(p).astype(np.int64)
    nearest, face = np.full(len(p), 9.0), np.zeros(len(p))
    for step in itertools.product((-1, 0, 1), repeat=2):
        h = hash_lattice(base + step, seed)
        du, dv = p[:, 0] - base[:, 0] - step[0] - unit(h), p[:, 1] - base[:, 1] - step[1] - unit(h, 11)
        distance = np.hypot(du, dv)
        h = hash_lattice(base + step, seed + 500)
        plane = 0.5 * (unit(h) - 0.5) + du * (unit(h, 11) - 0.5) + dv * (unit(h, 21) - 0.75)
        face = np.where(distance < nearest, plane, face)
        nearest = np.minimum(nearest, distance)
    return face


def relief(p, along, seed):
    """How far weather has left a wall standing out, in metres: dipping beds, broken into blocks. It depends on the place on
    the wall and hardly on the depth behind it, so that the rock steps back in ledges and never turns into sponge."""
    dip = p[:, 1] + 0.06 * p[:, 0] - 0.05 * p[:, 2] + 0.30 * gradient_noise(p * 0.20, 70)
    bed = dip * 1.1
    bed = bed + 0.30 * np.sin(bed * 1.9)                  # beds of uneven thickness
    hard = unit(hash_lattice(np.floor(bed)[:, None], 71))
    shelf = bed - np.floor(bed)                           # each bed's face slopes back a little towards its top
    seam = smoothstep(0.14, 0.0, np.abs(bed - np.round(bed)))
    blocks = 0.50 * (hard - 0.5) - 0.16 * (shelf - 0.5) - 0.12 * seam
    blocks += 0.62 * facets(along * 0.55, dip * 0.75, seed) + 0.34 * facets(along * 1.4, dip * 1.8, seed + 1)
    return blocks + lumps(p)


def lumps(p):
    return 0.22 * fbm(p * 0.35, 74, 2) + 0.05 * fbm(p * 1.9, 75, 2)


def cliff_distance(p, wall=0.0, top=0.0):
    """The wall under the plateau's rim: undercut at its foot, leaning out towards its top, hollowed in one place.
    `wall` and `top` say how far weather has left them standing out."""
    x, y, z = p.T
    behind, height = behind_cliff(x, z)
    lean = 0.7 + 0.5 * gradient_noise(np.stack([z * 0.16, z * 0.0 + 2.2], -1), 76)
    up = (y - 0.3) / height
    front = 0.45 + lean * (0.75 * smoothstep(0.95, 1.15, up) - 1.25 * smoothstep(0.12, 0.8, up))
    hollow = shelter(z) * 2.3 * smoothstep(3.7, 2.3, y) * smoothstep(-1.5, -0.4, y)
    rim = height + 0.42 + 0.4 * fbm(p[:, [0, 2]] * 0.35, 77, 2) - 2.0 * smoothstep(1.6, 3.6, behind - 1.6 * shelter(z))
    rim = rim - 1.6 * smoothstep(9.5, 14.5, z)            # in the south the wall sinks into an open slope
    return smooth_max(front + hollow - behind - wall, y - rim - top, 0.4)


def arch_distance(p, wall=0.0, roof=0.0):
    """A fin of rock that runs from the cliff across the path, with a hole worn through it."""
    x, y, z = p.T
    across = z + 4.35 - 0.10 * (x - 2.5) - 0.35 * np.sin(x * 0.55)
    thickness = 1.15 + 0.35 * smoothstep(2.5, -2.5, x) + 0.30 * smoothstep(4.0, 8.0, x) - 0.25 * smoothstep(2.5, 6.0, y)
    top = roof + 6.45 + 0.10 * (x - 2.0) - 0.16 * np.maximum(0.4 - x, 0.0) ** 2 - 0.9 * smoothstep(-1.6, -2.9, x)
    west = -3.9 + 0.30 * np.maximum(y, 0.0) - x
    fin = smooth_max(smooth_max(np.abs(across) - thickness - wall, y - top, 0.6), west - wall, 0.7)
    fin = smooth_max(fin, x - 10.5, 0.5)                  # it ends inside the cliff
    u, v = (x - 2.55 - 0.10 * y) / 2.95, (y - 0.2) / 4.55  # the hole leans a little towards the cliff
    hole = ((np.abs(u) ** 2.4 + np.maximum(v, 0.0) ** 2.4 + 1e-9) ** (1 / 2.4) - 1.0) * 2.9
    return smooth_max(fin, -(hole - 0.28 * np.abs(across) ** 1.5 + 0.2 + roof + 0.3 * wall), 0.35)


def rock_distance(p):
    """Cliff and arch together with their weathering; far from the surface the weathering is left out."""
    parts = []
    for distance, along, seed in ((cliff_distance, p[:, 2], 72), (arch_distance, p[:, 0] + 0.2 * p[:, 2], 77)):
        part = distance(p)
        near = np.abs(part) < 1.4
        part[near] = distance(p[near], relief(p[near], along[near], seed), lumps(p[near]))
        parts.append(part)
    return smooth_min(*parts, 0.5)


def boulder_distance(p):
    """A block split along a handful of planes and rounded by frost, about two metres across."""
    random = np.random.RandomState(5)
    normals = random.normal(size=(13, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    result = np.linalg.norm(p, axis=1) - 1.15
    for normal, distance in zip(normals, random.uniform(0.62, 0.95, 13)):
        result = smooth_max(result, p @ normal - distance, 0.07)
    return result - 0.09 * fbm(p * 1.1, 80, 3) - 0.03 * fbm(p * 4.0, 81, 2)


def surface_nets(distance, low, high, cell):
    """Quads of the zero surface as triangles: one vertex per cell that the surface crosses, one quad per crossed edge."""
    counts = np.ceil((high - low) / cell).astype(int) + 1
    axes = [low[k] + cell * np.arange(counts[k]) for k in range(3)]
    field = distance(np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)).reshape(counts)
    cells = counts - 1
    total, hits = np.zeros((*cells, 3)), np.zeros(cells)
    edges = []
    for axis in range(3):
        a, b = (np.take(field, np.arange(counts[axis] - 1) + k, axis) for k in (0, 1))
        where = np.argwhere((a < 0) != (b < 0))
        fa, fb = a[tuple(where.T)], b[tuple(where.T)]
        point = where.astype(float)
        point[:, axis] += fa / (fa - fb)
        v, w = (axis + 1) % 3, (axis + 2) % 3
        ring = []
        for dv, dw in ((0, 0), (-1, 0), (-1, -1), (0, -1)):   # the four cells around the edge, in order
            cell_index = where.copy()
            cell_index[:, v] += dv
            cell_index[:, w] += dw
            ring.append(cell_index)
            valid = ((cell_index >= 0) & (cell_index < cells)).all(1)
            np.add.at(total, tuple(cell_index[valid].T), point[valid])
            np.add.at(hits, tuple(cell_index[valid].T), 1)
        edges.append((np.stack(ring, 1), fa < 0))
    used = hits > 0
    number = np.full(cells, -1)
    number[used] = np.arange(used.sum())
    vertices = low + cell * total[used] / hits[used][:, None]
    faces = []
    for ring, leaves in edges:
        keep = ((ring >= 0) & (ring < cells)).all((1, 2))
        ring, leaves = ring[keep], leaves[keep]
        quad = number[tuple(np.moveaxis(ring, -1, 0))]
        quad = np.where(leaves[:, None], quad, quad[:, ::-1])
        corner = vertices[quad]
        short = np.linalg.norm(corner[:, 0] - corner[:, 2], axis=1) <= np.linalg.norm(corner[:, 1] - corner[:, 3], axis=1)
        faces.append(np.where(short[:, None], quad[:, [0, 1, 2]], quad[:, [0, 1, 3]]))
        faces.append(np.where(short[:, None], quad[:, [0, 2, 3]], quad[:, [1, 2, 3]]))
    return vertices, np.vstack(faces)


def largest_component(vertices, faces):
    """Drops crumbs that the weathering has cut loose."""
    label = np.arange(len(vertices))
    while True:
        lowest = label[faces].min(1)
        following = label.copy()
        for k in range(3):
            np.minimum.at(following, faces[:, k], lowest)
        following = following[following]
        if np.array_equal(following, label):
            break
        label = following
    names, sizes = np.unique(label, return_counts=True)
    return faces[label[faces[:, 0]] == names[np.argmax(sizes)]]


def face_normals(vertices, faces):
    """Unit normals, and twice the areas as a column."""
    corner = vertices[faces]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    return normal / np.maximum(length, 1e-12), length


def corner_normals(vertices, faces, crease=180.0):
    """Area-weighted normals for each corner of each face, averaged over the faces around its vertex that lie within
    `crease` degrees of it. Computed before a surface is cut into nodes, so that both sides of a cut agree to the bit."""
    normal, area = face_normals(vertices, faces)
    corners = np.argsort(faces.ravel(), kind="stable")                # grouped by vertex
    vertex = faces.ravel()[corners]
    first = np.searchsorted(vertex, vertex)                           # where each corner's group begins
    size = np.bincount(vertex, minlength=len(vertices))[vertex]
    mine, total = normal[corners // 3], np.zeros((len(corners), 3))
    for k in range(size.max()):
        inside = k < size
        other = corners[np.where(inside, first + k, 0)] // 3
        agree = inside & ((mine * normal[other]).sum(1) >= np.cos(np.radians(crease)) - 1e-9)
        total += np.where(agree[:, None], normal[other] * area[other], 0.0)
    result = np.empty_like(total)
    result[corners] = total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-12)
    return result.reshape(-1, 3, 3)


def chisel(vertices, faces, reach, rounds=3, threshold=0.35):
    """Makes soft lumps break along planes: normals are averaged among neighbours that already agree (Sun et al. 2007,
    `Fast and effective feature-preserving mesh denoising`), then the vertices are moved
    to fit them, no farther than `reach`."""
    edge = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    key = edge[:, 0].astype(np.int64) * len(vertices) + edge[:, 1]
    order = np.argsort(key, kind="stable")
    same = key[order][1:] == key[order][:-1]
    owner = np.tile(np.arange(len(faces)), 3)[order]
    left, right = owner[:-1][same], owner[1:][same]
    start = vertices
    for _ in range(rounds):
        normal, area = face_normals(vertices, faces)
        for _ in range(4):
            agreement = np.maximum((normal[left] * normal[right]).sum(1) - threshold, 0.0)[:, None] ** 2
            total = normal * area * (1.0 - threshold) ** 2
            np.add.at(total, left, agreement * area[right] * normal[right])
            np.add.at(total, right, agreement * area[left] * normal[left])
            normal = total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-12)
        middle = vertices[faces].mean(1)
        move, count = np.zeros_like(vertices), np.zeros((len(vertices), 1))
        for k in range(3):
            offset = ((middle - vertices[faces[:, k]]) * normal).sum(1, keepdims=True)
            np.add.at(move, faces[:, k], normal * offset)
            np.add.at(count, faces[:, k], 1.0)
        vertices = np.clip(vertices + move / np.maximum(count, 1.0), start - reach, start + reach)
    return vertices


def cliff_and_arch(ground):
    """Vertices, faces, and for each face whether it belongs to the arch; rock buried under the ground is left out."""
    vertices, faces = surface_nets(rock_distance, LOW, HIGH, CELL)
    faces = largest_component(vertices, faces)
    vertices = np.clip(chisel(vertices, faces, 0.4 * CELL), -HALF, HALF)
    buried = vertices[:, 1] < ground.at(ground.height, vertices[:, 0], vertices[:, 2]) - 0.22
    faces = faces[~buried[faces].all(1)]
    middle = vertices[faces].mean(1)
    return vertices, faces, arch_distance(middle) < cliff_distance(middle)


def rock_mask(vertices, normals):
    """COLOR_0 of rock: grass in tufts on its ledges and flat tops only; moisture where it faces down or lies deep."""
    tufts = smoothstep(-0.05, 0.35, fbm(vertices * 0.8, 82, 3))
    density = smoothstep(0.72, 0.92, normals[:, 1]) * tufts * 0.8
    moisture = np.maximum(smoothstep(-0.2, -0.8, normals[:, 1]), smoothstep(1.2, 0.0, vertices[:, 1])) * 0.8
    return np.stack([density, moisture, 0.5 * tufts, np.ones_like(density)], -1)


def box_uv(vertices, faces, metres):
    """Per-corner texture coordinates projected along each face's dominant axis; v runs up on walls.

    The axis is chosen from widely smoothed normals: few seams, hence few vertices that must be written twice.
    """
    normal = face_normals(vertices, faces)[0]
    for _ in range(14):
        total = np.zeros_like(vertices)
        for k in range(3):
            np.add.at(total, faces[:, k], normal)
        normal = total[faces].sum(1)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-12
    axis = np.argmax(np.abs(normal) * (1.0, 1.15, 1.0), axis=1)
    corner = vertices[faces]
    pick = np.array([(2, 1), (0, 2), (0, 1)])[axis]
    return np.take_along_axis(corner, pick[:, None, :].repeat(3, 1), 2) / metres


def rock_albedo(size):
    """Tileable weathered limestone, sRGB 0..1: faint beds, grain, pits, broken cracks, lichen."""
    axis = (np.arange(size) + 0.5) / size
    p = np.stack(np.meshgrid(axis, axis), -1)
    warp = np.stack([fbm(p * 4, 90, 3, 4), fbm(p * 4, 91, 3, 4)], -1) * 0.05
    broad, fine = fbm((p + warp) * 3, 92, 5, 3), fbm((p + warp) * 28, 93, 4, 28, gain=0.75)
    beds = np.sin(2 * np.pi * (9 * p[..., 1] + 0.9 * broad + 14 * warp[..., 0]))
    colour = blend((.560, .525, .460), (.370, .350, .320), smoothstep(-0.4, 0.45, broad + 0.35 * fine + 0.12 * beds))
    colour = blend(colour, (.600, .530, .405), 0.6 * smoothstep(0.05, 0.45, fbm((p + warp) * 5, 95, 4, 5) + 0.2 * fine))
    near, gap, _ = worley((p + warp * 1.6) * 7, 96, 7)
    cracks = smoothstep(0.030, 0.0, gap - near) * smoothstep(0.05, 0.30, fbm(p * 8, 97, 3, 8))
    colour = blend(colour, (.190, .175, .155), 0.6 * cracks)
    streaks = fbm((p + 0.6 * warp) * (22, 4), 87, 3, (22, 4))
    colour = blend(colour, (.250, .235, .210), 0.5 * smoothstep(0.05, 0.5, streaks + 0.15 * fine))
    grain = gradient_noise(p * 300, 88, 300)
    lichen = smoothstep(0.24, 0.36, fbm((p + warp) * 9, 98, 4, 9) + 0.3 * fine)
    colour = blend(colour, (.600, .610, .500), 0.55 * lichen)
    colour = blend(colour, (.270, .290, .165), 0.55 * smoothstep(0.18, 0.5, fbm((p - warp) * 4, 99, 4, 4) + 0.25 * fine))
    return np.clip(colour * (1.0 + 0.34 * fine + 0.12 * broad + 0.16 * grain)[..., None], 0.02, 0.98)
