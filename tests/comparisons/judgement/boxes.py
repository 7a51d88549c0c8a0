"""Feasible sets made by hand."""

from __future__ import annotations

import numpy as np

from raytruth.comparisons.feasible_sets.feasible_set import HIT_VALUES, UNUSED, FeasibleSet

Box = tuple[float, float]


def boxes(*pixels: list[Box], declared: frozenset[Box] = frozenset()) -> FeasibleSet:
    """One row of pixels; each outcome is the same range in all three channels. Nothing is hit.

    The ranges `declared` are those that only a shortcut leads to.
    """
    most = max(1, *(len(pixel) for pixel in pixels))
    low = np.full((1, len(pixels), most, 3), np.nan)
    high = low.copy()
    due = np.ones((1, len(pixels), most), bool)
    for x, pixel in enumerate(pixels):
        for place, (lowest, highest) in enumerate(pixel):
            low[0, x, place], high[0, x, place] = lowest, highest
            due[0, x, place] = (lowest, highest) not in declared
    nowhere = np.full((1, len(pixels), 1, HIT_VALUES), np.nan)
    nothing = np.full((1, len(pixels), 1), -1)
    merged = np.zeros((1, len(pixels)), bool)
    return FeasibleSet(low, high, due, merged, nothing, nowhere, nowhere, np.ones((1, len(pixels), 1), bool))


def hits(*pixels: list[tuple[int, Box]], declared: frozenset[int] = frozenset()) -> FeasibleSet:
    """One row of pixels; each hit is a primitive and the range of all of its seven values.

    Only a shortcut leads to the primitives `declared`.
    """
    most = max(1, *(len(pixel) for pixel in pixels))
    primitives = np.full((1, len(pixels), most), UNUSED)
    low = np.full((1, len(pixels), most, HIT_VALUES), np.nan)
    high = low.copy()
    for x, pixel in enumerate(pixels):
        for place, (primitive, (lowest, highest)) in enumerate(pixel):
            primitives[0, x, place] = primitive
            if primitive >= 0:
                low[0, x, place], high[0, x, place] = lowest, highest
    color, one = np.ones((1, len(pixels), 1, 3)), np.ones((1, len(pixels), 1), bool)
    due = ~np.isin(primitives, list(declared))
    return FeasibleSet(color, color, one, np.zeros((1, len(pixels)), bool), primitives, low, high, due)
