"""Faults in the intersection with triangles (docs/spec.md, TRI), most of them in Möller's and Trumbore's test."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.comparisons.faults.other_formulas import MOELLER_TRUMBORE
from raytruth.reference_tracer.arithmetics.edits import Edit
from raytruth.reference_tracer.source.vector import cross, normalize, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector


@fault(
    "TRI-1",
    "triangle_distance",
    "Which three conditions hold for a point inside of a triangle?",
    Edit("u + v > 1.0", "u > 1.0 or v > 1.0"),
    of=MOELLER_TRUMBORE,
)
def parallelogram() -> None:
    """Both coordinates are between 0 and 1, but their sum is not checked: triangles become parallelograms."""


@fault(
    "TRI-1",
    "triangle_distance",
    "Look closely at where two triangles of a mesh meet.",
    Edit("u < 0.0 or v < 0.0 or u + v > 1.0", "u < 0.01 or v < 0.01 or u + v > 0.99"),
    of=MOELLER_TRUMBORE,
)
def cracks_between_triangles() -> None:
    """The tests of the edges keep a small distance from them, so light falls through between triangles."""


@fault(
    "TRI-1",
    "triangle_distance",
    "On which side of its start does a ray hit?",
    Edit("t if t > 0.0 else inf", "abs(t)"),
    of=MOELLER_TRUMBORE,
)
def triangle_behind_the_start() -> None:
    """The sign of t is not checked, so triangles behind the start of a ray are hit as if they were before it."""


@fault(
    "TRI-2",
    "triangle_distance",
    "Below which angle do your triangles vanish?",
    Edit("determinant == 0.0", "abs(dot(normalize(direction), normalize(cross(first_edge, second_edge)))) < 0.05"),
    of=MOELLER_TRUMBORE,
)
def nearly_parallel_rays_miss() -> None:
    """Rays that are nearly parallel to a triangle count as parallel and miss it: floors end before the horizon."""


@fault(
    "TRI-3",
    "triangle_distance",
    "From how many sides can a triangle be seen?",
    Edit("determinant == 0.0", "determinant <= 0.0"),
    of=MOELLER_TRUMBORE,
)
def back_faces_culled() -> None:
    """Triangles are seen from their front only."""


@fault("TRI-4", "triangle_normal", "Which way round do the corners run, seen from outside?")
def winding_reversed(a: Vector, b: Vector, c: Vector) -> Vector:
    """The cross product has its factors swapped, so the normals of meshes point inward."""
    return normalize(cross(subtract(c, a), subtract(b, a)))


@fault("TRI-4", "triangle_normal", "How long is the cross product of two edges?")
def triangle_normal_not_normalised(a: Vector, b: Vector, c: Vector) -> Vector:
    """The cross product of two edges is used as the normal, as long as it is."""
    return cross(subtract(b, a), subtract(c, a))


@fault(
    "TRI-4",
    "triangle_normal",
    "Work out the normal of one tilted triangle by hand: in which coordinate does yours differ?",
)
def axis_of_the_normal_lost(a: Vector, b: Vector, c: Vector) -> Vector:
    """One term of the cross product has the wrong sign, which shows only on triangles that are tilted."""
    u = subtract(b, a)
    v = subtract(c, a)
    return normalize((u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] + u[1] * v[0]))
