"""Where the rays of legitimate variants start and end (docs/how-verdicts-work.md, "ray offset")."""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.plane import plane_distance
from raytruth.reference_tracer.source.scene_data import (
    PLANE_NORMAL,
    PLANE_POINT,
    SPHERE_CENTER,
    SPHERE_RADIUS,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
    number_of,
    vector_of,
)
from raytruth.reference_tracer.source.sphere import sphere_distance
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.reference_tracer.source.triangle import triangle_distance
from raytruth.reference_tracer.source.vector import along, dot

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

# Far above the rounding of float64 in scenes of some units, and far below what can be seen. The functions repeat it,
# since they become source of the tracer.
OFFSET = 2.0**-20


def beside_the_surface(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:
    """A millionth off the surface, which is then tested as all others are."""
    return along(point, normal, 9.5367431640625e-07), NOTHING


def a_little_before_the_light() -> Scalar:
    """All but a millionth of the way."""
    return 1.0 - 9.5367431640625e-07


def sphere_not_too_near(scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int) -> Scalar:
    """To the nearest root that is not too near, also of the sphere that the ray starts on."""
    skipped = 9.5367431640625e-07 / sqrt(dot(direction, direction))
    center = vector_of(scene, SPHERE_CENTER, sphere)
    radius = number_of(scene, SPHERE_RADIUS, sphere)
    distance = sphere_distance(along(origin, direction, skipped), direction, center, radius)
    if distance < inf:
        return skipped + distance
    return inf


def triangle_not_too_near(scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int) -> Scalar:
    """To the triangle if it is not too near, also if the ray starts on it."""
    distance = triangle_distance(
        origin,
        direction,
        vector_of(scene, TRIANGLE_A, triangle),
        vector_of(scene, TRIANGLE_B, triangle),
        vector_of(scene, TRIANGLE_C, triangle),
    )
    if distance * sqrt(dot(direction, direction)) > 9.5367431640625e-07:
        return distance
    return inf


def plane_not_too_near(scene: SceneData, origin: Vector, direction: Vector, left: int, plane: int) -> Scalar:
    """To the plane if it is not too near, also if the ray starts on it."""
    distance = plane_distance(
        origin, direction, vector_of(scene, PLANE_POINT, plane), vector_of(scene, PLANE_NORMAL, plane)
    )
    if distance * sqrt(dot(direction, direction)) > 9.5367431640625e-07:
        return distance
    return inf
