"""Khronos' gltf-validator, from npm. Fetched once into the build folder, with the version and the
hash that stand in gltf_validator/package-lock.json; without network and without a former run the
test fails, because a check that skips itself is none."""

import fcntl
import json
import os
import shutil
import subprocess
from pathlib import Path

from support import ROOT

RECIPE = ROOT / "tests/cli/gltf_validator"
FOLDER = Path(os.environ.get("SWARD_NODE_FOLDER", ROOT / "build/node")).resolve()

# It does not know EXT_mesh_gpu_instancing, and so believes what that uses to be unused.
EXPECTED = {"UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"}


def installed():
    """The validator's folder; installs it if this is the first test that asks."""
    module = FOLDER / "node_modules/gltf-validator"
    FOLDER.mkdir(parents=True, exist_ok=True)
    with open(FOLDER / "lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if (module / "package.json").is_file():
            return module
        for name in ("package.json", "package-lock.json"):
            shutil.copy(RECIPE / name, FOLDER / name)
        # Without a network this must fail in seconds, not in npm's usual minutes.
        command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund",
                   "--fetch-retries=1", "--fetch-retry-maxtimeout=2000", "--fetch-timeout=30000",
                   "--fetch-retry-mintimeout=1000", f"--cache={FOLDER / 'cache'}"]
        try:
            done = subprocess.run(command, cwd=FOLDER, stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, timeout=90)
            reason = done.stdout + done.stderr if done.returncode else ""
        except (OSError, subprocess.TimeoutExpired) as error:
            reason = str(error)
        if reason:
            raise AssertionError(
                f"gltf-validator is not in {FOLDER}, and npm cannot fetch it: the first run in a build "
                "folder needs the network (or SWARD_NODE_FOLDER, naming a folder where `npm ci` has run "
                f"with {RECIPE.relative_to(ROOT)}/package.json).\n{reason}")
    return module


def issues(path):
    """Everything it finds in a file: numErrors, numWarnings, …, messages."""
    done = subprocess.run(["node", str(RECIPE / "validate.js"), str(installed()), str(path)],
                          capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)
    return json.loads(done.stdout)
