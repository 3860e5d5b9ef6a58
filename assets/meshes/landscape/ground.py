# SPDX-License-Identifier: MIT
"""The meadow's heightfield: shape, erosion, footpath, brook, and the mask and albedo that are painted on it.

Coordinates are glTF's: x east, y up, z south, in metres. Rasters are indexed [z, x] at STEP metres.
"""

import numpy as np

from .noise import bilinear, blend, blur, fbm, gradient_noise, mix, smoothstep, unit, worley

HALF = 20.0                      # the ground spans -HALF..HALF on x and z
STEP = 2 * HALF / 384            # raster spacing; the mesh takes every second sample
WATER_LEVEL = -0.62
N = int(round(2 * HALF / STEP)) + 1

PATH = [(-4.6, 22), (-3.2, 17.5), (0.4, 13.2), (2.3, 9.0), (0.6, 4.6), (-0.5, 1.4), (1.4, -2.0), (2.4, -5.0),
        (2.0, -9.0), (-0.2, -13.0), (0.6, -17.0), (2.4, -22)]
# x, z, half width: a brook from the north-west that widens into a pond and leaves in the south-west
BROOK = [(-9.5, -22, .55), (-9.8, -17, .6), (-7.8, -12, .65), (-9.2, -7, .7), (-7.6, -2.5, .9), (-8.2, 1.8, 2.5),
         (-8.6, 4.2, 2.7), (-10.8, 8.0, 1.2), (-11.0, 12.0, .8), (-13.8, 16.0, .7), (-15.0, 22, .7)]
# z, x of the cliff's foot, height of the plateau above the meadow
CLIFF = np.array([(22, 16.5, .8), (15, 14.6, 1.4), (11, 12.6, 2.8), (7, 11.2, 4.6), (3, 10.4, 6.1), (-1, 8.2, 7.2),
                  (-4.5, 7.2, 7.7), (-8, 8.4, 7.3), (-12, 9.6, 6.2), (-16, 8.6, 5.2), (-22, 8.8, 4.2)])


def catmull_rom(points, per_span=60):
    """Dense samples of the smooth curve through all points but the first and last span's outer ends."""
    p = np.array(points, float)
    p = np.vstack([2 * p[0] - p[1], p, 2 * p[-1] - p[-2]])
    t = np.linspace(0, 1, per_span, endpoint=False)[:, None]
    spans = [0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t ** 2 + (3 * b - a - 3 * c + d) * t ** 3)
             for a, b, c, d in zip(p, p[1:], p[2:], p[3:])]
    return np.vstack(spans)


def curve_distance(x, z, curve):
    """Distance to a sampled curve, less the half width in its third column where it has one."""
    best = np.full(x.shape, 1e9)
    for sample in curve[::3]:
        width = sample[2] if len(sample) > 2 else 0.0
        best = np.minimum(best, np.hypot(x - sample[0], z - sample[1]) - width)
    return best


def cliff_line(z):
    """Foot of the cliff, height of the plateau, and the slope of the line, at given z."""
    dense = catmull_rom(CLIFF)[::-1]
    x, height = (np.interp(z, dense[:, 0], dense[:, k]) for k in (1, 2))
    slope = np.interp(z, dense[:, 0], np.gradient(dense[:, 1], dense[:, 0]))
    return x, height, slope


def behind_cliff(x, z):
    """Horizontal distance behind the cliff's foot line (positive under the plateau), and the plateau's height."""
    foot, height, slope = cliff_line(z)
    wobble = 0.9 * gradient_noise(np.stack([x * 0.0 + 7.3, z * 0.22], -1), 31)
    return (x - foot - wobble) / np.sqrt(1.0 + slope * slope), height


def shelter(z):
    """1 along the stretch where the cliff's foot is hollowed out into a rock shelter."""
    return smoothstep(3.2, 1.2, np.abs(z - 3.6))


def erode(height, strength, seed, batches=26, droplets=5000, steps=48):
    """Hydraulic erosion by droplets that all run at once: they pick soil up where they speed up, drop it where they slow down."""
    random = np.random.RandomState(seed)
    n = height.shape[0]
    for _ in range(batches):
        position = random.uniform(1, n - 2, (droplets, 2))
        direction = np.zeros((droplets, 2))
        speed, water, sediment = np.ones(droplets), np.ones(droplets), np.zeros(droplets)
        change = np.zeros(n * n)
        for _ in range(steps):
            i, j = position.astype(int).T
            u, v = position[:, 0] - i, position[:, 1] - j
            a, b, c, d = height[i, j], height[i + 1, j], height[i, j + 1], height[i + 1, j + 1]
            slope = np.stack([(b - a) * (1 - v) + (d - c) * v, (c - a) * (1 - u) + (d - b) * u], 1)
            direction = 0.35 * direction - 0.65 * slope / (np.linalg.norm(slope, axis=1, keepdims=True) + 1e-9)
            direction /= np.linalg.norm(direction, axis=1, keepdims=True) + 1e-9
            following = np.clip(position + direction, 1.0, n - 2.001)
            here = (1 - u) * (1 - v) * a + u * (1 - v) * b + (1 - u) * v * c + u * v * d
            fall = here - bilinear(height, following[:, 0], following[:, 1])
            capacity = np.clip(fall / STEP, 0.0, 1.0) * speed * water * 0.07
            spare = capacity - sediment
            moved = np.where(fall < 0, np.minimum(sediment, -fall), np.where(spare > 0, -0.25 * spare, -0.15 * spare))
            moved = np.where(moved < 0, np.maximum(moved, -np.maximum(fall, 0)), moved)
            moved *= strength[i, j]
            sediment -= moved
            for di, dj, weight in ((0, 0, (1-u)*(1-v)), (1, 0, u*(1-v)), (0, 1, (1-u)*v), (1, 1, u*v)):
                change += np.bincount((i + di) * n + j + dj, moved * weight, n * n)
            speed = np.sqrt(np.maximum(speed ** 2 + fall * 8.0, 0.05)) * 0.96
            water *= 0.975
            position = following
        height = height + blur(np.clip(change.reshape(n, n), -0.05, 0.05), 1)
    return height


class Ground:
    """Rasters of everything that is known about the ground. Build it once, then sample it."""

    def __init__(self):
        axis = np.linspace(-HALF, HALF, N)
        self.x, self.z = np.meshgrid(axis, axis)
        warp = np.stack([self.x, self.z], -1)
        bend = np.stack([fbm(warp * 0.35, 11, 3), fbm(warp * 0.35, 12, 3)], -1)
        self.path = curve_distance(self.x + 0.25 * bend[..., 0], self.z + 0.25 * bend[..., 1], catmull_rom(PATH))
        self.brook = curve_distance(self.x + 0.5 * bend[..., 0], self.z + 0.5 * bend[..., 1], catmull_rom(BROOK))
        self.behind, self.plateau = behind_cliff(self.x, self.z)
        self.height = self._shape(warp)
        gz, gx = np.gradient(blur(self.height, 2), STEP)
        self.slope = np.hypot(gx, gz)
        self.rock = np.full((N, N), 9.0)          # distance to rock that stands on the ground, see cover()

    def _shape(self, p):
        x, z = self.x, self.z
        roll = 0.62 * fbm(p * 0.085 + 3.1, 1, 2) + 0.28 * fbm(p * 0.24, 2, 2)
        meadow = 0.25 + roll + 0.07 * smoothstep(0, 8, self.brook) * np.maximum(self.brook, 0)
        # hills close the valley to the west and north, so that a walker sees no edge of the world
        edge = x + 2.2 * fbm(p * 0.11, 3, 3)
        meadow += 3.6 * smoothstep(-10.5, -20, edge) * smoothstep(24, 6, z) + 1.0 * smoothstep(-12, -20, edge)
        meadow += 2.5 * smoothstep(-7, -20, z + 2.0 * fbm(p * 0.13, 4, 3))
        meadow += 0.9 * np.exp(-((x + 2.6) ** 2 + (z + 4.6) ** 2) / 9.0)         # the arch's western foot
        meadow += (0.55 - 0.45 * shelter(z)) * np.exp(-np.abs(np.minimum(self.behind, 0)) / 1.3)      # scree under the cliff
        # the plateau's ramp hides inside the rock, except in the south where it is an open slope
        open_slope = smoothstep(10, 17, z)
        start = 0.7 + 2.1 * shelter(z) - 3.0 * open_slope
        top = self.plateau + 0.3 + 0.35 * fbm(p * 0.2, 5, 3) + 0.05 * np.maximum(self.behind, 0)
        ramp = smoothstep(0, 1, (self.behind - start) / (1.5 + 6.0 * open_slope))
        height = mix(meadow, top, ramp)
        # erosion: strong on slopes, faint on the flat; then tussocks that no water has smoothed
        gz, gx = np.gradient(height, STEP)
        strength = 0.2 + 0.8 * smoothstep(0.08, 0.4, np.hypot(gx, gz))
        height = erode(height, strength, seed=20)
        height = blur(height, 2) + 0.045 * fbm(p * 0.9, 6, 3) + 0.022 * fbm(p * 2.6, 7, 2)
        # brook and pond: banks fall to the water, the bed lies below it
        bank = smoothstep(0.0, 3.3, self.brook + 0.22 * fbm(p * 0.8, 8, 2))
        bed = WATER_LEVEL + 0.07 - 0.75 * smoothstep(0.25, -1.3, self.brook) + 0.03 * fbm(p * 1.5, 9, 2)
        height = mix(bed, height, bank)
        # the path is trodden in: it follows the smoothed ground, a hand deep, with a faint raised rim
        trodden = blur(height, 160) - 0.09 + 0.012 * fbm(p * 3.0, 10, 2)
        height = mix(height, trodden, smoothstep(1.15, 0.3, self.path))
        return height + 0.03 * np.exp(-((self.path - 0.95) / 0.25) ** 2)

    def at(self, raster, x, z):
        return bilinear(raster, (np.asarray(z) + HALF) / STEP, (np.asarray(x) + HALF) / STEP)

    def cover(self, distance_to_rock):
        """Tells the ground where rock stands on it: called as f(points) with the points of the ground."""
        points = np.stack([self.x, self.height + 0.03, self.z], -1)
        self.rock = distance_to_rock(points.reshape(-1, 3)).reshape(N, N)

    def mask(self, x, z):
        """What is painted into COLOR_0: grass density, moisture, clumps (a hint for flowers and taller tufts)."""
        p = np.stack([x, z], -1)
        path, brook, slope, rock = (self.at(r, x, z) for r in (self.path, self.brook, self.slope, self.rock))
        height, behind = self.at(self.height, x, z), self.at(self.behind, x, z)
        density = 0.9 + 0.16 * fbm(p * 0.45, 40, 3) - 0.35 * smoothstep(0.25, 0.6, fbm(p * 0.3 + 9.0, 41, 3))
        density = np.clip(density, 0.35, 1.0)
        density *= smoothstep(0.42, 0.95, path + 0.14 * fbm(p * 1.3, 42, 2))
        density *= smoothstep(WATER_LEVEL + 0.02, WATER_LEVEL + 0.14, height) * smoothstep(-0.1, 0.4, brook)
        density *= 1.0 - 0.85 * smoothstep(0.9, 1.6, slope + 0.2 * fbm(p * 0.9, 43, 2))
        scree = smoothstep(1.6, 0.2, np.abs(behind + 0.3)) * smoothstep(12, 8, z)
        density *= 1.0 - scree * smoothstep(-0.25, 0.25, fbm(p * 0.8, 44, 3))
        density *= smoothstep(0.0, 0.15, rock)
        moisture = np.clip(np.exp(-np.maximum(brook, 0) / 2.0) + 0.25 * fbm(p * 0.2, 45, 3), 0, 1)
        clumps = smoothstep(0.12, 0.45, fbm(p * 0.4 + 3.7, 46, 4)) * smoothstep(0.6, 2.2, path) * smoothstep(0, 1, brook)
        clumps = clumps * smoothstep(0.3, 0.7, density)
        return np.stack([density, moisture, clumps, np.ones_like(x)], -1)

    def albedo(self, size):
        """Painted colour of the whole ground, sRGB 0..1, row 0 in the north: size x size x 3."""
        axis = (np.arange(size) + 0.5) / size * 2 * HALF - HALF
        x, z = np.meshgrid(axis, axis)
        p = np.stack([x, z], -1)
        path, brook, slope, rock = (self.at(r, x, z) for r in (self.path, self.brook, self.slope, self.rock))
        height, behind = self.at(self.height, x, z), self.at(self.behind, x, z)
        fine, grain = fbm(p * 2.2, 60, 4, gain=0.65), fbm(p * 8.0, 61, 2, gain=0.9)
        straw = np.maximum(gradient_noise(p @ ((3.0, 11.0), (-2.0, 7.0)), 66), gradient_noise(p @ ((2.0, -8.0), (3.0, 9.0)), 67))
        # soil under the grass: moss and earth in patches, dry thatch on top of the rises, straw everywhere
        colour = blend((.310, .265, .165), (.255, .300, .120), smoothstep(-0.3, 0.25, fbm(p * 0.55, 62, 4) + 0.4 * fine))
        colour = blend(colour, (.440, .405, .220), 0.65 * smoothstep(0.0, 0.5, fbm(p * 0.28, 63, 4) + 0.4 * fine))
        colour = blend(colour, (.480, .430, .270), 0.55 * smoothstep(0.15, 0.6, straw))
        colour = blend(colour, (.205, .260, .100), 0.75 * smoothstep(2.8, 0.3, brook + 0.8 * fine))
        # steep ground shows the same beds as the cliff; stones lie under the cliff and around the boulders
        bed = gradient_noise(np.stack([height * 2.6 + 0.5 * fine, 0.15 * x], -1), 68) + 0.5 * fine
        ledges = blend((.345, .320, .275), (.480, .445, .385), smoothstep(-0.45, 0.5, bed + 0.4 * grain))
        colour = blend(colour, ledges, smoothstep(1.0, 1.5, slope + 0.5 * fine))
        scree = smoothstep(2.0, 0.3, np.abs(behind + 0.3)) * smoothstep(12, 8, z) * smoothstep(-0.3, 0.2, fbm(p * 0.8, 44, 3))
        strewn = np.maximum(scree, 0.7 * smoothstep(0.45, 0.0, rock + 0.2 * fine))
        for scale, seed in ((7.0, 64), (3.1, 69)):
            stone, _, name = worley(p * scale + 0.25 * fine[..., None], seed)
            size = 0.15 + 0.33 * unit(name, 11)
            lying = smoothstep(size, size - 0.12, stone) * (unit(name) < 0.75 * strewn)
            colour = blend(colour * (1.0 - 0.35 * smoothstep(size + 0.25, size, stone) * (lying < 0.5) * strewn)[..., None],
                           blend((.350, .335, .300), (.540, .515, .465), unit(name, 5)), lying)
        # the path: trodden earth, pale in the middle, pebbles of all sizes, worn grass at its sides
        edge = path + 0.22 * fine + 0.10 * grain
        earth = blend((.520, .440, .325), (.390, .315, .220), smoothstep(0.05, 0.55, edge + 0.35 * fine))
        for scale, seed in ((5.0, 65), (10.0, 59)):
            pebble, _, name = worley(p * scale + 0.2 * grain[..., None], seed)
            size = 0.10 + 0.25 * unit(name, 11)
            earth = blend(earth, blend((.400, .370, .320), (.610, .575, .510), unit(name, 5)),
                          0.8 * smoothstep(size, size - 0.1, pebble) * (unit(name) > 0.7))
        colour = blend(colour, earth, smoothstep(0.92, 0.50, edge))
        # wet margin and the bed of the brook
        above = height - WATER_LEVEL + 0.06 * fine
        colour = blend(colour, (.235, .195, .130), smoothstep(0.17, 0.04, above) * smoothstep(1.2, 0.3, brook))
        gravel = blend((.310, .295, .225), (.180, .195, .140), smoothstep(0, -0.6, above)) * (0.7 + 0.6 * unit(name))[..., None]
        colour = blend(colour, gravel, smoothstep(0.07, -0.04, above) * 0.8)
        return np.clip(colour * (1.0 + 0.24 * fine + 0.20 * grain)[..., None], 0.02, 0.98)
