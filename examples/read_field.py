#!/usr/bin/env python3
"""Reads a field of grass (.sward) by its description alone: docs/field_format.md.

    read_field.py FIELD.sward              what is in it
    read_field.py FIELD.sward OUT.csv      one row for each blade, as `sward export` writes them

Needs numpy, and the shared libraries of zstd and xxHash (Debian: libzstd1, libxxhash0).
"""

import ctypes
import json
import sys
from pathlib import Path

import numpy as np

HEADER = np.dtype([("magic", "S8"), ("major", "<u2"), ("minor", "<u2"), ("mark", "<u4"),
                   ("bytes", "<u8"), ("chunks", "<u4"), ("zero", "<u4"), ("origin", "<f8", 3),
                   ("hash", "<u8")])
ENTRY = np.dtype([("name", "S8"), ("offset", "<u8"), ("stored", "<u8"), ("raw", "<u8"),
                  ("hash", "<u8"), ("flags", "<u4"), ("element", "<u4"), ("count", "<u8"),
                  ("zero", "<u8")])
PATCH = np.dtype([("bounds_low", "<f4", 3), ("first_blade", "<u4"), ("bounds_high", "<f4", 3),
                  ("blade_count", "<u4"), ("root_low", "<f4", 3), ("root_step", "<f4"),
                  ("cone_axis", "<f4", 3), ("cone_cosine", "<f4"), ("height_low", "<f4"),
                  ("height_step", "<f4"), ("width_low", "<f4"), ("width_step", "<f4"),
                  ("parent", "<u4"), ("first_child", "<u4"), ("child_count", "<u4"),
                  ("depth", "<u4"), ("rank_low", "<f4"), ("rank_high", "<f4")])
VERTEX = np.dtype([("position", "<f4", 3), ("normal", "<i2", 2), ("uv", "<f4", 2),
                   ("color", "u1", 4)])
MATERIAL = np.dtype([("color", "<f4", 4), ("roughness", "<f4"), ("metallic", "<f4"),
                     ("image", "<u4"), ("flags", "<u4")])
RANGE = np.dtype([("level", "<u4"), ("material", "<u4"), ("first", "<u4"), ("count", "<u4")])

# Chunks by name: what an element is, and whether the file must have it.
CHUNKS = {"PATCHES": (PATCH, True), "BLADES": (np.dtype(("<u4", 4)), True),
          "KEYS": (np.dtype(("<u4", 2)), False), "SPECIES": ("text", True),
          "GVERTICE": (VERTEX, False), "GINDICES": (np.dtype("<u4"), False),
          "GRANGES": (RANGE, False), "GMATERIA": (MATERIAL, False),
          "GIMAGES": (np.dtype("u1"), False), "DEFAULTS": ("text", True),
          "PROVENAN": ("text", False)}
CRITICAL, COMPRESSED = 1, 2

COLUMNS = ("id x y z ux uy uz facing height width stiffness species exposure "
           "tint_r tint_g tint_b clump patch").split()


class BadField(Exception):
    """The file is no field, or a damaged one."""


def require(condition, message):
    if not condition:
        raise BadField(message)


def xxh3(data):
    library = ctypes.CDLL("libxxhash.so.0")
    library.XXH3_64bits.restype = ctypes.c_uint64
    library.XXH3_64bits.argtypes = [ctypes.c_char_p, ctypes.c_size_t]
    return library.XXH3_64bits(data, len(data))


def zstd(data, raw_bytes):
    library = ctypes.CDLL("libzstd.so.1")
    library.ZSTD_decompress.restype = ctypes.c_size_t
    library.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t] * 2
    raw = ctypes.create_string_buffer(raw_bytes)
    require(library.ZSTD_decompress(raw, raw_bytes, data, len(data)) == raw_bytes,
            "a chunk cannot be decompressed")
    return raw.raw


def read_chunks(data):
    """The header, and the raw bytes of each chunk by name."""
    require(data[:8] == b"SWARD\r\n\x1a", "not a field file")
    require(len(data) >= HEADER.itemsize, "truncated")
    header = np.frombuffer(data, HEADER, 1)[0]
    require(header["mark"] == 0x01020304, "wrong byte order")
    require(header["major"] == 1, f"version {header['major']} is not known")
    require(header["bytes"] == len(data), f"{len(data)} bytes instead of {header['bytes']}")
    end = HEADER.itemsize + int(header["chunks"]) * ENTRY.itemsize
    require(0 < header["chunks"] <= 64 and end <= len(data), "the chunk table does not fit")
    require(xxh3(data[:56] + bytes(8) + data[64:end]) == header["hash"], "header is damaged")

    chunks = {}
    for entry in np.frombuffer(data, ENTRY, header["chunks"], HEADER.itemsize):
        name = entry["name"].decode("ascii").rstrip()
        start, stored, flags = (int(entry[key]) for key in ("offset", "stored", "flags"))
        require(start >= end and start - end < 64 and start % 64 == 0, f"{name} lies wrong")
        require(not any(data[end:start]), f"bytes before {name} are not zero")
        end = start + stored
        require(end <= len(data), f"{name} does not fit")
        content = data[start:end]
        require(xxh3(content) == entry["hash"], f"{name} is damaged")
        require(flags & ~(CRITICAL | COMPRESSED) == 0, f"{name} has unknown flags")
        require(name in CHUNKS or not flags & CRITICAL, f"{name} is critical and not known")
        require(entry["count"] * entry["element"] == entry["raw"], f"{name} has a wrong size")
        if flags & COMPRESSED:
            # First all first bytes, then all second bytes, …: back to elements.
            planes = np.frombuffer(zstd(content, int(entry["raw"])), "u1")
            content = planes.reshape(int(entry["element"]), int(entry["count"])).T.tobytes()
        require(len(content) == entry["raw"], f"{name} has a wrong size")
        chunks.setdefault(name, content)
    require(not any(data[end:]), "bytes behind the last chunk are not zero")
    return header, chunks


def read_field(path):
    """All of a field as arrays and JSON: a dictionary with "origin" and the names of CHUNKS."""
    header, chunks = read_chunks(Path(path).read_bytes())
    field = {"origin": header["origin"]}
    for name, (kind, required) in CHUNKS.items():
        require(name in chunks or not required, f"{name} is missing")
        if kind == "text":
            field[name] = json.loads(chunks.get(name, b"{}"))
        else:
            require(len(chunks.get(name, b"")) % kind.itemsize == 0, f"{name} has a wrong size")
            base, shape = kind.subdtype or (kind, ())
            field[name] = np.frombuffer(chunks.get(name, b""), base).reshape(-1, *shape)
    return field


def images(content):
    """The ground's images: rows, columns, RGBA."""
    result = []
    while len(content):
        width, height = (int(n) for n in content[:8].view("<u4"))
        result.append(content[8:8 + 4 * width * height].reshape(height, width, 4))
        content = content[8 + 4 * width * height:]
    return result


def octahedral(x, y):
    """Unit vectors of coordinates in [-1, 1]."""
    z = 1 - np.abs(x) - np.abs(y)
    sign = lambda n: np.where(n >= 0, 1, -1).astype(n.dtype)
    v = np.stack([np.where(z >= 0, x, (1 - np.abs(y)) * sign(x)),
                  np.where(z >= 0, y, (1 - np.abs(x)) * sign(y)), z], axis=1)
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def ids(keys):
    h = (keys[:, 0].astype("u8") << np.uint64(32) | keys[:, 1]) + np.uint64(0x9e3779b97f4a7c15)
    h = (h ^ h >> np.uint64(30)) * np.uint64(0xbf58476d1ce4e5b9)
    h = (h ^ h >> np.uint64(27)) * np.uint64(0x94d049bb133111eb)
    return (h ^ h >> np.uint64(31)) >> np.uint64(11)


def blades(field):
    """The blades with roots in plain numbers: a dictionary of COLUMNS, in the order of the file."""
    patches, packed = field["PATCHES"], field["BLADES"]
    patch = np.repeat(np.arange(len(patches)), patches["blade_count"])
    require(len(patch) == len(packed), "the patches do not cover the blades")
    own = patches[patch]
    bits = lambda word, low, count: (packed[:, word] >> low & ((1 << count) - 1)).astype("f4")

    steps = np.stack([bits(0, 0, 16), bits(0, 16, 16), bits(1, 0, 16)], axis=1)
    root = field["origin"] + (own["root_low"] + own["root_step"][:, None] * steps)
    up = octahedral((bits(1, 16, 8) - 127) / 127, (bits(1, 24, 8) - 127) / 127)
    table = {"id": ids(field["KEYS"]) if len(field["KEYS"]) else np.arange(len(packed)),
             "x": root[:, 0], "y": root[:, 1], "z": root[:, 2],
             "ux": up[:, 0], "uy": up[:, 1], "uz": up[:, 2],
             "facing": bits(2, 0, 8) * np.float32(2 * np.pi / 256),
             "height": own["height_low"] + own["height_step"] * bits(2, 8, 8),
             "width": own["width_low"] + own["width_step"] * bits(2, 16, 6),
             "stiffness": bits(2, 22, 6) / 63, "species": bits(3, 21, 3).astype("u4"),
             "exposure": bits(3, 16, 5) / 31, "tint_r": bits(3, 0, 5) / 31,
             "tint_g": bits(3, 5, 6) / 63, "tint_b": bits(3, 11, 5) / 31,
             "clump": bits(3, 24, 8).astype("u4"), "patch": patch}
    # Ribbons on the stalks of compound plants have no root of their own.
    plants = np.array(["organs" in species for species in field["SPECIES"]])
    rooted = (table["clump"] == 0) | ~plants[table["species"]]
    return {name: column[rooted] for name, column in table.items()}


def main(arguments):
    if len(arguments) not in (1, 2):
        sys.exit(__doc__)
    try:
        field = read_field(arguments[0])
        table = blades(field)
    except (BadField, OSError) as error:
        sys.exit(f"read_field.py: {arguments[0]}: {error}")
    if len(arguments) == 1:
        names = ", ".join(species["name"] for species in field["SPECIES"])
        print(f"{len(table['id'])} blades of {names} in {len(field['PATCHES'])} patches; ground of "
              f"{len(field['GINDICES']) // 3} triangles and {len(images(field['GIMAGES']))} images")
        return
    kinds = {"id": "%d", "species": "%d", "clump": "%d", "patch": "%d",
             "x": "%.9f", "y": "%.9f", "z": "%.9f"}
    with open(arguments[1], "x", encoding="ascii") as file:
        file.write(",".join(COLUMNS) + "\n")
        line = ",".join(kinds.get(name, "%.9g") for name in COLUMNS) + "\n"
        for row in zip(*(table[name].tolist() for name in COLUMNS)):
            file.write(line % row)


if __name__ == "__main__":
    main(sys.argv[1:])
