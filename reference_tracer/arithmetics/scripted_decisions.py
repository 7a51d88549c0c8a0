"""Decisions in compiled code: answers to comparisons that balls leave open (balls.py, `Decisions`).

They are in the state of the call (compiler/questions.py). Those of a script come first, then True; all are recorded.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from raytruth.reference_tracer.arithmetics.float_ball_comparisons import UNDECIDED
from raytruth.reference_tracer.compiler.questions import state
from raytruth.reference_tracer.compiler.types import Array, Integer, Tuple

# An evaluation with more undecided comparisons has more ways than anyone follows.
MOST_ANSWERS = 4096
# Ways that are followed through the comparisons of one shadow ray. It only bounds the work: beyond, both light and
# shadow are possible. Where six triangles of a box meet, ways to a shadow and past it are found within some dozens.
MOST_WAYS = 64

# Places of `counts`.
POSITION, RECORDED, COMPARISONS, HAS_LOST = range(4)
"""How many answers have been given, how many there are, how many comparisons there were, and 1 if an answer had no
room."""
NUMBER_OF_COUNTS = 4


class ScriptedDecisions(NamedTuple):
    """Whole numbers."""

    answers: Any
    """1 for True."""
    counts: Any


DECISIONS = Tuple((Array(Integer()),) * 2, ScriptedDecisions._fields, ScriptedDecisions.__name__)


def decisions_memory() -> ScriptedDecisions:
    """Room for decisions, none taken yet."""
    return ScriptedDecisions(np.zeros(MOST_ANSWERS, dtype=np.int64), np.zeros(NUMBER_OF_COUNTS, dtype=np.int64))


def next_answer() -> bool:
    """The answer to an undecided comparison."""
    decisions = state().decisions
    position = decisions.counts[POSITION]
    if position >= MOST_ANSWERS:
        decisions.counts[HAS_LOST] = 1
        return True
    if position >= decisions.counts[RECORDED]:
        decisions.answers[position] = 1
        decisions.counts[RECORDED] = position + 1
    decisions.counts[POSITION] = position + 1
    answer: int = decisions.answers[position]
    return answer == 1


def decided(answer: int) -> bool:
    """The answer 1 or 0 of a comparison, as it is; of one that is undecided the next one."""
    counts = state().decisions.counts
    counts[COMPARISONS] = counts[COMPARISONS] + 1
    if answer == UNDECIDED:
        return next_answer()
    return answer == 1


class Paused(NamedTuple):
    """Where decisions were when others were begun behind them."""

    position: int
    recorded: int


def paused() -> Paused:
    """Begin decisions of their own, behind those that there are."""
    counts = state().decisions.counts
    was = Paused(counts[POSITION], counts[RECORDED])
    counts[POSITION] = was.recorded
    return was


def resume(was: Paused) -> None:
    """Go on with the decisions that were paused, and forget those behind them."""
    counts = state().decisions.counts
    counts[POSITION] = was.position
    counts[RECORDED] = was.recorded


def next_way(first: int) -> bool:
    """Set the answers from place `first` on to the next way that they may go; False where there is none left.

    Every answer is True at first, and the last of them that still is becomes False: so no way is taken twice, and they
    come in the order of `every_outcome` (balls.py).
    """
    decisions = state().decisions
    last = decisions.counts[RECORDED] - 1
    while last >= first:
        if decisions.answers[last] == 1:
            decisions.answers[last] = 0
            decisions.counts[RECORDED] = last + 1
            decisions.counts[POSITION] = first
            return True
        last = last - 1
    return False


def ways_left(first: int) -> int:
    """How many ways of the answers from place `first` on are left at least: each True among them leads to one."""
    decisions = state().decisions
    left = 0
    for place in range(first, decisions.counts[RECORDED]):
        left = left + decisions.answers[place]
    return left


def begin_decisions() -> None:
    """Forget all answers."""
    counts = state().decisions.counts
    counts[POSITION] = 0
    counts[RECORDED] = 0
    counts[HAS_LOST] = 0


def count_comparison() -> None:
    """One more, of any numbers: a measure of work that depends on no clock."""
    counts = state().decisions.counts
    counts[COMPARISONS] = counts[COMPARISONS] + 1
