"""Small scenes that are put along any axes and on any scale, in numbers that floats hold, for tests of ties."""

from __future__ import annotations

import itertools
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from hypothesis import strategies as st

from raytruth.scenes.scene import Scene
from tests.extremes.exact_pixels import cross, dot, minus

if TYPE_CHECKING:
    from collections.abc import Sequence

    Point = Sequence[float]

GREY = 0.5
WHITE = {"diffuse": {"reflectance": (GREY, GREY, GREY)}}
SHINING = {"emission": {"radiance": (1.0, 0.5, 0.25)}}
SKY = (0.125, 0.25, 0.75)
AXES = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)]
# Width and height of images whose pixels lie one unit apart where they are looked at.
SIDE = 9


class Place:
    """Where a scene is put: local coordinates are to the right, up and towards the viewer, of unit size."""

    def __init__(self, forward: Point, up: Point, size: float) -> None:
        self.up = tuple(map(float, up))
        self.axes = (cross(forward, up), up, tuple(-part for part in forward))
        self.size = size

    def __call__(self, *local: float) -> tuple[float, ...]:
        """A local point as the scene states it."""
        return tuple(
            self.size * sum(float(axis[i]) * part for axis, part in zip(self.axes, local, strict=True))
            for i in range(3)
        )

    def __repr__(self) -> str:
        return f"Place{(*self.axes, self.size)}"


PLACES = st.builds(
    lambda axes, factor, exponent: Place(*axes, factor * 2.0**exponent),
    st.sampled_from([(f, u) for f, u in itertools.product(AXES, AXES) if dot(f, u) == 0]),
    st.sampled_from([1, 3, 5, 11]),  # a third has no end in binary, so that directions are no exact balls
    st.integers(-10, 10),
)
QUARTERS = st.integers(-12, 12).map(lambda n: n / 4)
# Two sides of a right angle, and the third.
TRIPLES = [(3, 4, 5), (4, 3, 5), (5, 12, 13), (15, 8, 17), (0, 1, 1), (1, 0, 1)]
# Three coordinates of a point at a whole distance from the origin, and that distance.
ROUND_POINTS = [
    ((signs[0] * p[0], signs[1] * p[1], signs[2] * p[2]), radius)
    for whole, radius in (((0, 0, 1), 1), ((1, 2, 2), 3), ((2, 3, 6), 7), ((1, 4, 8), 9), ((0, 3, 4), 5))
    for p in sorted(set(itertools.permutations(whole)))
    for signs in itertools.product((1, -1), repeat=3)
]


def looking_down(place: Place, x: float, y: float, *, height: float = SIDE / 2, perspective: bool = False) -> Any:
    """A camera over the local plane z = 0 whose pixels' centres lie at whole distances from (x, y) there."""
    camera = {
        "position": place(x, y, height),
        "look_at": place(x, y, height - 1.0),
        "up": place.up,
        "width": SIDE,
        "height": SIDE,
    }
    if perspective:
        return camera | {"projection": "perspective", "vertical_field_of_view": 90.0}
    return camera | {"projection": "orthographic", "view_height": SIDE * place.size}


def seen_point(x: float, y: float, column: int, row: int) -> tuple[float, float, float]:
    return (x + column - SIDE // 2, y + SIDE // 2 - row, 0.0)


def scene(camera: Any, objects: list[Any], materials: dict[str, Any], **more: Any) -> Scene:
    base = {"purpose": "A test.", "convention": "whitted", "background": {"color": SKY}}
    return Scene.model_validate(base | {"camera": camera, "objects": objects, "materials": materials} | more)


def lamp(position: Point) -> dict[str, Any]:
    return {"kind": "point", "position": position, "intensity": (1.0, 1.0, 1.0), "falloff": "none"}


def lit_square(point: Point, light: Point) -> Fraction:
    """The square of what a grey floor z = 0 shows of a light at this point that nothing hides."""
    toward = minus(light, point)
    if toward[2] <= 0:
        return Fraction(0)
    return Fraction(GREY) ** 2 * toward[2] ** 2 / dot(toward, toward)
