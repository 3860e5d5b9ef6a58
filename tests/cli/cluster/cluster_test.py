"""A bake dealt out to tiles gives the bytes of one bake, whatever happens to the tiles on the way."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from meshes import color_png, glb_bytes, png, square, textured_gltf
from output_test import small_files_only
from support import CliTest, DONE, INPUT, INTERRUPTED, IO, PROGRAM, USAGE, digest

# Hills over 6 x 5 cells of 32 m, so that every tile has cells and neighbours.
HILLS = {"kind": "hills", "extent": [192, 160], "cells": [96, 80], "seed": 3, "height": 6, "width": 40,
         "octaves": 3}
TILES = 6
OPTIONS = ("--density", "1", "--seed", "7", "--clearance", "0.3", "--sky-rays", "2")


class ClusterTest(CliTest):
    def setUp(self):
        super().setUp()
        self.ground = self.write_json("hills.json", HILLS).name

    def plan(self, *options, tiles=TILES, to="plan.json", **how):
        self.sward("plan", self.ground, "--tiles", tiles, "-o", to, "-q", *options, **how)

    def tile(self, index, *options, plan="plan.json", to="tiles", **how):
        return self.sward("tile", plan, "--index", index, "-o", to, *options, **how)

    def merge(self, plan="plan.json", tiles="tiles", to="merged.sward"):
        self.sward("merge", plan, tiles, "-o", to, "-q")
        return self.folder / to

    def tile_file(self, index, folder="tiles"):
        return self.folder / folder / f"tile-{index:06}.blades"


class Tiles(ClusterTest):
    def test_masks_and_cut_outs_are_the_same_in_tiles(self):
        # What a mask reads of an untransformed set, and the holes of a material that moves its own.
        noise = random.Random(6).randbytes(4 * 64 * 64)
        (self.folder / "holes.png").write_bytes(png(64, 64, 8, 6, noise))
        (self.folder / "mask.png").write_bytes(color_png(64, 64, noise[:3 * 64 * 64]))
        mesh = square(160.0, cells=40)
        uvs = [(x / 160.0 + 0.5, z / 160.0 + 0.5) for x, _, z in mesh.positions]
        document = json.loads(textured_gltf(mesh, uvs, "holes.png"))
        material = document["materials"][0]
        material["alphaMode"] = "MASK"
        material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
            "KHR_texture_transform": {"scale": [3, 5], "rotation": 0.4}}
        self.ground = self.write_json("moved.gltf", document).name
        options = ("--density", "1", "--mask", "texture:mask.png:G", "--report", "report.json", "--force")
        whole = digest(self.bake(self.ground, *options))
        rejected = self.read_json("report.json")["roots"]["rejected"]
        self.assertGreater(rejected["cutout"], 1000)
        self.plan(*options[:4])
        for index in range(TILES):
            self.tile(index)
        self.sward("merge", "plan.json", "tiles", "-o", "merged.sward", "-q", "--report", "merged.json")
        self.assertEqual(digest(self.folder / "merged.sward"), whole)
        merged = self.read_json("merged.json")
        self.assertEqual(merged["roots"]["rejected"], rejected)
        self.assertEqual(merged["masks"], [{"mask": "texture:mask.png:G", "reads": "TEXCOORD_0"}])

    def test_any_order_and_any_threads_give_the_bytes_of_one_bake(self):
        whole = digest(self.bake(self.ground, *OPTIONS))
        self.plan(*OPTIONS)
        for folder, order, threads in (("a", range(TILES), 1), ("b", (4, 1, 5, 0, 3, 2), 3)):
            for index in order:
                self.tile(index, "--threads", threads, to=folder)
            self.assertEqual(digest(self.merge(tiles=folder, to=f"{folder}.sward")), whole)
        for index in range(TILES):
            self.assertEqual(digest(self.tile_file(index, "a")), digest(self.tile_file(index, "b")))

    def test_the_memory_of_a_merge_is_that_of_a_tile(self):
        peaks = {}
        for count in (10_000, 800_000):
            self.plan("--count", count, "--sky-rays", 0, "--meadow", "grass", tiles=12, to=f"{count}.json")
            for index in range(12):
                self.tile(index, "--threads", 1, plan=f"{count}.json", to=f"of-{count}")
            self.sward("merge", f"{count}.json", f"of-{count}", "-o", f"{count}.sward", "--report", "report.json", "--force", "-q")
            peaks[count] = self.read_json("report.json")["memory_bytes"]["peak"]
        # Of 24 bytes a blade; a tile has a twelfth, and patches half a byte for each blade.
        self.assertLess(peaks[800_000] - peaks[10_000], 24 * 800_000 / 4)

    def test_any_number_of_tiles_does_too(self):
        # 20 are more than there are cells: some tiles are empty.
        whole = digest(self.bake("hills", "--density", "10"))
        for tiles in (1, 3, 20):
            self.sward("plan", "hills", "--density", "10", "--tiles", tiles, "-o", f"{tiles}.json")
            for index in range(tiles):
                self.tile(index, plan=f"{tiles}.json", to=f"of-{tiles}")
            merged = self.merge(plan=f"{tiles}.json", tiles=f"of-{tiles}", to=f"{tiles}.sward")
            self.assertEqual(digest(merged), whole, tiles)

    def test_seeds_are_the_same_in_tiles(self):
        options = ("--density", "20", "--seed", "7", "--clearance", "0.3", "--sky-rays", "2", "--budget", "20000")
        for use, tiles in (("always", TILES), ("few", 3)):
            with self.subTest(use=use):
                sown = (*options, "--seeds", "always")
                whole = self.bake(self.ground, *sown, "--report", "whole.json", "--force", to=f"{use}.sward")
                self.assertGreater(self.info(whole)["seeds"]["cells"], 25)
                self.plan(*sown, tiles=tiles, to=f"{use}.json")
                for index in range(tiles):
                    self.assertIn("seeds in", self.tile(index, plan=f"{use}.json", to=f"{use}-tiles").stdout)
                merged = self.merge(f"{use}.json", f"{use}-tiles", f"{use}-merged.sward")
                self.assertEqual(digest(merged), digest(whole))
                self.sward("merge", f"{use}.json", f"{use}-tiles", "-o", "again.sward", "--force", "--report", "merged.json", "-q")
                told = [self.read_json(name)["seeds"] for name in ("whole.json", "merged.json")]
                self.assertEqual(*told)
                (self.folder / "merged.json").unlink()
        # The field says the scale of its blades.
        small = ("--density", "500", "--blade-scale", "0.5", "--ground-up", "radial", "--budget", "3000", "--seeds", "always")
        whole = self.bake("sphere", *small, to="sphere.sward")
        self.assertEqual(self.info(whole)["provenance"]["blade_scale"], 0.5)
        self.sward("plan", "sphere", *small, "--tiles", 3, "-o", "sphere.json", "-q")
        for index in range(3):
            self.tile(index, plan="sphere.json", to="sphere-tiles")
        self.assertEqual(digest(self.merge("sphere.json", "sphere-tiles", "sphere-merged.sward")), digest(whole))
        # A plan with seeds is another plan than one without; what cannot be sown is refused.
        self.plan(*options, to="plain.json")
        self.refused("tile", "plain.json", "--index", "0", "-o", "always-tiles", code=INPUT, names=["belongs to plan"])
        self.refused("plan", self.ground, "--tiles", "2", "-o", "p.json", "--count", "9", "--seeds", "always",
                     code=USAGE, names=["--seeds", "--count"])

    def test_an_exact_count_is_exact_over_tiles(self):
        for spread in ("uniform", "poisson"):
            with self.subTest(spread=spread):
                options = ("--count", "10007", "--sampling", spread, "--slope", "0:30~10")
                whole = self.bake(self.ground, *options, to=f"{spread}.sward")
                self.assertEqual(self.info(whole)["blades"], 10007)
                self.plan(*options, to=f"{spread}.json")
                for index in range(TILES):
                    self.tile(index, plan=f"{spread}.json", to=f"{spread}-tiles")
                merged = self.merge(f"{spread}.json", f"{spread}-tiles", f"{spread}-merged.sward")
                self.assertEqual(digest(merged), digest(whole))

    def test_a_tile_baked_twice_says_so_and_keeps_its_bytes(self):
        self.plan(*OPTIONS)
        self.tile(2)
        file = self.tile_file(2)
        before = (digest(file), file.stat().st_mtime_ns, file.stat().st_ino)
        self.assertIn("there already", self.tile(2).stdout)
        self.assertEqual((digest(file), file.stat().st_mtime_ns, file.stat().st_ino), before)
        self.assertNotIn("there already", self.tile(2, "--force").stdout)
        self.assertEqual(digest(file), before[0])
        self.assertNotEqual(file.stat().st_ino, before[2])

    def test_missing_and_damaged_tiles_are_named_as_an_array(self):
        self.plan(*OPTIONS)
        self.merge_fails(IO, "0-5", missing="0-5")
        for index in range(TILES):
            self.tile(index)
        whole = digest(self.merge(to="whole.sward"))
        for index in (0, 3, 4):
            self.tile_file(index).unlink()
        self.merge_fails(IO, "0,3-4", missing="0,3-4")
        # Cut short, one bit changed, empty: each is found, beside those that are missing.
        content = self.tile_file(1).read_bytes()
        for damage in (content[:-9], content[:5000] + bytes([content[5000] ^ 1]) + content[5001:], b""):
            self.tile_file(1).write_bytes(damage)
            self.merge_fails(INPUT, "0-1,3-4", missing="0,3-4", damaged="1")
        # A second run replaces damaged tiles and keeps the others.
        for index in (0, 1, 3, 4):
            self.assertNotIn("there already", self.tile(index).stdout)
        self.assertIn("there already", self.tile(2).stdout)
        self.assertEqual(digest(self.merge()), whole)
        self.tile_file(5).write_bytes(b"x")
        self.merge_fails(INPUT, "5", damaged="5")

    def merge_fails(self, code, again, missing="none", damaged="none"):
        self.refused("merge", "plan.json", "tiles", "-o", "out.sward", code=code,
                     names=[f"missing ({missing})", f"damaged ({damaged})", f"bake again: {again}\n"])

    def test_a_plan_whose_arguments_are_no_list_is_refused(self):
        self.plan("--count", 10)
        plan = json.loads((self.folder / "plan.json").read_text())
        for arguments in (None, {"a": "--count"}, "--count=10"):
            self.write_json("wrong.json", plan | {"arguments": arguments})
            self.refused("tile", "wrong.json", "--index", "0", "-o", "none", code=INPUT,
                         names=["wrong.json", "arguments"])

    def test_a_tile_of_another_plan_is_refused(self):
        self.plan(*OPTIONS)
        self.plan(*OPTIONS, "--align", "vertical", to="other.json")
        for index in range(TILES):
            self.tile(index)
            self.tile(index, plan="other.json", to="others")
        shutil.copy(self.tile_file(3, "others"), self.tile_file(3))
        done = self.refused("merge", "plan.json", "tiles", "-o", "out.sward", code=INPUT,
                            names=["damaged (3)", "belongs to plan"])
        self.assertIn(self.tile_file(3).name, done.stderr)
        # Nor does a tile stand for another one of its plan.
        shutil.copy(self.tile_file(1), self.tile_file(3))
        done = self.refused("merge", "plan.json", "tiles", "-o", "out.sward", code=INPUT, names=["damaged (3)", "tile 1, not"])
        self.assertIn(self.tile_file(3).name, done.stderr)
        shutil.copy(self.tile_file(3, "others"), self.tile_file(3))
        # Tiles of another plan are not replaced either.
        before = digest(self.tile_file(3))
        self.refused("tile", "plan.json", "--index", "3", "-o", "tiles", code=INPUT,
                     names=[self.tile_file(3).name, "--force"])
        self.assertEqual(digest(self.tile_file(3)), before)
        self.tile(3, "--force")
        self.assertEqual(digest(self.merge()), digest(self.bake(self.ground, *OPTIONS)))

    def test_a_file_that_changed_after_the_plan_is_refused(self):
        """Masks, areas, and the meadow with its masks: named, and written anew with the same content they are no others."""
        def mask(shade):
            return color_png(8, 8, bytes([shade] * 3 * 8 * 8))
        species = {"name": "a", "share": 1, "mask": "texture:own.png:R"}
        files = {"mask.png": (mask(255), mask(128)), "own.png": (mask(255), mask(128)),
                 "area.glb": (glb_bytes(square(9.0)), glb_bytes(square(8.0))),
                 "own.json": tuple(json.dumps({"name": "own", "species": [{**species, "height_m": h}]}).encode() for h in (0.2, 0.3))}
        for name, (before, _) in files.items():
            (self.folder / name).write_bytes(before)
        self.plan("--density", "0.1", "--mask", "texture:mask.png", "--exclude", "area.glb:1", "--meadow", "own.json", "--sky-rays", 0, tiles=2)
        for name, (before, after) in files.items():
            (self.folder / name).write_bytes(after)
            self.refused("tile", "plan.json", "--index", "0", "-o", "tiles", code=INPUT, leaves=["tiles"],
                         names=[f"{name}: has changed", "plan.json", "plan again"])
            (self.folder / name).write_bytes(before)
        self.tile(0)

    def test_a_part_of_another_plan_is_refused(self):
        self.plan(*OPTIONS)
        self.plan(*OPTIONS, "--align", "vertical", to="other.json")
        shutil.copy(self.folder / "other.parts/part-000003.ground",
                    self.folder / "plan.parts/part-000003.ground")
        self.refused("tile", "plan.json", "--index", "3", "-o", "tiles", code=INPUT, leaves=["tiles"],
                     names=["part-000003.ground", "belongs to plan"])
        (self.folder / "plan.parts/part-000003.ground").unlink()
        self.refused("tile", "plan.json", "--index", "3", "-o", "tiles", code=IO,
                     names=["part-000003.ground"])

    def test_an_index_that_the_plan_does_not_have_is_wrong_usage(self):
        self.plan(*OPTIONS)
        for index in (TILES, 4294967295, 4294967296, -1, "x", ""):
            self.refused("tile", "plan.json", f"--index={index}", "-o", "tiles", code=USAGE,
                         names=["--index"])
        self.refused("tile", "plan.json", "-o", "tiles", code=USAGE, names=["--index"])
        self.refused("plan", self.ground, "--tiles", "0", "-o", "p.json", code=USAGE, names=["--tiles"])

    def test_a_plan_that_is_not_one_is_refused(self):
        for text, code in (("{}", INPUT), ("no", INPUT), ('{"format": "sward plan 9"}', 5)):
            (self.folder / "bad.json").write_text(text)
            for command in (("tile", "bad.json", "--index", "0", "-o", "tiles"),
                            ("merge", "bad.json", "tiles", "-o", "out.sward")):
                self.refused(*command, code=code, names=["bad.json"])
        self.refused("tile", "none.json", "--index", "0", "-o", "t", code=IO, names=["none.json"])

    def test_no_number_of_a_plan_ends_a_tile_in_any_other_way(self):
        self.sward("plan", "plane", "--count", "60", "--tiles", "2", "-o", "p.json")
        sound = self.read_json("p.json")
        for key in sound["resolved"]:
            if isinstance(sound["resolved"][key], bool):
                continue
            for value in (0, -1, 1e-300, 1e300, -1e300, 1e-30):
                with self.subTest(key=key, value=value):
                    self.write_json("bad.json", {**sound, "resolved": {**sound["resolved"], key: value}})
                    (self.folder / "p.parts").rename(self.folder / "bad.parts")
                    done = subprocess.run([str(PROGRAM), "tile", "bad.json", "--index", "0", "-o", "t", "--force"], cwd=self.folder,
                                          capture_output=True, text=True, timeout=60)
                    (self.folder / "bad.parts").rename(self.folder / "p.parts")
                    self.assertIn(done.returncode, (DONE, INPUT), done.stderr)
                    if key in ("scale", "widening", "thinned") or value < 0:
                        self.assertEqual(done.returncode, INPUT)
                        self.assertIn(key, done.stderr)

    def test_whole_numbers_of_a_plan_are_whole(self):
        self.sward("plan", "plane", "--count", "60", "--tiles", "2", "-o", "p.json")
        sound = self.read_json("p.json")
        (self.folder / "p.parts").rename(self.folder / "bad.parts")
        for part, key in ((None, "tiles"), ("ground", "triangles"), ("ground", "seed"), ("resolved", "root_last_key")):
            for value in (1.5, -1, 1e51, -1e51, "3", None, 1 << 64):
                with self.subTest(key=key, value=value):
                    changed = {**sound, part: {**sound[part], key: value}} if part else {**sound, key: value}
                    self.write_json("bad.json", changed)
                    done = self.sward("tile", "bad.json", "--index", "0", "-o", "t", "--force", code=INPUT)
                    self.assertIn(f"{key} is ", done.stderr)

    def test_a_tile_needs_no_more_memory_in_a_larger_world(self):
        # Tiles of 128 m in worlds of 0.13 and 0.52 million triangles; half of those are 20 MB.
        peaks = {}
        for side in (512, 1024):
            self.ground = self.write_json(f"{side}.json", {**HILLS, "extent": [side, side],
                                                           "cells": [side // 2, side // 2]}).name
            self.plan("--density", "0.5", tiles=side * side // 16384, to=f"{side}-plan.json")
            peaks[side] = max(self.peak("tile", f"{side}-plan.json", "--index", index, "-o", str(side),
                                        "--threads", "1") for index in (5, 9))
        self.assertLess(peaks[1024], 1.1 * peaks[512] + 2e6)

    def peak(self, *arguments):
        """Most memory that a run held [bytes]."""
        process = subprocess.Popen([str(PROGRAM), *map(str, arguments)], cwd=self.folder,
                                   stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, DONE)
        return usage.ru_maxrss * 1024

    def test_an_interrupted_tile_leaves_no_half(self):
        self.plan("--density", "3000", "--sky-rays", "64", tiles=2)
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number.name):
                running = subprocess.Popen(
                    [str(PROGRAM), "tile", "plan.json", "--index", "0", "-o", "tiles", "--progress",
                     "always"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                self.assertTrue(os.read(running.stderr.fileno(), 1))
                running.send_signal(number)
                out, err = running.communicate(timeout=60)
                self.assertEqual((running.returncode, out), (INTERRUPTED, b""), err)
                self.assertEqual(list((self.folder / "tiles").iterdir()), [])

    def test_a_full_disk_leaves_nothing_half_written(self):
        self.plan(*OPTIONS)
        done = self.tile(0, code=IO, before=small_files_only)
        self.assertIn("tile-000000.blades", done.stderr)
        self.assertEqual(list((self.folder / "tiles").iterdir()), [])
        for index in range(TILES):
            self.tile(index)
        whole = self.files()
        self.sward("merge", "plan.json", "tiles", "-o", "f.sward", code=IO, before=small_files_only)
        self.assertEqual(self.files(), whole)
        self.plan(*OPTIONS, to="full.json", code=IO, before=small_files_only)
        self.assertEqual(self.files(), whole)

    def test_a_plan_that_fails_leaves_what_was_there(self):
        self.plan(*OPTIONS)
        before = {name: digest(self.folder / name) for name in self.files()
                  if (self.folder / name).is_file()}
        self.plan("--density", "2", "--force", code=IO, before=small_files_only)
        self.plan("--density", "2", code=IO)
        self.assertEqual(before, {name: digest(self.folder / name) for name in self.files()
                                  if (self.folder / name).is_file()})
        self.plan("--density", "2", "--force")
        self.assertNotEqual(before["plan.json"], digest(self.folder / "plan.json"))
        self.assertEqual(set(before), {name for name in self.files() if (self.folder / name).is_file()})

    def test_a_plan_of_more_cells_than_it_deals_in_a_minute_is_refused_at_once(self):
        # A bake of the same ground has a count, and is done in seconds; the plan would visit each cell of the box.
        (self.folder / "steep.obj").write_text("v 0 0 0\nv 40000 20000 0\nv 0 9000 40000\nf 1 3 2\n", encoding="ascii")
        self.refused("plan", "steep.obj", "--tiles", "2", "--count", "100", "-o", "p.json", code=INPUT,
                     names=["cells of 32 m", "10000000"])

    def test_a_plan_replaces_no_folder_but_that_of_a_plan(self):
        (self.folder / "plan.parts").mkdir()
        mine = self.folder / "plan.parts/letters.txt"
        mine.write_text("mine")
        for force in ((), ("--force",)):
            self.refused("plan", self.ground, "--tiles", "2", "-o", "plan.json", *force, code=IO,
                         names=["plan.parts"])
        mine.unlink()
        self.plan(*OPTIONS)
        # A plan that was killed at its very end has left parts and no plan.
        (self.folder / "plan.json").unlink()
        self.plan(*OPTIONS)

    def test_the_folder_that_files_are_named_from_must_be_there(self):
        (self.folder / "there").mkdir()
        self.sward("plan", f"../{self.ground}", "--tiles", "2", "-o", "../plan.json", "-q",
                   folder=self.folder / "there")
        (self.folder / "there").rmdir()
        for command in (("tile", "plan.json", "--index", "0", "-o", "tiles"),
                        ("merge", "plan.json", "tiles", "-o", "out.sward")):
            self.refused(*command, code=IO, names=["plan.json", self.folder / "there"])

    def test_a_plan_without_its_parts_names_their_folder(self):
        self.plan(*OPTIONS)
        for index in range(TILES):
            self.tile(index)
        bare = self.folder / "plan.parts/bare.sward"
        bare.write_bytes(bare.read_bytes()[:-1])
        self.refused("merge", "plan.json", "tiles", "-o", "out.sward", code=INPUT, names=["plan.parts"])
        shutil.rmtree(self.folder / "plan.parts")
        self.refused("merge", "plan.json", "tiles", "-o", "out.sward", code=IO, names=["plan.parts"])
        self.refused("tile", "plan.json", "--index", "1", "-o", "others", code=IO, names=["plan.parts"],
                     leaves=["others"])

    def test_merge_reports_and_tells_what_bake_does(self):
        options = (*OPTIONS, "--slope", "0:20~10", "--altitude", "-1:", "--sampling", "poisson")
        whole = self.report(self.ground, *options)
        told = self.sward("bake", self.ground, "-o", "again.sward", *options)
        self.plan(*options)
        for index in range(TILES):
            self.tile(index)
        done = self.sward("merge", "plan.json", "tiles", "-o", "merged.sward", "--report", "m.json")
        merged = self.read_json("m.json")
        self.assertEqual(set(merged), set(whole))
        for key in ("tool", "input", "seed", "blade_scale", "roots", "spacing", "density_per_m2",
                    "warnings"):
            self.assertEqual(merged[key], whole[key], key)
        self.assertEqual(merged["output"]["bytes"], whole["output"]["bytes"])
        self.assertEqual(merged["output"]["path"], "merged.sward")
        for stage in ("load", "patches", "write", "total"):
            self.assertGreater(merged["timing_s"][stage], 0.0, stage)
        self.assertRegex(done.stdout, r"^merged\.sward: \d+ blades in \d+ patches, [\d.]+ [kM]B, [\d.]+ s\n$")
        kept = next(line for line in told.stderr.splitlines() if "kept" in line)
        self.assertIn(kept, done.stderr)
        self.refused("merge", "plan.json", "tiles", "-o", "x.sward", "--report", "m.json", code=IO,
                     names=["m.json"])
        self.refused("merge", "plan.json", "tiles", "-o", "x.sward", "--report", "x.sward", code=USAGE,
                     names=["x.sward"])

    def test_plan_and_merge_choose_the_ground_s_own_green(self):
        green, rock = (0.1, 0.3, 0.05, 1.0), (0.3, 0.3, 0.3, 1.0)
        (self.folder / "isle.glb").write_bytes(glb_bytes(
            square(160.0, cells=40, color_of=lambda x, z: green if x < 0 else rock)))
        self.ground = "isle.glb"
        whole = self.report(self.ground, "--density", "0.5")
        self.assertTrue(whole["ground_colors"]["chosen_mask"])
        planned = self.sward("plan", self.ground, "--tiles", TILES, "-o", "plan.json", "--density", "0.5")
        self.assertIn("--mask ground:green", planned.stderr)
        for index in range(TILES):
            self.tile(index)
        done = self.sward("merge", "plan.json", "tiles", "-o", "merged.sward", "--report", "m.json")
        self.assertIn("--mask ground:green", done.stderr)
        self.assertEqual(self.read_json("m.json")["ground_colors"], whole["ground_colors"])
        self.assertEqual(self.info("merged.sward")["provenance"]["settings"]["masks"], ["ground:green"])

    def test_merge_says_why_nothing_grows(self):
        done = self.sward("bake", self.ground, "-o", "none.sward", "--density", "1", "--altitude", "900:")
        self.plan("--density", "1", "--altitude", "900:")
        for index in range(TILES):
            self.tile(index)
        merged = self.sward("merge", "plan.json", "tiles", "-o", "merged.sward")
        warnings = [line for line in done.stderr.splitlines() if "no blade grows" in line]
        self.assertEqual(len(warnings), 1)
        self.assertIn(warnings[0], merged.stderr)

    def test_images_are_there_once_and_wrap_as_their_material_says(self):
        # A texture that is clamped: beyond it the ground keeps the colour of its edge.
        noise = random.Random(5).randbytes(3 * 256 * 256)
        (self.folder / "paint.png").write_bytes(color_png(256, 256, noise))
        mesh = square(160.0, cells=40)
        (self.folder / "painted.gltf").write_text(textured_gltf(
            mesh, [(x / 80.0, z / 80.0) for x, _, z in mesh.positions], "paint.png",
            {"wrapS": 33071, "wrapT": 33648}))
        self.ground = "painted.gltf"
        options = ("--density", "1", "--mask", "material-texture:G", "--mask", "ground:green")
        whole = digest(self.bake(self.ground, *options))
        self.plan(*options)
        for index in range(TILES):
            self.tile(index)
        self.assertEqual(digest(self.merge()), whole)
        pixels = 4 * 256 * 256
        images = list((self.folder / "plan.parts").glob("image-*"))
        self.assertEqual(len(images), 1)
        self.assertGreater(images[0].stat().st_size, pixels)
        for part in (self.folder / "plan.parts").glob("part-*"):
            self.assertLess(part.stat().st_size, pixels)
        content = bytearray(images[0].read_bytes())
        content[5000] ^= 1
        images[0].write_bytes(content)
        self.refused("tile", "plan.json", "--index", "0", "-o", "other", code=INPUT,
                     names=[images[0].name], leaves=["other"])


if __name__ == "__main__":
    unittest.main()
