"""Families of extreme sizes and distances."""

from __future__ import annotations

from math import asin, degrees
from typing import TYPE_CHECKING

from raytruth.scenes.families.parts import build, diffuse, emission, floor, lamp, perspective, sphere, triangle, untidy

if TYPE_CHECKING:
    from raytruth.scenes.families.parts import Point
    from raytruth.scenes.scene import Scene


def scale(parameter: float, seed: int) -> Scene:
    """A matt sphere, a mirror, glass and a floor, all lengths multiplied by the parameter.

    The image must not depend on the scale, since attenuation and absorption are scaled along: the truth knows neither
    an epsilon (SHAD-4) nor a farthest distance (TRAV-1). 1e-9 and 1e9 are what float32 can hold: the square of a
    triangle's normal is the fourth power of a length, and its numbers end at 1e-38 and 3e38.
    """
    dx, dy, dz = untidy(seed)

    def at(x: float, y: float, z: float) -> Point:
        return x * parameter, y * parameter, z * parameter

    # No quadratic term, which would need a coefficient of parameter**-2, more than a scene may state.
    falloff = {"constant": 0.31, "linear": 0.17 / parameter, "quadratic": 0.0}
    glass = {"index_of_refraction": 1.47, "absorption": (0.13 / parameter, 0.21 / parameter, 0.34 / parameter)}
    return build(
        "The same picture at every scale: an absolute epsilon shows.",
        perspective(at(0.13 + dx, 1.37 + dy, 6.1 + dz), at(0.0, 0.31, 0.0), 43.0),
        convention="whitted",
        max_depth=4,
        background={"bottom": (0.11, 0.12, 0.17), "top": (0.43, 0.57, 0.71)},
        lights=[{"kind": "point", "position": at(2.3, 4.1, 3.7), "intensity": (2.1,) * 3, "falloff": falloff}],
        materials={
            "matt": diffuse(0.7, 0.3, 0.2)
            | {"specular": {"reflectance": (0.3,) * 3, "exponent": 23.0, "model": "phong"}},
            "mirror": {"mirror": {"reflectance": (0.8, 0.85, 0.9)}},
            "glass": {"dielectric": glass},
            "ground": diffuse(0.4, 0.5, 0.3),
        },
        objects=[
            sphere("matt", at(-1.47, 0.11, -0.9), parameter),
            sphere("mirror", at(1.23, 0.37, -1.7), 1.2 * parameter),
            sphere("glass", at(0.21, -0.17, 1.1), 0.71 * parameter),
            floor("ground", -1.0 * parameter, 9.7 * parameter),
        ],
    )


def sphere_size(parameter: float, seed: int) -> Scene:
    """A sphere with the parameter as radius, whose nearest point is at distance 1, seen whole if that is possible.

    From 1e-5, a dot, to 1e7, a plane for all that the camera sees. Hit or miss and the hit's distance are to be those
    of the equation (SPH-1): no digit may be lost to the radius's square, which is 1e14 times what it is compared with.
    """
    dx, dy, _ = untidy(seed)
    half_angle = degrees(asin(parameter / (1.0 + parameter)))
    return build(
        "A dot or a horizonless plain: a sphere's radius must not cost its surface precision.",
        perspective((0.0, 0.0, 0.0), (dx * 1e-3, dy * 1e-3, -1.0), min(2.3 * half_angle, 97.0)),
        lights=[lamp((0.57 + dx, 0.71 + dy, 0.0), 3.0)],
        background={"color": (0.13, 0.21, 0.34)},
        materials={"matt": diffuse(0.8, 0.6, 0.4)},
        objects=[sphere("matt", (0.0, 0.0, -1.0 - parameter), parameter)],
    )


def above_huge_sphere(parameter: float, seed: int) -> Scene:
    """A camera at height 1 above a sphere with the parameter as radius looks at the horizon, under a low sun.

    The rays graze: the constant term |o - c|² - r² of SPH-1 cancels all but 2/r of its digits, and the horizon is where
    its discriminant is 0. No shadow may appear on the sphere but where the sun is below its own horizon (SHAD-4).
    """
    dx, dy, dz = untidy(seed)
    return build(
        "A planet seen from a man's height: the constant of the quadratic equation cancels.",
        perspective((0.0, 1.0, 0.0), (dx, 0.97 + dy, -3.0 + dz), 61.0),
        lights=[{"kind": "directional", "direction": (0.7, -0.3, -0.6), "irradiance": (2.0, 1.9, 1.7)}],
        background={"color": (0.13, 0.21, 0.34)},
        materials={"matt": diffuse(0.8, 0.6, 0.4)},
        objects=[sphere("matt", (0.0, -parameter, 0.0), parameter)],
    )


def huge_triangle(parameter: float, seed: int) -> Scene:
    """A triangle with the parameter as size is the ground under a sphere of radius 1; its corners are far away.

    The point that a ray meets is to be right to what the corners' coordinates allow (TRI-1), and the shadow on it,
    too (SHAD-1).
    """
    dx, dy, dz = untidy(seed)
    far = parameter
    return build(
        "A ground without end: what is near must not suffer from corners that are far.",
        perspective((0.3 + dx, 2.1 + dy, 6.3 + dz), (0.0, 0.2, 0.0), 47.0),
        lights=[lamp((2.3, 5.1, 3.1), 40.0)],
        background={"color": (0.13, 0.21, 0.34)},
        materials={"matt": diffuse(0.7, 0.3, 0.2), "ground": diffuse(0.4, 0.5, 0.3)},
        objects=[
            sphere("matt", (0.0, 0.0, 0.0), 1.0),
            triangle("ground", (-far, -1.0, 0.7 * far), (far, -1.0 + dy, 0.9 * far), (0.1 * far, -1.0 + dx, -far)),
        ],
    )


def needle(parameter: float, seed: int) -> Scene:
    """A triangle of length 1 and the parameter as width at its base, seen so near that it is some pixels wide.

    A triangle with an area, however small, is hit on both sides and up to its edges (TRI-1, TRI-3). The scene format
    refuses a triangle whose area is exactly 0; a function that is given one misses it (TRI-2).
    """
    dx, dy, dz = untidy(seed)
    base = (0.3 + dx, 0.2 + dy, -0.4 + dz)
    tip = (base[0] + 0.6, base[1] + 0.5, base[2] - 0.3)
    middle = tuple(0.7 * b + 0.3 * t for b, t in zip(base, tip, strict=True))
    # Along one axis, so that the base has the width that it should have, to the last digit of its coordinates.
    return build(
        "A triangle of hardly any width: a threshold on its determinant makes it disappear.",
        {
            "projection": "orthographic",
            "position": (middle[0], middle[1], middle[2] + 1.0),
            "look_at": middle,
            "view_height": 3.1 * parameter,
        },
        background={"color": (0.13, 0.21, 0.34)},
        materials={"shining": emission(0.9, 0.7, 0.3)},
        objects=[triangle("shining", base, (base[0] + parameter, base[1], base[2]), tip)],
    )
