"""The tracer's source in mpmath's numbers: a second opinion on Arb and arithmetics/balls.py, not on formulas."""

from __future__ import annotations

from functools import cache
from random import Random
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, ctx
from mpmath import mp, mpf

from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic, make_kernel
from raytruth.reference_tracer.certification import Certifier
from raytruth.reference_tracer.tables import build_tables
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.requirements import required_features
from tests.second_opinion.truth import MORE_DIGITS, with_own_error

if TYPE_CHECKING:
    from raytruth.reference_tracer.arithmetics.kernel import Kernel
    from raytruth.reference_tracer.certification import Enclosure
    from raytruth.reference_tracer.source.scene_data import SceneData
    from raytruth.scenes.features import Feature

pytestmark = pytest.mark.clause("ARI-10")

PIXELS = 20


def mpmath_arithmetic() -> Arithmetic:
    """Numbers of the precision that mpmath is working in."""
    functions = {"exp": mp.exp, "floor": lambda x: int(mp.floor(x)), "inf": mp.inf, "pi": +mp.pi}
    return Arithmetic("mpmath", mpf, {**functions, "sqrt": mp.sqrt, "tan": mp.tan})


@pytest.mark.parametrize("name", library_names())
def test_mpmath_agrees_with_the_certified_truth_at_sampled_pixels(name: str) -> None:
    scene = open_scene(name)
    certifier = Certifier(scene)
    features = required_features(scene)
    data = build_tables(scene, features, mpmath_arithmetic())  # floats are exact in any precision
    numbers = Random(name)
    decided = 0
    for _ in range(PIXELS):
        column, row = numbers.randrange(scene.camera.width), numbers.randrange(scene.camera.height)
        pixel = certifier.pixel(column, row)
        opinion = with_own_error(lambda column=column, row=row: traced(features, data, column, row))
        decided += pixel.undecided is None
        outcomes = (pixel,) if pixel.undecided is None else pixel.undecided.outcomes
        assert any(holds(outcome, opinion) for outcome in outcomes), (column, row, pixel, opinion)
    assert decided > 0


def traced(features: frozenset[Feature], data: SceneData, column: int, row: int) -> Any:
    """The pixel's value in the precision that mpmath is working in."""
    kernel = kernel_in_mpmath(features, mp.prec)
    return kernel.radiance_at(data, kernel.camera_frame(data), column + mpf(0.5), row + mpf(0.5))


@cache
def kernel_in_mpmath(features: frozenset[Feature], precision: int) -> Kernel:
    assert precision == mp.prec, "π has as many digits as mpmath works with"
    return make_kernel(mpmath_arithmetic(), features)


def holds(enclosure: Enclosure, opinion: list[Any]) -> bool:
    with ctx.workdps(MORE_DIGITS):
        channels = zip(enclosure.middle, enclosure.radius, opinion, strict=True)
        return all(arb(middle, radius).overlaps(ball) for middle, radius, ball in channels)
