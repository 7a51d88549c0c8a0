"""Boxes of colours, a ball for each channel: what the rays of a pixel's tree may bring.

Part of the text of a kernel, as followed_rays.py is. They are what feasible_pixel.py says of boxes in Arb's balls.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.feasible_sets.box_balls import (
    ball_common,
    ball_hull,
    ball_sum,
    from_black,
    is_finite,
    is_under,
    upper_end,
)

if TYPE_CHECKING:
    from raytruth.reference_tracer.arithmetics.float_balls import Ball

    Box = tuple[Ball, Ball, Ball]
    """A ball for each channel."""


def box_is_finite(box: Box) -> bool:
    """Whether all channels are."""
    return is_finite(box[0]) and is_finite(box[1]) and is_finite(box[2])


def box_sum(a: Box, b: Box) -> Box:
    """All sums of colours of two boxes."""
    return (ball_sum(a[0], b[0]), ball_sum(a[1], b[1]), ball_sum(a[2], b[2]))


def box_hull(a: Box, b: Box) -> Box:
    """A box that holds both."""
    return (ball_hull(a[0], b[0]), ball_hull(a[1], b[1]), ball_hull(a[2], b[2]))


def box_from_black(weight: Box, factor: float) -> Box:
    """From black to a weight times a factor."""
    return (from_black(weight[0], factor), from_black(weight[1], factor), from_black(weight[2], factor))


def box_common(box: Box, possible: Box) -> Box:
    """What a box and one that surely holds the value have in common."""
    red, green = ball_common(box[0], possible[0]), ball_common(box[1], possible[1])
    return (red, green, ball_common(box[2], possible[2]))


def heaviest(weight: Box) -> float:
    """The largest that a channel may be; infinite where nothing is known."""
    if not box_is_finite(weight):
        return 1e999
    most = upper_end(weight[0])
    for channel in range(1, 3):
        end = upper_end(weight[channel])
        most = end if end > most else most
    return most


def box_is_under(weight: Box, limit: float) -> bool:
    """Whether all channels are below a limit."""
    return is_under(weight[0], limit) and is_under(weight[1], limit) and is_under(weight[2], limit)
