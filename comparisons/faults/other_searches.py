"""Legitimate variants by the order of the work: what is looked at first, and what is summed first."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.other_formulas import variant
from raytruth.reference_tracer.source.bounding_volume import box_is_missed
from raytruth.reference_tracer.source.features import BOUNDING_VOLUMES
from raytruth.reference_tracer.source.ray_tree import trace_ray
from raytruth.reference_tracer.source.scene_data import (
    NODE_END,
    NODE_FIRST_TRIANGLE,
    NODE_HIGH,
    NODE_LOW,
    NODE_ORDER,
    NODE_TRIANGLES,
    SPHERE_MATERIAL,
    SPHERE_RADIUS,
    TRIANGLE_MATERIAL,
    SceneData,
    integer_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.traversal import NOTHING, distance_to_sphere, distance_to_triangle
from raytruth.reference_tracer.source.vector import add

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


@variant("nearest_sphere")
def spheres_from_last_to_first(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """The spheres are tested in reverse order."""
    nearest = inf
    hit = NOTHING
    spheres = rows_of(scene, SPHERE_RADIUS)
    for place in range(spheres):
        sphere = spheres - 1 - place
        distance = distance_to_sphere(scene, origin, direction, left, sphere)
        if distance <= nearest and distance < inf:
            nearest = distance
            hit = sphere
    return nearest, hit


@variant("nearest_triangle")
def boxes_from_last_to_first(
    scene: SceneData, origin: Vector, direction: Vector, left: int, nearest: Scalar, hit: int
) -> tuple[Scalar, int]:
    """The leaves of the tree of boxes are visited in reverse order."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    if BOUNDING_VOLUMES:
        nodes = rows_of(scene, NODE_END)
        for step in range(nodes):
            node = nodes - 1 - step
            first = integer_of(scene, NODE_FIRST_TRIANGLE, node)
            low = vector_of(scene, NODE_LOW, node)
            if integer_of(scene, NODE_TRIANGLES, node) > 0:
                if not box_is_missed(origin, direction, low, vector_of(scene, NODE_HIGH, node), nearest):
                    for place in range(first, first + integer_of(scene, NODE_TRIANGLES, node)):
                        triangle = integer_of(scene, NODE_ORDER, place)
                        distance = distance_to_triangle(scene, origin, direction, left - spheres, triangle)
                        if distance < nearest:
                            nearest = distance
                            hit = spheres + triangle
    else:
        triangles = rows_of(scene, TRIANGLE_MATERIAL)
        for place in range(triangles):
            triangle = triangles - 1 - place
            distance = distance_to_triangle(scene, origin, direction, left - spheres, triangle)
            if distance < nearest:
                nearest = distance
                hit = spheres + triangle
    return nearest, hit


@variant("nearest_triangle")
def boxes_behind_a_hit_entered(
    scene: SceneData, origin: Vector, direction: Vector, left: int, nearest: Scalar, hit: int
) -> tuple[Scalar, int]:
    """Boxes are entered although something nearer has been hit already."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    if BOUNDING_VOLUMES:
        node = 0
        while node < rows_of(scene, NODE_END):
            first = integer_of(scene, NODE_FIRST_TRIANGLE, node)
            low = vector_of(scene, NODE_LOW, node)
            if box_is_missed(origin, direction, low, vector_of(scene, NODE_HIGH, node), inf):
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


@variant("radiance")
def breadth_first(scene: SceneData, origin: Vector, direction: Vector, medium: int, depth: int) -> Vector:
    """The rays of the tree are followed, and summed, in the order in which they were sent on."""
    total = (0.0, 0.0, 0.0)
    waiting = [(origin, direction, (1.0, 1.0, 1.0), NOTHING, medium, depth)]
    while len(waiting) > 0:
        total = add(total, trace_ray(scene, waiting.pop(0), waiting))
    return total
