"""Renderer."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, Mapping, Sequence, Tuple, Union

import numpy
import numpy.typing

from . import _native
from ._arrays import plain
from ._field import Field, read
from ._options import Options

# What render() says for each picture, or what draws nothing.
LEFT_OUT = {
    "camera": "render() takes the camera",
    "size": "render() takes the size",
    "fixed_dt": "render() takes the time",
    "quiet": "nothing is printed",
    "verbose": "nothing is printed",
    "help": "help(sward.Renderer) lists all",
}
RENDER_OPTIONS = Options("Renderer", _native.render_options(), LEFT_OUT)

LARGEST_SIDE = 16384  # [pixels]
FORWARD = "flow-forward"


class Renderer:
    """Draws a field into numpy arrays, as `sward-view render` does, on a device that stays open.

    field: a Field, or the path of one. settings: a settings file, or a dict as in one (docs/settings.md): wind,
    gravity, colliders, sun and more. Raises sward.Error, for example "unsupported" where there is no Vulkan device.
    """

    def __init__(self, field: Union[str, os.PathLike[str], Field], *, settings: Any = None, **options: Any) -> None:
        text = ""
        if isinstance(settings, Mapping):
            text = json.dumps(settings, default=plain)
        elif settings is not None:
            options["settings"] = settings
        self._field = field if isinstance(field, Field) else read(field)
        self._native = _native.Renderer(self._field._native, RENDER_OPTIONS.arguments(options), text)

    @property
    def device(self) -> str:
        """Name of the Vulkan device."""
        return self._native.device

    def render(self, camera: Any = "fit", time: float = 0.0, size: Tuple[int, int] = (1280, 720), *,
               dtype: numpy.typing.DTypeLike = "uint8", settings: Union[Mapping[str, Any], None] = None,
               layers: Union[str, Sequence[str], None] = None) -> Union[numpy.ndarray, Dict[str, numpy.ndarray]]:
        """One picture: (height, width, 3), rows from the top, red, green, blue.

        camera: "fit", "eye", "top" or "edge"; a camera file; or a dict of eye, target and perhaps up [m, world] and
        fov_y_deg [degrees]; a list of such with "time" is a path. time: [s]; blades move on from the picture before,
        and settle in the wind of this time at the first picture, if time falls, or after a pause of over two hours.
        size: (width, height) [pixels]. dtype: uint8 for sRGB on film, as a .png of the viewer; float32 for linear
        radiance before exposure and film curve, as its .exr. settings: of this picture alone, over the renderer's.

        layers: names as of `sward-view render --layers` (docs/layers.md), such as ["depth", "id", "flow-backward"], or
        "all". Then the result is a dict: the picture as "color", and an array (height, width) or (height, width, 3 or
        2) for each. An id is that of Field.blades() plus 2**53. Flow is that from the picture before; "flow-forward" is
        that of the next picture and is not told. Blades settle anew at the first picture with flow.
        """
        text, is_json = camera_text(camera)
        width, height = size_of(size)
        return self._native.render(text, is_json, float(time), width, height, settings_text(settings),
                                   is_linear(dtype), layers_text(layers))

    def advance(self, time: float, *, dtype: numpy.typing.DTypeLike = "uint8") -> None:
        """Moves the blades to a time [s] and draws nothing. Pictures of both kinds keep blades of their own."""
        self._native.advance(float(time), is_linear(dtype))


def camera_text(camera: Any) -> tuple:
    """(text, whether it is JSON)."""
    if isinstance(camera, (str, os.PathLike)):
        return os.fspath(camera), False
    if isinstance(camera, (Mapping, list, tuple)):
        return json.dumps(camera, default=plain), True
    raise TypeError(f"camera is a name, a path, a dict, or a list of dicts, not {type(camera).__name__}")


def size_of(size: Any) -> tuple:
    try:
        width, height = (int(side) for side in size)
    except (TypeError, ValueError):
        raise TypeError(f"size is (width, height) in pixels, not {size!r}") from None
    if not (1 <= width <= LARGEST_SIDE and 1 <= height <= LARGEST_SIDE):
        raise ValueError(f"size is {width}x{height}; each side is 1 to {LARGEST_SIDE} pixels")
    return width, height


def layers_text(layers: Any) -> str:
    """Names with commas between them."""
    names = layer_names(layers)
    if FORWARD in names:
        raise ValueError(f'layers: "{FORWARD}" is known with the next picture alone: take "flow-backward" of that')
    return ",".join(names)


def layer_names(layers: Any) -> list:
    if layers is None:
        return []
    known = _native.Renderer.layers()
    if layers == "all":
        return [name for name in known if name != FORWARD]
    if isinstance(layers, str) or not isinstance(layers, Sequence):
        raise TypeError(f'layers is "all" or a list of names, not {layers!r}')
    for name in layers:
        if name not in known:
            raise ValueError(f"layers: {name!r} is none of {', '.join(known)}")
    return list(layers)


def settings_text(settings: Any) -> str:
    return "" if settings is None else json.dumps(settings, default=plain)


def is_linear(dtype: Any) -> bool:
    kind = numpy.dtype(dtype)
    if kind not in (numpy.dtype(numpy.uint8), numpy.dtype(numpy.float32)):
        raise TypeError(f"dtype is {kind}, neither uint8 nor float32")
    return kind == numpy.dtype(numpy.float32)


RENDER_OPTIONS.document(Renderer.__init__, Renderer)
