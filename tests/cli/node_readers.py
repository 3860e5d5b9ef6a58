"""Programs of others that read the exports and come from npm: Khronos' gltf-validator, three.js, and
TinyUSDZ (Debian 12 has no USD). Fetched once into the build folder, in the versions and with the hashes that
stand in node_readers/package-lock.json; without network and without a former run the tests fail,
because a check that skips itself is none."""

import fcntl
import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy

from support import ROOT

RECIPE = ROOT / "tests/cli/node_readers"
FOLDER = Path(os.environ.get("SWARD_NODE_FOLDER", ROOT / "build/node")).resolve()

# The validator does not know EXT_mesh_gpu_instancing, and so believes what that uses to be unused.
EXPECTED = {"UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"}


def modules():
    """The folder of the programs; installs them if this is the first test that asks."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    with open(FOLDER / "lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        wanted = (RECIPE / "package-lock.json").read_bytes()
        done = FOLDER / "installed-lock.json"
        if not done.is_file() or done.read_bytes() != wanted:
            install()
            done.write_bytes(wanted)
    return FOLDER / "node_modules"


def install():
    for name in ("package.json", "package-lock.json"):
        shutil.copy(RECIPE / name, FOLDER / name)
    # Without a network this must fail in seconds, not in npm's usual minutes.
    command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1",
               "--fetch-retry-mintimeout=1000", "--fetch-retry-maxtimeout=2000",
               "--fetch-timeout=30000", f"--cache={FOLDER / 'cache'}"]
    try:
        done = subprocess.run(command, cwd=FOLDER, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=100)
        reason = done.stdout + done.stderr if done.returncode else ""
    except (OSError, subprocess.TimeoutExpired) as error:
        reason = str(error)
    if reason:
        raise AssertionError(
            f"gltf-validator, three.js and TinyUSDZ are not in {FOLDER}, and npm cannot fetch them: the "
            "first run in a build folder needs the network (or SWARD_NODE_FOLDER, naming a folder where "
            f"they have been installed before).\n{reason}")


def gltf_issues(path):
    """Everything that Khronos' validator finds in a file: numErrors, numWarnings, …, messages."""
    done = subprocess.run(["node", str(RECIPE / "validate_gltf.js"), str(modules()), str(path)],
                          capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)
    return json.loads(done.stdout)


def three_instances(path):
    """What three.js shows of a .glb: a row of id and matrix, column by column, for each instance."""
    done = subprocess.run(["node", str(RECIPE / "read_instances.mjs"), str(modules()), str(path)],
                          capture_output=True)
    if done.returncode:
        raise AssertionError(done.stderr.decode())
    return numpy.frombuffer(done.stdout, "<f8").reshape(-1, 17)


def usd_text(path):
    """A layer as TinyUSDZ writes it again, and the number of meshes that it draws; None if it refuses
    the file."""
    done = subprocess.run(["node", str(RECIPE / "read_usd.mjs"), str(modules()), str(path)],
                          capture_output=True, text=True)
    if "TinyUSDZ refuses" in done.stderr:
        return None
    if done.returncode:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-2000:])
    return done.stdout, int(done.stderr.split()[-2])
