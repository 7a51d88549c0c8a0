"""Boxes of colours in balls of floats: what the rays of a pixel's tree may bring, in the compiler's language.

They hold what feasible_pixel.py says of the same boxes in Arb's balls. Nothing here is done by a renderer, and rounded.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reference_tracer.arithmetics.float_ball_comparisons import certainly_less, equal
from raytruth.reference_tracer.arithmetics.float_balls import (
    LARGEST,
    OUTWARD,
    Ball,
    add,
    from_zero_to,
    hull,
    lower,
    upper,
)

if TYPE_CHECKING:
    Box = tuple[Ball, Ball, Ball]
    """A ball for each channel."""


def is_finite(ball: Ball) -> bool:
    """Whether middle and radius are numbers."""
    return abs(ball.middle) <= LARGEST and ball.radius <= LARGEST


def box_is_finite(box: Box) -> bool:
    """Whether all channels are."""
    return is_finite(box[0]) and is_finite(box[1]) and is_finite(box[2])


def box_sum(a: Box, b: Box) -> Box:
    """All sums of colours of two boxes."""
    return (add(a[0], b[0], 0.0), add(a[1], b[1], 0.0), add(a[2], b[2], 0.0))


def ball_hull(a: Ball, b: Ball) -> Ball:
    """A ball that holds both; anything, where one is not finite."""
    if not (is_finite(a) and is_finite(b)):
        return add(a, b, 0.0)
    least = min(lower(a), lower(b))
    return hull(least, max(upper(a), upper(b)))


def box_hull(a: Box, b: Box) -> Box:
    """A box that holds both."""
    return (ball_hull(a[0], b[0]), ball_hull(a[1], b[1]), ball_hull(a[2], b[2]))


def from_black(weight: Ball, factor: float) -> Ball:
    """All from 0 to a weight times a factor that is not negative; the product is rounded up."""
    return from_zero_to(upper(weight) * factor * OUTWARD)


def box_from_black(weight: Box, factor: float) -> Box:
    """The same of each channel."""
    return (from_black(weight[0], factor), from_black(weight[1], factor), from_black(weight[2], factor))


def common(ball: Ball, possible: Ball) -> Ball:
    """What a ball and one that surely holds the value have in common: the latter where the arithmetic broke down."""
    if not is_finite(ball) or equal(ball, possible) == 0:
        return possible
    least = max(lower(ball), lower(possible))
    most = min(upper(ball), upper(possible))
    if least <= lower(ball) and upper(ball) <= most:
        return ball
    if not least <= most:
        return possible
    return hull(least, most)


def box_common(box: Box, possible: Box) -> Box:
    """The same of each channel."""
    return (common(box[0], possible[0]), common(box[1], possible[1]), common(box[2], possible[2]))


def heaviest(weight: Box) -> float:
    """The largest that a channel may be; infinite where nothing is known."""
    if not box_is_finite(weight):
        return 1e999
    return max(upper(weight[0]), upper(weight[1]), upper(weight[2]))


def is_below(weight: Box, limit: float) -> bool:
    """Whether all channels certainly are."""
    least = Ball(limit, 0.0)
    return certainly_less(weight[0], least) and certainly_less(weight[1], least) and certainly_less(weight[2], least)


def pixel_center(place: int, radius: float) -> Ball:
    """The image coordinate of a pixel's centre, or all within a radius of it."""
    return Ball(place + 0.5, radius)
