"""Options of the programs as keywords: names, texts and types come from the program's own tables (_native)."""

from __future__ import annotations

import difflib
import inspect
import os
import re
from typing import Any, Mapping, Sequence, Union

import numpy

from ._texts import json_text

# A value of an option: a number, a text as on the command line, a path, or two or three numbers for a range.
Value = Union[str, float, os.PathLike[str], Sequence[Any], None]


class Option:
    """An option of the program, and its keyword."""

    def __init__(self, row: Mapping[str, Any]) -> None:
        self.option: str = row["option"]
        self.key: str = self.option[2:].replace("-", "_")
        self.value: str = row["value"]
        self.group: str = row["group"]
        self.is_flag: bool = row["numbers"] == 0
        self.is_pair: bool = row["numbers"] == 2
        self.repeats: bool = row["repeats"] or "may be repeated" in row["text"]
        self.text: str = re.sub(r"--([a-z][a-z-]*)", lambda found: found[1].replace("-", "_"), row["text"])

    @property
    def annotation(self) -> str:
        return "bool" if self.is_flag else "Value"

    def arguments(self, value: Any) -> list:
        """What stands on a command line for this value."""
        if isinstance(value, numpy.ndarray) and value.ndim == 0:
            value = value[()]
        if self.is_flag:
            if not isinstance(value, (bool, numpy.bool_)):
                raise TypeError(f"{self.key} is True or False, not {value!r}")
            return [self.option] if value else []
        if self.is_pair:
            pair = [value] if isinstance(value, (str, bytes)) or numpy.ndim(value) != 1 else list(value)
            if len(pair) != 2:
                raise TypeError(f"{self.key} is two numbers ({self.value}), not {value!r}")
            return [self.option, *(text_of(self.key, one) for one in pair)]
        if isinstance(value, Mapping):
            return [f"{self.option}={key}={text if isinstance(text, str) else json_text(f'{self.key}: {key}', text)}"
                    for key, text in value.items()]
        if self.repeats and isinstance(value, (list, tuple, set, frozenset)):
            return [f"{self.option}={text_of(self.key, one)}" for one in value]
        if isinstance(value, (list, tuple, numpy.ndarray)):
            return [f"{self.option}={range_text(self.key, self.value, value)}"]
        return [f"{self.option}={text_of(self.key, value)}"]


def text_of(key: str, value: Any) -> str:
    """A number, a text or a path as the command line has it."""
    if isinstance(value, (bool, numpy.bool_)):
        raise TypeError(f"{key} is a value, not {value!r}")
    if isinstance(value, (int, numpy.integer)):
        return str(int(value))
    if isinstance(value, (float, numpy.floating)):
        number = float(value)
        return str(int(number)) if number.is_integer() and abs(number) < 2.0**53 else repr(number)
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    raise TypeError(f"{key} is a number, a text or a path, not {type(value).__name__}")


def range_text(key: str, form: str, value: Sequence[Any]) -> str:
    """(0, 45) as 0:45, (0, 45, 10) as 0:45~10, (1280, 720) as 1280x720, (x, y, z) as x,y,z, ((0, 8), (2, 4)) as
    0:8,2:4; None is an open end.
    """
    if ":" in form and "," in form:
        parts = form.split(",")
        if len(value) != len(parts) or not all(isinstance(one, (list, tuple, numpy.ndarray)) and numpy.shape(one) == (2,)
                                               for one in value):
            example = ", ".join(f"({part.replace(':', ', ')})" for part in parts)
            raise TypeError(f"{key} is ({example}), or the text {form}, not {value!r}")
        return ",".join(range_text(key, "MIN:MAX", one) for one in value)
    if re.fullmatch(r"[A-Z](,[A-Z])+", form) and len(value) != len(form.split(",")):
        raise TypeError(f"{key} is ({form.replace(',', ', ')}), {len(form.split(','))} numbers, not {value!r}")
    texts = ["" if one is None else text_of(key, one) for one in value]
    if re.fullmatch(r"[A-Z]x[A-Z]", form) and len(texts) == 2:
        return "x".join(texts)
    if ":" in form and "MIN" in form and len(texts) in (2, 3):
        return ":".join(texts[:2]) + "".join("~" + soft for soft in texts[2:])
    if "~" in form and len(texts) == 2:
        return "~".join(texts)
    if "," in form and ":" not in form:
        return ",".join(texts)
    raise TypeError(f"{key} is {form or 'one value'}, not {value!r}")


class Options:
    """A table of options; those in `left_out` are no keywords, and the text says what there is instead."""

    def __init__(self, function: str, rows: Sequence[Mapping[str, Any]], left_out: Mapping[str, str]) -> None:
        self.function = function
        self.left_out = dict(left_out)
        self.known = {option.key: option for option in map(Option, rows) if option.key not in left_out}

    def check(self, values: Mapping[str, Any]) -> None:
        """TypeError for a keyword that is not known."""
        for key in values:
            if key not in self.known:
                raise TypeError(self.complaint(key))

    def arguments(self, values: Mapping[str, Any]) -> list:
        """The arguments of a command line; None is an option that is not given. TypeError for an unknown keyword."""
        self.check(values)
        return [text for key, value in values.items() if value is not None
                for text in self.known[key].arguments(value)]

    def complaint(self, key: str) -> str:
        text = f"{self.function}() has no keyword {key!r}"
        if key in self.left_out:
            return f"{text}: {self.left_out[key]}"
        near = difflib.get_close_matches(key, self.known, 1)
        return f"{text}; did you mean {near[0]!r}?" if near else text

    def keywords(self) -> list:
        """inspect.Parameter of each keyword."""
        return [inspect.Parameter(option.key, inspect.Parameter.KEYWORD_ONLY,
                                  default=False if option.is_flag else None, annotation=option.annotation)
                for option in self.known.values()]

    def document(self, function: Any, holder: Any = None) -> None:
        """Puts the keywords into the signature of a function that takes them as **options, and into its docstring, or
        into that of the class which holds it.
        """
        own = inspect.signature(function)
        fixed = [one for one in own.parameters.values() if one.kind is not inspect.Parameter.VAR_KEYWORD]
        names = {one.name for one in fixed}
        function.__signature__ = own.replace(
            parameters=fixed + [one for one in self.keywords() if one.name not in names])
        told = holder or function
        lines, group = [inspect.cleandoc(told.__doc__)], None
        for option in self.known.values():
            if option.group != group:
                group = option.group
                lines.append(f"\n{group}:")
            form = f" ({option.value})" if option.value else ""
            lines.append(f"  {option.key}{form}: {option.text}")
        told.__doc__ = "\n".join(lines)
