"""A tape of linked numbers on which Python does one compiled operation at a time."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from raytruth.reference_tracer.arithmetics import (
    linked_tape,
    linked_tape_operations,
    linked_tape_rows,
    linked_tape_sweeps,
)
from raytruth.reference_tracer.arithmetics.float_balls import Ball
from raytruth.reference_tracer.arithmetics.linked_tape import IS_FULL
from raytruth.reference_tracer.arithmetics.linked_tape_memory import BALL, tape_memory, tape_type
from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

OF_TWO = {
    "+": "linked_sum",
    "-": "linked_difference",
    "*": "linked_product",
    "/": "linked_quotient",
    "min": "linked_minimum",
    "max": "linked_maximum",
    "power": "linked_power",
}
OF_ONE = {
    "abs": "linked_size",
    "neg": "linked_negative",
    "sqrt": "linked_root",
    "exp": "linked_exponential",
    "tan": "linked_tangent",
    "own": "hit_with_error",
}
CODES = {name: code for code, name in enumerate([*OF_TWO, *OF_ONE])}

TEXT = f"""
def put(ball, places):
    places[0] = number_of_ball(ball).place

def operate(code, first, second, places):
    places[0] = result(code, LinkedNumber(first), LinkedNumber(second)).place

def result(code, a, b):
{"".join(f"    if code == {CODES[name]}: return {OF_TWO[name]}(a, b){chr(10)}" for name in OF_TWO)}
{"".join(f"    if code == {CODES[name]}: return {OF_ONE[name]}(a){chr(10)}" for name in OF_ONE)}
    return a

def keep(places, rows):
    origin = (LinkedNumber(places[0]), LinkedNumber(places[1]), LinkedNumber(places[2]))
    direction = (LinkedNumber(places[3]), LinkedNumber(places[4]), LinkedNumber(places[5]))
    rows[0] = keep_ray(origin, direction)

def begin(row, places):
    origin, direction = kept_ray(row)
    for place in range(3):
        places[place] = origin[place].place
        places[3 + place] = direction[place].place

def enclose(number, balls):
    balls[0] = box_of(LinkedNumber(number))

def compare(first, second, balls, answers):
    a, b = LinkedNumber(first), LinkedNumber(second)
    balls[0] = difference(a, b)
    answers[0] = linked_less(a, b)
    answers[1] = linked_less_or_equal(a, b)
    answers[2] = linked_equal(a, b)
    answers[3] = 1 if certainly_less(a, b) else 0
    answers[4] = 1 if certainly_zero(a) else 0
    below = linked_floor(a)
    answers[5] = below.lowest
    answers[6] = 1 if below.is_one else 0

def forget(row):
    reset()
    forget_rays(row)
"""
INTEGER, INTEGERS, BALLS = Integer(), Array(Integer()), Array(BALL)
ENTRY_POINTS = {
    "put": (BALL, INTEGERS),
    "operate": (INTEGER, INTEGER, INTEGER, INTEGERS),
    "keep": (INTEGERS, INTEGERS),
    "begin": (INTEGER, INTEGERS),
    "enclose": (INTEGER, BALLS),
    "compare": (INTEGER, INTEGER, BALLS, INTEGERS),
    "forget": (INTEGER,),
}
STATE = Tuple((tape_type(), Float(64)), ("tape", "roundoff"), "State")


@cache
def compiled() -> Mapping[str, Callable[..., None]]:
    """The functions of the text."""
    modules = (linked_tape, linked_tape_operations, linked_tape_rows, linked_tape_sweeps)
    names = {name: value for module in modules for name, value in vars(module).items() if not name.startswith("__")}
    return Program(TEXT, "text of a test", names, ENTRY_POINTS, state=STATE).compiled()


class Answers(NamedTuple):
    """What comparisons of two numbers gave: 1, 0 or UNDECIDED; and the whole number below the first one."""

    difference: Ball
    less: int
    less_or_equal: int
    equal: int
    certainly_less: int
    certainly_zero: int
    lowest: int
    is_one: int


class Tape:
    """A tape; its numbers are places."""

    def __init__(
        self, roundoff: float, constants: Sequence[Ball] = (), numbers: int = 1000, symbols: int = 500
    ) -> None:
        self.arrays = tape_memory(constants, numbers, symbols)
        self.roundoff = roundoff

    def call(self, name: str, *arguments: Any) -> None:
        compiled()[name]((self.arrays, self.roundoff), *arguments)

    def put(self, ball: Ball) -> int:
        """A number of which only this is known."""
        places = _wholes(1)
        self.call("put", ball, places)
        return int(places[0])

    def operate(self, name: str, first: int, second: int = 0) -> int:
        places = _wholes(1)
        self.call("operate", CODES[name], first, second, places)
        return int(places[0])

    def condensed(self, numbers: Sequence[int]) -> list[int]:
        """Six numbers, or fewer, kept and put on the tape again."""
        places, row = np.array([*numbers, *numbers[:1] * 6][:6], dtype=np.int64), _wholes(1)
        self.call("keep", places, row)
        self.call("begin", int(row[0]), places)
        return [int(place) for place in places[: len(numbers)]]

    def center(self, number: int) -> Ball:
        return Ball(*self.arrays.centers[number].tolist())

    def range(self, number: int) -> Ball:
        return Ball(*self.arrays.ranges[number].tolist())

    def box(self, number: int) -> Ball:
        """The tight enclosure."""
        balls = np.zeros((1, 2))
        self.call("enclose", number, balls)
        return Ball(*balls[0].tolist())

    def compare(self, first: int, second: int) -> Answers:
        balls, answers = np.zeros((1, 2)), _wholes(7)
        self.call("compare", first, second, balls, answers)
        return Answers(Ball(*balls[0].tolist()), *answers.tolist())

    def forget(self) -> None:
        """All but the constants."""
        self.call("forget", 0)

    @property
    def is_full(self) -> bool:
        return bool(self.arrays.counts[IS_FULL])


def _wholes(count: int) -> Any:
    return np.zeros(count, dtype=np.int64)
