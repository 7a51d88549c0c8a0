"""Feasible sets made by hand."""

from __future__ import annotations

import numpy as np

from raytruth.comparisons.feasible_sets.feasible_set import HIT_VALUES, UNUSED, FeasibleSet

Box = tuple[float, float]


def boxes(*pixels: list[Box]) -> FeasibleSet:
    """One row of pixels; each outcome is the same range in all three channels. Nothing is hit."""
    most = max(1, *(len(pixel) for pixel in pixels))
    low = np.full((1, len(pixels), most, 3), np.nan)
    high = low.copy()
    for x, pixel in enumerate(pixels):
        for place, (lowest, highest) in enumerate(pixel):
            low[0, x, place], high[0, x, place] = lowest, highest
    nowhere = np.full((1, len(pixels), 1, HIT_VALUES), np.nan)
    nothing = np.full((1, len(pixels), 1), -1)
    return FeasibleSet(low, high, np.zeros((1, len(pixels)), bool), nothing, nowhere, nowhere)


def hits(*pixels: list[tuple[int, Box]]) -> FeasibleSet:
    """One row of pixels; each hit is a primitive and the range of all of its seven values."""
    most = max(1, *(len(pixel) for pixel in pixels))
    primitives = np.full((1, len(pixels), most), UNUSED)
    low = np.full((1, len(pixels), most, HIT_VALUES), np.nan)
    high = low.copy()
    for x, pixel in enumerate(pixels):
        for place, (primitive, (lowest, highest)) in enumerate(pixel):
            primitives[0, x, place] = primitive
            if primitive >= 0:
                low[0, x, place], high[0, x, place] = lowest, highest
    color = np.ones((1, len(pixels), 1, 3))
    return FeasibleSet(color, color, np.zeros((1, len(pixels)), bool), primitives, low, high)
