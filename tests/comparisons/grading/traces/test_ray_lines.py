from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.grading.traces.ray_lines import MOST_TOLD, RayLinesError, ray_lines

pytestmark = pytest.mark.clause("GRD-9", "CMD-2")


def problems(printed: str) -> tuple[str, ...]:
    with pytest.raises(RayLinesError) as caught:
        ray_lines(printed)
    return caught.value.problems


def test_lines_that_begin_with_no_brace_are_the_programs_own_business() -> None:
    rays = ray_lines('loading …\n{"path": ""}\n{"path": "TR", "primitive": null, "own": 1}\ndone\n')
    assert set(rays) == {"", "TR"}
    assert rays["TR"].model_fields_set == {"path", "primitive"}


def test_all_mistakes_are_told_each_with_its_line() -> None:
    told = problems('{"path": "X"}\n{\n{"path": "", "origin": [1, 2]}\n{"path": "T"}\n{"path": "T"}\n{"distance": NaN}')
    assert [problem.split(":")[0] for problem in told] == ["line 1", "line 2", "line 3", "line 5", "line 6", "line 6"]
    assert "a second time" in told[3]


def test_a_program_that_prints_no_rays_is_told_what_to_print() -> None:
    (told,) = problems("rendered in 3 s\n")
    assert "`--trace COLUMN ROW` (docs/ray-trees.md)" in told


def test_hostile_output_is_refused_in_few_sentences() -> None:
    assert len(problems("{\n" * 1000)) == MOST_TOLD
    assert len(problems('{"a":' * 100_000)) == 1


@given(st.recursive(st.none() | st.floats() | st.text(max_size=5), lambda inner: st.lists(inner, max_size=4)))
def test_any_values_are_taken_or_refused_in_sentences(value: Any) -> None:
    printed = json.dumps({"path": "", "origin": value, "primitive": value, "distance": value})
    is_refused = False
    try:
        rays = ray_lines(printed)
    except RayLinesError as error:
        is_refused, told = True, error.problems
    assert all(problem.startswith("line 1: ") for problem in told) if is_refused else set(rays) == {""}
