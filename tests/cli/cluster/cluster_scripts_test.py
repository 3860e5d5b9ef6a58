"""The example scripts bake on a cluster and go on where a killed tile stopped."""

import os
import re
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from cluster_test import ClusterTest, TILES
from loopback_slurm import LoopbackSlurm
from support import DONE, IO, PROGRAM, ROOT, USAGE, digest

from needs import leave_out, needs

EXAMPLES = ROOT / "examples/cluster"
# Enough to be at work for a while in each tile.
LONG = ("--density", "5", "--seed", "7", "--sky-rays", "8")

# Stands for `sward` in the scripts. While the file "hold-I" lies beside it, tile I has its stderr on a
# pipe that is full: it stops at its first word of progress, in the middle of its work, for ever.
HOLDING = """#!/usr/bin/env python3
import os, sys
arguments = [{program!r}, *sys.argv[1:]]
place = os.path.dirname(os.path.abspath(__file__))
index = sys.argv[sys.argv.index("--index") + 1] if "--index" in sys.argv else ""
if sys.argv[1] == "tile" and os.path.exists(os.path.join(place, "hold-" + index)):
    os.unlink(os.path.join(place, "hold-" + index))
    reader, writer = os.pipe()
    os.set_inheritable(reader, True)
    os.set_blocking(writer, False)
    try:
        while True:
            os.write(writer, bytes(1))
    except BlockingIOError:
        os.set_blocking(writer, True)
    os.dup2(writer, 2)
    with open(os.path.join(place, "held"), "w") as file:
        file.write(str(os.getpid()))
    arguments += ["--progress", "always"]
os.execv(arguments[0], arguments)
"""


class Scripts(ClusterTest):
    """The example scripts, with a tile killed in the middle of its work."""

    VICTIM = 2

    def run_script(self, name, *, environment, wait=True, code=DONE):
        # A folder and a file with spaces, since engineers have them.
        place = self.folder / "our county"
        place.mkdir(exist_ok=True)
        holding = self.folder / "holding-sward"
        if not holding.exists():
            holding.write_text(HOLDING.format(program=str(PROGRAM)))
            holding.chmod(0o755)
            (self.folder / f"hold-{self.VICTIM}").touch()
        command = [str(EXAMPLES / name), "our county/hills field.sward", str(TILES), self.ground, *LONG]
        running = subprocess.Popen(command, cwd=self.folder, env={**environment, "SWARD": str(holding)},
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, start_new_session=True)
        self.addCleanup(self.end, running)
        return self.finish(running, code) if wait else running

    def finish(self, running, code):
        out, _ = running.communicate(timeout=60)
        self.assertEqual(running.returncode, code, out)
        return out

    @staticmethod
    def end(running):
        if running.poll() is None:
            os.killpg(running.pid, signal.SIGKILL)
        running.communicate()

    def kill_the_victim(self):
        """SIGKILL for a tile that has begun and cannot end."""
        deadline = time.monotonic() + 60
        while (process := self.held()) is None:
            self.assertLess(time.monotonic(), deadline, "the tile never ran")
            time.sleep(0.01)
        os.kill(process, signal.SIGKILL)

    def held(self):
        """Process of the victim once it is `sward` and waits for somebody to read its progress."""
        try:
            process = int((self.folder / "held").read_text())
            state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
            return process if Path(f"/proc/{process}/exe").readlink() == PROGRAM and state == "S" else None
        except (OSError, ValueError):
            return None

    @property
    def output(self):
        return self.folder / "our county/hills field.sward"

    @property
    def work(self):
        return self.folder / "our county/hills field.sward.tiles"

    def tiles_there(self):
        return sorted(int(path.stem[5:]) for path in (self.work / "tiles").glob("tile-*.blades"))

    def require_the_victim_is_missing(self):
        self.assertFalse(self.output.exists())
        self.assertEqual(self.tiles_there(), [i for i in range(TILES) if i != self.VICTIM])

    def require_the_bytes_of_one_bake(self):
        self.assertEqual(digest(self.output), digest(self.bake(self.ground, *LONG)))


class Parallel(Scripts):
    def test_gnu_parallel_goes_on_where_a_killed_tile_stopped(self):
        needs("parallel")
        how = {"environment": {**os.environ, "JOBS": "2"}}
        running = self.run_script("bake-parallel.sh", wait=False, **how)
        self.kill_the_victim()
        self.assertIn(f"missing ({self.VICTIM})", self.finish(running, IO))
        self.require_the_victim_is_missing()
        jobs = self.jobs()
        self.assertEqual(sorted(jobs), [(i, 9 if i == self.VICTIM else 0) for i in range(TILES)])

        self.run_script("bake-parallel.sh", **how)
        self.assertEqual(self.jobs()[len(jobs):], [(self.VICTIM, 0)])
        self.require_the_bytes_of_one_bake()
        # A third time there is nothing left to do; another bake in its folder is refused.
        self.assertIn("there already", self.run_script("bake-parallel.sh", **how))
        self.output.unlink()
        self.write_json("plane.json", {"kind": "plane"})
        self.ground = "plane.json"
        self.assertIn("another bake", self.run_script("bake-parallel.sh", code=USAGE, **how))

    def jobs(self):
        """(tile, signal) of each job that GNU parallel has run."""
        rows = (self.work / "jobs.log").read_text().splitlines()
        rows = [row.split("\t") for row in rows if not row.startswith("Seq")]
        return [(int(re.search(r"--index (\d+)", row[8])[1]), int(row[7])) for row in rows]


class LongSlurm(Scripts):
    """On a cluster of daemons of its own, which takes a while to start and to end."""

    def test_a_slurm_array_goes_on_where_a_killed_task_stopped(self):
        needs("slurm")
        try:
            slurm = LoopbackSlurm()
        except RuntimeError as failure:
            leave_out("slurm", str(failure))
        self.addCleanup(slurm.close)
        try:
            self.bake_with(slurm)
        except AssertionError as failure:
            raise AssertionError(f"{failure}\n{self.job_logs()}\n{slurm.logs()}") from failure
        slurm.close()
        self.assertEqual(slurm.processes(), [])

    def bake_with(self, slurm):
        how = {"environment": slurm.environment}
        self.run_script("bake-slurm.sh", **how)
        self.assertIn("in the queue", self.run_script("bake-slurm.sh", code=USAGE, **how))
        self.kill_the_victim()
        self.wait_until_the_queue_is_empty(slurm)
        self.require_the_victim_is_missing()
        self.assertIn(f"missing ({self.VICTIM})", (self.work / "logs/merge.log").read_text())

        before = {path.name: path.stat().st_mtime_ns for path in (self.work / "tiles").iterdir()}
        out = self.run_script("bake-slurm.sh", **how)
        self.assertIn(f"tiles {self.VICTIM},", out)
        self.wait_until_the_queue_is_empty(slurm)
        self.require_the_bytes_of_one_bake()
        for path in (self.work / "tiles").glob("tile-*.blades"):
            self.assertEqual(before.get(path.name, path.stat().st_mtime_ns), path.stat().st_mtime_ns)
        self.assertIn("there already", self.run_script("bake-slurm.sh", **how))

    def wait_until_the_queue_is_empty(self, slurm):
        deadline = time.monotonic() + 60
        while queue := slurm.ask("squeue", "--noheader"):
            self.assertLess(time.monotonic(), deadline, f"jobs wait for ever:\n{queue}")
            time.sleep(0.1)

    def job_logs(self):
        return "\n".join(f"--- {path.name}\n{path.read_text()}"
                         for path in sorted((self.work / "logs").glob("*.log")))


class Examples(unittest.TestCase):
    def test_scripts_are_short_and_parse(self):
        for script in sorted(EXAMPLES.glob("*.sh")):
            self.assertLessEqual(len(script.read_text().splitlines()), 60, script)
            subprocess.run(["bash", "-n", str(script)], check=True)
            self.assertTrue(os.access(script, os.X_OK), script)


if __name__ == "__main__":
    unittest.main()
