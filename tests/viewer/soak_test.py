"""Random clicks, drags and keys, the same in every run: the window outlives them and its memory
does not grow. SWARD_SOAK_SECONDS says for how long; 600 unless it is set."""

import os
import random
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window_case import WindowCase  # noqa: E402

SECONDS = float(os.environ.get("SWARD_SOAK_SECONDS", "600"))
WIDTH, HEIGHT = 640, 420
ROUNDS = 3  # of the same actions
GROWTH = 0.01  # of the memory, from the first rounds to the last
# What the driver has for a picture comes and goes in pieces of this size [bytes]. Malloc is to give
# them back: else the memory grows once, whenever two pictures happen to have theirs together.
PIECE = 65536
KEYS = ["f", "Home", "space", "period", "h", "Tab", "g", "c", "1", "2", "3", "4", "ctrl+9", "9"]
STEPS = ["Field", "Physics", "Wind", "Culling", "Colliders", "Look", "Camera", "Profile"]


class LongSoakTest(WindowCase):
    SIZE = (WIDTH, HEIGHT)

    def test_random_input_leaves_it_alive_and_as_large_as_before(self):
        viewer = self.open(self.field("hills", 1000), self.field("plane", 1000), "--resolution", "auto",
                           environment={"MALLOC_MMAP_THRESHOLD_": str(PIECE)})

        # What is made once, as pipelines are, is made in the first two rounds. One is not enough:
        # which frames two actions share depends on time, so that a round can miss its own peak.
        end = time.monotonic() + SECONDS / ROUNDS
        count = 0
        largest = []
        for number in range(ROUNDS):
            chance = random.Random(6)
            sizes = []
            while len(sizes) < count if number else time.monotonic() < end:
                self.act(viewer, chance)
                self.assertIsNone(viewer.process.poll(), viewer.said())
                sizes.append(self.bytes_of(viewer))
            count = len(sizes)
            largest.append(max(sizes))
        self.assertLess(largest[-1], max(largest[:-1]) * (1 + GROWTH),
                        f"largest size of each round [kB]: {largest}")
        viewer.process.terminate()
        viewer.process.wait(60)
        said = viewer.said()
        self.assertEqual(viewer.process.returncode, 130, said)
        self.assertNotIn("validation", said)

    def act(self, viewer, chance):
        xdotool, window = viewer.display.xdotool, viewer.window
        kind = chance.randrange(6)
        if kind == 0:
            window.key(chance.choice(KEYS))
        elif kind == 1:
            window.wheel(chance.choice([-2, -1, 1, 2]))
        elif kind == 2:
            control = viewer.controls().get("Rail/" + chance.choice(STEPS))
            if control:
                xdotool("mousemove", "--window", window.number, int(control["x"]) + 20,
                        int(control["y"]) + 10, "click", 1)
        else:
            # Not over the panels' texts: a file's name could be typed there.
            begin = (chance.randrange(100, WIDTH), chance.randrange(HEIGHT - 40))
            finish = (chance.randrange(100, WIDTH), chance.randrange(HEIGHT - 40))
            window.drag(begin, finish, button=chance.choice([1, 1, 2, 3]))

    def bytes_of(self, viewer):
        """Memory that is its own: what the driver maps of files does not count."""
        text = Path(f"/proc/{viewer.process.pid}/status").read_text()
        return next(int(line.split()[1]) for line in text.splitlines()
                    if line.startswith("RssAnon"))


if __name__ == "__main__":
    unittest.main()
