"""Docstrings, the type stub and docs/python.md say what the module has."""

import ast
import inspect
import re
import unittest
from pathlib import Path

import sward

from case import ROOT, PythonCase

STUB = ast.parse(Path(sward.__file__).with_name("__init__.pyi").read_text(encoding="utf-8"))


def public_members(owner):
    return {name: member for name, member in vars(owner).items()
            if (not name.startswith("_") and (inspect.isfunction(member) or isinstance(member, property)))}


def parameters_of(function):
    """(name, kind, default, annotation) of each parameter, from a signature of the module."""
    return [(one.name, one.kind.name, None if one.default is one.empty else repr(one.default),
             None if one.annotation is one.empty else one.annotation)
            for one in inspect.signature(function).parameters.values()]


def parameters_in(node):
    """The same from a stub."""
    found, given = [], node.args
    defaults = [None] * (len(given.args) - len(given.defaults)) + given.defaults
    for kind, names, values in (("POSITIONAL_OR_KEYWORD", given.args, defaults),
                                ("KEYWORD_ONLY", given.kwonlyargs, given.kw_defaults)):
        for one, value in zip(names, values):
            found.append((one.arg, kind, value and ast.unparse(value),
                          one.annotation and ast.unparse(one.annotation)))
    return found


class Stub(PythonCase):
    def assert_same_signature(self, node, function):
        own = [(name, kind, default, text and ast.unparse(ast.parse(text)))
               for name, kind, default, text in parameters_of(function)]
        # Defaults that are objects, such as numpy.uint8, print in another way.
        plain = lambda rows: [(name, kind, default is not None, text) for name, kind, default, text in rows]
        self.assertEqual(plain(parameters_in(node)), plain(own))
        annotation = inspect.signature(function).return_annotation
        self.assertEqual(ast.unparse(node.returns), ast.unparse(ast.parse(annotation)))

    def test_names_and_signatures_are_those_of_the_module(self):
        functions = {node.name: node for node in STUB.body if isinstance(node, ast.FunctionDef)}
        classes = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
        aliases = {node.targets[0].id for node in STUB.body if isinstance(node, ast.Assign)}
        self.assertEqual(set(functions) | set(classes) | aliases, set(sward.__all__))
        for name, node in functions.items():
            with self.subTest(function=name):
                self.assert_same_signature(node, getattr(sward, name))
        for name, node in classes.items():
            own = public_members(getattr(sward, name))
            said = {member.name: member for member in node.body if isinstance(member, ast.FunctionDef)}
            self.assertEqual({key for key in said if not key.startswith("_")}, set(own), name)
            for key, member in own.items():
                with self.subTest(member=f"{name}.{key}"):
                    self.assert_same_signature(said[key], member.fget if isinstance(member, property) else member)
            if "__init__" in said:
                self.assert_same_signature(said["__init__"], getattr(sward, name).__init__)

    def test_it_is_marked_as_typed(self):
        self.assertTrue(Path(sward.__file__).with_name("py.typed").exists())


class Docstrings(PythonCase):
    def test_every_public_name_has_one(self):
        for name in sward.__all__:
            value = getattr(sward, name)
            if not (inspect.isclass(value) or inspect.isfunction(value)):
                continue
            self.assertTrue(value.__doc__, name)
            if inspect.isclass(value):
                for key, member in public_members(value).items():
                    self.assertTrue(member.__doc__, f"{name}.{key}")

    def test_the_page_names_everything(self):
        page = (ROOT / "docs/python.md").read_text(encoding="utf-8")
        words = set(re.findall(r"[\w]+", " ".join(re.findall(r"`([^`\n]+)`", page))))
        for name in sward.__all__:
            self.assertIn(name, words | {"Ground", "Progress", "Value"})
            value = getattr(sward, name)
            if inspect.isclass(value) and value is not sward.Error:
                self.assertEqual(set(public_members(value)) - words, set(), name)

    def test_members_of_blades_and_patches_are_in_the_page(self):
        page = (ROOT / "docs/python.md").read_text(encoding="utf-8")
        field = sward.bake("plane", count=10)
        for array in (field.blades(), field.patches, field.keys, field.packed):
            for name in array.dtype.names:
                self.assertIn(f"`{name}`", page)


if __name__ == "__main__":
    unittest.main()
