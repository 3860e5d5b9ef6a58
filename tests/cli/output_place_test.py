"""An output place that takes no file, or must keep what it holds, is refused before the work."""

import os
import resource
import signal
import struct
import subprocess
import unittest
import zlib

from support import CliTest, DONE, INTERRUPTED, IO, PROGRAM, USAGE

# Minutes of work, so that a test that passes shows that none was done.
LONG = ("--count", "130000000")


def png():
    """A white image of one pixel."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(b"\0\xff\xff\xff")) + chunk(b"IEND", b""))


class OutputPlace(CliTest):
    def commands(self):
        """Each command that writes a file, up to the file's name, and the extension of that."""
        self.bake("plane", "--count", "10", to="in.sward")
        self.sward("plan", "plane", "--count", "10", "--tiles", "1", "-o", "in.json")
        self.sward("tile", "in.json", "--index", "0", "-o", "tiles")
        return ((("bake", "sphere", *LONG, "-o"), ".sward"),
                (("bake", "sphere", *LONG, "-o", "out.sward", "--report"), ".json"),
                (("bake", "sphere", "--dry-run", "--report"), ".json"),
                (("plan", "plane", "--tiles", "2", "-o"), ".json"),
                (("merge", "in.json", "tiles", "-o"), ".sward"),
                (("merge", "in.json", "tiles", "-o", "out.sward", "--report"), ".json"),
                (("export", "in.sward", "-o"), ".csv"),
                (("export", "in.sward", "-o"), ".glb"),
                (("terrain", "plane", "-o"), ".glb"))

    def test_that_is_no_regular_file(self):
        os.mkfifo(self.folder / "pipe")
        (self.folder / "null").symlink_to("/dev/null")
        for command, extension in self.commands():
            for kind, target in (("pipe", "pipe"), ("device", "/dev/null"), ("folder", ".")):
                name = f"{kind}{extension}"
                link = self.folder / name
                link.symlink_to(target)
                with self.subTest(command=command, kind=kind):
                    self.refused(*command, name, "--force", code=IO, names=[name, f"is a {kind}"])
                    self.assertTrue(link.is_symlink())
                link.unlink()

    def test_whose_name_is_too_long(self):
        for command, extension in self.commands():
            with self.subTest(command=command):
                longest = "a" * (255 - len(extension)) + extension
                self.refused(*command, "a" + longest, code=IO, names=["256 bytes", "255"])
                if command[0] != "plan" and command[1] != "sphere":
                    self.sward(*command, longest, "--force")

    def test_that_belongs_to_another_format(self):
        for command, extension in self.commands():
            if command[0] == "export":
                continue
            for other in (".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".csv", ".usda", ".png",
                          ".json", ".sward", ".GLB", ".mtl", ".bin"):
                if other.lower() != extension:
                    with self.subTest(command=command, other=other):
                        self.refused(*command, f"x{other}", code=USAGE, names=[f"x{other}", extension])

    def test_that_ends_in_what_no_program_knows(self):
        for command, extension in self.commands():
            if command[0] == "export":
                continue
            for name in ("x.txt", "lawn.v2", "x.swrad"):
                with self.subTest(command=command, name=name):
                    self.refused(*command, name, code=USAGE, names=[name, extension])
        # A name without an ending is taken as it is.
        self.bake("plane", "--count", "10", to="field")
        self.assertTrue((self.folder / "field").is_file())

    def test_of_a_tile_is_refused_before_the_tile_is_baked(self):
        # Without its parts the plan can bake nothing: an error of the place shows that it was looked at first.
        self.sward("plan", "plane", "--count", "10", "--tiles", "2", "-o", "p.json")
        self.sward("tile", "p.json", "--index", "0", "-o", "sound")
        name = next((self.folder / "sound").iterdir()).name
        (self.folder / "p.parts").rename(self.folder / "away")
        os.mkfifo(self.folder / "fifo")
        (self.folder / "file").write_text("precious")
        for kind, target in (("pipe", "../fifo"), ("device", "/dev/null"), ("folder", "../away")):
            (self.folder / kind).mkdir()
            (self.folder / kind / name).symlink_to(target)
            for force in ((), ("--force",)):
                with self.subTest(kind=kind, force=force):
                    self.refused("tile", "p.json", "--index", "0", "-o", kind, *force, code=IO,
                                 names=[name, f"is a {kind}"])
            self.assertTrue((self.folder / kind / name).is_symlink())
        for place in ("file", "/proc/none"):
            self.refused("tile", "p.json", "--index", "0", "-o", place, code=IO, names=[place])
        self.assertEqual((self.folder / "file").read_text(), "precious")

    def test_of_a_tile_follows_links_and_replaces_only_what_is_damaged(self):
        self.sward("plan", "plane", "--count", "10", "--tiles", "2", "-o", "p.json")
        self.sward("tile", "p.json", "--index", "0", "-o", "sound")
        tile = next((self.folder / "sound").iterdir())
        whole = tile.read_bytes()
        (self.folder / "links").mkdir()
        link = self.folder / "links" / tile.name
        link.symlink_to("../far")
        for content in (None, b"", whole[:-1], bytes(len(whole))):
            if content is not None:
                (self.folder / "far").write_bytes(content)
            self.sward("tile", "p.json", "--index", "0", "-o", "links")
            self.assertTrue(link.is_symlink())
            self.assertEqual((self.folder / "far").read_bytes(), whole)
        before = (self.folder / "far").stat()
        self.assertIn("is there already", self.sward("tile", "p.json", "--index", "0", "-o", "links").stdout)
        self.assertEqual((self.folder / "far").stat().st_mtime_ns, before.st_mtime_ns)

    def test_that_is_standard_output(self):
        (self.folder / "out.sward").symlink_to("/dev/stdout")
        with open(self.folder / "log", "wb") as log:
            done = subprocess.run([str(PROGRAM), "bake", "plane", "--count", "9", "-o", "out.sward",
                                   "--force"], cwd=self.folder, stdout=log, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, (self.folder / "log").read_bytes()), (IO, b""))
        self.assertIn(b"out.sward", done.stderr)

    def test_links_are_followed(self):
        (self.folder / "far").mkdir()
        for command, extension in self.commands():
            if command[1] == "sphere":
                continue
            with self.subTest(command=command):
                link = self.folder / f"link{extension}"
                link.symlink_to(f"far/{command[0]}{extension}")
                self.refused(*command, link.name, code=IO, names=[link.name, "--force"])
                self.sward(*command, link.name, "--force")
                self.assertTrue(link.is_symlink())
                self.assertGreater((self.folder / "far" / f"{command[0]}{extension}").stat().st_size, 9)
                link.unlink()

    def test_that_the_plans_parts_cannot_have(self):
        (self.folder / "p.parts").mkdir()
        (self.folder / "p.parts/precious").write_text("x")
        self.refused("plan", "sphere", "--tiles", "2", "-o", "p.json", code=IO, names=["p.parts"])

    def test_that_is_an_input_by_any_way(self):
        # The report takes names without extension, as these files have.
        (self.folder / "mtl").write_text("newmtl g\nmap_Kd skin\n")
        (self.folder / "skin").write_bytes(png())
        (self.folder / "mask").write_bytes(png())
        (self.folder / "m.obj").write_text("mtllib mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nusemtl g\n"
                                           "f 1/1 3/1 2/1\n")
        (self.folder / "meadow").write_text('{"species": [{"name": "a", "share": 1, "mask": "texture:mask:R"}]}')
        (self.folder / "bytes").write_bytes(struct.pack("<9f", 0, 0, 0, 0, 0, 1, 1, 0, 0))
        self.write_json("m.gltf", {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "buffers": [{"uri": "bytes", "byteLength": 36}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 0, 1]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})
        (self.folder / "other").symlink_to("bytes")
        command = ("bake", "m.obj", "m.gltf", *LONG, "--meadow", "meadow", "--max-blades", "0", "--force")
        inputs = ("mtl", "skin", "mask", "meadow", "bytes", "other")
        before = {name: (self.folder / name).read_bytes() for name in inputs}
        for name in inputs:
            with self.subTest(name=name):
                self.refused(*command, "-o", "f.sward", "--report", name, code=USAGE,
                             names=[name, "is read and would be overwritten"])
                self.refused(*command, "-o", name, code=USAGE, names=[name, "is read"])
                self.refused("plan", *command[1:], "--tiles", "2", "-o", name, code=USAGE,
                             names=[name, "is read"])
        self.assertEqual(before, {name: (self.folder / name).read_bytes() for name in inputs})

    def test_recipes_tiles_and_fields_are_inputs_too(self):
        self.sward("terrain", "plane", "-o", "p.glb")
        os.link(self.folder / "p.glb", self.folder / "twin.glb")
        self.refused("terrain", "p.glb", "-o", "twin.glb", "--force", code=USAGE, names=["twin.glb"])
        self.commands()
        tile = next((self.folder / "tiles").iterdir())
        (self.folder / "t.sward").symlink_to(tile)
        self.refused("merge", "in.json", "tiles", "-o", "t.sward", "--force", code=USAGE, names=["t.sward"])
        (self.folder / "f.csv").symlink_to("in.sward")
        self.refused("export", "in.sward", "-o", "f.csv", "--force", code=USAGE, names=["f.csv"])

    def test_a_terminal_that_goes_ends_a_bake_cleanly(self):
        for number, ignored, code in ((signal.SIGHUP, False, INTERRUPTED),
                                      (signal.SIGXCPU, False, INTERRUPTED),
                                      (signal.SIGHUP, True, DONE)):
            with self.subTest(signal=number.name, ignored=ignored):
                count = "200000" if ignored else "100000000"
                running = subprocess.Popen(
                    [str(PROGRAM), "bake", "sphere", "-o", "f.sward", "--count", count, "--progress",
                     "always"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                    preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN) if ignored else None)
                self.assertTrue(os.read(running.stderr.fileno(), 1))
                running.send_signal(number)
                _, err = running.communicate(timeout=120)
                self.assertEqual(running.returncode, code, err)
                self.assertEqual(self.files(), {"f.sward"} if ignored else set())

    def test_a_limit_of_the_files_size_is_an_error_of_the_write(self):
        def small():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, (65536, 65536))
        done = self.sward("bake", "plane", "-o", "f.sward", "--count", "50000", code=IO, before=small)
        self.assertIn("f.sward: cannot write: File too large", done.stderr)
        self.assertEqual(self.files(), set())
        self.bake("plane", "--count", "5000", to="f.sward")
        for name in ("f.csv", "f.ply", "f.usda", "f.glb"):
            self.sward("export", "f.sward", "-o", name, code=IO, before=small)
        self.assertEqual(self.files(), {"f.sward"})


if __name__ == "__main__":
    unittest.main()
