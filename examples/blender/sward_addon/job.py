"""Programs that run one after the other while Blender goes on. Nothing here knows Blender."""

import os
import re
import shutil
import subprocess

PROGRESS = re.compile(r"(\w[\w ]*?)\s+\[[# ]*\]\s+(\d+) %")
TAIL = 4096  # bytes of a log that are looked at


class Job:
    """Runs commands in order; the first that fails ends it. Looks at them only in poll()."""

    def __init__(self, folder, commands):
        self.folder = folder
        self.commands = list(commands)
        self.step = ""  # what is being done, with its share
        self.error = ""  # why it failed
        self.warnings = []
        self.process = None
        self.log = os.path.join(folder, "log.txt")
        self.next()

    def next(self):
        command = self.commands.pop(0)
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                                            cwd=self.folder)

    def poll(self):
        """RUNNING, DONE or FAILED. Never waits."""
        code = self.process.poll()
        if code is None:
            with open(self.log, "rb") as log:
                log.seek(max(0, os.path.getsize(self.log) - TAIL))
                found = PROGRESS.findall(log.read().decode("utf-8", "replace"))
            if found:
                self.step = "{} {} %".format(*found[-1])
            return "RUNNING"
        lines = self.lines()
        self.warnings += [line[len("warning: "):] for line in lines if line.startswith("warning: ")]
        if code != 0:
            said = [line[len("error: "):] for line in lines if line.startswith("error: ")]
            self.error = " ".join(said) or " ".join(lines[-3:]) or f"sward ended with {code} and said nothing"
            return "FAILED"
        if not self.commands:
            return "DONE"
        try:
            self.next()
        except OSError as error:
            self.error = str(error)
            return "FAILED"
        return "RUNNING"

    def lines(self):
        """What the program has said, without its progress bars."""
        with open(self.log, "rb") as log:
            text = log.read().decode("utf-8", "replace").replace("\x1b[K", "").replace("\r", "\n")
        return [line.strip() for line in text.splitlines() if line.strip() and not PROGRESS.search(line)]

    def stop(self):
        """Ends the program that runs and removes the folder."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
