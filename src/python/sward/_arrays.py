"""Checks arrays of ground and masks, and hands them to the native module in one form."""

from __future__ import annotations

import os
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

import numpy
import numpy.typing

from . import _native
from ._texts import json_text

MAX_SIDE = 32768  # samples of heights or a mask on a side
HIGHEST = 1e6  # [m] above or below 0, of heights


class Mesh:
    """Ground of numpy arrays.

    vertices: (n, 3) real numbers, in `units` and with `up_axis` as of a file; metres and y by default.
    triangles: (m, 3) integers from 0 to n - 1; corners turn anti-clockwise seen from the front.
    colors: (n, 3) or (n, 4), floats in [0, 1] or uint8, as images store them; for `mask="vertex-color:R"`.
    uvs: (n, 2) floats, (0, 0) at an image's upper left corner; for masks that are images or arrays.
    attributes: {"_NAME": (n,) or (n, k) floats, k up to 4}; for `mask="vertex-color:_NAME"`.
    name: in messages.
    """

    def __init__(self, vertices: numpy.typing.ArrayLike, triangles: numpy.typing.ArrayLike,
                 colors: Optional[numpy.typing.ArrayLike] = None, uvs: Optional[numpy.typing.ArrayLike] = None,
                 attributes: Optional[Mapping[str, numpy.typing.ArrayLike]] = None, name: str = "mesh") -> None:
        places = real("vertices", vertices)
        shape("vertices", places, "(n, 3)", None, 3)
        finite("vertices", places)
        self.is_single = places.dtype.itemsize <= 4 and places.dtype.kind == "f"
        self.vertices = numpy.ascontiguousarray(places, numpy.float64)
        self.triangles = indices(triangles, len(places))
        self.colors = None if colors is None else colors_of(colors, len(places))
        self.uvs = None if uvs is None else per_vertex("uvs", uvs, len(places), 2, 2)
        self.attributes = {str(key): per_vertex(f"attributes[{key!r}]", values, len(places), 1, 4)
                           for key, values in (attributes or {}).items()}
        for key in self.attributes:
            if not key.startswith("_"):
                raise ValueError(f"attributes[{key!r}]: a name begins with _, as in glTF")
        self.name = str(name)


def array_of(name: str, value: Any, hole: Optional[float] = None) -> numpy.ndarray:
    """The value as an array of numbers. TypeError for objects, texts and complex numbers. `hole` takes the place of
    masked numbers; without it they are a TypeError.
    """
    if numpy.ma.is_masked(value):
        if hole is None:
            raise TypeError(f"{name}: is a masked array with masked numbers")
        if value.dtype.kind in "biu" and numpy.isnan(hole):
            value = value.astype(numpy.float64)
        value = value.filled(hole)
    try:
        array = numpy.asarray(value)
    except ValueError as reason:
        raise TypeError(f"{name}: is no array: {reason}") from None
    if array.dtype.kind not in "buif":
        raise TypeError(f"{name}: has dtype {array.dtype}; real numbers are needed")
    if array.size == 0:
        raise ValueError(f"{name}: is empty, of shape {array.shape}")
    return array


def real(name: str, value: Any, hole: Optional[float] = None) -> numpy.ndarray:
    array = array_of(name, value, hole)
    if array.dtype.kind == "b":
        raise TypeError(f"{name}: has dtype bool; real numbers are needed")
    return array


def shape(name: str, array: numpy.ndarray, wanted: str, rows: Optional[int], low: int, high: int = 0) -> None:
    """ValueError unless the array has two axes, `rows` rows, and low to high columns."""
    if array.ndim != 2 or (rows is not None and len(array) != rows) or not low <= array.shape[1] <= (high or low):
        raise ValueError(f"{name}: has shape {array.shape}, not {wanted}")


def finite(name: str, array: numpy.ndarray) -> None:
    if array.dtype.kind == "f" and not numpy.isfinite(array).all():
        place = tuple(int(i) for i in numpy.argwhere(~numpy.isfinite(array))[0])
        raise ValueError(f"{name}: {array[place]} at {list(place)}; all numbers must be finite")


def indices(value: Any, vertices: int) -> numpy.ndarray:
    array = array_of("triangles", value)
    if array.dtype.kind not in "ui":
        raise TypeError(f"triangles: has dtype {array.dtype}; integers are needed")
    shape("triangles", array, "(m, 3)", None, 3)
    outside = (array < 0) | (array >= vertices)
    if outside.any():
        row, corner = (int(i) for i in numpy.argwhere(outside)[0])
        raise ValueError(f"triangles: triangle {row} names vertex {array[row, corner]}, but there are {vertices}")
    return numpy.ascontiguousarray(array, numpy.uint32)


def per_vertex(name: str, value: Any, vertices: int, low: int, high: int) -> numpy.ndarray:
    array = real(name, value)
    if array.ndim == 1 and low == 1:
        array = array[:, None]
    columns = f"{low}" if low == high else f"{low} to {high}"
    shape(name, array, f"({vertices}, {columns})", vertices, low, high)
    finite(name, array)
    with numpy.errstate(over="ignore"):
        single = numpy.ascontiguousarray(array, numpy.float32)
    if not numpy.isfinite(single).all():
        place = tuple(int(i) for i in numpy.argwhere(~numpy.isfinite(single))[0])
        raise ValueError(f"{name}: {array[place]} at {list(place)} is too large for single precision, {3.4e38}")
    return single


def colors_of(value: Any, vertices: int) -> numpy.ndarray:
    array = real("colors", value)
    shape("colors", array, f"({vertices}, 3 or 4)", vertices, 3, 4)
    finite("colors", array)
    if array.dtype == numpy.uint8:
        array = array.astype(numpy.float32) / numpy.float32(255)
    elif array.dtype.kind != "f":
        raise TypeError(f"colors: has dtype {array.dtype}; uint8, or floats in [0, 1] are needed")
    if array.min() < 0 or array.max() > 1:
        raise ValueError(f"colors: from {array.min()} to {array.max()}; floats are in [0, 1]")
    colors = numpy.ones((vertices, 4), numpy.float32)
    colors[:, : array.shape[1]] = array
    return colors


def heights_of(value: Any) -> numpy.ndarray:
    """(z, x) heights as contiguous float32; NaN stays, and what is masked becomes NaN."""
    array = real("heights", value, numpy.nan)
    sides("heights", array, 2)
    wide = array.astype(numpy.float32) if array.dtype == numpy.float16 else array  # halves cannot hold the bound
    outside = (wide > HIGHEST) | (wide < -HIGHEST)
    if outside.any():
        place = tuple(int(i) for i in numpy.argwhere(outside)[0])
        raise ValueError(f"heights: {array[place]} at {list(place)}; from {-HIGHEST:.0f} to {HIGHEST:.0f} m, or NaN for a hole")
    return numpy.ascontiguousarray(array, numpy.float32)


def sides(name: str, array: numpy.ndarray, least: int) -> None:
    if array.ndim != 2 or min(array.shape) < least or max(array.shape) > MAX_SIDE:
        raise ValueError(f"{name}: has shape {array.shape}; two sides of {least} to {MAX_SIDE} are needed")


def mask_of(name: str, value: Any) -> numpy.ndarray:
    """(v, u) shares of the density as words of 16 bits: bool, uint8 and uint16 over their range, floats in [0, 1]. What
    is masked becomes 0.
    """
    array = array_of(name, value, 0)
    sides(name, array, 1)
    finite(name, array)
    if array.dtype.kind == "u" and array.dtype.itemsize == 2:
        return numpy.ascontiguousarray(array, numpy.uint16)
    if array.dtype.kind == "b":
        return numpy.where(array, numpy.uint16(65535), numpy.uint16(0))
    if array.dtype == numpy.uint8:
        return array.astype(numpy.uint16) * numpy.uint16(257)
    if array.dtype.kind != "f":
        raise TypeError(f"{name}: has dtype {array.dtype}; bool, uint8, uint16, or floats in [0, 1] are needed")
    if array.min() < 0 or array.max() > 1:
        raise ValueError(f"{name}: from {array.min()} to {array.max()}; floats are in [0, 1]")
    # In double precision: halves cannot hold 65535.
    return numpy.ascontiguousarray(numpy.floor(array.astype(numpy.float64) * 65535 + 0.5), numpy.uint16)


# What a bake grows on: a file or a built-in, several of them, heights, or a mesh.
Ground = Union[str, os.PathLike[str], Sequence[Any], numpy.ndarray, Mesh]


def paths_of(ground: Any) -> Optional[list]:
    """Files or built-ins; None if the ground is arrays."""
    paths = [ground] if isinstance(ground, (str, os.PathLike)) else ground
    if not isinstance(paths, (list, tuple)) or not any(isinstance(one, (str, os.PathLike)) for one in paths):
        return None
    for one in paths:
        if not isinstance(one, (str, os.PathLike)):
            raise TypeError(f"the ground lists {type(one).__name__} beside a path; several grounds are all paths")
        if not os.fspath(one):
            raise ValueError("the ground is an empty path")
    return [os.fspath(one) for one in paths]


def put_ground(inputs: Any, ground: Any) -> None:
    """Hands arrays to `inputs`: a Mesh, (vertices, triangles[, colors]), or an array of heights."""
    if isinstance(ground, tuple) and len(ground) in (2, 3) and not numpy.isscalar(ground[0]):
        ground = Mesh(*ground)
    if isinstance(ground, Mesh):
        inputs.set_mesh(ground.name, ground.vertices, ground.triangles, ground.colors, ground.uvs,
                        ground.attributes, ground.is_single)
        return
    if ground is None or isinstance(ground, (bytes, str, os.PathLike, Mapping)):
        raise TypeError(f"the ground is a path, a Mesh, (vertices, triangles), or heights, not {type(ground).__name__}")
    if isinstance(ground, list) and any(numpy.ndim(one) > 1 for one in ground if isinstance(one, numpy.ndarray)):
        raise TypeError("the ground is a list of arrays; a mesh is a tuple (vertices, triangles), or a sward.Mesh")
    inputs.set_heights("heights", heights_of(ground))


def strokes_text(strokes: Any) -> str:
    """The text of a stroke file, from a list of dicts as in such a file (docs/painting.md)."""
    if isinstance(strokes, (str, bytes, Mapping)) or not isinstance(strokes, Iterable):
        raise TypeError(f"strokes: a list of dicts is needed, not {type(strokes).__name__}")
    return json_text("strokes", {"format": "sward strokes 1", "strokes": list(strokes)})


def inputs_of(ground: Any, values: dict) -> tuple:
    """Takes what is no text out of the keywords: (native inputs, positional arguments)."""
    inputs = _native.Inputs()
    paths = paths_of(ground)
    if paths is None:
        put_ground(inputs, ground)
    masks = values.get("mask")
    if masks is not None and not isinstance(masks, str):
        listed = list(masks) if isinstance(masks, (list, tuple)) else [masks]
        values["mask"] = [one for one in listed if isinstance(one, str)] or None
        arrays = [one for one in listed if not isinstance(one, str)]
        for number, array in enumerate(arrays):
            name = f"mask {number}" if len(arrays) > 1 else "mask"
            inputs.add_mask(name, mask_of(name, array), False)
    if values.get("paint") is not None and not isinstance(values["paint"], (str, os.PathLike)):
        inputs.set_strokes(strokes_text(values.pop("paint")))
    if isinstance(values.get("meadow"), Mapping):
        inputs.set_meadow(json_text("meadow", values.pop("meadow")))
    return inputs, ["--", *(paths or [])]
