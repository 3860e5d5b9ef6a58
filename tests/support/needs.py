#!/usr/bin/python3
"""What some tests need beside the programs, a compiler and Python with NumPy. A test begins with, for example,

    needs("open3d", "parallel")

and is left out, with the reason, on a machine that lacks one of them. Where CI is true in the environment such a
test fails instead, unless the distribution has no such package or only `install-dependencies --dev` installs it.
scripts/test --complete sets CI. What a GoogleTest skips is told with it, and fails there too.

  tests/support/needs.py              what this machine lacks: a line "Left out: …" for each need that leaves tests out
  tests/support/needs.py LastTest.log the tests that a run of ctest has left out, by reason
"""

import importlib.util
import os
import platform
import re
import shutil
import sys
import unittest
from pathlib import Path
from typing import Callable, NamedTuple

# Packages that a distribution does not have at all, by ID and VERSION_ID of /etc/os-release.
ABSENT = {("ubuntu", "24.04"): {"python3-open3d"}}

# A suite of which ctest prints that it was skipped: Python's closing line where some tests were left out and all others
# have passed. The last lines of a run name these tests.
SKIPPED = r"OK \(skipped="


class Need(NamedTuple):
    what: str
    packages: tuple  # that bring it
    here: Callable[[], bool]
    option: str = "--test"  # of scripts/install-dependencies


def module(name):
    return lambda: importlib.util.find_spec(name) is not None


def programs(*names):
    # Daemons lie where a user's PATH does not look.
    path = os.environ.get("PATH", os.defpath) + ":/usr/sbin:/usr/local/sbin"
    return lambda: all(shutil.which(name, path=path) for name in names)


NEEDS = {
    "open3d": Need("Open3D", ("python3-open3d",), module("open3d")),
    "skimage": Need("scikit-image", ("python3-skimage",), module("skimage")),
    "pillow": Need("Pillow", ("python3-skimage",), module("PIL")),  # scikit-image depends on it
    "gdal": Need("GDAL with its Python", ("libgdal-dev", "python3-gdal"), module("osgeo")),
    # What the Python module is built with, before the tests.
    "pybind11": Need("pybind11 and Python's headers", ("pybind11-dev", "python3-dev"),
                     lambda: Path("/usr/include/pybind11/pybind11.h").exists()),
    "parallel": Need("GNU parallel", ("parallel",), programs("parallel")),
    "slurm": Need("Slurm", ("munge", "slurmctld", "slurmd", "slurm-client"), programs("munged", "slurmctld", "slurmd", "sbatch")),
    # The packages themselves are fetched by the first test that uses one (tests/cli/export/node_readers.py).
    "npm packages": Need("gltf-validator, three.js and TinyUSDZ from npm", ("nodejs", "npm"), programs("node")),
    "node": Need("Node.js", ("nodejs",), programs("node")),
    "chromium": Need("Chromium", ("chromium",), programs("chromium"), "--dev"),
    "clang wasm32": Need("clang for WebAssembly", ("clang-19", "lld-19", "wasi-libc", "libc++-19-dev-wasm32",
                         "libc++abi-19-dev-wasm32", "libclang-rt-19-dev-wasm32"),
                         lambda: programs("clang++-19", "wasm-ld-19")() and Path("/usr/include/wasm32-wasi").is_dir(), "--dev"),
    "display": Need("Xvfb and xdotool", ("xvfb", "xdotool"), programs("Xvfb", "xdotool")),
    "groff": Need("groff", ("groff-base",), programs("groff")),
    "blender": Need("Blender", ("blender",), programs("blender"), "--dev"),
}


def absent_packages():
    try:
        system = platform.freedesktop_os_release()
    except OSError:
        return set()
    return ABSENT.get((system.get("ID"), system.get("VERSION_ID")), set())


def reason_without(name):
    """Why tests with a need are left out here; None if they are not."""
    need = NEEDS[name]
    if need.here():
        return None
    if absent := sorted(absent_packages().intersection(need.packages)):
        return f"this distribution has no package {', '.join(absent)}"
    return f"install {' '.join(need.packages)} (scripts/install-dependencies {need.option})"


def demanded():
    """Whether nothing may be left out."""
    return os.environ.get("CI", "").lower() not in ("", "0", "false")


def needs(*names):
    """Leaves the test out, or fails it, if the machine lacks something."""
    for name in names:
        if reason := reason_without(name):
            leave_out(name, reason)


def leave_out(name, reason):
    """The same for what shows only when it is used: a server that cannot be reached, a daemon that does not start."""
    need = NEEDS[name]
    text = f"needs {need.what}: {reason}"
    if demanded() and need.option == "--test" and not absent_packages().intersection(need.packages):
        raise AssertionError(f"{text}\nCI is set: there no test is left out")
    print(f"\nleft out{running()}: {text.splitlines()[0]}", file=sys.stderr)
    raise unittest.SkipTest(text)


def running():
    """The test of whose call this is, in parentheses; nothing in what prepares a whole class."""
    frame = sys._getframe()
    while frame:
        test = frame.f_locals.get("self")
        if isinstance(test, unittest.TestCase):
            return f" ({test.id().removeprefix('__main__.')})"
        frame = frame.f_back
    return ""


def left_out_in(log):
    """Names of tests by reason, from ctest's LastTest.log: those of needs(), and those of GTEST_SKIP()."""
    found, suite, test, skips = ({}, {}), "", "", False
    for line in log.splitlines():
        if begin := re.match(r"\d+/\d+ Test: (.+)", line):
            suite = test = begin[1]
        elif begin := re.match(r"\[ RUN      \] (.+)", line):
            test = begin[1]
        elif reason := re.match(r"left out(?: \((.+?)\))?: (.+)", line):
            found[0].setdefault(reason[2], []).append(f"{suite} {reason[1]}" if reason[1] else suite)
        elif skips:
            found[1].setdefault(line.strip() or "no reason given", []).append(test)
        skips = re.search(r"\.cpp:\d+: Skipped$", line) is not None
    return found


def main(arguments):
    """Returns the exit code."""
    if not arguments:
        for name, need in NEEDS.items():
            if reason := reason_without(name):
                print(f"Left out: tests that need {need.what}: {reason}")
        return 0
    found = left_out_in(Path(arguments[0]).read_text(encoding="utf-8", errors="replace"))
    for reasons in found:
        for reason, tests in reasons.items():
            print(f"Left out: {', '.join(dict.fromkeys(tests))}: {reason}")
    return int(bool(found[1]) and demanded())


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
