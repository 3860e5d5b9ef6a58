"""The extensions of the Godot add-on, in a host that plays Godot: what they read, refuse and draw."""

import csv
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["SWARD_PROGRAM"]


def lines_of(*command, **environment):
    """What a program prints, and that it ends well."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=300,
                          env={**os.environ, **environment})
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout.splitlines()


class WithFields(unittest.TestCase):
    COUNT = 1000

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="sward-godot-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.field = cls.folder / "meadow.sward"
        subprocess.run([PROGRAM, "bake", "hills", "--meadow", "daisies", "--count", str(cls.COUNT), "--blade-scale", "4", "-o",
                        cls.field, "-q"],
                       check=True)

    def damaged(self, name, change):
        content = bytearray(self.field.read_bytes())
        change(content)
        path = self.folder / name
        path.write_bytes(content)
        return path


class Fields(WithFields):
    def read(self, field, *hidden):
        return lines_of(os.environ["SWARD_GODOT_FIELDS"], os.environ["SWARD_GODOT_LIBRARY"], field, *hidden)

    def test_buffers_of_multimeshes_have_the_blades_of_the_file(self):
        lines = self.read(self.field)
        self.assertIn("blades 1000", lines)
        species = [line.split() for line in lines if line.startswith("species")]
        self.assertGreater(len(species), 1)
        x, y, z, speed, strength = map(float, next(line for line in lines if line.startswith("breeze")).split()[1:])
        self.assertAlmostEqual(x * x + y * y + z * z, 1.0, 5)
        self.assertGreater(speed, 0)
        self.assertGreater(strength, 0)
        blades = sorted(tuple(map(float, line.split()[1:])) for line in lines if line.startswith("blade "))
        self.assertEqual(len(lines), 2 + len(species) + len(blades), "nothing else is said")
        table = self.folder / "meadow.csv"
        subprocess.run([PROGRAM, "export", self.field, "-o", table], check=True, capture_output=True)
        with open(table, encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(blades))
        # Places are unique: nothing stands in another's spot.
        place = lambda x, y, z: (round(x * 500), round(y * 500), round(z * 500))
        wanted = {}
        for row in rows:
            wanted.setdefault(place(*(float(row[axis]) for axis in "xyz")), []).append(row)
        for x, y, z, width, length, depth, stiffness, exposure, _, height in blades:
            near = [row for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                    for row in wanted.get(tuple(a + b for a, b in zip(place(x, y, z), (dx, dy, dz))), [])]
            fits = [row for row in near
                    if max(abs(float(row[axis]) - value) for axis, value in zip("xyz", (x, y, z))) < 1e-4
                    and abs(float(row["height"]) - height) < 1e-5
                    and abs(float(row["stiffness"]) - stiffness) < 1e-5
                    and abs(float(row["exposure"]) - exposure) < 1e-5
                    and abs(length - height) < 1e-5 and abs(depth - height) < 1e-5
                    # A plant's mesh has its own width.
                    and min(abs(width - float(row["width"])), abs(width - height)) < 1e-5]
            self.assertEqual(len(fits), 1, (x, y, z))
            wanted[place(*(float(fits[0][axis]) for axis in "xyz"))].remove(fits[0])

    def test_what_is_wrong_with_a_file_is_said_with_its_name(self):
        def newer(content):
            content[8] += 1

        def flipped(content):
            content[len(content) // 2] ^= 1

        for path, words in [(self.folder / "missing.sward", ["cannot open"]),
                            (self.damaged("flipped.sward", flipped), []),
                            (self.damaged("short.sward", lambda content: content.__delitem__(slice(40, None))), []),
                            (self.damaged("newer.sward", newer), ["version"])]:
            with self.subTest(path=path.name):
                lines = self.read(path)
                self.assertEqual(len(lines), 1, lines)
                for word in ["refused ", str(path), *words]:
                    self.assertIn(word, lines[0])

    def test_an_older_godot_is_refused(self):
        done = subprocess.run([os.environ["SWARD_GODOT_FIELDS"], os.environ["SWARD_GODOT_LIBRARY"], self.field,
                               "classdb_register_extension_class4"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("sward_field_entry has refused", done.stderr)

    def test_a_reader_of_fields_needs_no_vulkan_and_shows_its_entry_alone(self):
        library = os.environ["SWARD_GODOT_LIBRARY"]
        self.assertNotIn("vulkan", subprocess.run(["readelf", "-d", library], capture_output=True, text=True,
                                                  check=True).stdout)
        for path, shown in [(library, {"sward_field_entry"}),
                            (os.environ["SWARD_GODOT_NATIVE"], {"sward_native_entry", "sward_features_layer_negotiate"})]:
            table = subprocess.run(["nm", "-D", "--defined-only", path], capture_output=True, text=True, check=True)
            self.assertEqual({line.split()[-1] for line in table.stdout.splitlines()}, shown)

    def test_what_the_extensions_need_lies_beside_them(self):
        folder = Path(os.environ["SWARD_GODOT_LIBRARY"]).parent
        for name in ("field", "native"):
            text = (folder / f"sward_{name}.gdextension").read_text(encoding="utf-8")
            needed = subprocess.run(["readelf", "-d", folder / f"libsward_godot_{name}.so"], capture_output=True,
                                    text=True, check=True).stdout
            for library in [line.split("[")[1].rstrip("]") for line in needed.splitlines() if "NEEDED" in line]:
                if not library.startswith(("libc.", "libm.", "libstdc++.", "libgcc_s.", "libvulkan.", "ld-linux")):
                    self.assertTrue((folder / library).is_file(), library)
                    self.assertIn(f'"{library}"', text)


class Native(WithFields):
    COUNT = 20000

    def draw(self, *mode, **environment):
        return lines_of(os.environ["SWARD_GODOT_DEVICE"], os.environ["SWARD_GODOT_NATIVE"], self.field, *mode,
                        **environment)

    def test_grass_is_drawn_on_a_device_of_godot(self):
        lines = self.draw()
        self.assertEqual([line for line in lines if line.startswith(("validation", "error", "the host"))], [])
        self.assertIn("environment restored", lines)
        numbers = {line.split()[0]: list(map(int, line.split()[1:])) for line in lines
                   if line.split()[0] in ("covered", "blades", "pressed", "views", "moved")}
        self.assertGreater(numbers["covered"][0], 100)
        self.assertGreater(numbers["blades"][0], 100)
        self.assertNotEqual(numbers["pressed"], numbers["covered"], "a ball moves blades")
        self.assertEqual(numbers["views"][0], numbers["views"][1], "both views look from the same place")
        self.assertGreater(numbers["views"][0], 100)
        self.assertEqual(numbers["moved"], [0], "a field that is moved away is not seen")
        refused = [line for line in lines if " refused " in line]
        self.assertEqual([line.split()[0] for line in refused], ["missing", "settings", "size", "unknown"])
        self.assertIn("missing.sward", refused[0])
        self.assertIn("windd", refused[1])
        self.assertIn("view 4", refused[2])
        self.assertIn("view 1", refused[3])

    def test_why_it_cannot_draw_is_said(self):
        for without, words in [("shaderBufferInt64Atomics", "lacks shaderBufferInt64Atomics"),
                               ("scalarBlockLayout,maintenance4", "lacks scalarBlockLayout, maintenance4"),
                               ("vulkan1.3", "1.3 is needed")]:
            with self.subTest(without=without):
                lines = self.draw(SWARD_GODOT_WITHOUT=without)
                self.assertEqual(len(lines), 2, lines)
                self.assertIn("start refused ", lines[1])
                self.assertIn(words, lines[1])

    def test_a_device_without_the_layer_is_refused(self):
        for mode, environment in [(["late"], {}), ([], {"SWARD_GODOT_WITHOUT": "layer"})]:
            with self.subTest(mode=mode):
                lines = self.draw(*mode, **environment)
                self.assertEqual(len(lines), 2, lines)
                self.assertIn("start refused the layer VK_LAYER_SWARD_features is not on Godot's device", lines[1])

    def test_features_go_into_the_structs_that_a_host_has(self):
        self.assertEqual(self.draw("whole"), ["environment restored", "started"])

    def test_layers_of_the_user_stay(self):
        with tempfile.TemporaryDirectory(prefix="sward-layers-") as empty:
            lines = self.draw("start", VK_INSTANCE_LAYERS="VK_LAYER_KHRONOS_validation", VK_LAYER_PATH=
                              f"{empty}:/usr/share/vulkan/explicit_layer.d")
        self.assertIn("environment restored", lines)
        self.assertIn("started", lines)


if __name__ == "__main__":
    unittest.main()
