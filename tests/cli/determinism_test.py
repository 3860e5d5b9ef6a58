"""The same mesh, settings and seed give the same bytes, however and wherever they are baked."""

import json
import re
import struct
import subprocess
import unittest

from meshes import bumps, glb_bytes
from support import CliTest, ROOT, digest

LOADER = "/lib64/ld-linux-x86-64.so.2"
# Turns the C library's choice of faster code down to the x86-64 baseline (glibc 2.33 and later).
BASELINE = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX,-AVX2,-AVX512F,-AVX512VL,-AVX512BW,-AVX512DQ,"
                              "-FMA,-FMA4,-BMI1,-BMI2,-ERMS,-SSE4_1,-SSE4_2,-SSSE3"}
# Every step of the bake takes part: rays, filters, traits, patches.
OPTIONS = ("--count", "30000", "--clearance", "0.3", "--slope", "0:70~10", "--sky-rays", "8",
           "--seed", "5", "--align", "blend:0.3")

# Hashes of fields that were baked on Debian 12 by GCC 12 with Embree 3.
KNOWN = ROOT / "tests/cli/baked_fields.json"


def hashes(field):
    """The file's own hashes of its patches and blades. Other chunks are compressed: their bytes depend
    on the version of zstd."""
    content = field.read_bytes()
    (chunks,) = struct.unpack_from("<I", content, 24)
    table = [struct.unpack_from("<8s24xQ", content, 64 + 64 * chunk) for chunk in range(chunks)]
    return {name.decode().strip(): f"{value:016x}" for name, value in table
            if name in (b"PATCHES ", b"BLADES  ")}


class Determinism(CliTest):
    def test_any_number_of_threads_gives_the_same_bytes(self):
        for ground in ("hills", "arch"):
            with self.subTest(ground=ground):
                digests = {threads: digest(self.bake(ground, *OPTIONS, "--threads", threads,
                                                     to=f"{ground}{threads}.sward"))
                           for threads in (1, 2, 7)}
                self.assertEqual(len(set(digests.values())), 1, digests)

    def test_the_sample_terrain_too(self):
        mesh = ROOT / "assets/meshes/landscape.glb"
        digests = {digest(self.bake(mesh, "--density", "15", "--mask", "vertex-color:R:or-white", "--threads",
                                    threads, to=f"{threads}.sward")) for threads in (1, 2, 7)}
        self.assertEqual(len(digests), 1)

    def test_any_directory_and_name_gives_the_same_bytes(self):
        content = glb_bytes(bumps())
        digests = set()
        for number, (folder, name) in enumerate((("here", "m.glb"), ("there/deeper", "other.glb"))):
            place = self.folder / folder
            place.mkdir(parents=True)
            (place / name).write_bytes(content)
            digests.add(digest(self.bake(name, *OPTIONS, folder=place)))
            digests.add(digest(self.bake(place / name, *OPTIONS, to=f"{number}.sward")))
        self.assertEqual(len(digests), 1)

    def test_any_cpu_gives_the_same_bytes(self):
        native = digest(self.bake("arch", *OPTIONS, to="native.sward"))
        baseline = digest(self.bake("arch", *OPTIONS, to="baseline.sward", environment=BASELINE))
        self.assertEqual(native, baseline)

    def test_any_distribution_gives_the_same_blades(self):
        # Other compilers, C libraries and versions of Embree, OpenMesh and tinygltf.
        blades = ("--meadow", "grass")
        fields = {ground: hashes(self.bake(ground, *OPTIONS[2:], *blades, "--count", "5000", to=f"{ground}.sward"))
                  for ground in ("plane", "sphere", "hills", "dunes", "torus", "arch")}
        fields["hills, poisson"] = hashes(self.bake("hills", *blades, "--sampling", "poisson", "--count", "5000",
                                                    "--curvature", ":0.5~0.2", "--slope",
                                                    "0:180", to="poisson.sward"))
        fields["hills, plants"] = hashes(self.bake("hills", "--meadow", "hay", "--count", "5000", to="hay.sward"))
        fields["landscape"] = hashes(self.bake(ROOT / "assets/meshes/landscape.glb", *OPTIONS[2:], *blades,
                                               "--density", "5", "--mask", "vertex-color:R:or-white", to="mesh.sward"))
        text = json.dumps(fields, indent=2) + "\n"
        self.assertEqual(fields, json.loads(KNOWN.read_text(encoding="ascii")),
                         f"a change that is meant to sow other blades puts this into {KNOWN.name}:\n{text}")

    def test_the_c_library_obeys_the_tunables(self):
        # Guards the test above against names that a newer C library would ignore.
        def active(environment):
            text = subprocess.run([LOADER, "--list-diagnostics"], env=environment, capture_output=True,
                                  text=True, check=True).stdout
            return re.findall(r"x86\.cpu_features\.features.*active.*", text)
        self.assertNotEqual(active({}), active(BASELINE))

    def test_nothing_of_the_run_is_in_the_field(self):
        field = self.bake("hills", "--count", "100", "--threads", "1")
        content = field.read_bytes()
        for text in (str(self.folder), "field.sward", "thread"):
            self.assertNotIn(text.encode(), content)

    def test_another_seed_is_another_meadow(self):
        one = self.bake("hills", "--count", "1000", "--seed", "1", to="1.sward")
        two = self.bake("hills", "--count", "1000", "--seed", "2", to="2.sward")
        roots = {blade.root for blade in self.blades(one)}
        self.assertLess(len(roots & {blade.root for blade in self.blades(two)}), 5)


if __name__ == "__main__":
    unittest.main()
