"""`sward-view dataset`: a set is the same from any number of processes, and after it was stopped."""

import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
FRAMES = 8
BAKES = {"fields": 2, "ground": {"plane": 1, "flat.obj": 1},
         "options": {"scale": 0.1, "blade-scale": 0.6, "count": [200, 700], "meadow": {"lawn": 1, "own.json": 2},
                     "align": ["normal", "vertical"], "slope": "0:{30..40}", "bare-names": "none"},
         "set": {"clump_size_m": [0.2, 0.6]}}
SCENE = {"about": "a test", "fields": ["f.sward"], "bakes": BAKES, "size": "48x32", "frames": FRAMES, "seed": 3,
         "layers": "depth,id,class,flow-backward,flow-forward", "format": "npz",
         "cameras": {"height_m": [0.3, 0.6], "pitch_deg": [-60, -30], "heading_deg": [0, 360], "fov_y_deg": [40, 60],
                     "speed_m_s": [0.2, 1], "x_m": [-0.5, 0.5]},
         "sun": {"height_deg": [20, 60]}, "wind_strength": [1, 4], "time_s": 5, "settling_frames": 2,
         "objects": {"min_area_pixels": 6}}


def mask_of(segmentation):
    """The mask of a run-length encoding of COCO: differences to the run two before, in digits of five bits."""
    runs, digits = [], []
    for digit in (ord(letter) - 48 for letter in segmentation["counts"]):
        digits.append(digit & 0x1f)
        if digit & 0x20:
            continue
        value = sum(digit << 5 * place for place, digit in enumerate(digits))
        if digits[-1] & 0x10:
            value -= 1 << 5 * len(digits)
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
        digits = []
    return np.repeat(np.arange(len(runs)) % 2 == 1, runs).reshape(segmentation["size"][::-1]).T


class DatasetCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-dataset-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.run_program(SWARD, "bake", "plane", "--scale", "0.1", "--count", "900", "--blade-scale", "0.6",
                        "-o", "f.sward")
        (cls.folder / "flat.obj").write_text("v -5 0 -5\nv -5 0 5\nv 5 0 5\nv 5 0 -5\nf 1 2 3 4\n", encoding="utf-8")
        (cls.folder / "own.json").write_text(json.dumps({"name": "own", "species": [
            {"name": "reed", "share": 1, "height_m": [0.2, 0.3], "width_m": [0.004, 0.006]}]}), encoding="utf-8")
        (cls.folder / "set.json").write_text(json.dumps(SCENE), encoding="utf-8")
        # Frames that are drawn before a set grows are those of the whole.
        (cls.folder / "first.json").write_text(json.dumps(SCENE | {"frames": 2, "about": "at first"}), encoding="utf-8")
        cls.dataset("-o", "one", scene="first.json")
        cls.dataset("-o", "one")

    @classmethod
    def run_program(cls, *arguments, code=0):
        done = subprocess.run(list(map(str, arguments)), cwd=cls.folder, env=ENVIRONMENT, text=True,
                              capture_output=True)
        assert done.returncode == code, (arguments, done.stdout, done.stderr)
        return done

    @classmethod
    def dataset(cls, *arguments, scene="set.json", code=0):
        return cls.run_program(VIEWER, "dataset", scene, *arguments, code=code)

    def files(self, name):
        """What a folder holds, but for what a process that was killed had begun."""
        return {file.name: file.read_bytes() for file in (self.folder / name).rglob("*")
                if file.suffix in (".json", ".npz", ".sward") and not file.name.startswith(".")}

    def frame(self, number):
        return (json.loads((self.folder / f"one/frame_{number:08}.json").read_text(encoding="utf-8")),
                np.load(self.folder / f"one/frame_{number:08}.npz"))


class Dataset(DatasetCase):
    def test_frames_vary_within_the_stated_ranges(self):
        described = [self.frame(i)[0] for i in range(FRAMES)]
        self.assertEqual({frame["field"] for frame in described},
                         {"f.sward"} | {file.name for file in (self.folder / "one/fields").iterdir()})
        self.assertEqual(len({tuple(frame["camera"]["eye"]) for frame in described}), FRAMES)
        for frame in described:
            x, height, _ = frame["camera"]["eye"]
            self.assertTrue(-0.5 <= x <= 0.5 and 0.3 <= height <= 0.6)
            self.assertTrue(40 <= frame["camera"]["fov_y_deg"] <= 60)
            self.assertTrue(1 <= frame["wind_strength"] <= 4)
            self.assertEqual(frame["time_s"], 5)
            # Its heading is not stated: that of the usual sun, 60 degrees east of north.
            east, sine, south = frame["sun_direction"]
            self.assertTrue(np.sin(np.radians(20)) <= sine <= np.sin(np.radians(60)))
            self.assertAlmostEqual(np.degrees(np.arctan2(east, -south)), 60, delta=0.5)

    def test_fields_are_baked_within_the_stated_ranges(self):
        manifest = json.loads((self.folder / "one/manifest.json").read_text(encoding="utf-8"))
        bakes = manifest["bakes"]
        self.assertEqual(len(bakes), BAKES["fields"])
        self.assertEqual(len(manifest["fields"]), 1 + len(bakes))
        self.assertEqual(len({tuple(bake) for bake in bakes}), len(bakes))
        fields = sorted((self.folder / "one/fields").iterdir())
        self.assertEqual(len(fields), len(bakes))
        for bake, file in zip(bakes, fields):
            self.assertIn(bake[0], BAKES["ground"])
            options = dict(word[2:].split("=", 1) for word in bake[1:] if word.startswith("--") and "=" in word)
            self.assertTrue(200 <= int(options["count"]) <= 700)
            self.assertIn(options["meadow"], BAKES["options"]["meadow"])
            self.assertTrue(30 <= float(options["slope"].split(":")[1]) <= 40)
            self.assertTrue(0 <= int(options["seed"]) <= 2_000_000_000)
            key, value = bake[bake.index("--set") + 1].split("=")
            self.assertTrue(key == "clump_size_m" and 0.2 <= float(value) <= 0.6)
            known = json.loads(self.run_program(SWARD, "info", file, "--json").stdout)
            self.assertEqual(known["provenance"]["settings"]["seed"], int(options["seed"]))
            self.assertNotIn(str(self.folder), json.dumps(manifest))

    def test_cameras_carry_depth_and_flow_from_frame_to_frame(self):
        for number in range(FRAMES):
            described, arrays = self.frame(number)
            width, height = described["width"], described["height"]

            def seen(points, camera):
                place = points @ np.array(camera["world_to_camera"])[:3].T
                place = place @ np.array(camera["intrinsics"]).T
                return place[..., :2] / place[..., 2:]

            now = described["camera"]
            x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
            rays = np.stack([x, y, np.ones_like(x)], axis=-1) @ np.linalg.inv(np.array(now["intrinsics"])).T
            rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
            ground = arrays["class"] == 1
            depth = np.where(ground, arrays["depth"], 1)
            world = (rays * depth[..., None]) @ np.array(now["world_to_camera"])[:3, :3] + np.array(now["eye"])
            points = np.concatenate([world, np.ones((height, width, 1))], axis=-1)
            self.assertLess(abs(world[ground][:, 1]).max(initial=0), 2e-3)
            for name, other in (("flow-backward", "camera_before"), ("flow-forward", "camera_after")):
                way = seen(points, described[other]) - np.stack([x, y], axis=-1)
                self.assertLess(np.abs(way - arrays[name])[ground].max(initial=0), 0.02)
                self.assertTrue(np.isfinite(arrays[name]).all())

    def test_objects_are_the_plants_in_the_picture(self):
        coco = json.loads((self.folder / "one/coco.json").read_text(encoding="utf-8"))
        self.assertEqual([image["id"] for image in coco["images"]], list(range(FRAMES)))
        self.assertEqual([a["id"] for a in coco["annotations"]], list(range(1, len(coco["annotations"]) + 1)))
        plants = [a for a in coco["annotations"] if not a["iscrowd"]]
        self.assertGreater(len(plants), 20)
        categories = {category["id"] for category in coco["categories"]}
        for number in range(FRAMES):
            _, arrays = self.frame(number)
            blades = np.zeros(arrays["class"].shape, bool)
            for annotation in (a for a in coco["annotations"] if a["image_id"] == number):
                self.assertIn(annotation["category_id"], categories)
                mask = mask_of(annotation["segmentation"])
                self.assertEqual(mask.sum(), annotation["area"])
                self.assertGreaterEqual(annotation["area"], 6)
                rows, columns = np.nonzero(mask)
                self.assertEqual(annotation["bbox"], [columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1])
                self.assertTrue((arrays["class"][mask] == 2).all())
                if annotation["iscrowd"]:
                    blades |= mask
                else:
                    self.assertTrue((arrays["id"][mask] != 0).all())
            self.assertLessEqual((arrays["class"] == 2).sum() - blades.sum(), 5 * len(categories))

    def test_a_folder_of_another_set_is_refused(self):
        cameras = SCENE["cameras"] | {"fov_y_deg": [40, 50]}
        before = self.files("one")
        for change, says in (({"seed": 4}, "its \"scene.seed\" is 3, here it is 4"),
                             ({"cameras": cameras}, "its \"scene.cameras.fov_y_deg\" is [40,60], here it is [40,50]"),
                             ({"samples": 4}, "its \"scene.samples\" is not stated, here it is 4"),
                             ({"frames": 7}, "its \"scene.frames\" is 8, here it is 7; a set can only grow")):
            (self.folder / "other.json").write_text(json.dumps(SCENE | change), encoding="utf-8")
            self.assertIn(says, self.dataset("-o", "one", scene="other.json", code=1).stderr)
        self.assertEqual(self.files("one"), before)

    def test_frames_of_another_set_are_refused(self):
        shutil.copytree(self.folder / "one", self.folder / "joined")
        frame = self.folder / "joined/frame_00000003.json"
        head, rest = frame.read_text(encoding="utf-8").split(",", 1)
        frame.write_text(head[:-4] + "xyz\"," + rest, encoding="utf-8")
        self.assertIn("joined/frame_00000003.json: is a frame of the set", self.dataset("-o", "joined", code=1).stderr)
        (self.folder / "joined/manifest.json").unlink()
        before = self.files("joined")
        self.assertIn("joined/frame_00000000.json: is here without a manifest.json", self.dataset("-o", "joined", code=1).stderr)
        for file in (self.folder / "joined").glob("frame_*.json"):
            file.unlink()
        self.assertIn("joined/frame_00000000.npz: is here without", self.dataset("-o", "joined", code=1).stderr)
        self.assertEqual(self.files("joined"), {name: held for name, held in before.items()
                                                if not (name.startswith("frame") and name.endswith(".json"))})

    def test_what_is_gone_or_torn_is_drawn_again(self):
        shutil.copytree(self.folder / "one", self.folder / "torn")
        described = [self.folder / f"torn/frame_{i:08}.json" for i in range(FRAMES)]
        described[0].with_suffix(".npz").unlink()
        picture = described[1].with_suffix(".npz")
        picture.write_bytes(picture.read_bytes()[:-1])
        described[2].write_text("", encoding="utf-8")
        described[3].write_text("{}", encoding="utf-8")
        described[4].write_bytes(described[4].read_bytes()[:-9])
        described[5].write_bytes(described[5].read_bytes().replace(b'"width":48', b'"width":47'))
        self.assertIn("6 frames: ", self.dataset("-o", "torn").stdout)
        self.assertEqual(self.files("torn"), self.files("one"))

    def test_numbers_of_bakes_are_as_they_are_written(self):
        options = {"density": 1234.5678, "seed": 12345678901234, "scale": 0.1, "sky-rays": "{7.5..8.5}", "blade-scale": [0.12345678, 0.12345679]}
        scene = SCENE | {"bakes": {"ground": "none.glb", "options": options}}
        (self.folder / "numbers.json").write_text(json.dumps(scene), encoding="utf-8")
        said = self.dataset("-o", "numbers", scene="numbers.json", code=2).stderr
        for word in ("--density=1234.5678 ", "--seed=12345678901234 ", "--scale=0.1 ", "--sky-rays=8\n", "--blade-scale=0.1234567"):
            self.assertIn(word, said)

    def test_wrong_scenes_and_options_are_refused(self):
        for change, code, says in (({"fields": []}, 3, "fields"), ({"bakes": {"fields": 2}}, 3, "ground"),
                                   ({"bakes": BAKES | {"fields": 0}}, 3, "fields"),
                                   ({"bakes": BAKES | {"ground": [1, 2]}}, 3, "ground"),
                                   ({"bakes": BAKES | {"options": {"threads": 2}}}, 3, "options.threads"),
                                   ({"bakes": BAKES | {"options": {"density": [9, 2]}}}, 3, "9 is above 2"),
                                   ({"bakes": BAKES | {"options": {"slope": "0:{45..30}"}}}, 3, "slope: 45 is above 30"),
                                   ({"bakes": BAKES | {"options": {"seed": 1.5}}}, 3, "seed: 1.5 is not a whole number"),
                                   ({"bakes": BAKES | {"options": {"sky-rays": [0.2, 0.8]}}}, 3, "sky-rays: no whole number is from 0.2 to 0.8"),
                                   ({"bakes": BAKES | {"options": {"meadow": {"lawn": 0}}}}, 3, "no weight"),
                                   ({"bakes": BAKES | {"options": {"densitty": 2}}}, 1, "--densitty"),
                                   ({"bakes": BAKES | {"ground": "none.glb"}}, 2, "none.glb"), ({"size": "0x3"}, 3, "size"),
                                   ({"layers": "depths"}, 3, "'depths'"), ({"framez": 3}, 3, "framez"),
                                   ({"cameras": {"height_m": [-2, 1]}}, 3, "height_m"),
                                   ({"cameras": {"x_m": [500, 600]}}, 3, "x_m"),
                                   ({"cameras": {"x_m": [2, -2]}}, 3, "x_m: 2 is above -2"),
                                   ({"path": "path.json"}, 3, "cameras: height_m: means nothing beside \"path\""),
                                   ({"jitter_deg": 5}, 3, "jitter_deg: means nothing without \"path\""),
                                   ({"compressed": True}, 3, "compressed: means nothing beside a \"format\""),
                                   ({"settings": ""}, 3, "settings: expected the name of a file"),
                                   ({"fields": [""]}, 3, "fields: expected names of fields, found \"\""),
                                   ({"fields": ["none.sward"]}, 2, "none.sward")):
            (self.folder / "wrong.json").write_text(json.dumps(SCENE | change), encoding="utf-8")
            done = self.dataset("-o", "wrong", scene="wrong.json", code=code)
            self.assertIn(says, done.stderr)
        for share in ("0/4", "5/4", "1", "1/", "x/2", "1/2/3"):
            self.assertIn("--share", self.dataset("-o", "wrong", "--share", share, code=1).stderr)
        self.assertIn("--null-output", self.dataset("-o", "wrong", "--null-output", code=1).stderr)
        self.assertIn("-o is missing", self.dataset(code=1).stderr)


class LongDataset(DatasetCase):
    """Takes many processes, each of which starts a device."""

    def test_shares_of_four_processes_are_the_set_of_one(self):
        started = [subprocess.Popen([VIEWER, "dataset", "set.json", "-o", "four", "--share", f"{i}/4", "--threads", "1"],
                                    cwd=self.folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL) for i in range(1, 5)]
        self.assertEqual([process.wait() for process in started], [0] * 4)
        self.assertEqual(self.files("one"), self.files("four"))
        self.assertEqual(len(self.files("one")), 2 * FRAMES + 2 + BAKES["fields"])

    def test_a_killed_run_goes_on_and_makes_the_same(self):
        process = subprocess.Popen([VIEWER, "dataset", "set.json", "-o", "killed"], cwd=self.folder, env=ENVIRONMENT,
                                   stdout=subprocess.DEVNULL)
        while process.poll() is None and not list((self.folder / "killed").glob("frame_*.json")):
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        process.wait()
        finished = {file.name: file.stat().st_mtime_ns for file in (self.folder / "killed").glob("frame_*.json")}
        self.assertGreater(len(finished), 0)
        self.dataset("-o", "killed")
        self.assertEqual(self.files("one"), self.files("killed"))
        # What was finished has not been drawn again.
        for name, when in finished.items():
            self.assertEqual((self.folder / "killed" / name).stat().st_mtime_ns, when)
        self.assertIn("nothing is left", self.dataset("-o", "killed").stdout)

    def test_a_sun_of_a_stated_heading_has_the_height_of_the_settings(self):
        (self.folder / "sun.json").write_text(json.dumps({"look": {"sun": {"azimuth": 180, "elevation": 45}}}), encoding="utf-8")
        scene = {"fields": ["f.sward"], "size": "16x16", "layers": "none", "format": "png", "settings": "sun.json",
                 "sun": {"heading_deg": 90}}
        (self.folder / "sunny.json").write_text(json.dumps(scene), encoding="utf-8")
        self.dataset("-o", "sunny", scene="sunny.json")
        described = json.loads((self.folder / "sunny/frame_00000000.json").read_text(encoding="utf-8"))
        np.testing.assert_allclose(described["sun_direction"], [np.sqrt(1 / 2), np.sqrt(1 / 2), 0], atol=1e-6)

    def test_null_output_says_how_fast_the_device_is(self):
        self.assertRegex(self.dataset("--null-output").stdout, r"8 frames: [0-9.]+ frames per second on the device")


if __name__ == "__main__":
    unittest.main()
