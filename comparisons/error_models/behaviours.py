"""All that a renderer computes otherwise than the truth does, by its error model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.bounded_offsets import bounded_offset_behaviour
from raytruth.comparisons.error_models.camera_behaviours import camera_behaviour
from raytruth.comparisons.error_models.departure_edits import departure_behaviour
from raytruth.comparisons.error_models.dielectric_formulas import dielectric_behaviour
from raytruth.comparisons.error_models.helpers import HELPERS
from raytruth.comparisons.error_models.hit_points import hit_point_behaviour
from raytruth.comparisons.error_models.left_triangles import left_triangle_behaviour
from raytruth.comparisons.error_models.rasterisers.rasterisation import rasterisation_behaviour
from raytruth.comparisons.error_models.ray_offsets import offset_behaviour
from raytruth.comparisons.error_models.ray_policies import ray_policy_behaviour
from raytruth.comparisons.error_models.sphere_tests import sphere_test_behaviour
from raytruth.comparisons.error_models.triangle_tests import triangle_test_behaviour
from raytruth.reference_tracer.arithmetics.behaviour import merged

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.scenes.scene import Scene


def behaviour_of(error_model: ErrorModel, scene: Scene) -> Behaviour:
    """The behaviour of a renderer on a scene. Its constants are balls, made at the precision in force.

    Raises ValueError for an error model of which two parts change the same function, which no renderer can have.
    """
    return merged(
        HELPERS,
        offset_behaviour(error_model),
        bounded_offset_behaviour(error_model),
        ray_policy_behaviour(error_model, scene),
        triangle_test_behaviour(error_model),
        hit_point_behaviour(error_model),
        left_triangle_behaviour(error_model),
        sphere_test_behaviour(error_model, scene),
        dielectric_behaviour(error_model),
        rasterisation_behaviour(error_model.rasterisation, scene),
        camera_behaviour(error_model, scene),
        departure_behaviour(error_model),
    )
