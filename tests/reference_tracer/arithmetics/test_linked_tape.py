"""Linked numbers on a tape hold what a renderer may compute, and are as narrow as Arb's linked balls."""

from __future__ import annotations

import itertools
import operator
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, ctx
from hypothesis import event, given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics.balls import Decisions
from raytruth.reference_tracer.arithmetics.float_ball_comparisons import UNDECIDED
from raytruth.reference_tracer.arithmetics.float_balls import LARGEST, Ball
from raytruth.reference_tracer.arithmetics.linked_arithmetic import linked_arithmetic
from raytruth.reference_tracer.arithmetics.linked_balls import condensed, difference, enclosure, with_own_symbol
from raytruth.reference_tracer.arithmetics.linked_tape import FIRST_REACHED, NOTHING
from tests.reference_tracer.arithmetics.ball_draws import EXACT_BITS as SUMS_BITS
from tests.reference_tracer.arithmetics.ball_draws import SPECIAL_BALLS, holds
from tests.reference_tracer.arithmetics.tapes import OF_ONE, OF_TWO, Tape
from tests.reference_tracer.kernels import kept_precision

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from raytruth.reference_tracer.arithmetics.linked_balls import LinkedBall

pytestmark = pytest.mark.clause("ARI-4", "ARI-11")

BITS = 24
ROUNDOFF = 2.0**-BITS
EXACT_BITS = 300
"""So far beyond the roundoff, that the samples may be taken for exact."""
ROOM = 6
"""How many numbers are condensed at once: those of a ray."""

ALL_BITS = {"+", "-", "*", "min", "max", "abs", "neg", "own"}
"""Operations whose exact results have so many bits as to be known exactly."""

Step = tuple[str, int, int]
"""An operation, and which two of the numbers so far it is done on."""


@pytest.fixture(autouse=True, scope="module")
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def run(steps: Sequence[Step], inputs: Sequence[Any], result: Callable[..., Any], condense: Callable[..., Any]) -> Any:
    """The inputs, and the results of all steps, or of those since numbers were condensed."""
    numbers = list(inputs)
    for name, first, second in steps:
        if name == "condense":
            numbers = condense(numbers[-ROOM:])
        else:
            numbers.append(result(name, numbers[first % len(numbers)], numbers[second % len(numbers)]))
    return numbers


def of_arb(made: Any) -> Callable[..., LinkedBall]:
    """The operations over Arb's linked balls, by name."""
    functions: dict[str, Any] = {
        "+": operator.add,
        "-": operator.sub,
        "*": operator.mul,
        "/": operator.truediv,
        "abs": lambda a, _: abs(a),
        "neg": lambda a, _: -a,
        "own": lambda a, _: with_own_symbol(a),
        **{name: made.functions[name] for name in ("min", "max", "power")},
        **{name: lambda a, _, name=name: made.functions[name](a) for name in ("sqrt", "exp", "tan")},
    }
    return lambda name, a, b: functions[name](a, b)


def sampled(deltas: Iterator[float]) -> Callable[..., Any]:
    """The operations at points; each result is rounded by the next of some relative errors."""

    def exact(name: str, a: Any, b: Any) -> Any:
        if name == "sqrt":
            return a.sqrt() if a > 0 else a * 0
        if name == "power":
            return a**b if a > 0 else a * 0
        if name in {"min", "max"}:
            return getattr(a, name)(b)
        return {
            "+": lambda: a + b,
            "-": lambda: a - b,
            "*": lambda: a * b,
            "/": lambda: a / b,
            "exp": a.exp,
            "tan": a.tan,
            "abs": lambda: abs(a),
            "neg": lambda: -a,
            "own": lambda: a,
        }[name]()

    def result(name: str, a: Any, b: Any) -> Any:
        value = exact(name, a, b) if name in ALL_BITS else within(EXACT_BITS, lambda: exact(name, a, b))
        return value if name in {"min", "max", "abs", "neg", "own"} else value * (1 + arb(next(deltas)) * ROUNDOFF)

    return result


MIDDLES = st.floats(-100, 100, width=32) | st.integers(-3, 3).map(float)


def inputs_of(*radii: float) -> st.SearchStrategy[list[Ball]]:
    return st.lists(st.builds(Ball, MIDDLES, st.sampled_from([0.0, 0.0, *radii])), min_size=2, max_size=4)


INPUTS = inputs_of(2.0**-24, 2.0**-10, 0.5)
# Of wide balls exponentials and quotients are up to 1/32 wider than they need be, each (float_balls.py).
NARROW_INPUTS = inputs_of(2.0**-24, 2.0**-10)
NAMES = [*OF_TWO, *OF_ONE, "condense", "+", "-", "*", "*", "sqrt"]
STEPS = st.lists(st.tuples(st.sampled_from(NAMES), st.integers(0, 99), st.integers(0, 99)), min_size=1, max_size=16)
PLACES_IN_BALLS = st.lists(st.floats(-1, 1) | st.sampled_from([-1.0, 1.0]), min_size=4, max_size=4)
DELTAS = st.lists(st.floats(-1, 1) | st.sampled_from([-1.0, 1.0]), min_size=16, max_size=16)


def on_tape(
    steps: Sequence[Step], inputs: Sequence[Ball], roundoff: float = ROUNDOFF
) -> tuple[Tape, list[int], list[Step]]:
    """A tape whose first inputs are constants; the numbers; and the steps, those at no tame numbers replaced."""
    constants = len(inputs) // 2
    tape = Tape(roundoff, inputs[:constants])
    places = [*range(constants), *map(tape.put, inputs[constants:])]
    taken = iter(steps)
    tamed: list[Step] = []

    def result(name: str, a: int, b: int) -> int:
        step = next(each for each in taken if each[0] != "condense")
        tame = is_tame(name, tape.range(a), tape.range(b))
        tamed.append(step if tame else ("neg", *step[1:]))
        return tape.operate(tamed[-1][0], a, b)

    def condense(numbers: list[int]) -> list[int]:
        tamed.append(("condense", 0, 0))
        return tape.condensed(numbers)

    return tape, run(steps, places, result, condense), tamed


def is_tame(name: str, a: Ball, b: Ball) -> bool:
    """Whether an operation has no reason to overflow, or to take a number for what it is not meant for."""
    largest = abs(a.middle) + a.radius
    if name == "power":
        least, most = b.middle - b.radius, b.middle + b.radius
        return largest < 100.0 and (
            1.0 <= least < most < 20.0 or 0.0 < least < most <= 1.0 or 0.0 < least == most < 20.0
        )
    if name == "tan":
        return largest < 1.5
    if name == "exp":
        return largest < 50.0
    return all(abs(ball.middle) + ball.radius < 1e30 for ball in (a, b))


@given(STEPS, INPUTS, PLACES_IN_BALLS, DELTAS)
def test_boxes_and_ranges_hold_whatever_a_renderer_may_compute(
    steps: list[Step], inputs: list[Ball], places: list[float], deltas: list[float]
) -> None:
    tape, numbers, steps = on_tape(steps, inputs)
    ctx.prec = EXACT_BITS
    points = [arb(ball.middle) + arb(ball.radius) * arb(part) for ball, part in zip(inputs, places, strict=False)]
    values = run(steps, points, sampled(iter(deltas)), list)
    bounded = 0
    for number, value in zip(numbers, values, strict=True):
        assert value.is_finite() or not tape.range(number).radius <= LARGEST
        found = tape.range(number), tape.box(number)
        bounded += found[1].radius <= LARGEST
        for ball in found:
            assert not value.is_finite() or holds_closely(ball, value), (steps, inputs, ball, value)
    event(f"most are bounded: {bounded > len(numbers) / 2}")
    for number, value in zip(numbers, values, strict=True):
        apart = tape.compare(number, numbers[0]).difference
        assert not value.is_finite() or holds_closely(apart, value - values[0])


def within(bits: int, function: Callable[[], Any]) -> Any:
    """What is irrational is known to some of the bits that sums and products of all floats need."""
    with ctx.workprec(min(bits, ctx.prec)):
        return function()


def holds_closely(ball: Ball, value: Any) -> bool:
    """Whether a ball holds a value that is known but for the last of its bits."""
    return holds(ball, value.mid()) or bool(abs(value.mid() - arb(ball.middle)) <= arb(ball.radius) + value.rad())


@given(STEPS, NARROW_INPUTS)
def test_boxes_are_hardly_wider_than_arbs(steps: list[Step], inputs: list[Ball]) -> None:
    tape, numbers, steps = on_tape(steps, inputs)
    made = linked_arithmetic(BITS, Decisions())
    with made.in_force():
        arbs = run(steps, [made.functions["ball"](arb(*ball)) for ball in inputs], of_arb(made), condensed)
        enclosures = [enclosure(number) for number in arbs]
        differences = [difference(number, arbs[0]) for number in arbs]
    for number, expected, apart in zip(numbers, enclosures, differences, strict=True):
        if expected.is_finite():
            assert_as_narrow(tape.box(number), expected, [tape.range(number)])
        if apart.is_finite():
            ranges = [tape.range(number), tape.range(numbers[0])]
            assert_as_narrow(tape.compare(number, numbers[0]).difference, apart, ranges)


def assert_as_narrow(ball: Ball, expected: Any, ranges: list[Ball]) -> None:
    """The radius is Arb's or 1/20 more, but for some roundings of what it comes from: Arb's has three bits more."""
    assert expected.overlaps(arb(ball.middle, ball.radius))
    rounding = 64 * 2.0**-53 * sum(abs(each.middle) + each.radius for each in ranges)
    assert ball.radius <= 1.05 * float(expected.rad()) + rounding + 1e-300, (ball, expected)


@pytest.mark.parametrize("name", [*OF_TWO, *OF_ONE])
def test_operations_hold_the_values_at_infinities_denormals_zeros_and_nan(name: str) -> None:
    ctx.prec = SUMS_BITS
    tape = Tape(ROUNDOFF)
    for place, a in enumerate(SPECIAL_BALLS):
        for b in SPECIAL_BALLS[place % 4 :: 4] if name in OF_TWO else SPECIAL_BALLS[:1]:
            tape.forget()
            start = tape.put(a), tape.put(b)
            holding = tape.range(tape.operate(name, *start))
            (kept,) = tape.condensed([tape.operate(name, *start)])
            deltas = itertools.cycle([-1.0, 1.0, 1.0])
            for x, y in itertools.product(ends(a), ends(b)):
                value = sampled(deltas)(name, x, y)
                for ball in (holding, tape.box(kept)):
                    assert not value.is_finite() or holds_closely(ball, value), (name, a, b, ball, value)


def ends(ball: Ball) -> list[Any]:
    """Some exact points of a ball."""
    if ball.radius == 0.0 or not abs(ball.middle) <= LARGEST:
        return [arb(ball.middle)]
    reach = arb(min(ball.radius, LARGEST))
    return [arb(ball.middle) - reach, arb(ball.middle), arb(ball.middle) + reach]


@given(STEPS, INPUTS)
def test_a_sweep_leaves_nothing_behind(steps: list[Step], inputs: list[Ball]) -> None:
    tape, numbers, _ = on_tape(steps, inputs)
    before = str([tape.box(number) for number in numbers])  # NaN is written alike, if it is not equal to itself
    for number in numbers:
        tape.compare(number, numbers[-1])
    assert not tape.arrays.derivatives.any()
    assert (tape.arrays.reached == NOTHING).all()
    assert tape.arrays.counts[FIRST_REACHED] == tape.arrays.capacity.constants
    assert str([tape.box(number) for number in numbers]) == before


def test_an_error_that_two_numbers_share_counts_once_and_so_does_that_of_a_constant() -> None:
    tape = Tape(ROUNDOFF, [Ball(3.0, 0.5)])
    total = tape.operate("+", tape.put(Ball(2.0, 0.25)), 0)
    apart = tape.operate("-", tape.operate("-", total, 0), 0)
    assert tape.range(apart).radius > 1.2
    assert tape.box(apart).radius == pytest.approx(0.5 + 0.25, abs=20 * ROUNDOFF)  # 2 ± 0.25, less a constant of ± 0.5
    assert tape.compare(total, total).difference == Ball(0.0, 0.0)
    assert tape.compare(tape.operate("+", total, 0), total)[1:4] == (0, 0, 0)


def test_a_comparison_that_ranges_leave_open_is_decided_by_what_the_numbers_share() -> None:
    tape = Tape(ROUNDOFF)
    x, step, zero = tape.put(Ball(0.0, 1.0)), tape.put(Ball(0.1875, 0.0625)), tape.put(Ball(0.0, 0.0))
    y = tape.operate("+", x, step)
    assert tape.compare(x, y)[1:4] == (1, 1, 0)
    assert tape.compare(y, x)[1:4] == (0, 0, 0)
    assert not tape.compare(x, y).certainly_less
    assert tape.compare(x, zero)[1:4] == (UNDECIDED,) * 3
    assert tape.compare(zero, zero)[1:4] == (0, 1, 1)
    assert tape.compare(zero, x).certainly_zero
    assert tape.compare(zero, step).certainly_less


def test_the_whole_number_below_is_that_of_the_tight_enclosure() -> None:
    tape = Tape(ROUNDOFF)
    x = tape.put(Ball(0.0, 1.0))
    half = tape.operate("-", tape.operate("+", tape.put(Ball(2.5, 0.0)), x), x)
    assert tape.compare(half, x)[-2:] == (2, 1)
    assert tape.compare(tape.operate("*", x, half), x)[-1] == 0


def test_a_rotation_repeated_a_hundred_times_grows_the_error_in_proportion() -> None:
    # Intervals wrap: they grow by cos + sin = 1.4 each time, to 1e14 times their size.
    tape = Tape(ROUNDOFF, symbols=700)
    x, y = tape.put(Ball(1.0, 0.0)), tape.put(Ball(0.5, 0.0))
    for _ in range(100):
        root = tape.operate("sqrt", tape.put(Ball(0.5, 0.0)))
        turned = tape.operate("*", root, x), tape.operate("*", root, y)
        x, y = tape.condensed([tape.operate("-", *turned), tape.operate("+", *turned)])
    assert not tape.is_full
    assert ROUNDOFF < tape.box(x).radius < 2000 * ROUNDOFF


@given(st.integers(1, 30), STEPS, INPUTS)
def test_a_full_tape_says_so_and_writes_nothing_beyond_its_end(
    room: int, steps: list[Step], inputs: list[Ball]
) -> None:
    tape = Tape(ROUNDOFF, inputs[:1], numbers=room, symbols=room)
    ample = Tape(ROUNDOFF, inputs[:1])
    tape.arrays = small = ample.arrays._replace(capacity=tape.arrays.capacity._replace(rows=room // 6, row_slopes=room))
    results = []
    for each in (tape, ample := Tape(ROUNDOFF, inputs[:1])):
        places = [0, *map(each.put, inputs[1:])]
        numbers = run(steps, places, each.operate, each.condensed)
        results.append([each.box(number) for number in numbers])
    end, symbols, rows, slopes = small.capacity[1:]
    for name in ("centers", "ranges", "errors", "links", "slopes", "is_tight"):
        assert not getattr(small, name)[end:].any()
    assert not small.by_symbol[symbols:].any()
    assert not small.row_widths[rows:].any()
    assert not small.row_slopes[slopes:].any()
    event(f"full: {tape.is_full}")
    assert tape.is_full or str(results[0]) == str(results[1])
    tape.forget()
    assert not tape.is_full
    assert not small.derivatives.any()


def test_what_is_not_linear_is_in_the_rest_of_a_condensed_number() -> None:
    tape = Tape(ROUNDOFF)
    (x,) = tape.condensed([tape.put(Ball(1.0, 0.5))])
    x, square = tape.condensed([x, tape.operate("*", x, x)])
    apart = tape.box(tape.operate("-", square, x))
    assert apart.middle + apart.radius >= 0.75  # at 1.5, where the linear part alone has 0.5
    assert apart.radius < 1.1  # of ranges alone it would be 1.75


def test_what_floats_round_of_a_centre_is_in_the_rest_of_a_condensed_number() -> None:
    tape = Tape(0.0)
    (root,) = tape.condensed([tape.operate("sqrt", tape.put(Ball(2.0, 0.0)))])
    assert holds(tape.box(tape.operate("*", root, root)), arb(2))
    assert 0.0 < tape.box(root).radius < 2.0**-51


def test_symbols_without_room_fill_the_tape() -> None:
    tape = Tape(ROUNDOFF, symbols=11)
    numbers = tape.condensed([tape.put(Ball(1.0, 0.5))])
    assert not tape.is_full
    tape.condensed(numbers)
    assert tape.is_full


def test_a_divisor_that_its_range_does_not_keep_from_zero_is_looked_at_more_closely() -> None:
    tape = Tape(ROUNDOFF)
    x = tape.put(Ball(0.0, 1.5))
    two = tape.operate("-", tape.operate("+", tape.put(Ball(2.0, 0.0)), x), x)
    assert holds(tape.range(two), arb(0))
    assert tape.box(tape.operate("/", tape.put(Ball(1.0, 0.0)), two)).radius < 10 * ROUNDOFF
