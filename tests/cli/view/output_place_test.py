"""Outputs of `sward-view render` that cannot or must not be written are refused before anything is drawn."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SWARD = os.environ["SWARD_PROGRAM"]
VIEWER = os.environ["SWARD_VIEW_PROGRAM"]
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
# A device without a driver: what asks for one ends with exit code 5.
NO_DEVICE = {"VK_DRIVER_FILES": "/nonexistent.json", "VK_ICD_FILENAMES": "/nonexistent.json"}
DONE, USAGE, IO, UNSUPPORTED = 0, 1, 2, 5

OUTPUTS = {"-o": ".png", "--stats": ".json", "--dump-blades": ".csv"}


class OutputPlaceTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-view-output-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        subprocess.run([SWARD, "bake", "plane", "--count", "20", "-o", "f.sward", "-q"], check=True, cwd=self.folder)
        self.write("s.json", {"look": {"exposure": 1}})
        self.write("c.json", {"eye": [3, 2, 3], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 50})

    def write(self, name, value):
        (self.folder / name).write_text(json.dumps(value), encoding="utf-8")

    def render(self, outputs, *arguments, code, environment=None):
        line = [word for option, name in outputs.items() for word in (option, str(name))]
        done = subprocess.run([VIEWER, "render", "f.sward", "--size", "16x16", *line, *arguments], cwd=self.folder, text=True,
                              env={**ENVIRONMENT, **(environment or {})}, capture_output=True, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def refused(self, outputs, *arguments, code, names):
        """Refused before a device is asked for; nothing is made or changed."""
        before = self.contents()
        done = self.render(outputs, *arguments, code=code, environment=NO_DEVICE)
        for name in names:
            self.assertIn(name, done.stderr)
        self.assertEqual(self.contents(), before)

    def contents(self):
        return {path.name: (path.is_symlink(), path.read_bytes() if path.is_file() else None) for path in self.folder.iterdir()}

    def all_with(self, option, name):
        """Sound outputs, of which one is `name`."""
        return {"-o": "p.png", option: name}

    def test_that_is_no_regular_file_or_in_no_folder(self):
        os.mkfifo(self.folder / "pipe")
        for option, extension in OUTPUTS.items():
            for kind, target in (("pipe", "pipe"), ("device", "/dev/null"), ("folder", ".")):
                with self.subTest(option=option, kind=kind):
                    link = self.folder / f"{kind}{extension}"
                    link.symlink_to(target)
                    self.refused(self.all_with(option, link.name), "--force", code=IO, names=[link.name, f"is a {kind}"])
                    link.unlink()
            for place in ("none", "/proc/none", "f.sward"):
                with self.subTest(option=option, place=place):
                    self.refused(self.all_with(option, f"{place}/x{extension}"), "--force", code=IO, names=[f"x{extension}"])

    def test_that_exists_stays_without_force_and_is_replaced_with_it(self):
        (self.folder / "far").mkdir()
        for kind in ("old", "link"):
            outputs = {option: kind + extension for option, extension in OUTPUTS.items()}
            for option, name in outputs.items():
                if kind == "link":
                    (self.folder / name).symlink_to(f"far/{name}")
                    (self.folder / "far" / name).write_text("precious")
                else:
                    (self.folder / name).write_text("precious")
                self.refused(self.all_with(option, name), code=IO, names=[name, "--force"])
            self.render(outputs, "--force", "-q", code=DONE)
            for name in outputs.values():
                self.assertNotEqual((self.folder / name).read_bytes(), b"precious", name)
                self.assertEqual((self.folder / name).is_symlink(), kind == "link", name)

    def test_that_is_read_is_refused(self):
        (self.folder / "f.png").symlink_to("f.sward")
        os.link(self.folder / "f.sward", self.folder / "twin.csv")
        (self.folder / "s2.json").symlink_to("s.json")
        for option, name in (("-o", "f.png"), ("--dump-blades", "twin.csv")):
            self.refused(self.all_with(option, name), "--force", code=USAGE, names=[name, "is read"])
        # What settings and cameras name is known once they are read; nothing is drawn even then.
        before = self.contents()
        for name in ("s.json", "s2.json", "c.json"):
            done = self.render(self.all_with("--stats", name), "--settings", "s.json", "--camera", "c.json", "--force", code=USAGE)
            self.assertIn("is read", done.stderr)
        self.assertEqual(self.contents(), before)

    def test_that_two_outputs_share_or_that_has_the_name_of_another_format(self):
        self.refused({"-o": "p.png", "--stats": "same", "--dump-blades": "same"}, code=USAGE, names=["same"])
        for option, extension in OUTPUTS.items():
            for other in (".png", ".json", ".csv", ".sward", ".glb"):
                if other != extension:
                    self.refused(self.all_with(option, f"x{other}"), code=USAGE, names=[f"x{other}", extension])

    def test_a_sound_one_goes_on_to_the_device(self):
        self.render({"-o": "p.png", "--stats": "s2.json", "--dump-blades": "d.csv"}, code=UNSUPPORTED, environment=NO_DEVICE)


if __name__ == "__main__":
    unittest.main()
