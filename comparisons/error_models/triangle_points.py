"""How a renderer may find the point where a ray meets a triangle, in place of going along the ray.

Both are the same in exact arithmetic. Where a triangle is far larger than its distance, or small and far, rounding does
other things to them. The function here is source of the tracer, as those of triangle_tests.py.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from flint import arb

from raytruth.comparisons.error_models.helpers import (
    corners_of,
    largest_magnitude,
    pluecker_products,
    triangle_of,
)
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.source.traversal import surface_normal
from raytruth.reference_tracer.source.vector import add, along, dot, negate, scale, subtract

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

interpolation_error_x: Scalar = 0.0
"""Of a coordinate that is interpolated between corners, in units of the largest of theirs."""
interpolation_error_y: Scalar = 0.0
interpolation_error_z: Scalar = 0.0

# (1 - u - v)·a + u·b + v·c, for weights between 0 and 1: the first weight is off by two roundoffs at most, a coordinate
# of a by as much of it; each product and each of two sums rounds once, the weights' sum being 1: in all 2 + 3.
INTERPOLATION_ROUNDOFFS = 5


def triangle_point_behaviour(error_model: ErrorModel) -> Behaviour:
    """What is replaced, nothing for who goes along the ray; to be merged with HELPERS. The constants are balls."""
    if error_model.triangle_points != "barycentric":
        return IDEAL
    error = arb(0, INTERPOLATION_ROUNDOFFS * 2.0**-error_model.precision_bits)
    return Behaviour(
        {"surface_at": surface_at_barycentric},
        constants={f"interpolation_error_{axis}": error for axis in "xyz"},
        name="points on triangles",
    )


def surface_at_barycentric(
    scene: SceneData, origin: Vector, direction: Vector, distance: Scalar, primitive: int
) -> tuple[Vector, Vector, bool]:
    """As surface_at of ray_tree.py, but for a triangle from its corners: (1 - u - v)·a + u·b + v·c.

    The weights are the products of Plücker coordinates of Embree's robust test (triangle_tests.pluecker_distance), over
    the sum of all three by a reciprocal: PlueckerHitM::finalize in kernels/geometry/triangle_intersector_pluecker.h.
    Plain balls do not know that the weights' errors cancel, so they are given a + u·(b - a) + v·(c - a), and what
    rounding does to the sum above.
    """
    point = along(origin, direction, distance)
    triangle = triangle_of(scene, primitive)
    if triangle >= 0:
        a, b, c = corners_of(scene, triangle)
        to_a, to_b, to_c = subtract(a, origin), subtract(b, origin), subtract(c, origin)
        u, v, w = pluecker_products(to_a, to_b, to_c, direction)
        reciprocal = 1.0 / (u + v + w) * 1.0 * 1.0 * 1.0  # as in triangle_tests.py
        from_a = add(scale(subtract(b, a), u * reciprocal), scale(subtract(c, a), v * reciprocal))
        x, y, z = add(a, from_a)
        x = x + largest_magnitude(a[0], b[0], c[0]) * interpolation_error_x
        y = y + largest_magnitude(a[1], b[1], c[1]) * interpolation_error_y
        z = z + largest_magnitude(a[2], b[2], c[2]) * interpolation_error_z
        point = (x, y, z)
    outward = surface_normal(scene, primitive, point)
    entering = dot(direction, outward) < 0.0
    normal = outward if entering else negate(outward)
    return point, normal, entering
