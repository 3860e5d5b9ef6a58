"""Field, and what makes and compares fields."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Optional, Union

import numpy

from . import _native
from ._arrays import plain
from ._options import Options

GROWTH_OPTIONS = Options("grow", _native.growth_options(), {})


class Comparison(dict):
    """Result of compare(): numbers by name, as docs/cli.md explains them; lengths in metres, angles in radians."""

    @property
    def same(self) -> bool:
        """Whether nothing differs beyond the tolerance and the errors of packing."""
        return not self["reasons"]


class Field:
    """A baked field: a mapped file, or one in memory. sward.read() and sward.bake() make it.

    Arrays over the field's memory are read-only and copied nowhere; they keep the field alive.
    """

    def __init__(self, native: Any) -> None:
        if not isinstance(native, _native.Field):
            raise TypeError("sward.read() and sward.bake() make fields")
        self._native = native

    def __len__(self) -> int:
        """Number of blades, the ribbons of compound plants included."""
        return self._native.count

    def __repr__(self) -> str:
        kind = "file" if self.is_mapped else "in memory"
        return f"<sward.Field {self.name!r}, {kind}: {len(self)} blades>"

    @property
    def name(self) -> str:
        """The file, or what the field was baked of."""
        return self._native.name

    @property
    def is_mapped(self) -> bool:
        """Whether the field is a mapped file."""
        return self._native.is_mapped

    @property
    def file_bytes(self) -> int:
        """Bytes of the file that the field is, or would be."""
        return self._native.file_bytes

    @property
    def report(self) -> Optional[dict]:
        """The report of the bake that made this object; None if it was read."""
        return json.loads(self._native.report) if self._native.report else None

    @property
    def provenance(self) -> dict:
        """Program, hash of the ground, and settings of the bake."""
        return json.loads(self._native.provenance)

    @property
    def copyright(self) -> str:
        """Of the ground's author."""
        return self._native.copyright

    @property
    def origin(self) -> numpy.ndarray:
        """(3,) float64 [m]: a place in the world is origin + position; a multiple of 32 m."""
        return numpy.array(self._native.origin)

    @property
    def bounds(self) -> numpy.ndarray:
        """(2, 3) float64 [m]: lowest and highest corner of everything visible, in the world; NaN if nothing is."""
        bounds = self._native.bounds
        return numpy.array(bounds).reshape(2, 3) if bounds else numpy.full((2, 3), numpy.nan)

    @property
    def species(self) -> list:
        """Names of the species; Field.blades()["species"] is an index into it."""
        return list(self._native.species)

    @property
    def has_seeds(self) -> bool:
        """Whether most blades are not stored but grow from seeds; see grow()."""
        return self._native.has_seeds

    @property
    def packed(self) -> numpy.ndarray:
        """(n,) view of the packed blades, 16 bytes each: root_xy, root_z_up, shape, look, as docs/field_format.md says."""
        return _native.packed(self._native)

    @property
    def patches(self) -> numpy.ndarray:
        """(p,) view of the patch tree, 104 bytes each; [0] is its root. Lengths [m] are relative to the origin."""
        return _native.patches(self._native)

    @property
    def keys(self) -> numpy.ndarray:
        """(n,) view of where each blade is from: triangle of the input, and the candidate's number on it."""
        return _native.keys(self._native)

    def blades(self, first: int = 0, count: Optional[int] = None) -> numpy.ndarray:
        """Blades `first` to `first + count` in file order, unpacked into a new structured array.

        id: uint64, the same in all exports. root: (3,) float64 [m], in the world. up: (3,) unit direction of growth.
        facing: [rad] turn of the width axis about it. height, width: [m], full width at the root. area: [m²] of one
        side. stiffness, exposure: [0, 1]. tint: (3,) sRGB colour of the ground in [0, 1]. rank: [0, 1), place in the
        progressive order. patch: index into `patches`. species: index into `species`. clump: 0 to 255, 255: dead.
        ribbon: whether it is a leaf or petal on the stalk of a compound plant.
        """
        return self._native.unpacked(*self._range(first, count))

    def curves(self, first: int = 0, count: Optional[int] = None) -> numpy.ndarray:
        """(count, 3, 3) float64 [m]: the Bézier points v0, v1, v2 of blades at rest in still air, in the world."""
        return self._native.curves(*self._range(first, count))

    def _range(self, first: int, count: Optional[int]) -> tuple:
        if first < 0 or (count is not None and count < 0):
            raise ValueError(f"blades {first} and {count} more: neither may be below 0")
        return first, max(len(self) - first, 0) if count is None else count

    def info(self, histograms: bool = False) -> dict:
        """What `sward info --json` prints, with `histograms` also what --histogram adds."""
        return json.loads(self._native.info(histograms))

    def save(self, path: Union[str, os.PathLike[str]], force: bool = False) -> None:
        """Writes a field in memory as a file, whole or not at all. `force`: over an existing one."""
        self._native.save(os.fspath(path), force)

    def export(self, path: Union[str, os.PathLike[str]], with_ground: bool = False, force: bool = False,
               progress: Optional[Callable[[float, str], None]] = None) -> None:
        """Writes .glb, .ply, .usda or .csv, by the extension: `sward export`. `with_ground`: in a .glb."""
        self._native.export(os.fspath(path), with_ground, force, f"sward {_native.version}", progress)

    def grow(self, *, threads: int = 0, progress: Optional[Callable[[float, str], None]] = None,
             **options: Any) -> Field:
        """The field that grows from the seeds of this one, in memory: `sward grow`.

        threads: 0 for one on each CPU; the field does not depend on it.
        """
        return Field(self._native.grow(GROWTH_OPTIONS.arguments(options), threads, progress))


GROWTH_OPTIONS.document(Field.grow)


def read(path: Union[str, os.PathLike[str]]) -> Field:
    """Maps a field file and verifies all of it, as every reader of Sward does. Raises sward.Error."""
    return Field(_native.read(os.fspath(path)))


def validate(path: Union[str, os.PathLike[str]]) -> Field:
    """Verifies every byte of a field file, cells of seeds too, and returns it: `sward validate`. Raises sward.Error."""
    field = read(path)
    field._native.validate_seeds()
    return field


def compare(first: Union[str, os.PathLike[str], Field], second: Union[str, os.PathLike[str], Field], *,
            transform: Any = None, match: Optional[str] = None, tolerance: float = 1e-3) -> Comparison:
    """Compares fields blade by blade: `sward compare`.

    transform: applied to the first: a (4, 4) or (3, 3) array, or a dict of rotation (x, y, z, w), translation [m] and
    scale. match: "order" or "id"; by default id if both have ids. tolerance: [m] between two roots.
    """
    if match not in (None, "order", "id"):
        raise ValueError(f"match is {match!r}, neither 'order' nor 'id'")
    if not tolerance >= 0:
        raise ValueError(f"tolerance is {tolerance}; it is 0 or more")
    text = "" if transform is None else json.dumps(transform, default=plain)
    fields = [one if isinstance(one, Field) else read(one) for one in (first, second)]
    return Comparison(_native.compare(fields[0]._native, fields[1]._native, text, match or "", tolerance))
