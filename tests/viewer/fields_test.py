"""Several fields in one window and in one picture."""

import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window_case import SWARD, VIEWER, WindowCase  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402


def bake(ground, count, path, *arguments):
    # Blades alone, so that the numbers of blades are those of the bake.
    meadow = [] if "--meadow" in arguments else ["--meadow", "grass"]
    subprocess.run([SWARD, "bake", ground, "--count", str(count), "--blade-scale", "8", "-o", path,
                    "--force", "-q", *meadow, *arguments], check=True)


class FieldsCase(WindowCase):
    SIZE = (900, 780)

    def setUp(self):
        super().setUp()
        # Blades alone, so that the numbers of blades are those of the bake.
        self.hills = self.field("hills", 1500, 8, "--meadow", "grass")
        self.plane = self.field("plane", 800, 8, "--meadow", "steppe")

    def open(self, *arguments):
        return super().open(*arguments, "--panel", "field")

    def wait_for_total(self, viewer, total):
        viewer.wait_for_value("Status/Numbers",
                              lambda shown: f" of {total:,} blades".replace(",", " ") in shown,
                              f"{total} blades are shown")


class FieldsTest(FieldsCase):
    def test_each_of_several_is_listed_and_may_go_and_come(self):
        viewer = self.open(self.hills, self.plane)
        self.wait_for_total(viewer, 2300)
        self.assertEqual(viewer.shows("Field/Total"), "2 300")
        for number, (path, blades) in enumerate(((self.hills, "1 500"), (self.plane, "800")), 1):
            viewer.click(f"Field/Show {number}", 0.2)
            viewer.wait_for_value("Field/File", lambda shown, path=path: shown == str(path),
                                  "it tells of the one that was chosen")
            self.assertEqual(viewer.shows("Field/Blades"), blades)
            self.assertIn(blades, viewer.shows(f"Field/Show {number}"))
        viewer.click("Field/Remove 1")
        self.wait_for_total(viewer, 800)
        self.assertNotIn("Field/Show 1", viewer.controls())
        self.assertEqual(viewer.shows("Field/File"), str(self.plane))
        self.assert_ends_well(viewer)

    def test_one_is_dropped_beside_the_rest(self):
        viewer = self.open(self.hills)
        before = viewer.shows("Field/File")
        # A drop without Shift replaces the fields, with Shift it adds to them.
        self.display.xdotool("mousemove", "--window", viewer.window.number, 600, 300)
        self.display.xdotool("keydown", "Shift_L")
        viewer.wait_frames(2)
        self.drop(viewer, self.plane)
        self.display.xdotool("keyup", "Shift_L")
        self.wait_for_total(viewer, 2300)
        self.drop(viewer, self.plane)
        self.wait_for_total(viewer, 800)
        viewer.press("Drop adds", panel="Field")
        viewer.wait_for_value("Field/Drop adds", lambda shown: shown == "on", "it is turned on")
        self.drop(viewer, self.hills)
        self.wait_for_total(viewer, 2300)
        # Two at once, beside the two that are there.
        self.drop(viewer, self.plane, self.plane)
        self.wait_for_total(viewer, 3900)
        viewer.click("Field/Remove 4")
        self.wait_for_total(viewer, 3100)
        viewer.click("Field/Show 2", 0.2)
        viewer.wait_for_value("Field/File", lambda shown: shown == before, "the new one is chosen")
        self.assert_ends_well(viewer)

    def test_a_click_tells_whose_a_blade_is_and_its_own_id(self):
        rows = {}
        for field in (self.hills, self.plane):
            table = field.with_suffix(".csv")
            subprocess.run([SWARD, "export", field, "-o", table, "--force"], check=True,
                           stderr=subprocess.DEVNULL)
            with open(table) as file:
                rows[field.name] = {row["id"]: row for row in csv.DictReader(file)}
        viewer = self.open(self.hills, self.plane, "--camera", "top", "--resolution", "0.4")
        viewer.key("space")
        seen = set()
        for i in range(120):
            viewer.click_at(470 + 37 * i % 400, 80 + 29 * i % 440)
            told = viewer.controls()
            if "Blade/Id" not in told:
                continue
            field = told["Blade/Field"]["shows"]
            row = rows[field].get(told["Blade/Id"]["shows"])
            self.assertIsNotNone(row, f"{field} has such a blade")
            self.assertEqual(row["patch"], told["Blade/Patch"]["shows"])
            for axis, shown in zip("xyz", told["Blade/Root"]["shows"].split()):
                self.assertAlmostEqual(float(row[axis]), float(shown), delta=0.002)
            seen.add(field)
            if len(seen) == 2:
                break
        self.assertEqual(seen, set(rows), "blades of both are met")
        self.assert_ends_well(viewer)

    def test_only_the_one_that_changed_or_was_chosen_is_exchanged(self):
        moving = self.folder / "moving.sward"
        bake("plane", 300, moving)
        viewer = self.open(self.hills, moving, "--watch")
        self.wait_for_total(viewer, 1800)
        bake("plane", 400, moving)
        self.wait_for_total(viewer, 1900)
        # A rebake replaces the chosen field.
        viewer.click("Field/Show 1", 0.2)
        viewer.press("Ground", panel="Meadow")
        viewer.type("plane")
        viewer.wait_for_value("Meadow/Ground", lambda shown: shown == "plane", "it is typed")
        self.assertEqual(viewer.shows("Meadow/Count"), "1500")
        viewer.press("Bake again", panel="Meadow")
        viewer.open_panel("Field")
        viewer.wait_for_value("Field/Show 1", lambda shown: shown.startswith("plane "),
                              "it has taken the place of the first")
        self.assertTrue(viewer.shows("Field/Show 2").startswith("moving.sward"))
        self.wait_for_total(viewer, 1900)
        self.assert_ends_well(viewer)


class TogetherTest(unittest.TestCase):
    """The same without a window."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-render-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        bake("hills", 3000, cls.folder / "hills.sward")
        bake("plane", 2000, cls.folder / "plane.sward")

    def view(self, *arguments, code=0):
        done = subprocess.run([VIEWER, *map(str, arguments)], cwd=self.folder, text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def render(self, *fields, name):
        self.view("render", *fields, "-o", name, "--stats", "stats.json", "--force", "--camera",
                  "eye.json", "--wind-strength", "0", "--size", "160x90", "--validation", "-q")
        return json.loads((self.folder / "stats.json").read_text())["blades"]

    def test_it_is_one_picture_whatever_their_order(self):
        # The plane runs through the hills: each hides some of the other.
        (self.folder / "eye.json").write_text('{"eye": [0, 9, 34], "target": [0, 0, 0]}')
        counts = self.render("hills.sward", "plane.sward", name="both.png")
        self.assertEqual(counts["total"], 5000)
        again = self.render("plane.sward", "hills.sward", name="turned.png")
        self.assertEqual(again["total"], 5000)
        self.assertAlmostEqual(again["drawn"], counts["drawn"], delta=5)
        self.render("hills.sward", name="hills.png")
        self.render("plane.sward", name="plane.png")

        needs("skimage")
        from skimage.io import imread
        pictures = {name: imread(self.folder / f"{name}.png")[..., :3].astype(int)
                    for name in ("both", "turned", "hills", "plane")}

        # A blade's shade is drawn from its number, which is another in another order: the mean of
        # some pixels is compared.
        def differs(a, b):
            change = (pictures[a] - pictures[b]).reshape(9, 10, 16, 10, 3).mean(axis=(1, 3))
            return abs(change).max()

        self.assertLess(differs("both", "turned"), 12)
        self.assertGreater(differs("both", "hills"), 30)
        self.assertGreater(differs("both", "plane"), 30)

    def test_what_cannot_be_joined_is_told_by_name(self):
        bake("hills", 100, self.folder / "far.sward")
        done = self.view("render", "hills.sward", "plane.sward", "-o", "no.png", "--dump-blades",
                         "no.csv", code=1)
        self.assertIn("--dump-blades", done.stderr)
        self.assertFalse((self.folder / "no.png").exists())
        kinds = []
        for i in range(9):
            name = f"kind{i}.sward"
            bake("plane", 10, self.folder / name, "--set", f"species.0.gloss=0.{i + 1}")
            kinds.append(name)
        done = self.view("render", *kinds, "-o", "no.png", code=3)
        self.assertIn("species", done.stderr)
        self.assertIn("kind", done.stderr)


class LongFieldsTest(FieldsCase):
    def test_what_is_wrong_with_a_second_one_leaves_the_first(self):
        broken = self.folder / "broken.sward"
        broken.write_bytes(self.hills.read_bytes()[:2000])
        viewer = self.open(self.hills)
        viewer.press("Drop adds", panel="Field")
        viewer.wait_frames(2)
        self.drop(viewer, broken)
        viewer.wait_for_value("Message/Error", lambda shown: "broken.sward" in shown, "it complains")
        self.wait_for_total(viewer, 1500)
        self.assert_ends_well(viewer)

    def test_a_click_tells_of_a_blade_that_is_sown(self):
        seeded, table = self.folder / "seeded.sward", self.folder / "grown.csv"
        subprocess.run([SWARD, "bake", "plane", "--density", "4", "--blade-scale", "8", "--sky-rays", "0", "--meadow", "grass",
                        "--seeds", "always", "--budget", "500", "-o", seeded, "-q"], check=True, stderr=subprocess.DEVNULL)
        for verb, source, to in (("grow", seeded, self.folder / "grown.sward"), ("export", self.folder / "grown.sward", table)):
            subprocess.run([SWARD, verb, source, "-o", to, "-q"], check=True, stderr=subprocess.DEVNULL)
        with open(table) as file:
            rows = {row["id"]: row for row in csv.DictReader(file)}
        viewer = self.open(seeded, "--camera", "top", "--resolution", "0.4")
        viewer.wait_for_value("Field/Sown", lambda shown: shown.replace(" ", "").isdigit(), "blades are sown")
        viewer.key("space")
        sown = 0
        for i in range(60):
            viewer.click_at(470 + 37 * i % 400, 80 + 29 * i % 440)
            told = viewer.controls()
            if "Blade/Id" not in told:
                continue
            row = rows[told["Blade/Id"]["shows"]]
            for axis, shown in zip("xyz", told["Blade/Root"]["shows"].split()):
                self.assertAlmostEqual(float(row[axis]), float(shown), delta=0.005)
            self.assertRegex(told["Blade/Species"]["shows"], r"^[a-z]+$")
            self.assertEqual("Blade/Patch" in told, "Blade/Sown" not in told)
            if "Blade/Sown" in told:
                for value in ("Triangle", "Candidate"):
                    self.assertRegex(told[f"Blade/{value}"]["shows"], r"^\d+$")
                self.assertEqual(len(told["Blade/Cell"]["shows"].split()), 3)
                sown += 1
            if sown == 3:
                break
        self.assertEqual(sown, 3)
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
