"""Light of a picture in OpenEXR as NumPy arrays: scan lines of one part, uncompressed or by RLE, ZIP or ZIPS.

No package suits: Debian 12 has no python3-openexr, and python3-openimageio brings 66 packages. What sward-view, sward and
Blender write with these compressions is read; other files fail with a reason. Format: "OpenEXR File Layout", openexr.com.
"""

import struct
import zlib
from pathlib import Path

import numpy as np

KINDS = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}
LINES = {0: 1, 1: 1, 2: 1, 3: 16}  # scan lines in a block, by compression
COMPRESSIONS = ("none", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A", "DWAA", "DWAB")


def text_at(content, place):
    end = content.index(b"\0", place)
    return content[place:end].decode("utf-8"), end + 1


def attributes(content, path):
    """The header's attributes as bytes, and where it ends."""
    if content[:4] != b"v/1\x01":
        raise ValueError(f"{path}: not an OpenEXR file")
    flags = struct.unpack_from("<I", content, 4)[0] >> 8
    if flags & ~4:  # long names are fine
        raise ValueError(f"{path}: tiles, deep data or several parts; expected scan lines of one part")
    place, found = 8, {}
    while content[place]:
        name, place = text_at(content, place)
        _, place = text_at(content, place)
        length = struct.unpack_from("<i", content, place)[0]
        found[name] = content[place + 4:place + 4 + length]
        place += 4 + length
    return found, place + 1


def channel_list(packed, path):
    """Names and types of the channels in the order of the file."""
    place, found = 0, []
    while packed[place]:
        name, place = text_at(packed, place)
        kind, _, step_x, step_y = struct.unpack_from("<iB3xii", packed, place)
        if kind not in KINDS or (step_x, step_y) != (1, 1):
            raise ValueError(f"{path}: channel {name} has type {kind}, steps {step_x} and {step_y}; expected 0 to 2, 1 and 1")
        found.append((name, KINDS[kind]))
        place += 16
    return found


def unpacked_runs(packed):
    """Run lengths: n ≥ 0 repeats the next byte n + 1 times, n < 0 copies −n bytes."""
    result, place = bytearray(), 0
    while place < len(packed):
        count = struct.unpack_from("b", packed, place)[0]
        if count < 0:
            result += packed[place + 1:place + 1 - count]
            place += 1 - count
        else:
            result += packed[place + 1:place + 2] * (count + 1)
            place += 2
    return bytes(result)


def joined(packed):
    """Undoes the differences between bytes and the split into even and odd ones."""
    values = np.frombuffer(packed, np.uint8).astype(np.int64)
    values[1:] -= 128
    values = np.cumsum(values).astype(np.uint8)
    result = np.empty_like(values)
    half = (len(values) + 1) // 2
    result[0::2], result[1::2] = values[:half], values[half:]
    return result.tobytes()


def read(path):
    """{channel: array of height × width}; layers are in the names, as in "ViewLayer.Combined_sun.R"."""
    content = Path(path).read_bytes()
    try:
        return read_content(content, path)
    except (struct.error, IndexError, KeyError, zlib.error) as error:
        raise ValueError(f"{path}: damaged or cut off") from error


def read_content(content, path):
    header, place = attributes(content, path)
    channels = channel_list(header["channels"], path)
    compression = header["compression"][0]
    if compression not in LINES:
        name = COMPRESSIONS[compression] if compression < len(COMPRESSIONS) else compression
        raise ValueError(f"{path}: compression {name}; expected none, RLE, ZIPS or ZIP")
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    result = {name: np.empty((height, width), kind) for name, kind in channels}
    line_bytes = width * sum(kind.itemsize for _, kind in channels)
    blocks = -(-height // LINES[compression])
    for offset in struct.unpack_from(f"<{blocks}Q", content, place):
        first, size = struct.unpack_from("<ii", content, offset)
        row = first - top
        rows = min(LINES[compression], height - row)
        block = content[offset + 8:offset + 8 + size]
        if len(block) < rows * line_bytes and compression:
            block = joined(unpacked_runs(block) if compression == 1 else zlib.decompress(block))
        if len(block) != rows * line_bytes:
            raise ValueError(f"{path}: damaged or cut off")
        at = 0
        for y in range(row, row + rows):
            for name, kind in channels:
                result[name][y] = np.frombuffer(block, kind, width, at)
                at += width * kind.itemsize
    return result


def color(channels, layer=""):
    """Red, green and blue of a layer as height × width × 3; "" is the layer without a name."""
    names = [f"{layer}.{letter}" if layer else letter for letter in "RGB"]
    missing = [name for name in names if name not in channels]
    if missing:
        raise ValueError(f"no channel {missing[0]}; there are {', '.join(sorted(channels))}")
    return np.stack([channels[name].astype(float) for name in names], axis=-1)


def write(path, channels):
    """Writes {channel: array} as floats, uncompressed."""
    names = sorted(channels)
    height, width = channels[names[0]].shape
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    listed = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in names) + b"\0"
    header = b"v/1\x01" + struct.pack("<I", 2 | (4 << 8 if max(map(len, names)) > 31 else 0))
    for name, kind, value in (("channels", "chlist", listed), ("compression", "compression", b"\0"),
                              ("dataWindow", "box2i", window), ("displayWindow", "box2i", window),
                              ("lineOrder", "lineOrder", b"\0"), ("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
                              ("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0)),
                              ("screenWindowWidth", "float", struct.pack("<f", 1.0))):
        header += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    line = 4 * width * len(names)
    first = len(header) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * (8 + line)) for y in range(height))
    table = np.stack([np.asarray(channels[name], "<f4") for name in names], axis=1)  # height, channel, width
    rows = b"".join(struct.pack("<ii", y, line) + table[y].tobytes() for y in range(height))
    Path(path).write_bytes(header + offsets + rows)
