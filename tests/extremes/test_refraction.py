"""Worst cases of refraction: decisions within 8 ulp of the critical angle, and the reflectances that lose most bits."""

from __future__ import annotations

from fractions import Fraction
from math import sqrt

import mpmath
import pytest

from raytruth.reference_tracer.source.refraction import fresnel_reflectance, snell_discriminant
from tests.properties.exact import gamma
from tests.properties.optical_strategies import MOST_ULPS, SMALLEST_SUBNORMAL, moved

RATIOS = [1 / 1.5, 0.6, 0.8, 1 / 1.33, 1 / 2.42, 1e-3, 1.0 - 1e-6, 1.0 - 2.0**-53]


@pytest.mark.clause("REFR-2", "REFR-8")
@pytest.mark.parametrize("ratio", RATIOS, ids=float.hex)
def test_within_8_ulp_of_the_critical_angle_a_wrong_decision_weighs_next_to_nothing(ratio: float) -> None:
    """Exhaustive over the 17 floats around the critical cosine."""
    critical = sqrt((1.0 - ratio) * (1.0 + ratio))
    for ulps in range(-MOST_ULPS, MOST_ULPS + 1):
        cosine = moved(critical, ulps)
        squared = Fraction(cosine) ** 2
        exactly = Fraction(ratio) ** 2 - 1 + squared
        computed = snell_discriminant(cosine, ratio)
        assert abs(Fraction(computed) - exactly) <= gamma(4) * 2 * squared
        if computed >= 0:
            g = sqrt(computed)
            # 1 - R <= 2·(g/c)·(1 + 1/η²): g² is 8 ulp of c², 16 of 2^-52, and its rounding.
            most = 2 * sqrt(16 * 2.0**-52 + 8 * 2.0**-53) * (1 + 1 / ratio**2)
            assert 1 - most <= fresnel_reflectance(cosine, g, ratio) <= 1
        if abs(ulps) >= 4:
            # So far from it every decision is right: c² is off by 8 ulp, eight roundings.
            assert (computed < 0) == (exactly < 0)


# Best found among 80,000 draws: cosines uniform, near 0 and near 1; indices 1 + 1e-15 to 1.1, and 1.1 to 1000.
# Beside each its error in units of 2^-53 of R.
WORST_REFLECTANCES = [
    ("0x1.1cd2afbca88bfp-17", "0x1.0000000000005p+0"),  # 13.3: grazing, nearly equal indices
    ("0x1.fff9b455c0284p-1", "0x1.005531313feedp+0"),  # 12.4: nearly head on
    ("0x1.ffff76286a529p-1", "0x1.02c9dfba14ecbp+5"),  # 12.1: nearly head on, index 32
    ("0x1.934a468f4bb43p-1", "0x1.0c8d8aa192933p+6"),  # 11.0: index 67
]


@pytest.mark.clause("REFR-4")
@pytest.mark.parametrize(("cosine", "ratio"), WORST_REFLECTANCES)
def test_a_reflectance_into_the_denser_medium_loses_no_more_than_its_roundings(cosine: str, ratio: str) -> None:
    c, eta = float.fromhex(cosine), float.fromhex(ratio)
    computed = fresnel_reflectance(c, sqrt(snell_discriminant(c, eta)), eta)
    with mpmath.workprec(400):
        g = mpmath.sqrt(mpmath.mpf(eta) ** 2 - 1 + mpmath.mpf(c) ** 2)
        across = (c - g) / (c + g)
        within = (mpmath.mpf(eta) ** 2 * c - g) / (mpmath.mpf(eta) ** 2 * c + g)
        exact = (across**2 + within**2) / 2
        # 40 roundings of its own; g is off by 3, which enter in the fourth power at most.
        assert abs(computed - exact) <= 52 * mpmath.mpf(2) ** -53 * exact


@pytest.mark.clause("REFR-4")
@pytest.mark.parametrize("cosine", [0.0, -0.0, SMALLEST_SUBNORMAL, 1e-200, 1e-162])
@pytest.mark.parametrize("ratio", [1.0, 1.5, 1e3])
def test_grazing_light_is_reflected_even_where_the_cosines_square_underflows(cosine: float, ratio: float) -> None:
    assert fresnel_reflectance(cosine, sqrt(snell_discriminant(cosine, ratio)), ratio) == 1.0


@pytest.mark.clause("REFR-8")
def test_equal_indices_reflect_nothing_down_to_the_smallest_cosine_whose_square_is_a_number() -> None:
    for cosine in (1.0, 1e-8, 1e-100, 1e-153, 2.3e-162):
        assert fresnel_reflectance(cosine, sqrt(snell_discriminant(cosine, 1.0)), 1.0) == 0.0
