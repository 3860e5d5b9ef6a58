"""Pictures as linear light in NumPy arrays of height × width × 3: EXR files, and PNG files by sRGB's curve."""

import struct
import zlib
from pathlib import Path

import numpy as np

import exr_light
import png_light

# Colours of errors from 0 to 1: five points of a scale from black over violet and orange to pale yellow.
SCALE = np.array([[0, 0, 4], [81, 18, 124], [183, 55, 121], [252, 137, 97], [252, 253, 191]], float)


def read(path, layer=""):
    """Linear light of a picture. `layer`: of an EXR file, as in "ViewLayer.Combined_sun"."""
    path = Path(path)
    if path.suffix == ".exr":
        try:
            return exr_light.color(exr_light.read(path), layer)
        except ValueError as error:
            raise ValueError(str(error) if str(path) in str(error) else f"{path}: {error}") from error
    return np.array(png_light.LINEAR)[codes(path)]


def codes(path):
    """The 8-bit red, green and blue of a PNG file."""
    try:
        rows = np.stack([np.frombuffer(bytes(row), np.uint8) for row in png_light.rows(Path(path))])
    except (struct.error, zlib.error, IndexError, ValueError) as error:
        raise ValueError(f"{path}: not a PNG file of 8-bit colour, or a damaged one") from error
    return rows.reshape(rows.shape[0], -1, 3)


def encoded(linear):
    """8-bit sRGB of linear light."""
    linear = np.clip(linear, 0.0, 1.0)
    code = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
    return (255.0 * code + 0.5).astype(np.uint8)


def write_png(path, codes):
    """8-bit red, green and blue."""
    height, width, _ = codes.shape
    raw = np.concatenate([np.zeros((height, 1), np.uint8), codes.reshape(height, 3 * width)], axis=1).tobytes()
    content = b"\x89PNG\r\n\x1a\n"
    for kind, part in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(raw)),
                       (b"IEND", b"")):
        content += struct.pack(">I", len(part)) + kind + part + struct.pack(">I", zlib.crc32(kind + part))
    Path(path).write_bytes(content)


def write_errors(path, errors):
    """Errors in [0, 1] as colours, the larger the paler."""
    at = np.clip(errors, 0.0, 1.0) * (len(SCALE) - 1)
    low = np.minimum(at.astype(int), len(SCALE) - 2)
    share = (at - low)[..., None]
    write_png(path, ((1.0 - share) * SCALE[low] + share * SCALE[low + 1] + 0.5).astype(np.uint8))
