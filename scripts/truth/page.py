"""A page of the documentation with pairs of pictures, and the figures before a change of the light and after it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import light_pictures  # noqa: E402

HEAD = """# Real time beside truth

`scripts/judge --page` has made this page. [How it judges](algorithms/truth.md), and why it differs. Each picture: `sward-view render`, the same blades
traced by Cycles, and four times their difference.
{how}.
"""
TABLE = """
## All pictures

By scene, distance [m] and sun, relative to the truth; *sun* and *sky* are mean luminance by each light alone. *Noise* is the FLIP between two halves
of the truth's samples: most of it adds to the FLIP of ours. What *before* is: [truth](algorithms/truth.md#against-cycles).

{how}.

{met}

"""
QUALITY = 88  # of JPEG: noise is no detail
AIMS = {"mean": 0.05, "contrast": 0.10, "blue_green": 0.05, "flip": 0.05}
NAMES = {"mean": "luminance", "contrast": "contrast", "blue_green": "blue/green", "flip": "FLIP"}


def ratio(one, key):
    return one["ours"][key] / max(one["truth"][key], 1e-12)


def figures_of(result):
    """Mean and contrast relative to the truth's, blue/green likewise, and FLIP, of the whole picture."""
    one = result["all"]["all"]
    return [f"{ratio(one, key):.2f}" for key in ("mean", "contrast", "blue_green")] + [f"{one['flip']:.2f}"]


def comparison(results, before):
    """Markdown: of each picture the figures before, if they are known, and now."""
    now_alone = ["far, middle, near", "sun", "sky"]
    names = ["mean", "contrast", "blue/green", "FLIP"]
    lines = [f"| picture | {' | '.join(f'{name}, before → now' for name in names)} | noise | {' | '.join(now_alone)} |",
             "| --- |" + " ---: |" * (len(names) + 1 + len(now_alone))]
    for name, result in results.items():
        now = figures_of(result)
        was = figures_of(before[name]) if name in before else ["–"] * len(now)
        cells = [f"{a} → {b}" for a, b in zip(was, now)] + [f"{result['all']['all']['noise']:.2f}"]
        cells.append(" ".join(f"{ratio(result['all'][band], 'mean'):.2f}" for band in ("far", "middle", "near")))
        cells += [f"{ratio(result[light]['all'], 'mean'):.2f}" if light in result else "–" for light in ("sun", "sky")]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def met(results):
    """A sentence: how many pictures meet each aim as a whole."""
    wholes = [result["all"]["all"] for result in results.values()]
    counts = {key: sum(one["flip"] <= aim if key == "flip" else abs(ratio(one, key) - 1.0) <= aim for one in wholes)
              for key, aim in AIMS.items()}
    parts = [f"{NAMES[key]} {'at most' if key == 'flip' else 'within'} {AIMS[key]:g} in {count}" for key, count in counts.items()]
    return f"Aims and how many of the {len(wholes)} pictures meet them: {', '.join(parts)}."


def described(report):
    """A sentence on how pictures were made."""
    size = "×".join(map(str, report["size"])) + " pixels, " if report.get("size") else ""
    devices = sorted({field["device"] for field in report["fields"].values() if "device" in field})
    ours = report["supersample"] ** 2 if report["supersample"] > 1 else 4
    return f"{size}{report['samples']} samples of a pixel by Cycles and {ours} of ours" + (f", drawn on {', '.join(devices)}" if devices else "")


def write_jpeg(path, png):
    from PIL import Image
    Image.fromarray(light_pictures.codes(png)).save(path, quality=QUALITY)


def described_by_distance(reports):
    """The same of several reports."""
    if len(reports) == 1:
        return described(reports[0])
    distances = [sorted({int(name.split(".")[1]) for name in report["pictures"]}) for report in reports]
    return ";\n".join(f"{', '.join(map(str, some))} m: {described(report)}" for some, report in zip(distances, reports))


def write(page, folder, report, tables, before, shown=6):
    """Writes `page` and, beside it in truth/, a JPEG for one picture of each of the first `shown` scenes of `report`. The figures
    below the pictures are those of the reports `tables`, and of the pictures `before`."""
    pictures = page.parent / "truth"
    pictures.mkdir(parents=True, exist_ok=True)
    text, scenes, results = HEAD.format(how=described(report)), [], report["pictures"]
    for name in results:
        scene = name.split(".")[0]
        if scene not in scenes and len(scenes) < shown:
            # Another sun for each scene, if there are several.
            same = [other for other in results if other.split(".")[0] == scene]
            chosen = same[len(scenes) % len(same)]
            scenes.append(scene)
            write_jpeg(pictures / f"pair-{scene}.jpg", folder / f"{chosen}.pair.png")
            mean, contrast, _, flip = figures_of(results[chosen])
            text += (f"\n![{chosen}: ours, the truth, four times the difference](truth/pair-{scene}.jpg)\n\n"
                     f"*{chosen}*: {mean} of the true luminance, {contrast} of the true contrast, FLIP {flip}, of which the truth's noise "
                     f"is up to {results[chosen]['all']['all']['noise']:.2f}.\n")
    results = {name: result for table in tables for name, result in table["pictures"].items()}
    text += TABLE.format(how=described_by_distance(tables), met=met(results)) + comparison(results, before)
    page.write_text(text, encoding="utf-8")
