"""Light of a picture without any package: PNG with 8 bits of red, green and blue, as `sward-view` writes it."""

import struct
import zlib
from collections import Counter


def linear(code):
    """Of an sRGB value of 8 bits (IEC 61966-2-1), in [0, 1]."""
    value = code / 255.0
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


LINEAR = [linear(code) for code in range(256)]


def rows(path):
    """The picture's rows, each bytes r g b r g b …"""
    data = path.read_bytes()
    place, packed, width, height = 8, b"", 0, 0
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        chunk = data[place + 8:place + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlace = struct.unpack(">IIBBBBB", chunk)
            if (depth, color, interlace) != (8, 2, 0):
                raise ValueError(f"{path}: {depth} bits, colour type {color}, interlace {interlace}; expected 8, 2, 0")
        elif kind == b"IDAT":
            packed += chunk
        place += 12 + length
    raw, stride = zlib.decompress(packed), 3 * width
    before = bytearray(stride)
    for y in range(height):
        begin = y * (stride + 1)
        row = bytearray(raw[begin + 1:begin + 1 + stride])
        unfilter(raw[begin], row, before)
        yield row
        before = row


def unfilter(kind, row, before):
    """PNG 1.2, section 6, for three bytes a pixel."""
    if kind == 1:
        for i in range(3, len(row)):
            row[i] = (row[i] + row[i - 3]) & 255
    elif kind == 2:
        for i, up in enumerate(before):
            row[i] = (row[i] + up) & 255
    elif kind == 3:
        for i, up in enumerate(before):
            row[i] = (row[i] + ((row[i - 3] if i > 2 else 0) + up >> 1)) & 255
    elif kind == 4:
        for i, b in enumerate(before):
            a, c = (row[i - 3], before[i - 3]) if i > 2 else (0, 0)
            toA, toB, toC = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            row[i] = (row[i] + (a if toA <= toB and toA <= toC else b if toB <= toC else c)) & 255


def mean_light(path):
    """Mean of red, green and blue over the picture, in linear light."""
    counts, pixels = [Counter(), Counter(), Counter()], 0
    for row in rows(path):
        pixels += len(row) // 3
        for channel in range(3):
            counts[channel].update(row[channel::3])
    return [sum(LINEAR[code] * count for code, count in counter.items()) / pixels for counter in counts]
