"""sward-view as somebody who sits before it: finds controls by their names, and turns them."""

import json
import os
import re
import subprocess
import time
from pathlib import Path

from display import PATIENCE, wait_until

STATUS_BAR = 30  # its height at most, at a content scale of 1


def processor_seconds(pid):
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def child_of(viewer):
    """The process of its baker; nothing if there is none."""
    children = subprocess.run(["pgrep", "-P", str(viewer.process.pid), "-x", "sward"],
                              capture_output=True, text=True).stdout.split()
    return int(children[0]) if children else None


class Viewer:
    """A running viewer, under the validation layer, that tells where its controls are. It draws on
    at rest, as it does with a GPU, unless `rests`."""

    def __init__(self, program, display, folder, arguments, environment=None, validated=True,
                 rests=False, **process):
        self.display = display
        self.told = folder / f"controls-{time.monotonic_ns()}.json"
        self.errors = open(folder / f"stderr-{time.monotonic_ns()}.txt", "w+")
        self.process = subprocess.Popen(
            [program, *map(str, arguments), *(["--validation"] if validated else []), "--controls",
             self.told, *([] if rests else ["--at-rest", "move"])],
            env={**os.environ, "DISPLAY": display.name, "XDG_STATE_HOME": str(folder / "state"),
                 **(environment or {})},
            stderr=self.errors, text=True, cwd=folder, **process)
        self.window = None

    def said(self):
        """All that it has written to stderr."""
        self.errors.flush()
        with open(self.errors.name) as file:
            return file.read()

    def wait_for_window(self):
        self.wait(self.controls, "it tells of its controls")
        self.window = self.wait(lambda: self.display.find("Sward", self.process.pid), "there is a window")

    def wait_for_field(self):
        self.wait_for_window()
        self.wait(lambda: re.search("of [1-9].* blades drawn", self.shows("Status/Numbers") or ""),
                  "it tells how many blades are drawn")

    def wait_for_title(self):
        """The same where no panels are shown, and with them no status."""
        self.window = self.wait(lambda: self.display.find("Sward.*blades drawn", self.process.pid),
                                "the title tells how many blades are drawn")

    def wait(self, holds, what):
        def holds_or_ended():
            if self.process.poll() is not None:
                raise AssertionError(f"it ended with {self.process.returncode}: {self.said()}")
            return holds()
        return wait_until(holds_or_ended, what)

    def controls(self):
        try:
            return json.loads(self.told.read_text())
        except (OSError, ValueError):
            return {}

    def shows(self, name):
        """What a control shows; nothing if there is none of that name."""
        return self.controls().get(name, {}).get("shows")

    def wait_for_value(self, name, holds, what):
        return self.wait(lambda: holds(self.shows(name)) if self.shows(name) is not None else False,
                         what)

    def wait_frames(self, count):
        """Waits until the list of controls was written `count` times: at least as many frames."""
        for _ in range(count):
            before = self.told.stat().st_mtime_ns
            self.wait(lambda: self.told.stat().st_mtime_ns != before, "another frame")

    def away(self):
        """Moves the mouse to where it explains nothing, and lets the picture follow."""
        _, _, width, _ = self.window.geometry()
        self.display.xdotool("mousemove", "--window", self.window.number, width - 30, 30)
        self.wait_frames(5)

    def open_panel(self, name):
        """Opens a panel; None closes whichever is open."""
        opened = [key for key, control in self.controls().items()
                  if key.startswith("Rail/") and control["shows"] == "open"]
        wanted = f"Rail/{name}" if name else (opened[0] if opened else None)
        if wanted is None or (name and wanted in opened):
            return
        self.click(wanted)
        self.wait(lambda: (self.shows(wanted) == "open") == bool(name), f"{name} is open")

    def scroll_to(self, name):
        """Where a control is; one below the window's end is brought inside by the wheel."""
        control = self.wait(lambda: self.controls().get(name), f"there is {name}")
        _, _, _, height = self.window.geometry()
        if control["y"] + control["height"] <= height:
            return control
        while control["y"] + control["height"] > height - STATUS_BAR:
            xdotool = self.display.xdotool
            xdotool("mousemove", "--window", self.window.number, int(control["x"]), height // 2)
            xdotool("click", 5)
            self.wait_frames(4)
            before, control = control, self.controls()[name]
            if control["y"] >= before["y"]:
                break
        return control

    def centre(self, name, across=0.5):
        control = self.scroll_to(name)
        return (round(control["x"] + across * control["width"]),
                round(control["y"] + 0.5 * control["height"]))

    def click(self, name, across=0.5):
        """Clicks it, and waits until that is seen."""
        self.click_at(*self.centre(name, across))

    def click_at(self, x, y, button=1):
        # A frame that has begun, one that sees the button go down, one that sees it go up.
        self.display.xdotool("mousemove", "--window", self.window.number, x, y, "click", button)
        self.wait_frames(3)

    def press(self, control, panel):
        """Opens the panel and clicks a control in it."""
        self.open_panel(panel)
        self.click(f"{panel}/{control}")

    def set(self, control, panel, across):
        """Sets a slider to a share of its width; clicks a toggle."""
        self.open_panel(panel)
        self.click(f"{panel}/{control}", across)

    def key(self, name):
        self.window.key(name)
        self.wait_frames(2)

    def drag(self, begin, end, steps=4, button=1, held=0.0):
        number, xdotool = self.window.number, self.display.xdotool
        xdotool("mousemove", "--window", number, *begin, "mousedown", button)
        self.wait_frames(2)
        for i in range(1, steps + 1):
            xdotool("mousemove", "--window", number,
                    *(begin[k] + (end[k] - begin[k]) * i // steps for k in (0, 1)))
            self.wait_frames(1)
        time.sleep(held)
        xdotool("mouseup", button)
        self.wait_frames(2)

    def type(self, text, delay=100):
        """Types into what has the keys, slowly enough for frames that each see one letter."""
        self.display.xdotool("type", "--window", self.window.number, "--delay", delay, text)

    def type_anew(self, name, panel, text):
        """Types a text in place of the one that a control has."""
        self.press(name, panel)
        # Held for longer than a frame.
        self.display.xdotool("keydown", "ctrl", "keydown", "a")
        self.wait_frames(3)
        self.display.xdotool("keyup", "a", "keyup", "ctrl")
        self.wait_frames(2)
        self.type(text)
        self.wait_for_value(f"{panel}/{name}", lambda shown: shown == text, "it is typed")

    def escape_to_picture(self):
        """Closes all that lies over the picture, by Escape."""
        over = lambda: [name for name, control in self.controls().items()
                        if name in ("Keys/Close", "Blade/Id", "Files/Folder", "Question/Text")
                        or (name.startswith("Rail/") and control["shows"] == "open")]
        while over():
            self.key("Escape")

    def end(self):
        """Closes its window, and saves nothing; its exit code and what it said."""
        end = time.monotonic() + PATIENCE
        self.window.ask_to_close()
        while self.process.poll() is None and time.monotonic() < end:
            if "Question/Close without saving" in self.controls():
                try:
                    self.wait_frames(3)  # until the question has its place
                    self.click("Question/Close without saving")
                except AssertionError:
                    if self.process.poll() is None:
                        raise
            time.sleep(0.02)
        self.process.wait(timeout=PATIENCE)
        return self.process.returncode, self.said()

    def close(self):
        """Whatever happens, it does not outlive the test."""
        self.process.kill()
        self.process.wait()
        self.errors.close()
