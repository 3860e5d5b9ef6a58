"""Opens a page of a folder in Chromium without a window."""

import json
import os
import re
import signal
import subprocess

from file_server import FolderServer

SWITCHES = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
            "--ignore-gpu-blocklist", "--disable-background-networking", "--no-first-run", "--enable-logging=stderr"]


# Chromium's own words where it has WebGPU and no graphics card.
NO_ADAPTER = re.compile(r':CONSOLE[^"]*"No available adapters\.", source: ')


def chromium(address, profile, *switches):
    """Starts it; output is read from its pipes. `profile`: a folder of its own."""
    return subprocess.Popen(["chromium", *SWITCHES, f"--user-data-dir={profile}", *switches, address],
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            start_new_session=True)


def end(browser):
    """What it has said on stderr. A browser that draws does not always hear the first request."""
    os.killpg(browser.pid, signal.SIGTERM)
    try:
        return browser.communicate(timeout=10)[1]
    except subprocess.TimeoutExpired:
        os.killpg(browser.pid, signal.SIGKILL)
        return browser.communicate()[1]


def look(test, folder, page, *switches, ranges=True, timeout=240, greets=()):
    """What a page of `folder` sends to the server. Fails the test if the page failed, or if anything stands on the
    console that has none of the words `greets`."""
    with FolderServer(folder, ranges) as server:
        browser = chromium(f"{server.address}/{page}", test.folder / "profile", *switches)
        try:
            found = json.loads(server.posted.get(timeout=timeout))
        finally:
            said = end(browser)
    test.assertNotIn("failed", found, found.get("failed"))
    test.assertEqual(found["errors"], [])
    lines = [line for line in said.splitlines() if ":CONSOLE" in line and not NO_ADAPTER.search(line)]
    test.assertEqual([line for line in lines if not any(word in line for word in greets)], [])
    return found
