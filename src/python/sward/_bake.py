"""bake(), estimate() and settings()."""

from __future__ import annotations

import json
from typing import Any, Callable, Optional

from . import _native
from ._arrays import Ground, inputs_of
from ._field import Field
from ._options import Options
from ._texts import arguments_bytes, callback

Progress = Optional[Callable[[float, str], None]]

# What needs no keyword.
LEFT_OUT = {
    "help": "help(sward.bake) lists all",
    "quiet": "nothing is printed; warnings.simplefilter() silences sward.Warning",
    "verbose": "Field.report holds counts and times",
    "progress": "progress is a function that is called with (fraction, text)",
    "dry_run": "sward.estimate() tells what a bake would grow",
    "print_config": "sward.settings() returns the settings",
}
BAKE_OPTIONS = Options("bake", _native.bake_options(), LEFT_OUT)


def arguments_of(ground: Any, options: dict, table: Options = BAKE_OPTIONS) -> tuple:
    """(arguments of the command line, native inputs)."""
    values = dict(options)
    table.check(values)
    inputs, positional = inputs_of(ground, values)
    return arguments_bytes(table.arguments(values) + positional), inputs


def bake(ground: Ground, *, progress: Progress = None, **options: Any) -> Field:
    """Grows grass on ground: what `sward bake` does, with each of its options as a keyword.

    ground: a file or a built-in ("hills"), or several; a (z, x) array of heights in metres, the first row at -z, NaN
    or masked for holes, with `extent=(x, z)` in metres; a sward.Mesh; or (vertices, triangles) or (vertices, triangles, colors).
    progress: called with (fraction, text), in the thread that called bake(). What it raises ends the bake.
    Returns the field: in memory, or with `output` the mapped file. The same input and options give the same bytes as
    the program does. Ctrl-C ends the bake with KeyboardInterrupt. Raises sward.Error; warns by sward.Warning when the
    work is done: if the filters make an exception of it, a written file is whole and stays.

    A range is (low, high), (low, high, soft), or a text such as "0:45~10"; None is an open end. A list repeats an
    option. `mask` also takes (v, u) arrays over the texture coordinates, the first row at -z: bool, uint8, uint16, or
    floats in [0, 1]; what is masked is 0. `paint` also takes a list of strokes, `meadow` and `set` also take dicts.
    """
    arguments, inputs = arguments_of(ground, options)
    return Field(_native.bake(arguments, inputs, callback(progress)))


def estimate(ground: Ground, *, progress: Progress = None, **options: Any) -> dict:
    """What bake() would grow, without growing it: the report of `sward bake --dry-run` as a dict.

    Takes what bake() takes. Counts and bytes are within 5 %.
    """
    arguments, inputs = arguments_of(ground, options)
    return json.loads(_native.estimate(arguments, inputs, callback(progress)))


def settings(ground: Ground, **options: Any) -> dict:
    """The effective settings of a bake, defaults included: `sward bake --print-config` as a dict."""
    arguments, inputs = arguments_of(ground, options)
    return json.loads(_native.settings(arguments, inputs))


for function in (bake, estimate, settings):
    BAKE_OPTIONS.document(function)
