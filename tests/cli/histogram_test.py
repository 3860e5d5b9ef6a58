"""What `sward info --histogram` says: nothing is lost, and people and programs hear the same."""

import math
import unittest

from support import CliTest

EVERY_BLADE = ("height_m", "width_m", "stiffness", "exposure", "slope_deg")


class Histogram(CliTest):
    def histogram(self, field):
        text = self.sward("info", field, "--histogram", "--json").stdout
        self.folder.joinpath("info.json").write_text(text, encoding="utf-8")
        return self.read_json("info.json")

    def test_bars_sum_to_the_blades(self):
        info = self.histogram(self.bake("hills", "--count", "20000"))
        for key, entry in info["histogram"].items():
            with self.subTest(key=key):
                self.assertEqual(sum(entry["bars"]["counts"]), entry["count"])
                self.assertLessEqual(entry["bars"]["low"], entry["least"] + 1e-6)
                self.assertLessEqual(entry["least"], entry["mean"])
                self.assertLessEqual(entry["mean"], entry["largest"])
                self.assertLessEqual(entry["largest"], entry["bars"]["high"] + 1e-6)
        for key in EVERY_BLADE:
            self.assertEqual(info["histogram"][key]["count"], info["blades"])
        patches = info["histogram"]["blades_per_patch"]
        self.assertAlmostEqual(patches["mean"] * patches["count"], info["blades"], places=3)

    def test_bounds_are_those_of_the_exported_blades(self):
        field = self.bake("arch", "--count", "5000")
        histogram = self.histogram(field)["histogram"]
        blades = self.blades(field)
        for key, column in (("height_m", "height"), ("width_m", "width"),
                            ("stiffness", "stiffness"), ("exposure", "exposure")):
            values = [float(blade.row[column]) for blade in blades]
            with self.subTest(key=key):
                self.assertAlmostEqual(histogram[key]["least"], min(values), places=6)
                self.assertAlmostEqual(histogram[key]["largest"], max(values), places=6)
                self.assertAlmostEqual(histogram[key]["mean"], sum(values) / len(values), places=6)
        slopes = [math.degrees(math.acos(max(-1.0, min(1.0, blade.up[1])))) for blade in blades]
        self.assertAlmostEqual(histogram["slope_deg"]["largest"], max(slopes), places=2)
        self.assertEqual([sum(1 for slope in slopes if 10 * bar <= slope < 10 * bar + 10 - 1e-4)
                          for bar in range(18)], self.without_edges(histogram, slopes))

    @staticmethod
    def without_edges(histogram, slopes):
        """The bars, less the few slopes that rounding may put on either side of an edge."""
        bars = list(histogram["slope_deg"]["bars"]["counts"])
        for slope in slopes:
            if slope % 10 >= 10 - 1e-4:
                bars[int(slope // 10)] -= 1
        return bars

    def test_density_and_spacing_are_those_that_were_asked_for(self):
        field = self.bake("plane", "--density", "400", "--blade-scale", "1", "--sky-rays", "0")
        histogram = self.histogram(field)["histogram"]
        full = histogram["density_per_m2"]
        self.assertAlmostEqual(full["largest"], 400.0, delta=120.0)
        # In units of 1/√density: 0.5 for roots at random, 1.0746 for a grid of triangles.
        mean = histogram["nearest_neighbour_m"]["mean"] * math.sqrt(400.0)
        self.assertTrue(0.49 < mean < 1.0746, mean)

    def test_people_see_the_same_counts(self):
        field = self.bake("torus", "--count", "3000")
        histogram = self.histogram(field)["histogram"]
        text = self.sward("info", field, "--histogram").stdout
        self.assertTrue(text.startswith(self.sward("info", field).stdout))
        for title, key in (("height [m]", "height_m"), ("blades of a patch", "blades_per_patch")):
            head, *lines = text.split(f"  {title}: ")[1].splitlines()
            self.assertIn(str(histogram[key]["count"]), head)
            counts = [count for count in histogram[key]["bars"]["counts"] if count > 0]
            shown = []
            for line in lines:
                if not line.startswith("    "):
                    break
                shown.append(int(line.split()[3]))
            self.assertEqual([count for count in shown if count > 0], counts)

    def test_a_field_without_blades_has_empty_bars(self):
        field = self.bake("plane", "--density", "1", "--altitude", "5:", to="none.sward")
        histogram = self.histogram(field)["histogram"]
        self.assertEqual({entry["count"] for entry in histogram.values()}, {0})
        self.assertIn("height [m]: 0 blades", self.sward("info", field, "--histogram").stdout)


if __name__ == "__main__":
    unittest.main()
