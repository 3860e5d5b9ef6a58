"""The programs for Windows do by Wine what those for Linux do. scripts/test-windows runs this, with bake_test.py and window_test.py."""

import ctypes
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import zipfile
from pathlib import Path

import wine
from bake_test import *  # noqa: F401,F403  its tests are run with those here
from window_test import *  # noqa: F401,F403  and so are its
from wine import Case, ROOT, WINDOWS, baked, linux, shared_folder, windows

# Ten fields: grounds, species with ribbons, seeds, names that are not ASCII, no blades at all.
FIELDS = {
    "plane.sward": ("plane", "--count", "20000", "--blade-scale", "4"),
    "sphere.sward": ("sphere", "--count", "6000"),
    "hills.sward": ("hills", "--count", "8000", "--blade-scale", "4"),
    "daisies.sward": ("plane", "--meadow", "daisies", "--count", "3000", "--blade-scale", "1"),
    "marsh.sward": ("plane", "--meadow", "marsh", "--count", "3000"),
    "dunes.sward": ("dunes", "--meadow", "dunes", "--count", "4000", "--blade-scale", "4"),
    "alpine.sward": ("sphere", "--meadow", "alpine", "--count", "3000"),
    "seeds.sward": ("plane", "--density", "40", "--seeds", "always"),
    "one.sward": ("plane", "--count", "1"),
    "wiese-ä-草-🌾.sward": ("plane", "--count", "500", "--seed", "7"),
}
SIZE = ("--size", "320x200")
TGKILL = 234  # the number of this system call on x86-64
AS_ROOT = [] if os.geteuid() == 0 else ["sudo", "-n"]
# Scenes of the rasteriser, one of seeds that are sown, and one of the tessellator.
SCENES = (
    ("plane.sward",),
    ("sphere.sward", "--frames", "3:3", "--fixed-dt", "1/30"),
    ("hills.sward", "--wind-strength", "3", "--frames", "4:4", "--fixed-dt", "1/10"),
    ("daisies.sward", "--collider", "sphere:0,0.2,0,0.5", "--frames", "2:2", "--fixed-dt", "1/10"),
    ("wiese-ä-草-🌾.sward", "--samples", "1", "--camera", "eye"),
    ("seeds.sward", "--camera", "eye"),
    ("dunes.sward", "--geometry", "tessellation"),
)


def fields():
    return [baked(name, *arguments) for name, arguments in FIELDS.items()]


class SystemCalls(Case):
    def test_the_laws_of_files_and_names_hold(self):
        done = self.check(windows("system_calls", self.folder()))
        # Wine 8 has no renames with POSIX semantics.
        self.assertRegex(done.stdout, b"^an open file: (not )?replaced\n$")


class Fields(Case):
    def test_a_field_that_is_read_and_written_again_has_its_bytes(self):
        folder, names = self.folder(), fields()
        pairs = [argument for name in names for argument in (name, f"{folder}/{name}")]
        self.check(windows("rewrite", *pairs, cwd=shared_folder()))
        for name in names:
            with self.subTest(field=name):
                self.assertEqual((folder / name).read_bytes(), (shared_folder() / name).read_bytes())


class Pictures(Case):
    def test_pictures_are_those_of_linux_byte_for_byte(self):
        folder = self.folder()
        fields()
        for i, scene in enumerate(SCENES):
            with self.subTest(scene=" ".join(scene)):
                pictures = []
                for run, name in ((linux, f"linux-ä-{i}.png"), (windows, f"windows-草-{i}.png")):
                    self.check(run("sward-view", "render", *scene, *SIZE, "-o", f"{folder}/{name}", "-q", cwd=shared_folder()))
                    pictures.append((folder / name).read_bytes())
                self.assertEqual(*pictures)

    def test_devices_are_those_of_linux(self):
        done = self.check(windows("sward-view", "devices"))
        self.assertIn(b"llvmpipe", done.stdout)

    def test_a_benchmark_measures(self):
        fields()
        done = self.check(windows("sward-view", "bench", "plane.sward", *SIZE, "--frames", "3", "-q", cwd=shared_folder()))
        self.assertIn("[ms]", done.stdout.decode())


class CInterface(Case):
    def test_a_host_in_c_draws_as_on_linux(self):
        folder = self.folder()
        arguments = ["plane", "--count", "20000", "--blade-scale", "4"]
        field, damaged = folder / "plane.sward", folder / "damaged.sward"
        subprocess.run([wine.LINUX / "sward", "bake", *arguments, "-o", field, "-q"], check=True, stdout=subprocess.DEVNULL)
        content = bytearray(field.read_bytes())
        content[len(content) // 2] ^= 1
        damaged.write_bytes(content)
        seeded = folder / "seeded.sward"
        subprocess.run([wine.LINUX / "sward", "bake", "plane", "--density", "60", "--blade-scale", "4", "--sky-rays", "0",
                        "--seeds", "always", "--budget", "5000", "-o", seeded, "-q"], check=True, stdout=subprocess.DEVNULL)
        stroke = {"kind": "erase", "radius_m": 12, "hardness": 1, "points": [[0, 0, 0]]}
        with subprocess.Popen([wine.LINUX / "sward", "edit", *arguments, "--field", field, "-q"], text=True,
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE) as session:
            session.stdout.readline()
            print(json.dumps({"id": 1, "do": "paint", "keep": 0, "strokes": [stroke]}), file=session.stdin, flush=True)
            delta = json.loads(session.stdout.readline())["delta"]
            there = self.check(windows("host", field, damaged, delta, seeded))
            here = self.check(linux("sward_c_host", field, damaged, delta, seeded))
            session.stdin.close()
        self.assertEqual(there.stdout.replace(b"\r", b""), here.stdout)
        self.assertEqual(there.stderr, b"")

    def test_a_reader_in_c_reads_as_on_linux_and_opens_no_vulkan(self):
        fields()
        # As on a machine without a loader.
        without = {"WINEDLLOVERRIDES": "mscoree,mshtml,vulkan-1=", "DISPLAY": ""}
        there = self.check(windows("fields_only", "daisies.sward", cwd=shared_folder(), env=without))
        here = self.check(linux("sward_c_fields", "daisies.sward", cwd=shared_folder()))
        self.assertEqual(there.stdout.replace(b"\r", b""), here.stdout)
        refused = windows("sward-view", "render", "plane.sward", "-o", "none.png", cwd=shared_folder(), env=without)
        self.assertEqual(refused.returncode, 5, refused.stderr)  # SWARD_ERROR_UNSUPPORTED
        self.assertIn(b"vulkan-1.dll", refused.stderr)

    def test_the_library_exports_what_its_headers_declare_and_links_nothing_of_the_compiler(self):
        declared = {name for file in ("field", "device", "grass", "view")
                    for name in re.findall(r"(?m)^[a-zA-Z].*[ *](sward_[a-z0-9_]+)\(", (ROOT / f"src/c/{file}.h").read_text("utf-8"))}
        said = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", WINDOWS / "sward.dll"], capture_output=True, text=True, check=True).stdout
        exported = set(re.findall(r"(?m)^\s*\[\s*\d+\].*\b(sward_\w+)$", said))
        self.assertEqual(exported, declared)
        for program in ("sward.dll", "sward.exe", "sward-view.exe"):
            said = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", WINDOWS / program], capture_output=True, text=True, check=True).stdout
            linked = {name.lower() for name in re.findall(r"DLL Name: (\S+)", said)}
            self.assertLessEqual(linked, {"advapi32.dll", "kernel32.dll", "msvcrt.dll", "shell32.dll", "user32.dll",
                                          *(["gdi32.dll"] if program == "sward-view.exe" else [])}, program)


class Archive(Case):
    """What scripts/bundle --windows packs."""

    def unpacked(self):
        folder = self.folder()
        subprocess.run([ROOT / "scripts/bundle", "--windows", "--out", folder], check=True, stdout=subprocess.DEVNULL)
        packed, = folder.glob("*.zip")
        self.assertLess(packed.stat().st_size, 30_000_000)
        with zipfile.ZipFile(packed) as archive:
            archive.extractall(folder)
        return packed.with_suffix("")

    def test_the_example_is_built_from_it_alone_and_reads_a_field(self):
        folder = self.unpacked()
        fields()
        subprocess.run(["x86_64-w64-mingw32-gcc", "-Wall", "-Werror", "-I", "include", "examples/read_field.c", "-L", "lib", "-lsward",
                        "-o", "bin/read_field.exe"], cwd=folder, check=True)
        done = self.check(subprocess.run([wine.WINE, folder / "bin/read_field.exe", "daisies.sward", folder / "rows.csv"],
                                         cwd=shared_folder(), env=wine.environment(), capture_output=True, timeout=wine.PATIENCE))
        self.assertIn(b"daisy", done.stdout)
        table = folder / "linux.csv"
        subprocess.run([wine.LINUX / "sward", "export", "daisies.sward", "-o", table, "-q"], cwd=shared_folder(), check=True,
                       stdout=subprocess.DEVNULL)
        self.assertEqual(len((folder / "rows.csv").read_text().splitlines()), len(table.read_text("utf-8").splitlines()))
        view = self.check(subprocess.run([wine.WINE, folder / "bin/sward-view.exe", "--version"], env=wine.environment(), capture_output=True))
        self.assertEqual(view.stdout, linux("sward-view", "--version").stdout)

    def test_licences_of_all_that_is_compiled_in_are_there(self):
        licences = {file.name for file in (self.unpacked() / "licenses").iterdir()}
        self.assertLessEqual({"libzstd-dev", "libfmt-dev", "libembree-dev", "libtbb-dev", "libopenexr-dev", "libz-mingw-w64-dev", "gcc-mingw-w64-base", "mingw-w64-x86-64-dev", "common-licenses"}, licences)

    def test_a_linker_that_takes_the_options_of_microsofts_links_it(self):
        folder = self.unpacked()
        (folder / "start.c").write_text("#define SWARD_NO_VULKAN\n#include <sward/c/sward.h>\n"
                                        "__declspec(dllimport) void ExitProcess(unsigned);\n"
                                        "void start(void) { ExitProcess(sward_last_error()[0] == 0 ? 42 : 1); }\n")
        subprocess.run(["x86_64-w64-mingw32-gcc", "-I", "include", "-c", "start.c", "-o", "start.obj"], cwd=folder, check=True)
        subprocess.run(["lld-link", "/nologo", "/nodefaultlib", "/subsystem:console", "/entry:start", "/out:bin/start.exe", "start.obj",
                        "lib/sward.lib", "/usr/x86_64-w64-mingw32/lib/libkernel32.a"], cwd=folder, check=True)
        done = subprocess.run([wine.WINE, folder / "bin/start.exe"], env=wine.environment(), capture_output=True, timeout=wine.PATIENCE)
        self.assertEqual(done.returncode, 42, done.stderr)


class Complaints(Case):
    """Exit codes and messages are those of Linux."""

    def both(self, *arguments):
        said = [run("sward-view", *arguments, cwd=shared_folder()) for run in (linux, windows)]
        self.assertEqual(*(done.stderr.decode() for done in said))
        self.assertEqual(*(done.returncode for done in said))
        return said[1]

    def test_files_that_cannot_be_read(self):
        fields()
        whole = (shared_folder() / "plane.sward").read_bytes()
        bad = {"empty.sward": b"", "text-ä.sward": b"no field", "cut-草.sward": whole[:-100],
               "changed.sward": whole[:5000] + bytes([whole[5000] ^ 1]) + whole[5001:]}
        for name, content in bad.items():
            (shared_folder() / name).write_bytes(content)
            with self.subTest(name=name):
                done = self.both("render", name, "-o", "none.png")
                self.assertEqual(done.returncode, 3)
                self.assertIn(name, done.stderr.decode())
        self.both("render", "missing-ä.sward", "-o", "none.png")
        self.both("render", ".", "-o", "none.png")
        self.assertFalse((shared_folder() / "none.png").exists())

    def test_places_that_cannot_be_written(self):
        fields()
        for place in ("no-folder-草.png/a.png", ".", "plane.sward", "a.jpg"):
            with self.subTest(place=place):
                self.both("render", "plane.sward", "-o", place)

    def test_arguments_that_are_wrong(self):
        for arguments in (("render",), ("render", "a.sward", "--size", "ä"), ("devices", "--草")):
            with self.subTest(arguments=arguments):
                self.assertEqual(self.both(*arguments).returncode, 1)


class Ends(Case):
    def test_ctrl_c_ends_a_long_work_and_leaves_nothing(self):
        folder = self.folder()
        fields()
        # The processes of Wine are those of Linux; to one of them SIGINT is Ctrl-C.
        work = subprocess.Popen([wine.WINE, WINDOWS / "sward-view.exe", "render", "plane.sward", *SIZE, "--frames", "0:100000", "-o", f"{folder}/%d.png"],
                                cwd=shared_folder(), env=wine.environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        end = time.monotonic() + wine.PATIENCE
        while not any(folder.iterdir()) and time.monotonic() < end:
            time.sleep(0.05)
        # To the first thread: those of the driver are none of Wine's, whose handler would fail there.
        ctypes.CDLL(None).syscall(TGKILL, work.pid, work.pid, signal.SIGINT)
        said = work.communicate(timeout=60)[1].decode()
        self.assertEqual(work.returncode, 130, said)
        self.assertIn("interrupted", said)
        self.assertEqual([file.name for file in folder.iterdir() if not file.name.endswith(".png")], [])

    def test_a_full_disk_is_an_error_and_leaves_nothing(self):
        fields()
        folder = self.folder()
        # As root; scripts/install-dependencies asks for it, too.
        subprocess.run([*AS_ROOT, "mount", "-t", "tmpfs", "-o", "size=64k,mode=777", "none", folder], check=True)
        self.addCleanup(subprocess.run, [*AS_ROOT, "umount", folder], check=True)
        for run in (linux, windows):
            done = run("sward-view", "render", "plane.sward", "--size", "640x400", "-o", f"{folder}/a.png", "-q", cwd=shared_folder())
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(b"No space left on device", done.stderr)
            self.assertEqual(list(folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
