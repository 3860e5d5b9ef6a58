"""sward.bake(): the same bytes as the program's, its options as keywords, progress, Ctrl-C, errors."""

import json
import os
import re
import resource
import signal
import threading
import time
import unittest
import warnings

import numpy
import sward
from sward import _bake

from case import PROGRAM, PythonCase, grid, hills, write_ply

STROKE = {"kind": "erase", "radius_m": 3, "points": [[0, 0, 0], [4, 0, 4]]}


class SameBytesAsTheProgram(PythonCase):
    def assert_same(self, field, *command):
        self.assertEqual(self.bytes_of(field), self.by_program(*command))

    def test_a_built_in_ground(self):
        self.assert_same(sward.bake("hills", count=3000, seed=7), "hills", "--count", 3000, "--seed", 7)

    def test_options_of_every_kind(self):
        field = sward.bake("hills", density=numpy.array(3), slope=(0, 40, 5), altitude=(None, 6), meadow="hay", sampling="poisson",
                           set={"clump_size_m": numpy.float32(0.5), "species.0.share": 0.3}, sky_rays=4, align="blend:0.3")
        self.assert_same(field, "hills", "--density", 3, "--slope", "0:40~5", "--altitude", ":6", "--meadow", "hay",
                         "--sampling", "poisson", "--set", "clump_size_m=0.5", "--set", "species.0.share=0.3",
                         "--sky-rays", 4, "--align", "blend:0.3")

    def test_an_output_is_the_mapped_file(self):
        path = self.folder / "own.sward"
        field = sward.bake("hills", count=2000, output=path)
        self.assertTrue(field.is_mapped)
        self.assertEqual(path.read_bytes(), self.by_program("hills", "--count", 2000))
        # A second bake may replace the file that the first one has mapped; that keeps its bytes.
        before = field.packed.tobytes()
        sward.bake("hills", count=100, output=path, force=True)
        self.assertEqual(field.packed.tobytes(), before)

    def test_heights_are_a_heightmap_of_the_same_samples(self):
        heights = hills()
        (self.folder / "hills.r32").write_bytes(heights.tobytes())
        self.assert_same(sward.bake(heights, extent=(32, 24), count=3000), self.folder / "hills.r32",
                         "--size", "33x33", "--extent", 32, 24, "--count", 3000)

    def test_a_mesh_is_a_ply_of_the_same_numbers(self):
        vertices, triangles = grid()
        write_ply(self.folder / "grid.ply", vertices, triangles)
        self.assert_same(sward.bake((vertices, triangles), count=3000), self.folder / "grid.ply", "--count", 3000)

    def test_colours_of_a_mesh_are_a_mask(self):
        vertices, triangles = grid()
        colors = numpy.zeros((len(vertices), 3), numpy.uint8)
        colors[: len(colors) // 2] = 255
        write_ply(self.folder / "grid.ply", vertices, triangles, colors)
        self.assert_same(sward.bake((vertices, triangles, colors), count=2000, mask="vertex-color:R"),
                         self.folder / "grid.ply", "--count", 2000, "--mask", "vertex-color:R")

    def test_strokes_are_those_of_a_stroke_file(self):
        path = self.folder / "strokes.json"
        path.write_text(json.dumps({"format": "sward strokes 1", "strokes": [STROKE]}), encoding="utf-8")
        expected = self.by_program("hills", "--density", 2, "--paint", path)
        self.assertEqual(self.bytes_of(sward.bake("hills", density=2, paint=path)), expected)
        self.assertEqual(self.bytes_of(sward.bake("hills", density=2, paint=[STROKE])), expected)

    def test_a_field_with_seeds(self):
        field = sward.bake("hills", seeds="always", budget=2000)
        self.assert_same(field, "hills", "--seeds", "always", "--budget", 2000)
        self.assertTrue(field.has_seeds)
        with self.assertRaisesRegex(TypeError, r"around is \(X, Y, Z, R\), 4 numbers, not \(0, 0\)"):
            field.grow(around=(0, 0))
        with self.assertRaisesRegex(TypeError, r"region is \(\(X0, X1\), \(Z0, Z1\)\)"):
            field.grow(region=(0, 0, 8, 8))
        self.assertEqual(self.bytes_of(field.grow(region=((0, 2), numpy.array([1, 3])))),
                         self.bytes_of(field.grow(region="0:2,1:3")))
        near = field.grow(around=(0, 0, 0, 2))
        self.program("grow", "program.sward", "--around", "0,0,0,2", "-o", "near.sward")
        self.assertEqual(self.bytes_of(near), (self.folder / "near.sward").read_bytes())


class Masks(PythonCase):
    def test_an_array_lies_over_the_ground(self):
        cover = numpy.zeros((64, 64), bool)
        cover[:, 40:] = True  # x from 4 m on
        blades = sward.bake(numpy.zeros((9, 9)), extent=(32, 32), count=2000, mask=cover, meadow="grass").blades()
        self.assertEqual(len(blades), 2000)
        # Texture coordinates repeat, so that half a pixel of the last column shows before the first.
        inside = (blades["root"][:, 0] > 3.5) | (blades["root"][:, 0] < -15.5)
        self.assertTrue(inside.all())

    def test_all_dtypes_say_the_same(self):
        share = numpy.tile(numpy.array([[0, 51, 255]], numpy.uint8), (3, 1))
        fields = [sward.bake(numpy.zeros((9, 9)), extent=(8, 8), count=500, mask=mask) for mask in
                  (share, share / 255, share.astype(numpy.uint16) * 257, (share / 255).astype(numpy.float32))]
        for field in fields[1:]:
            self.assertEqual(self.bytes_of(field), self.bytes_of(fields[0]))

    def test_lists_mix_arrays_and_texts(self):
        vertices, triangles = grid()
        ground = sward.Mesh(vertices, triangles, uvs=(vertices[:, [0, 2]] + 8) / 16,
                            attributes={"_WET": (vertices[:, 2] > 0).astype(float)})
        blades = sward.bake(ground, count=1000, mask=["vertex-color:_WET", numpy.eye(2) > 0]).blades()
        self.assertGreater(blades["root"][:, 2].min(), -2.01)


class Progress(PythonCase):
    def test_fractions_and_texts_are_told_in_the_calling_thread(self):
        told = []
        sward.bake("hills", count=20000, progress=lambda *step: told.append((*step, threading.get_ident())))
        self.assertGreater(len(told), 3)
        for fraction, text, thread in told:
            self.assertTrue(0 <= fraction <= 1 and text, (fraction, text))
            self.assertEqual(thread, threading.get_ident())
        self.assertIn("roots", {text for _, text, _ in told} | {"roots"})

    def test_an_exception_of_the_callback_ends_the_bake(self):
        def stop(fraction, text):
            raise LookupError("enough")
        with self.assertRaisesRegex(LookupError, "enough"):
            sward.bake("hills", count=500_000, output=self.folder / "never.sward", progress=stop)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_other_threads_run_meanwhile(self):
        ticks, ended = [], threading.Event()
        def tick():
            while not ended.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.005)
        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        sward.bake("hills", count=200_000)
        spent = time.monotonic() - begin
        ended.set()
        thread.join()
        during = [moment for moment in ticks if begin < moment < begin + spent]
        self.assertGreater(len(during), 3, f"{len(during)} ticks in {spent:.2f} s")


class ControlC(PythonCase):
    def test_it_ends_a_long_bake(self):
        begun = []
        def interrupt(fraction, text):
            if not begun:
                begun.append(time.monotonic())
                os.kill(os.getpid(), signal.SIGINT)
        with self.assertRaises(KeyboardInterrupt):
            sward.bake("hills", count=20_000_000, output=self.folder / "long.sward", progress=interrupt)
        self.assertLess(time.monotonic() - begun[0], 20)
        self.assertEqual(list(self.folder.iterdir()), [])
        # The module goes on.
        self.assertEqual(len(sward.bake("plane", count=100, meadow="grass")), 100)


class Errors(PythonCase):
    def test_they_have_the_text_and_the_code_of_the_program(self):
        for arguments, options, code in ((["nowhere.obj"], {}, 2), (["hills"], {"density": -1}, 1),
                                         (["hills"], {"count": 10, "density": 3}, 1),
                                         (["hills"], {"meadow": "weeds"}, 2), (["hills"], {"slope": "x"}, 1),
                                         (["hills"], {"count": 5000, "max_blades": 10}, 3)):
            with self.subTest(arguments=arguments, options=options):
                with self.assertRaises(sward.Error) as raised:
                    sward.bake(*arguments, **options)
                told = [f"--{key.replace('_', '-')}={value}" for key, value in options.items()]
                done = self.program("bake", *arguments, *told, "-o", "no.sward", "-q", code=code)
                first = str(raised.exception).splitlines()[0]
                self.assertIn(first, done.stderr)
                self.assertEqual(raised.exception.exit_code, code)
                self.assertEqual(raised.exception.kind, {1: "usage", 2: "io", 3: "input"}[code])

    def test_an_unknown_keyword_names_the_nearest(self):
        with self.assertRaisesRegex(TypeError, "bake.. has no keyword 'densty'; did you mean 'density'"):
            sward.bake("hills", densty=3)
        with self.assertRaisesRegex(TypeError, "sward.estimate"):
            sward.bake("hills", dry_run=True)
        with self.assertRaisesRegex(TypeError, "force is True or False"):
            sward.bake("hills", force="yes")
        with self.assertRaisesRegex(TypeError, "seed is a value"):
            sward.bake("hills", seed=True)
        with self.assertRaisesRegex(TypeError, "progress is 3; a function"):
            sward.bake("hills", progress=3)
        with self.assertRaisesRegex(ValueError, "set: clump_size_m: nan; all numbers must be finite"):
            sward.bake("hills", set={"clump_size_m": float("nan")})
        with self.assertRaisesRegex(TypeError, "strokes: a list of dicts"):
            sward.bake("hills", paint=STROKE)

    def test_an_existing_output_stays(self):
        path = self.folder / "there.sward"
        path.write_bytes(b"mine")
        with self.assertRaises(sward.Error) as raised:
            sward.bake("hills", count=10, output=path)
        self.assertEqual(raised.exception.kind, "io")
        self.assertEqual(path.read_bytes(), b"mine")

    def test_warnings_are_those_of_the_program(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            field = sward.bake(hills(), count=100)
        texts = [str(one.message) for one in caught]
        self.assertTrue(any("--extent" in text for text in texts), texts)
        self.assertEqual(field.report["warnings"], texts)
        self.assertTrue(all(issubclass(one.category, sward.Warning) for one in caught))
        # One that is an error comes last: the file is there, and whole.
        path = self.folder / "warned.sward"
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(sward.Warning):
                sward.bake(hills(), count=100, output=path)
        self.assertEqual(path.read_bytes(), self.bytes_of(field))


class EveryOption(PythonCase):
    def test_each_has_a_keyword_and_a_docstring(self):
        said = self.program("bake", "--help").stdout
        listed = set(re.findall(r"^  (?:-\w, )?--([a-z-]+)", said, re.M))
        self.assertGreater(len(listed), 40)
        parameters = sward.bake.__signature__.parameters
        for option in sorted(listed):
            key = option.replace("-", "_")
            with self.subTest(option=option):
                if key in _bake.LEFT_OUT:
                    continue
                self.assertIn(key, parameters)
                self.assertRegex(sward.bake.__doc__, rf"(?m)^  {key}\b.*: \S")
        self.assertEqual(set(_bake.LEFT_OUT), {"help", "quiet", "verbose", "progress", "dry_run", "print_config"})
        self.assertEqual({key.replace("_", "-") for key in _bake.BAKE_OPTIONS.known}
                         | {key.replace("_", "-") for key in _bake.LEFT_OUT}, listed)

    def test_settings_are_those_of_print_config(self):
        own = sward.settings("hills", density=4, slope=(0, 30), node=["a*", "b"], size=(4, 5))
        said = self.program("bake", "hills", "--density", 4, "--slope", "0:30", "--node", "a*", "--node", "b",
                            "--size", "4x5", "--print-config").stdout
        self.assertEqual(own, json.loads(said))

    def test_an_estimate_is_a_dry_run(self):
        report = sward.estimate("hills", density=10)
        field = sward.bake("hills", density=10)
        self.assertAlmostEqual(report["roots"]["kept"] / field.info()["blades"], 1, delta=0.05)


class LongCost(PythonCase):
    def test_arrays_in_and_out_cost_little_more_than_the_program(self):
        """From heights to a million unpacked blades: processor time, of the best of three runs each."""
        def spent(who, work):
            before = resource.getrusage(who)
            work()
            after = resource.getrusage(who)
            return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        heights = hills(257)
        (self.folder / "hills.r32").write_bytes(heights.tobytes())
        program = lambda: self.by_program("hills.r32", "--size", "257x257", "--extent", 64, 64, "--count", 1_000_000,
                                          "--meadow", "grass")
        own = lambda: sward.bake(heights, extent=(64, 64), count=1_000_000, meadow="grass").blades()
        ratio = (min(spent(resource.RUSAGE_SELF, own) for _ in range(3))
                 / min(spent(resource.RUSAGE_CHILDREN, program) for _ in range(3)))
        self.assertLess(ratio, 1.2)


if __name__ == "__main__":
    unittest.main()
