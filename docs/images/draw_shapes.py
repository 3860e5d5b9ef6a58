#!/usr/bin/python3
"""Draws docs/images/shapes.png: the five shapes of a blade, above flat and below folded.

    docs/images/draw_shapes.py SWARD SWARD_VIEW OUT.png

SWARD and SWARD_VIEW are the programs. Needs python3-numpy and python3-skimage.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from skimage.io import imread, imsave
from skimage.transform import downscale_local_mean

SHAPES = ("triangle-tip", "quad", "triangle", "quadratic", "dandelion")
SIZE = 440  # [pixels] of a panel before it is halved
GAP = 4
CAMERA = {"eye": [0.0, 0.42, 1.35], "target": [0.0, 0.19, 0.0], "fov_y_deg": 26}
SETTINGS = {"wind": [], "gravity": {"strength": 2}, "look": {"fog": 0, "sun": {"azimuth": 215, "elevation": 35}},
            "detail": {"segments": 16}}


def panel(sward, viewer, folder, shape, fold):
    meadow = folder / "meadow.json"
    meadow.write_text(json.dumps({"species": [
        {"name": shape, "shape": shape, "fold": fold, "height_m": [0.34, 0.46], "width_m": [0.055, 0.065],
         "tip_threshold": 0.5, "root_color": [0.04, 0.10, 0.02], "tip_color": [0.20, 0.38, 0.07]}]}))
    ground = folder / "ground.json"
    ground.write_text(json.dumps({"kind": "plane", "size": [0.8, 0.5]}))
    field = folder / "field.sward"
    subprocess.run([sward, "bake", ground, "--meadow", meadow, "--count", "9", "--sampling", "poisson", "--seed", "3",
                    "--sky-rays", "0", "--blade-scale", "1", "-o", field, "--force", "-q"], check=True)
    camera, settings, picture = folder / "camera.json", folder / "settings.json", folder / "p.png"
    camera.write_text(json.dumps(CAMERA))
    settings.write_text(json.dumps(SETTINGS))
    subprocess.run([viewer, "render", field, "-o", picture, "--size", f"{SIZE}x{SIZE}", "--camera", camera,
                    "--settings", settings, "--force", "-q"], check=True)
    return downscale_local_mean(imread(picture)[..., :3].astype(float), (2, 2, 1))


def main(sward, viewer, out):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for fold in (0.0, 1.0):
            panels = [panel(sward, viewer, Path(folder), shape, fold) for shape in SHAPES]
            rows.append(np.concatenate([np.pad(p, ((GAP, GAP), (GAP, GAP), (0, 0)), constant_values=255) for p in panels],
                                       axis=1))
    # A palette's worth of levels, so that the file stays small.
    picture = np.clip(np.round(np.concatenate(rows) / 4) * 4, 0, 255).astype(np.uint8)
    imsave(out, picture, check_contrast=False)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
