"""What the compiler does not know it refuses, and says where it stands."""

from __future__ import annotations

import re
from typing import NamedTuple

import pytest

from raytruth.reference_tracer.compiler.names import NotCompilableError
from tests.reference_tracer.compiler.programs import FILE, INTEGER, INTEGERS, NUMBER, NUMBERS, program

pytestmark = pytest.mark.clause("ARI-12")

REFUSED = {
    "b = {}": "the compiler does not know this: {}",
    "b = unheard_of": "this name stands for nothing: unheard_of",
    "b = math.sqrt(a)": "this name stands for nothing: math.sqrt",
    "b = print(a)": "the compiler does not know what is called here: print(a)",
    "b = sqrt(a, a)": "there is no operation 'sqrt' for float64 and float64: sqrt(a, a)",
    "b = sqrt(x=a)": "arguments are passed by their places: sqrt(x=a)",
    "b = i % i": "whole numbers are divided only by a positive constant: i % i",
    "b = i / i": "there is no operation 'truediv' for int and int: i / i",
    "b = a % a": "there is no operation 'mod' for float64 and float64: a % a",
    "b = (a, i)[i]": "only a tuple of parts of one type is read at a computed place: (a, i)[i]",
    "b = (a, i)[2]": "tuple[float64, int] has no such part: (a, i)[2]",
    "b = a[0]": "float64 has no parts: a[0]",
    "b = a.real": "float64 has no part real: a.real",
    "b = numbers[a]": "the array has 1 dimensions, each with a whole number: numbers[a]",
    "b = [a, a]": "a list begins with one element, from which its type follows: [a, a]",
    "b = 'text'": "the compiler does not know this: 'text'",
    "b = a if (a, a) else a": "tuple[float64, float64] is neither true nor false: (a, a)",
    "b = a + (a, a)": "the arithmetic has no operation 'add' for float64 and tuple[float64, float64]: a + (a, a)",
    "b = twice(a, a)": "twice takes 1 arguments: twice(a, a)",
    "b = endless(a)": "a function does not call itself",
    "b = mixed(a)": "int is returned here, and float64 elsewhere: return 1",
    "i = a": "this has been int before, and is float64 here: i",
    "i, b = a, i": "this has been int before, and is float64 here: i",
    "(b, c) = (a, a, a)": "tuple[float64, float64, float64] cannot be assigned to this: (b, c)",
    "numbers[0] = i": "int cannot be assigned to this: numbers[0]",
    "b = c = a": "the compiler does not know this: b = c = a",
    "for b in numbers: pass": "a loop is over a range: for b in numbers:",
    "for b in range(0, i, 2): pass": "the compiler does not know this: for b in range(0, i, 2):",
    "for b in range(a): pass": "a range is of whole numbers: for b in range(a):",
    "with a: pass": "the compiler does not know this: with a:",
    "waiting = [a]\n    waiting.append(i)": "int is put into list[float64]: waiting.append(i)",
}
HEAD = """
def twice(a):
    return a + a

def endless(a):
    return endless(a)

def mixed(a):
    if a > 0.0:
        return a
    return 1

def run(a, i, numbers, wholes):
"""
LINES = {"endless": 5, "mixed": 11}


@pytest.mark.parametrize("statement", REFUSED)
def test_what_the_compiler_does_not_know_is_refused_with_file_and_line(statement: str) -> None:
    text = f"{HEAD}    {statement}\n"
    where = next((name for name in LINES if name in statement), "run")
    line = LINES.get(where, len(text.splitlines()))
    expected = f"{FILE}, line {line}, in {where}: {REFUSED[statement]}"
    with pytest.raises(NotCompilableError, match=f"^{re.escape(expected)}$"):
        program(text, NUMBER, INTEGER, NUMBERS, INTEGERS).ir_text()


class Pair(NamedTuple):
    first: float
    second: float


def added(a: Pair, b: Pair) -> Pair:
    return Pair(a.first + b.first, a.third)  # type: ignore[attr-defined]


def test_what_is_wrong_in_a_function_of_an_arithmetic_is_named_with_its_own_file_and_line() -> None:
    text = "def run(a, numbers):\n    numbers[0] = (Pair(a, a) + Pair(a, a)).first"
    with pytest.raises(NotCompilableError) as raised:
        program(text, NUMBER, NUMBERS, names={"Pair": Pair}, operations={"add": added}).ir_text()
    line = added.__code__.co_firstlineno + 1
    assert str(raised.value) == f"{__file__}, line {line}, in added: Pair has no part third: a.third"


def test_a_whole_number_beside_a_float_becomes_one() -> None:
    text = "def run(a, i, numbers, wholes):\n    numbers[0] = a * 2 + i"
    assert "sitofp" in program(text, NUMBER, INTEGER, NUMBERS, INTEGERS).ir_text()
