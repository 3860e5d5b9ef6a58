"""Meadows are chosen by their pictures, and their species changed, in the window. On a real X server."""

import json
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window_case import ROOT, SWARD, WindowCase  # noqa: E402

MEADOWS = ROOT / "assets" / "meadows"


class SpeciesTest(WindowCase):
    SIZE = (900, 790)

    def open(self):
        mesh = self.mesh()
        subprocess.run([SWARD, "bake", mesh, "--meadow", "grass", "--count", "800", "-o",
                        self.folder / "plane.sward", "-q"], check=True)
        return super().open("plane.sward", "--panel", "meadow")

    def densities(self, viewer):
        viewer.click("Meadow/Meadow")
        viewer.wait(lambda: viewer.shows("Meadow/dunes"), "the list is open")
        names = [path.stem for path in MEADOWS.glob("*.json")]
        told = {name: viewer.shows(f"Meadow/{name}") for name in names}
        return {name: int(text.split("/")[0].replace(" ", "").replace("\u202f", ""))
                for name, text in told.items()}

    def test_the_list_of_meadows_tells_the_density_of_each(self):
        viewer = self.open()
        told = self.densities(viewer)
        small = self.folder / "small.obj"
        small.write_text("v 0 0 0\nv 0 0 2\nv 2 0 2\nv 2 0 0\nf 1 2 3 4\n")
        for name, density in told.items():
            report = self.folder / f"{name}.json"
            subprocess.run([SWARD, "bake", small, "--meadow", name, "--blade-scale", "1", "--dry-run",
                            "--report", report, "-o", self.folder / "x.sward", "-q"], check=True,
                           capture_output=True)
            self.assertEqual(density, json.loads(report.read_text())["density_per_m2"]["closed"], name)
        viewer.wait_frames(3)
        viewer.click("Meadow/lawn")
        viewer.wait_for_value("Meadow/Usual density", lambda shown: "9" in shown[:1], "lawn is chosen")
        self.assert_ends_well(viewer)

    def assert_swatch(self, viewer, name):
        """The button at the right end of a colour has the colour that its numbers tell, in sRGB."""
        viewer.away()
        control, (left, top, _, _) = viewer.controls()[name], viewer.window.geometry()
        x, y = round(control["x"] + control["width"]) - 10, round(control["y"] + 0.5 * control["height"])
        shown = self.display.picture(left + x, top + y, 1, 1)[0][0][::-1]
        linear = [float(word) for word in control["shows"].split()]
        told = [255 * (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055) for c in linear]
        # The window's pixels are stored as eight bits of linear light where they are blended.
        for one, other in zip(shown, told):
            self.assertAlmostEqual(one, other, delta=4, msg=f"{name}: {shown} for {told}")

    def test_a_changed_species_is_written_and_sown(self):
        viewer = self.open()
        viewer.press("Edit species", panel="Meadow")
        viewer.wait(lambda: viewer.shows("Meadow/Species 2"), "species are listed")
        viewer.wait_frames(3)
        viewer.click("Meadow/Species 2")
        name = viewer.shows("Meadow/Species 2")
        tip = viewer.shows("Meadow/Tip colour")
        self.assert_swatch(viewer, "Meadow/Base colour")
        self.assert_swatch(viewer, "Meadow/Tip colour")
        # The first of the three numbers of the colour, typed.
        x, y = viewer.centre("Meadow/Tip colour", 0.06)
        self.display.xdotool("keydown", "ctrl")
        viewer.click_at(x, y)
        self.display.xdotool("keyup", "ctrl")
        viewer.type("255")
        viewer.key("Return")
        viewer.wait_for_value("Meadow/Tip colour", lambda shown: shown.startswith("1.000"), "it is red")
        viewer.set("Share", "Meadow", 0.95)
        viewer.click("Meadow/Ground")
        viewer.type("plane.glb")
        viewer.wait_for_value("Meadow/Ground", lambda shown: shown == "plane.glb", "it is typed")
        # It lies below, where the panel must be scrolled to.
        self.display.xdotool("click", "--repeat", 12, "--delay", 60, 5)
        viewer.wait(lambda: viewer.controls()["Meadow/Bake again"]["y"] < 755, "it is scrolled")
        viewer.wait_frames(3)
        viewer.press("Bake again", panel="Meadow")
        viewer.wait(lambda: viewer.shows("Meadow/Report"), "it is baked")
        files = [path for path in self.folder.glob("*.json") if not path.name.startswith("controls")]
        self.assertEqual(len(files), 1, "one meadow file")
        written = json.loads(files[0].read_text())
        changed = [one for one in written["species"] if one["name"] == name][0]
        self.assertEqual(changed["tip_color"][0], 1.0)
        self.assertNotEqual(tip.split()[0], "1.000")
        self.assertEqual(viewer.shows("Meadow/Meadow file"), files[0].name)
        self.assert_ends_well(viewer)


if __name__ == "__main__":
    unittest.main()
