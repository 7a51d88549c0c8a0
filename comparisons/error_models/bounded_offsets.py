"""How a renderer leaves a surface that moves the start of some rays only, and by no more than a bound.

Cycles excludes the triangle that a ray leaves, and starts on it. Near an edge rounding may have put that point beyond
the edge, and so behind the neighbour. So it tests whether the ray would meet the triangle that it leaves, and moves
its start off the surface if not. Which rays that are cannot be told where rounding decides it; how far they are moved
can be bounded. A ray's start is then a small box: whatever the renderer did, it started somewhere in there.

The functions here are source of the tracer, as those of ray_offsets.py.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from flint import arb

from raytruth.comparisons.error_models.helpers import corners_of, edge_slack, pluecker_products, triangle_of
from raytruth.comparisons.error_models.ray_offsets import offset_length
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.source.bounding_volume import certainly_less
from raytruth.reference_tracer.source.shadow import departure, shadow_ray_end
from raytruth.reference_tracer.source.traversal import is_occluded
from raytruth.reference_tracer.source.vector import subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

anywhere_x: Scalar = 0.0
"""Between -1 and 1, as are the other two: which part of the bound a coordinate is off by."""
anywhere_y: Scalar = 0.0
anywhere_z: Scalar = 0.0


def bounded_offset_behaviour(error_model: ErrorModel) -> Behaviour:
    """What an offset changes that is a bound, and else nothing; to be merged with HELPERS and `offset_behaviour`.

    The constants are balls.
    """
    if not error_model.ray_offset.is_bound:
        return IDEAL
    return Behaviour(
        {"departure": departure_within_bound, "is_shadowed": is_shadowed_from_within_bound},
        constants={"anywhere_x": arb(0, 1), "anywhere_y": arb(0, 1), "anywhere_z": arb(0, 1)},
        name="bounded ray offsets",
    )


def departure_within_bound(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:  # noqa: ARG001 - the signature of the function it stands for
    """Where a ray starts: anywhere in a box around the surface point, as wide as the bound, each coordinate by itself.

    One ray's start is independent of another's though they share these three numbers: each goes on as a bundle of its
    own (rounded_rays.py).
    """
    reach = offset_length(point)
    x = point[0] + normal[0] * reach * anywhere_x
    y = point[1] + normal[1] * reach * anywhere_y
    return (x, y, point[2] + normal[2] * reach * anywhere_z), primitive


def is_shadowed_from_within_bound(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Whether a light is hidden, where a shadow ray's start may be moved, but its direction is that from the point.

    It surely starts on the point of a sphere, and of a triangle that it surely meets: by the products of Plücker
    coordinates, as in triangle_tests.pluecker_distance, but with the slack against the hit.
    """
    surely_kept = True
    triangle = triangle_of(scene, primitive)
    if triangle >= 0:
        a, b, c = corners_of(scene, triangle)
        to_a, to_b, to_c = subtract(a, point), subtract(b, point), subtract(c, point)
        u, v, w = pluecker_products(to_a, to_b, to_c, to_light)
        slack = edge_slack * abs(u + v + w)
        in_front = certainly_less(slack, u) and certainly_less(slack, v) and certainly_less(slack, w)
        behind = certainly_less(u, -slack) and certainly_less(v, -slack) and certainly_less(w, -slack)
        surely_kept = in_front or behind
    origin = point
    if not surely_kept:
        origin, _ = departure(primitive, point, normal, to_light)
    return is_occluded(scene, origin, to_light, primitive, shadow_ray_end() if light_is_near else inf)
