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
    from collections.abc import Callable, Mapping

    from raytruth.comparisons.faults.fault import Subject
    from tests.second_opinion.case import Case

pytestmark = pytest.mark.clause("ARI-10")


FAULTS = all_faults()

# A fault, and a closed form that shows it.
PLANTED: list[tuple[Subject, Callable[[Random], Case]]] = [
    (FAULTS["mirrored_image"], surfaces.lit_triangle),
    (FAULTS["half_a_pixel_off"], mirrors.mirror_corridor),
    (FAULTS["horizontal_field_of_view"], surfaces.checkerboard_floor),
    (FAULTS["one_over_distance"], surfaces.diffuse_sphere),
    (FAULTS["one_over_distance"], surfaces.lit_triangle),
    (planted_faults.cosine_squared, surfaces.diffuse_sphere),
    (planted_faults.cosine_squared, surfaces.sphere_in_parallel_projection),
    (FAULTS["no_pi"], surfaces.checkerboard_floor),
    (FAULTS["polynomial_not_clamped"], surfaces.phong_sphere),
    (planted_faults.half_of_the_exponent, surfaces.phong_sphere),
    (FAULTS["phong_for_blinn"], surfaces.blinn_sphere),
    (FAULTS["parallelogram"], surfaces.lit_triangle),
    (FAULTS["plane_behind_the_start"], surfaces.lit_plane),
    (FAULTS["plane_normal_of_two_lengths"], surfaces.lit_plane),
    (FAULTS["plane_normal_not_normalised"], surfaces.lit_plane),
    (FAULTS["water_above_its_surface"], flat_glass.half_space_of_water),
    (planted_faults.squares_in_one_floor, surfaces.checkerboard_floor),
    (FAULTS["no_shadow_rays"], shadows.umbra_of_a_point_light),
    (FAULTS["no_shadow_rays"], shadows.shadow_of_the_sun),
    (FAULTS["gradient_from_the_horizon"], mirrors.mirror_sphere),
    (FAULTS["reflection_reversed"], mirrors.mirror_sphere),
    (FAULTS["reflection_one_percent_too_dark"], mirrors.mirror_corridor),
    (planted_faults.fresnel_without_half, round_glass.glass_sphere_on_its_axis),
    (planted_faults.fresnel_without_half, flat_glass.glass_slab),
    (FAULTS["schlick"], flat_glass.glass_slab),
    (FAULTS["schlick"], round_glass.glass_sphere),
    (FAULTS["radiance_not_scaled"], flat_glass.window_of_snell),
    (FAULTS["radiance_scaled_the_wrong_way"], flat_glass.prism_at_the_critical_angle),
    (FAULTS["inverted_index_ratio"], round_glass.glass_sphere),
    (FAULTS["every_ray_enters"], round_glass.bubble_in_glass),
    (planted_faults.discriminant_without_sign, flat_glass.prism_at_the_critical_angle),
    (planted_faults.exchanged_constants, flat_glass.slab_of_constant_weights),
    (FAULTS["total_reflection_in_full"], flat_glass.window_of_constant_weights),
    (FAULTS["linear_absorption"], round_glass.absorption_along_a_chord),
    (planted_faults.always_into_empty_space, round_glass.bubble_in_glass),
    (planted_faults.three_quarters_of_the_way, round_glass.absorption_along_a_chord),
]
# Enough for every fault to show, some of which do so only beyond the critical angle or in a shadow.
CASES = 40


@pytest.mark.parametrize(("fault", "form"), PLANTED, ids=[f"{fault.name}-{form.__name__}" for fault, form in PLANTED])
def test_a_planted_fault_is_told_by_a_closed_form(fault: Subject, form: Callable[[Random], Case]) -> None:
    assert any(_differs(form(Random(seed)), fault.overrides) for seed in range(CASES))


def test_every_closed_form_tells_a_fault() -> None:
    assert {form for _, form in PLANTED} == set(CLOSED_FORMS)


def _differs(case: Case, overrides: Mapping[str, Callable[..., Any]]) -> bool:
    """Whether the faulty tracer and the closed form have no value in common; certainly so, in finite balls."""
    try:
        faulty = certified(case.scene, case.x, case.y, overrides)
    except UndecidedComparisonError:
        return False
    opinion = with_own_error(lambda: case.radiance(case.x, case.y))
    return all(ball.is_finite() for ball in faulty) and not agree(faulty, opinion)
