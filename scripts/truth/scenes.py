"""What scripts/judge looks at: six scenes, three suns, three distances."""

import math

# Side of the flat grounds [m]: whatever the cameras below see, and 3 m more for suns down to 15°.
SIDE = 12
PLANE = {"kind": "plane", "size": [SIDE, SIDE], "cells": [24, 24]}
# Light that both renderers have: no gloss, which is judged by --gloss.
MATTE = ["--blade-scale", "1", "--set", "species.*.gloss=0", "--seed", "1"]

# Meadow, ground, options of `sward bake`. A ground "slope" rises by so many degrees to the left, so that every sun reaches it.
SCENES = {
    "grass": {"meadow": "grass", "ground": PLANE, "bake": MATTE},
    "grass-thin": {"meadow": "grass", "ground": PLANE, "bake": [*MATTE, "--density", "800"]},
    # Short blades: a smaller square has room for their shadows.
    "lawn": {"meadow": "lawn", "ground": {**PLANE, "size": [9, 9]}, "bake": [*MATTE, "--density", "4000"]},
    "steppe-thin": {"meadow": "steppe", "ground": PLANE, "bake": [*MATTE, "--density", "800"]},
    "slope": {"meadow": "grass", "slope": 25.0, "bake": MATTE},
    "planet": {"meadow": "grass", "ground": {"kind": "sphere", "radius": 3, "segments": 128, "rings": 64},
               "bake": [*MATTE, "--ground-up", "radial"], "top": 3.0},
}

# Degrees clockwise from −z, where the eye looks, and above the horizon.
SUNS = {"high": (135.0, 60.0), "beside": (90.0, 20.0), "behind": (0.0, 15.0)}

# By distance [m] of the eye from the middle of the picture: degrees below the horizon, height of the picture on the ground
# seen from there [degrees], and its size in pixels.
DISTANCES = {2: (35.0, 30.0, (640, 360)), 20: (20.0, 6.0, (320, 180)), 200: (14.0, 0.55, (128, 72))}


def camera_at(scene, distance):
    """The eye looks along −z at the scene's middle, `distance` [m] away."""
    down, fov, _ = DISTANCES[distance]
    top = scene.get("top", 0.0)
    eye = [0.0, top + distance * math.sin(math.radians(down)), distance * math.cos(math.radians(down))]
    return {"eye": eye, "target": [0.0, top, 0.0], "up": [0.0, 1.0, 0.0], "fov_y_deg": fov}


def slope_mesh(degrees, cells=24):
    """OBJ text of a square that rises towards −x."""
    rise = math.radians(degrees)
    lines, count = [], cells + 1
    for j in range(count):
        for i in range(count):
            along, z = SIDE * (i / cells - 0.5), SIDE * (j / cells - 0.5)
            lines.append(f"v {along * math.cos(rise):.6f} {-along * math.sin(rise):.6f} {z:.6f}")
    for j in range(cells):
        for i in range(cells):
            a = j * count + i + 1
            lines.append(f"f {a} {a + count} {a + count + 1} {a + 1}")
    return "\n".join(lines) + "\n"
