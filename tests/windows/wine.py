"""Runs the programs of build/windows by Wine, beside those of build/release."""

import atexit
import functools
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/viewer"))
from display import Display  # noqa: E402

LINUX = ROOT / "build" / "release" / "bin"
WINDOWS = ROOT / "build" / "windows" / "bin"
WINE = next((found for name in ("/usr/lib/wine/wine64", "wine64", "wine") if (found := shutil.which(name))), None)
SERVER = shutil.which("wineserver", path=f"/usr/lib/wine:{os.environ.get('PATH', os.defpath)}")
# A driver that needs no GPU, so that every machine gives the same verdict.
DRIVER = next(Path("/usr/share/vulkan/icd.d").glob("lvp_icd*.json"), None)
PATIENCE = 300  # seconds


@functools.cache
def display():
    """An X server for all programs: without one, Wine has no Vulkan."""
    server = Display()
    atexit.register(server.close)
    return server


@functools.cache
def environment():
    """Of programs of both systems. The folder of Wine's own files is made once and kept."""
    made = dict(os.environ, VK_ICD_FILENAMES=str(DRIVER), VK_DRIVER_FILES=str(DRIVER), LP_NUM_THREADS="0", DISPLAY=display().name,
                WINEPREFIX=str(ROOT / "build" / "windows" / "wine"), WINEDEBUG="-all", WINEDLLOVERRIDES="mscoree,mshtml=")
    if not (Path(made["WINEPREFIX"]) / "system.reg").is_file():
        subprocess.run([WINE, "wineboot", "--init"], env=made, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        subprocess.run([SERVER, "--wait"], env=made, check=True)  # then they are written
    return made


def windows(program, *arguments, **options):
    """Runs a program of Windows; text comes as bytes."""
    return subprocess.run([WINE, WINDOWS / f"{program}.exe", *map(str, arguments)], env=environment() | options.pop("env", {}),
                          capture_output=True, timeout=PATIENCE, **options)


def linux(program, *arguments, **options):
    return subprocess.run([LINUX / program, *map(str, arguments)], env=environment() | options.pop("env", {}),
                          capture_output=True, timeout=PATIENCE, **options)


@functools.cache
def shared_folder():
    folder = tempfile.TemporaryDirectory(prefix="sward-windows-")
    atexit.register(folder.cleanup)
    return Path(folder.name)


@functools.cache
def baked(name, *arguments):
    """A field, baked once by the program of Linux: its name in shared_folder()."""
    subprocess.run([LINUX / "sward", "bake", *arguments, "-o", shared_folder() / name, "-q"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return name


class Case(unittest.TestCase):
    def folder(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-windows-")
        self.addCleanup(folder.cleanup)
        return Path(folder.name)

    def check(self, done):
        self.assertEqual(done.returncode, 0, done.stderr.decode(errors="replace") + done.stdout.decode(errors="replace"))
        return done


def missing():
    """What the tests need and this machine lacks."""
    needed = {"Wine (wine64)": WINE, "lld-link (lld)": shutil.which("lld-link"), "Xvfb (xvfb)": shutil.which("Xvfb"), "xdotool": shutil.which("xdotool"), "lavapipe (mesa-vulkan-drivers)": DRIVER,
              "build/windows (scripts/build windows)": (WINDOWS / "sward.exe").is_file(),
              "build/release (scripts/build release)": (LINUX / "sward-view").is_file()}
    return [what for what, is_there in needed.items() if not is_there]


if missing():
    sys.exit(f"test-windows: missing: {', '.join(missing())}")
