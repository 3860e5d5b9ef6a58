# SPDX-License-Identifier: MIT
"""Noise and small array helpers for the landscape. Pure numpy: the same seed gives the same numbers everywhere."""

import itertools

import numpy as np


def smoothstep(low, high, value):
    """0 at `low`, 1 at `high`, smooth between; `high` may be the smaller one."""
    t = np.clip((np.asarray(value, float) - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def mix(a, b, t):
    return a + (b - a) * t


def blend(colour, over, weight):
    """Paints one colour over another; colours have three components on the last axis, the weight has none."""
    colour, over = np.asarray(colour, float), np.asarray(over, float)
    return colour + (over - colour) * weight[..., None]


def smooth_max(a, b, k):
    """Polynomial maximum whose crease is rounded over a distance of about k."""
    h = np.maximum(k - np.abs(a - b), 0.0) / k
    return np.maximum(a, b) + h * h * k * 0.25


def smooth_min(a, b, k):
    return -smooth_max(-a, -b, k)


def hash_lattice(cells, seed, period=None):
    """One well-mixed 32-bit number for each integer lattice point; `cells` has its coordinates on the last axis."""
    h = np.full(cells.shape[:-1], (seed * 0x9E3779B1 + 0x7F4A7C15) & 0xFFFFFFFF, np.uint32)
    for axis in range(cells.shape[-1]):
        coordinate = cells[..., axis] if period is None else cells[..., axis] % np.broadcast_to(period, cells.shape[-1])[axis]
        h ^= coordinate.astype(np.int64).astype(np.uint32)
        h *= np.uint32(0x85EBCA6B)
        h ^= h >> np.uint32(13)
        h *= np.uint32(0xC2B2AE35)
        h ^= h >> np.uint32(16)
    return h


def unit(h, shift=0):
    """Uniform number in 0..1 from eleven bits of a hash."""
    return ((h >> np.uint32(shift)) & np.uint32(2047)).astype(float) / 2047.0


def gradient_noise(points, seed, period=None):
    """Perlin's gradient noise in 2 or 3 dimensions, about -1..1; with a `period` (one integer or one per axis) it tiles."""
    base = np.floor(points).astype(np.int64)
    local = points - base
    fade = local ** 3 * (local * (local * 6.0 - 15.0) + 10.0)
    total = np.zeros(points.shape[:-1])
    for corner in itertools.product((0, 1), repeat=points.shape[-1]):
        h = hash_lattice(base + corner, seed, period)
        dot, weight = 0.0, 1.0
        for axis, step in enumerate(corner):
            dot = dot + (unit(h, 10 * axis) * 2.0 - 1.0) * (local[..., axis] - step)
            weight = weight * (fade[..., axis] if step else 1.0 - fade[..., axis])
        total += dot * weight
    return total * 1.6


def fbm(points, seed, octaves=4, period=None, gain=0.5):
    """Sum of octaves of gradient noise, each twice as fine and `gain` times as strong; about -1..1."""
    total, amplitude, norm = 0.0, 1.0, 0.0
    for octave in range(octaves):
        scale = 2 ** octave
        total = total + amplitude * gradient_noise(points * scale, seed + 101 * octave,
                                                   None if period is None else np.multiply(period, scale))
        norm += amplitude
        amplitude *= gain
    return total / norm


def worley(points, seed, period=None):
    """Cellular noise in 2D: distance to the nearest and second nearest feature point, and the nearest one's hash."""
    base = np.floor(points).astype(np.int64)
    first = np.full(points.shape[:-1], 9.0)
    second = first.copy()
    owner = np.zeros(points.shape[:-1], np.uint32)
    for step in itertools.product((-1, 0, 1), repeat=2):
        cell = base + step
        h = hash_lattice(cell, seed, period)
        distance = np.hypot(cell[..., 0] + unit(h) - points[..., 0], cell[..., 1] + unit(h, 11) - points[..., 1])
        second = np.minimum(second, np.maximum(distance, first))
        owner = np.where(distance < first, h, owner)
        first = np.minimum(first, distance)
    return first, second, owner


def blur(image, passes):
    """Repeated 1-2-1 filter with clamped borders: a Gaussian of variance passes / 2 in pixels."""
    for _ in range(passes):
        for axis in (0, 1):
            padded = np.pad(image, [(1, 1) if a == axis else (0, 0) for a in range(image.ndim)], mode="edge")
            n = image.shape[axis]
            lower, middle, upper = (np.take(padded, np.arange(n) + k, axis) for k in range(3))
            image = 0.25 * lower + 0.5 * middle + 0.25 * upper
    return image


def bilinear(image, row, column):
    """Value of a raster at fractional rows and columns, clamped at the border."""
    row = np.clip(row, 0.0, image.shape[0] - 1.000001)
    column = np.clip(column, 0.0, image.shape[1] - 1.000001)
    i, j = row.astype(int), column.astype(int)
    u, v = row - i, column - j
    return ((1 - u) * (1 - v) * image[i, j] + u * (1 - v) * image[i + 1, j]
            + (1 - u) * v * image[i, j + 1] + u * v * image[i + 1, j + 1])
