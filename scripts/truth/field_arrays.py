"""Blades and ground of a field as arrays for another renderer: triangles with the colours that the shaders give them.

The formulas are those of shaders/shared (shape.h, ribbon.h, organ.h, cover.h, noise.h), shaders/blade/blade_colors.glsl and
shaders/preview/ground_light.glsl in NumPy, read off those files and written anew: a second opinion on blades as well.
"""

import json
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))
import read_field  # noqa: E402

# Of cover.h, grass_cover.cpp, blade_colors.glsl and blade_light.glsl.
MOST_CORNERS = 128
LEAST_GROUND = 0.02
LITTER, LITTER_SHARE, UNDERGROWTH_HEIGHT = np.array([0.135, 0.120, 0.048]), 0.35, 0.3
THROUGH_TINT, THROUGH = np.array([1.25, 1.15, 0.45]), 0.8
STRAW, DRIED_CLUMP = np.array([0.42, 0.32, 0.13]), 255
DANDELION_LOBES = 4
# A triangle-tip of an organ narrows towards its base.
STALK_LEAF, BASE_WIDTH, BASE_LENGTH = "triangle-tip on a stalk", 0.25, 0.3


def mix(a, b, t):
    return a + (b - a) * t


def smoothstep(low, high, x):
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def decoded(encoded):
    return np.where(encoded > 0.04045, ((encoded + 0.055) / 1.055) ** 2.4, encoded / 12.92)


def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)


def mix_uint(x):
    x = x.astype(np.uint32)
    for shift, factor in ((16, 0x7feb352d), (15, 0x846ca68b)):
        x = (x ^ (x >> np.uint32(shift))) * np.uint32(factor)
    return x ^ (x >> np.uint32(16))


def chance(key):
    return (mix_uint(key) >> np.uint32(8)) / 16777215.0


def value_noise(places):
    """noise.h at an array of places."""
    steps = [np.uint32(step) for step in (0x9e3779b1, 0x85ebca77, 0xc2b2ae3d)]
    cell = np.floor(places)
    f = places - cell
    s = f * f * (3.0 - 2.0 * f)
    cell = cell.astype(np.int64).astype(np.uint32)
    near = cell[:, 0] * steps[0] + cell[:, 1] * steps[1] + cell[:, 2] * steps[2]
    result = np.zeros(len(places))
    for corner in range(8):
        bits = [corner >> axis & 1 for axis in range(3)]
        point = near + sum((step for bit, step in zip(bits, steps) if bit), np.uint32(0))
        height = ((point ^ (point >> np.uint32(11))) * np.uint32(0x31848bab)).astype(float)
        result += height * np.prod([s[:, axis] if bit else 1.0 - s[:, axis] for axis, bit in enumerate(bits)], axis=0)
    return result / 2.0 ** 32


def meadow_and_region(places):
    meadow = 0.65 * value_noise(places / 2.3) + 0.35 * value_noise(places / 0.7)
    return meadow, value_noise(places / 13.0 + 71.0)


def shift_of(hue):
    return np.stack([1.0 + 0.75 * hue, 1.0 + 0.10 * hue, 1.0 - 0.45 * hue], axis=-1)


def outline(shape, threshold, t):
    """Left and right edge in widths at `t` [0, 1] along a blade."""
    half = 0.5
    if shape == "triangle-tip":
        half = 0.5 - 0.5 * max(t - threshold, 0.0) / max(1.0 - threshold, 1e-3)
    elif shape == "triangle":
        half = 0.5 - 0.5 * t
    elif shape == "quadratic":
        return -0.5, 0.5 - t * t
    elif shape == "dandelion":
        rest = 1.0 - t
        half = 0.5 * np.sqrt(rest) * (2.0 - rest - np.sqrt(0.5 * abs(np.sin(np.pi * DANDELION_LOBES * rest))))
    elif shape == STALK_LEAF:
        before = max(1.0 - t / BASE_LENGTH, 0.0)
        half = outline("triangle-tip", threshold, t)[1] * (1.0 - (1.0 - BASE_WIDTH) * before * before)
    elif shape == "leaf":
        away = (threshold - t) / max(threshold, 1e-3) if t < threshold else (t - threshold) / max(1.0 - threshold, 1e-3)
        half = 0.5 - 0.5 * min(away * away, 1.0)
    return -half, half


def outline_area(shape, threshold):
    if shape == STALK_LEAF:
        steps = (np.arange(4096) + 0.5) / 4096
        return 2.0 * np.mean([outline(shape, threshold, t)[1] for t in steps])
    return {"triangle-tip": 0.5 + 0.5 * threshold, "triangle": 0.5, "quadratic": 2 / 3, "leaf": 2 / 3,
            "dandelion": 0.57268}.get(shape, 1.0)


def finish(look):
    """finishOf() of leaf_finish.h."""
    shape = look.get("shape", "triangle-tip")
    if shape == "quad":
        return "stalk"
    if shape not in ("leaf", "dandelion"):
        return "grass"
    red, green, blue = look["tip_color"]
    return "broad" if green > max(red, blue) else "petal"


def end_wave(away, falls):
    return max(1.0 - away, 0.0) ** 2 * (1.0 - falls * away)


def tone_along(finishes, t, dry):
    """toneAlong() of leaf_finish.h: a factor for each blade."""
    tone = np.ones((len(finishes), 3))
    is_petal, is_grass = finishes == "petal", finishes == "grass"
    tone[is_petal] -= end_wave(min(t / 0.6, 1.0), 2.5) * np.array([0.12, 0.22, 0.42])
    tone[is_grass | (finishes == "stalk")] += end_wave(min(2.5 * t, 1.0), 4.0) * np.array([0.75, 0.3, 0.55])
    tone[is_grass] += (dry * end_wave(min(2.2 - 2.2 * t, 1.0), 2.5))[is_grass, None] * np.array([0.12, -0.2, -0.35])
    return tone


class Looks:
    """The species' looks and those of their organs; each blade has one."""

    def __init__(self, species):
        self.list = list(species)
        self.first, self.ribbons = {}, {}
        for number, one in enumerate(species):
            if "organs" in one:
                kinds = range(len(self.list), len(self.list) + len(one["organs"]))
                self.list += [{**organ, "shape": STALK_LEAF} if organ.get("shape") == "triangle-tip" else organ
                              for organ in one["organs"]]
                # Ribbon numbers 1, 2 … in the order of the organs.
                self.ribbons[number] = np.repeat(kinds, [organ["count"] for organ in one["organs"]])

    def of(self, species, clump):
        """The look of each blade."""
        look = species.copy()
        for number, ribbons in self.ribbons.items():
            on_stalk = (species == number) & (clump > 0)
            look[on_stalk] = ribbons[clump[on_stalk] - 1]
        return look

    def values(self, name, otherwise):
        return np.array([look.get(name, otherwise) for look in self.list], float)


class Cover:
    """Leaf area index on a grid of cubes: grass_cover.cpp."""

    def __init__(self, soup, roots, areas, mean_height):
        """`soup`: the drawn ground; `areas` [m²] of the blades at `roots`."""
        places = np.concatenate([soup.reshape(-1, 3), roots])
        low, size = places.min(axis=0), np.ptp(places, axis=0)
        self.low, self.edge = low, max(size.max() / (MOST_CORNERS - 1), 0.5 * mean_height, 1e-6)
        self.count = np.clip(np.ceil(size / self.edge).astype(int) + 1, 2, MOST_CORNERS)
        leaves, ground = np.zeros(self.count.prod()), np.zeros(self.count.prod())
        self.deal(leaves, roots, areas)
        pieces = subdivided(soup, 0.5 * self.edge)
        sides = np.cross(pieces[:, 1] - pieces[:, 0], pieces[:, 2] - pieces[:, 0])
        self.deal(ground, pieces.mean(axis=1), 0.5 * np.linalg.norm(sides, axis=1))
        self.values = leaves / np.maximum(ground, LEAST_GROUND * self.edge ** 2)

    def around(self, places):
        """For each of eight corners, its index and weight at each place."""
        at = np.clip((places - self.low) / self.edge, 0.0, self.count - 1.0)
        cell = np.minimum(at.astype(int), self.count - 2)
        f = at - cell
        for corner in range(8):
            bits = np.array([corner >> axis & 1 for axis in range(3)])
            index = cell + bits
            weight = np.prod(np.where(bits, f, 1.0 - f), axis=1)
            yield index[:, 0] + self.count[0] * (index[:, 1] + self.count[1] * index[:, 2]), weight

    def deal(self, amounts, places, what):
        for index, weight in self.around(places):
            amounts += np.bincount(index, weight * what, len(amounts))

    def at(self, places):
        return sum(self.values[index] * weight for index, weight in self.around(places))


def subdivided(soup, longest):
    """Triangles (n × 3 × 3) halved at their longest side until none is longer [m]."""
    done = []
    while len(soup):
        sides = np.linalg.norm(np.roll(soup, -1, axis=1) - soup, axis=2)
        large = sides.max(axis=1) > longest
        done.append(soup[~large])
        soup, side = soup[large], sides[large].argmax(axis=1)
        if not len(soup):
            break
        rows = np.arange(len(soup))
        turned = np.stack([soup[rows, (side + i) % 3] for i in range(3)], axis=1)  # the longest side comes first
        middle = 0.5 * (turned[:, 0] + turned[:, 1])
        soup = np.concatenate([np.stack([turned[:, 0], middle, turned[:, 2]], axis=1),
                               np.stack([middle, turned[:, 1], turned[:, 2]], axis=1)])
    return np.concatenate(done)


def unpacked(field):
    """What is needed of all packed blades, ribbons on stalks too."""
    patches, packed = field["PATCHES"], field["BLADES"]
    patch = np.repeat(np.arange(len(patches)), patches["blade_count"])
    own = patches[patch]
    bits = lambda word, low, count: packed[:, word] >> np.uint32(low) & np.uint32((1 << count) - 1)
    steps = np.stack([bits(0, 0, 16), bits(0, 16, 16), bits(1, 0, 16)], axis=1)
    with np.errstate(over="ignore"):
        seed = mix_uint(((packed[:, 2] & np.uint32(0xffc000ff)) ^ (packed[:, 1] >> np.uint32(16) << np.uint32(8))) +
                        packed[:, 3] * np.uint32(0x9e3779b9)) >> np.uint32(16)
    return {"root": own["root_low"] + own["root_step"][:, None] * steps.astype("f4"),
            "up": read_field.octahedral((bits(1, 16, 8).astype("f4") - 127) / 127, (bits(1, 24, 8).astype("f4") - 127) / 127),
            "facing": bits(2, 0, 8), "stiffness": bits(2, 22, 6), "hash": bits(2, 28, 4),
            "height": own["height_low"] + own["height_step"] * bits(2, 8, 8).astype("f4"),
            "width": own["width_low"] + own["width_step"] * bits(2, 16, 6).astype("f4"),
            "tint": np.stack([bits(3, 0, 5) / 31, bits(3, 5, 6) / 63, bits(3, 11, 5) / 31], axis=1),
            "tint_g": bits(3, 5, 6), "exposure": bits(3, 16, 5) / 31, "species": bits(3, 21, 3).astype(int),
            "clump": bits(3, 24, 8).astype(int), "seed": seed}


def frame_around(up):
    """tangentOf() and bitangentOf() of octahedral.h."""
    sign = np.where(up[:, 2] >= 0.0, 1.0, -1.0)
    a = -1.0 / (sign + up[:, 2])
    b = up[:, 0] * up[:, 1] * a
    tangent = np.stack([1.0 + sign * up[:, 0] ** 2 * a, sign * b, -sign * up[:, 0]], axis=1)
    return tangent, np.cross(up, tangent)


def dumped(path):
    """Ids and control points of `sward-view render --dump-blades`."""
    with Path(path).open(encoding="ascii") as file:
        names = file.readline().strip().split(",")
    numbers = [names.index(name) for name in ("x", "y", "z", "v1x", "v1y", "v1z", "v2x", "v2y", "v2z")]
    points = np.loadtxt(path, delimiter=",", skiprows=1, usecols=numbers, ndmin=2)
    ids = np.loadtxt(path, delimiter=",", skiprows=1, usecols=[names.index("id")], dtype=np.int64, ndmin=1)
    return ids, points.reshape(-1, 3, 3)


def ground_arrays(field, finest, most):
    """Soup of the drawn ground (level 0), with the albedo at each corner; pieces of `finest` [m] or coarser, `most` at most."""
    vertices, indices = field["GVERTICE"], field["GINDICES"]
    soups, colors = [np.zeros((0, 3, 3))], [np.zeros((0, 3))]
    images = read_field.images(field["GIMAGES"])
    for part in field["GRANGES"]:
        if part["level"] != 0:
            continue
        corners = vertices[indices[part["first"]:part["first"] + part["count"]]]
        material = field["GMATERIA"][part["material"]]
        color = material["color"][:3] * decoded(corners["color"][:, :3] / 255.0)
        if material["image"] != 0xffffffff:
            image = images[material["image"]]
            at = np.mod(corners["uv"], 1.0) * (image.shape[1], image.shape[0])
            at = np.minimum(at.astype(int), (image.shape[1] - 1, image.shape[0] - 1))
            color = color * decoded(image[at[:, 1], at[:, 0], :3] / 255.0)
        soups.append(corners["position"].reshape(-1, 3, 3).astype(float))
        colors.append(color.reshape(-1, 3, 3).mean(axis=1))
    soup, color = np.concatenate(soups), np.concatenate(colors)
    if not len(soup):
        return soup, color
    # Each triangle keeps its own colour through the division.
    area = 0.5 * np.linalg.norm(np.cross(soup[:, 1] - soup[:, 0], soup[:, 2] - soup[:, 0]), axis=1).sum()
    longest = max(finest, np.sqrt(4.0 * area / most))
    pieces, shades = [], []
    for shade in np.unique(color, axis=0):
        part = subdivided(soup[(color == shade).all(axis=1)], longest)
        pieces.append(part)
        shades.append(np.broadcast_to(shade, (len(part), 3)))
    return np.concatenate(pieces), np.concatenate(shades)


def thinned_of(path):
    chunks = read_field.read_chunks(Path(path).read_bytes())[1]
    return float(json.loads(chunks["COVER"])["thinned"]) if "COVER" in chunks else 1.0


def arrays_of(path, dump, segments=8, finest=0.05):
    """Everything that a renderer needs, and what is known of it: two dictionaries.

    `segments` along each blade; `finest`: side of the ground's pieces [m].
    """
    field = read_field.read_field(path)
    table = unpacked(field)
    ids, points = dumped(dump)
    own = read_field.ids(field["KEYS"]) if len(field["KEYS"]) else np.arange(len(field["BLADES"]))
    if len(ids) != len(own) or (ids != own).any():
        raise ValueError(f"{dump}: not the blades of {path}, in the order of the file")
    v0, v1, v2 = np.moveaxis(points - field["origin"], 1, 0)
    looks = Looks(field["SPECIES"])
    species, clump = table["species"], table["clump"]
    look = looks.of(species, clump)
    is_plant = np.isin(species, list(looks.ribbons))
    on_stalk = is_plant & (clump > 0)

    # Leaf area where each blade stands.
    shapes = [one.get("shape", "triangle-tip") for one in looks.list]
    thresholds = looks.values("tip_threshold", 0.5)
    areas = np.array([outline_area(shape, threshold) for shape, threshold in zip(shapes, thresholds)])
    # A ribbon counts with the mean length of its organ.
    share = np.array([np.mean(one["length"]) if "pitch_deg" in one else 1.0 for one in looks.list])
    area = table["height"] * share[look] * table["width"] * areas[look]
    soup, bare = ground_arrays(field, finest, 400_000)
    patches = field["PATCHES"]
    middle = lambda name, last: patches[f"{name}_low"] + 0.5 * last * patches[f"{name}_step"]
    counts = patches["blade_count"].astype(float)
    mean_height = float((counts * middle("height", 255)).sum() / max(counts.sum(), 1.0))
    cover = Cover(soup, table["root"].astype(float), area, mean_height)
    thinned = thinned_of(path)
    root_color = np.array([one["root_color"] for one in looks.list], float)
    tip_color = np.array([one["tip_color"] for one in looks.list], float)
    mean = lambda colors: (area[:, None] * colors[look]).sum(axis=0) / area.sum()
    undergrowth = mix(mix(mean(root_color), mean(tip_color), UNDERGROWTH_HEIGHT), LITTER, LITTER_SHARE)
    below = lambda places: 1.0 - np.exp(-0.65 * thinned * cover.at(places))

    # Colours: blade_colors.glsl. All parts of a plant have one tone.
    with np.errstate(over="ignore"):
        plant_key = table["hash"] | table["facing"] << np.uint32(4)
        tone = np.where(is_plant, plant_key % DRIED_CLUMP, clump).astype(np.uint32)
        clump_chance = chance(tone * np.uint32(977) + np.uint32(11))
        kept = (table["facing"] | table["stiffness"] << np.uint32(8) | table["tint_g"] << np.uint32(14) | tone << np.uint32(20))
        key = kept * np.uint32(16) + table["hash"]
        single, other = chance(key), chance(key + np.uint32(0x9e3779b9))
        # A ribbon has the root of its plant.
        meadow, region = meadow_and_region(table["root"].astype(float))
    amount = looks.values("color_variation", 0.0)[look]
    light = 1 + amount * (0.9 * (single - .5) + 0.6 * (clump_chance - .5) + 0.5 * (meadow - .5) + 0.4 * (region - .5))
    hue = amount * (0.7 * (clump_chance - .5) + 0.5 * (other - .5) + 1.1 * (meadow - .5) + 1.2 * (region - .5))
    shift = shift_of(hue)
    ground = mix(decoded(table["tint"]), shift * undergrowth, below(table["root"].astype(float))[:, None])
    root = mix(root_color[look] * shift, ground, looks.values("ground_tint", 0.0)[look][:, None]) * light[:, None]
    tip = tip_color[look] * shift * light[:, None]
    dead = (tone == DRIED_CLUMP).astype(float)
    dry = np.maximum(smoothstep(0.0, 0.25, looks.values("dryness", 0.0)[look] * (0.6 + 0.8 * meadow) - other), dead)
    straw = STRAW * (0.7 + 0.6 * single)[:, None]
    tip = mix(tip, straw, 0.8 * dry[:, None])
    root = mix(root, 0.6 * straw, (0.25 * dry + 0.3 * dead)[:, None])

    # Ribbons across the curves: a ribbon on a stalk lies across the plane in which it bends.
    tangent, bitangent = frame_around(table["up"].astype(float))
    angle = (table["facing"] * (2.0 * np.pi / 256.0))[:, None]
    axis = tangent * np.cos(angle) + bitangent * np.sin(angle)
    bend = np.cross(v1 - v0, v2 - v1)
    is_bent = on_stalk & (np.linalg.norm(bend, axis=1) > 1e-3 * np.linalg.norm(v2 - v0, axis=1) ** 2)
    axis[is_bent] = unit(bend[is_bent])
    straight = on_stalk & ~is_bent
    axis[straight] = unit(np.cross(v2 - v0, v2 - v0 + [0.31, 0.17, 0.23]))[straight]
    finishes = np.array([finish(one) for one in looks.list])[look]
    dry_tips = smoothstep(0.3, 1.0, (table["seed"] & np.uint32(255)) / 255.0)
    fold = looks.values("fold", 0.0)[look]
    across = 3 if (fold > 0.0).any() else 2
    count = len(v0)
    vertices = np.empty((count, segments + 1, across, 3), np.float32)
    reflected = np.empty_like(vertices)
    scale = np.array([widening(shape, threshold, segments) for shape, threshold in zip(shapes, thresholds)])[look]
    width = scale * table["width"]
    for k in range(segments + 1):
        t = k / segments
        edges = np.array([outline(shape, threshold, t) for shape, threshold in zip(shapes, thresholds)])[look] * width[:, None]
        place = (1 - t) ** 2 * v0 + 2 * t * (1 - t) * v1 + t * t * v2
        left, right = (place + edges[:, i, None] * axis for i in (0, 1))
        vertices[:, k, 0], vertices[:, k, -1] = left, right
        if across == 3:
            along = unit((1 - t) * (v1 - v0) + t * (v2 - v1))
            ridge = (0.5 * fold * (edges[:, 1] - edges[:, 0]))[:, None] * unit(np.cross(along, axis))
            vertices[:, k, 1] = 0.5 * (left + right) + ridge
        reflected[:, k] = (mix(root, tip, smoothstep(-0.15, 0.8, t)) * tone_along(finishes, t, dry_tips))[:, None]
    reflected = np.clip(reflected, 0.0, 1.0)
    through = reflected * (THROUGH * THROUGH_TINT * looks.values("translucency", 0.0)[look][:, None])[:, None, None]
    first = (np.arange(count) * (segments + 1) * across)[:, None, None] + across * np.arange(segments)[:, None]
    corner = first + np.arange(across - 1)
    faces = np.stack([corner, corner + 1, corner + across + 1, corner + across], axis=-1).reshape(-1, 4)
    gloss = np.broadcast_to(looks.values("gloss", 0.0)[look][:, None], (count, (segments + 1) * across))

    places = soup.reshape(-1, 3)
    with np.errstate(over="ignore"):
        meadow, region = meadow_and_region(places)
    shade = (1 + 0.45 * (0.5 * (meadow - .5) + 0.4 * (region - .5)))[:, None] * \
        shift_of(0.45 * (1.1 * (meadow - .5) + 1.2 * (region - .5)))
    under = below(places)[:, None]
    albedo = mix(np.repeat(bare, 3, axis=0), shade * undergrowth, under)
    flat = lambda array: array.reshape(-1, 3).astype(np.float32)
    arrays = {"vertices": flat(vertices), "faces": faces.astype(np.int32), "reflected": flat(reflected), "through": flat(through),
              "gloss": gloss.ravel().astype(np.float32), "ground": places.astype(np.float32), "ground_color": flat(albedo)}
    known = {"blades": count, "origin": [float(x) for x in field["origin"]],
             "leaf_area_index": float(cover.at(table["root"].astype(float)).mean()), "largest_albedo": float((reflected + through).max())}
    return arrays, known


def widening(shape, threshold, segments):
    """Widening of the chords that restores the outline's area."""
    widths = [np.subtract(*outline(shape, threshold, k / segments)[::-1]) for k in range(segments + 1)]
    return outline_area(shape, threshold) * segments / (0.5 * (widths[0] + widths[-1]) + sum(widths[1:-1]))
