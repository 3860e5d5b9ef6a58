"""Field, and what makes and compares fields."""

from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Callable, Optional, Union

import numpy

from . import _native
from ._errors import Error
from ._options import Options
from ._texts import arguments_bytes, callback, json_text, number, path_bytes, text_of_bytes, whole

GROWTH_OPTIONS = Options("grow", _native.growth_options(), {})
MOST_THREADS = 1024


class Comparison(dict):
    """Result of compare(): numbers by name, as docs/cli.md explains them; lengths in metres, angles in radians."""

    @property
    def same(self) -> bool:
        """Whether nothing differs beyond the tolerance and the errors of packing."""
        return not self["reasons"]


class Field:
    """A baked field: a mapped file, or one in memory. sward.read() and sward.bake() make it.

    Arrays over the field's memory are read-only and copied nowhere; they keep the field alive. A mapped field pickles
    as the path of its file, which must then hold the same field; one in memory as its bytes.
    """

    def __init__(self, native: Any, mark: Optional[tuple] = None) -> None:
        if not isinstance(native, _native.Field):
            raise TypeError("sward.read() and sward.bake() make fields")
        self._held = native  # reads no page of the file by itself
        self._path = os.path.abspath(text_of_bytes(native.name)) if native.is_mapped else ""
        self._stamp, self._hash = mark or (mark_of(self._path) if native.is_mapped else (None, b""))

    @property
    def _native(self) -> Any:
        """The native field. sward.Error if its file has been written to: its pages may be any bytes, or gone."""
        if self._stamp is not None:
            now = stamp_of(self._path)
            if now is not None and now[:2] == self._stamp[:2] and now != self._stamp:
                raise Error(f"{self.name}: has been written to in place since it was read; a new file must replace it "
                            "by renaming, and read() with copy=True maps none", "io", 2)
        return self._held

    def __len__(self) -> int:
        """Number of blades, the ribbons of compound plants included."""
        return self._held.count

    def __copy__(self) -> Field:
        return self

    def __deepcopy__(self, memo: dict) -> Field:
        return self  # it never changes

    def __reduce__(self) -> tuple:
        report = self._held.report
        if self._stamp is not None:
            return reopened, (self._path, self._hash, report)
        with tempfile.TemporaryDirectory(prefix="sward-") as folder:
            path = os.path.join(folder, "field.sward")
            self._held.save(path_bytes(path), False)
            with open(path, "rb") as file:
                return unpickled, (file.read(), self._held.name, report)

    def __repr__(self) -> str:
        kind = "file" if self.is_mapped else "in memory"
        return f"<sward.Field {self.name!r}, {kind}: {len(self)} blades>"

    @property
    def name(self) -> str:
        """The file, or what the field was baked of."""
        return text_of_bytes(self._held.name)

    @property
    def is_mapped(self) -> bool:
        """Whether the field is a mapped file."""
        return self._held.is_mapped

    @property
    def file_bytes(self) -> int:
        """Bytes of the file that the field is, or would be."""
        return self._held.file_bytes

    @property
    def report(self) -> Optional[dict]:
        """The report of the bake that made this object; None if it was read."""
        return json.loads(self._held.report) if self._held.report else None

    @property
    def provenance(self) -> dict:
        """Program, hash of the ground, and settings of the bake."""
        return json.loads(self._held.provenance)

    @property
    def copyright(self) -> str:
        """Of the ground's author."""
        return self._held.copyright

    @property
    def origin(self) -> numpy.ndarray:
        """(3,) float64 [m]: a place in the world is origin + position; a multiple of 32 m."""
        return numpy.array(self._held.origin)

    @property
    def bounds(self) -> numpy.ndarray:
        """(2, 3) float64 [m]: lowest and highest corner of everything visible, in the world; NaN if nothing is."""
        bounds = self._native.bounds
        return numpy.array(bounds).reshape(2, 3) if bounds else numpy.full((2, 3), numpy.nan)

    @property
    def species(self) -> list:
        """Names of the species; Field.blades()["species"] is an index into it."""
        return list(self._held.species)

    @property
    def has_seeds(self) -> bool:
        """Whether most blades are not stored but grow from seeds; see grow()."""
        return self._held.has_seeds

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
        first = whole("first", first)
        count = max(len(self) - first, 0) if count is None else whole("count", count)
        if first < 0 or count < 0:
            raise ValueError(f"blades {first} and {count} more: neither may be below 0")
        if first + count > len(self):
            raise Error(f"{self.name}: blades {first} to {first + count} are asked for, and it has {len(self)}")
        return first, count

    def info(self, histograms: bool = False) -> dict:
        """What `sward info --json` prints, with `histograms` also what --histogram adds."""
        return json.loads(self._native.info(histograms))

    def save(self, path: Union[str, os.PathLike[str]], force: bool = False) -> None:
        """Writes a field in memory as a file, whole or not at all. `force`: over an existing one."""
        self._native.save(path_bytes(path), force)

    def export(self, path: Union[str, os.PathLike[str]], with_ground: bool = False, force: bool = False,
               progress: Optional[Callable[[float, str], None]] = None) -> None:
        """Writes .glb, .ply, .usda or .csv, by the extension: `sward export`. `with_ground`: in a .glb."""
        self._native.export(path_bytes(path), with_ground, force, f"sward {_native.version}", callback(progress))

    def grow(self, *, threads: int = 0, progress: Optional[Callable[[float, str], None]] = None,
             **options: Any) -> Field:
        """The field that grows from the seeds of this one, in memory: `sward grow`.

        threads: 0 for one on each CPU; the field does not depend on it. around: (x, y, z, radius) [m]. region: ((x0, x1),
        (z0, z1)) [m]. Both also as texts.
        """
        arguments = arguments_bytes(GROWTH_OPTIONS.arguments(options))
        if not 0 <= whole("threads", threads) <= MOST_THREADS:
            raise ValueError(f"threads is {threads}; it is 0 to {MOST_THREADS}")
        return Field(self._native.grow(arguments, whole("threads", threads), callback(progress)))


GROWTH_OPTIONS.document(Field.grow)


def read(path: Union[str, os.PathLike[str]], *, copy: bool = False) -> Field:
    """Maps a field file and verifies all of it, as every reader of Sward does. Raises sward.Error.

    copy: reads the file into memory instead, for files that others write to in place. A mapped file must only be
    replaced by renaming, as all programs of Sward do.
    """
    name = path_bytes(path)
    mark = None if copy else mark_of(name)
    return Field(_native.read(name, bool(copy)), mark)


def stamp_of(path: Union[str, bytes]) -> Optional[tuple]:
    """What tells whether a file has been written to: device and number of the file, bytes, time. None without a file."""
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns


def mark_of(path: Union[str, bytes]) -> tuple:
    """(stamp, hash) of a field's file: the hash is that of the header and of the hashes of all chunks, as it stores it."""
    try:
        with open(path, "rb") as file:
            return stamp_of(path), file.read(64)[56:]
    except OSError:
        return None, b""


def field_of(field: Union[str, os.PathLike[str], Field]) -> Field:
    """The field, or that of a path."""
    return field if isinstance(field, Field) else read(field)


def reopened(path: str, hash: bytes, report: str) -> Field:
    """A mapped field from its pickle."""
    field = read(path)
    if field._hash != hash:
        raise Error(f"{path}: is not the field that was pickled, but another one", "input", 3)
    field._held.report = report
    return field


def unpickled(data: bytes, name: bytes, report: str) -> Field:
    """A field in memory from its pickle."""
    return Field(_native.from_bytes(data, name, report))


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
    tolerance = number("tolerance", tolerance)
    if not tolerance >= 0:
        raise ValueError(f"tolerance is {tolerance}; it is 0 or more")
    text = "" if transform is None else json_text("transform", transform)
    fields = [field_of(one) for one in (first, second)]
    return Comparison(_native.compare(fields[0]._native, fields[1]._native, text, match or "", tolerance))
