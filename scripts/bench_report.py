"""Tables and plots of what scripts/bench has measured."""

import textwrap

from bench_groups import AIMS, ALL_MOVED
import svg_plot

PASSES = ("cull", "update", "pyramid", "blades", "shadow", "resolve", "grass", "ground", "total")
BYTES_MOVED = 24  # of a blade: packed 16, its state read and written 4 each
AIMED_SHARE = 0.6  # of the copy bandwidth


def about(measurement, runs, what="medians"):
    """Where, with what and how: stands under each table and plot."""
    devices = sorted({f"{run['device']}, {run['driver']}" for run in runs})
    commits = sorted({run["commit"] for run in runs})
    return f"{'; '.join(devices)}; {measurement['size']}; commit {', '.join(commits)}; {what}"


def commands(runs):
    return [run["command"] for run in runs]


def median(run, name):
    return run["stats"]["gpu_ms"].get(name, {"median": 0.0})["median"]


def p99(run, name):
    return run["stats"]["gpu_ms"].get(name, {"p99": 0.0})["p99"]


def cell(run, name):
    """Without spaces, so that rows stay short; a pass that did not run is a dash."""
    return f"{median(run, name):.3f}/{p99(run, name):.3f}" if p99(run, name) > 0 else "–"


def paragraph(words, indent=""):
    """Lines of a page, of at most 150 characters; commands are broken between their words."""
    return textwrap.wrap(words, 150, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| --- |" + " ---: |" * (len(head) - 1)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows] + [""]


def row_of(run):
    blades = run["stats"]["blades"]
    return [blades["resident"], blades["simulated"], blades["drawn"], run["stats"]["samples"], *passes_of(run)]


def passes_of(run):
    return [cell(run, name) for name in PASSES]


HEAD = ["resident", "moved", "drawn", "samples", *PASSES]


class Report:
    def __init__(self, measurement, folder):
        self.measurement, self.folder = measurement, folder
        self.lines, self.plots = [], 0

    def section(self, title, words):
        self.lines += [f"## {title}", "", *paragraph(words), ""]

    def add(self, head, runs, rows):
        """A table, under it where it is from; the command of its first row, the others are in measured.json."""
        self.lines += table(head, rows)
        self.lines += [*paragraph(f"{about(self.measurement, runs, 'median/p99 [ms]')}. First row: `{runs[0]['command']}`."), ""]

    def plot(self, name, drawing):
        (self.folder / f"{name}.svg").write_text(drawing, encoding="utf-8")
        self.lines += [f"![{name}]({name}.svg)", ""]

    def bars(self, name, title, parts, runs, names):
        rows = [(label, [sum(median(run, key) for key in keys) for keys in parts.values()]) for label, run in zip(names, runs)]
        self.plot(name, svg_plot.bars(title, "GPU time [ms]", list(parts), rows, about(self.measurement, runs), commands(runs)))

    def lines_of(self, name, title, across, series, logarithmic):
        """`series`: {name: [(x, run)]}, of which grass is drawn."""
        points = {key: [(x, median(run, "grass"), p99(run, "grass")) for x, run in row] for key, row in series.items()}
        runs = [run for row in series.values() for _, run in row]
        self.plot(name, svg_plot.lines(title, across, "grass, GPU time [ms]", points,
                                       about(self.measurement, runs, "medians, strokes to p99"), commands(runs), logarithmic))


PARTS = {"cull, update": ("cull", "update"), "pyramid": ("pyramid",), "blades": ("blades",), "shadow": ("shadow",), "resolve": ("resolve",),
         "ground": ("ground",)}


def scenes_of(runs):
    return list(dict.fromkeys(run["scene"] for run in runs))


def table_section(report, runs):
    report.section("Scenes", "Each way of drawing, standing and moving. *moved* blades are those of the last frame.")
    for scene in scenes_of(runs):
        for moving in (False, True):
            chosen = [run for run in runs if run["scene"] == scene and run["moving"] == moving]
            if not chosen:
                continue
            name = scene + (", moving" if moving else "")
            report.lines += [f"### {name}", ""]
            report.add(["way", *HEAD], chosen, [[run["way"], *row_of(run)] for run in chosen])
            fast = [run for run in chosen if not run["way"].startswith("tessellation")]
            if fast:
                report.bars(name.replace(", ", "-"), f"{name}: what a frame is made of", PARTS, fast, [run["way"] for run in fast])
    bounds(report, [run for run in runs if run["way"] == ALL_MOVED and not run["moving"]])
    aims(report, runs)


def bounds(report, runs):
    """Update and cull against the time in which the device copies what they must read and write."""
    copies = {copy["device"]: copy for copy in report.measurement["copies"]}
    rows, used = [], []
    for run in runs:
        copy = copies.get(run["device"])
        time = median(run, "cull") + median(run, "update")
        if copy is None or copy["gb_per_s"] <= 0 or time <= 0:
            continue
        moved = run["stats"]["blades"]["simulated"] * BYTES_MOVED
        reached = moved / time / 1e6
        rows.append([run["scene"], run["stats"]["blades"]["simulated"], f"{moved / 1e6:.1f}", f"{time:.3f}", f"{reached:.0f}",
                     f"{copy['gb_per_s']:.0f}", f"{100 * reached / copy['gb_per_s']:.1f} %",
                     f"{moved / (AIMED_SHARE * copy['gb_per_s'] * 1e6):.3f}"])
        used.append(run)
    if rows:
        copy = copies[used[0]["device"]]
        report.section("Update and cull against the bandwidth", f"A blade is {BYTES_MOVED} bytes read and written. The bound is what the "
                       f"device reads and writes when it copies {copy['bytes']} bytes (`{copy['command']}`: {copy['copy_ms']['median']:.3f} ms).")
        report.add(["scene", "moved", "MB", "cull + update [ms]", "GB/s", "copy [GB/s]", "of the bound", f"at {AIMED_SHARE:.0%} [ms]"],
                   used, rows)


def aims(report, runs):
    rows, used = [], []
    for scene, way, grass, whole in AIMS:
        for run in runs:
            if (run["scene"], run["way"], run["moving"]) == (scene, way, False) and report.measurement["size"] == "1920x1080":
                rows.append([f"{scene}: {way}", cell(run, "grass"), "–" if grass is None else grass, cell(run, "total"), whole])
                used.append(run)
    if rows:
        report.section("Aims", "For one NVIDIA H200.")
        report.add(["", "grass", "at most", "whole", "at most"], used, rows)


def growth_section(report, runs):
    report.section("Resident blades", "Default settings, one sample. *outside*: the same picture, the added ground behind and beside "
                   "it; *inside*: farther ground comes into the picture.")
    rows = []
    for run in runs:
        first = next(other for other in runs if other["way"] == run["way"])
        rows.append([f"{run['way']}, {run['x']}×", *row_of(run), f"{median(run, 'grass') / max(median(first, 'grass'), 1e-9):.3f}×",
                     f"{median(run, 'total') / max(median(first, 'total'), 1e-9):.3f}×"])
    report.add(["", *HEAD, "grass grows", "total grows"], runs, rows)
    report.lines_of("growth", "Time against resident blades", "resident blades",
                    {way: [(run["stats"]["blades"]["resident"], run) for run in runs if run["way"] == way]
                     for way in dict.fromkeys(run["way"] for run in runs)}, (True, False))


def visible_section(report, runs):
    report.section("Visible blades", "One sample; the draw distance is a 32nd to the whole of the scene's.")
    report.add(["", "of the distance", *HEAD], runs, [[f"{run['scene']}, {run['way']}", f"{run['x']:g}", *row_of(run)] for run in runs])
    report.lines_of("visible", "Time against drawn blades", "drawn blades",
                    {f"{scene}, {way}": [(run["stats"]["blades"]["drawn"], run) for run in runs if (run["scene"], run["way"]) == (scene, way)]
                     for scene, way in dict.fromkeys((run["scene"], run["way"]) for run in runs)}, (True, True))


def levels_section(report, runs):
    report.section("Segments a blade", "Nothing left out, one sample.")
    report.add(["", "segments", *HEAD], runs, [[f"{run['scene']}, {run['way']}", run["x"], *row_of(run)] for run in runs])
    report.lines_of("levels", "Time against segments a blade", "segments along each blade",
                    {f"{scene}, {way}": [(run["x"], run) for run in runs if (run["scene"], run["way"]) == (scene, way)]
                     for scene, way in dict.fromkeys((run["scene"], run["way"]) for run in runs)}, (False, True))


def culling_section(report, runs):
    report.section("Culling", "One sample, no level of detail; no test, each alone, all; and the default, which thins as well. A blade "
                   "counts for the first test that cuts it.")
    parts = {"cull, update": ("cull", "update"), "pyramid": ("pyramid",), "blades, resolve": ("blades", "shadow", "resolve")}
    for scene in scenes_of(runs):
        chosen = [run for run in runs if run["scene"] == scene]
        cuts = list(chosen[0]["stats"]["blades"]["culled"])
        report.lines += [f"### {scene}", ""]
        rows = []
        for run in chosen:
            blades = run["stats"]["blades"]
            rows.append([run["way"], *(blades["culled"][cut] for cut in cuts), blades["lod"], blades["simulated"], blades["drawn"],
                         *passes_of(run)])
        report.add(["tests", *(f"by {cut}" for cut in cuts), "thinned", "moved", "drawn", *PASSES], chosen, rows)
        report.bars(f"culling-{scene}", f"{scene}: each culling test alone, and all", parts, chosen, [run["way"] for run in chosen])


def coverage_section(report, runs):
    report.section("Coverage", "Share of the picture that grass covers, by its distance; found / reference [%], and their ratio. The "
                   "reference has no culling, no level of detail, and 256 samples.")
    for run in runs:
        found, wanted = run["coverage"]["found"], run["coverage"]["reference"]
        rows = [[f"to {limit:.1f} m", f"{100 * a:.3f}", f"{100 * b:.3f}", f"{a / b:.4f}" if b > 0 else "–"]
                for limit, a, b in zip(run["limits"], found, wanted)]
        rows.append(["all", f"{100 * sum(found):.3f}", f"{100 * sum(wanted):.3f}", f"{sum(found) / max(sum(wanted), 1e-9):.4f}"])
        report.lines += [f"### {run['scene']}, {run['way']}", ""]
        report.lines += table(["distance", "found", "reference", "ratio"], rows)
        report.lines += [*paragraph(f"{about(report.measurement, [run], 'light of one frame')}. `{run['command']}`."), ""]


SECTIONS = {"table": table_section, "growth": growth_section, "visible": visible_section, "levels": levels_section,
            "culling": culling_section, "coverage": coverage_section}


def write_report(measurements, folder):
    """Of measurements of one size, as if they were one; of what was measured twice the last counts."""
    sizes = {measurement["size"] for measurement in measurements}
    if len(sizes) > 1:
        raise SystemExit(f"bench: measurements of different sizes: {', '.join(sorted(sizes))}")
    runs = {}
    for measurement in measurements:
        for run in measurement["runs"]:
            runs[tuple(run[key] for key in ("group", "scene", "way", "moving", "x", "device"))] = run
    merged = {"size": measurements[0]["size"], "copies": [measurement["copies"] for measurement in measurements]}
    folder.mkdir(parents=True, exist_ok=True)
    report = Report(merged, folder)
    report.lines += ["# Measured by scripts/bench", ""]
    for measurement in measurements:
        copies = measurement["copies"]
        report.lines += paragraph(f"* `{measurement['command']}`, commit {measurement['commit']}, {copies['device']}, "
                                  f"{copies['driver']}", "  ")
    report.lines.append("")
    for group, section in SECTIONS.items():
        chosen = [run for run in runs.values() if run["group"] == group]
        if chosen:
            section(report, chosen)
    (folder / "README.md").write_text("\n".join(report.lines), encoding="utf-8")
