"""How a renderer may find the point where a ray meets a triangle, in place of going along the ray.

Both are the same in exact arithmetic. Where a triangle is far larger than its distance, or small and far, rounding does
other things to them. The function here is an override, as in triangle_tests.py.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.reference_tracer.source.features import SPHERES
from raytruth.reference_tracer.source.scene_data import (
    SPHERE_MATERIAL,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.traversal import surface_normal
from raytruth.reference_tracer.source.vector import add, along, cross, dot, negate, scale, subtract

if TYPE_CHECKING:
    from collections.abc import Callable

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


def triangle_point_overrides(error_model: ErrorModel) -> dict[str, Callable[..., Any]]:
    """The function of the tracer's source that is replaced; nothing for who goes along the ray."""
    return {"surface_at": surface_at_barycentric} if error_model.triangle_points == "barycentric" else {}


def triangle_point_constants(error_model: ErrorModel) -> dict[str, Any]:
    """The constants of the override by name, as balls."""
    error = arb(0, INTERPOLATION_ROUNDOFFS * 2.0**-error_model.precision_bits)
    return {f"interpolation_error_{axis}": error for axis in "xyz"}


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
    triangle = primitive
    if SPHERES:
        triangle = primitive - rows_of(scene, SPHERE_MATERIAL)
    if triangle >= 0:
        a = vector_of(scene, TRIANGLE_A, triangle)
        b = vector_of(scene, TRIANGLE_B, triangle)
        c = vector_of(scene, TRIANGLE_C, triangle)
        to_a, to_b, to_c = subtract(a, origin), subtract(b, origin), subtract(c, origin)
        u = dot(cross(subtract(to_c, to_a), add(to_c, to_a)), direction)
        v = dot(cross(subtract(to_a, to_b), add(to_a, to_b)), direction)
        w = dot(cross(subtract(to_b, to_c), add(to_b, to_c)), direction)
        reciprocal = 1.0 / (u + v + w) * 1.0 * 1.0 * 1.0  # as in triangle_tests.py
        from_a = add(scale(subtract(b, a), u * reciprocal), scale(subtract(c, a), v * reciprocal))
        x, y, z = add(a, from_a)
        x = x + max(max(abs(a[0]), abs(b[0])), abs(c[0])) * interpolation_error_x  # noqa: PLW3301 - balls have a maximum of two
        y = y + max(max(abs(a[1]), abs(b[1])), abs(c[1])) * interpolation_error_y  # noqa: PLW3301 - as above
        z = z + max(max(abs(a[2]), abs(b[2])), abs(c[2])) * interpolation_error_z  # noqa: PLW3301 - as above
        point = (x, y, z)
    outward = surface_normal(scene, primitive, point)
    entering = dot(direction, outward) < 0.0
    normal = outward if entering else negate(outward)
    return point, normal, entering
