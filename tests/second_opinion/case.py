"""A small scene with untidy numbers, a point of its image, and the closed form of the radiance there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from raytruth.scenes.scene import Scene

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

    from tests.second_opinion.paper import Vector

WIDTH, HEIGHT = 28, 20
Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Case:
    """`radiance` is exact but for the precision that mpmath works in; it holds at every point of the image.

    `side` tells on which side of the closed form's own edge an image point lies: lit or not, totally reflected or not.
    """

    scene: Scene
    radiance: Callable[[float, float], Vector]
    x: float
    y: float
    side: Callable[[float, float], bool] | None = None


def build(camera: dict[str, Any], materials: dict[str, Any], objects: list[dict[str, Any]], **more: Any) -> Scene:
    base = {"purpose": "A test.", "convention": "radiometric", "camera": camera, "objects": objects}
    return Scene.model_validate(base | {"materials": materials} | more)


def case(
    numbers: Random,
    scene: Scene,
    radiance: Callable[[float, float], Vector],
    side: Callable[[float, float], bool] | None = None,
) -> Case:
    """At any point of the image."""
    return Case(scene, radiance, numbers.uniform(0, WIDTH), numbers.uniform(0, HEIGHT), side)


def color(numbers: Random, least: float = 0.05, most: float = 0.95) -> Triple:
    return (numbers.uniform(least, most), numbers.uniform(least, most), numbers.uniform(least, most))


def sky(numbers: Random) -> dict[str, Triple]:
    return {"bottom": color(numbers), "top": color(numbers)}


def around(numbers: Random, center: Triple, least: float, most: float) -> Triple:
    """A point in any direction from the centre, at a distance between the two."""
    x, y, z = (numbers.gauss(0, 1) for _ in range(3))
    factor = numbers.uniform(least, most) / (x * x + y * y + z * z) ** 0.5
    return (center[0] + factor * x, center[1] + factor * y, center[2] + factor * z)


def anywhere(numbers: Random) -> Triple:
    return around(numbers, (0.0, 0.0, 0.0), 0, 2)


def perspective(numbers: Random, position: Triple, look_at: Triple, view: float, **more: Any) -> dict[str, Any]:
    """A camera with a vertical field of view in degrees, its up in any direction."""
    placed = {"position": position, "look_at": look_at, "up": anywhere(numbers), "width": WIDTH, "height": HEIGHT}
    return {"projection": "perspective", "vertical_field_of_view": view} | placed | more


def orthographic(numbers: Random, position: Triple, look_at: Triple, view: float, **more: Any) -> dict[str, Any]:
    """As `perspective`, with the visible height."""
    placed = {"position": position, "look_at": look_at, "up": anywhere(numbers), "width": WIDTH, "height": HEIGHT}
    return {"projection": "orthographic", "view_height": view} | placed | more


def sphere(center: Triple, radius: float, material: str) -> dict[str, Any]:
    return {"shape": "sphere", "center": center, "radius": radius, "material": material}


def plane(z: float, material: str, *, facing_up: bool = True) -> dict[str, Any]:
    """A square of side 200 in the plane of this z, larger than anything that the cases look at."""
    corners = ((-100.0, -100.0, z), (100.0, -100.0, z), (100.0, 100.0, z), (-100.0, 100.0, z))
    faces = ((0, 1, 2), (0, 2, 3)) if facing_up else ((2, 1, 0), (3, 2, 0))
    return {"shape": "mesh", "vertices": corners, "faces": faces, "material": material}


def point_light(position: Triple, intensity: Triple, falloff: Any = "inverse_square") -> dict[str, Any]:
    return {"kind": "point", "position": position, "intensity": intensity, "falloff": falloff}


def sun(direction: Triple, irradiance: Triple) -> dict[str, Any]:
    return {"kind": "directional", "direction": direction, "irradiance": irradiance}
