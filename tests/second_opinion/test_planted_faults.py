"""A fault in the shared source makes a closed form differ: both sides do not share it."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.reference_tracer.ties import UndecidedComparisonError
from tests.second_opinion import flat_glass, mirrors, planted_faults, round_glass, shadows, surfaces
from tests.second_opinion.closed_forms import CLOSED_FORMS
from tests.second_opinion.truth import agree, certified, with_own_error

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.second_opinion.case import Case

pytestmark = pytest.mark.clause("ARI-10")


def of_catalogue(name: str) -> tuple[Callable[..., Any], str]:
    """A fault of the catalogue and the function that it replaces."""
    ((function, body),) = all_faults()[name].overrides.items()
    return body, function


# Fault, the function that it replaces, and a closed form that shows it.
PLANTED: list[tuple[Callable[..., Any], str, Callable[[Random], Case]]] = [
    (*of_catalogue("mirrored_image"), surfaces.lit_triangle),
    (*of_catalogue("half_a_pixel_off"), mirrors.mirror_corridor),
    (*of_catalogue("horizontal_field_of_view"), surfaces.checkerboard_floor),
    (*of_catalogue("one_over_distance"), surfaces.diffuse_sphere),
    (*of_catalogue("one_over_distance"), surfaces.lit_triangle),
    (planted_faults.cosine_squared, "direct_light", surfaces.diffuse_sphere),
    (planted_faults.cosine_squared, "direct_light", surfaces.sphere_in_parallel_projection),
    (planted_faults.no_pi, "diffuse", surfaces.checkerboard_floor),
    (planted_faults.unclamped_attenuation, "attenuation", surfaces.phong_sphere),
    (planted_faults.half_of_the_exponent, "phong", surfaces.phong_sphere),
    (*of_catalogue("phong_for_blinn"), surfaces.blinn_sphere),
    (planted_faults.parallelogram, "triangle_distance", surfaces.lit_triangle),
    (planted_faults.squares_in_one_floor, "is_even_square", surfaces.checkerboard_floor),
    (*of_catalogue("no_shadow_rays"), shadows.umbra_of_a_point_light),
    (*of_catalogue("no_shadow_rays"), shadows.shadow_of_the_sun),
    (planted_faults.upper_half_of_the_sky, "background_radiance", mirrors.mirror_sphere),
    (planted_faults.mirrored_behind_the_surface, "mirror_direction", mirrors.mirror_sphere),
    (*of_catalogue("reflection_one_percent_too_dark"), mirrors.mirror_corridor),
    (planted_faults.fresnel_without_half, "fresnel_reflectance", round_glass.glass_sphere_on_its_axis),
    (planted_faults.fresnel_without_half, "fresnel_reflectance", flat_glass.glass_slab),
    (*of_catalogue("schlick"), flat_glass.glass_slab),
    (*of_catalogue("schlick"), round_glass.glass_sphere),
    (planted_faults.radiance_not_scaled, "split", flat_glass.window_of_snell),
    (planted_faults.radiance_scaled_the_wrong_way, "split", flat_glass.prism_at_the_critical_angle),
    (*of_catalogue("inverted_index_ratio"), round_glass.glass_sphere),
    (*of_catalogue("every_ray_enters"), round_glass.bubble_in_glass),
    (planted_faults.discriminant_without_sign, "snell_discriminant", flat_glass.prism_at_the_critical_angle),
    (planted_faults.exchanged_constants, "split", flat_glass.slab_of_constant_weights),
    (planted_faults.total_reflection_of_everything, "total_reflection_weight", flat_glass.window_of_constant_weights),
    (planted_faults.linear_absorption, "medium_transmittance", round_glass.absorption_along_a_chord),
    (planted_faults.always_into_empty_space, "medium_beyond", round_glass.bubble_in_glass),
    (planted_faults.three_quarters_of_the_way, "distance_to_other_side", round_glass.absorption_along_a_chord),
]
# Enough for every fault to show, some of which do so only beyond the critical angle or in a shadow.
CASES = 40


@pytest.mark.parametrize(
    ("fault", "function", "form"), PLANTED, ids=[f"{fault.__name__}-{form.__name__}" for fault, _, form in PLANTED]
)
def test_a_planted_fault_is_told_by_a_closed_form(
    fault: Callable[..., Any], function: str, form: Callable[[Random], Case]
) -> None:
    assert any(_differs(form(Random(seed)), {function: fault}) for seed in range(CASES))


def test_every_closed_form_tells_a_fault() -> None:
    assert {form for _, _, form in PLANTED} == set(CLOSED_FORMS)


def _differs(case: Case, overrides: dict[str, Callable[..., Any]]) -> bool:
    """Whether the faulty tracer and the closed form have no value in common; certainly so, in finite balls."""
    try:
        faulty = certified(case.scene, case.x, case.y, overrides)
    except UndecidedComparisonError:
        return False
    opinion = with_own_error(lambda: case.radiance(case.x, case.y))
    return all(ball.is_finite() for ball in faulty) and not agree(faulty, opinion)
