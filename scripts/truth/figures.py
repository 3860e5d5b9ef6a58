"""Figures of a picture beside the truth, for the whole of it and for each third: near, middle and far."""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import flip  # noqa: E402

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
BANDS = ("far", "middle", "near", "all")
LIGHTS = ("all", "sun", "sky")
DARK = 0.4  # a pixel is dark below this share of the 90th percentile of its band


def band_rows(name, height):
    third = height // 3
    return {"far": slice(0, third), "middle": slice(third, height - third), "near": slice(height - third, height),
            "all": slice(0, height)}[name]


def spread(picture, halves, shown):
    """Standard deviation of luminance. The covariance of two halves, whose noise is independent, leaves their noise out."""
    one, other = ((half[shown] @ LUMINANCE) for half in (halves or (picture, picture)))
    return float(np.sqrt(max(((one - one.mean()) * (other - other.mean())).mean(), 0.0)))


def figures_of(picture, shown, halves=None):
    """Mean luminance, contrast, share of dark pixels, blue over green of the pixels that are `shown`. `halves`: the picture by
    each half of its samples, if they are known."""
    light = picture[shown]
    luminance = light @ LUMINANCE
    if not len(luminance) or luminance.mean() <= 0.0:
        return {"pixels": int(len(luminance)), "mean": 0.0, "contrast": 0.0, "dark": 0.0, "blue_green": 0.0}
    return {"pixels": int(len(luminance)), "mean": float(luminance.mean()),
            "contrast": spread(picture, halves, shown) / float(luminance.mean()),
            "dark": float((luminance < DARK * np.percentile(luminance, 90)).mean()),
            "blue_green": float(light[:, 2].mean() / max(light[:, 1].mean(), 1e-12))}


def compared(ours, truth, halves, shown, ppd, our_halves=()):
    """{light: {band: {"ours", "truth", "flip", "noise"}}} of dictionaries of pictures by light. `halves`: two with half of the
    truth's samples each; the FLIP between them, "noise", is above what the truth's own noise adds. `shown`: pixels without sky.
    `our_halves`: the same of ours, or nothing."""
    result = {}
    for light in (light for light in LIGHTS if light in ours):
        mine, real = (np.where(shown[..., None], picture[light], 0.0) for picture in (ours, truth))
        error = flip.hdr_flip(real, mine, ppd)
        noise = flip.hdr_flip(*(np.where(shown[..., None], half[light], 0.0) for half in halves), ppd)
        by_halves = [[half[light] for half in pair] for pair in (our_halves, halves)]
        result[light] = {}
        for band in BANDS:
            rows = band_rows(band, len(shown))
            part = shown[rows]
            mean = lambda errors: float(errors[rows][part].mean()) if part.any() else 0.0
            one, other = (figures_of(picture[rows], part, [half[rows] for half in pair])
                          for picture, pair in zip((mine, real), by_halves))
            result[light][band] = {"ours": one, "truth": other,
                                   "flip": mean(error), "noise": mean(noise)}
    return result


def missed(name, result, bounds):
    """What a comparison misses, in words. `bounds`: largest relative error of mean, contrast and blue/green, largest FLIP;
    None: not asked for."""
    found = []
    for light, bands in result.items():
        for band, one in bands.items():
            if one["truth"]["mean"] <= 0.0:
                continue
            for key in ("mean", "contrast", "blue_green"):
                if max(one["ours"][key], one["truth"][key]) < 1e-9:
                    continue  # both are even, or black
                ratio = one["ours"][key] / max(one["truth"][key], 1e-12)
                if bounds.get(key) is not None and not abs(ratio - 1.0) <= bounds[key]:
                    found.append(f"{name}, {light}, {band}: {key} is {ratio:.3f} of the truth's; at most {bounds[key]:g} off")
            if bounds.get("flip") is not None and not one["flip"] <= bounds["flip"]:
                found.append(f"{name}, {light}, {band}: FLIP {one['flip']:.3f}; at most {bounds['flip']:g}")
    return found


def table(results):
    """Markdown: a row for each picture and light; means, contrast and FLIP far / middle / near / all."""
    lines = ["| picture | light | mean / truth, far | middle | near | all | contrast, ours / truth | dark share | blue/green | FLIP (noise) |",
             "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"]
    for name, result in results.items():
        for light, bands in result.items():
            ratios = [f"{one['ours']['mean'] / max(one['truth']['mean'], 1e-12):.2f}" for one in bands.values()]
            whole = bands["all"]
            pair = lambda key, digits: f"{whole['ours'][key]:.{digits}f} / {whole['truth'][key]:.{digits}f}"
            lines.append(f"| {name} | {light} | {' | '.join(ratios)} | {pair('contrast', 2)} | {pair('dark', 2)} | "
                         f"{pair('blue_green', 3)} | {whole['flip']:.3f} ({whole['noise']:.3f}) |")
    return "\n".join(lines) + "\n"
