#!/usr/bin/env python3
"""Writes what docs/tutorial.md starts from: a valley with a road through it.

    make_valley.py [FOLDER]

valley.png   heightmap, 16 bits, 257 x 257 samples: black is the lowest place, white the highest
road.png     mask over it, 8 bits, 512 x 512 pixels: white is road, black is not
verge.png    another: white up to four metres beside the road
"""

import math
import struct
import sys
import zlib
from pathlib import Path

SIDE = 96.0     # [m]
LOW, HIGH = 0.0, 14.0


def write_png(path, side, rows, bits):
    """A square image of one channel. `rows` have numbers from 0 to 1."""
    most, code = (1 << bits) - 1, "B" if bits == 8 else "H"
    data = b"".join(b"\0" + struct.pack(f">{side}{code}", *(round(min(max(v, 0.0), 1.0) * most) for v in row))
                    for row in rows)

    def chunk(kind, content):
        return (struct.pack(">I", len(content)) + kind + content
                + struct.pack(">I", zlib.crc32(kind + content)))
    head = struct.pack(">IIBBBBB", side, side, bits, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(data, 9))
                     + chunk(b"IEND", b""))


def road_at(z):
    """The middle of the road [m] at a place along the valley."""
    return 9.0 * math.sin(z / 17.0) + 3.0 * math.sin(z / 7.0 + 1.0)


def from_road(x, z):
    """Distance to the middle of the road [m], nearly."""
    slope = 9.0 / 17.0 * math.cos(z / 17.0) + 3.0 / 7.0 * math.cos(z / 7.0 + 1.0)
    return abs(x - road_at(z)) / math.hypot(1.0, slope)


def height(x, z):
    """[m] Hills on both sides, and a level strip below the road."""
    hills = (5.0 + 2.2 * math.sin(x / 11.0 + 0.6) * math.cos(z / 13.0) + 0.8 * math.sin(x / 4.0 - z / 5.0)
             + 7.0 * (1.0 - math.exp(-((x - road_at(z)) / 30.0) ** 2)))
    strip = 4.0 + 0.012 * z
    t = min(max((from_road(x, z) - 2.5) / 6.0, 0.0), 1.0)
    return strip + (hills - strip) * t * t * (3.0 - 2.0 * t)


def grid(side, value):
    places = [(i / (side - 1) - 0.5) * SIDE for i in range(side)]
    return [[value(x, z) for x in places] for z in places]


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    write_png(folder / "valley.png", 257, grid(257, lambda x, z: (height(x, z) - LOW) / (HIGH - LOW)), 16)
    # The edge of the road is 60 cm wide, so that grass thins out there.
    write_png(folder / "road.png", 512, grid(512, lambda x, z: (1.9 - from_road(x, z)) / 0.6), 8)
    write_png(folder / "verge.png", 512, grid(512, lambda x, z: (6.0 - from_road(x, z)) / 2.0), 8)


if __name__ == "__main__":
    main()
