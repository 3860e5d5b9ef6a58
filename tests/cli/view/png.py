"""Reads the PNG files that the viewer writes, with NumPy alone."""

import struct
import zlib

import numpy as np


def picture_of(path):
    """The colours of an 8-bit PNG as whole numbers, height × width × 3; rows may have any of the five filters."""
    data = path.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    channels = {2: 3, 6: 4}[data[25]]
    packed, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * channels)
    kinds = lines[:, 0]
    differences = lines[:, 1:].reshape(height, width, channels).astype(np.int32)
    # A border of zeros above and to the left. A pixel needs those above, to the left and between them: all
    # pixels of one diagonal are known at once.
    found = np.zeros((height + 1, width + 1, channels), np.int32)
    for diagonal in range(height + width - 1):
        y = np.arange(max(0, diagonal - width + 1), min(height, diagonal + 1))
        x = diagonal - y
        left, above, corner = found[y + 1, x], found[y, x + 1], found[y, x]
        p = left + above - corner
        from_left, from_above, from_corner = abs(p - left), abs(p - above), abs(p - corner)
        paeth = np.where((from_left <= from_above) & (from_left <= from_corner), left,
                         np.where(from_above <= from_corner, above, corner))
        predicted = np.choose(kinds[y][:, None], (0, left, above, (left + above) // 2, paeth))
        found[y + 1, x + 1] = (differences[y, x] + predicted) & 255
    return found[1:, 1:, :3]


def pixels_of(path):
    """All pixels, row by row, as an array with 3 columns."""
    return picture_of(path).reshape(-1, 3)


def mean_of(path):
    """Mean red, green and blue of the bytes."""
    return pixels_of(path).mean(axis=0).tolist()


def linear_mean_of(path):
    """Mean red, green and blue of the light that the bytes stand for (sRGB), 0 to 1."""
    light = np.array([(i / 255 / 12.92) if i < 11 else ((i / 255 + 0.055) / 1.055) ** 2.4 for i in range(256)])
    return light[pixels_of(path)].mean(axis=0).tolist()
