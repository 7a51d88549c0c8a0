"""The functions of box_balls.py for double-double balls. What is wide has the digits of one float."""

from __future__ import annotations

from raytruth.comparisons.feasible_sets import box_balls
from raytruth.reference_tracer.arithmetics.double_double_balls import (
    DoubleDoubleBall,
    add,
    from_float_ball,
    to_float_ball,
)
from raytruth.reference_tracer.arithmetics.double_double_comparisons import certainly_less


def is_finite(ball: DoubleDoubleBall) -> bool:
    """Whether middle and radius are numbers."""
    return box_balls.is_finite(to_float_ball(ball))


def exact_ball(value: float) -> DoubleDoubleBall:
    """The number alone."""
    return DoubleDoubleBall(value, 0.0, 0.0)


def pixel_center(place: int, radius: float) -> DoubleDoubleBall:
    """The image coordinate of a pixel's centre, or all within a radius of it."""
    return DoubleDoubleBall(place + 0.5, 0.0, radius)


def ball_sum(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """All sums of numbers of two balls."""
    return add(a, b, 0.0)


def ball_hull(a: DoubleDoubleBall, b: DoubleDoubleBall) -> DoubleDoubleBall:
    """A ball that holds both; one that is not finite, where one of them is not."""
    return from_float_ball(box_balls.ball_hull(to_float_ball(a), to_float_ball(b)))


def from_black(weight: DoubleDoubleBall, factor: float) -> DoubleDoubleBall:
    """All from 0 to a weight times a factor that is not negative; the product is rounded up, unless it is 0."""
    return from_float_ball(box_balls.from_black(to_float_ball(weight), factor))


def ball_common(ball: DoubleDoubleBall, possible: DoubleDoubleBall) -> DoubleDoubleBall:
    """What a ball and one that surely holds the value have in common: the latter where the arithmetic broke down."""
    whole = to_float_ball(ball)
    part = box_balls.ball_common(whole, to_float_ball(possible))
    if part.middle == whole.middle and part.radius == whole.radius:
        return ball
    return from_float_ball(part)


def upper_end(ball: DoubleDoubleBall) -> float:
    """A float that no number of the ball is above."""
    return box_balls.upper_end(to_float_ball(ball))


def is_under(ball: DoubleDoubleBall, limit: float) -> bool:
    """Whether all of a ball is below a limit."""
    return certainly_less(ball, DoubleDoubleBall(limit, 0.0, 0.0))
