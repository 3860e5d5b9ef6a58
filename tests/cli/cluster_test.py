"""A bake dealt out to tiles gives the bytes of one bake, whatever happens to the tiles on the way."""

import os
import re
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from loopback_slurm import LoopbackSlurm, search_path
from output_test import small_files_only
from support import CliTest, DONE, INPUT, INTERRUPTED, IO, PROGRAM, ROOT, USAGE, digest

EXAMPLES = ROOT / "examples/cluster"
# Hills over 6 x 5 cells of 32 m, so that every tile has cells and neighbours.
HILLS = {"kind": "hills", "extent": [192, 160], "cells": [96, 80], "seed": 3, "height": 6, "width": 40,
         "octaves": 3}
TILES = 6
OPTIONS = ("--density", "1", "--seed", "7", "--clearance", "0.3", "--exposure", "2")
# Enough to be at work for a second or so in each tile.
LONG = ("--density", "5", "--seed", "7", "--exposure", "8")
# [s] of CPU time after which a tile is in the middle of its work.
WORKING = 0.1


class ClusterTest(CliTest):
    def setUp(self):
        super().setUp()
        self.ground = self.write_json("hills.json", HILLS).name

    def plan(self, *options, tiles=TILES, to="plan.json", **how):
        self.sward("plan", self.ground, "--tiles", tiles, "-o", to, "-q", *options, **how)

    def tile(self, index, *options, plan="plan.json", to="tiles", **how):
        return self.sward("tile", plan, "--index", index, "-o", to, *options, **how)

    def merge(self, plan="plan.json", tiles="tiles", to="merged.sward"):
        self.sward("merge", plan, tiles, "-o", to, "-q")
        return self.folder / to

    def tile_file(self, index, folder="tiles"):
        return self.folder / folder / f"tile-{index:06}.blades"


class Tiles(ClusterTest):
    def test_any_order_and_any_threads_give_the_bytes_of_one_bake(self):
        whole = digest(self.bake(self.ground, *OPTIONS))
        self.plan(*OPTIONS)
        for folder, order, threads in (("a", range(TILES), 1), ("b", (4, 1, 5, 0, 3, 2), 3)):
            for index in order:
                self.tile(index, "--threads", threads, to=folder)
            self.assertEqual(digest(self.merge(tiles=folder, to=f"{folder}.sward")), whole)
        for index in range(TILES):
            self.assertEqual(digest(self.tile_file(index, "a")), digest(self.tile_file(index, "b")))

    def test_any_number_of_tiles_does_too(self):
        # 200 are more than there are cells: some tiles are empty.
        whole = digest(self.bake("hills", "--density", "10"))
        for tiles in (1, 3, 200):
            self.sward("plan", "hills", "--density", "10", "--tiles", tiles, "-o", f"{tiles}.json")
            for index in range(tiles):
                self.tile(index, plan=f"{tiles}.json", to=f"of-{tiles}")
            merged = self.merge(plan=f"{tiles}.json", tiles=f"of-{tiles}", to=f"{tiles}.sward")
            self.assertEqual(digest(merged), whole, tiles)

    def test_an_exact_count_is_exact_over_tiles(self):
        for spread in ("uniform", "poisson"):
            with self.subTest(spread=spread):
                options = ("--count", "10007", "--sampling", spread, "--slope", "0:30~10")
                whole = self.bake(self.ground, *options, to=f"{spread}.sward")
                self.assertEqual(self.info(whole)["blades"], 10007)
                self.plan(*options, to=f"{spread}.json")
                for index in range(TILES):
                    self.tile(index, plan=f"{spread}.json", to=f"{spread}-tiles")
                merged = self.merge(f"{spread}.json", f"{spread}-tiles", f"{spread}-merged.sward")
                self.assertEqual(digest(merged), digest(whole))

    def test_a_tile_baked_twice_says_so_and_keeps_its_bytes(self):
        self.plan(*OPTIONS)
        self.tile(2)
        file = self.tile_file(2)
        before = (digest(file), file.stat().st_mtime_ns, file.stat().st_ino)
        self.assertIn("there already", self.tile(2).stdout)
        self.assertEqual((digest(file), file.stat().st_mtime_ns, file.stat().st_ino), before)
        self.assertNotIn("there already", self.tile(2, "--force").stdout)
        self.assertEqual(digest(file), before[0])
        self.assertNotEqual(file.stat().st_ino, before[2])

    def test_missing_and_damaged_tiles_are_named_as_an_array(self):
        self.plan(*OPTIONS)
        self.merge_fails(IO, "0-5", missing="0-5")
        for index in range(TILES):
            self.tile(index)
        whole = digest(self.merge(to="whole.sward"))
        for index in (0, 3, 4):
            self.tile_file(index).unlink()
        self.merge_fails(IO, "0,3-4", missing="0,3-4")
        # Cut short, one bit changed, empty: each is found, beside those that are missing.
        content = self.tile_file(1).read_bytes()
        for damage in (content[:-9], content[:5000] + bytes([content[5000] ^ 1]) + content[5001:], b""):
            self.tile_file(1).write_bytes(damage)
            self.merge_fails(INPUT, "0-1,3-4", missing="0,3-4", damaged="1")
        # Asked again, tiles replace what is damaged, and leave the others alone.
        for index in (0, 1, 3, 4):
            self.assertNotIn("there already", self.tile(index).stdout)
        self.assertIn("there already", self.tile(2).stdout)
        self.assertEqual(digest(self.merge()), whole)
        self.tile_file(5).write_bytes(b"x")
        self.merge_fails(INPUT, "5", damaged="5")

    def merge_fails(self, code, again, missing="none", damaged="none"):
        self.refused("merge", "plan.json", "tiles", "-o", "out.sward", code=code,
                     names=[f"missing ({missing})", f"damaged ({damaged})", f"bake again: {again}\n"])

    def test_a_tile_of_another_plan_is_refused(self):
        self.plan(*OPTIONS)
        self.plan(*OPTIONS, "--align", "vertical", to="other.json")
        for index in range(TILES):
            self.tile(index)
            self.tile(index, plan="other.json", to="others")
        shutil.copy(self.tile_file(3, "others"), self.tile_file(3))
        done = self.refused("merge", "plan.json", "tiles", "-o", "out.sward", code=INPUT,
                            names=["damaged (3)", "belongs to plan"])
        self.assertIn(self.tile_file(3).name, done.stderr)
        # Nor is the work of another plan replaced unasked.
        before = digest(self.tile_file(3))
        self.refused("tile", "plan.json", "--index", "3", "-o", "tiles", code=INPUT,
                     names=[self.tile_file(3).name, "--force"])
        self.assertEqual(digest(self.tile_file(3)), before)
        self.tile(3, "--force")
        self.assertEqual(digest(self.merge()), digest(self.bake(self.ground, *OPTIONS)))

    def test_a_part_of_another_plan_is_refused(self):
        self.plan(*OPTIONS)
        self.plan(*OPTIONS, "--align", "vertical", to="other.json")
        shutil.copy(self.folder / "other.parts/part-000003.ground",
                    self.folder / "plan.parts/part-000003.ground")
        self.refused("tile", "plan.json", "--index", "3", "-o", "tiles", code=INPUT, leaves=["tiles"],
                     names=["part-000003.ground", "belongs to plan"])
        (self.folder / "plan.parts/part-000003.ground").unlink()
        self.refused("tile", "plan.json", "--index", "3", "-o", "tiles", code=IO,
                     names=["part-000003.ground"])

    def test_an_index_that_the_plan_does_not_have_is_wrong_usage(self):
        self.plan(*OPTIONS)
        for index in (TILES, 4294967295, 4294967296, -1, "x", ""):
            self.refused("tile", "plan.json", f"--index={index}", "-o", "tiles", code=USAGE,
                         names=["--index"])
        self.refused("tile", "plan.json", "-o", "tiles", code=USAGE, names=["--index"])
        self.refused("plan", self.ground, "--tiles", "0", "-o", "p.json", code=USAGE, names=["--tiles"])

    def test_a_plan_that_is_not_one_is_refused(self):
        for text, code in (("{}", INPUT), ("no", INPUT), ('{"format": "sward plan 9"}', 5)):
            (self.folder / "bad.json").write_text(text)
            for command in (("tile", "bad.json", "--index", "0", "-o", "tiles"),
                            ("merge", "bad.json", "tiles", "-o", "out.sward")):
                self.refused(*command, code=code, names=["bad.json"])
        self.refused("tile", "none.json", "--index", "0", "-o", "t", code=IO, names=["none.json"])

    def test_a_tile_needs_no_more_memory_in_a_larger_world(self):
        # Tiles of 128 m in worlds of 0.13 and 0.52 million triangles; half of those are 20 MB.
        peaks = {}
        for side in (512, 1024):
            self.ground = self.write_json(f"{side}.json", {**HILLS, "extent": [side, side],
                                                           "cells": [side // 2, side // 2]}).name
            self.plan("--density", "0.5", tiles=side * side // 16384, to=f"{side}-plan.json")
            peaks[side] = max(self.peak("tile", f"{side}-plan.json", "--index", index, "-o", str(side),
                                        "--threads", "1") for index in (5, 9))
        self.assertLess(peaks[1024], 1.1 * peaks[512] + 2e6)

    def peak(self, *arguments):
        """Most memory that a run held [bytes]."""
        process = subprocess.Popen([str(PROGRAM), *map(str, arguments)], cwd=self.folder,
                                   stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, DONE)
        return usage.ru_maxrss * 1024

    def test_an_interrupted_tile_leaves_no_half(self):
        self.plan("--density", "3000", "--exposure", "64", tiles=2)
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number.name):
                running = subprocess.Popen(
                    [str(PROGRAM), "tile", "plan.json", "--index", "0", "-o", "tiles", "--progress",
                     "always"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                self.assertTrue(os.read(running.stderr.fileno(), 1))
                running.send_signal(number)
                out, err = running.communicate(timeout=60)
                self.assertEqual((running.returncode, out), (INTERRUPTED, b""), err)
                self.assertEqual(list((self.folder / "tiles").iterdir()), [])

    def test_a_full_disk_leaves_nothing_half_written(self):
        self.plan(*OPTIONS)
        done = self.tile(0, code=IO, before=small_files_only)
        self.assertIn("tile-000000.blades", done.stderr)
        self.assertEqual(list((self.folder / "tiles").iterdir()), [])
        for index in range(TILES):
            self.tile(index)
        whole = self.files()
        self.sward("merge", "plan.json", "tiles", "-o", "f.sward", code=IO, before=small_files_only)
        self.assertEqual(self.files(), whole)
        # A plan that is not finished is not there; what lies in its parts is whole.
        self.plan(*OPTIONS, to="full.json", code=IO, before=small_files_only)
        self.assertFalse({name for name in self.files() - whole if not name.startswith("full.parts")})
        self.assertFalse([name for name in self.files() if "/." in name])


def cpu_seconds(process):
    """CPU time of a process [s]; 0 when it has ended."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def tile_at_work(folder, index):
    """Process of `sward tile` for this tile of a plan in `folder` once it is at work, or None."""
    for path in Path("/proc").glob("[0-9]*"):
        try:
            words = (path / "cmdline").read_bytes().decode(errors="replace").split("\0")
            program = (path / "exe").readlink()
        except OSError:
            continue
        if program == PROGRAM and words[1] == "tile" and str(folder) in words[2] and \
                words[words.index("--index") + 1] == str(index) and cpu_seconds(path.name) > WORKING:
            return int(path.name)
    return None


class Scripts(ClusterTest):
    """The example scripts, with a tile killed in the middle of its work."""

    VICTIM = 2

    def run_script(self, name, *, environment, wait=True, code=DONE):
        # A folder and a file with spaces, since engineers have them.
        place = self.folder / "our county"
        place.mkdir(exist_ok=True)
        command = [str(EXAMPLES / name), "our county/hills field.sward", str(TILES), self.ground, *LONG]
        running = subprocess.Popen(command, cwd=self.folder, env={**environment, "SWARD": str(PROGRAM)},
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

    def kill_the_victim(self, running=None):
        """SIGKILL for a tile that has begun and not ended."""
        deadline = time.monotonic() + 40
        while (process := tile_at_work(self.folder, self.VICTIM)) is None:
            self.assertLess(time.monotonic(), deadline, "the tile never ran")
            time.sleep(0.005)
        os.kill(process, signal.SIGKILL)

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
        if shutil.which("parallel") is None:
            self.fail("GNU parallel is not installed; scripts/install-dependencies installs it")
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


class Slurm(Scripts):
    def test_a_slurm_array_goes_on_where_a_killed_task_stopped(self):
        slurm = LoopbackSlurm()
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
