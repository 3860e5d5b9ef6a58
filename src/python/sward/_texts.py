"""Texts for the native module: JSON of Python's and numpy's values, names of files, whole numbers."""

from __future__ import annotations

import json
import math
import operator
import os
from typing import Any, Iterable, Mapping

import numpy


def json_text(name: str, value: Any) -> str:
    """The value as JSON. TypeError for what JSON lacks, ValueError for numbers that are not finite, with the place."""
    return json.dumps(plain(name, value))


def plain(place: str, value: Any) -> Any:
    """The value with dicts, lists, texts and numbers of Python in place of numpy's."""
    if value is None or isinstance(value, (str, bool)):
        return value
    if isinstance(value, numpy.ndarray):
        if numpy.ma.is_masked(value):
            raise TypeError(f"{place}: is a masked array with masked numbers")
        return plain(place, value.tolist())
    if isinstance(value, numpy.generic):
        value = value.item()
    if isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, float):
        if not math.isfinite(value):
            raise ValueError(f"{place}: {value}; all numbers must be finite")
        return value
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise TypeError(f"{place}: key {key!r} is no text")
        return {key: plain(f"{place}: {key}", one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(f"{place}[{i}]", one) for i, one in enumerate(value)]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{place}: {type(value).__name__} is no value of JSON")


def path_bytes(path: Any) -> bytes:
    """The name of a file as bytes, also one that is no UTF-8, as os.listdir() returns it."""
    name = os.fspath(path)
    name = name if isinstance(name, bytes) else name.encode("utf-8", "surrogateescape")
    if b"\0" in name:
        raise ValueError(f"{name!r}: a name of a file has no NUL character")
    if not name:
        raise ValueError("the name of a file is empty")
    return name


def text_of_bytes(name: bytes) -> str:
    """The same as a text."""
    return name.decode("utf-8", "surrogateescape")


def arguments_bytes(arguments: Iterable[str]) -> list:
    """Arguments of a command line as bytes."""
    return [one.encode("utf-8", "surrogateescape") for one in arguments]


def whole(name: str, value: Any) -> int:
    """TypeError unless the value is a whole number."""
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}; a whole number is needed") from None


def number(name: str, value: Any) -> float:
    """The value as a float. TypeError if it is no number."""
    if isinstance(value, (str, bytes, bool, numpy.bool_)):
        raise TypeError(f"{name} is {value!r}; a number is needed")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {value!r}; a number is needed") from None


def callback(progress: Any) -> Any:
    """TypeError unless it is None or can be called."""
    if progress is not None and not callable(progress):
        raise TypeError(f"progress is {progress!r}; a function of (fraction, text) is needed")
    return progress
