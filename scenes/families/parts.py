"""What the families are built from: cameras, shapes and rotations, in the form that scenes are validated from."""

from __future__ import annotations

from math import cos, pi, sin
from random import Random
from typing import Any

from raytruth.scenes.scene import Scene

Part = dict[str, Any]
Point = tuple[float, float, float]

# Enough pixels that every row and column of a family's extreme is met, few enough for a certified image in a second.
WIDTH, HEIGHT = 16, 12


def build(purpose: str, camera: Part, **stated: Any) -> Scene:
    """A scene of the parts; the image is small, and the convention `radiometric` unless it is stated."""
    whole = {"purpose": purpose, "convention": "radiometric", "camera": {"width": WIDTH, "height": HEIGHT, **camera}}
    return Scene.model_validate(whole | stated)


def perspective(position: Point, look_at: Point, degrees: float, **stated: Any) -> Part:
    """A camera with a vertical field of view in degrees."""
    camera = {"projection": "perspective", "position": position, "look_at": look_at, "vertical_field_of_view": degrees}
    return camera | stated


def orthographic(position: Point, look_at: Point, height: float, **stated: Any) -> Part:
    """A camera that sees a rectangle of this height."""
    camera = {"projection": "orthographic", "position": position, "look_at": look_at, "view_height": height}
    return camera | stated


def sphere(material: str, center: Point, radius: float) -> Part:
    """A sphere."""
    return {"shape": "sphere", "center": center, "radius": radius, "material": material}


def triangle(material: str, a: Point, b: Point, c: Point) -> Part:
    """A triangle."""
    return {"shape": "triangle", "vertices": (a, b, c), "material": material}


def plane(material: str, point: Point, normal: Point) -> Part:
    """An infinite plane."""
    return {"shape": "plane", "point": point, "normal": normal, "material": material}


def quadrilateral(material: str, a: Point, b: Point, c: Point, d: Point) -> Part:
    """Two triangles that share the edge from a to c."""
    return {"shape": "mesh", "vertices": (a, b, c, d), "faces": ((0, 1, 2), (0, 2, 3)), "material": material}


def floor(material: str, height: float, half: float) -> Part:
    """A horizontal square around the y axis, seen from above."""
    low, high = -half, half
    return quadrilateral(material, (low, height, high), (high, height, high), (high, height, low), (low, height, low))


def emission(red: float, green: float, blue: float) -> Part:
    """A material that shines."""
    return {"emission": {"radiance": (red, green, blue)}}


def diffuse(red: float, green: float, blue: float) -> Part:
    """A matt material."""
    return {"diffuse": {"reflectance": (red, green, blue)}}


def lamp(position: Point, intensity: float) -> Part:
    """A white point light with the inverse-square law."""
    return {"kind": "point", "position": position, "intensity": (intensity,) * 3, "falloff": "inverse_square"}


class Rotation:
    """A rotation drawn by a seed; seed 0 leaves every point exactly where it is, so that ties are exact."""

    def __init__(self, seed: int) -> None:
        angles = Random(seed)
        self.angles = [angles.uniform(-pi, pi) if seed else 0.0 for _ in range(3)]

    def __call__(self, point: Point) -> Point:
        """The rotated point."""
        for axis, angle in enumerate(self.angles):
            first, second, third = point[axis - 2], point[axis - 1], point[axis]
            turned = {
                (axis - 2) % 3: cos(angle) * first - sin(angle) * second,
                (axis - 1) % 3: sin(angle) * first + cos(angle) * second,
                axis: third,
            }
            point = (turned[0], turned[1], turned[2])
        return point


def untidy(seed: int, size: float = 0.1) -> Point:
    """A small offset drawn by the seed, so that nothing lies exactly on a grid."""
    numbers = Random(seed)
    return numbers.uniform(-size, size), numbers.uniform(-size, size), numbers.uniform(-size, size)
