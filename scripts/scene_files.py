"""What a scene's JSON says is baked and looked at; for scripts/gallery, scripts/bench and scripts/picture-error."""

import hashlib
import json
import os
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def field_scene(path):
    """The scene in a file, and the name of its field: another scene's if it has the field "of" that."""
    scene = json.loads(path.read_text(encoding="utf-8"))
    if "of" not in scene:
        return scene, path.stem
    other, name = field_scene(path.with_name(scene["of"] + ".json"))
    return {**other, **scene}, name


def input_of(scene, key, name, folder):
    """What the scene holds under `key`: an object becomes a file; a text is a file of the repository or a name."""
    value = scene[key]
    if isinstance(value, str):
        return str(ROOT / value) if "/" in value else value
    path = folder / f"{name}.{key}.json"
    path.write_text(json.dumps(value), encoding="utf-8")
    return str(path)


def camera_of(scene, name, folder):
    return input_of(scene, "camera", name, folder) if "camera" in scene else "fit"


def bake_in_tiles(sward, tiles, command, field):
    """The same bytes as one bake, with a process for each core. The tiles, larger than the field together, lie in TMPDIR."""
    def run(*arguments):
        subprocess.run([sward, *arguments, "-q"], check=True, cwd=ROOT, stdout=subprocess.DEVNULL)

    with tempfile.TemporaryDirectory(prefix="sward-tiles-", dir=os.environ.get("TMPDIR", field.parent)) as folder:
        plan = Path(folder) / "plan.json"
        run("plan", *command, "--tiles", str(tiles), "-o", plan)
        with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            list(pool.map(lambda tile: run("tile", plan, "--index", str(tile), "-o", folder, "--threads", "1"), range(tiles)))
        run("merge", plan, folder, "-o", field, "--force")


def baked(scene, name, sward, count, folder):
    """The scene's field, with another number of blades unless `count` is None; baked anew when its program or anything
    of its bake has changed."""
    ground = input_of(scene, "ground", name, folder)
    command = [ground, "--meadow", input_of(scene, "meadow", name, folder) if "meadow" in scene else "meadow"]
    options = list(scene.get("bake", []))
    if count is not None:
        for amount in {"--density", "--count"} & set(options):
            place = options.index(amount)
            del options[place:place + 2]
        options += ["--count", str(count)]
    command += options
    made_of = [json.dumps([scene[key] for key in ("ground", "meadow", "bake") if key in scene]), str(count)]
    made_of += [str(path.stat().st_mtime_ns) for path in (Path(ground), sward) if path.is_file() and path.parent != folder]
    stamp = hashlib.sha256("\n".join(made_of).encode()).hexdigest()
    field, stamp_file = folder / f"{name}.sward", folder / f"{name}.stamp"
    if not field.is_file() or not stamp_file.is_file() or stamp_file.read_text(encoding="ascii") != stamp:
        if count is None and "tiles" in scene:
            bake_in_tiles(sward, scene["tiles"], command, field)
        else:
            subprocess.run([sward, "bake", *command, "-o", field, "--force", "-q"], check=True, cwd=ROOT)
        stamp_file.write_text(stamp, encoding="ascii")
    return field
