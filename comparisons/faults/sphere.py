"""Faults in the intersection with spheres (docs/spec.md, SPH)."""

from __future__ import annotations

from math import inf, sqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit
from raytruth.reference_tracer.source.vector import dot, normalize, scale, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


@fault("SPH-1", "root_outside", "Of two hits, which one does the viewer see?", Edit("product / farther", "farther"))
def farther_root_of_a_sphere() -> None:
    """The farther of two hits is taken, so the back of the sphere is seen from outside."""


@fault("SPH-1", "sphere_distance", "Which of your rays have a direction that is not a unit vector?")
def quadratic_for_unit_directions(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """The quadratic is solved for unit vectors only, but shadow rays reach from the point to the light."""
    to_origin = subtract(origin, center)
    b = dot(direction, to_origin)
    discriminant = b * b - dot(to_origin, to_origin) + radius * radius
    if discriminant < 0.0:
        return inf
    root = sqrt(discriminant)
    if -b - root > 0.0:
        return -b - root
    if -b + root > 0.0:
        return -b + root
    return inf


@fault("SPH-1", "sphere_distance", "Is there a plus or a minus in your discriminant?")
def sign_in_the_discriminant(origin: Vector, direction: Vector, center: Vector, radius: Scalar) -> Scalar:
    """The radius is added in the quadratic where it should be subtracted."""
    to_origin = subtract(origin, center)
    a = dot(direction, direction)
    b = dot(direction, to_origin)
    discriminant = b * b - a * (dot(to_origin, to_origin) + radius * radius)
    if discriminant < 0.0:
        return inf
    t = (-b - sqrt(discriminant)) / a
    return t if t > 0.0 else inf


@fault(
    "SPH-1",
    "distance_to_sphere",
    "Compare the size of the sphere in the image with what the scene says.",
    Edit("number_of(scene, SPHERE_RADIUS, sphere)", "1.01 * number_of(scene, SPHERE_RADIUS, sphere)"),
)
def sphere_one_percent_too_large() -> None:
    """Spheres are met with a radius that is one percent too large."""


@fault(
    "SPH-2",
    "root_outside",
    "What does a ray that just touches the sphere's rim do, and what is your discriminant there?",
    Edit("half_chord_squared >= 0.0", "half_chord_squared >= 1e-2"),
)
def rim_of_a_sphere_cut_off() -> None:
    """A small discriminant counts as a miss, so spheres lose their rim."""


@fault(
    "SPH-2",
    "root_outside",
    "What does a ray that misses the sphere by little do, and what is your discriminant there?",
    Edit("half_chord_squared >= 0.0", "half_chord_squared >= -1e-2"),
    Edit("sqrt(half_chord_squared)", "sqrt(max(half_chord_squared, 0.0))"),
)
def near_miss_hits_a_sphere() -> None:
    """A slightly negative discriminant is set to 0, so spheres grow a thin rim."""


@fault("SPH-3", "root_inside", "Which of the two roots is positive for a ray that starts inside?")
def sphere_missed_from_inside(foot: Scalar, product: Scalar) -> Scalar:
    """Only the nearer root is looked at, which is behind a ray that starts inside the sphere."""
    return inf


@fault("SPH-4", "distance_to_other_side", "Where does a ray that went into a ball come out?")
def no_way_out_of_a_sphere(origin: Vector, direction: Vector, center: Vector) -> Scalar:
    """A ray that starts on a sphere never meets that sphere again, so rays inside of glass do not come out."""
    return inf


@fault(
    "SPH-4",
    "distance_to_other_side",
    "How long is the chord through the centre?",
    Edit("-2.0 * half_linear", "-half_linear"),
)
def way_through_a_sphere_halved() -> None:
    """The way through the sphere ends at its middle, since a factor of 2 is missing."""


@fault("SPH-5", "sphere_normal", "Which way does the normal point, and who relies on that?")
def sphere_normal_inward(point: Vector, center: Vector, radius: Scalar) -> Vector:
    """The normal points to the centre, so rays seem to leave glass where they enter it."""
    return scale(subtract(center, point), 1.0 / radius)


@fault("SPH-5", "sphere_normal", "How long is the normal of a sphere whose radius is not 1?")
def sphere_normal_not_normalised(point: Vector, center: Vector, radius: Scalar) -> Vector:
    """The normal is as long as the radius."""
    return subtract(point, center)


@fault("SPH-5", "sphere_normal", "What is the normal of a sphere that is not at the origin?")
def sphere_normal_from_the_origin(point: Vector, center: Vector, radius: Scalar) -> Vector:
    """The normal is the direction from the origin, as if every sphere stood there."""
    return normalize(point)
