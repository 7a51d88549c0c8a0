"""Ordinary scenes, drawn at random: what people's scenes are like, at their scales and in their places."""

from __future__ import annotations

from math import cos, radians, sin
from random import Random
from typing import TYPE_CHECKING, Any

from raytruth.scenes.families.parts import build, diffuse, perspective, quadrilateral, sphere, triangle

if TYPE_CHECKING:
    from raytruth.scenes.families.parts import Part, Point
    from raytruth.scenes.scene import Scene

# Of all drawn scenes: how many lie far from the origin, have a mirror among their materials, and a second light.
FAR, WITH_MIRROR, WITH_SECOND_LIGHT = 0.25, 0.3, 0.3
# Where these lie: with float32, a coordinate of 1e4 leaves 2^-10 of a unit.
FARTHEST = 1e4


def drawn(parameter: float, seed: int) -> Scene:
    """A floor of ±5 to ±1000, balls of 0.01 to 3, some slivers, one or two lamps; all lengths times the parameter.

    What is seen does not depend on scale and place (TRAV-1), and nothing near may be lost of a shadow (SHAD-4), though
    the floor is far larger than what stands on it, and slivers are hardly wider than a ray. So a right renderer fails
    on none of them, whatever its offsets, and whatever the formulas by which it finds points.
    """
    random = Random(f"drawn {parameter} {seed}")
    away = tuple(random.choice((-1.0, 0.0, 1.0)) * random.uniform(10.0, FARTHEST) for _ in range(3))
    away = away if random.random() < FAR else (0.0, 0.0, 0.0)

    def at(x: float, y: float, z: float) -> Point:
        return (x + away[0]) * parameter, (y + away[1]) * parameter, (z + away[2]) * parameter

    half = 10.0 ** random.uniform(0.7, 3.0)
    turn = radians(random.uniform(0.0, 90.0))
    corners = [
        (half * cos(turn + quarter), half * sin(turn + quarter)) for quarter in map(radians, (45, 135, 225, 315))
    ]
    balls = [_ball(random, at, parameter) for _ in range(random.randint(1, 3))]
    slivers = [_sliver(random, at) for _ in range(random.randint(0, 2))]
    view = radians(random.uniform(0.0, 360.0))
    eye = at(6.0 * cos(view), random.uniform(1.2, 4.0), 6.0 * sin(view))
    return build(
        "An ordinary scene of its own scale and place.",
        perspective(eye, at(0.0, 0.6, 0.0), random.uniform(25.0, 60.0)),
        max_depth=1,
        lights=[_lamp(random, at, parameter) for _ in range(2 if random.random() < WITH_SECOND_LIGHT else 1)],
        materials={
            "ground": diffuse(*(random.uniform(0.2, 0.9) for _ in range(3))),
            "matt": diffuse(*(random.uniform(0.2, 0.9) for _ in range(3))),
            "other": {"mirror": {"reflectance": (0.9, 0.85, 0.8)}}
            if random.random() < WITH_MIRROR
            else diffuse(0.3, 0.6, 0.5),
        },
        objects=[quadrilateral("ground", *(at(x, 0.0, z) for x, z in reversed(corners))), *balls, *slivers],
    )


def _ball(random: Random, at: Any, parameter: float) -> Part:
    radius = 10.0 ** random.uniform(-2.0, 0.5)
    center = at(random.uniform(-2.0, 2.0), radius * random.uniform(0.6, 1.6), random.uniform(-2.0, 2.0))
    return sphere(random.choice(("matt", "other")), center, radius * parameter)


def _sliver(random: Random, at: Any) -> Part:
    x, y, z = random.uniform(-2.0, 2.0), random.uniform(0.2, 2.0), random.uniform(-2.0, 2.0)
    width = 10.0 ** random.uniform(-4.0, -1.0)
    return triangle("matt", at(x, y, z), at(x + random.uniform(1.0, 2.0), y + 0.3, z), at(x, y + width, z + width))


def _lamp(random: Random, at: Any, parameter: float) -> Part:
    position = at(random.uniform(-4.0, 4.0), random.uniform(3.0, 8.0), random.uniform(-4.0, 4.0))
    intensity = tuple(random.uniform(20.0, 60.0) * parameter**2 for _ in range(3))
    return {"kind": "point", "position": position, "intensity": intensity, "falloff": "inverse_square"}
