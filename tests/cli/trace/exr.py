"""Reads OpenEXR files of scan lines with ZIP compression, as `sward trace` writes them ("OpenEXR File Layout",
openexr.com)."""

import struct
import zlib

FORMATS = {0: "I", 1: "e", 2: "f"}
LINES = {0: 1, 2: 1, 3: 16}


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header_of(data, at=8):
    """The attributes, and where they end."""
    assert data[:4] == bytes((0x76, 0x2f, 0x31, 0x01)), "an EXR file"
    header = {}
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


def rows_of(block, rows, width, channels, pixels):
    """Adds the numbers of a block of scan lines to those of each channel."""
    place = 0
    for _ in range(rows):
        for name, kind in channels:
            form = f"<{width}{kind}"
            pixels[name] += struct.unpack_from(form, block, place)
            place += struct.calcsize(form)


class Part:
    """A picture of a file: the numbers of each channel, row after row from the top."""

    def __init__(self, header):
        left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
        self.name = header["name"].decode() if "name" in header else ""
        self.width, self.height = right - left + 1, bottom - top + 1
        self.lines = LINES[header["compression"][0]]
        self.channels = channels_of(header["channels"])
        self.blocks = -(-self.height // self.lines)
        self.pixels = {name: [] for name, _ in self.channels}

    def add(self, data, at):
        """Reads the block at a place; returns where it ends."""
        first, size = struct.unpack_from("<ii", data, at)
        rows = min(self.lines, self.height - first)
        row_bytes = sum(struct.calcsize(kind) for _, kind in self.channels) * self.width
        block = unzipped(data[at + 8:at + 8 + size], rows * row_bytes)
        rows_of(block, rows, self.width, self.channels, self.pixels)
        return at + 8 + size


def read_exr(path):
    """Size of the picture, and the numbers of each channel, row after row from the top."""
    data = path.read_bytes()
    header, at = header_of(data)
    part = Part(header)
    at += 8 * part.blocks
    for _ in range(part.blocks):
        at = part.add(data, at)
    return (part.width, part.height), part.pixels


def read_parts(path):
    """The same of a file of several pictures, by the names of these."""
    data = path.read_bytes()
    assert data[5] & 0x10, "a file of several parts"
    parts, at = [], 8
    while data[at] != 0:
        header, at = header_of(data, at)
        parts.append(Part(header))
    at += 1 + 8 * sum(part.blocks for part in parts)
    for _ in range(sum(part.blocks for part in parts)):
        number, = struct.unpack_from("<i", data, at)
        at = parts[number].add(data, at + 4)
    return {part.name: ((part.width, part.height), part.pixels) for part in parts}
