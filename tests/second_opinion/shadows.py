"""Closed forms of the shadow that a sphere casts on a floor."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mpmath import mp, mpf

from tests.second_opinion import case as make
from tests.second_opinion.paper import (
    Vector,
    by_channel,
    camera_ray,
    closest_to,
    combined,
    difference,
    dot,
    exact,
    length,
    sphere_normal_seen,
    unit,
)

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

    from tests.second_opinion.case import Case

BLACK = (mpf(0), mpf(0), mpf(0))


def umbra_of_a_point_light(numbers: Random) -> Case:
    """The umbra is the cone of half angle asin(r/D) around the direction from the light to the centre.

    Elsewhere the floor z = 0 has L = ρ/π · I · z_light/d³. The floor lies below the sphere, the light above.
    """
    center, radius = _hovering(numbers)
    light = (center[0] + numbers.uniform(-2, 2), center[1] + numbers.uniform(-2, 2), center[2] + numbers.uniform(2, 4))
    intensity = make.color(numbers, 5, 50)

    def irradiance(point: Vector) -> Vector | None:
        axis, down = difference(exact(center), exact(light)), difference(point, exact(light))
        angle = mp.acos(dot(axis, down) / (length(axis) * length(down)))
        if angle <= mp.asin(radius / length(axis)):
            return None
        return combined((light[2] / length(down) ** 3, exact(intensity)))

    middle = _meeting_the_floor(center, [c - p for c, p in zip(center, light, strict=True)])
    return _floor(numbers, center, radius, middle, make.point_light(light, intensity), irradiance)


def shadow_of_the_sun(numbers: Random) -> Case:
    """Of parallel light the shadow is a cylinder of radius r around the axis through the centre."""
    center, radius = _hovering(numbers)
    direction = (numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(-2, -0.6))
    strength = make.color(numbers, 0.5, 5)

    def irradiance(point: Vector) -> Vector | None:
        along = unit(exact(direction))
        _, aside = closest_to(exact(center), point, along)
        return None if length(aside) <= radius else combined((-along[2], exact(strength)))

    middle = _meeting_the_floor(center, direction)
    return _floor(numbers, center, radius, middle, make.sun(direction, strength), irradiance)


def _hovering(numbers: Random) -> tuple[make.Triple, float]:
    """Centre and radius of a sphere above the floor."""
    radius = numbers.uniform(0.3, 0.9)
    return (numbers.uniform(-1, 1), numbers.uniform(-1, 1), radius + numbers.uniform(0.1, 1)), radius


def _meeting_the_floor(center: make.Triple, direction: Any) -> make.Triple:
    """The shadow's middle, about: that is where the camera looks."""
    steps = -center[2] / direction[2]
    return (center[0] + steps * direction[0], center[1] + steps * direction[1], 0.0)


def _floor(
    numbers: Random,
    center: make.Triple,
    radius: float,
    middle: make.Triple,
    light: dict[str, Any],
    irradiance: Callable[[Vector], Vector | None],
) -> Case:
    """A matt floor z = 0 and above it a sphere that glows; a None of `irradiance` is shadow."""
    reflectance, glow = make.color(numbers), make.color(numbers)
    position = (numbers.uniform(-4, 4), numbers.uniform(-4, 4), numbers.uniform(3, 6))
    scene = make.build(
        make.perspective(numbers, position, middle, numbers.uniform(8, 20)),
        {"matt": {"diffuse": {"reflectance": reflectance}}, "glowing": {"emission": {"radiance": glow}}},
        [make.plane(0.0, "matt"), make.sphere(center, radius, "glowing")],
        lights=[light],
    )

    def radiance(x: float, y: float) -> Vector:
        origin, direction = camera_ray(scene.camera, x, y)
        if sphere_normal_seen(exact(center), mpf(radius), origin, direction) is not None:
            return exact(glow)
        if direction[2] >= 0:
            return BLACK
        arriving = irradiance(combined((1, origin), (-origin[2] / direction[2], direction)))
        if arriving is None:
            return BLACK
        return combined((1 / mp.pi, by_channel(exact(reflectance), arriving)))

    return make.case(numbers, scene, radiance, lambda x, y: radiance(x, y) == BLACK)
