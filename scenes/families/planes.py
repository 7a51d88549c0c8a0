"""Families of infinite planes: seen from near and from within, at grazing angles, and stated from far away."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.families.parts import Rotation, build, diffuse, lamp, perspective, plane, sphere, untidy

if TYPE_CHECKING:
    from raytruth.scenes.families.parts import Point
    from raytruth.scenes.scene import Scene

BACKGROUND = {"color": (0.13, 0.21, 0.34)}
# Along the plane across (1, 4, 2), which whole numbers keep exact; and a point of the plane.
NORMAL = (1.0, 4.0, 2.0)
ALONG = (2.0, 0.0, -1.0)
FOOT = (0.25, -1.0, 0.5)


def camera_near_plane(parameter: float, seed: int) -> Scene:
    """A camera at the parameter above a plane, or below it, looks along it; a lamp is on the side of the normal.

    The plane fills the lower half of the image, or the upper one, down to its horizon, which no ray of seed 0 meets
    (PLANE-2). Of the plane that the camera is in, nothing is seen (PLANE-3).
    """
    turned = Rotation(seed)
    return build(
        "Just above a plane, just below it and exactly in it: what the ray starts on is not met.",
        perspective(turned((0.0, 0.0, parameter)), turned((0.0, 1.0, parameter)), 67.0, up=turned((0.0, 0.0, 1.0))),
        background=BACKGROUND,
        lights=[lamp(turned((0.3, 2.1, 1.7)), 9.0)],
        materials={"matt": diffuse(0.8, 0.6, 0.4)},
        objects=[plane("matt", (0.0, 0.0, 0.0), turned((0.0, 0.0, 3.0)))],
    )


def grazing_plane(parameter: float, seed: int) -> Scene:
    """A camera at height 1 sees a matt floor at sines of about the parameter, and a ball on it, through a long lens.

    The floor is met however far away (PLANE-1) and however nearly parallel the ray is (PLANE-2). Nothing is lost of the
    ball's shadow on it (SHAD-4), nor of what is seen of it in all its length.
    """
    dx, dy, _ = untidy(seed)
    far = 1.0 / parameter
    return build(
        "A floor seen at a grazing angle: no sine is so small that it counts as 0.",
        perspective((0.0, 1.0, 0.0), (0.0, 0.0, -far), min(60.0, 57.0 * parameter)),
        background=BACKGROUND,
        lights=[lamp((0.7 * far, (0.9 + dy) * far, -0.6 * far), 0.9 * far * far)],
        materials={"matt": diffuse(0.8, 0.6, 0.4), "red": diffuse(0.8, 0.2, 0.1)},
        objects=[plane("matt", (0.0, 0.0, 0.0), (0.0, 0.7, 0.0)), sphere("red", (0.1 * dx, 0.13, -far), 0.13)],
    )


def plane_stated_from_afar(parameter: float, seed: int) -> Scene:
    """A tilted plane by a point of it at the parameter from what is seen of it; a ball throws its shadow on it.

    Any point of the plane states the same plane (PLANE-1). All of the place is in one product, ⟨p - o, m⟩, of which as
    many digits cancel as the point is far away.
    """
    dx, dy, dz = untidy(seed)
    steps = float(round(parameter))
    point: Point = (FOOT[0] + steps * ALONG[0], FOOT[1] + steps * ALONG[1], FOOT[2] + steps * ALONG[2])
    return build(
        "A plane by a far point of it: what is seen does not depend on which point is stated.",
        perspective((0.3 + dx, 2.1 + dy, 5.3 + dz), (0.1, -0.9, 0.2), 43.0),
        background=BACKGROUND,
        lights=[lamp((2.3, 4.1, 1.7), 90.0)],
        materials={"matt": diffuse(0.8, 0.6, 0.4), "red": diffuse(0.8, 0.2, 0.1)},
        objects=[sphere("red", (0.2, 0.1, 0.4), 0.7), plane("matt", point, NORMAL)],
    )
