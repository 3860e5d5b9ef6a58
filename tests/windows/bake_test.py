"""The offline program for Windows bakes and exports the bytes of that for Linux. windows_test.py runs this with the rest."""

import json
import math
import re
import struct
import subprocess
import sys

import wine
from wine import Case, ROOT, WINDOWS, linux, shared_folder, windows

sys.path.append(str(ROOT / "tests/cli"))
from meshes import bumps, color_png, glb_bytes, grey_png, obj_text, square, stl_bytes, textured_gltf  # noqa: E402

LANDSCAPE = ROOT / "assets/meshes/landscape.glb"
CODED = ROOT / "tests/fuzz/corpus/gltf_import"  # with Draco and meshoptimizer


def moved(mesh, x):
    mesh.positions = [(p[0] + x, p[1], p[2]) for p in mesh.positions]
    return mesh


def ply_text(mesh):
    head = f"ply\nformat ascii 1.0\nelement vertex {len(mesh.positions)}\nproperty float x\nproperty float y\nproperty float z\n"
    head += f"element face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    return head + "".join(f"{x} {y} {z}\n" for x, y, z in mesh.positions) + "".join(f"3 {a} {b} {c}\n" for a, b, c in mesh.triangles)


def off_text(mesh):
    return (f"OFF\n{len(mesh.positions)} {len(mesh.triangles)} 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in mesh.positions)
            + "".join(f"3 {a} {b} {c}\n" for a, b, c in mesh.triangles))


class Bakes(Case):
    """All is done by both programs, in folders of their own: what they say and what they write is equal."""

    def both(self, folder, *arguments, code=0):
        """Runs sward in FOLDER/linux and FOLDER/windows; returns what is said, without times."""
        said = []
        for run in (linux, windows):
            place = folder / run.__name__
            place.mkdir(exist_ok=True)
            done = run("sward", *arguments, cwd=place)
            self.assertEqual(done.returncode, code, done.stderr.decode(errors="replace"))
            said.append(re.sub(r"\b\d[\d.]* s\b", "… s", (done.stdout + done.stderr).decode()))
            # Absolute paths begin with a drive on Windows, and what it joins has a backslash.
            said[-1] = re.sub(r"\S*/(linux|windows)/", "…/", said[-1].replace("\\", "/"))
        self.assertEqual(*said)
        return said[0]

    def equal(self, folder, *names):
        for name in names:
            with self.subTest(file=name):
                self.assertTrue((folder / "linux" / name).read_bytes() == (folder / "windows" / name).read_bytes(), f"{name} differs")

    def test_grounds_of_every_kind_give_the_same_fields(self):
        folder = self.folder()
        (folder / "ä.obj").write_text(obj_text(bumps()))
        (folder / "草.ply").write_text(ply_text(moved(bumps(), 20)))
        (folder / "b.stl").write_bytes(stl_bytes(moved(bumps(), 40)))
        (folder / "c.off").write_text(off_text(moved(bumps(), 60)))
        (folder / "heights.png").write_bytes(grey_png(65, 65, [int(20000 + 9000 * math.sin(i % 65 / 7) * math.cos(i // 65 / 9))
                                                               for i in range(65 * 65)]))
        mesh = square(30.0, color_of=lambda x, z: (0.5 + x / 40, 0.4, 0.3 - z / 60, 1.0))
        uvs = [(x / 30 + 0.5, z / 30 + 0.5) for x, _, z in mesh.positions]
        (folder / "image.png").write_bytes(color_png(32, 32, bytes((7 * i * i) % 251 for i in range(3 * 32 * 32))))
        (folder / "textured.gltf").write_text(textured_gltf(mesh, uvs, "image.png"))
        (folder / "colored.glb").write_bytes(glb_bytes(mesh))
        grounds = {
            "sphere": ("sphere", "--count", "4000"),
            "hills": ("hills", "--meadow", "alpine", "--count", "4000"),
            "landscape": (LANDSCAPE, "--count", "5000"),
            "meshes": ("../ä.obj", "../草.ply", "../b.stl", "../c.off", "--count", "3000", "--sky", "0.2:1", "--clearance", "0.1"),
            "heights": ("../heights.png", "--meadow", "daisies", "--density", "1", "--slope", "0:30", "--curvature", "-1:1"),
            "textured": ("../textured.gltf", "../colored.glb", "--density", "30", "--mask", "texture:../image.png:G"),
            "compressed": (*(CODED / f"{name}.glb" for name in ("draco", "draco_sequential", "meshopt", "meshopt_filters")), "--count", "200"),
            "seeds": ("hills", "--seeds", "always", "--density", "3"),
        }
        for name, arguments in grounds.items():
            with self.subTest(ground=name):
                self.both(folder, "bake", *arguments, "-o", f"{name}-ä草.sward", "-q")
                self.equal(folder, f"{name}-ä草.sward")

    def test_fields_are_told_and_exported_as_on_linux(self):
        folder = self.folder()
        field, other, seeds = (f"../{name}.sward" for name in ("wiese-ä", "other", "seeds"))
        for name, arguments in ((field, ("sphere", "--count", "900")), (other, ("sphere", "--count", "900", "--seed", "2")),
                                (seeds, ("plane", "--density", "30", "--seeds", "always"))):
            (folder / "linux").mkdir(exist_ok=True)
            self.check(linux("sward", "bake", *arguments, "-o", name, "-q", cwd=folder / "linux"))
        for form in ("glb", "ply", "usda", "csv"):
            self.both(folder, "export", field, "-o", f"草.{form}", "-q")
        self.equal(folder, "草.ply", "草.csv")
        # Prototypes of blades are bent by sinf() and cosf(), which the C library of Windows rounds otherwise.
        here, there = ((folder / run / "草.glb").read_bytes() for run in ("linux", "windows"))
        self.assertEqual(len(here), len(there))
        for (a,), (b,), (c,), (d,) in zip(*(struct.iter_unpack(form, data[:len(data) // 4 * 4]) for form in ("<f", "<I") for data in (here, there))):
            self.assertTrue(c == d or abs(a - b) < 1e-6, (a, b))
        number = re.compile(r"-?\d+\.?\d*(?:e[-+]?\d+)?")
        here, there = ((folder / run / "草.usda").read_text("utf-8") for run in ("linux", "windows"))
        self.assertEqual(number.sub("#", here), number.sub("#", there))
        for a, b in zip(number.findall(here), number.findall(there)):
            self.assertTrue(a == b or abs(float(a) - float(b)) < 1e-6, (a, b))
        self.both(folder, "info", field)
        self.both(folder, "validate", field)
        self.both(folder, "compare", field, other, code=7)
        self.both(folder, "grow", seeds, "-o", "grown.sward", "--region=-3:3,-3:3", "-q")
        self.equal(folder, "grown.sward")
        self.both(folder, "terrain", "hills", "-o", "hills.glb", "-q")
        self.equal(folder, "hills.glb")
        # Its light is computed by functions that the C library of Windows rounds otherwise.
        self.check(windows("sward", "trace", field, "-o", "light.png", "--size", "33x33", "--samples", "2", "-q", cwd=folder / "windows"))
        self.assertTrue((folder / "windows/light.png").read_bytes().startswith(b"\x89PNG"))

    def test_openexr_is_left_out_with_a_message(self):
        folder = self.folder()
        self.check(linux("sward", "bake", "plane", "--count", "100", "-o", "plane.sward", "-q", cwd=folder))
        self.check(linux("sward", "trace", "plane.sward", "-o", "light.exr", "--size", "9x9", "--samples", "1", "-q", cwd=folder))
        for arguments in (("bake", "light.exr", "--extent", "9", "9", "-o", "no.sward"),
                          ("trace", "plane.sward", "-o", "no.exr", "--size", "9x9", "--samples", "1")):
            done = windows("sward", *arguments, cwd=folder)
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertIn(b"this build", done.stderr)

    def test_tiles_join_to_the_field_of_one_bake(self):
        folder = self.folder()
        ground = ("hills", "--density", "0.1", "--seed", "7")
        self.both(folder, "plan", *ground, "--tiles", "2", "-o", "plan.json", "-q")
        for index in (0, 1):
            self.both(folder, "tile", "plan.json", "--index", index, "-o", "tiles", "-q")
        self.both(folder, "merge", "plan.json", "tiles", "-o", "merged.sward", "-q")
        self.equal(folder, "merged.sward")

    def test_a_bake_that_stays_open_answers_through_pipes(self):
        folder = self.folder()
        stroke = {"kind": "erase", "radius_m": 3, "hardness": 1, "points": [[0, 0, 0]]}
        answers = []
        for run, program in ((linux, (wine.LINUX / "sward",)), (windows, (wine.WINE, WINDOWS / "sward.exe"))):
            place = folder / run.__name__
            (place / "deltas").mkdir(parents=True)
            with subprocess.Popen([*program, "edit", "plane", "--count", "4000", "--deltas", "deltas", "-q"], cwd=place, text=True,
                                  env=wine.environment(), stdin=subprocess.PIPE, stdout=subprocess.PIPE) as session:
                said = [json.loads(session.stdout.readline())]
                for request in ({"id": 1, "do": "paint", "keep": 0, "strokes": [stroke]}, {"id": 2, "do": "save", "path": "saved-ä.sward"}):
                    print(json.dumps(request), file=session.stdin, flush=True)
                    said.append(json.loads(session.stdout.readline()))
                    said[-1]["bytes"] = [file.read_bytes() for file in sorted((place / "deltas").iterdir())]
                session.stdin.close()
                self.assertEqual(session.wait(60), 0)
            # Absolute paths, and times.
            answers.append([{key: value for key, value in answer.items() if key not in ("delta", "path") and not key.endswith(("_s", "_ms", "seconds"))}
                            for answer in said])
        self.assertEqual(*answers)
        self.equal(folder, "saved-ä.sward")

    def test_complaints_are_those_of_linux(self):
        folder = self.folder()
        whole = LANDSCAPE.read_bytes()
        (folder / "cut-ä.glb").write_bytes(whole[:2000])
        (folder / "words-草.obj").write_text("v 1 2 x\nf 1 2 3\n")
        (folder / "short.png").write_bytes(grey_png(9, 9, [7] * 81)[:60])
        for code, arguments in ((3, ("../cut-ä.glb",)), (3, ("../words-草.obj",)), (3, ("../short.png",)), (2, ("../missing-ä.ply",)),
                                (1, ("sphere", "--density", "ä"))):
            with self.subTest(arguments=arguments):
                said = self.both(folder, "bake", *arguments, "-o", "none.sward", code=code)
                self.assertIn("error: ", said)
        self.assertEqual([*(folder / "windows").iterdir()], [])

    def test_the_viewer_bakes_what_is_missing(self):
        folder = self.folder()
        scene = {"ground": {"kind": "plane", "size": [9, 9], "cells": [2, 2]}, "bake": ["--density", "60", "--blade-scale", "4"]}
        (folder / "scene-ä.json").write_text(json.dumps(scene))
        for run in (linux, windows):
            self.check(run("sward-view", "bench", "scene-ä.json", "--fields", run.__name__, "--size", "160x100", "--frames", "2", "-q", cwd=folder))
        self.equal(folder, "scene-ä.sward")
