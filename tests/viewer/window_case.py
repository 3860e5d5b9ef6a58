"""What tests of the window begin with: one X server for all of a file, fields that are baked once, a
folder for each test, and viewers that do not outlive it."""

import atexit
import functools
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from display import Display
from viewer import Viewer

ROOT = Path(__file__).resolve().parents[2]
SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]

# Few pixels: what most tests ask the window does not depend on them, and a CPU draws them faster.
FEW_PIXELS = "0.2"


@functools.cache
def shared_display():
    display = Display()
    atexit.register(display.close)
    return display


@functools.cache
def shared_folder():
    folder = tempfile.TemporaryDirectory(prefix="sward-view-")
    atexit.register(folder.cleanup)
    return Path(folder.name)


@functools.cache
def baked(ground, *options):
    """The field of a ground, baked once for the process."""
    field = shared_folder() / f"{len(list(shared_folder().iterdir()))}.sward"
    subprocess.run([SWARD, "bake", ground, *options, "-o", field, "-q"], check=True)
    return field


@functools.cache
def small_mesh():
    """A mesh that is baked soon, written once for the process."""
    recipe, mesh = shared_folder() / "plane.json", shared_folder() / "plane.glb"
    recipe.write_text(json.dumps({"kind": "plane", "size": [4, 4], "cells": [4, 4]}))
    subprocess.run([SWARD, "terrain", recipe, "-o", mesh], check=True)
    return mesh


class WindowCase(unittest.TestCase):
    SIZE = (900, 600)
    kept = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-view-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        if shared_display.cache_info().currsize > 0:
            self.display.let_go()

    @property
    def display(self):
        return shared_display()

    def field(self, ground="plane", count=1500, scale=8, *options, name=None):
        """A field of the test's own, in its folder."""
        field = self.folder / (name or f"{ground}.sward")
        shutil.copy(baked(ground, "--count", str(count), "--blade-scale", str(scale), *options), field)
        return field

    def mesh(self):
        """plane.glb in the folder of the test."""
        return Path(shutil.copy(small_mesh(), self.folder))

    def start(self, *arguments, size=None, environment=None, belongs_to=None, **process):
        """A viewer that may not have a window yet. `size` is False if it is not told one."""
        if size is not False:
            arguments += ("--size", "{}x{}".format(*(size or self.SIZE)))
        if "--resolution" not in arguments and not process.get("rests"):
            arguments += ("--resolution", FEW_PIXELS)
        viewer = Viewer(VIEWER, self.display, self.folder, arguments, environment, **process)
        (belongs_to.addClassCleanup if belongs_to else self.addCleanup)(viewer.close)
        return viewer

    def open(self, *arguments, **options):
        """A viewer that shows its field."""
        viewer = self.start(*arguments, **options)
        viewer.wait_for_field()
        return viewer

    def open_kept(self, ground="plane", *arguments):
        """A viewer for all tests of the class. They begin at its first view with all panels closed, and leave
        its field and its settings as they were."""
        cls = type(self)
        if cls.kept is None or cls.kept.process.poll() is not None:
            folder = tempfile.TemporaryDirectory(prefix="sward-view-")
            cls.addClassCleanup(folder.cleanup)
            own, self.folder = self.folder, Path(folder.name)
            cls.kept = self.start(self.field(ground), *arguments, belongs_to=cls)
            self.folder = own
            cls.kept.wait_for_field()
        cls.kept.escape_to_picture()
        cls.kept.key("Home")
        return cls.kept

    @classmethod
    def tearDownClass(cls):
        if cls.kept is not None:
            cls().assert_ends_well(cls.kept)

    def assert_ends_well(self, viewer):
        code, said = viewer.end()
        self.assertEqual(code, 0, said)
        self.assertIn("0 validation messages", said)

    def drop(self, viewer, *paths):
        # Use a separate process: Xlib ends the whole program on an error.
        subprocess.run([sys.executable, Path(__file__).with_name("drop.py"), self.display.name,
                        viewer.window.number, *(path.as_uri() for path in paths)], check=True)
