"""A reader of 3D Tiles 1.1 with implicit tiling, written from the specification. Whatever breaks a rule is an
error."""

import json
import struct
from pathlib import Path

import numpy


class Subtree:
    """One .subtree file: bits of tiles, contents and subtrees below."""

    def __init__(self, content, levels):
        magic, version, json_bytes, binary_bytes = struct.unpack_from("<4sIQQ", content)
        if (magic, version) != (b"subt", 1) or json_bytes % 8 or binary_bytes % 8:
            raise ValueError(f"header {magic} {version} {json_bytes} {binary_bytes}")
        if len(content) != 24 + json_bytes + binary_bytes:
            raise ValueError(f"{len(content)} bytes for {json_bytes} and {binary_bytes}")
        self.json = json.loads(content[24:24 + json_bytes])
        self.binary = content[24 + json_bytes:]
        (buffer,) = self.json["buffers"]
        if "uri" in buffer or buffer["byteLength"] > len(self.binary):
            raise ValueError(f"buffer {buffer}")
        tiles = (8 ** levels - 1) // 7
        self.tiles = self.bits("tileAvailability", tiles)
        (contents,) = self.json["contentAvailability"]
        self.contents = self.bits_of(contents, tiles)
        self.children = self.bits("childSubtreeAvailability", 8 ** levels)
        if (self.contents & ~self.tiles).any():
            raise ValueError("a content without its tile")

    def bits(self, name, count):
        return self.bits_of(self.json[name], count)

    def bits_of(self, availability, count):
        if "constant" in availability:
            return numpy.full(count, availability["constant"] == 1)
        view = self.json["bufferViews"][availability["bitstream"]]
        if view["byteOffset"] % 8 or view["byteLength"] != (count + 7) // 8:
            raise ValueError(f"a view {view} of {count} bits")
        stored = self.binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
        bits = numpy.unpackbits(numpy.frombuffer(stored, numpy.uint8), bitorder="little").astype(bool)
        if bits[count:].any() or bits[:count].sum() != availability["availableCount"]:
            raise ValueError(f"{bits.sum()} bits of {availability}")
        return bits[:count]


def morton(number):
    """Level-local x, y, z of a Morton number."""
    return tuple(sum((number >> (3 * bit + axis) & 1) << bit for bit in range(8)) for axis in range(3))


class Tileset:
    """tiles: by (level, x, y, z), the path of its content or None."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.json = json.loads((self.folder / "tileset.json").read_text(encoding="utf-8"))
        if self.json["asset"]["version"] != "1.1":
            raise ValueError(f"version {self.json['asset']['version']}")
        root = self.root = self.json["root"]
        tiling = root["implicitTiling"]
        if tiling["subdivisionScheme"] != "OCTREE" or root["refine"] != "REPLACE" or "children" in root:
            raise ValueError(f"root {root}")
        self.levels, self.subtree_levels = tiling["availableLevels"], tiling["subtreeLevels"]
        self.transform = numpy.array(root["transform"]).reshape(4, 4).T
        self.tiles, self.used = {}, {self.folder / "tileset.json"}
        self.read_subtree((0, 0, 0, 0))
        there = {path for path in self.folder.rglob("*") if path.is_file()}
        if there != self.used:
            raise ValueError(f"files that no tile has: {sorted(there - self.used)[:5]}")

    def path(self, template, tile):
        path = self.folder / template.format(**dict(zip(("level", "x", "y", "z"), tile)))
        self.used.add(path)
        return path

    def read_subtree(self, at):
        path = self.path(self.root["implicitTiling"]["subtrees"]["uri"], at)
        subtree = Subtree(path.read_bytes(), self.subtree_levels)
        if not subtree.tiles[0]:
            raise ValueError(f"{path}: its root is not there")

        def below(levels, number):
            return (at[0] + levels, *((at[axis + 1] << levels) + part for axis, part in enumerate(morton(number))))

        first = 0
        for level in range(self.subtree_levels):
            for number in range(8 ** level):
                if not subtree.tiles[first + number]:
                    continue
                tile = below(level, number)
                if tile[0] >= self.levels:
                    raise ValueError(f"tile {tile} of {self.levels} levels")
                if tile[0] > 0 and self.parent(tile) not in self.tiles:
                    raise ValueError(f"tile {tile} without its parent")
                has = subtree.contents[first + number]
                self.tiles[tile] = self.path(self.root["content"]["uri"], tile) if has else None
            first += 8 ** level
        for number in numpy.flatnonzero(subtree.children):
            self.read_subtree(below(self.subtree_levels, int(number)))

    @staticmethod
    def parent(tile):
        return (tile[0] - 1, *(x >> 1 for x in tile[1:]))

    def leaves(self):
        parents = {self.parent(tile) for tile in self.tiles if tile[0] > 0}
        return [tile for tile in self.tiles if tile not in parents]

    def box(self, tile):
        """Least and largest corner of a tile, in the axes of the tileset."""
        box = numpy.array(self.root["boundingVolume"]["box"])
        half = numpy.diag(box[3:].reshape(3, 3))
        if not numpy.array_equal(numpy.diag(half), box[3:].reshape(3, 3)):
            raise ValueError("the box is turned")
        size = 2.0 * half / 2 ** tile[0]
        low = box[:3] - half + size * numpy.array(tile[1:])
        return low, low + size

    def error(self, tile):
        return self.root["geometricError"] / 2 ** tile[0]


def z_up(places):
    """From the axes of glTF to those of 3D Tiles."""
    return numpy.stack([places[:, 0], -places[:, 2], places[:, 1]], axis=1)
