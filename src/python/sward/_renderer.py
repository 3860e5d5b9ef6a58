"""Renderer."""

from __future__ import annotations

import operator
import os
import weakref
from typing import Any, Dict, Mapping, Sequence, Tuple, Union

import numpy
import numpy.typing

from . import _native
from ._errors import Error
from ._field import Field, field_of
from ._options import Options
from ._texts import arguments_bytes, json_text, number, path_bytes

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
    """Draws fields into numpy arrays, as `sward-view render` does, on a device that stays open.

    field: a Field, the path of one, or a list of such, which are drawn together. settings: a settings file, or a dict as
    in one (docs/settings.md): wind, gravity, colliders, sun and more. Raises sward.Error, for example "unsupported" where
    there is no Vulkan device, and in a process that was forked from the one that made it.
    """

    def __init__(self, field: Union[str, os.PathLike[str], Field, Sequence[Union[str, os.PathLike[str], Field]]], *,
                 settings: Any = None, **options: Any) -> None:
        text = ""
        if isinstance(settings, Mapping):
            text = json_text("settings", settings)
        elif settings is not None:
            options["settings"] = settings
        fields = list(field) if isinstance(field, (list, tuple)) else [field]
        if not fields:
            raise ValueError("field: an empty list; at least one field is drawn")
        self._fields = [field_of(one) for one in fields]
        self._process = os.getpid()
        arguments = arguments_bytes(RENDER_OPTIONS.arguments(options))
        self._held = _native.Renderer([one._native for one in self._fields], arguments, text)
        OPEN.add(self)

    @property
    def _native(self) -> Any:
        """The native renderer. sward.Error in a forked process, and if a field's file has been written to."""
        if os.getpid() != self._process:
            raise Error('a Renderer is of no use after fork(): its device belongs to the process that opened it; make one '
                        'in each process, and start processes by multiprocessing\'s method "spawn"', "unsupported", 5)
        for field in self._fields:
            field._native
        return self._held

    @property
    def device(self) -> str:
        """Name of the Vulkan device."""
        return self._held.device

    def render(self, camera: Any = "fit", time: float = 0.0, size: Tuple[int, int] = (1280, 720), *,
               dtype: numpy.typing.DTypeLike = "uint8", settings: Union[Mapping[str, Any], None] = None,
               layers: Union[str, Sequence[str], None] = None) -> Union[numpy.ndarray, Dict[str, numpy.ndarray]]:
        """One picture: (height, width, 3), rows from the top, red, green, blue.

        camera: "fit", "eye", "top" or "edge"; a camera file; or a dict of eye, target and perhaps up [m, world] and
        fov_y_deg [degrees]; a list of such with "time" is a path. time: [s]; blades move on from the picture before,
        and settle in the wind of this time at the first picture, if time falls, or after a pause of over two hours.
        size: (width, height) [pixels]. dtype: uint8 for sRGB on film, as a .png of the viewer; float32 for linear
        radiance before exposure and film curve, as its .exr. settings: of this picture alone, over the renderer's.
        Pictures of both kinds share their past: one of the other kind, at the same time and from the same camera, is
        another picture of the same moment.

        layers: names as of `sward-view render --layers` (docs/layers.md), such as ["depth", "id", "flow-backward"], or
        "all". With a list, also an empty one, the result is a dict: the picture as "color", and an array (height, width) or (height, width, 3 or
        2) for each. An id is that of Field.blades() plus 2**53. Flow is that from the moment before; "flow-forward" is
        that to the next one and is not told. Of several fields, an id tells which one, and patches are numbered as joined.
        """
        text, is_json = camera_text(camera)
        width, height = size_of(size)
        return self._native.render(text, is_json, number("time", time), width, height, settings_text(settings),
                                   is_linear(dtype), layers_text(layers), layers is not None)

    def advance(self, time: float, *, dtype: numpy.typing.DTypeLike = "uint8") -> None:
        """Moves the blades to a time [s] and draws nothing. dtype: of the pictures that follow; those of the other kind
        follow in one step when they are drawn.
        """
        self._native.advance(number("time", time), is_linear(dtype))


OPEN: Any = weakref.WeakSet()  # renderers of this process


def abandon() -> None:
    """After fork(): the child never closes devices of its parent, whose threads it lacks."""
    for renderer in list(OPEN):
        if renderer._process != os.getpid():
            renderer._held.abandon()
    OPEN.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=abandon)


def camera_text(camera: Any) -> tuple:
    """(text, whether it is JSON)."""
    if isinstance(camera, (str, os.PathLike)):
        return path_bytes(camera), False
    if isinstance(camera, (Mapping, list, tuple)):
        return json_text("camera", camera), True
    raise TypeError(f"camera is a name, a path, a dict, or a list of dicts, not {type(camera).__name__}")


def size_of(size: Any) -> tuple:
    try:
        width, height = (operator.index(side) for side in size)
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
    if settings is None:
        return ""
    if not isinstance(settings, Mapping):
        raise TypeError(f"settings of a picture are a dict, not {settings!r}")
    return json_text("settings", settings)


def is_linear(dtype: Any) -> bool:
    kind = numpy.dtype(dtype)
    if kind not in (numpy.dtype(numpy.uint8), numpy.dtype(numpy.float32)):
        raise TypeError(f"dtype is {kind}, neither uint8 nor float32")
    return kind == numpy.dtype(numpy.float32)


RENDER_OPTIONS.document(Renderer.__init__, Renderer)
