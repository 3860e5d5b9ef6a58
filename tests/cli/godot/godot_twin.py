"""The arithmetic of addons/sward, written anew: accessors of a .glb to instances of a MultiMesh, and level of detail."""

import numpy

NUMBERS, STEPS, STEPS_PER_OCTAVE = 20, 33, 4
LOD_FADE, FULL_SHARE, SMALLEST_SHARE = 0.1, 1.0 / 0.9, 1.0 / 256.0


def linear(x):
    return numpy.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def basis(q):
    """Columns of the rotations by unit quaternions x y z w."""
    x, y, z, w = q.T
    return numpy.stack([
        numpy.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], axis=1),
        numpy.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], axis=1),
        numpy.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=1)], axis=2)


def multimesh_buffer(glb, attributes):
    """20 numbers an instance, as blade_instances.gd fills them: single precision."""
    read = lambda name: glb.numbers(attributes[name])
    axes = basis(read("ROTATION")) * read("SCALE")[:, None, :]
    rows = numpy.concatenate([axes, read("TRANSLATION")[:, :, None]], axis=2).reshape(-1, 12)
    root = glb.raw(attributes["_ROOT_COLOR"]).astype(int)
    tip = glb.raw(attributes["_TIP_COLOR"])[:, :3] / 255.0
    stiffness, exposure = (numpy.round(n * read(name)[:, 0]) for n, name in ((63, "_STIFFNESS"), (31, "_EXPOSURE")))
    custom = numpy.stack([stiffness + 64 * exposure, read("_RANK")[:, 0],
                          (root[:, 0] >> 3) + ((root[:, 1] >> 2) << 5), root[:, 2] >> 3], axis=1)
    return numpy.concatenate([rows, linear(tip), read("_LEAF_AREA"), custom], axis=1).astype(numpy.float32)


def as_halves(buffer):
    """What the Compatibility renderer keeps: colour and custom data as halves, rounded towards zero."""
    kept = buffer.copy()
    bits = kept[:, 12:].copy().view(numpy.uint32)
    halves = (bits & numpy.uint32(0xFFFFE000)).view(numpy.float32)
    kept[:, 12:] = numpy.where(numpy.abs(halves) < 2.0 ** -14, 0.0, halves)
    return kept


def unpacked(buffer):
    """What the vertex shader gets out of an instance."""
    rows = buffer[:, :12].reshape(-1, 3, 4).astype(numpy.float64)
    packed, red_green, blue = (numpy.floor(buffer[:, k] + 0.5).astype(int) for k in (16, 18, 19))
    root = numpy.stack([(red_green & 31) / 31, (red_green >> 5) / 63, blue / 31], axis=1)
    return {"place": rows[:, :, 3], "width": numpy.linalg.norm(rows[:, :, 0], axis=1),
            "height": numpy.linalg.norm(rows[:, :, 1], axis=1), "side": rows[:, :, 0], "up": rows[:, :, 1],
            "front": rows[:, :, 2], "stiffness": (packed & 63) / 63, "exposure": (packed >> 6) / 31,
            "rank": buffer[:, 17], "tip": buffer[:, 12:15], "root": root, "leaf_area": buffer[:, 15]}


def counts_of(ranks):
    counts = numpy.searchsorted(ranks, 2.0 ** (-numpy.arange(STEPS) / STEPS_PER_OCTAVE))
    counts[0] = len(ranks)
    return counts


def visible_of(counts, share):
    if share >= 1.0:
        return counts[0]
    step = int(numpy.floor(-numpy.log2(max(share, SMALLEST_SHARE)) * STEPS_PER_OCTAVE + 1e-4))
    return counts[min(max(step, 0), STEPS - 1)]


def share_of(pixels, below):
    return numpy.clip(pixels / below, SMALLEST_SHARE, FULL_SHARE)


def width_factor(rank, share):
    """lod_width_factor() of blade.gdshader."""
    if share >= FULL_SHARE:
        return numpy.ones_like(rank)
    fade = LOD_FADE * share
    beyond = max(share - 1.0, 0.0)
    return numpy.clip((share - rank) / fade, 0.0, 1.0) / (share - 0.5 * fade - 0.5 * beyond * beyond / fade)


def curve_of(places, uvs):
    """Control points v1 and v2 of the first ribbon of a mesh, and the number of its vertices."""
    first = 1
    while first < len(uvs) and uvs[first, 1] >= uvs[first - 1, 1]:
        first += 1
    centre = lambda t: places[:first][numpy.abs(uvs[:first, 1] - t) < 1e-4].mean(axis=0)
    v2 = centre(1.0)
    return 2.0 * centre(0.5) - 0.5 * v2, v2, first


def rest_tip(stiffness, gravity, forward, recovery):
    """Direction (front, up) of the tip of a blade on level ground without wind: held_direction()."""
    b = 1.0 - stiffness
    pull = numpy.stack([b * gravity * forward, -b * gravity + numpy.maximum(recovery * (1.0 - 0.25 * b), 1e-3)], axis=-1)
    pull[..., 1] = numpy.maximum(pull[..., 1], 0.0)
    return pull / numpy.linalg.norm(pull, axis=-1, keepdims=True)
