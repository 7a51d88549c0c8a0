"""Feasible sets are proofs: what an arithmetic really computes must lie in the set of that arithmetic, everywhere.

The tracer's own source runs on NumPy's float32 and on Python floats, operation by operation in the order that the balls
follow. A bound that forgot a rounding would be broken by some of these 12,000 pixels; that this is so is tested, too.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import UNJUDGED, distances_in_tolerances
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, INTERPRETED_FLOAT32, Arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import library_names
from tests.reference_tracer.small_scenes import library_scene

pytestmark = pytest.mark.clause("VER-2")

WIDTH, HEIGHT = 20, 15

# exp, tan and powers may err by some units in the last place, of which 24 and 53 bits allow half a one.
LIBRARY_BITS = 2


def outside(name: str, arithmetic: Arithmetic, bits: int) -> tuple[int, int]:
    """How many pixels lie outside their set, and how many cannot be judged."""
    scene = library_scene(name, WIDTH, HEIGHT)
    output = OutputModel("float32" if arithmetic is INTERPRETED_FLOAT32 else "float64")
    feasible = feasible_set(scene, ErrorModel("", bits, output=output))
    with np.errstate(all="ignore"):
        image: Any = render(scene, arithmetic, Behaviour(PLAIN_FORMS))
    distances = distances_in_tolerances(image.astype(np.float64), feasible)
    return int((distances > 1).sum()), int((distances == UNJUDGED).sum())


@pytest.mark.clause("ARI-4")
@pytest.mark.parametrize("name", library_names())
def test_what_float32_computes_lies_in_its_feasible_set_at_every_pixel(name: str) -> None:
    failing, unjudged = outside(name, INTERPRETED_FLOAT32, 24 - LIBRARY_BITS)
    assert failing == 0
    assert unjudged <= WIDTH * HEIGHT / 100


@pytest.mark.parametrize("name", library_names())
def test_what_python_floats_compute_lies_in_their_feasible_set_at_every_pixel(name: str) -> None:
    assert outside(name, FLOAT, 53 - LIBRARY_BITS) == (0, 0)


@pytest.mark.parametrize("name", ["concave-mirror", "glass-sphere", "coloured-mirrors", "plane-mirror"])
def test_a_bound_for_more_bits_than_were_used_is_broken(name: str) -> None:
    # Five bits too many: roundings rarely all go one way, so that a few bits of a right bound are not used.
    failing, _ = outside(name, INTERPRETED_FLOAT32, 29)
    assert failing > 0
