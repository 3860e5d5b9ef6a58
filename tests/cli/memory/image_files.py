"""Images and grids as bytes, sound or claiming more than they hold."""

import struct
import zlib


def chunk(name, data, length=None):
    body = name + data
    return struct.pack(">I", len(data) if length is None else length) + body + struct.pack(">I", zlib.crc32(body))


def png(width, height, pixels, depth=16, kind=0, interlaced=0, before=b""):
    """A PNG whose pixel data are `pixels`, compressed."""
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, interlaced)) +
            before + chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))


def ramp(width=33, height=33):
    return b"".join(b"\0" + b"".join(struct.pack(">H", 100 * (i + j)) for i in range(width)) for j in range(height))


def attribute(name, kind, data, size=None):
    return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data) if size is None else size) + data


def exr(width, height, more=b"", tile=None, compression=3, data=b""):
    """An OpenEXR image of one channel Y of floats, and what follows its header."""
    box = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = (attribute(b"channels", b"chlist", b"Y\0" + struct.pack("<iIii", 2, 0, 1, 1) + b"\0") +
              attribute(b"compression", b"compression", bytes([compression])) + attribute(b"dataWindow", b"box2i", box) +
              attribute(b"displayWindow", b"box2i", box) + attribute(b"lineOrder", b"lineOrder", b"\0") +
              attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
              attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)) +
              attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + more)
    if tile:
        header += attribute(b"tiles", b"tiledesc", struct.pack("<IIB", *tile, 0))
    return b"\x76\x2f\x31\x01" + struct.pack("<I", 2 | (0x200 if tile else 0)) + header + b"\0" + data


def bmp(width, height):
    return b"BM" + struct.pack("<IHHIIiiHHIIiiII", 54, 0, 0, 54, 40, width, height, 1, 24, 0, 0, 0, 0, 0, 0) + b"abc" * 20


def tga(width, height, packed=False):
    return struct.pack("<BBBHHBHHHHBB", 0, 0, 10 if packed else 2, 0, 0, 0, 0, 0, width, height, 24, 32) + b"\xff" + b"abc" * 20


def jpeg(width, height, progressive=False):
    """A JPEG with the tables that a decoder wants and hardly any pixel."""
    def segment(marker, data):
        return b"\xff" + bytes([marker]) + struct.pack(">H", len(data) + 2) + data
    tables = segment(0xdb, b"\0" + bytes([1] * 64))
    for kind in (0x00, 0x10):
        tables += segment(0xc4, bytes([kind, 1] + [0] * 15 + [0]))
    frame = segment(0xc2 if progressive else 0xc0, struct.pack(">BHHBBBB", 8, height, width, 1, 1, 0x11, 0))
    scan = segment(0xda, bytes([1, 1, 0, 0, 0 if progressive else 63, 0]))
    return b"\xff\xd8" + tables + frame + scan + b"\x2a" * 20 + b"\xff\xd9"


def asc(width, height):
    return f"ncols {width}\nnrows {height}\ncellsize 1\n1 2 3\n".encode("ascii")
