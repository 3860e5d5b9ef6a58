"""A file name is bytes. One that is not UTF-8 is found, and ends no command."""

import json
import os
import unittest

from meshes import glb_bytes, square
from support import CliTest, USAGE

ODD = os.fsdecode(b"caf\xe9")  # Latin-1, as from an old archive


class Names(CliTest):
    def setUp(self):
        super().setUp()
        self.home = self.folder / ODD
        self.home.mkdir()
        (self.home / f"{ODD}.glb").write_bytes(glb_bytes(square(20.0)))
        (self.home / f"{ODD}-pond.glb").write_bytes(glb_bytes(square(4.0)))

    def odd(self, *arguments, **how):
        """Runs in the folder; returns stdout as JSON."""
        return json.loads(self.sward(*arguments, folder=self.home, **how).stdout)

    def test_in_every_json_that_is_written(self):
        mesh, pond = (self.home / f"{ODD}{name}.glb" for name in ("", "-pond"))
        self.sward("bake", mesh, "-o", self.home / f"{ODD}.sward", "--count", "50", "--occluder", pond,
                   "--exclude", pond, "--report", self.home / f"{ODD}.json")
        report = json.loads((self.home / f"{ODD}.json").read_bytes())
        self.assertIn("caf\ufffd.glb", report["input"]["path"])
        self.assertIn("caf\ufffd.sward", report["output"]["path"])
        effective = self.odd("bake", mesh, "-o", "x", "--print-config", "--hole-mask", mesh)
        self.assertIn("caf\ufffd.glb", effective["ground"]["input"][0])
        self.assertEqual(self.odd("info", f"{ODD}.sward", "--json")["blades"], 50)
        self.sward("validate", self.home / f"{ODD}.sward")
        for extension in (".csv", ".ply", ".usda", ".glb"):
            self.sward("export", self.home / f"{ODD}.sward", "-o", self.home / f"{ODD}{extension}",
                       "--force")

    def test_inside_of_a_mesh(self):
        (self.folder / "m.mtl").write_bytes(b"newmtl g\xe9\nKd 0 1 0\n")
        (self.folder / "m.obj").write_bytes(b"mtllib m.mtl\no n\xe9\nv 0 0 0\nv 1 0 0\nv 0 0 1\n"
                                            b"usemtl g\xe9\nf 1 3 2\n")
        self.bake("m.obj", "--count", "20", "--material", os.fsdecode(b"g\xe9"), "--report", "r.json",
                  to="f.sward")
        self.info(self.folder / "f.sward")
        self.sward("export", "f.sward", "-o", "f.glb", "--with-ground")
        self.sward("terrain", "m.obj", "-o", "t.glb")
        self.bake("t.glb", "--count", "20", "--material", "g\ufffd", to="t.sward")

    def test_in_a_plan_are_found_again(self):
        plan = self.home / f"{ODD}.json"
        options = ("--exclude", f"{ODD}-pond.glb:margin", "0.5", "--count", "200", "--seed", "3", "--")
        self.sward("bake", "-o", "whole.sward", *options, f"{ODD}.glb", folder=self.home)
        self.assertEqual(self.odd("info", "whole.sward", "--json")["blades"], 200)
        self.sward("plan", "-o", plan, "--tiles", "2", *options, f"{ODD}.glb", folder=self.home)
        written = json.loads(plan.read_text(encoding="utf-8"))
        self.assertIn({"percent": "caf%E9.glb"}, written["arguments"])
        for index in range(2):
            self.sward("tile", plan, "--index", index, "-o", self.home / "tiles")
        self.sward("merge", plan, self.home / "tiles", "-o", self.home / "joined.sward", "--report",
                   self.home / "r.json")
        self.sward("compare", self.home / "whole.sward", self.home / "joined.sward")
        self.assertIn("caf\ufffd.glb", self.read_json(f"{ODD}/r.json")["input"]["path"])

    def test_of_masks_beside_a_meadow_survive_assignments(self):
        # A mask that is missing is named by its own bytes: it was looked for under them.
        meadow = {"species": [{"name": "a", "share": 1, "mask": "texture:m.png:R"}]}
        (self.home / "m.json").write_text(json.dumps(meadow))
        for assignment in ((), ("--set", "clump_size_m=1")):
            done = self.sward("bake", "plane", "-o", "f.sward", "--meadow", self.home / "m.json",
                              *assignment, code=2, before=None)
            self.assertIn(str(self.home / "m.png"), done.stderr)

    def test_that_json_cannot_hold_are_refused_in_words(self):
        (self.folder / "m.json").write_bytes(b'{"species": [{"name": "caf\xe9"}]}')
        self.refused("bake", "plane", "-o", "f.sward", "--meadow", "m.json", code=3,
                     names=["m.json", "UTF-8"])
        self.refused("bake", "plane", "-o", "f.sward", f"--set=species.0.name={ODD}", code=USAGE,
                     names=["--set", "UTF-8"])

    def test_with_control_characters_neither_cut_a_message_nor_reach_the_terminal(self):
        odd = b"a\x1b]0;x\x07\0\x7f\xc2\x9bz"
        shown = "a\\x1b]0;x\\x07\\x00\\x7f\\x9bz"
        for name, content in {
                "a.ply": b"ply\nformat ascii 1.0\nelement " + odd + b" x\nend_header\n",
                "b.ply": b"ply\nformat " + odd + b" 1.0\nend_header\n",
                "a.obj": b"v 0 " + odd + b" 0\n",
                "a.off": b"OFF\n3 " + odd + b" 0\n",
                "a.stl": b"solid a\nfacet normal 0 0 " + odd + b"\n",
                "a.asc": b"ncols " + odd + b"\nnrows 2\n",
                "a.json": b'{"' + odd.replace(b"\0", b"") + b'": 1}'}.items():
            with self.subTest(name=name):
                (self.folder / name).write_bytes(content)
                said = self.refused("bake", name, "-o", "f.sward", code=3, names=[name]).stderr
                self.assertTrue(all(c.isprintable() or c == "\n" for c in said), ascii(said))
                if name in ("b.ply", "a.off", "a.asc"):  # these quote what they found
                    self.assertIn(shown, said)
        species = {"name": "\x1b[2Jgrün\x7f\x9b\0", "share": 1}
        self.write_json("m.json", {"species": [species]})
        self.bake("plane", "--count", "9", "--meadow", "m.json")
        for option in ((), ("--json",)):
            told = self.sward("info", "field.sward", *option).stdout
            self.assertTrue(all(c.isprintable() or c == "\n" for c in told), ascii(told))
        self.assertEqual(json.loads(told)["species"][0]["name"], species["name"])


if __name__ == "__main__":
    unittest.main()
