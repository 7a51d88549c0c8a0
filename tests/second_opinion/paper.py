"""What is needed to write down an image by hand, in mpmath's numbers of any precision; nothing here is the tracer's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mpmath import mp, mpf

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.scenes.camera import Camera

Number = Any
"""An mpf: mpmath's types are not stated."""
Vector = tuple[Number, Number, Number]


def exact(values: Sequence[float]) -> Vector:
    """Floats as they are: every float is an mpf."""
    x, y, z = map(mpf, values)
    return x, y, z


def dot(a: Vector, b: Vector) -> Number:
    return mp.fdot(zip(a, b, strict=True))


def length(a: Vector) -> Number:
    return mp.sqrt(dot(a, a))


def combined(*terms: tuple[Number, Vector]) -> Vector:
    """The sum of factor times vector over all terms."""
    x, y, z = (mp.fsum(factor * vector[axis] for factor, vector in terms) for axis in range(3))
    return x, y, z


def difference(a: Vector, b: Vector) -> Vector:
    return combined((1, a), (-1, b))


def unit(a: Vector) -> Vector:
    return combined((1 / length(a), a))


def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def by_channel(*colors: Vector) -> Vector:
    """The product of colours, channel by channel."""
    red, green, blue = (mp.fprod(channel) for channel in zip(*colors, strict=True))
    return red, green, blue


def camera_ray(camera: Camera, x: float, y: float) -> tuple[Vector, Vector]:
    """Origin and unit direction through the image point (x, y) in pixels, from the top left corner.

    The image's up is what Gram and Schmidt leave of `up` (CAM-1); from the image's middle to its top it is tan(φ/2) at
    distance 1 (CAM-3), or half the visible height (CAM-4).
    """
    position = exact(camera.position)
    forward = unit(difference(exact(camera.look_at), position))
    up = exact(camera.up)
    up = unit(combined((1, up), (-dot(up, forward), forward)))
    right = cross(forward, up)
    across = (2 * mpf(x) - camera.width) / camera.height
    upward = 1 - 2 * mpf(y) / camera.height
    if camera.projection == "perspective":
        half = mp.tan(mp.radians(mpf(camera.vertical_field_of_view) / 2))
        return position, unit(combined((1, forward), (half * across, right), (half * upward, up)))
    half = mpf(camera.view_height) / 2
    return combined((1, position), (half * across, right), (half * upward, up)), forward


def closest_to(center: Vector, origin: Vector, direction: Vector) -> tuple[Number, Vector]:
    """Where a line comes closest to a point: how far along it, and the vector from the point to there."""
    foot = dot(difference(center, origin), direction)
    return foot, combined((1, origin), (foot, direction), (-1, center))


def sphere_normal_seen(center: Vector, radius: Number, origin: Vector, direction: Vector) -> Vector | None:
    """The outward normal where a ray from outside first meets a sphere; None for a miss.

    A chord at distance s from the centre reaches sqrt(r² - s²) to both sides of its middle (Pythagoras).
    """
    foot, aside = closest_to(center, origin, direction)
    half_chord_squared = radius**2 - dot(aside, aside)
    if half_chord_squared < 0 or foot < 0:
        return None
    return combined((1 / radius, aside), (-mp.sqrt(half_chord_squared) / radius, direction))


def fresnel(incident: Number, refracted: Number) -> Number:
    """Reflectance of unpolarised light from both angles: the sine law and the tangent law.

    Fresnel 1823; Born, Wolf, "Principles of Optics", 7th edition, section 1.5.2, eq. (21a).
    """
    both = incident + refracted
    between = incident - refracted
    return ((mp.sin(between) / mp.sin(both)) ** 2 + (mp.tan(between) / mp.tan(both)) ** 2) / 2


def gradient(bottom: Sequence[float], top: Sequence[float], height: Number) -> Vector:
    """The background where the unit direction has the y coordinate `height` (BG-1): the mean where that is 0."""
    return combined(((1 - height) / 2, exact(bottom)), ((1 + height) / 2, exact(top)))


def faded(absorption: Sequence[float], distance: Number) -> Vector:
    """Bouguer's law: equal distances take equal fractions, exp(-σ·d) in all (Bouguer 1729, Lambert 1760)."""
    red, green, blue = (mp.exp(-mpf(sigma) * distance) for sigma in absorption)
    return red, green, blue
