#!/usr/bin/env python3
"""Draws docs/images/sampling.png: roots of real bakes, read from their field files.

    docs/images/draw_sampling.py SWARD OUT.png

SWARD is the program. Nothing but Python's own library is needed. From the left: uniform roots;
Poisson disks; a quarter of four times as many Poisson disks in progressive order, as a distant field
is drawn; and a quarter chosen by chance, as it is not.
"""

import json
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

SIDE = 8.0  # [m] of the plane
SHOWN = 6.4  # [m] of it that a panel shows, off the borders
COUNT = 2000  # roots of the plane in every panel
PIXELS = 220  # of a panel
GAP = 10
RADIUS = 1.3  # [pixels] of a dot
PATCH = struct.Struct("<3fI3fI3ff3ff4f4I2f")


def bake(sward, folder, name, count, sampling):
    ground = Path(folder) / "plane.json"
    ground.write_text(json.dumps({"kind": "plane", "size": [SIDE, SIDE]}))
    field = Path(folder) / f"{name}.sward"
    subprocess.run([sward, "bake", ground, "-o", field, "-q", "--sky-rays", "0", "--seed", "1",
                    "--count", str(count), "--sampling", sampling], check=True)
    return field


def roots(field):
    """(x, z, rank, number) of every blade: docs/field_format.md."""
    data = field.read_bytes()
    chunks = {}
    for i in range(struct.unpack_from("<I", data, 24)[0]):
        name, offset, size = struct.unpack_from("<8sQQ", data, 64 + 64 * i)
        chunks[name.decode().strip()] = data[offset:offset + size]
    found = []
    for values in PATCH.iter_unpack(chunks["PATCHES"]):
        first, count, low, step, (rank, last) = values[3], values[7], values[8:11], values[11], values[-2:]
        for i in range(count):
            xy, z = struct.unpack_from("<II", chunks["BLADES"], 16 * (first + i))
            found.append((low[0] + step * (xy & 0xffff), low[2] + step * (z & 0xffff),
                          rank + (last - rank) * (i + 0.5) / count, first + i))
    return found


def panel(places):
    """Rows of grey values with a soft dot for every root."""
    grey = [[255.0] * PIXELS for _ in range(PIXELS)]
    for x, z in places:
        at = [PIXELS * (c / SHOWN + 0.5) for c in (x, z)]
        for j in range(int(at[1]) - 3, int(at[1]) + 4):
            for i in range(int(at[0]) - 3, int(at[0]) + 4):
                if 0 <= i < PIXELS and 0 <= j < PIXELS:
                    distance = ((i + 0.5 - at[0]) ** 2 + (j + 0.5 - at[1]) ** 2) ** 0.5
                    grey[j][i] *= 1.0 - min(max(RADIUS + 0.5 - distance, 0.0), 1.0) * 0.9
    return grey


def write_png(path, rows):
    def chunk(name, content):
        body = name + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))

    raw = b"".join(b"\0" + bytes(round(value) for value in row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 9))
                     + chunk(b"IEND", b""))


def main():
    sward, out = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        uniform = roots(bake(sward, folder, "uniform", COUNT, "uniform"))
        poisson = roots(bake(sward, folder, "poisson", COUNT, "poisson"))
        dense = roots(bake(sward, folder, "dense", 4 * COUNT, "poisson"))
    chosen = (uniform, poisson, [root for root in dense if root[2] < 0.25],
              [root for root in dense if root[3] * 0x9e3779b1 >> 7 & 3 == 0])
    panels = [panel([root[:2] for root in each]) for each in chosen]
    for name, each in zip(("uniform", "poisson", "prefix", "chance"), chosen):
        print(f"{name}: {len(each)} roots")
    gap = [225.0] * GAP
    write_png(Path(out), [sum(([*each[j], *gap] for each in panels), [])[:-GAP] for j in range(PIXELS)])


main()
