from __future__ import annotations

import io
import json
from itertools import product
from typing import Any, get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.oracle.lines import LONGEST_LINE, QuestionError, answered, answered_lines, json_schema
from raytruth.comparisons.renderers.program.declaration import Formulas

pytestmark = pytest.mark.clause("ORA-3")

GOOD: dict[str, Any] = {"ask": "reflect", "direction": [1, -1, 0], "normal": [0, 1, 0]}


def lines(text: bytes) -> list[tuple[dict[str, Any], bool]]:
    return [(json.loads(line), is_good) for line, is_good in answered_lines(io.BytesIO(text))]


def problems(question: Any) -> tuple[str, ...]:
    with pytest.raises(QuestionError) as caught:
        answered(question)
    return caught.value.problems


def test_bad_lines_are_answered_with_their_numbers_and_the_rest_goes_on() -> None:
    good = json.dumps(GOOD).encode()
    bad = [b"{", b"[" * 50_000, b"\xff", b"3", b'{"ask": 1}', b"x" * (3 * LONGEST_LINE), b'{"ask": "reflct", "id": 7}']
    found = lines(b"\n".join([good, *bad, b"", good]))
    assert [is_good for _, is_good in found] == [True, *[False] * len(bad), True]
    assert [answer["line"] for answer, _ in found] == [*range(1, len(bad) + 2), len(bad) + 3]
    for number, (answer, _) in enumerate(found[1:-1], start=2):
        assert answer["error"].startswith(f"line {number}: ")
        assert answer["error"].endswith((".", "?"))
    assert found[-2][0]["id"] == 7
    assert "did you mean 'reflect'" in found[-2][0]["error"]


def test_all_mistakes_of_a_question_are_told_at_once_each_with_its_place() -> None:
    told = problems({"ask": "reflect", "direction": [0, 0, 0], "normal": [0, "a"], "nromal": 1})
    assert [problem.split(": ")[0] for problem in told] == ["direction", "normal[1]", "normal[2]", "nromal"]
    assert "did you mean 'normal'" in told[-1]


def test_what_no_scene_may_have_no_question_may_have() -> None:
    flat = {"ask": "intersect_triangle", "origin": [0, 0, 1], "direction": [0, 0, -1]}
    assert "area" in problems(flat | {"a": [0, 0, 0], "b": [1, 1, 1], "c": [2, 2, 2]})[0]
    (told,) = problems(GOOD | {"formulas": {"least_determinant": 1e-6}})
    assert told.startswith("formulas.least_determinant: expected the triangle test")
    (told,) = problems(GOOD | {"direction": ["0x1p+2000", 0, 0]})
    assert "expected a number that float64 holds" in told
    found = lines(b'{"ask": "reflect", "direction": [1' + b"0" * 6000 + b', 0, 0], "normal": [0, 1, 0]}\n')
    assert "direction[0]: expected" in found[0][0]["error"]


def test_hexadecimal_floats_are_the_numbers_that_they_write() -> None:
    in_hex = GOOD | {"direction": [(1.0).hex(), (-1.0).hex(), "0x0p0"]}
    assert answered(in_hex) == answered(GOOD)
    (told,) = problems(GOOD | {"direction": ["1.5", 0, 0]})
    assert told.startswith("direction[0]: expected a number")


def test_a_text_is_never_evaluated() -> None:
    (told,) = problems(GOOD | {"direction": ["__import__('os').getcwd()", 0, 0]})
    assert told.startswith("direction[0]: expected a number, found")


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=9),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=9), inner, max_size=3),
    max_leaves=8,
)


@given(st.dictionaries(st.sampled_from([*GOOD, "id", "slack_bits", "formulas", "lights"]), JSON, max_size=3))
def test_any_json_is_answered_or_refused_in_sentences(changes: dict[str, Any]) -> None:
    ((answer, is_good),) = lines(json.dumps(GOOD | changes).encode())
    assert is_good == ("error" not in answer)


@pytest.mark.parametrize("keys", [("sphere", "sphere_normals"), ("triangle", "triangle_points")])
def test_every_pair_of_formulas_gives_an_answer_or_a_sentence(keys: tuple[str, str]) -> None:
    sphere = {"ask": "intersect_sphere", "origin": [0, 0, 5], "direction": [0, 0, -1], "center": [0, 0, 0], "radius": 1}
    for chosen in product(*(get_args(Formulas.model_fields[key].annotation) for key in keys)):
        formulas = dict(zip(keys, chosen, strict=True))
        ((answer, is_good),) = lines(json.dumps(sphere | {"formulas": formulas}).encode())
        assert is_good or answer["error"].startswith("line 1: formulas."), formulas


def test_the_schema_tells_every_question_and_every_key() -> None:
    told = json.dumps(json_schema())
    for name in ("intersect_box", "index_from", "slack_bits", "low_hex", "undecided"):
        assert name in told
    assert len(json_schema()["question"]["anyOf"]) == 9
