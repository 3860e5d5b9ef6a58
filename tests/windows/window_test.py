"""The window of sward-view.exe by Wine on an X server, steered by mouse and keys. windows_test.py runs this with the rest."""

import json
import os
import shutil
import sys
from pathlib import Path

import numpy as np
from PIL import Image

import wine
from wine import Case, ROOT, WINDOWS, baked, linux, shared_folder

sys.path.append(str(ROOT / "tests/viewer"))
from display import share_that_differs  # noqa: E402
from viewer import Viewer  # noqa: E402

MEADOW = ("wiese-ä-草.sward", "plane", "--meadow", "grass", "--count", "6000", "--blade-scale", "4", "--sky-rays", "0")
OTHER = ("other.sward", "hills", "--meadow", "grass", "--count", "900", "--blade-scale", "8", "--sky-rays", "0")
SIZE = (900, 600)


def of_windows(path):
    """The path as Windows has it: Wine's drive Z: is the whole of Linux."""
    return "Z:" + str(path).replace("/", "\\")


class Windows(Case):
    def setUp(self):
        self.place = self.folder() / "ort-ä-草"
        self.place.mkdir()
        self.display = wine.display()
        self.display.let_go()
        self.state = self.place / "zustand-ä-草"

    def field(self, made=MEADOW):
        """A field of the test's own."""
        return Path(shutil.copy(shared_folder() / baked(*made), self.place))

    def start(self, *arguments, size=SIZE, environment=None):
        program = self.place / "sward-view"
        program.write_text(f'#!/bin/sh\nexec "{wine.WINE}" "{WINDOWS}/sward-view.exe" "$@"\n')
        program.chmod(0o755)
        if "--resolution" not in arguments:
            arguments += ("--resolution", "0.3")
        # Wine hands no layers on.
        viewer = Viewer(program, self.display, self.place, (*arguments, "--size", "{}x{}".format(*size)), validated=False,
                        environment={**wine.environment(), "XDG_STATE_HOME": of_windows(self.state), **(environment or {})})
        self.addCleanup(viewer.close)
        return viewer

    def open(self, *arguments, **options):
        viewer = self.start(*arguments, **options)
        viewer.wait_for_field()
        return viewer

    def assert_ends_well(self, viewer):
        code, said = viewer.end()
        self.assertEqual(code, 0, said)

    def wait_for_total(self, viewer, total):
        viewer.wait_for_value("Status/Numbers", lambda shown: f" of {total:,} blades".replace(",", " ") in shown,
                              f"{total} blades are shown")


class Window(Windows):
    def test_it_shows_what_render_draws_and_takes_keys_and_the_mouse(self):
        field = self.field()
        still, size = ("--wind-strength", "0", "--camera", "eye", "--samples", "4"), (420, 300)
        viewer = self.start(field, *still, "--panel", "off", "--resolution", "1", size=size)
        viewer.wait_for_title()
        viewer.key("space")
        self.display.xdotool("mousemove", 1200, 780)  # the server draws it over the window
        viewer.wait_frames(3)
        seen = viewer.window.picture()
        viewer.key("p")
        taken = self.place / "sward.png"
        viewer.wait(taken.exists, "a picture is taken")
        viewer.wait_frames(3)
        # By the program of Linux.
        drawn = self.place / "drawn.png"
        self.check(linux("sward-view", "render", field, *still, "--size", "{}x{}".format(*size), "-o", drawn, "-q"))
        taken, drawn = (np.asarray(Image.open(path).convert("RGB"))[..., ::-1].astype(np.int16) for path in (taken, drawn))
        self.assertTrue((taken == drawn).all(), "its picture has the pixels of Linux")
        self.assertTrue((seen == drawn).all(), "and so has the window")
        for name, move in {"turn": lambda: viewer.window.drag((200, 150), (300, 200)),
                           "pan": lambda: viewer.window.drag((200, 150), (240, 110), button=2),
                           "dolly": lambda: viewer.window.wheel(4)}.items():
            with self.subTest(move=name):
                move()
                viewer.wait(lambda: share_that_differs(seen, viewer.window.picture()) > 0.1, "the picture moves")
                viewer.key("Home")
                # But for the mouse, which lies over it now.
                viewer.wait(lambda: share_that_differs(seen, viewer.window.picture()) < 0.005, "and returns")
        viewer.window.resize(500, 260)
        viewer.wait(lambda: viewer.window.geometry()[2:] == (500, 260), "it has another size")
        viewer.wait(lambda: (viewer.window.picture()[:, -1].max(axis=1) > 0).all(), "it is filled")
        viewer.window.key("Escape")
        viewer.process.wait(timeout=wine.PATIENCE)
        self.assertEqual(viewer.process.returncode, 0, viewer.said())

    def test_panels_open_and_a_field_that_is_replaced_is_shown_anew(self):
        field = self.field()
        viewer = self.open(field, "--watch", "--panel", "wind")
        self.wait_for_total(viewer, 6000)
        viewer.set("Total strength", "Wind", 0.9)
        self.assertGreater(float(viewer.shows("Wind/Total strength")), 20)
        viewer.open_panel("Field")
        self.assertEqual(Path(viewer.shows("Field/File").replace("\\", "/")).name, field.name)
        # Under another name first: Windows shows no file that is half written.
        new = shutil.copy(shared_folder() / baked(*OTHER), self.place / "new.sward")
        os.replace(new, field)
        self.wait_for_total(viewer, 900)
        self.assert_ends_well(viewer)
        recent = (self.state / "sward/recent").read_text("utf-8").split()
        self.assertEqual(recent, [of_windows(field)])

    def test_a_ground_is_baked_first_and_saved_under_a_name(self):
        recipe = self.place / "grund-ä草.json"
        recipe.write_text(json.dumps({"kind": "plane", "size": [4, 4], "cells": [4, 4]}))
        viewer = self.open(recipe, "--meadow", "grass", "--panel", "field")
        self.assertIn("baking it first", viewer.said())
        viewer.press("Save field as...", panel="Field")
        viewer.wait_for_value("Files/Name", lambda shown: shown == "grund-ä草.sward", "it proposes a name")
        viewer.wait_frames(3)
        viewer.key("Return")
        saved = self.place / "grund-ä草.sward"
        viewer.wait(saved.exists, "the field is written")
        viewer.wait_for_value("Field/Saved", lambda shown: shown == saved.name, "it is told")
        self.check(linux("sward", "validate", saved))
        self.assert_ends_well(viewer)

    def test_a_film_is_handed_to_ffmpeg(self):
        # What stands in for it: a program of the tests, which writes its input.
        programs = self.place / "programme-ä"
        programs.mkdir()
        shutil.copy(WINDOWS / "system_calls.exe", programs / "ffmpeg.exe")
        viewer = self.open(self.field(), "--panel", "capture", "--resolution", "1", environment={"WINEPATH": of_windows(programs)},
                           size=(640, 480))
        viewer.press("Video", panel="Capture")
        viewer.set("Pictures", "Capture", 0.02)
        viewer.wait_for_value("Capture/Pictures", lambda shown: int(shown) < 5, "few pictures")
        pictures = int(viewer.shows("Capture/Pictures"))
        viewer.press("Take sequence", panel="Capture")
        film = self.place / "sward.mp4"
        viewer.wait(film.exists, "the film is there")
        self.assertEqual(film.stat().st_size, pictures * 640 * 480 * 4)
        self.assertEqual(list(self.place.glob("*.part*")), [])
        self.assert_ends_well(viewer)

    def test_what_it_cannot_open_is_refused(self):
        broken = self.place / "kaputt-ä.sward"
        broken.write_bytes((shared_folder() / baked(*MEADOW)).read_bytes()[:1000])
        for file, code in ((broken, 3), (self.place / "missing.sward", 2)):
            viewer = self.start(file)
            self.assertEqual(viewer.process.wait(timeout=wine.PATIENCE), code, viewer.said())
            self.assertIn(file.name, viewer.said())


class Painting(Windows):
    def begin(self, viewer):
        viewer.key("space")
        viewer.click("Paint/Start painting")
        viewer.wait(lambda: {"Paint/Kind", "Question/Text"} & set(viewer.controls()), "it begins or asks")

    def paint(self, viewer, y, count):
        viewer.drag((600, y), (760, y), steps=2)
        viewer.wait_for_value("Paint/Count", lambda shown: shown == str(count), f"{count} strokes")

    @staticmethod
    def strokes(file):
        return len(json.loads(file.read_text())["strokes"]) if file.exists() else 0

    def test_each_window_has_its_own_autosave_and_what_is_left_is_offered(self):
        field = self.field()
        own, others = (self.place / f"{field.stem}.strokes.autosave{n}.json" for n in ("", "-2"))
        opens = (field, "--ground", "plane", "--panel", "paint", "--camera", "top")
        one = self.open(*opens)
        self.begin(one)
        for count, y in ((1, 300), (2, 340)):
            self.paint(one, y, count)
        one.wait(lambda: self.strokes(own) == 2, "it is saved by itself")
        one.wait_for_value("Paint/Blades", lambda shown: shown not in ("", "0"), "the session answers")
        # The second lies over the first.
        other = self.open(*opens)
        self.begin(other)
        self.assertIn("Paint/Kind", other.controls(), "the work of the first is not offered")
        self.paint(other, 400, 1)
        other.wait(lambda: self.strokes(others) == 1, "it has a file of its own")
        other.key("ctrl+z")
        other.wait(lambda: not others.exists(), "nothing is left of it")
        self.assertEqual(self.strokes(own), 2)
        # What a killed one leaves is offered to the other.
        one.process.kill()
        one.process.wait()
        self.assertEqual(self.strokes(own), 2)
        other.click("Paint/Stop painting")
        other.wait(lambda: "Paint/Start painting" in other.controls(), "it has stopped")
        other.wait_frames(3)
        other.click("Paint/Start painting")
        other.wait(lambda: "2 strokes" in (other.shows("Question/Text") or ""), "it offers them")
        other.wait_frames(3)
        other.click("Question/Load them")
        other.wait_for_value("Paint/Count", lambda shown: shown == "2", "they are loaded")
        self.assertEqual(self.strokes(own), 2)
        self.assert_ends_well(other)
        self.assertFalse(own.exists(), "closed without saving")
        self.assertEqual([path.name for path in self.place.iterdir() if "lock" in path.name], [])
