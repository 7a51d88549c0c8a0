"""Attenuation, highlights and mirror directions at the ends of their ranges, against ball arithmetic."""

from __future__ import annotations

from math import inf, isfinite, isnan, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import given, target

from raytruth.reference_tracer.rendering import render
from raytruth.reference_tracer.source import scene_data as layout
from raytruth.reference_tracer.source.illumination import blinn, phong
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.refraction import medium_transmittance
from tests.properties.optical_strategies import DISTANCES, EXPONENTS, NOT_NUMBERS
from tests.properties.strategies import Vector, directions
from tests.reference_tracer.kernels import float_kernel, kept_precision, scene_data
from tests.reference_tracer.small_scenes import lamp, small_scene
from tests.reproduction import note_case

if TYPE_CHECKING:
    from collections.abc import Iterator

UNIT_ROUNDOFF = 2.0**-53
# What the platform's `pow` and `exp` may err, in roundoffs: two units in the last place.
LIBRARY_ROUNDOFFS = 4


@pytest.fixture(scope="module")
def balls_of_200_bits() -> Iterator[None]:
    for _ in kept_precision():
        ctx.prec = 200
        yield


def lights(kind: int) -> layout.SceneData:
    return scene_data({layout.LIGHT_FALLOFF: [kind], layout.LIGHT_FALLOFF_COEFFICIENTS: [(0.5, 0.25, 0.125)]})


@pytest.mark.clause("ILL-7")
@pytest.mark.usefixtures("balls_of_200_bits")
@given(DISTANCES)
def test_attenuation_is_right_to_a_few_roundings_at_every_distance(distance: float) -> None:
    squared = distance * distance
    note_case(distance=distance)
    attenuation: Any = float_kernel().attenuation
    assert attenuation(lights(0), 0, squared) == 1.0
    polynomial = attenuation(lights(2), 0, squared)
    exact = 1 / (arb("0.5") + arb(squared).sqrt() / 4 + arb(squared) / 8) if squared else arb(2)
    limited = exact.min(arb(1))
    # A root, two products, two sums and the division; the sums are of positive numbers.
    assert abs(arb(polynomial) - limited) <= 6 * UNIT_ROUNDOFF * limited
    if squared > 0:
        assert attenuation(lights(1), 0, squared) == 1.0 / squared
        assert isfinite(attenuation(lights(1), 0, squared))


@pytest.mark.clause("ILL-9")
@pytest.mark.parametrize("falloff", ["none", "inverse_square", {"constant": 0.0, "linear": 0.0, "quadratic": 1.0}])
def test_a_light_at_the_very_point_of_a_surface_adds_nothing(falloff: Any) -> None:
    # The camera sees the point (0, 0, 1) exactly, where the light is.
    assert not render(small_scene(lights=[lamp((0.0, 0.0, 1.0), 1.0, falloff)])).any()
    beside = render(small_scene(lights=[lamp((0.0, 0.0, 1.0 + 2.0**-50), 1.0, falloff)]))
    assert np.isfinite(beside).all()
    assert (beside > 0).all()


@pytest.mark.clause("ILL-5", "ILL-6")
@pytest.mark.usefixtures("balls_of_200_bits")
@given(directions(), directions(), directions(), EXPONENTS)
def test_highlights_are_in_0_to_1_and_right_for_the_cosine(
    normal: Vector, direction: Vector, toward_light: Vector, exponent: float
) -> None:
    note_case(normal=normal, direction=direction, toward_light=toward_light, exponent=exponent)
    mirrored = mirror_direction(direction, normal)
    cosine = sum(a * b for a, b in zip(mirrored, toward_light, strict=True))
    highlight = phong(normal, direction, toward_light, exponent)
    # Cosines of unit vectors within rounding: 3 roundings each in the vectors, 5 in the mirroring, 3 in the product.
    largest = (1 + arb(16 * UNIT_ROUNDOFF)) ** arb(exponent)
    assert highlight >= 0.0
    assert arb(highlight) <= largest * (1 + LIBRARY_ROUNDOFFS * UNIT_ROUNDOFF)
    exact = arb(cosine) ** arb(exponent) if cosine > 0 else arb(0)
    # Below the smallest normal number a unit is not relative any more.
    error = abs(arb(highlight) - exact)
    assert error <= LIBRARY_ROUNDOFFS * UNIT_ROUNDOFF * exact + arb(2) ** -1074
    if exact > arb(2) ** -1000:
        target(float(error / exact / UNIT_ROUNDOFF), label="roundoffs of a power")
    if any(a != b for a, b in zip(toward_light, direction, strict=True)):
        assert arb(blinn(normal, direction, toward_light, exponent)) <= largest * (
            1 + LIBRARY_ROUNDOFFS * UNIT_ROUNDOFF
        )


@pytest.mark.clause("ILL-5", "ILL-6")
@pytest.mark.parametrize("exponent", [1e-6, 1.0, 1e6, 1e12])
@pytest.mark.parametrize("highlight", [phong, blinn])
def test_a_highlight_seen_head_on_is_1_and_one_from_behind_0(highlight: Any, exponent: float) -> None:
    up, down, aside = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0)
    assert highlight(up, down, up, exponent) == 1.0
    assert highlight(up, down, aside, exponent) < 1.0
    assert phong(up, down, aside, exponent) == 0.0
    assert phong(up, down, down, exponent) == 0.0


@pytest.mark.clause("REFR-7")
@given(DISTANCES)
def test_a_medium_transmits_between_all_and_nothing_at_every_distance(distance: float) -> None:
    clear, tinted, black = medium_transmittance((0.0, 1.0, 1e12), distance)
    assert clear == 1.0
    assert 0.0 <= black <= tinted <= 1.0
    assert tinted > 0 or distance > 700


@pytest.mark.clause("NUM-2")
@given(NOT_NUMBERS)
def test_what_is_not_a_number_stays_so(wrong: float) -> None:
    first, _, third = mirror_direction((wrong, 0.0, 0.0), (0.6, 0.0, 0.8))
    assert not isfinite(first)
    assert not isfinite(third)
    if isnan(wrong):
        assert isnan(medium_transmittance((wrong, wrong, wrong), 1.0)[0])
        assert isnan(float_kernel().attenuation(lights(1), 0, wrong))


@pytest.mark.clause("NUM-2")
def test_signed_zeros_are_equal_and_infinite_distances_let_nothing_through() -> None:
    assert mirror_direction((0.0, 0.0, -1.0), (-0.0, -0.0, 1.0)) == mirror_direction((-0.0, 0.0, -1.0), (0.0, 0.0, 1.0))
    assert medium_transmittance((1.0, 1.0, 1.0), inf) == (0.0, 0.0, 0.0)
    assert float_kernel().attenuation(lights(1), 0, inf) == 0.0
    assert float_kernel().attenuation(lights(2), 0, inf) == 0.0


# The sharpest highlights: a cosine one unit under 1 to a large power. Exhaustive over the last 8 units.
@pytest.mark.clause("ILL-5")
@pytest.mark.parametrize("ulps", range(1, 9))
def test_the_sharpest_highlight_falls_off_with_the_angle(ulps: int) -> None:
    cosine = 1.0 - ulps * UNIT_ROUNDOFF
    toward_light = (sqrt((1.0 - cosine) * (1.0 + cosine)), 0.0, cosine)
    up, down = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
    assert phong(up, down, toward_light, 1e12) == pytest.approx(np.exp(-1e12 * ulps * UNIT_ROUNDOFF), rel=2.0**-40)
