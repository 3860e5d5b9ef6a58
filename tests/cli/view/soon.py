"""The way to draw that starts soonest, for tests of what does not depend on the way. On lavapipe the shaders of the other
ways take half a second of processor time in each run."""

import os
from pathlib import Path

SOON = ("--geometry", "tessellation")

VIEWER = Path(os.environ["SWARD_VIEW_PROGRAM"]).resolve()
PROGRAM = """#!/bin/sh
# sward-view, which tessellates where no other way is asked for.
case "$*" in
    *--geometry*|*--copy-bandwidth*) exec "{viewer}" "$@" ;;
    bench*|render*) exec "{viewer}" "$@" {soon} ;;
esac
exec "{viewer}" "$@"
"""

REPEATING = """#!/bin/sh
# sward-view, which measures, copies and draws once, and then says the same again.
kind=$1
case "$*" in *--copy-bandwidth*) kind=copies ;; esac
for word in "$@"; do
    case "$last" in -o) picture=$word ;; --stats) stats=$word ;; esac
    last=$word
done
if [ ! -e "{folder}/$kind" ]; then
    "{folder}/soon" "$@" > "{folder}/$kind" || exit
    [ -z "$stats" ] || cp "$stats" "{folder}/stats"
    [ -z "$picture" ] || cp "$picture" "{folder}/picture"
fi
cat "{folder}/$kind"
[ -z "$stats" ] || cp "{folder}/stats" "$stats"
[ -z "$picture" ] || cp "{folder}/picture" "$picture"
"""


def programs_that_start_soon(folder, program=PROGRAM):
    """Makes a folder with both programs for a script that runs them."""
    folder.mkdir(parents=True)
    (folder / "sward").symlink_to(VIEWER.parent / "sward")
    for name, text in (("soon", PROGRAM), ("sward-view", program)):
        (folder / name).write_text(text.format(viewer=VIEWER, soon=" ".join(SOON), folder=folder), encoding="utf-8")
        (folder / name).chmod(0o755)
    return folder


def programs_that_repeat_themselves(folder):
    """The same for a script whose tables and plots are looked at, and not what is in them."""
    return programs_that_start_soon(folder, REPEATING)
