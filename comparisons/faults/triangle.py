"""Faults in the intersection with triangles (docs/spec.md, TRI). Their bodies follow Möller and Trumbore (1997)."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.vector import cross, dot, normalize, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


@fault("TRI-1", "triangle_distance", "Which three conditions hold for a point inside of a triangle?")
def parallelogram(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Both coordinates are between 0 and 1, but their sum is not checked: triangles become parallelograms."""
    p = cross(direction, subtract(c, a))
    determinant = dot(subtract(b, a), p)
    if determinant == 0.0:
        return inf
    u = dot(subtract(origin, a), p) / determinant
    q = cross(subtract(origin, a), subtract(b, a))
    v = dot(direction, q) / determinant
    if u < 0.0 or u > 1.0 or v < 0.0 or v > 1.0:
        return inf
    t = dot(subtract(c, a), q) / determinant
    return t if t > 0.0 else inf


@fault("TRI-1", "triangle_distance", "Look closely at where two triangles of a mesh meet.")
def cracks_between_triangles(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """The tests of the edges keep a small distance from them, so light falls through between triangles."""
    p = cross(direction, subtract(c, a))
    determinant = dot(subtract(b, a), p)
    if determinant == 0.0:
        return inf
    u = dot(subtract(origin, a), p) / determinant
    q = cross(subtract(origin, a), subtract(b, a))
    v = dot(direction, q) / determinant
    if u < 0.01 or v < 0.01 or u + v > 0.99:
        return inf
    t = dot(subtract(c, a), q) / determinant
    return t if t > 0.0 else inf


@fault("TRI-1", "triangle_distance", "On which side of its start does a ray hit?")
def triangle_behind_the_start(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """The sign of t is not checked, so triangles behind the start of a ray are hit as if they were before it."""
    p = cross(direction, subtract(c, a))
    determinant = dot(subtract(b, a), p)
    if determinant == 0.0:
        return inf
    u = dot(subtract(origin, a), p) / determinant
    q = cross(subtract(origin, a), subtract(b, a))
    v = dot(direction, q) / determinant
    if u < 0.0 or v < 0.0 or u + v > 1.0:
        return inf
    return abs(dot(subtract(c, a), q) / determinant)


@fault("TRI-2", "triangle_distance", "Below which angle do your triangles vanish?")
def nearly_parallel_rays_miss(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Rays that are nearly parallel to a triangle count as parallel and miss it: floors end before the horizon."""
    normal = cross(subtract(b, a), subtract(c, a))
    across = abs(dot(normalize(direction), normalize(normal)))
    if across < 0.05:
        return inf
    p = cross(direction, subtract(c, a))
    determinant = dot(subtract(b, a), p)
    u = dot(subtract(origin, a), p) / determinant
    q = cross(subtract(origin, a), subtract(b, a))
    v = dot(direction, q) / determinant
    if u < 0.0 or v < 0.0 or u + v > 1.0:
        return inf
    t = dot(subtract(c, a), q) / determinant
    return t if t > 0.0 else inf


@fault("TRI-3", "triangle_distance", "From how many sides can a triangle be seen?")
def back_faces_culled(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """Triangles are seen from their front only."""
    p = cross(direction, subtract(c, a))
    determinant = dot(subtract(b, a), p)
    if determinant <= 0.0:
        return inf
    u = dot(subtract(origin, a), p) / determinant
    q = cross(subtract(origin, a), subtract(b, a))
    v = dot(direction, q) / determinant
    if u < 0.0 or v < 0.0 or u + v > 1.0:
        return inf
    t = dot(subtract(c, a), q) / determinant
    return t if t > 0.0 else inf


@fault("TRI-4", "triangle_normal", "Which way round do the corners run, seen from outside?")
def winding_reversed(a: Vector, b: Vector, c: Vector) -> Vector:
    """The cross product has its factors swapped, so the normals of meshes point inward."""
    return normalize(cross(subtract(c, a), subtract(b, a)))


@fault("TRI-4", "triangle_normal", "How long is the cross product of two edges?")
def triangle_normal_not_normalised(a: Vector, b: Vector, c: Vector) -> Vector:
    """The cross product of two edges is used as the normal, as long as it is."""
    return cross(subtract(b, a), subtract(c, a))


@fault("TRI-4", "triangle_normal", "Look at one flat facet alone: is its shading flat?")
def axis_of_the_normal_lost(a: Vector, b: Vector, c: Vector) -> Vector:
    """One term of the cross product has the wrong sign, which shows only on triangles that are tilted."""
    u = subtract(b, a)
    v = subtract(c, a)
    return normalize((u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] + u[1] * v[0]))
