"""All closed forms."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.second_opinion import flat_glass, mirrors, round_glass, shadows, surfaces

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

    from tests.second_opinion.case import Case

CLOSED_FORMS: tuple[Callable[[Random], Case], ...] = (
    surfaces.diffuse_sphere,
    surfaces.phong_sphere,
    surfaces.blinn_sphere,
    surfaces.lit_triangle,
    surfaces.lit_plane,
    surfaces.sphere_in_parallel_projection,
    surfaces.checkerboard_floor,
    shadows.umbra_of_a_point_light,
    shadows.shadow_of_the_sun,
    mirrors.mirror_sphere,
    mirrors.mirror_corridor,
    flat_glass.glass_slab,
    flat_glass.half_space_of_water,
    flat_glass.slab_of_constant_weights,
    flat_glass.window_of_snell,
    flat_glass.window_of_constant_weights,
    flat_glass.prism_at_the_critical_angle,
    round_glass.glass_sphere,
    round_glass.glass_sphere_on_its_axis,
    round_glass.absorption_along_a_chord,
    round_glass.bubble_in_glass,
)
"""From a source of random numbers a scene with untidy numbers, an image point, and what is seen there."""
