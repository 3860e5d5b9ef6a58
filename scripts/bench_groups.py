"""What scripts/bench measures, group by group: scenes, and options of `sward-view bench`."""

from dataclasses import dataclass, field

NOTHING_LEFT_OUT = ("--cull", "none", "--lod", "off")
RASTER = ("--geometry", "raster")
TESSELLATION = ("--geometry", "tessellation")
ONE, FOUR = ("--samples", "1"), ("--samples", "4")
WHOLE = "raster, nothing left out"
ALL_MOVED = f"{WHOLE}, all moved, 1 sample"  # by settings of its own: far blades move in every frame, too
TESTS = ("patch", "orientation", "frustum", "distance", "occlusion")
SHARES = (1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2, 1)  # of a scene's draw distance
LEVELS = (1, 2, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21)
GROWTH = (1, 4, 16)  # times as many resident blades

# Name of the way, its options, and whether its frames take so long that a fifth of them must do.
WAYS = ((f"{WHOLE}, 1 sample", (*RASTER, *NOTHING_LEFT_OUT, *ONE), False),
        (f"{WHOLE}, 4 samples", (*RASTER, *NOTHING_LEFT_OUT, *FOUR), False),
        (ALL_MOVED, (*RASTER, *NOTHING_LEFT_OUT, *ONE), False),
        ("default, 1 sample", ONE, False),
        ("default, 4 samples", FOUR, False),
        ("raster, default, 4 samples", (*RASTER, *FOUR), True),
        ("tessellation, default, 4 samples", (*TESSELLATION, *FOUR), True),
        ("tessellation, level 7, nothing left out, 1 sample", (*TESSELLATION, "--tess-level", "7", *NOTHING_LEFT_OUT, *ONE), True))

# Scene, way, and what grass and the whole frame may take [ms] on one H200 at 1920×1080.
AIMS = (("1M", f"{WHOLE}, 1 sample", 0.6, 1.1),
        ("1M", "tessellation, level 7, nothing left out, 1 sample", None, 27),
        ("other", "default, 1 sample", 0.35, 0.85),
        ("other", "default, 4 samples", 0.8, 1.5),
        ("other", f"{WHOLE}, 1 sample", 0.8, 1.2),
        ("16M", f"{WHOLE}, 1 sample", 2.2, 2.7),
        ("16M", f"{WHOLE}, 4 samples", 5.5, 6.0),
        ("100M", "default, 1 sample", 2.0, 2.5),
        ("1G", "default, 1 sample", 3.5, 4.0))
LARGE = {"100M", "1G"}  # scenes that are not tessellated or drawn whole by default


@dataclass
class Run:
    """One run of `sward-view bench`: a point of a line, or a row of a table."""
    group: str
    scene: str
    way: str
    options: tuple = ()
    moving: bool = False
    slow: bool = False
    x: float | None = None  # what the way is drawn against
    coverage: bool = field(default=False)


def table(scenes):
    for scene in scenes or ("1M", "other", "16M"):
        for moving in (False, True):
            for way, options, slow in WAYS:
                if not (scene in LARGE and (slow or way.startswith(WHOLE))):
                    yield Run("table", scene, way, options, moving, slow)


def growth(_):
    for where in ("outside", "inside"):
        for times in GROWTH:
            yield Run("growth", f"growth-{where}-{times}", where, ONE, x=times)


def visible(scenes):
    for scene in scenes or ("16M",):
        for way, options in (("default", ONE), ("not thinned", (*ONE, "--lod", "off"))):
            for share in SHARES:
                yield Run("visible", scene, way, options, x=share)


def levels(scenes):
    for scene in scenes or ("1M",):
        for name, geometry in (("tessellation", TESSELLATION), ("raster", RASTER)):
            for level in LEVELS:
                yield Run("levels", scene, name, (*geometry, "--tess-level", str(level), *NOTHING_LEFT_OUT, *ONE),
                          slow=geometry is TESSELLATION, x=level)


def culling(scenes):
    for scene in scenes or ("1M", "other", "4M", "16M"):
        for tests in ("none", *TESTS, "all"):
            yield Run("culling", scene, tests, (*ONE, "--lod", "off", "--cull", tests))
        yield Run("culling", scene, "all, thinned", ONE)


def coverage(scenes):
    for scene in scenes or ("1M", "other", "16M"):
        for way, options in (("default, 1 sample", ONE), ("default, 4 samples", FOUR)):
            yield Run("coverage", scene, way, options, coverage=True)


GROUPS = {"table": table, "growth": growth, "visible": visible, "levels": levels, "culling": culling, "coverage": coverage}
