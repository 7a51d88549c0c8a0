"""Closed forms, written down by hand for small scenes, lie in the certified truth."""

from __future__ import annotations

import math
from random import Random
from typing import TYPE_CHECKING

import pytest
from flint import ctx
from hypothesis import given, note
from hypothesis import strategies as st
from mpmath import mp

from raytruth.reference_tracer.arithmetics.balls import ball_arithmetic
from raytruth.reference_tracer.rendering import prepare
from raytruth.reference_tracer.ties import RaisingDecisions
from tests.reproduction import note_case
from tests.second_opinion import case as make
from tests.second_opinion.closed_forms import CLOSED_FORMS
from tests.second_opinion.surfaces import sphere_in_parallel_projection
from tests.second_opinion.truth import DIGITS, FEWEST_BITS, agree, certified, with_own_error

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.second_opinion.case import Case

pytestmark = pytest.mark.clause("ARI-10")

SEEDS = st.integers(0, 2**64 - 1)
EVERY_FORM = pytest.mark.parametrize("form", CLOSED_FORMS, ids=lambda form: form.__name__)

WITH_AN_EDGE = [form for form in CLOSED_FORMS if form(Random(0)).side is not None]


@pytest.mark.clause(
    "CAM-1",
    "CAM-2",
    "CAM-3",
    "CAM-4",
    "SPH-1",
    "SPH-4",
    "SPH-5",
    "TRI-4",
    "PLANE-1",
    "PLANE-4",
    "PLANE-5",
    "BG-1",
    "BG-2",
    "TEX-1",
    "ILL-2",
    "ILL-3",
    "ILL-5",
    "ILL-6",
    "ILL-7",
    "SHAD-1",
    "SHAD-2",
    "REFL-1",
    "REFL-2",
    "REFR-1",
    "REFR-3",
    "REFR-4",
    "REFR-5",
    "REFR-6",
    "REFR-7",
    "REFR-9",
    "TREE-1",
    "TREE-2",
)
@EVERY_FORM
@given(seed=SEEDS)
def test_the_closed_form_lies_in_the_certified_ball(form: Callable[[Random], Case], seed: int) -> None:
    case = form(Random(seed))
    check(case, case.x, case.y)


@pytest.mark.clause("SPH-2", "TRI-1", "SHAD-1", "SHAD-2", "REFR-2")
@pytest.mark.parametrize("form", WITH_AN_EDGE, ids=lambda form: form.__name__)
@given(seed=SEEDS)
def test_neighbouring_floats_on_both_sides_of_an_edge_have_the_closed_form_of_their_side(
    form: Callable[[Random], Case], seed: int
) -> None:
    case = form(Random(seed))
    ends = edge_on_line(case)
    if ends is not None:
        for x in ends:
            check(case, x, case.y)


def check(case: Case, x: float, y: float) -> None:
    truth, opinion = certified(case.scene, x, y), with_own_error(lambda: case.radiance(x, y))
    note_case(x=x, y=y)
    note(f"scene = {case.scene.model_dump_json()}\ntruth = {truth}\nclosed form = {opinion}")
    assert agree(truth, opinion)


def edge_on_line(case: Case) -> tuple[float, float] | None:
    """Two neighbouring floats on different sides of the case's edge in its row of the image; None if there is none."""
    assert case.side is not None
    with mp.workdps(DIGITS):
        columns = [float(x) for x in range(0, make.WIDTH + 1, 4)]
        sides = [case.side(x, case.y) for x in columns]
        place = next((i for i in range(len(sides) - 1) if sides[i] != sides[i + 1]), None)
        if place is None:
            return None
        low, high = columns[place], columns[place + 1]
        while math.nextafter(low, high) < high:
            middle = (low + high) / 2
            if case.side(middle, case.y) == sides[place]:
                low = middle
            else:
                high = middle
    return low, high


@pytest.mark.clause("PRJ-5")
@pytest.mark.parametrize("form", WITH_AN_EDGE, ids=lambda form: form.__name__)
def test_a_quarter_of_the_cases_with_an_edge_have_one_in_their_line(form: Callable[[Random], Case]) -> None:
    assert sum(edge_on_line(form(Random(seed))) is not None for seed in range(20)) >= 5


@pytest.mark.clause("IMG-1")
def test_a_pixel_is_seen_through_its_centre() -> None:
    """IMG-1: the cases themselves choose any point of the image."""
    case = sphere_in_parallel_projection(Random(1))
    with ctx.workprec(FEWEST_BITS):
        prepared = prepare(case.scene, ball_arithmetic(FEWEST_BITS, RaisingDecisions()))
        image = prepared.arithmetic.image(make.HEIGHT, make.WIDTH, 3)
        prepared.kernel.render_rows(prepared.data, 1, 0, make.HEIGHT, image)
    lit = 0
    for row in range(make.HEIGHT):
        for column in range(make.WIDTH):
            x, y = column + 0.5, row + 0.5
            opinion = with_own_error(lambda x=x, y=y: case.radiance(x, y))
            assert agree(list(image[row, column]), opinion), (column, row)
            lit += bool(opinion[0] > 0)
    assert lit > 0
