"""Families of rays that touch: tangents, edges and corners, surfaces in one place, a camera on a surface."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.families.parts import (
    Rotation,
    build,
    diffuse,
    emission,
    lamp,
    orthographic,
    perspective,
    quadrilateral,
    sphere,
    untidy,
)

if TYPE_CHECKING:
    from raytruth.scenes.families.parts import Part
    from raytruth.scenes.scene import Scene

BACKGROUND = {"color": (0.13, 0.21, 0.34)}
AXES = ((0.0, 0.0, 8.0), (0.0, 0.0, -8.0), (8.0, 0.0, 0.0), (-8.0, 0.0, 0.0), (0.0, 8.0, 0.0), (0.0, -8.0, 0.0))


def tangent(parameter: float, seed: int) -> Scene:
    """Parallel rays, 12 of which pass a sphere's centre at 1 + parameter times its radius; along an axis by the seed.

    A ray exactly tangent hits (SPH-2). All distances are whole, with the circle of radius 5 through (3, 4) and (5, 0),
    so that at parameter 0 the discriminant is 0 without rounding: these pixels are exact ties.
    """
    position = AXES[seed % len(AXES)]
    up = (0.0, 0.0, 1.0) if position[1] else (0.0, 1.0, 0.0)
    # Half a pixel off the image's centre on both of its axes: in the middle of a pixel.
    center = tuple(0.5 * (axis == 0.0) for axis in position)
    return build(
        "Rays that touch a sphere hit it.",
        orthographic(position, (0.0, 0.0, 0.0), 12.0, up=up),
        background=BACKGROUND,
        materials={"shining": emission(0.9, 0.7, 0.3)},
        objects=[{"shape": "sphere", "center": center, "radius": 5.0 / (1.0 + parameter), "material": "shining"}],
    )


def coplanar(parameter: float, seed: int) -> Scene:
    """Two squares that overlap, the second nearer to the camera by the parameter.

    The nearer one is seen; at exactly the same distance either may be (TRAV-3), so that at parameter 0 every pixel of
    the overlap is an exact tie: never a third value, and never the background.
    """
    turned = Rotation(seed)
    corners = [(-2.0, -2.0), (1.0, -2.0), (1.0, 2.0), (-2.0, 2.0)]
    first = quadrilateral("first", *(turned((x, y, 0.0)) for x, y in corners))
    second = quadrilateral("second", *(turned((x + 1.0, y, parameter)) for x, y in corners))
    return build(
        "Two surfaces in one plane: one of them is seen, entire or in parts, and nothing else.",
        orthographic(turned((0.03, 0.07, 8.0)), turned((0.03, 0.07, 0.0)), 6.1, up=turned((0.0, 1.0, 0.0))),
        background=BACKGROUND,
        materials={"first": emission(0.9, 0.2, 0.1), "second": emission(0.1, 0.3, 0.8)},
        objects=[first, second],
    )


def coincident_spheres(parameter: float, seed: int) -> Scene:
    """Two spheres around one centre, the second larger by the parameter.

    The larger one is seen, and it alone is lit: it casts its shadow on the other. At parameter 0 the lower number
    wins (TRAV-3), and whether each shadows the other is an exact tie: its surface is met at t = 0, which is no hit.
    """
    dx, dy, dz = untidy(seed)
    center = (dx, dy, dz)
    return build(
        "Two spheres in one place: the first is seen, and it does not shadow itself through the second.",
        perspective((0.2, 0.3, 4.1), (0.0, 0.0, 0.0), 41.0),
        background=BACKGROUND,
        lights=[lamp((2.1, 3.3, 4.7), 30.0)],
        materials={"first": diffuse(0.9, 0.2, 0.1), "second": diffuse(0.1, 0.3, 0.8)},
        objects=[sphere("first", center, 1.0), sphere("second", center, 1.0 + parameter)],
    )


def fan(parameter: float, seed: int) -> Scene:
    """A closed sheet of as many triangles as the parameter says around one vertex, seen through vertex and edges.

    No ray passes between two triangles that share an edge or a vertex (TRI-1): the sheet fills the image, and the
    background behind it is never seen. For seed 0 rays meet the edges exactly, which are exact ties of two triangles
    of one colour; for all others the sheet is turned in space, and they meet them within rounding.
    """
    turned = Rotation(seed)
    rim = _lattice_square(int(parameter))
    vertices = [turned((0.5, 0.5, 0.0)), *(turned((0.5 + x, 0.5 + y, 0.0)) for x, y in rim)]
    faces = [(0, 1 + k, 1 + (k + 1) % len(rim)) for k in range(len(rim))]
    sheet: Part = {"shape": "mesh", "vertices": vertices, "faces": faces, "material": "shining"}
    return build(
        "Triangles that share edges and a vertex leave no gap.",
        orthographic(turned((0.0, 0.0, 8.0)), turned((0.0, 0.0, 0.0)), 12.0, up=turned((0.0, 1.0, 0.0))),
        background=BACKGROUND,
        materials={"shining": emission(0.9, 0.7, 0.3)},
        objects=[sheet],
    )


def _lattice_square(corners: int) -> list[tuple[float, float]]:
    """The outline of the square of half width 16 as so many points, a multiple of 4, at equal steps."""
    step = 128 // corners
    outline = []
    for k in range(0, 128, step):
        side, place = divmod(k, 32)
        x, y = ((16.0, place - 16.0), (16.0 - place, 16.0), (-16.0, 16.0 - place), (place - 16.0, -16.0))[side]
        outline.append((x, y))
    return outline


def camera_near_surface(parameter: float, seed: int) -> Scene:
    """A camera at 1 + parameter radii from a sphere's centre looks at that centre; a light is inside.

    From inside and from exactly on the surface, where the start is not met, the lit far side is seen (SPH-3); from
    outside, however near, the dark side at a distance of that many radii (SHAD-4).
    """
    _, dy, dz = untidy(seed)
    return build(
        "On a surface, just inside and just outside: what the ray starts on is not met.",
        perspective((1.0 + parameter, 0.0, 0.0), (0.0, 0.0, 0.0), 83.0),
        background=BACKGROUND,
        lights=[lamp((0.1, 0.3 + dy, 0.2 + dz), 1.0)],
        materials={"matt": diffuse(0.8, 0.6, 0.4)},
        objects=[sphere("matt", (0.0, 0.0, 0.0), 1.0)],
    )
