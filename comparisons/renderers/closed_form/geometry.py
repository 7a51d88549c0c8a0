"""Where rays meet one sphere, one triangle or one plane, and whether it stands between itself and a light.

Arrays of vectors have shape (height, width, 3); everything is float64.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from raytruth.scenes.lights import PointLight
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from raytruth.comparisons.records.renderings import Rays
    from raytruth.scenes.lights import Light
    from raytruth.scenes.shapes import Shape

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Hits:
    """What rays meet; the values of a ray that misses mean nothing."""

    is_hit: NDArray[np.bool_]
    """Shape (height, width), as `distance` and `is_front`."""
    distance: Array
    position: Array
    normal: Array
    """The unit normal as the shape defines it, not turned to the viewer."""
    is_front: NDArray[np.bool_]
    """Whether the ray comes from the side to which the normal points."""


def dot(first: Array, second: Array) -> Array:
    """Scalar products along the last axis."""
    products: Array = np.sum(first * second, axis=-1)
    return products


def intersect_sphere(rays: Rays, center: Array, radius: float) -> Hits:
    """The nearest hit ahead of each ray's origin, by Pythagoras' theorem; a tangent ray hits.

    The foot of the perpendicular from the centre lies at s = m·d with m = c − o; its length is q = |m × d| (Lagrange's
    identity), and half the chord is h = √((r−q)(r+q)), hence t = s ∓ h (Glassner 1989, An Introduction to Ray Tracing,
    ch. 2, sec. 2.2). From outside, the near root is taken from the product of both, (|m|−r)(|m|+r), without
    cancellation.
    """
    to_center = center - rays.origins
    along = dot(to_center, rays.directions)
    foot = along[..., None] * rays.directions - to_center  # from the centre to the foot of the perpendicular
    perpendicular = np.linalg.norm(np.cross(to_center, rays.directions), axis=-1)
    half_chord_squared = (radius - perpendicular) * (radius + perpendicular)
    half_chord = np.sqrt(np.maximum(half_chord_squared, 0.0))
    far = along + half_chord
    center_distance = np.linalg.norm(to_center, axis=-1)
    is_front = center_distance > radius
    near = (center_distance - radius) * (center_distance + radius) / far
    distance = np.where(is_front, near, far)
    chord_end = np.where(is_front, -half_chord, half_chord)[..., None] * rays.directions
    return Hits(
        is_hit=(half_chord_squared >= 0) & np.where(is_front, along > 0, far > 0),
        distance=distance,
        position=rays.origins + distance[..., None] * rays.directions,
        normal=(foot + chord_end) / radius,
        is_front=is_front,
    )


def intersect_triangle(rays: Rays, vertices: Array) -> Hits:
    """The hit ahead of each ray's origin, by signed volumes; a ray through an edge hits, one in the plane misses.

    The ray passes a triangle if the volumes of the tetrahedra that it spans with the three edges, d·(a × b), have one
    sign (Segura, Feito 2001, "Algorithms to Test Ray-Triangle Intersection", sec. 3). The distance is that to the
    plane, ((v0 − o)·n) / (d·n) with n = (v1−v0) × (v2−v0).
    """
    corners = vertices[:, None, None, :] - rays.origins  # (3, height, width, 3)
    edges = np.cross(corners, np.roll(corners, -1, axis=0))
    volumes = dot(edges, rays.directions)
    normal = np.cross(vertices[1] - vertices[0], vertices[2] - vertices[0])
    steepness = dot(rays.directions, normal)
    distance = dot(corners[0], normal) / steepness
    is_inside = np.all(volumes >= 0, axis=0) | np.all(volumes <= 0, axis=0)
    return Hits(
        is_hit=is_inside & (steepness != 0) & (distance > 0),
        distance=distance,
        position=rays.origins + distance[..., None] * rays.directions,
        normal=np.broadcast_to(normal / np.linalg.norm(normal), rays.directions.shape),
        is_front=steepness < 0,
    )


def intersect_plane(rays: Rays, point: Array, normal: Array) -> Hits:
    """The hit ahead of each ray's origin, by similar triangles; a ray along the plane misses, one from within it too.

    A ray whose start is h above the plane, and a point at distance 1 on it h - s, meets the plane at the distance h/s.
    """
    unit = normal / np.linalg.norm(normal)
    height = dot(rays.origins - point, unit)
    sinking = -dot(rays.directions, unit)
    distance = height / sinking
    return Hits(
        is_hit=(sinking != 0) & (distance > 0),
        distance=distance,
        position=rays.origins + distance[..., None] * rays.directions,
        normal=np.broadcast_to(unit, rays.directions.shape),
        is_front=sinking > 0,
    )


def is_unobstructed(light: Light, shape: Shape, hits: Hits) -> NDArray[np.bool_]:
    """Whether a light on the viewer's side of the tangent plane is seen from each hit point; shape (height, width).

    A triangle or a plane is flat, and a sphere seen from outside is convex: none can stand before what its tangent
    plane does not hide. Seen from inside, the ball is convex, so it holds the whole way to every point light in it, and
    hides all that is outside.
    """
    if not isinstance(shape, Sphere):
        return np.ones_like(hits.is_front)
    if not isinstance(light, PointLight):
        return hits.is_front
    reaches_inside = float(np.linalg.norm(np.subtract(light.position, shape.center))) <= shape.radius
    return hits.is_front | reaches_inside
