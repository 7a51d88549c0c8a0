from __future__ import annotations

import numpy as np
import pytest

from raytruth.comparisons.measures.public_gates import GATES, as_picture, gates_that_reject

pytestmark = pytest.mark.clause("VER-11")

TRUTH = np.random.default_rng(7).uniform(0.05, 0.95, (16, 20, 3))
TRUTH.flags.writeable = False


def changed(pixels: int, by: float) -> np.ndarray:
    """The truth with so many pixels off by so much."""
    image = TRUTH.copy()
    image.reshape(-1, 3)[:pixels] += by
    return image


def test_no_gate_rejects_the_truth_and_all_reject_what_is_not_a_number() -> None:
    assert gates_that_reject(TRUTH, TRUTH) == ()
    assert gates_that_reject(TRUTH * np.nan, TRUTH) == tuple(GATES)


def test_every_gate_rejects_another_picture() -> None:
    assert gates_that_reject(TRUTH[::-1, ::-1] * 0.3, TRUTH) == tuple(GATES)


@pytest.mark.parametrize(
    ("gate", "passing", "failing"),
    [
        ("mean ±2.5 %", TRUTH * 1.024, TRUTH * 1.026),
        ("8 components over 2/255", changed(2, 0.5), changed(3, 0.5)),
        ("0.016 on 1 % of pixels", changed(3, 0.5), changed(4, 0.5)),
        ("pixelmatch 0.2 on 5 % of pixels", changed(16, 3.0), changed(40, 3.0)),
    ],
)
def test_a_gate_opens_where_it_says(gate: str, passing: np.ndarray, failing: np.ndarray) -> None:
    assert gate not in gates_that_reject(passing, TRUTH)
    assert gate in gates_that_reject(failing, TRUTH)


def test_pictures_are_codes_of_srgb() -> None:
    assert as_picture(np.array([-1.0, 0.0, 0.0031308, 0.5, 1.0, 7.0])).tolist() == [0, 0, 10, 188, 255, 255]
