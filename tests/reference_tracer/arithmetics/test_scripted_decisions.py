"""Decisions in compiled code go the ways of `every_outcome`, in its order."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.reference_tracer.arithmetics import scripted_decisions
from raytruth.reference_tracer.arithmetics.balls import Decisions, every_outcome
from raytruth.reference_tracer.arithmetics.float_ball_comparisons import UNDECIDED
from raytruth.reference_tracer.arithmetics.scripted_decisions import (
    COMPARISONS,
    DECISIONS,
    HAS_LOST,
    MOST_ANSWERS,
    POSITION,
    RECORDED,
    ScriptedDecisions,
    decisions_memory,
)
from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.types import Array, Integer, Tuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

pytestmark = pytest.mark.clause("ARI-3", "ARI-12")

TEXT = """
def walked(count):
    code = 1
    for place in range(count):
        if code % 3 != 0:
            code = 2 * code + (1 if decided(-1) else 0)
    return code

def once(count, results):
    results[0] = walked(count)

def every(count, results):
    was = paused()
    ways = 0
    searching = True
    while searching:
        results[ways] = walked(count)
        ways += 1
        searching = next_way(was.recorded)
    resume(was)
    results[ways] = walked(count)

def known(results):
    results[0] = 1 if decided(1) else 0
    results[1] = 1 if decided(0) else 0
"""


@cache
def compiled() -> Mapping[str, Callable[..., None]]:
    kinds = (Integer(), Array(Integer()))
    names = {name: getattr(scripted_decisions, name) for name in ("decided", "paused", "resume", "next_way")}
    state = Tuple((DECISIONS,), ("decisions",), "State")
    return Program(TEXT, "text", names, {"once": kinds, "every": kinds, "known": kinds[1:]}, state=state).compiled()


def call(name: str, decisions: ScriptedDecisions, *arguments: Any) -> list[int]:
    results = np.zeros(200, dtype=np.int64)
    compiled()[name]((decisions,), *arguments, results)
    return [int(result) for result in results]


def walked(count: int, decisions: Decisions) -> int:
    """As the text has it."""
    code = 1
    for _ in range(count):
        if code % 3 != 0:
            code = 2 * code + int(decisions.next())
    return code


@given(st.integers(0, 7))
def test_all_ways_are_taken_once_in_the_order_of_every_outcome(count: int) -> None:
    decisions = Decisions()
    expected = list(every_outcome(lambda: walked(count, decisions), decisions, 200))
    found = call("every", decisions_memory(), count)
    assert found[: len(expected)] == expected
    assert not any(found[len(expected) + 1 :])


@given(st.integers(0, 7), st.lists(st.booleans(), max_size=7))
def test_a_script_is_followed_and_what_is_asked_beyond_it_is_recorded_as_true(count: int, script: list[bool]) -> None:
    decisions, memory = Decisions(), decisions_memory()
    decisions.follow(script)
    memory.answers[: len(script)] = script
    memory.counts[RECORDED] = len(script)
    assert call("once", memory, count)[0] == walked(count, decisions)
    assert memory.answers[: memory.counts[RECORDED]].astype(bool).tolist() == decisions.answers
    assert memory.counts[POSITION] == decisions.position


@given(st.integers(1, 7), st.lists(st.booleans(), min_size=7, max_size=7))
def test_decisions_that_were_paused_go_on_as_if_there_had_been_none_between(count: int, script: list[bool]) -> None:
    memory, decisions = decisions_memory(), Decisions()
    memory.answers[:7] = script
    memory.counts[RECORDED] = 7
    decisions.follow(script)
    found = [code for code in call("every", memory, count) if code]
    assert found[-1] == walked(count, decisions)
    assert memory.counts[RECORDED] == 7


def test_what_is_known_asks_nothing_and_is_counted() -> None:
    memory = decisions_memory()
    assert call("known", memory)[:2] == [1, 0]
    assert memory.counts[RECORDED] == 0
    assert memory.counts[COMPARISONS] == 2
    assert UNDECIDED == -1  # as the text has it


def test_an_answer_without_room_is_lost_and_that_is_said() -> None:
    memory = decisions_memory()
    memory.counts[POSITION] = memory.counts[RECORDED] = MOST_ANSWERS - 1
    call("once", memory, 1)
    assert not memory.counts[HAS_LOST]
    call("once", memory, 1)
    assert memory.counts[HAS_LOST]
    assert memory.counts[RECORDED] == MOST_ANSWERS
