from __future__ import annotations

from fractions import Fraction
from math import isfinite, log2, sqrt
from typing import TYPE_CHECKING

import pytest
from flint import arb, ctx
from hypothesis import assume, given, target
from hypothesis import strategies as st

from raytruth.reference_tracer.source.refraction import (
    fresnel_reflectance,
    medium_transmittance,
    refracted_direction,
    snell_discriminant,
)
from tests.properties.exact import cross, dot, exact, gamma
from tests.properties.optical_strategies import EXTREME_RATIOS, incidences
from tests.properties.strategies import Refraction, cosines_and_ratios, directions, perpendiculars, rational_refractions
from tests.reference_tracer.kernels import exact_kernel, kept_precision
from tests.reproduction import note_case

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.properties.strategies import Vector


@pytest.fixture(scope="module")
def balls_of_400_bits() -> Iterator[None]:
    for _ in kept_precision():
        ctx.prec = 400  # a cosine's square has 106 bits, and nearly equal indices cancel 50 of them again and again
        yield


def born_wolf(cosine: Fraction, g: Fraction, ratio: Fraction) -> Fraction:
    """R = (r_s² + r_p²)/2 with the coefficients as the textbook has them."""
    perpendicular = (cosine - g) / (cosine + g)
    parallel = (ratio**2 * cosine - g) / (ratio**2 * cosine + g)
    return (perpendicular**2 + parallel**2) / 2


@pytest.mark.clause("REFR-3")
@given(rational_refractions())
def test_the_refracted_direction_obeys_snells_law_exactly(case: Refraction) -> None:
    kernel = exact_kernel()
    assert kernel.snell_discriminant(case.cosine, case.ratio) == case.g**2
    refracted = kernel.refracted_direction(case.direction, case.normal, case.cosine, case.g, case.ratio)
    assert dot(refracted, refracted) == 1
    assert dot(refracted, case.normal) == -case.g / case.ratio
    assert dot(refracted, case.tangent) == case.sine / case.ratio
    assert dot(refracted, cross(case.normal, case.tangent)) == 0


@pytest.mark.clause("REFR-3")
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


@pytest.mark.clause("REFR-4", "REFR-8")
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


@pytest.mark.clause("REFR-4")
@given(rational_refractions())
def test_reflected_and_transmitted_power_add_up(case: Refraction) -> None:
    assume(case.cosine > 0)
    # Transmitted power by the amplitudes t_s and t_p and the beam's width: (g/c)·t² of each polarisation.
    across = 2 * case.cosine / (case.cosine + case.g)
    within = 2 * case.ratio * case.cosine / (case.ratio**2 * case.cosine + case.g)
    transmitted = case.g / case.cosine * (across**2 + within**2) / 2
    assert exact_kernel().fresnel_reflectance(case.cosine, case.g, case.ratio) + transmitted == 1


@pytest.mark.clause("REFR-4")
@given(st.fractions(Fraction(1, 1000), 1000, max_denominator=1000))
def test_head_on_the_reflectance_is_that_of_the_indices_alone(ratio: Fraction) -> None:
    reflectance = exact_kernel().fresnel_reflectance(Fraction(1), ratio, ratio)
    assert reflectance == ((ratio - 1) / (ratio + 1)) ** 2


@pytest.mark.clause("REFR-4")
@given(st.integers(1, 60), st.integers(1, 60))
def test_at_brewsters_angle_no_light_of_one_polarisation_is_reflected(a: int, b: int) -> None:
    assume(a != b)
    # tan θ = η with rational sine and cosine: a Pythagorean triple.
    cosine, sine = Fraction(2 * a * b, a * a + b * b), Fraction(abs(a * a - b * b), a * a + b * b)
    ratio = sine / cosine
    g = exact_kernel().sqrt(exact_kernel().snell_discriminant(cosine, ratio))
    perpendicular = (cosine - g) / (cosine + g)
    assert exact_kernel().fresnel_reflectance(cosine, g, ratio) == perpendicular**2 / 2


@pytest.mark.clause("REFR-2")
@given(cosines_and_ratios())
def test_total_reflection_happens_exactly_if_exact_arithmetic_says_so(case: tuple[float, float]) -> None:
    cosine, ratio = case
    note_case(cosine=cosine, ratio=ratio)
    excess, squared = Fraction(ratio) ** 2 - 1, Fraction(cosine) ** 2
    # Three roundings in (η-1)·(η+1), one in c², one in the sum.
    assume(abs(excess + squared) > gamma(4) * (abs(excess) + squared))
    assert (snell_discriminant(cosine, ratio) < 0) == (excess + squared < 0)


@pytest.mark.clause("REFR-8")
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


@pytest.mark.clause("REFR-4")
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


@pytest.mark.clause("REFR-7")
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


def doubt_of_discriminant(cosine: float, ratio: float) -> Fraction:
    """How far rounding may move g²: three roundings in (η-1)·(η+1), one in c², one in the sum; and underflow."""
    c, eta = Fraction(cosine), Fraction(ratio)
    return gamma(4) * (abs(eta**2 - 1) + c**2) + Fraction(2) ** -1073


def ball_of(exact_value: Fraction, radius: Fraction = Fraction(0)) -> arb:
    """A ball that holds everything up to `radius` from a rational number."""
    value = arb(exact_value.numerator) / exact_value.denominator
    return value + arb(0, arb(radius.numerator) / radius.denominator)


def born_wolf_in_balls(c: arb, g: arb, eta: arb) -> arb:
    """As born_wolf."""
    across = (c - g) / (c + g)
    within = (eta**2 * c - g) / (eta**2 * c + g)
    return (across**2 + within**2) / 2


@pytest.mark.clause("REFR-8", "NUM-2")
@given(incidences())
def test_a_reflectance_at_the_extremes_is_a_finite_fraction(case: tuple[float, float]) -> None:
    cosine, ratio = case
    discriminant = snell_discriminant(cosine, ratio)
    assert isfinite(discriminant)
    assume(discriminant >= 0)
    note_case(cosine=cosine, ratio=ratio)
    reflectance = fresnel_reflectance(cosine, sqrt(discriminant), ratio)
    # As in the property for tame cases; a cosine beyond 1 by four units makes the quotient exceed 1 by its share of g.
    assert 0 <= reflectance <= 1 + gamma(40) / Fraction(min(ratio, 1.0))
    assert reflectance + (1.0 - reflectance) == pytest.approx(1.0, abs=2.0**-53)


@pytest.mark.clause("REFR-4")
@pytest.mark.usefixtures("balls_of_400_bits")
@given(incidences())
def test_a_reflectance_at_the_extremes_is_that_of_an_angle_within_rounding(case: tuple[float, float]) -> None:
    cosine, ratio = case
    discriminant = snell_discriminant(cosine, ratio)
    assume(discriminant >= 0)
    assume(2.0**-500 < cosine <= 1)
    note_case(cosine=cosine, ratio=ratio)
    computed = fresnel_reflectance(cosine, sqrt(discriminant), ratio)
    c, eta = Fraction(cosine), Fraction(ratio)
    discriminants = [eta**2 - 1 + c**2 + sign * doubt_of_discriminant(cosine, ratio) for sign in (-1, 0, 1)]
    lowest, g, highest = (ball_of(max(Fraction(0), g2)).sqrt() for g2 in discriminants)
    # All that R can be with a g that far off, as a ball: in the form whose factors are each known to a few roundings.
    some_g = lowest.union(highest)
    sine_squared = ball_of(1 - c**2)
    across = ball_of(eta**2 - 1) / (ball_of(c) + some_g) ** 2
    within = (ball_of(c) * some_g - sine_squared) / (ball_of(c) * some_g + sine_squared)
    possible = across**2 / 2 * (1 + within**2)
    true = born_wolf_in_balls(ball_of(c), g, ball_of(eta))
    assert possible.overlaps(true)
    assert (possible * (1 + ball_of(Fraction(0), gamma(40)))).contains(arb(computed))
    if true > 0:
        error = float(abs(arb(computed) / true - 1))
        target(log2(max(error, 2.0**-60)) + 53, label="bits of reflectance lost")


@pytest.mark.clause("REFR-2")
@given(incidences())
def test_total_reflection_at_the_extremes_is_decided_rightly_but_within_rounding(case: tuple[float, float]) -> None:
    cosine, ratio = case
    note_case(cosine=cosine, ratio=ratio)
    exactly = Fraction(ratio) ** 2 - 1 + Fraction(cosine) ** 2
    computed = snell_discriminant(cosine, ratio)
    error = abs(Fraction(computed) - exactly)
    assert error <= doubt_of_discriminant(cosine, ratio)
    if exactly:
        target(min(100.0, log2(max(float(error / abs(exactly)), 2.0**-60)) + 53), label="bits of g² lost")


@pytest.mark.clause("REFR-3")
@given(directions(), st.data(), EXTREME_RATIOS, st.floats(0, 1), st.sampled_from([1.0, -1.0]))
def test_a_refracted_direction_is_as_long_as_the_index_ratio_lets_it_be_known(
    normal: Vector, data: st.DataObject, ratio: float, sine: float, side: float
) -> None:
    tangent = data.draw(perpendiculars(normal))
    cosine = sqrt((1.0 - sine) * (1.0 + sine))
    direction = tuple(side * sine * t - cosine * n for t, n in zip(tangent, normal, strict=True))
    c = -sum(d * n for d, n in zip(direction, normal, strict=True))
    discriminant = snell_discriminant(c, ratio)
    assume(c >= 0)
    assume(discriminant >= 0)
    note_case(direction=direction, normal=normal, ratio=ratio)
    refracted = refracted_direction(direction, normal, c, sqrt(discriminant), ratio)  # type: ignore[arg-type] # a triple
    squared = dot(exact(refracted), exact(refracted))
    # |d + (c - g)n|² = |d|² - c² + g² = η² where d, n and c are exact. They are off by γ(8) each (the unit vectors by
    # their normalisation, c by γ(3), d by its making), g² by γ(4)·(|η² - 1| + c²); all of it divided by η².
    eta = Fraction(ratio)
    assert abs(squared - 1) <= gamma(64) * (1 + 1 / eta + 1 / eta**2)


@pytest.mark.clause("NUM-2")
@given(st.sampled_from([float("nan"), float("inf")]), incidences())
def test_what_is_not_a_number_never_becomes_one(wrong: float, case: tuple[float, float]) -> None:
    cosine, ratio = case
    assert not isfinite(snell_discriminant(wrong, ratio))
    assert not isfinite(snell_discriminant(cosine, wrong))
    assume(cosine * cosine > 0)
    assert not fresnel_reflectance(cosine, float("nan"), ratio) >= 0
    assert not fresnel_reflectance(float("nan"), 1.0, ratio) >= 0
