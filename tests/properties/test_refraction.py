from __future__ import annotations

from fractions import Fraction
from math import sqrt

from hypothesis import assume, given
from hypothesis import strategies as st

from reference_tracer.refraction import fresnel_reflectance, medium_transmittance, snell_discriminant
from tests.properties.exact import cross, dot, gamma
from tests.properties.strategies import Refraction, cosines_and_ratios, rational_refractions
from tests.reference_tracer.kernels import exact_kernel
from tests.reproduction import note_case


def born_wolf(cosine: Fraction, g: Fraction, ratio: Fraction) -> Fraction:
    """R = (r_s² + r_p²)/2 with the coefficients as the textbook has them."""
    perpendicular = (cosine - g) / (cosine + g)
    parallel = (ratio**2 * cosine - g) / (ratio**2 * cosine + g)
    return (perpendicular**2 + parallel**2) / 2


@given(rational_refractions())
def test_the_refracted_direction_obeys_snells_law_exactly(case: Refraction) -> None:
    kernel = exact_kernel()
    assert kernel.snell_discriminant(case.cosine, case.ratio) == case.g**2
    refracted = kernel.refracted_direction(case.direction, case.normal, case.cosine, case.g, case.ratio)
    assert dot(refracted, refracted) == 1
    assert dot(refracted, case.normal) == -case.g / case.ratio
    assert dot(refracted, case.tangent) == case.sine / case.ratio
    assert dot(refracted, cross(case.normal, case.tangent)) == 0


@given(rational_refractions())
def test_the_refracted_ray_reversed_is_refracted_into_the_reversed_ray(case: Refraction) -> None:
    kernel = exact_kernel()
    refracted = kernel.refracted_direction(case.direction, case.normal, case.cosine, case.g, case.ratio)
    arriving = (-refracted[0], -refracted[1], -refracted[2])
    turned = (-case.normal[0], -case.normal[1], -case.normal[2])
    cosine = -dot(arriving, turned)
    back_ratio = 1 / case.ratio
    g = kernel.sqrt(kernel.snell_discriminant(cosine, back_ratio))
    back = kernel.refracted_direction(arriving, turned, cosine, g, back_ratio)
    assert back == (-case.direction[0], -case.direction[1], -case.direction[2])


@given(rational_refractions())
def test_the_reflectance_is_the_textbooks_the_same_from_both_sides_and_a_fraction(case: Refraction) -> None:
    reflectance = exact_kernel().fresnel_reflectance(case.cosine, case.g, case.ratio)
    beyond = case.g / case.ratio
    if case.cosine == 0:
        assert reflectance == 1
        return
    assert reflectance == born_wolf(case.cosine, case.g, case.ratio)
    assert 0 <= reflectance <= 1
    if beyond != 0:
        assert exact_kernel().fresnel_reflectance(beyond, case.cosine / case.ratio, 1 / case.ratio) == reflectance


@given(rational_refractions())
def test_reflected_and_transmitted_power_add_up(case: Refraction) -> None:
    assume(case.cosine > 0)
    # Transmitted power by the amplitudes t_s and t_p and the beam's width: (g/c)·t² of each polarisation.
    across = 2 * case.cosine / (case.cosine + case.g)
    within = 2 * case.ratio * case.cosine / (case.ratio**2 * case.cosine + case.g)
    transmitted = case.g / case.cosine * (across**2 + within**2) / 2
    assert exact_kernel().fresnel_reflectance(case.cosine, case.g, case.ratio) + transmitted == 1


@given(st.fractions(Fraction(1, 1000), 1000, max_denominator=1000))
def test_head_on_the_reflectance_is_that_of_the_indices_alone(ratio: Fraction) -> None:
    reflectance = exact_kernel().fresnel_reflectance(Fraction(1), ratio, ratio)
    assert reflectance == ((ratio - 1) / (ratio + 1)) ** 2


@given(st.integers(1, 60), st.integers(1, 60))
def test_at_brewsters_angle_no_light_of_one_polarisation_is_reflected(a: int, b: int) -> None:
    assume(a != b)
    # tan θ = η with rational sine and cosine: a Pythagorean triple.
    cosine, sine = Fraction(2 * a * b, a * a + b * b), Fraction(abs(a * a - b * b), a * a + b * b)
    ratio = sine / cosine
    g = exact_kernel().sqrt(exact_kernel().snell_discriminant(cosine, ratio))
    perpendicular = (cosine - g) / (cosine + g)
    assert exact_kernel().fresnel_reflectance(cosine, g, ratio) == perpendicular**2 / 2


@given(cosines_and_ratios())
def test_total_reflection_happens_exactly_if_exact_arithmetic_says_so(case: tuple[float, float]) -> None:
    cosine, ratio = case
    note_case(cosine=cosine, ratio=ratio)
    excess, squared = Fraction(ratio) ** 2 - 1, Fraction(cosine) ** 2
    # Three roundings in (η-1)·(η+1), one in c², one in the sum.
    assume(abs(excess + squared) > gamma(4) * (abs(excess) + squared))
    assert (snell_discriminant(cosine, ratio) < 0) == (excess + squared < 0)


@given(cosines_and_ratios())
def test_rounding_never_makes_a_reflectance_leave_0_to_1(case: tuple[float, float]) -> None:
    cosine, ratio = case
    discriminant = snell_discriminant(cosine, ratio)
    assume(discriminant >= 0)
    note_case(cosine=cosine, ratio=ratio)
    reflectance = fresnel_reflectance(cosine, sqrt(discriminant), ratio)
    # The quotient r_p/r_s is in [-1, 1] since rounding keeps order. For η < 1, (g + c)² >= c² >= 1 - η² for the same
    # reason. For η > 1, (g + c)² >= g² up to the roundings of the sum, the root, and the square.
    assert 0 <= reflectance <= 1 + gamma(8)
    if ratio <= 1:
        assert reflectance <= 1


@given(cosines_and_ratios())
def test_rounding_changes_a_reflectance_by_less_than_derived(case: tuple[float, float]) -> None:
    cosine, ratio = case
    discriminant = snell_discriminant(cosine, ratio)
    assume(discriminant >= 0)
    note_case(cosine=cosine, ratio=ratio)
    g = sqrt(discriminant)
    c, eta, root = Fraction(cosine), Fraction(ratio), Fraction(g)
    perpendicular = (eta - 1) * (eta + 1) / (root + c) ** 2
    ideal = exact_kernel().fresnel_reflectance(c, root, eta)
    # r_s: γ(3) in the numerator, γ(3) in the denominator, and the division; so γ(15) in the square. The quotient: γ(4)
    # of the sum of both terms above and below, and the division, so γ(19) in 1 + square; three products more.
    doubt = gamma(40) * perpendicular**2
    assert abs(Fraction(fresnel_reflectance(cosine, g, ratio)) - ideal) <= doubt


@given(st.floats(0, 10), st.floats(0, 10), st.floats(1e-3, 30))
def test_a_medium_transmits_a_part_of_the_light_and_less_the_longer_the_way(
    a: float, b: float, distance: float
) -> None:
    note_case(absorption=(a, b, 0.0), distance=distance)
    transmittance = medium_transmittance((a, b, 0.0), distance)
    assert all(0 <= part <= 1 for part in transmittance)
    assert transmittance[2] == 1
    longer = medium_transmittance((a, b, 0.0), 2 * distance)
    assert all(after <= before for before, after in zip(transmittance, longer, strict=True))
