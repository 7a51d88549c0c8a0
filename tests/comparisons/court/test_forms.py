from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given

from raytruth.comparisons.court.cases import all_cases
from raytruth.comparisons.court.exact_hits import truth_of
from raytruth.comparisons.court.forms import all_forms
from tests.comparisons.court.made_questions import rays_at_boxes, rays_through_corners

if TYPE_CHECKING:
    from raytruth.comparisons.court.questions import Question

pytestmark = pytest.mark.clause("CRT-5")

FORMS = all_forms()
CASES = all_cases()


@given(rays_through_corners())
def test_our_form_misses_no_corner_in_float32(question: Question) -> None:
    answer = FORMS["ours, float32"](question)
    assert answer is not None
    assert answer.hit


@given(rays_at_boxes())
def test_signed_and_padded_slabs_lose_no_box_that_is_met(question: Question) -> None:
    if truth_of(question).hit:
        for name in ("box: signed", "box: padded"):
            answer = FORMS[name](question)
            assert answer is not None
            assert answer.hit, name


@pytest.mark.parametrize(
    ("form", "case"),
    [
        ("box: plain", "along-the-lower-face"),
        ("box: d < 0", "negative-zero-and-a-box"),
        ("box: strict", "flat-box"),
        ("Möller-Trumbore, float32", "small-triangle"),
        ("quadratic, float32", "beside-a-sphere-far-away"),
    ],
)
def test_each_weak_form_is_wrong_where_its_weakness_is_asked_about(form: str, case: str) -> None:
    question = CASES[case].question
    answer = FORMS[form](question)
    assert answer is not None
    assert answer.hit != truth_of(question).hit


def test_a_form_says_nothing_of_a_shape_that_it_is_not_for() -> None:
    for name, form in FORMS.items():
        told = {shape for shape in ("triangles", "sphere", "box") if form(_first(shape)) is not None}
        expected = {"box"} if name.startswith("box") else {"sphere"} if name[0] in "qp" else {"triangles"}
        assert told == (expected | {"sphere"} if name.startswith("ours") else expected), name


def _first(shape: str) -> Question:
    return next(case.question for case in CASES.values() if case.question.shape == shape)
