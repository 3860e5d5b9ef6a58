"""Reads the PNG files that the viewer writes, without a package for it."""

import struct
import zlib


def rows_of(path):
    """The rows of an 8-bit PNG, of (r, g, b) or (r, g, b, a) bytes; rows may have any of the five filters.
    Returns (channels, rows)."""
    data = path.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    channels = {2: 3, 6: 4}[data[25]]
    packed, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, stride = zlib.decompress(packed), width * channels
    above, rows = bytearray(stride), []
    for y in range(height):
        start = y * (stride + 1)
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            p = left + above[i] - corner
            paeth = min((abs(p - left), 0, left), (abs(p - above[i]), 1, above[i]),
                        (abs(p - corner), 2, corner))[2]
            row[i] = (row[i] + (0, left, above[i], (left + above[i]) // 2, paeth)[kind]) & 255
        rows.append(row)
        above = row
    return channels, rows


def pixels_of(path):
    """All pixels as (r, g, b), row by row."""
    channels, rows = rows_of(path)
    return [tuple(row[i:i + 3]) for row in rows for i in range(0, len(row), channels)]


def mean_of(path):
    """Mean red, green and blue of the bytes."""
    pixels = pixels_of(path)
    return [sum(pixel[c] for pixel in pixels) / len(pixels) for c in range(3)]


def linear_mean_of(path):
    """Mean red, green and blue of the light that the bytes stand for (sRGB), 0 to 1."""
    light = [(i / 255 / 12.92) if i < 11 else ((i / 255 + 0.055) / 1.055) ** 2.4 for i in range(256)]
    pixels = pixels_of(path)
    return [sum(light[pixel[c]] for pixel in pixels) / len(pixels) for c in range(3)]
