"""Checks arrays of ground and masks, and hands them to the native module in one form."""

from __future__ import annotations

import json
import os
from typing import Any, Mapping, Optional, Sequence, Union

import numpy
import numpy.typing

from . import _native

MAX_SIDE = 32768  # samples of heights or a mask on a side


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


def array_of(name: str, value: Any) -> numpy.ndarray:
    """The value as an array of numbers. TypeError for objects, texts and complex numbers."""
    try:
        array = numpy.asarray(value)
    except ValueError as reason:
        raise TypeError(f"{name}: is no array: {reason}") from None
    if array.dtype.kind not in "buif":
        raise TypeError(f"{name}: has dtype {array.dtype}; real numbers are needed")
    if array.size == 0:
        raise ValueError(f"{name}: is empty, of shape {array.shape}")
    return array


def real(name: str, value: Any) -> numpy.ndarray:
    array = array_of(name, value)
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
    return numpy.ascontiguousarray(array, numpy.float32)


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
    """(z, x) heights as contiguous float32; NaN stays."""
    array = real("heights", value)
    sides("heights", array, 2)
    return numpy.ascontiguousarray(array, numpy.float32)


def sides(name: str, array: numpy.ndarray, least: int) -> None:
    if array.ndim != 2 or min(array.shape) < least or max(array.shape) > MAX_SIDE:
        raise ValueError(f"{name}: has shape {array.shape}; two sides of {least} to {MAX_SIDE} are needed")


def mask_of(name: str, value: Any) -> numpy.ndarray:
    """(v, u) shares of the density as words of 16 bits: bool, uint8 and uint16 over their range, floats in [0, 1]."""
    array = array_of(name, value)
    sides(name, array, 1)
    finite(name, array)
    if array.dtype == numpy.uint16:
        return numpy.ascontiguousarray(array)
    if array.dtype.kind == "b":
        return numpy.where(array, numpy.uint16(65535), numpy.uint16(0))
    if array.dtype == numpy.uint8:
        return array.astype(numpy.uint16) * numpy.uint16(257)
    if array.dtype.kind != "f":
        raise TypeError(f"{name}: has dtype {array.dtype}; bool, uint8, uint16, or floats in [0, 1] are needed")
    if array.min() < 0 or array.max() > 1:
        raise ValueError(f"{name}: from {array.min()} to {array.max()}; floats are in [0, 1]")
    return numpy.ascontiguousarray(numpy.floor(array * 65535 + 0.5), numpy.uint16)


# What a bake grows on: a file or a built-in, several of them, heights, or a mesh.
Ground = Union[str, os.PathLike[str], Sequence[Any], numpy.ndarray, Mesh]


def paths_of(ground: Any) -> Optional[list]:
    """Files or built-ins; None if the ground is arrays."""
    if isinstance(ground, (str, os.PathLike)):
        return [os.fspath(ground)]
    if isinstance(ground, (list, tuple)) and ground and all(isinstance(one, (str, os.PathLike)) for one in ground):
        return [os.fspath(one) for one in ground]
    return None


def put_ground(inputs: Any, ground: Any) -> None:
    """Hands arrays to `inputs`: a Mesh, (vertices, triangles[, colors]), or an array of heights."""
    if isinstance(ground, tuple) and len(ground) in (2, 3) and not numpy.isscalar(ground[0]):
        ground = Mesh(*ground)
    if isinstance(ground, Mesh):
        inputs.set_mesh(ground.name, ground.vertices, ground.triangles, ground.colors, ground.uvs,
                        ground.attributes, ground.is_single)
        return
    if ground is None or isinstance(ground, (bytes, dict)):
        raise TypeError(f"the ground is a path, a Mesh, (vertices, triangles), or heights, not {type(ground).__name__}")
    inputs.set_heights("heights", heights_of(ground))


def strokes_text(strokes: Any) -> str:
    """The text of a stroke file, from a list of dicts as in such a file (docs/painting.md)."""
    return json.dumps({"format": "sward strokes 1", "strokes": list(strokes)}, default=plain)


def plain(value: Any) -> Any:
    """numpy's numbers and arrays for json.dumps()."""
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    if isinstance(value, numpy.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{type(value).__name__} is no value of JSON")


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
    if isinstance(values.get("paint"), (list, tuple)):
        inputs.set_strokes(strokes_text(values.pop("paint")))
    if isinstance(values.get("meadow"), Mapping):
        inputs.set_meadow(json.dumps(values.pop("meadow"), default=plain))
    return inputs, ["--", *(paths or [])]
