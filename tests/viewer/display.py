"""An X server without a screen, and what a user does at it: look, drag, type, resize, close."""

import ctypes
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

PATIENCE = 180.0  # seconds; lavapipe on a busy machine is slow


def wait_until(holds, what):
    """Asks again and again; returns the first answer that is true."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        answer = holds()
        if answer:
            return answer
        time.sleep(0.01)
    raise AssertionError(f"waited {PATIENCE:.0f} s in vain until {what}")


class Display:
    """Xvfb, alive as long as this object is; its screen lies in a file that we can read."""

    WIDTH, HEIGHT = 1280, 800

    def __init__(self):
        needs("display")
        self.folder = Path(tempfile.mkdtemp(prefix="sward-display-"))
        self.name = wait_until(self.start, "an X server starts")

    def start(self):
        """Starts the server; returns its name, or nothing if it ended at once."""
        # It does not begin anew when its last client leaves: the next would find it busy with that.
        # A number of our own: the lowest free one is chosen by every server that starts, and a
        # server that ends takes away the socket of the next.
        number = random.randrange(100, 30000)
        read_end, write_end = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", f":{number}", "-displayfd", str(write_end), "-screen", "0",
             f"{self.WIDTH}x{self.HEIGHT}x24", "-nolisten", "tcp", "-noreset", "-fbdir",
             str(self.folder)],
            pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as answer:
            ready = answer.readline().strip()
        if not ready:
            self.server.wait()
        return ready and ":" + ready

    def close(self):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def set_resources(self, text):
        """What `xrdb -load` does: sets the resources of the server that programs read when they start."""
        x11 = ctypes.CDLL("libX11.so.6")
        x11.XOpenDisplay.restype = ctypes.c_void_p
        x11.XDefaultRootWindow.restype = ctypes.c_ulong
        connection = ctypes.c_void_p(x11.XOpenDisplay(self.name.encode()))
        root = ctypes.c_ulong(x11.XDefaultRootWindow(connection))
        resource_manager, string, replace = ctypes.c_ulong(23), ctypes.c_ulong(31), 0  # of X11/Xatom.h
        x11.XChangeProperty(connection, root, resource_manager, string, 8, replace, text.encode(),
                            len(text))
        x11.XCloseDisplay(connection)

    def xdotool(self, *arguments):
        done = subprocess.run(["xdotool", *map(str, arguments)], capture_output=True, text=True,
                              env={**os.environ, "DISPLAY": self.name})
        return done.stdout.strip() if done.returncode == 0 else ""

    def let_go(self):
        """The mouse lies in the middle of the screen, and no button or key is held."""
        self.xdotool("mousemove", self.WIDTH // 2, self.HEIGHT // 2, *("mouseup", 1, "mouseup", 2, "mouseup", 3),
                     *("keyup", "Shift_L", "keyup", "Control_L"))

    def find(self, title, process):
        """The visible window of a process whose title begins so; nothing if there is none."""
        windows = self.xdotool("search", "--all", "--onlyvisible", "--pid", process, "--name", "^" + title).split()
        return Window(self, windows[0]) if windows else None

    def picture(self, left, top, width, height):
        """The pixels that are on the screen now: rows, columns, and (blue, green, red)."""
        dump = self.folder / "Xvfb_screen0"
        # The header of an XWD file: 25 numbers, the largest byte first.
        header = np.fromfile(dump, ">u4", 25)
        header_bytes, bits_per_pixel, bytes_per_line, colors = (int(header[i]) for i in (0, 11, 12, 19))
        assert bits_per_pixel == 32, "the screen was asked to have 24 bits of colour"
        lines = np.fromfile(dump, np.uint8, height * bytes_per_line,
                            offset=header_bytes + 12 * colors + top * bytes_per_line)
        rows = lines.reshape(-1, bytes_per_line)[:, 4 * left:4 * (left + width)]
        # Signed, so that channels can be subtracted.
        return rows.reshape(len(rows), -1, 4)[..., :3].astype(np.int16)


class Window:
    """One window of a display without a window manager: at the place and size it was given."""

    def __init__(self, display, number):
        self.display = display
        self.number = number

    def title(self):
        return self.display.xdotool("getwindowname", self.number)

    def geometry(self):
        text = self.display.xdotool("getwindowgeometry", "--shell", self.number)
        values = dict(line.split("=", 1) for line in text.splitlines())
        return tuple(int(values[key]) for key in ("X", "Y", "WIDTH", "HEIGHT"))

    def picture(self):
        return self.display.picture(*self.geometry())

    def key(self, name):
        self.display.xdotool("key", "--window", self.number, name)

    def drag(self, begin, end, button=1):
        self.display.xdotool("mousemove", "--window", self.number, *begin, "mousedown", button)
        for i in range(1, 6):
            x, y = (begin[k] + (end[k] - begin[k]) * i // 5 for k in (0, 1))
            self.display.xdotool("mousemove", "--window", self.number, x, y)
            time.sleep(0.05)
        self.display.xdotool("mouseup", button)

    def wheel(self, steps):
        x, y, width, height = self.geometry()
        self.display.xdotool("mousemove", x + width // 2, y + height // 2)
        self.display.xdotool("click", "--repeat", abs(steps), 4 if steps > 0 else 5)

    def resize(self, width, height):
        self.display.xdotool("windowsize", self.number, width, height)

    def hide(self):
        self.display.xdotool("windowunmap", self.number)

    def show(self):
        self.display.xdotool("windowmap", self.number)

    def ask_to_close(self):
        """What the button of a window's frame does: the message WM_DELETE_WINDOW."""
        x11 = ctypes.CDLL("libX11.so.6")
        x11.XOpenDisplay.restype = ctypes.c_void_p
        connection = ctypes.c_void_p(x11.XOpenDisplay(self.display.name.encode()))
        atom = lambda name: x11.XInternAtom(connection, name, 0)
        # An XClientMessageEvent fills the first words of the 24 longs of an XEvent.
        event = (ctypes.c_long * 24)()
        event[0] = 33  # ClientMessage
        event[4] = int(self.number)
        event[5] = atom(b"WM_PROTOCOLS")
        event[6] = 32  # bits of each item
        event[7] = atom(b"WM_DELETE_WINDOW")
        x11.XSendEvent(connection, ctypes.c_ulong(int(self.number)), 0, ctypes.c_long(0),
                       ctypes.byref(event))
        x11.XSync(connection, 0)
        x11.XCloseDisplay(connection)


def share_that_differs(first, second, tolerance=3):
    """Share of pixels that differ by more than `tolerance` in any channel."""
    return float((abs(first - second).max(axis=2) > tolerance).mean())
