"""The film of a picture, film_curve.h, and its inverse."""

import numpy as np


def filmed(radiance):
    """Of radiance times exposure: the film's linear light."""
    x = 0.80 * radiance
    return np.clip((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0)


def unfilmed(shown):
    """Radiance times exposure from the film's linear light."""
    f = np.minimum(shown, 0.9999)
    a, b, c = 2.51 - 2.43 * f, 0.03 - 0.59 * f, -0.14 * f
    return (-b + np.sqrt(b * b - 4.0 * a * c)) / (2.0 * a) / 0.80
