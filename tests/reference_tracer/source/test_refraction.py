from __future__ import annotations

from fractions import Fraction
from math import sqrt

import mpmath
import pytest

from raytruth.reference_tracer.source.refraction import (
    fresnel_reflectance,
    medium_transmittance,
    refracted_direction,
    snell_discriminant,
)
from tests.reference_tracer.kernels import exact_kernel

NORMAL = (0.0, 0.0, 1.0)


@pytest.mark.clause("REFR-3")
def test_a_ray_along_the_normal_is_not_turned() -> None:
    assert refracted_direction((0.0, 0.0, -1.0), NORMAL, 1.0, 1.5, 1.5) == (0.0, 0.0, -1.0)


@pytest.mark.clause("REFR-8")
def test_equal_indices_neither_turn_nor_reflect() -> None:
    assert snell_discriminant(0.25, 1.0) == 0.0625
    assert fresnel_reflectance(0.25, 0.25, 1.0) == 0.0


@pytest.mark.clause("REFR-2")
def test_exactly_at_the_critical_angle_all_is_reflected_and_nothing_is_totally_reflected() -> None:
    cosine, ratio = Fraction(4, 5), Fraction(3, 5)  # sin θ = η
    assert exact_kernel().snell_discriminant(cosine, ratio) == 0
    assert exact_kernel().fresnel_reflectance(cosine, Fraction(0), ratio) == 1


@pytest.mark.clause("REFR-4")
def test_grazing_light_is_reflected() -> None:
    assert fresnel_reflectance(0.0, sqrt(1.25), 1.5) == 1.0
    assert fresnel_reflectance(0.0, 0.0, 1.0) == 1.0


@pytest.mark.clause("REFR-4")
@pytest.mark.parametrize("ratio", [1e-6, 1e-3, 0.5, 1 - 2**-30, 1 + 2**-30, 1.5, 1e3, 1e6])
def test_head_on_reflectances_are_right_for_every_index(ratio: float) -> None:
    g = sqrt(snell_discriminant(1.0, ratio))
    with mpmath.workprec(200):
        exact = ((mpmath.mpf(ratio) - 1) / (mpmath.mpf(ratio) + 1)) ** 2
        # R = r_s² with r_s = (η² - 1)/(g + 1)²: γ(15) for its own operations. An error e of g changes (g + 1)^-4 by the
        # factor 4·e/(1 + g): for η >= 1, where g is off by γ(4)·g, that is γ(16) more. For small η, g² = η² is what
        # is left of 1 - 1, off by γ(4) of 1, and so g by γ(4)/(2·η) and R by 8·2^-53/η.
        unit_roundoff = mpmath.mpf(2) ** -53
        lost = 8 * unit_roundoff / ratio if ratio < 1 else 0
        assert abs(fresnel_reflectance(1.0, g, ratio) - exact) <= exact * 32 * unit_roundoff + lost


@pytest.mark.clause("REFR-4")
def test_close_to_equal_indices_the_reflectance_keeps_its_digits() -> None:
    # Head on, η = 1 + ε: R = (ε/(2 + ε))², 7e-20 here, where (c - g)/(c + g) has lost half of its digits.
    ratio = 1.0 + 2.0**-31
    exact = (2.0**-31 / (2.0 + 2.0**-31)) ** 2
    computed = fresnel_reflectance(1.0, sqrt(snell_discriminant(1.0, ratio)), ratio)
    assert abs(computed - exact) <= 32 * 2.0**-53 * exact


@pytest.mark.clause("REFR-7")
def test_light_fades_exponentially_in_a_medium() -> None:
    assert medium_transmittance((0.0, 0.0, 0.0), 5.0) == (1.0, 1.0, 1.0)
    one, two, three = medium_transmittance((1.0, 2.0, 3.0), 0.5)
    assert (one, two, three) == tuple(float(mpmath.exp(-x)) for x in (0.5, 1.0, 1.5))
