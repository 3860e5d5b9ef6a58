"""Programs of others that read the exports and come from npm: Khronos' gltf-validator, three.js, and
TinyUSDZ (Debian has no USD). They are fetched once into the build folder, in the versions and with the hashes
of node_readers/package-lock.json. Without a network and without an earlier run their tests are left out (see
tests/support/needs.py); whatever else npm complains about is a failure."""

import fcntl
import json
import os
import re
import shutil
import subprocess
import time
from pathlib import Path

import numpy

from support import ROOT

from needs import leave_out, needs

RECIPE = ROOT / "tests/cli/node_readers"
FOLDER = Path(os.environ.get("SWARD_NODE_FOLDER", ROOT / "build/node")).resolve()

# The validator does not know EXT_mesh_gpu_instancing, and so believes what that uses to be unused.
EXPECTED = {"UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"}

# What npm says where no registry can be reached, or the one that can be does not have the packages.
UNREACHABLE = re.compile(r"\b(ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ENETUNREACH|EHOSTUNREACH|ERR_SOCKET_TIMEOUT|"
                         r"E40[1347]|E5\d\d)\b")
FORGOTTEN = 600.0  # [s] after which an unreachable registry is tried again


def modules():
    """The folder of the programs; installs them if this is the first test that asks."""
    return installed(RECIPE, "")


def installed(recipe, name):
    """The folder of the packages that package.json in `recipe` names, in a folder of this name below FOLDER; installs
    them if this is the first test that asks."""
    needs("npm packages")
    folder = FOLDER / name
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        wanted = (recipe / "package-lock.json").read_bytes()
        done, unreachable = folder / "installed-lock.json", folder / "unreachable"
        if not done.is_file() or done.read_bytes() != wanted:
            # One test waits for the network in vain, and not each.
            if unreachable.is_file() and time.time() - unreachable.stat().st_mtime < FORGOTTEN:
                leave_out("npm packages", unreachable.read_text(encoding="utf-8"))
            if reason := install(recipe, folder):
                unreachable.write_text(reason, encoding="utf-8")
                leave_out("npm packages", reason)
            done.write_bytes(wanted)
    return folder / "node_modules"


def install(recipe, folder):
    """Fetches them; if that cannot be done here, returns why."""
    for name in ("package.json", "package-lock.json"):
        shutil.copy(recipe / name, folder / name)
    # Without a network this must end in seconds, not in npm's usual minutes.
    command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1",
               "--fetch-retry-mintimeout=1000", "--fetch-retry-maxtimeout=2000",
               "--fetch-timeout=30000", f"--cache={FOLDER / 'cache'}"]
    where = f"into {folder}; SWARD_NODE_FOLDER may name a folder that has them"
    try:
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=100)
    except FileNotFoundError:
        return f"there is no npm to fetch them {where}"
    except subprocess.TimeoutExpired:
        return f"npm could not fetch them in 100 s {where}"
    if done.returncode == 0:
        return None
    said = done.stdout + done.stderr
    if found := UNREACHABLE.search(said):
        return f"npm cannot fetch them ({found[1]}) {where}\n{said}"
    raise AssertionError(f"npm {done.returncode}: {said}")


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


def three_load_time(path):
    """Time in which three.js parses a .glb in memory [s]: decoding, and matrices of instances."""
    done = subprocess.run(["node", str(RECIPE / "read_instances.mjs"), str(modules()), str(path)],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=True)
    return float(done.stderr.split()[-2]) / 1000.0


def unpacked(path):
    """A compact .glb without compression, decoded by meshoptimizer's decoder for JavaScript [bytes]. Fails if
    the file breaks a rule of the extension."""
    done = subprocess.run(["node", str(RECIPE / "unpack_meshopt.mjs"), str(modules()), str(path)],
                          capture_output=True)
    if done.returncode:
        raise AssertionError(done.stderr.decode())
    return done.stdout


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
