"""Reads the points of a binary little-endian PLY, by the format's description (Turk 1994)."""

import numpy

TYPES = {"char": "<i1", "uchar": "<u1", "short": "<i2", "ushort": "<u2", "int": "<i4",
         "uint": "<u4", "float": "<f4", "double": "<f8"}


def read_points(path):
    """A structured array with the properties as fields, and the header's lines."""
    content = path.read_bytes()
    header, end = b"\nend_header\n", content.index(b"\nend_header\n")
    lines = content[:end].decode("ascii").split("\n")
    if lines[:2] != ["ply", "format binary_little_endian 1.0"]:
        raise ValueError(f"the file begins with {lines[:2]}")
    fields, count = [], None
    for line in lines[2:]:
        words = line.split()
        if words[0] == "element" and words[1] == "vertex" and count is None:
            count = int(words[2])
        elif words[0] == "property" and count is not None:
            fields.append((words[2], TYPES[words[1]]))
        elif words[0] != "comment":
            raise ValueError(f"unexpected line {line!r}")
    kind = numpy.dtype(fields)
    body = content[end + len(header):]
    if len(body) != count * kind.itemsize:
        raise ValueError(f"{len(body)} bytes for {count} points of {kind.itemsize}")
    return numpy.frombuffer(body, kind), lines
