"""What the operations of the tracer's source are on the tape of linked numbers (linked_tape.py).

Each operation gives its value at the centres of its operands; the exact values over their ranges; and for each operand
a ball that holds the derivative by it over all values of both. So the mean value theorem holds for it between any two
points of the ranges, and so do chains of operations. Where the derivative jumps, as that of max does, the ball holds
the interval between those on both sides (Lebourg 1975). Where it has no bound, as that of a root at 0, it is unknown,
and what it is multiplied by is then enclosed by its range alone.
"""

from __future__ import annotations

from raytruth.reference_tracer.arithmetics import float_ball_comparisons as comparisons
from raytruth.reference_tracer.arithmetics import float_ball_functions as functions
from raytruth.reference_tracer.arithmetics import float_balls as balls
from raytruth.reference_tracer.arithmetics.float_ball_comparisons import UNDECIDED, WholeNumbers
from raytruth.reference_tracer.arithmetics.float_balls import UNKNOWN, Ball, lower, upper
from raytruth.reference_tracer.arithmetics.linked_tape import (
    MINUS_ONE,
    NO_LINK,
    ONE,
    ZERO,
    LinkedNumber,
    link_to,
    made,
    rounded,
)
from raytruth.reference_tracer.arithmetics.linked_tape_sweeps import box_of, difference
from raytruth.reference_tracer.compiler.questions import state

WITHIN_ONE = Ball(0.0, 1.0)
ZERO_TO_ONE = Ball(0.5, 0.5)


def center_of(number: LinkedNumber) -> Ball:
    """The number's value where nothing is rounded."""
    found: Ball = state().tape.centers[number.place]
    return found


def range_of(number: LinkedNumber) -> Ball:
    """A ball that holds all values of the number, as well as it is known yet."""
    found: Ball = state().tape.ranges[number.place]
    return found


def linked_sum(a: LinkedNumber, b: LinkedNumber) -> LinkedNumber:
    """A + b. The derivatives are 1."""
    center = balls.add(center_of(a), center_of(b), 0.0)
    return rounded(center, balls.add(range_of(a), range_of(b), 0.0), link_to(a, ONE), link_to(b, ONE))


def linked_difference(a: LinkedNumber, b: LinkedNumber) -> LinkedNumber:
    """A - b. The derivatives are 1 and -1."""
    center = balls.sub(center_of(a), center_of(b), 0.0)
    return rounded(center, balls.sub(range_of(a), range_of(b), 0.0), link_to(a, ONE), link_to(b, MINUS_ONE))


def linked_product(a: LinkedNumber, b: LinkedNumber) -> LinkedNumber:
    """a·b. The derivatives are b and a."""
    of_a, of_b = range_of(a), range_of(b)
    center = balls.mul(center_of(a), center_of(b), 0.0)
    return rounded(center, balls.mul(of_a, of_b, 0.0), link_to(a, of_b), link_to(b, of_a))


def linked_quotient(a: LinkedNumber, b: LinkedNumber) -> LinkedNumber:
    """a/b. The derivatives are 1/b and -a/b²; what may be 0 is looked at more closely."""
    of_b = range_of(b)
    if comparisons.equal(of_b, ZERO) != 0:
        of_b = box_of(b)
    inverse = balls.truediv(ONE, of_b, 0.0)
    exact = balls.truediv(range_of(a), of_b, 0.0)
    center = balls.truediv(center_of(a), center_of(b), 0.0)
    return rounded(center, exact, link_to(a, inverse), link_to(b, balls.neg(balls.mul(exact, inverse, 0.0))))


def linked_negative(a: LinkedNumber) -> LinkedNumber:
    """-a, which no arithmetic rounds. The derivative is -1."""
    return made(balls.neg(center_of(a)), balls.neg(range_of(a)), 0.0, link_to(a, MINUS_ONE), NO_LINK)


def linked_size(a: LinkedNumber) -> LinkedNumber:
    """|a|, which no arithmetic rounds. The derivative is 1 or -1; where a may be 0, anything between."""
    of_a = range_of(a)
    if lower(of_a) >= 0.0:
        return a
    if upper(of_a) <= 0.0:
        return linked_negative(a)
    return made(balls.absolute(center_of(a)), balls.absolute(of_a), 0.0, link_to(a, WITHIN_ONE), NO_LINK)


def linked_maximum(a: LinkedNumber, b: LinkedNumber) -> LinkedNumber:
    """max(a, b), which no arithmetic rounds. The derivatives are 1 and 0; where either may be larger, from 0 to 1."""
    of_a, of_b = range_of(a), range_of(b)
    if comparisons.less(of_a, of_b) == 0:
        return a
    if comparisons.less(of_b, of_a) == 0:
        return b
    center = comparisons.maximum(center_of(a), center_of(b))
    return made(center, comparisons.maximum(of_a, of_b), 0.0, link_to(a, ZERO_TO_ONE), link_to(b, ZERO_TO_ONE))


def linked_minimum(a: LinkedNumber, b: LinkedNumber) -> LinkedNumber:
    """min(a, b), as `linked_maximum`."""
    of_a, of_b = range_of(a), range_of(b)
    if comparisons.less(of_b, of_a) == 0:
        return a
    if comparisons.less(of_a, of_b) == 0:
        return b
    center = comparisons.minimum(center_of(a), center_of(b))
    return made(center, comparisons.minimum(of_a, of_b), 0.0, link_to(a, ZERO_TO_ONE), link_to(b, ZERO_TO_ONE))


def linked_root(a: LinkedNumber) -> LinkedNumber:
    """The root of max(a, 0). The derivative is 1/(2·√a); unknown where a may be 0.

    The source takes roots only of what it decided to be not negative.
    """
    of_a = range_of(a)
    if not lower(of_a) > 0.0:
        of_a = box_of(a)
    exact = _root_of_positive_part(of_a)
    slope = balls.truediv(ONE, balls.add(exact, exact, 0.0), 0.0) if lower(of_a) > 0.0 else UNKNOWN
    return rounded(_root_of_positive_part(center_of(a)), exact, link_to(a, slope), NO_LINK)


def _root_of_positive_part(a: Ball) -> Ball:
    return ZERO if upper(a) <= 0.0 else balls.sqrt(a, 0.0)


def linked_exponential(a: LinkedNumber) -> LinkedNumber:
    """The exponential, which is its own derivative."""
    exact = functions.exp(range_of(a), 0.0)
    return rounded(functions.exp(center_of(a), 0.0), exact, link_to(a, exact), NO_LINK)


def linked_tangent(a: LinkedNumber) -> LinkedNumber:
    """The tangent. The derivative is 1 + tan²."""
    exact = functions.tan(range_of(a), 0.0)
    slope = balls.add(ONE, balls.mul(exact, exact, 0.0), 0.0)
    return rounded(functions.tan(center_of(a), 0.0), exact, link_to(a, slope), NO_LINK)


def linked_power(base: LinkedNumber, exponent: LinkedNumber) -> LinkedNumber:
    """max(base, 0) ** exponent, for a positive exponent. The derivatives are e·b^(e - 1) and b^e·log b."""
    of_base, of_exponent = range_of(base), range_of(exponent)
    exact = functions.power(of_base, of_exponent, 0.0)
    center = functions.power(center_of(base), center_of(exponent), 0.0)
    by_exponent = link_to(exponent, UNKNOWN)
    if by_exponent.place >= 0 and lower(of_base) > 0.0:
        by_exponent = link_to(exponent, balls.mul(exact, functions.log(of_base), 0.0))
    return rounded(center, exact, link_to(base, _slope_of_power(of_base, of_exponent, exact)), by_exponent)


def _slope_of_power(base: Ball, exponent: Ball, power: Ball) -> Ball:
    """e·b^(e - 1) where b > 0, and 0 where b < 0; unknown where b may be 0 and e is not above 1.

    Where it may be either, it rises with b from 0 on, since e > 1.
    """
    less = balls.sub(exponent, ONE, 0.0)
    if lower(base) > 0.0:
        if lower(less) >= 0.0:
            return balls.mul(exponent, functions.power(base, less, 0.0), 0.0)
        if upper(less) <= 0.0:
            return balls.truediv(exponent, functions.power(base, balls.neg(less), 0.0), 0.0)
        return balls.truediv(balls.mul(exponent, power, 0.0), base, 0.0)
    if upper(base) <= 0.0:
        return ZERO
    if not lower(less) > 0.0:
        return UNKNOWN
    return balls.mul(exponent, functions.power(base, less, 0.0), 0.0)


def linked_floor(a: LinkedNumber) -> WholeNumbers:
    """What the whole number below a may be."""
    return comparisons.floor(box_of(a))


def linked_less(a: LinkedNumber, b: LinkedNumber) -> int:
    """Whether a < b: 1, 0, or UNDECIDED. What ranges leave open is looked at more closely."""
    known = comparisons.less(range_of(a), range_of(b))
    return known if known != UNDECIDED else comparisons.less(difference(a, b), ZERO)


def linked_less_or_equal(a: LinkedNumber, b: LinkedNumber) -> int:
    """Whether a ≤ b, as `linked_less`."""
    known = comparisons.less_or_equal(range_of(a), range_of(b))
    return known if known != UNDECIDED else comparisons.less_or_equal(difference(a, b), ZERO)


def linked_equal(a: LinkedNumber, b: LinkedNumber) -> int:
    """Whether a = b, as `linked_less`."""
    known = comparisons.equal(range_of(a), range_of(b))
    return known if known != UNDECIDED else comparisons.equal(difference(a, b), ZERO)


def certainly_less(a: LinkedNumber, b: LinkedNumber) -> bool:
    """Whether a < b for all values, as far as ranges tell."""
    return comparisons.certainly_less(range_of(a), range_of(b))


def certainly_zero(a: LinkedNumber) -> bool:
    """Whether a is 0 and nothing else."""
    return comparisons.certainly_zero(range_of(a))
