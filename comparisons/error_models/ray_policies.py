"""How people's own tracers let rays leave a surface, and which hits they leave out: apart for each kind of ray.

A ray is reflected, refracted, goes to a light, or comes from the camera. The tracer knows of a ray only which primitive
it has left. So in this behaviour that number tells the kind, too: it is 4·primitive + kind, and -1, the camera's, is
of the last kind by itself. The functions here are source of the tracer, as those of ray_offsets.py, in place of which
they stand where a renderer declares what those do not know: one of the formulas of sphere_formulas.py, policies that
differ between kinds of rays, or a start that is only bounded.

What is hit is compared with the least distance as the program does that: first the formula, then the comparison.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.comparisons.error_models.helpers import under_name
from raytruth.comparisons.error_models.policy_hits import (
    distance_to_plane_by_policy,
    distance_to_sphere_by_policy,
    distance_to_triangle_by_policy,
    least_distance,
    other_side,
)
from raytruth.comparisons.error_models.policy_starts import (
    as_it_is,
    bound_of,
    is_shadowed_by_policy,
    moved_by_units,
    offset_of,
    reflected_ray_by_policy,
    start_of,
    transmitted_ray_by_policy,
)
from raytruth.comparisons.error_models.sphere_formulas import sphere_formula_behaviour
from raytruth.comparisons.error_models.start_bounds import ULP_STEPS, largest_terms, scale_of
from raytruth.comparisons.error_models.triangle_formulas import triangle_formula_behaviour
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour, merged
from raytruth.reference_tracer.source.vector import normalize

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.error_models.ray_offset_model import RayOffset
    from raytruth.scenes.scene import Scene


# The kinds: 0 of shadow rays, 1 of reflected ones, 2 of refracted ones, 3 of the camera's.


def ray_policy_behaviour(error_model: ErrorModel, scene: Scene) -> Behaviour:
    """All that this renderer's rays do otherwise, or nothing if ray_offsets.py tells it.

    To be merged with HELPERS and `offset_behaviour`. The constants are balls that hold what the renderer stores.
    """
    if not error_model.needs_policies:
        return IDEAL
    bits = error_model.precision_bits
    offsets = error_model.offsets()
    stored = [_stored(offset, scene, bits) for offset in offsets]
    lists = {name: [values[name] for values in stored] for name in stored[0]}
    has_bounds = any(offset.error_bound > 0.0 for offset in offsets)
    normalised = error_model.directions == "normalised"
    aims = {"light": arb(1), "parallel": arb(0), "either": arb(0.5, 0.5)}
    itself = Behaviour(
        {
            "reflected_ray": reflected_ray_by_policy,
            "transmitted_ray": transmitted_ray_by_policy,
            "is_shadowed": is_shadowed_by_policy,
            "distance_to_sphere": distance_to_sphere_by_policy,
            "distance_to_triangle": distance_to_triangle_by_policy,
            "distance_to_plane": distance_to_plane_by_policy,
        },
        (
            *(start_of, moved_by_units, offset_of, bound_of, least_distance, other_side),
            under_name("as_traced", normalize if normalised else as_it_is),
        ),
        {
            **lists,
            "terms_of_points": [arb(terms if has_bounds else 0.0) for terms in largest_terms(scene)],
            "least_is_a_length": arb(0 if error_model.directions == "unnormalised" else 1),
            "aims_at_light": aims[error_model.shadow_aim],
            "some_of_it": arb(0.5, 0.5),
            "normalises": arb(1 if normalised else 0),
            **ULP_STEPS,
        },
        "ray policies",
    )
    return merged(itself, sphere_formula_behaviour(error_model), triangle_formula_behaviour(error_model))


def _stored(offset: RayOffset, scene: Scene, bits: int) -> dict[str, Any]:
    """The numbers of one kind of ray. Of a scene's scale each is the product, which is rounded like all else."""
    of_scene = offset.scale == "scene"
    relative = 0.0 if of_scene else offset.relative
    relative_least = 0.0 if of_scene else offset.relative_minimum_distance
    scene_scale = scale_of(scene, bits) if of_scene else arb(0)
    return {
        "length_of_offset": stored_number(offset.absolute, bits) + offset.relative * scene_scale,
        "relative_length_of_offset": stored_number(relative, bits),
        "error_bounds_of_offset": arb(offset.error_bound * 2.0**-bits),
        "moves_by_units": arb(1 if offset.in_units else 0),
        "moves_along_ray": arb(1 if offset.along == "direction" else 0),
        "leaves_surface_out": arb(1 if offset.excludes_surface else 0),
        "least_of_hits": stored_number(offset.minimum_distance, bits) + offset.relative_minimum_distance * scene_scale,
        "relative_least_of_hits": stored_number(relative_least, bits),
    }
