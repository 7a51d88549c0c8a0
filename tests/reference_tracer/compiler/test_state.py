"""What the functions of a program share without passing it to one another."""

from __future__ import annotations

import numpy as np
import pytest

from raytruth.reference_tracer.compiler.names import NotCompilableError
from raytruth.reference_tracer.compiler.questions import UNDECIDED, UndecidedError, marks_taken, state, undecided
from raytruth.reference_tracer.compiler.types import Array, Tuple
from tests.reference_tracer.compiler.programs import INTEGER, INTEGERS, NUMBER, NUMBERS, compiled, program

pytestmark = pytest.mark.clause("ARI-12")

PAIR = Tuple((NUMBER, NUMBER), ("middle", "radius"), "Pair")
TAPE = Tuple((Array(PAIR), Array(INTEGER, 2)), ("pairs", "links"), "Tape")
STATE = Tuple((NUMBER, TAPE, INTEGERS), ("scale", "tape", "counts"), "State")
NAMES = {"state": state, "undecided": undecided, "marks_taken": marks_taken}
TEXT = """
def added(value):
    counts = state().counts
    counts[0] = counts[0] + 1
    return value + state().scale

def pair_at(place):
    return state().tape.pairs[state().tape.links[place, 1]]

def whole_sum(all_of_it):
    return all_of_it.scale + all_of_it.tape.pairs[0].middle

def run(start, results):
    results[0] = added(added(start))
    results[1] = pair_at(0).radius + pair_at(1).middle
    results[2] = whole_sum(state())
    state().tape.pairs[0] = pair_at(1)
    if undecided():
        results[3] = float(marks_taken())
"""


def run_with(scale: float) -> tuple[list[float], list[int], list[list[float]]]:
    run = compiled(TEXT, NUMBER, NUMBERS, names=NAMES, state=STATE)
    pairs, links = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]), np.array([[0, 1], [0, 2]])
    counts, results = np.zeros(1, dtype=np.int64), np.zeros(4)
    run((scale, (pairs, links), counts), 0.5, results)
    return results.tolist(), counts.tolist(), pairs.tolist()


def test_functions_deep_inside_read_and_write_what_the_entry_point_was_given() -> None:
    results, counts, pairs = run_with(10.0)
    assert results == [20.5, 9.0, 11.0, UNDECIDED]
    assert counts == [2]
    assert pairs == [[5.0, 6.0], [3.0, 4.0], [5.0, 6.0]]
    assert run_with(-1.0)[0][0] == -1.5


def test_marks_and_state_lie_side_by_side() -> None:
    text = "def run(results):\n    results[0] = state().counts[0]\n    results[1] = 1 if undecided() else 0\n"
    run = compiled(text, INTEGERS, names=NAMES, state=Tuple((INTEGERS,), ("counts",)))
    results = np.zeros(2, dtype=np.int64)
    with pytest.raises(UndecidedError):
        run((np.array([7]),), results)
    assert results.tolist() == [7, 1]


def test_a_program_without_a_state_cannot_ask_for_it() -> None:
    with pytest.raises(NotCompilableError, match="in state: the compiler does not know this"):
        program("def run():\n    state()\n", names=NAMES).ir_text()


def test_there_is_no_state_in_interpreted_code() -> None:
    with pytest.raises(NotImplementedError):
        state()


def test_only_what_is_read_of_the_state_is_loaded() -> None:
    text = "def run(results):\n    results[0] = state().scale\n"
    loads = [
        program(text, NUMBERS, names=NAMES, state=STATE).ir_text().count(f"load {kind}") for kind in ("double", "i64")
    ]
    assert loads == [1, 1]  # and the marks, for the caller
