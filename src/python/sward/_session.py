"""Session."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Optional, Union

import numpy

from . import _native
from ._arrays import paths_of, put_ground, strokes_text
from ._bake import LEFT_OUT, arguments_of
from ._errors import Error
from ._field import Field, field_of
from ._options import Options
from ._texts import callback, whole

NOTHING_WRITTEN = "a session writes nothing; Session.field() has the field"
SESSION_OPTIONS = Options("Session", _native.bake_options(), {
    **LEFT_OUT, **dict.fromkeys(("output", "report", "force", "paint_mask", "paint_mask_size"), NOTHING_WRITTEN)})


class Session:
    """A bake that stays open while its ground is painted or changed: only the 32 m cells that a change reaches are
    baked again. The field is at any time, byte for byte, that of a whole bake.

    ground and options: as of sward.bake(), but for those that name outputs. field: one, or its path, that was
    baked of this ground with these options; its blades are used. progress: as of sward.bake(). A call during another
    one, from a second thread or from `progress`, raises sward.Error. After any exception the session is as before the
    call, also if the user's filters make an exception of a sward.Warning.
    """

    def __init__(self, ground: Any, *, field: Union[str, os.PathLike[str], Field, None] = None,
                 progress: Optional[Callable[[float, str], None]] = None, **options: Any) -> None:
        arguments, inputs = arguments_of(ground, options, SESSION_OPTIONS)
        self._native = _native.Session(arguments, inputs,
                                       None if field is None else field_of(field)._native, callback(progress))

    @property
    def strokes(self) -> list:
        """The strokes as they are now: dicts as in a stroke file (docs/painting.md)."""
        return json.loads(self._native.strokes)["strokes"]

    @property
    def species(self) -> list:
        """Names of the meadow's species."""
        return list(self._native.species)

    @property
    def origin(self) -> numpy.ndarray:
        """(3,) float64 [m] of the field."""
        return numpy.array(self._native.origin)

    @property
    def has_reused(self) -> bool:
        """Whether the blades of the given field were used."""
        return self._native.has_reused

    def __len__(self) -> int:
        """Number of blades, the ribbons of compound plants included."""
        return self._native.count

    def paint(self, strokes: Any, *, keep: Optional[int] = None,
              progress: Optional[Callable[[float, str], None]] = None) -> dict:
        """Adds strokes, dicts as in a stroke file. `keep`: of those before only so many first ones stay, so
        paint([], keep=n) undoes. Returns {"cells": numbers of the 32 m cells baked again, "blades": in these cells}.
        """
        before = len(self.strokes)
        kept = before if keep is None else whole("keep", keep)
        if kept < 0:
            raise ValueError(f"keep is {kept}; it is 0 or more")
        if kept > before:
            raise Error(f"keep is {kept}, and there are {before} strokes")
        return self._native.paint(strokes_text(strokes), kept, callback(progress))

    def replace_ground(self, ground: Any = None, *,
                       progress: Optional[Callable[[float, str], None]] = None) -> dict:
        """Replaces the ground by arrays of as many triangles in the same order, or by the session's files as they are
        now. Returns what paint() does.
        """
        inputs = None
        if ground is not None:
            if paths_of(ground) is not None:
                raise TypeError("replace_ground() takes arrays, or nothing: then it reads the session's own files again")
            inputs = _native.Inputs()
            put_ground(inputs, ground)
        return self._native.replace_ground(inputs, callback(progress))

    def field(self) -> Field:
        """The whole field as it is now, in memory. A copy."""
        return Field(self._native.field())

    def save(self, path: Union[str, os.PathLike[str]], force: bool = False) -> None:
        """Writes field() as a file."""
        self.field().save(path, force)


SESSION_OPTIONS.document(Session.__init__, Session)
