#!/usr/bin/env python3
"""Writes the type stub of the module sward: names, signatures and docstrings as the module itself has them.

    PYTHONPATH=build/release/python write_stub.py OUT.pyi
"""

import ast
import inspect
import re
import sys
from pathlib import Path

import sward

HEAD = '''"""Made by write_stub.py of the module itself."""

import os
from typing import Any, Callable, Mapping, Optional, Sequence, Tuple, Union

import numpy
import numpy.typing

'''


def alias(name):
    """The statement that defines a name of a type."""
    for module in ("_arrays", "_bake", "_options"):
        text = Path(getattr(sward, module).__file__).read_text(encoding="utf-8")
        for node in ast.parse(text).body:
            if isinstance(node, ast.Assign) and node.targets[0].id == name:
                return ast.get_source_segment(text, node) + "\n"
    raise SystemExit(f"write_stub.py: {name} is no alias")


def quoted(text, indent):
    """The first paragraph of a docstring."""
    lines = inspect.cleandoc(text or "").split("\n\n")[0].splitlines()
    return indent + '"""' + ("\n" + indent).join(lines) + '"""\n'


def function(name, value, indent=""):
    body = quoted(value.__doc__, indent + "    ") if value.__doc__ else ""
    # Annotations are texts, which a signature quotes.
    signature = re.sub(r"(\w: |-> )'([^']*)'", r"\1\2", str(inspect.signature(value)))
    return f"{indent}def {name}{signature}:\n{body or indent + '    ...' + chr(10)}"


def is_public(owner, key):
    """Whether users call this member; only functions make fields."""
    return not key.startswith("_") or key == "__len__" or (key == "__init__" and owner is not sward.Field)


def class_of(name, value):
    base = value.__bases__[0].__name__
    text = f"class {name}{'' if base == 'object' else f'({base})'}:\n" + quoted(value.__doc__, "    ")
    for key, annotation in value.__dict__.get("__annotations__", {}).items():
        text += f"    {key}: {annotation}\n"
    for key, member in vars(value).items():
        if isinstance(member, property):
            text += "\n    @property\n" + function(key, member.fget, "    ")
        elif inspect.isfunction(member) and is_public(value, key):
            text += "\n" + function(key, member, "    ")
    return text


def main(path):
    parts = [alias(name) for name in ("Value", "Ground", "Progress")] + ["__version__: str\n"]
    for name in sward.__all__:
        value = getattr(sward, name)
        if inspect.isclass(value):
            parts.append("\n" + class_of(name, value))
        elif inspect.isfunction(value):
            parts.append("\n" + function(name, value))
    Path(path).write_text(HEAD + "\n".join(parts), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1])
