"""What a ray meets first, and whether anything stands in its way (docs/spec.md, TRAV).

Primitives are numbered: the spheres first, then the triangles, then the planes. A ray that starts on a primitive names
it as `left`, so that it cannot meet the same point again: what is flat is left out, of a sphere only the other side
remains.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.bounding_volume import box_is_missed
from raytruth.reference_tracer.source.features import BOUNDING_VOLUMES, PLANES, SPHERES, TRIANGLES
from raytruth.reference_tracer.source.plane import plane_distance, plane_normal
from raytruth.reference_tracer.source.scene_data import (
    NODE_END,
    NODE_FIRST_TRIANGLE,
    NODE_HIGH,
    NODE_LOW,
    NODE_ORDER,
    NODE_TRIANGLES,
    PLANE_MATERIAL,
    PLANE_NORMAL,
    PLANE_POINT,
    SPHERE_CENTER,
    SPHERE_MATERIAL,
    SPHERE_RADIUS,
    TRIANGLE_A,
    TRIANGLE_B,
    TRIANGLE_C,
    TRIANGLE_MATERIAL,
    SceneData,
    first_plane,
    integer_of,
    number_of,
    plane_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.sphere import distance_to_other_side, sphere_distance, sphere_normal
from raytruth.reference_tracer.source.triangle import triangle_distance, triangle_normal

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector

NOTHING = -1
"""The number of no primitive: what a ray that misses hits, and what a camera ray has left."""


def nearest_hit(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """Distance (in units of the direction's length) and number of the nearest primitive; (infinity, -1) for none."""
    nearest = inf
    hit = NOTHING
    if SPHERES:
        nearest, hit = nearest_sphere(scene, origin, direction, left)
    if TRIANGLES:
        nearest, hit = nearest_triangle(scene, origin, direction, left, nearest, hit)
    if PLANES:
        nearest, hit = nearest_plane(scene, origin, direction, left, nearest, hit)
    return nearest, hit


def nearest_sphere(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """Distance and number of the nearest sphere ahead; (infinity, -1) for none."""
    nearest = inf
    hit = NOTHING
    for sphere in range(rows_of(scene, SPHERE_RADIUS)):
        distance = distance_to_sphere(scene, origin, direction, left, sphere)
        if distance < nearest:
            nearest = distance
            hit = sphere
    return nearest, hit


def distance_to_sphere(scene: SceneData, origin: Vector, direction: Vector, left: int, sphere: int) -> Scalar:
    """The distance to the sphere of this number, or to its other side if the ray starts on it."""
    center = vector_of(scene, SPHERE_CENTER, sphere)
    if sphere == left:
        return distance_to_other_side(origin, direction, center)
    return sphere_distance(origin, direction, center, number_of(scene, SPHERE_RADIUS, sphere))


def nearest_triangle(
    scene: SceneData, origin: Vector, direction: Vector, left: int, nearest: Scalar, hit: int
) -> tuple[Scalar, int]:
    """Distance and number of the nearest hit: `nearest` and `hit` so far, or those of a triangle that is nearer."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    if BOUNDING_VOLUMES:
        node = 0
        while node < rows_of(scene, NODE_END):
            first = integer_of(scene, NODE_FIRST_TRIANGLE, node)
            if box_is_missed(
                origin, direction, vector_of(scene, NODE_LOW, node), vector_of(scene, NODE_HIGH, node), nearest
            ):
                node = integer_of(scene, NODE_END, node)
            else:
                for place in range(first, first + integer_of(scene, NODE_TRIANGLES, node)):
                    triangle = integer_of(scene, NODE_ORDER, place)
                    distance = distance_to_triangle(scene, origin, direction, left - spheres, triangle)
                    if distance < nearest:
                        nearest = distance
                        hit = spheres + triangle
                node += 1
    else:
        for triangle in range(rows_of(scene, TRIANGLE_MATERIAL)):
            distance = distance_to_triangle(scene, origin, direction, left - spheres, triangle)
            if distance < nearest:
                nearest = distance
                hit = spheres + triangle
    return nearest, hit


def distance_to_triangle(scene: SceneData, origin: Vector, direction: Vector, left: int, triangle: int) -> Scalar:
    """The distance to the triangle of this number; infinity if the ray starts on it: it is flat and not met again."""
    if triangle == left:
        return inf
    return triangle_distance(
        origin,
        direction,
        vector_of(scene, TRIANGLE_A, triangle),
        vector_of(scene, TRIANGLE_B, triangle),
        vector_of(scene, TRIANGLE_C, triangle),
    )


def nearest_plane(
    scene: SceneData, origin: Vector, direction: Vector, left: int, nearest: Scalar, hit: int
) -> tuple[Scalar, int]:
    """Distance and number of the nearest hit: `nearest` and `hit` so far, or those of a plane that is nearer."""
    left_plane = plane_of(scene, left)
    for plane in range(rows_of(scene, PLANE_MATERIAL)):
        distance = distance_to_plane(scene, origin, direction, left_plane, plane)
        if distance < nearest:
            nearest = distance
            hit = first_plane(scene) + plane
    return nearest, hit


def distance_to_plane(scene: SceneData, origin: Vector, direction: Vector, left: int, plane: int) -> Scalar:
    """The distance to the plane of this number; infinity if the ray starts on it, which never meets it again."""
    if plane == left:
        return inf
    return plane_distance(
        origin, direction, vector_of(scene, PLANE_POINT, plane), vector_of(scene, PLANE_NORMAL, plane)
    )


def is_occluded(scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar) -> bool:
    """Whether any primitive stands at 0 < t < end. Every surface occludes, transparent ones too."""
    if SPHERES:
        for sphere in range(rows_of(scene, SPHERE_RADIUS)):
            if distance_to_sphere(scene, origin, direction, left, sphere) < end:
                return True
    if TRIANGLES:
        _, hit = nearest_triangle(scene, origin, direction, left, end, NOTHING)
        if hit != NOTHING:
            return True
    if PLANES:
        _, hit = nearest_plane(scene, origin, direction, left, end, NOTHING)
        return hit != NOTHING
    return False


def surface_normal(scene: SceneData, primitive: int, point: Vector) -> Vector:
    """The unit normal at a point of a primitive, as its shape defines it: not turned to the viewer."""
    if PLANES:
        plane = plane_of(scene, primitive)
        if plane >= 0:
            return plane_normal(vector_of(scene, PLANE_NORMAL, plane))
    spheres = rows_of(scene, SPHERE_MATERIAL)
    if SPHERES:
        if primitive < spheres:
            return sphere_normal(
                point, vector_of(scene, SPHERE_CENTER, primitive), number_of(scene, SPHERE_RADIUS, primitive)
            )
    if TRIANGLES:
        triangle = primitive - spheres
        return triangle_normal(
            vector_of(scene, TRIANGLE_A, triangle),
            vector_of(scene, TRIANGLE_B, triangle),
            vector_of(scene, TRIANGLE_C, triangle),
        )
    return point  # a scene has at least one primitive


def material_of(scene: SceneData, primitive: int) -> int:
    """The row of the material tables that belongs to a primitive."""
    if PLANES:
        plane = plane_of(scene, primitive)
        if plane >= 0:
            return integer_of(scene, PLANE_MATERIAL, plane)
    spheres = rows_of(scene, SPHERE_MATERIAL)
    material = 0
    if primitive < spheres:
        material = integer_of(scene, SPHERE_MATERIAL, primitive)
    else:
        material = integer_of(scene, TRIANGLE_MATERIAL, primitive - spheres)
    return material
