"""An output appears whole or not at all, and never in the place of another unasked."""

import os
import resource
import signal
import subprocess
import unittest

from support import CliTest, INTERRUPTED, IO, PROGRAM, USAGE


def small_files_only():
    """In the child: no file may grow beyond 64 kB, as on a full disk."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (65536, 65536))


class Output(CliTest):
    def test_an_existing_output_is_refused_and_stays_whole(self):
        for name, command in (("f.sward", ("bake", "plane", "--count", "10", "-o", "f.sward")),
                              ("t.glb", ("terrain", "plane", "-o", "t.glb"))):
            with self.subTest(name=name):
                (self.folder / name).write_text("precious")
                self.refused(*command, code=IO, names=[name, "--force"])
                self.assertEqual((self.folder / name).read_text(), "precious")
                self.sward(*command, "--force")
                self.assertNotEqual((self.folder / name).read_bytes(), b"precious")

    def test_the_refusal_comes_before_any_work(self):
        # This bake would take minutes.
        (self.folder / "f.sward").write_text("precious")
        self.refused("bake", "sphere", "-o", "f.sward", "--count", "130000000", code=IO,
                     names=["f.sward"])

    def test_an_existing_report_is_refused_beforehand(self):
        self.write_json("r.json", "precious")
        self.refused("bake", "plane", "-o", "f.sward", "--count", "10", "--report", "r.json", code=IO,
                     names=["r.json", "--force"])
        self.assertEqual(self.read_json("r.json"), "precious")

    def test_a_folder_that_is_missing_or_takes_nothing(self):
        self.refused("bake", "plane", "-o", "no/f.sward", code=IO, names=["no/f.sward"])
        self.refused("bake", "plane", "-o", "f.sward", "--report", "no/r.json", code=IO,
                     names=["no/r.json"])
        (self.folder / "file").write_text("x")
        self.refused("bake", "plane", "-o", "file/f.sward", code=IO, names=["file/f.sward"])
        # No user, root included, can create a file there.
        self.refused("bake", "plane", "-o", "/proc/f.sward", "--count", "10", code=IO,
                     names=["/proc/f.sward"])
        self.refused("terrain", "plane", "-o", "/proc/f.glb", code=IO, names=["/proc/f.glb"])

    def test_a_folder_is_not_an_output(self):
        (self.folder / "f.sward").mkdir()
        self.refused("bake", "plane", "-o", "f.sward", "--force", code=IO, names=["f.sward"])

    def test_an_input_is_never_overwritten(self):
        self.sward("terrain", "plane", "-o", "m.glb")
        before = (self.folder / "m.glb").read_bytes()
        for output in ("m.glb", "./m.glb", str(self.folder / "m.glb")):
            self.refused("bake", "m.glb", "-o", output, "--force", code=USAGE, names=["m.glb"])
        self.assertEqual((self.folder / "m.glb").read_bytes(), before)

    def test_a_full_disk_leaves_nothing(self):
        done = self.sward("bake", "sphere", "-o", "f.sward", "--count", "100000", code=IO,
                          before=small_files_only)
        self.assertIn("f.sward", done.stderr)
        self.assertEqual((done.stdout, self.files()), ("", set()))

    def test_a_full_disk_leaves_the_old_file_whole(self):
        old = self.bake("sphere", "--count", "10", to="f.sward").read_bytes()
        self.sward("bake", "sphere", "-o", "f.sward", "--count", "100000", "--force", code=IO,
                   before=small_files_only)
        self.assertEqual((self.folder / "f.sward").read_bytes(), old)
        self.assertEqual(self.files(), {"f.sward"})

    def test_a_full_disk_stops_the_export_too(self):
        self.bake("plane", "--count", "5000", to="f.sward")
        self.sward("export", "f.sward", "-o", "f.csv", code=IO, before=small_files_only)
        self.assertEqual(self.files(), {"f.sward"})

    def test_an_interrupted_bake_ends_with_130_and_leaves_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number.name):
                # The bar shows that growing has begun; the rest would take minutes.
                running = subprocess.Popen(
                    [str(PROGRAM), "bake", "sphere", "-o", "f.sward", "--count", "100000000",
                     "--progress", "always"], cwd=self.folder, stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE)
                self.assertTrue(os.read(running.stderr.fileno(), 1))
                running.send_signal(number)
                out, err = running.communicate(timeout=60)
                self.assertEqual((running.returncode, out), (INTERRUPTED, b""), err)
                self.assertIn(b"interrupted", err)
                self.assertEqual(self.files(), set())

    def test_outputs_are_as_readable_as_the_mask_allows(self):
        self.sward("bake", "plane", "-o", "f.sward", "--count", "10", before=lambda: os.umask(0o027))
        self.assertEqual((self.folder / "f.sward").stat().st_mode & 0o777, 0o640)


if __name__ == "__main__":
    unittest.main()
