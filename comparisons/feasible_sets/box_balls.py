"""What the compiled evaluator does to a ball of floats: one channel of a weight, or of what rays may bring.

In the compiler's language. Nothing here is done by a renderer, and rounded. Of double-double balls these functions have
the same names (box_double_doubles.py).
"""

from __future__ import annotations

from raytruth.reference_tracer.arithmetics.float_ball_comparisons import certainly_less, equal
from raytruth.reference_tracer.arithmetics.float_balls import (
    LARGEST,
    Ball,
    add,
    below,
    from_zero_to,
    hull,
    lower,
    upper,
)


def is_finite(ball: Ball) -> bool:
    """Whether middle and radius are numbers."""
    return abs(ball.middle) <= LARGEST and ball.radius <= LARGEST


def exact_ball(value: float) -> Ball:
    """The number alone."""
    return Ball(value, 0.0)


def pixel_center(place: int, radius: float) -> Ball:
    """The image coordinate of a pixel's centre, or all within a radius of it."""
    return Ball(place + 0.5, radius)


def ball_sum(a: Ball, b: Ball) -> Ball:
    """All sums of numbers of two balls."""
    return add(a, b, 0.0)


def ball_hull(a: Ball, b: Ball) -> Ball:
    """A ball that holds both; one that is not finite, where one of them is not."""
    if not (is_finite(a) and is_finite(b)):
        return add(a, b, 0.0)
    least = min(lower(a), lower(b))
    return hull(least, max(upper(a), upper(b)))


def from_black(weight: Ball, factor: float) -> Ball:
    """All from 0 to a weight times a factor that is not negative; the product is rounded up, unless it is 0."""
    most = upper(weight)
    return from_zero_to(-below(-(most * factor)) if most != 0.0 and factor != 0.0 else 0.0)


def ball_common(ball: Ball, possible: Ball) -> Ball:
    """What a ball and one that surely holds the value have in common: the latter where the arithmetic broke down."""
    if not is_finite(ball) or equal(ball, possible) == 0:
        return possible
    least, most = max(lower(ball), lower(possible)), min(upper(ball), upper(possible))
    if least <= lower(ball) and upper(ball) <= most:
        return ball
    return hull(least, most) if least <= most else possible


def upper_end(ball: Ball) -> float:
    """A float that no number of the ball is above."""
    return upper(ball)


def is_under(ball: Ball, limit: float) -> bool:
    """Whether all of a ball is below a limit."""
    return certainly_less(ball, Ball(limit, 0.0))
