from __future__ import annotations

import pytest

from raytruth.comparisons.feasible_sets.run_time_names import FEATURES, is_short, with_run_time_names

pytestmark = pytest.mark.clause("ARI-1", "ARI-12")

MIRRORS = FEATURES.index("MIRRORS")


def rewritten(body: str) -> str:
    text = with_run_time_names(f"def f(x, offset):\n    {body}", ("pi", "slack"), ("lengths", "spread"), ("g",))
    return text.splitlines()[-1].strip()


def test_features_and_constants_are_read_from_the_state() -> None:
    assert rewritten("return MIRRORS") == f"return state().features[{MIRRORS}]"
    assert rewritten("return slack * pi") == "return state().constants[1] * state().constants[0]"


def test_an_element_of_a_list_is_read_behind_its_start() -> None:
    assert rewritten("return lengths[x]") == "return state().constants[state().starts[0] + x]"
    assert rewritten("return lengths[int(spread[x])]").count("state().starts[") == 2


def test_a_list_by_itself_is_a_vector() -> None:
    assert rewritten("return spread").count("state().starts[1] +") == 3


def test_names_of_a_functions_own_stay() -> None:
    assert rewritten("slack = x + offset; return slack").endswith("return slack")


def test_functions_that_others_are_put_around_get_another_name() -> None:
    text = with_run_time_names("def g(x):\n    return x\ndef f(x):\n    return g(x)", (), (), ("g",))
    assert "def inner_g(x)" in text
    assert "return g(x)" in text


def test_a_literal_is_short_if_every_arithmetic_stores_it_exactly() -> None:
    assert all(map(is_short, (0.0, 0.5, 1.0, -2.0, 360.0, 2.0**-20, float("inf"))))
    assert not is_short(6e-7)
    assert not is_short(0.1)
