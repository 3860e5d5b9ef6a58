"""A page of the documentation with pairs of pictures, and the figures before a change of the light and after it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import light_pictures  # noqa: E402

HEAD = """# Real time beside truth

`scripts/judge` has made this page: {command}. [How it judges](algorithms/truth.md).
Each picture: `sward-view render`, the same blades traced by Cycles, and four times their difference.
"""
QUALITY = 82  # of JPEG: noise is no detail


def ratio(one, key):
    return one["ours"][key] / max(one["truth"][key], 1e-12)


def figures_of(result):
    """Mean and contrast relative to the truth's, blue/green likewise, and FLIP, of the whole picture."""
    one = result["all"]["all"]
    return [f"{ratio(one, key):.2f}" for key in ("mean", "contrast", "blue_green")] + [f"{one['flip']:.2f}"]


def comparison(results, before):
    """Markdown: of each picture the figures before, if they are known, and now."""
    names = ["mean", "contrast", "blue/green", "FLIP"]
    lines = ["| picture | " + " | ".join(f"{name}, before → now" for name in names) + " | noise of the truth |",
             "| --- |" + " ---: |" * (len(names) + 1)]
    for name, result in results.items():
        now = figures_of(result)
        was = figures_of(before[name]) if name in before else ["–"] * len(now)
        cells = [f"{a} → {b}" for a, b in zip(was, now)]
        lines.append(f"| {name} | {' | '.join(cells)} | {result['all']['all']['noise']:.2f} |")
    return "\n".join(lines) + "\n"


def write_jpeg(path, png):
    from PIL import Image
    Image.fromarray(light_pictures.codes(png)).save(path, quality=QUALITY)


def write(page, folder, results, before, command, shown=6):
    """Writes `page` and, beside it in truth/, a JPEG for the first picture of each of the first `shown` scenes."""
    pictures = page.parent / "truth"
    pictures.mkdir(parents=True, exist_ok=True)
    text, scenes = HEAD.format(command=command), []
    for name in results:
        scene = name.split(".")[0]
        if scene not in scenes and len(scenes) < shown:
            # Another sun for each scene, if there are several.
            same = [other for other in results if other.split(".")[0] == scene]
            chosen = same[len(scenes) % len(same)]
            scenes.append(scene)
            write_jpeg(pictures / f"{scene}.jpg", folder / f"{chosen}.pair.png")
            mean, contrast, *_ = figures_of(results[chosen])
            text += (f"\n![{chosen}: ours, the truth, four times the difference](truth/{scene}.jpg)\n\n"
                     f"*{chosen}*: {mean} of the true luminance, {contrast} of the true contrast.\n")
    text += "\nAll pictures, by scene, distance [m] and sun, relative to the truth:\n\n" + comparison(results, before)
    page.write_text(text, encoding="utf-8")
