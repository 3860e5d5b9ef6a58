"""FLIP, the difference that an observer sees when he alternates two pictures: its formulas in NumPy.

Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström & Fairchild, "FLIP: A Difference Evaluator for Alternating Images",
HPG 2020 (sections below are its sections); Andersson, Nilsson, Shirley & Akenine-Möller, "Visualizing Errors in Rendered
High Dynamic Range Images", Eurographics 2021 (HDR-FLIP). docs/algorithms/truth.md

Pictures are arrays of height × width × 3: linear light with the primaries of sRGB. A result is height × width in [0, 1].
"""

import math

import numpy as np

# The observer of the paper: 0.7 m from a screen that is 0.7 m and 3840 pixels wide.
PIXELS_PER_DEGREE = 67.0

# IEC 61966-2-1: linear red, green, blue to X, Y, Z.
TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375],
                   [0.2126729, 0.7151522, 0.0721750],
                   [0.0193339, 0.1191920, 0.9503041]])
FROM_XYZ = np.linalg.inv(TO_XYZ)
WHITE = TO_XYZ.sum(axis=1)  # of red = green = blue = 1

# Section 4.1, table 1: contrast sensitivity as sums of a·exp(−b·f²), as (a, b) of each: achromatic, red-green, blue-yellow.
SENSITIVITY = [[(1.0, 0.0047)], [(1.0, 0.0053)], [(34.1, 0.04), (13.5, 0.025)]]

COLOR_POWER = 0.7       # q_c, section 4.1.3
COLOR_KNEE = 0.4        # p_c: this share of the largest error …
COLOR_KNEE_ERROR = 0.95  # p_t: … becomes this error
FEATURE_WIDTH = 0.082   # w [degrees] of an edge, section 4.2
FEATURE_POWER = 0.5     # q_f

# HDR-FLIP, section 3: exposures between which a tone-mapped picture is compared, and the tone mapper (ACES as fitted by
# K. Narkowicz 2015, its input times 0.6): (k0 x² + k1 x + k2) / (k3 x² + k4 x + k5).
BRIGHTEST = 0.85  # tone-mapped luminance of the largest luminance at the first exposure, and of the median at the last
TONE = (0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14)


def to_linear(encoded):
    """Linear light of sRGB-encoded values in [0, 1]."""
    encoded = np.asarray(encoded, float)
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def opponent(linear):
    """YyCxCz: linear functions of light, in which contrast sensitivity is known. Section 4.1.1."""
    x, y, z = np.moveaxis(linear @ TO_XYZ.T / WHITE, -1, 0)
    return np.stack([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)], axis=-1)


def from_opponent(color):
    """The inverse of opponent()."""
    y = (color[..., 0] + 16.0) / 116.0
    xyz = np.stack([y + color[..., 1] / 500.0, y, y - color[..., 2] / 200.0], axis=-1)
    return xyz * WHITE @ FROM_XYZ.T


def lab(linear):
    """CIE L*a*b* relative to white."""
    xyz = linear @ TO_XYZ.T / WHITE
    low = 6.0 / 29.0
    f = np.where(xyz > low ** 3, np.cbrt(xyz), xyz / (3.0 * low ** 2) + 4.0 / 29.0)
    return np.stack([116.0 * f[..., 1] - 16.0, 500.0 * (f[..., 0] - f[..., 1]), 200.0 * (f[..., 1] - f[..., 2])], axis=-1)


def hunted(color):
    """L*a*b* with the Hunt effect: colours of dark places look less saturated. Section 4.1.2."""
    light = color[..., :1]
    return np.concatenate([light, 0.01 * light * color[..., 1:]], axis=-1)


def hyab(a, b):
    """Distance of large differences between colours in L*a*b* (Abasi et al. 2020). Section 4.1.2."""
    d = a - b
    return np.abs(d[..., 0]) + np.hypot(d[..., 1], d[..., 2])


def largest_color_error():
    """HyAB between green and blue to the power q_c: the largest of all colours of sRGB. Section 4.1.3."""
    green, blue = (hunted(lab(np.array(color))) for color in ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]))
    return hyab(green, blue) ** COLOR_POWER


def redistributed(distance):
    """Colour error in [0, 1] of a HyAB distance: small differences get most of the range. Section 4.1.3."""
    power, largest = distance ** COLOR_POWER, largest_color_error()
    knee = COLOR_KNEE * largest
    return np.where(power < knee, COLOR_KNEE_ERROR / knee * power,
                    COLOR_KNEE_ERROR + (power - knee) / (largest - knee) * (1.0 - COLOR_KNEE_ERROR))


def along(image, weights, axis):
    """`image` convolved with symmetric or antisymmetric `weights` along an axis; its rim continues."""
    radius = len(weights) // 2
    pad = [(0, 0)] * image.ndim
    pad[axis] = (radius, radius)
    padded, length = np.pad(image, pad, mode="edge"), image.shape[axis]
    result = np.zeros_like(image)
    for i, weight in enumerate(weights):
        result += weight * np.take(padded, range(i, i + length), axis=axis)
    return result


def seen_color(linear, ppd):
    """What the eye resolves of the colours, in YyCxCz. Section 4.1.1.

    exp(−b f²) in the frequency domain is √(π/b)·exp(−π² x²/b) in the plane; x [degrees].
    """
    image = opponent(linear)
    widest = max(b for terms in SENSITIVITY for _, b in terms)
    radius = math.ceil(3.0 * math.sqrt(widest / (2.0 * math.pi ** 2)) * ppd)
    x = np.arange(-radius, radius + 1) / ppd
    result = np.empty_like(image)
    for channel, terms in enumerate(SENSITIVITY):
        lines = [(a * math.sqrt(math.pi / b), np.exp(-math.pi ** 2 * x ** 2 / b)) for a, b in terms]
        whole = sum(a * line.sum() ** 2 for a, line in lines)
        result[..., channel] = sum(a / whole * along(along(image[..., channel], line, 0), line, 1) for a, line in lines)
    return result


def color_error(reference, test, ppd):
    """Section 4.1."""
    seen = [hunted(lab(np.clip(from_opponent(seen_color(picture, ppd)), 0.0, 1.0))) for picture in (reference, test)]
    return redistributed(hyab(*seen))


def features(lightness, ppd):
    """Strength of edges and of points at each pixel of an achromatic picture in [0, 1]. Section 4.2."""
    deviation = 0.5 * FEATURE_WIDTH * ppd
    radius = math.ceil(3.0 * deviation)
    x = np.arange(-radius, radius + 1, dtype=float)
    bell = np.exp(-x ** 2 / (2.0 * deviation ** 2))
    strengths = []
    for across in (-x * bell, (x ** 2 / deviation ** 2 - 1.0) * bell):
        # Positive weights sum to 1 and negative ones to −1.
        across = np.where(across > 0.0, across / across[across > 0.0].sum(), across / -across[across < 0.0].sum())
        line = bell / bell.sum()
        strengths.append(np.hypot(along(along(lightness, across, 1), line, 0), along(along(lightness, across, 0), line, 1)))
    return strengths


def feature_error(reference, test, ppd):
    """Section 4.2."""
    of = [features((opponent(picture)[..., 0] + 16.0) / 116.0, ppd) for picture in (reference, test)]
    edges, points = (np.abs(of[0][kind] - of[1][kind]) for kind in (0, 1))
    return np.clip(np.maximum(edges, points) / math.sqrt(2.0), 0.0, 1.0) ** FEATURE_POWER


def requires_alike(reference, test):
    if reference.shape != test.shape or reference.ndim != 3 or reference.shape[2] != 3:
        raise ValueError(f"pictures of {reference.shape} and {test.shape}; expected height × width × 3, alike")


def flip(reference, test, ppd=PIXELS_PER_DEGREE):
    """FLIP at each pixel of two pictures in linear light, in [0, 1]; what lies beyond is cut off. Section 4.3."""
    reference, test = (np.clip(np.asarray(picture, float), 0.0, 1.0) for picture in (reference, test))
    requires_alike(reference, test)
    return color_error(reference, test, ppd) ** (1.0 - feature_error(reference, test, ppd))


def tone_mapped(linear):
    k0, k1, k2, k3, k4, k5 = TONE
    return np.clip((k0 * linear ** 2 + k1 * linear + k2) / (k3 * linear ** 2 + k4 * linear + k5), 0.0, 1.0)


def exposure_range(reference):
    """First and last exposure [stops] for a reference, and their number. HDR-FLIP, section 3.

    The tone mapper gives BRIGHTEST to the largest luminance at the first, to the median at the last.
    """
    k0, k1, k2, k3, k4, k5 = TONE
    a, b, c = k0 - BRIGHTEST * k3, k1 - BRIGHTEST * k4, k2 - BRIGHTEST * k5
    bright = (-b + math.sqrt(b * b - 4.0 * a * c)) / (2.0 * a)
    luminance = np.asarray(reference, float) @ TO_XYZ[1]
    largest, median = float(luminance.max()), float(np.median(luminance))
    if largest <= 0.0:
        return 0.0, 0.0, 1
    # More than half of the picture may be black.
    first, last = math.log2(bright / largest), math.log2(bright / max(median, largest * 2.0 ** -16))
    return first, last, max(2, math.ceil(last - first))


def hdr_flip(reference, test, ppd=PIXELS_PER_DEGREE):
    """HDR-FLIP at each pixel of two pictures in linear light ≥ 0: the largest FLIP of all exposures."""
    reference, test = (np.maximum(np.asarray(picture, float), 0.0) for picture in (reference, test))
    requires_alike(reference, test)
    result = np.zeros(reference.shape[:2])
    for exposure in np.linspace(*exposure_range(reference)):
        shown = [tone_mapped(2.0 ** exposure * picture) for picture in (reference, test)]
        result = np.maximum(result, flip(*shown, ppd))
    return result
