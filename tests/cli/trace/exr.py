"""Reads OpenEXR files of scan lines with ZIP compression, as `sward trace` writes them ("OpenEXR File Layout",
openexr.com)."""

import struct
import zlib

FORMATS = {0: "I", 1: "e", 2: "f"}
LINES = {2: 1, 3: 16}


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header_of(data):
    """The attributes, and where they end."""
    assert data[:4] == bytes((0x76, 0x2f, 0x31, 0x01)), "an EXR file"
    at, header = 8, {}
    while data[at] != 0:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        size, = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return header, at + 1


def channels_of(packed):
    at, channels = 0, []
    while packed[at] != 0:
        name, at = text_at(packed, at)
        channels.append((name, FORMATS[struct.unpack_from("<i", packed, at)[0]]))
        at += 16
    return channels


def unzipped(block, size):
    """A block of scan lines: deltas of bytes, first those at even places, then those at odd ones."""
    if len(block) == size:
        return block
    deltas = bytearray(zlib.decompress(block))
    for i in range(1, len(deltas)):
        deltas[i] = (deltas[i - 1] + deltas[i] - 128) & 255
    joined = bytearray(len(deltas))
    half = (len(deltas) + 1) // 2
    joined[0::2], joined[1::2] = deltas[:half], deltas[half:]
    return bytes(joined)


def read_exr(path):
    """Size of the picture, and the numbers of each channel, row after row from the top."""
    data = path.read_bytes()
    header, at = header_of(data)
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    lines = LINES[header["compression"][0]]
    channels = channels_of(header["channels"])
    row_bytes = sum(struct.calcsize(kind) for _, kind in channels) * width
    at += 8 * -(-height // lines)
    pixels = {name: [] for name, _ in channels}
    for first in range(0, height, lines):
        rows = min(lines, height - first)
        _, size = struct.unpack_from("<ii", data, at)
        block = unzipped(data[at + 8:at + 8 + size], rows * row_bytes)
        at += 8 + size
        place = 0
        for _ in range(rows):
            for name, kind in channels:
                form = f"<{width}{kind}"
                pixels[name] += struct.unpack_from(form, block, place)
                place += struct.calcsize(form)
    return (width, height), pixels
