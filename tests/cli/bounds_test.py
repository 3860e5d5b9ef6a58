"""Absurd numbers, dense filters and signals: every command ends, soon, and says why."""

import itertools
import json
import random
import signal
import subprocess
import time
import unittest

from meshes import glb_bytes, square
from support import CliTest, DONE, INPUT, INTERRUPTED, PROGRAM, ROOT, USAGE, UNSUPPORTED

RECIPES = {
    "plane": {"size": 2, "cells": 2},
    "sphere": {"radius": 1, "segments": 1, "rings": 1},
    "torus": {"major_radius": 1, "minor_radius": 1},
    "hills": {"extent": 2, "height": 1, "width": 1, "octaves": 1, "lacunarity": 1, "gain": 1},
    "dunes": {"extent": 2, "height": 1, "spacing": 1, "wander": 1},
    "arch": {"span": 1, "thickness": 1, "roughness": 1, "patch": 1},
}
LONGEST = 60.0  # [s] a command may take


class BoundsTest(CliTest):
    def ends(self, *arguments):
        """Runs a bake of few blades; demands an end in time, a known code and a message."""
        began = time.monotonic()
        done = subprocess.run([str(PROGRAM), "bake", *map(str, arguments), "-o", "out-field.sward", "--force",
                               "-q", "--threads", "2", "--max-blades", "100000"],
                              cwd=self.folder, capture_output=True, text=True, timeout=2 * LONGEST)
        self.assertLess(time.monotonic() - began, LONGEST, arguments)
        self.assertIn(done.returncode, (DONE, USAGE, INPUT), f"{arguments}\n{done.stderr}")
        if done.returncode != DONE:
            self.assertIn("error: ", done.stderr)
            # The input is wrong, not what was to be written.
            self.assertNotIn("out-field.sward", done.stderr)
        return done

    def ends_by_signals(self, numbers):
        """Each stage of a bake is interrupted; the signals take turns, or each of them interrupts each stage."""
        (self.folder / "big.obj").write_text(
            "".join(f"v {i % 700} 0 {i // 700}\n" for i in range(490000))
            + "".join(f"f {i + 1} {i + 701} {i + 2}\n" for i in range(489000) if i % 700 != 699))
        for arguments, wait in ((("hills", "--density", "20000"), 1.0),
                                (("hills", "--density", "20000"), 3.0),
                                (("hills", "--spacing", "0.004"), 2.0),
                                (("sphere", "--count", "3000000", "--sky", "0.2:1"), 2.0),
                                (("big.obj", "--count", "1000000", "--border", "1"), 0.5)):
            for number in next(numbers):
                with self.subTest(arguments=arguments, number=number):
                    started = subprocess.Popen(
                        [str(PROGRAM), "bake", *arguments, "-o", "f.sward", "-q", "--max-blades",
                         "400000000"], cwd=self.folder, stderr=subprocess.PIPE)
                    time.sleep(wait)
                    if started.poll() is None:
                        began = time.monotonic()
                        started.send_signal(number)
                        started.wait(timeout=LONGEST)
                        # A second, and the time that a crowded machine takes to end a process.
                        self.assertLess(time.monotonic() - began, 2.0)
                        self.assertEqual(started.returncode, INTERRUPTED)
                        self.assertIn(b"interrupted", started.stderr.read())
                        self.assertLessEqual(self.files(), {"big.obj"})
                    started.stderr.close()
                    (self.folder / "f.sward").unlink(missing_ok=True)


class LongBounds(BoundsTest):
    """Half a minute of work, until the program gives up; and each signal in each stage of a bake."""

    def test_a_count_behind_a_filter_that_keeps_too_little_ends(self):
        for options in (("--slope", "30:30.001"), ("--slope", "30:30.01", "--sampling", "poisson")):
            self.ends("hills", "--count", "20000", *options)

    def test_any_signal_ends_a_bake_within_a_second(self):
        self.ends_by_signals(itertools.repeat((signal.SIGINT, signal.SIGTERM)))


class Bounds(BoundsTest):
    def test_any_exponent_in_a_gltf(self):
        chance = random.Random(1)
        for _ in range(25):
            def number():
                return chance.choice((-1, 1)) * chance.uniform(1, 10) * 10.0 ** chance.randint(-300, 300)

            key = chance.choice(("matrix", "translation", "scale", "rotation"))
            if key == "matrix":
                value = [1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0]
                value[chance.choice((0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14))] = number()
            else:
                value = [1.0] * (4 if key == "rotation" else 3)
                value[chance.randrange(3)] = number()
            (self.folder / "a.glb").write_bytes(glb_bytes(square(4.0), node={key: value}))
            self.ends("a.glb", "--count", "100")

    def test_any_exponent_in_a_recipe(self):
        chance = random.Random(2)
        for _ in range(20):
            kind = chance.choice(list(RECIPES))
            recipe = {"kind": kind}
            for key, count in RECIPES[kind].items():
                if chance.random() < 0.5:
                    values = [chance.uniform(1, 10) * 10.0 ** chance.randint(-4, 7) for _ in range(count)]
                    if key in ("cells", "segments", "rings", "octaves"):
                        values = [int(value) + 1 for value in values]
                    recipe[key] = values if count > 1 else values[0]
            self.write_json("a.json", recipe)
            self.ends("a.json", "--count", "100")

    def test_any_exponent_in_an_option_of_a_heightmap(self):
        chance = random.Random(3)
        (self.folder / "a.r16").write_bytes(bytes(range(200)))
        for _ in range(20):
            def number():
                return repr(chance.choice((1, 1, 1, -1)) * chance.uniform(1, 10)
                            * 10.0 ** chance.randint(-9, 20))

            self.ends("a.r16", "--size", "10x10", "--count", "100", "--extent", number(), number(),
                      f"--height={number()}:{number()}", f"--no-data={number()}",
                      "--endian", chance.choice(("little", "big", "middle")))

    def test_a_count_behind_a_dense_filter_ends(self):
        # Of a thousand candidates three are kept, of a million none.
        for options in (("--slope", "30:30.1"), ("--slope", "30:30.1", "--sampling", "poisson")):
            self.assertEqual(self.ends("hills", "--count", "5000", *options).returncode, DONE)
        done = self.ends("hills", "--count", "5000", "--slope", "30:30.00001")
        self.assertIn("no blade grows", done.stderr)

    def test_slivers_and_a_poisson_count_end(self):
        self.write_json("a.json", {"kind": "dunes", "extent": [0.05, 3000.0], "height": 0.08})
        self.ends("a.json", "--count", "300", "--sampling", "poisson", "--scale", "0.006",
                  "--altitude=-50:50")

    def test_a_signal_ends_a_bake_within_a_second(self):
        self.ends_by_signals(itertools.cycle(((signal.SIGINT,), (signal.SIGTERM,))))

    def test_a_byte_order_mark_changes_no_json(self):
        meadow = sorted((ROOT / "assets/meadows").glob("*.json"))[0].read_text(encoding="utf-8")
        for name, arguments in (("a.json", ["a.json"]), ("m.json", ["plane", "--meadow", "m.json"])):
            content = '{"kind": "plane", "size": [3, 3]}' if name == "a.json" else meadow
            (self.folder / name).write_text(content)
            plain = self.bake(*arguments, "--count", "50", "--force").read_bytes()
            (self.folder / name).write_text("\ufeff" + content)
            self.assertEqual(self.bake(*arguments, "--count", "50", "--force").read_bytes(), plain)

    def test_control_characters_and_long_words_of_a_file_do_not_reach_the_terminal(self):
        word = "x" * 5000
        for content in ('{"kind": "\\u001b]0;title\\u0007plane"}', '{"kind": "%s"}' % word,
                        '{"kind": "plane", "\\u009b2J": 1}', "\x1b[2J\x07"):
            (self.folder / "a.json").write_text(content, encoding="utf-8")
            done = self.sward("bake", "a.json", "-o", "f.sward", code=INPUT)
            for character in "\x1b\x07\x9b":
                self.assertNotIn(character, done.stderr)
            self.assertLess(len(done.stderr), 1500)

    def test_version_one_of_gltf_is_unsupported(self):
        (self.folder / "a.gltf").write_text(json.dumps({"asset": {"version": "1.0"}, "meshes": {}}))
        self.refused("bake", "a.gltf", "-o", "f.sward", code=UNSUPPORTED, names=["version 1"])


if __name__ == "__main__":
    unittest.main()
