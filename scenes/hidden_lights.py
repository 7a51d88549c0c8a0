"""Whether a triangle may stand between a light and what is seen of another: proved in whole numbers, not sampled.

A renderer that throws no shadows gives the image of a scene only where there are none. A light is not hidden from any
point of a triangle that the camera can see if, for each other triangle, one of these holds (all signs are exact):

- the camera and the light are on different sides of the first one's plane, so that it is not lit where it is seen;
- the other one lies behind the first one's plane, seen from the light, or in it;
- the first one and the light lie on one side of the other one's plane;
- a plane through the light and an edge of one of them separates the two.

Nor is a light hidden from anything that is seen if it is where all rays of the camera start. Where nothing of this
holds, the light may still not be hidden: then nothing is proved.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.exporters.triangle_soup import material_of_each_triangle, triangles_of_scene
from raytruth.scenes.lights import PointLight
from raytruth.scenes.planes import has_planes

if TYPE_CHECKING:
    from collections.abc import Iterable

    from raytruth.scenes.lights import Light
    from raytruth.scenes.scene import Scene

    Point = tuple[int, int, int]
    Triangle = tuple[Point, Point, Point]
    Homogeneous = tuple[Point, int]
    """A point and 1, or a direction and 0."""
    Plane = tuple[Point, int]
    """A normal n and n·p of the plane's points p."""

# Of all pairs; with more, the proof takes longer than a second a light.
MOST_TRIANGLES = 256


def may_be_hidden(scene: Scene) -> str | None:
    """In one clause which triangle may hide a light from which, as far as is proved; None if surely none does.

    Only of triangles, and only those surfaces count that have a term which is lit by lights. Of infinite planes nothing
    is proved.
    """
    if has_planes(scene):
        return "an infinite plane may hide a light, and nothing is proved of planes"
    materials = [scene.materials[name] for name in material_of_each_triangle(scene)]
    lit = [number for number, material in enumerate(materials) if "lights" in material.light_from()]
    if not lit or not scene.lights:
        return None
    if len(materials) > MOST_TRIANGLES:
        return f"of {len(materials)} triangles, more than {MOST_TRIANGLES}, none is proved to hide no light"
    whole = _WholeNumbers(scene)
    for number, light in enumerate(scene.lights):
        toward = whole.light(light)
        if toward == whole.viewer and toward[1] == 1:
            continue
        for receiver in lit:
            hiding = _first_that_may_hide(whole, toward, receiver)
            if hiding is not None:
                return f"triangle {hiding} may hide light {number} from triangle {receiver}"
    return None


def _first_that_may_hide(whole: _WholeNumbers, light: Homogeneous, receiver: int) -> int | None:
    """The number of a triangle, which is not proved to hide nothing of this light from the receiver."""
    lit, plane = whole.triangles[receiver], whole.planes[receiver]
    lit_side = _side(plane, light)
    if lit_side * _side(plane, whole.viewer) <= 0:
        return None
    for number, (other, others_plane) in enumerate(zip(whole.triangles, whole.planes, strict=True)):
        if number == receiver or others_plane[0] == (0, 0, 0):  # nothing meets a triangle without area (TRI-2)
            continue
        if all(lit_side * _side(plane, (corner, 1)) <= 0 for corner in other):
            continue
        if not _is_on_one_side(others_plane, lit, light) and not _are_apart(lit, other, light):
            return number
    return None


def _is_on_one_side(plane: Plane, triangle: Triangle, light: Homogeneous) -> bool:
    """Whether all that is strictly between a triangle and a light is off a plane, and on one side of it."""
    sides = [_side(plane, (corner, 1)) for corner in triangle]
    of_light = _side(plane, light)
    if of_light:
        return all(of_light * side >= 0 for side in sides)
    return all(side > 0 for side in sides) or all(side < 0 for side in sides)


def _are_apart(first: Triangle, second: Triangle, light: Homogeneous) -> bool:
    """Whether two triangles are separate, seen from the light: then a line along an edge of one separates them."""
    for one, other in ((first, second), (second, first)):
        for a, b, opposite in ((one[i - 2], one[i - 1], one[i]) for i in range(3)):
            plane = _plane_with_light(a, b, light)
            side = _side(plane, (opposite, 1))
            if side and all(side * _side(plane, (corner, 1)) < 0 for corner in other):
                return True
    return False


class _WholeNumbers:
    """A scene's corners, viewer and lights times one power of two, which makes whole numbers of all coordinates."""

    def __init__(self, scene: Scene) -> None:
        corners = triangles_of_scene(scene).reshape(-1, 3).tolist()
        camera = scene.camera
        positions = [light.position for light in scene.lights if isinstance(light, PointLight)]
        self._factor = _denominator(value for point in (*corners, *positions, camera.position) for value in point)
        points = [self._scaled(corner) for corner in corners]
        self.triangles: list[Triangle] = [(points[i], points[i + 1], points[i + 2]) for i in range(0, len(points), 3)]
        self.planes = [_plane(*corners) for corners in self.triangles]
        self.viewer = (self._scaled(camera.position), 1)
        """The point that all rays of the camera start from, or the direction against which they go."""
        if camera.projection == "orthographic":
            factor = _denominator((*camera.position, *camera.look_at))
            toward = [
                _whole(here, factor) - _whole(there, factor)
                for here, there in zip(camera.position, camera.look_at, strict=True)
            ]
            self.viewer = ((toward[0], toward[1], toward[2]), 0)

    def light(self, light: Light) -> Homogeneous:
        """The place of a light, or the direction to it."""
        if isinstance(light, PointLight):
            return self._scaled(light.position), 1
        factor = -_denominator(light.direction)
        x, y, z = light.direction
        return (_whole(x, factor), _whole(y, factor), _whole(z, factor)), 0

    def _scaled(self, point: Iterable[float]) -> Point:
        x, y, z = point
        return _whole(x, self._factor), _whole(y, self._factor), _whole(z, self._factor)


def _denominator(values: Iterable[float]) -> int:
    """The least common one of floats: the largest, since all are powers of two."""
    return max(value.as_integer_ratio()[1] for value in map(float, values))


def _whole(value: float, factor: int) -> int:
    numerator, denominator = float(value).as_integer_ratio()
    return numerator * factor // denominator


def _plane(a: Point, b: Point, c: Point) -> Plane:
    normal = _cross(_minus(b, a), _minus(c, a))
    return normal, _dot(normal, a)


def _plane_with_light(a: Point, b: Point, light: Homogeneous) -> Plane:
    point, weight = light
    x, y, z = a
    normal = _cross(_minus(b, a), _minus(point, (weight * x, weight * y, weight * z)))
    return normal, _dot(normal, a)


def _side(plane: Plane, point: Homogeneous) -> int:
    """Above 0 on the side of the normal, 0 in the plane; of a direction, whether it leads there."""
    return _dot(plane[0], point[0]) - point[1] * plane[1]


def _minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _dot(a: Point, b: Point) -> int:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Point, b: Point) -> Point:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
