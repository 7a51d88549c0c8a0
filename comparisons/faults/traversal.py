"""Faults in finding what a ray meets (docs/spec.md, TRAV)."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.bounding_volume import box_is_missed, clip
from raytruth.reference_tracer.source.camera import camera_frame, primary_ray
from raytruth.reference_tracer.source.features import BOUNDING_VOLUMES, SPHERES, TRIANGLES
from raytruth.reference_tracer.source.scene_data import (
    CAMERA_SIZE,
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
from raytruth.reference_tracer.source.traversal import (
    NOTHING,
    distance_to_sphere,
    distance_to_triangle,
    nearest_hit,
    nearest_sphere,
    nearest_triangle,
)
from raytruth.reference_tracer.source.vector import subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Table, Vector


@fault("TRAV-1", "nearest_sphere", "Which of all hits does the viewer see?")
def last_sphere_wins(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """The last sphere that is hit is taken, not the nearest."""
    nearest = inf
    hit = NOTHING
    for sphere in range(rows_of(scene, SPHERE_RADIUS)):
        distance = distance_to_sphere(scene, origin, direction, left, sphere)
        if distance < inf:
            nearest = distance
            hit = sphere
    return nearest, hit


@fault("TRAV-1", "nearest_hit", "From how far can something be seen?")
def far_clipping_plane(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """What is farther away than 6 is cut off, as by a far clipping plane."""
    nearest = inf
    hit = NOTHING
    if SPHERES:
        nearest, hit = nearest_sphere(scene, origin, direction, left)
    if TRIANGLES:
        nearest, hit = nearest_triangle(scene, origin, direction, left, nearest, hit)
    if nearest > 6.0:
        return inf, NOTHING
    return nearest, hit


@fault("TRAV-1", "nearest_hit", "How near may something be?")
def near_clipping_plane(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """Spheres nearer than 0.5 to the start of a ray are cut off, as by a near clipping plane."""
    nearest = inf
    hit = NOTHING
    if SPHERES:
        for sphere in range(rows_of(scene, SPHERE_RADIUS)):
            distance = distance_to_sphere(scene, origin, direction, left, sphere)
            if distance > 0.5 and distance < nearest:
                nearest = distance
                hit = sphere
    if TRIANGLES:
        nearest, hit = nearest_triangle(scene, origin, direction, left, nearest, hit)
    return nearest, hit


@fault("CAM-5", "nearest_hit", "What is behind the camera?")
def line_in_place_of_a_ray(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """A ray that meets no sphere before its start meets those behind it."""
    nearest = inf
    hit = NOTHING
    if SPHERES:
        nearest, hit = nearest_sphere(scene, origin, direction, left)
        if hit == NOTHING:
            backward = (-direction[0], -direction[1], -direction[2])
            nearest, hit = nearest_sphere(scene, origin, backward, left)
    if TRIANGLES:
        nearest, hit = nearest_triangle(scene, origin, direction, left, nearest, hit)
    return nearest, hit


@fault("TRAV-2", "material_of", "To which object does the hit belong?")
def material_of_the_neighbour(scene: SceneData, primitive: int) -> int:
    """Materials are looked up one place too early, as if the first object had none."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    material = 0
    if primitive < spheres:
        material = integer_of(scene, SPHERE_MATERIAL, max(primitive - 1, 0))
    else:
        material = integer_of(scene, TRIANGLE_MATERIAL, max(primitive - spheres - 1, 0))
    return material


@fault("TRAV-2", "first_hit_rows", "Which number has the first primitive?", gives="first hits")
def primitives_numbered_from_one(scene: SceneData, first: int, end: int, depths: Table, primitives: Table) -> None:
    """Primitives are numbered from 1."""
    frame = camera_frame(scene)
    for line in range(first, end):
        for column in range(integer_of(scene, CAMERA_SIZE, 0)):
            origin, direction = primary_ray(frame, float(column) + 0.5, float(line) + 0.5)
            distance, primitive = nearest_hit(scene, origin, direction, NOTHING)
            depths[line, column] = distance
            primitives[line, column] = primitive + 1


@fault("TRAV-4", "box_is_missed", "How thick is the box around a wall?")
def flat_boxes_missed(origin: Vector, direction: Vector, low: Vector, high: Vector, end: Scalar) -> bool:
    """A box counts as missed where entry and exit coincide, so that walls along an axis vanish."""
    to_low = subtract(low, origin)
    to_high = subtract(high, origin)
    entry = 0.0
    leave = end
    for axis in range(3):
        if direction[axis] > 0.0:
            entry, leave = clip(entry, leave, direction[axis], to_low[axis], to_high[axis])
        elif direction[axis] < 0.0:
            entry, leave = clip(entry, leave, direction[axis], to_high[axis], to_low[axis])
    return leave <= entry


@fault("TRAV-4", "nearest_triangle", "When may the search through the boxes stop?")
def first_leaf_wins(
    scene: SceneData, origin: Vector, direction: Vector, left: int, nearest: Scalar, hit: int
) -> tuple[Scalar, int]:
    """The search stops at the first leaf of the tree in which something is hit."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    if BOUNDING_VOLUMES:
        node = 0
        while node < rows_of(scene, NODE_END):
            first = integer_of(scene, NODE_FIRST_TRIANGLE, node)
            low = vector_of(scene, NODE_LOW, node)
            if box_is_missed(origin, direction, low, vector_of(scene, NODE_HIGH, node), nearest):
                node = integer_of(scene, NODE_END, node)
            else:
                for place in range(first, first + integer_of(scene, NODE_TRIANGLES, node)):
                    triangle = integer_of(scene, NODE_ORDER, place)
                    distance = distance_to_triangle(scene, origin, direction, left - spheres, triangle)
                    if distance < nearest:
                        nearest = distance
                        hit = spheres + triangle
                if hit >= spheres:
                    return nearest, hit
                node += 1
    else:
        for triangle in range(rows_of(scene, TRIANGLE_MATERIAL)):
            distance = distance_to_triangle(scene, origin, direction, left - spheres, triangle)
            if distance < nearest:
                nearest = distance
                hit = spheres + triangle
    return nearest, hit


@fault("TRAV-4", "nearest_triangle", "How many triangles are in a leaf?")
def last_triangle_of_a_leaf_lost(
    scene: SceneData, origin: Vector, direction: Vector, left: int, nearest: Scalar, hit: int
) -> tuple[Scalar, int]:
    """The loop over the triangles of a leaf ends one too early."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    if BOUNDING_VOLUMES:
        node = 0
        while node < rows_of(scene, NODE_END):
            first = integer_of(scene, NODE_FIRST_TRIANGLE, node)
            low = vector_of(scene, NODE_LOW, node)
            if box_is_missed(origin, direction, low, vector_of(scene, NODE_HIGH, node), nearest):
                node = integer_of(scene, NODE_END, node)
            else:
                for place in range(first, first + integer_of(scene, NODE_TRIANGLES, node) - 1):
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


@fault("TRAV-6", "nearest_sphere", "What is seen where two surfaces coincide?")
def coincident_surfaces_cancel(scene: SceneData, origin: Vector, direction: Vector, left: int) -> tuple[Scalar, int]:
    """Two hits at the same distance are taken for one that was counted twice, and both are dropped."""
    nearest = inf
    hit = NOTHING
    for sphere in range(rows_of(scene, SPHERE_RADIUS)):
        distance = distance_to_sphere(scene, origin, direction, left, sphere)
        if hit != NOTHING and abs(distance - nearest) < 1e-9 * nearest:
            nearest = inf
            hit = NOTHING
        elif distance < nearest:
            nearest = distance
            hit = sphere
    return nearest, hit
