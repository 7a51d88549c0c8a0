"""Families of lights where no light should be: on a surface, inside an object, far away."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.families.parts import (
    Rotation,
    build,
    diffuse,
    floor,
    lamp,
    orthographic,
    perspective,
    sphere,
    triangle,
    untidy,
)
from raytruth.scenes.values import LARGEST_COORDINATE

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

FACES_OF_TETRAHEDRON = ((0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2))


def light_near_surface(parameter: float, seed: int) -> Scene:
    """A light at the parameter above the top of a unit sphere in front of a wall; below 0 it is inside.

    A surface exactly at the light does not hide it (SHAD-1): at parameter 0 the wall is lit where it rises above the
    sphere, and all its pixels there are exact ties. The sphere is lit in a cap of radius √(2·parameter), at most.
    From below 0 on, all is dark.
    """
    dx, _, dz = untidy(seed)
    return build(
        "A light that touches a surface: no light leaks into the surface, and none is lost above it.",
        perspective((1.3 + dx, 3.1, 6.7 + dz), (0.0, 1.1, 0.0), 43.0),
        lights=[lamp((0.0, 1.0 + parameter, 0.0), 5.0)],
        materials={"matt": diffuse(0.8, 0.6, 0.4), "wall": diffuse(0.4, 0.5, 0.3)},
        objects=[
            sphere("matt", (0.0, 0.0, 0.0), 1.0),
            triangle("wall", (-30.0, -20.0, -2.0), (30.0, -20.0, -2.5), (0.0, 40.0, -2.2)),
        ],
    )


def light_inside_sphere(parameter: float, seed: int) -> Scene:
    """A light inside an opaque sphere, at the parameter times its radius from the centre, seen from outside.

    Everything is black (SHAD-3): no light leaks, however near the surface the light is.
    """
    turned = Rotation(seed)
    return build(
        "A light inside an opaque sphere lights nothing outside.",
        perspective((4.3, 5.1, 6.7), (0.0, -0.3, 0.0), 51.0),
        lights=[lamp(turned((0.0, parameter, 0.0)), 5.0)],
        materials={"matt": diffuse(0.8, 0.6, 0.4), "ground": diffuse(0.4, 0.5, 0.3)},
        objects=[sphere("matt", (0.0, 0.0, 0.0), 1.0), floor("ground", -1.5, 12.7)],
    )


def light_inside_tetrahedron(parameter: float, seed: int) -> Scene:
    """A light in a closed tetrahedron of the parameter as half height, above a matt triangle that fills the image.

    Everything is black (SHAD-3). A diagonal of the image sees points whose shadow rays go exactly through the edge
    that two triangles share (TRI-1), for seed 0: exact ties of two triangles that both hide the light. For all other
    seeds the scene is turned in space, and those rays meet the edge within rounding.
    """
    turned = Rotation(seed)
    signs = ((1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0))
    corners = [turned((x * parameter, y * parameter, z * parameter)) for x, y, z in signs]
    ground = [turned(corner) for corner in ((-40.0, -30.0, -3.0), (40.0, -30.0, -3.0), (0.0, 60.0, -3.0))]
    below = -0.5 * (3.0 + parameter)  # between the tetrahedron and the ground
    return build(
        "A closed surface keeps its light, at the edges and corners of its triangles, too.",
        orthographic(turned((0.0, 0.0, below)), turned((0.0, 0.0, -3.0)), 6.0, up=turned((0.0, 1.0, 0.0))),
        lights=[lamp((0.0, 0.0, 0.0), 50.0)],
        materials={"matt": diffuse(0.8, 0.6, 0.4), "wall": diffuse(0.5, 0.5, 0.5)},
        objects=[
            {"shape": "mesh", "vertices": corners, "faces": FACES_OF_TETRAHEDRON, "material": "wall"},
            triangle("matt", *ground),
        ],
    )


def distant_light(parameter: float, seed: int) -> Scene:
    """A light at the parameter as distance, as bright at the scene as one of intensity 1 at distance 1.

    Shadows are as sharp and the image as bright as with a light at hand (ILL-3, SHAD-1); where the intensity would
    exceed what a scene may state, it is as bright as may be.
    """
    dx, dy, dz = untidy(seed)
    position = ((0.48 + dx) * parameter, (0.6 + dy) * parameter, (0.64 + dz) * parameter)
    return build(
        "A light as far away as a sun, by the law of the near ones.",
        perspective((0.3, 2.1, 6.3), (0.0, 0.2, 0.0), 47.0),
        lights=[lamp(position, min(parameter**2, LARGEST_COORDINATE))],
        materials={"matt": diffuse(0.7, 0.3, 0.2), "ground": diffuse(0.4, 0.5, 0.3)},
        objects=[sphere("matt", (0.0, 0.0, 0.0), 1.0), floor("ground", -1.0, 9.7)],
    )
