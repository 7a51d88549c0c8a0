"""The proven answer to a question, and all that float32 and float64 may give instead of it."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.oracle.answer import CertifiedNumber, NumberRange, OracleAnswer
from raytruth.comparisons.oracle.questions import declaration_of
from raytruth.comparisons.oracle.situations import CHANGES, situation_of
from raytruth.comparisons.renderers.program.declaration import Formulas
from raytruth.comparisons.renderers.program.declared_model import error_model_of_declaration
from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import (
    Decisions,
    TooManyOutcomesError,
    ball_arithmetic,
    every_outcome,
    rounded_ball_arithmetic,
)
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, merged
from raytruth.reference_tracer.arithmetics.exact_arithmetic import ExactArithmetic
from raytruth.reference_tracer.certification import FEWEST_BITS, MOST_BITS, MOST_WORK, enclosing_floats
from raytruth.reference_tracer.rendering import PreparedScene
from raytruth.reference_tracer.tables import build_tables
from raytruth.reference_tracer.ties import NO_BOUND, RaisingDecisions, UndecidedComparisonError
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Literal

    from raytruth.comparisons.oracle.questions import Question
    from raytruth.comparisons.oracle.situations import Found, Situation
    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.reference_tracer.arithmetics.kernel import Kernel
    from raytruth.scenes.features import Feature

# Four comparisons that rounding leaves open, as in a pixel's feasible set; of more nothing is told.
MOST_OUTCOMES = 16
# A radius of half a unit in the last place is what rounding the middle to float64 costs: more bits cannot lessen it.
AS_GOOD_AS_FLOATS = 2.0**-52
# A kernel takes a twentieth of a second to make: those of nine questions, a few materials each, in three arithmetics.
MOST_KERNELS = 64

UNDECIDED = "the values given make a comparison an exact tie, which no precision decides"


def answer_to(question: Question) -> OracleAnswer:
    """The answer to a question whose scene is consistent."""
    situation = situation_of(question)
    truth = _truth(question.ask, situation)
    return OracleAnswer(
        ask=question.ask,
        id=question.id,
        truth=_told(truth, _certified) if truth is not None and _has_bounds(truth) else None,
        undecided=UNDECIDED if truth is None else "" if _has_bounds(truth) else NO_BOUND,
        float32=_feasible(question, situation, "float32"),
        float64=_feasible(question, situation, "float64"),
    )


def _truth(ask: str, situation: Situation) -> Found | None:
    """The answer in balls, as narrow as floats can tell; None where ties leave it open."""
    found, bits, work = None, FEWEST_BITS, MOST_WORK
    while bits <= MOST_BITS:
        with ctx.workprec(bits):
            try:
                found = _in_arithmetic(situation, *_ball_kernel(ask, _features(situation), bits))
            except UndecidedComparisonError:
                exact, kernel = _exact_kernel(ask, _features(situation), bits)
                exact.restart(work)
                try:
                    found = _balls_of(_in_arithmetic(situation, exact.arithmetic, kernel))
                except UndecidedComparisonError:
                    work = max(0, work - exact.work())
        if found is not None and all(map(_is_narrow, _numbers_in(found))):
            return found
        bits *= 2
    return found


def _feasible(
    question: Question, situation: Situation, precision: Literal["float32", "float64"]
) -> tuple[dict[str, Any], ...] | None:
    """Every way that rounding leaves open, each with all that it may give; None where these are too many."""
    model = error_model_of_declaration(declaration_of(question, precision))
    features = _features(situation)
    if question.formulas == Formulas():
        decisions, arithmetic, kernel = _rounded_kernel(question.ask, features, model.precision_bits)
    else:
        behaviour = behaviour_of(model, situation.scene)
        decisions, arithmetic, kernel = _new_rounded_kernel(question.ask, features, model.precision_bits, behaviour)
    with arithmetic.in_force():
        prepared = _prepared(situation, arithmetic, kernel)
        try:
            found = list(every_outcome(lambda: situation.ask(prepared), decisions, MOST_OUTCOMES, all_or_none=True))
        except TooManyOutcomesError:
            return None
        told = [_told(outcome, _range) for outcome in found]
    return tuple(outcome for place, outcome in enumerate(told) if outcome not in told[:place])


@lru_cache(MOST_KERNELS)
def _ball_kernel(ask: str, features: frozenset[Feature], bits: int) -> tuple[Arithmetic, Kernel]:
    arithmetic = ball_arithmetic(bits, RaisingDecisions())
    return arithmetic, make_kernel(arithmetic, features, CHANGES.get(ask, IDEAL))


@lru_cache(MOST_KERNELS)
def _exact_kernel(ask: str, features: frozenset[Feature], bits: int) -> tuple[ExactArithmetic, Kernel]:
    with ctx.workprec(bits):
        exact = ExactArithmetic(RaisingDecisions())
        return exact, make_kernel(exact.arithmetic, features, CHANGES.get(ask, IDEAL))


@lru_cache(MOST_KERNELS)
def _rounded_kernel(ask: str, features: frozenset[Feature], bits: int) -> tuple[Decisions, Arithmetic, Kernel]:
    """By the tracer's own formulas, which are the same for all scenes."""
    return _new_rounded_kernel(ask, features, bits, IDEAL)


def _new_rounded_kernel(
    ask: str, features: frozenset[Feature], bits: int, behaviour: Behaviour
) -> tuple[Decisions, Arithmetic, Kernel]:
    decisions = Decisions()
    arithmetic = rounded_ball_arithmetic(bits, decisions)
    with arithmetic.in_force():
        return decisions, arithmetic, make_kernel(arithmetic, features, merged(behaviour, CHANGES.get(ask, IDEAL)))


def _features(situation: Situation) -> frozenset[Feature]:
    return required_features(situation.scene) | situation.more_features


def _in_arithmetic(situation: Situation, arithmetic: Arithmetic, kernel: Kernel) -> Found:
    with arithmetic.in_force():
        return situation.ask(_prepared(situation, arithmetic, kernel))


def _prepared(situation: Situation, arithmetic: Arithmetic, kernel: Kernel) -> PreparedScene:
    """The kernel with the tables of the situation; the precision of the arithmetic is in force."""
    scene = situation.scene
    return PreparedScene(scene, arithmetic, kernel, build_tables(scene, required_features(scene), arithmetic))


def _balls_of(found: Found) -> Found:
    return {name: _each(value, lambda exact: exact.ball) for name, value in found.items()}


def _told(found: Found, tell: Callable[[Any], Any]) -> dict[str, Any]:
    return {name: _each(value, tell) for name, value in found.items()}


def _each(value: Any, change: Callable[[Any], Any]) -> Any:
    """The value with each of its numbers changed; a truth value is none."""
    if isinstance(value, bool):
        return value
    return tuple(map(change, value)) if isinstance(value, tuple) else change(value)


def _numbers_in(found: Found) -> Sequence[Any]:
    values = [value if isinstance(value, tuple) else (value,) for value in found.values()]
    return [number for value in values for number in value if not isinstance(number, bool)]


def _is_narrow(ball: Any) -> bool:
    middle, radius = enclosing_floats(ball)
    return radius <= max(AS_GOOD_AS_FLOATS * abs(middle), math.ulp(0.0))


def _has_bounds(found: Found) -> bool:
    return all(math.isfinite(enclosing_floats(ball)[1]) for ball in _numbers_in(found))


def _certified(ball: Any) -> CertifiedNumber:
    middle, radius = enclosing_floats(ball)
    return CertifiedNumber(middle=middle, radius=radius, middle_hex=middle.hex(), radius_hex=radius.hex())


def _range(ball: Any) -> NumberRange | None:
    """Floats around all that the ball holds; None where there are none."""
    if not ball.is_finite():
        return None
    low, high = float(ball.lower()), float(ball.upper())
    low = low if arb(low) <= ball.lower() else math.nextafter(low, -math.inf)
    high = high if arb(high) >= ball.upper() else math.nextafter(high, math.inf)
    if not (math.isfinite(low) and math.isfinite(high)):
        return None
    return NumberRange(low=low, high=high, low_hex=low.hex(), high_hex=high.hex())
