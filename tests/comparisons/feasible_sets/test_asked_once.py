"""The hit that is remembered is tested in test_rounded_rays.py, by what it spares."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.feasible_sets.asked_once import MOST_WAYS, OneDecision
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("VER-2")


def outcomes_of(function: Callable[[Decisions], bool]) -> list[tuple[bool, bool, bool]]:
    """What comes of one decision before, the function as one decision, and one after."""
    decisions = Decisions()
    one = OneDecision(lambda: function(decisions), decisions)
    return list(every_outcome(lambda: (decisions.next(), one(), decisions.next()), decisions, 64))


def all_of(table: list[bool]) -> Callable[[Decisions], bool]:
    """A function of so many decisions as the table has binary digits."""

    def function(decisions: Decisions) -> bool:
        place = 0
        for _ in range((len(table) - 1).bit_length()):
            place = 2 * place + int(decisions.next())
        return table[place]

    return function


@given(st.integers(0, 4).flatmap(lambda digits: st.lists(st.booleans(), min_size=2**digits, max_size=2**digits)))
def test_all_ways_are_one_decision_and_those_around_it_stay_free(table: list[bool]) -> None:
    outcomes = outcomes_of(all_of(table))
    assert len(outcomes) == len(set(outcomes)) == 4 * len(set(table))
    assert {middle for _, middle, _ in outcomes} == set(table)


def test_too_many_ways_leave_both_possible() -> None:
    few, many = [False] * MOST_WAYS, [False] * (2 * MOST_WAYS)
    assert {middle for _, middle, _ in outcomes_of(all_of(few))} == {False}
    assert {middle for _, middle, _ in outcomes_of(all_of(many))} == {True, False}


def test_an_error_inside_leaves_the_decisions_as_they_were() -> None:
    decisions = Decisions()

    def broken() -> bool:
        decisions.next()
        raise ZeroDivisionError

    decisions.follow([False])
    assert not decisions.next()
    with pytest.raises(ZeroDivisionError):
        OneDecision(broken, decisions)()
    assert (decisions.answers, decisions.position) == ([False], 1)
