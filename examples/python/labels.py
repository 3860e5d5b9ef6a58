#!/usr/bin/python3
"""A meadow on heights from numpy, with land cover as its mask: labelled pictures, and a plot of leaf area by height.

    examples/python/labels.py OUT [--small]

Needs the module sward (docs/python.md). Writes into the folder OUT:

    meadow.sward     the field
    frame_00.png …   pictures of a walk through it
    frame_00.npz …   what their pixels show: depth, id, species, flow-backward (docs/layers.md), and cover: 1 + class of
                     land cover on which the blade grows, 0 without a blade
    leaf_area.png    leaf area by height above the ground, by species: by matplotlib, or plain bars without it
    labels.json      how much of what grows where: blades and leaf area index of each class of land cover
"""

import argparse
import json
import struct
import zlib
from pathlib import Path

import numpy
import sward

SIDE = 48.0  # [m] of the ground
PATH, MEADOW, DAMP = 0, 1, 2  # classes of land cover
CLASSES = ("path", "meadow", "damp hollow")
SHARE = numpy.array([0.0, 1.0, 0.6])  # of the density, by class


def heights_and_cover(samples):
    """(z, x) heights [m] of a rolling ground, and the class of each place."""
    x, z = numpy.meshgrid(*[numpy.linspace(-SIDE / 2, SIDE / 2, samples)] * 2)
    heights = 1.6 * numpy.sin(x / 7) * numpy.cos(z / 9) + 0.03 * x + 0.3 * numpy.sin(x / 2.3 + z / 3.1)
    cover = numpy.full(heights.shape, MEADOW)
    cover[heights < -0.9] = DAMP
    cover[numpy.abs(z - 4 * numpy.sin(x / 8)) < 1.2] = PATH
    return heights, cover


def class_at(cover, places):
    """Classes at roots (n, 3) [m]."""
    cells = numpy.rint((places[:, [2, 0]] / SIDE + 0.5) * (len(cover) - 1)).astype(int)
    return cover[tuple(numpy.clip(cells, 0, len(cover) - 1).T)]


def walk(frames):
    """A camera for each frame: along the path, at the height of a child's eyes."""
    for share in numpy.linspace(0.15, 0.45, frames):
        x = (share - 0.5) * SIDE
        z = 4 * numpy.sin(x / 8)
        ground = 1.6 * numpy.sin(x / 7) * numpy.cos(z / 9) + 0.03 * x + 0.3 * numpy.sin(x / 2.3 + z / 3.1)
        yield {"eye": [x, ground + 1.1, z], "target": [x + 6, ground + 0.2, 4 * numpy.sin((x + 6) / 8) - 1.5],
               "fov_y_deg": 60}


def leaf_area_by_height(field, step=0.02, chunk=100_000):
    """(edges [m], area [m²] by species and step): each blade's area, spread along its curve at rest."""
    t = (numpy.arange(20) + 0.5) / 20
    bezier = numpy.stack([(1 - t) ** 2, 2 * t * (1 - t), t**2])
    edges = numpy.arange(0.0, 1.3 * float(field.blades()["height"].max()) + 2 * step, step)
    area = numpy.zeros((len(field.species), len(edges) - 1))
    for first in range(0, len(field), chunk):
        count = min(chunk, len(field) - first)
        blades, curves = field.blades(first, count), field.curves(first, count)
        # A leaf of a compound plant has the root of its stalk.
        height = numpy.maximum(curves[:, :, 1] @ bezier - blades["root"][:, 1:2], 0)
        weight = numpy.repeat(blades["area"][:, None] / len(t), len(t), axis=1)
        for number in range(len(field.species)):
            own = blades["species"] == number
            area[number] += numpy.histogram(height[own], edges, weights=weight[own])[0]
    used = 1 + int(numpy.flatnonzero(area.sum(axis=0))[-1])
    return edges[: used + 1], area[:, :used]


def write_png(path, picture):
    """An 8-bit RGB picture as a PNG file."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    height, width, _ = picture.shape
    rows = b"".join(b"\0" + row.tobytes() for row in numpy.ascontiguousarray(picture))
    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                           + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def plot(path, names, edges, area, ground):
    """Leaf area density [m²/m³] over height, by species."""
    density = area / (ground * numpy.diff(edges))
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as pyplot
    except ImportError:
        bars = numpy.full((len(edges) - 1, 200, 3), 255, numpy.uint8)
        lengths = density.sum(axis=0) / density.sum(axis=0).max() * 199
        for row, length in zip(bars[::-1], lengths):
            row[: int(length) + 1] = (60, 130, 40)
        write_png(path, bars.repeat(6, axis=0))
        return
    figure, axes = pyplot.subplots(figsize=(6.4, 4), dpi=100)
    left = numpy.zeros(len(edges) - 1)
    for name, own in zip(names, density):
        axes.barh(edges[:-1], own, numpy.diff(edges), left, align="edge", label=name)
        left += own
    axes.set(xlabel="leaf area density [m²/m³], one side", ylabel="height above the ground [m]",
             title=f"leaf area index {area.sum() / ground:.2f}")
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--small", action="store_true", help="few blades and small pictures, for a test")
    arguments = parser.parse_args()
    out = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    density, size, frames = (4, (96, 54), 2) if arguments.small else (900, (1280, 720), 20)

    # Heights and land cover are arrays; the field is a file that is mapped.
    heights, cover = heights_and_cover(97 if arguments.small else 385)
    field = sward.bake(heights, extent=(SIDE, SIDE), density=density, mask=SHARE[cover], meadow="hay", seed=7,
                       output=out / "meadow.sward", force=True,
                       progress=lambda fraction, text: print(f"\r{text} {fraction:4.0%} ", end=""))
    print(f"\r{field!r}")

    # Each blade has a place, an area and a species: labels without a picture.
    blades = field.blades()
    classes = class_at(cover, blades["root"])
    labels = {}
    for number, name in enumerate(CLASSES):
        ground = numpy.count_nonzero(cover == number) / cover.size * SIDE * SIDE
        own = classes == number
        labels[name] = {"ground_m2": round(ground, 1), "blades": int(own.sum()),
                        "leaf_area_index": round(float(blades["area"][own].sum() / ground), 3)}
    (out / "labels.json").write_text(json.dumps(labels, indent=2) + "\n", encoding="utf-8")

    # The device stays open from picture to picture, and the blades move on. Pixels know their blade, and so all that is
    # known of it.
    renderer = sward.Renderer(field, wind_strength=2)
    order = numpy.argsort(blades["id"])
    for number, camera in enumerate(walk(frames)):
        drawn = renderer.render(camera, time=number / 10, size=size, layers=["depth", "id", "species", "flow-backward"])
        write_png(out / f"frame_{number:02}.png", drawn.pop("color"))
        seen = numpy.searchsorted(blades["id"], drawn["id"] & (2**53 - 1), sorter=order)
        cover_seen = 1 + classes[order[numpy.minimum(seen, len(order) - 1)]]
        drawn["cover"] = numpy.where(drawn["id"] != 0, cover_seen, 0).astype(numpy.uint8)
        numpy.savez_compressed(out / f"frame_{number:02}.npz", **drawn)

    edges, area = leaf_area_by_height(field)
    plot(out / "leaf_area.png", field.species, edges, area, SIDE * SIDE)
    print(json.dumps(labels))


if __name__ == "__main__":
    main()
