"""Families of extreme mirrors and dielectrics."""

from __future__ import annotations

from math import nextafter
from typing import TYPE_CHECKING

from raytruth.scenes.families.parts import (
    Rotation,
    build,
    emission,
    orthographic,
    perspective,
    sphere,
    triangle,
    untidy,
)

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

SKY = {"bottom": (0.13, 0.11, 0.07), "top": (0.41, 0.57, 0.73)}


def index_ratio(parameter: float, seed: int) -> Scene:
    """A sphere whose index of refraction is the parameter, under a sky.

    Next to 1 it is all but invisible: R is about ((η - 1)/2)² and must not drown in the rounding of g - c (REFR-4). At
    1e3 almost everything is reflected, and a ray inside is reflected totally from a milliradian on; at 1e-3 the same
    happens outside (REFR-2).
    """
    dx, dy, _ = untidy(seed)
    return build(
        "Glass like air, glass like nothing: Snell and Fresnel at the ends of their range.",
        perspective((0.2 + dx, 0.7 + dy, 3.9), (0.0, 0.0, 0.0), 37.0),
        max_depth=4,
        background=SKY,
        materials={"glass": {"dielectric": {"index_of_refraction": parameter}}},
        objects=[sphere("glass", (0.0, 0.0, 0.0), 1.0)],
    )


def critical_angle(parameter: float, seed: int) -> Scene:
    """Parallel rays in glass of index 1.25 meet its surface at the critical angle; the index is off by so many ulp.

    The sine is 4/5 and the cosine 3/5, so that g² = (4/5)² - 1 + (3/5)² is 0: at parameter 0 every pixel is an exact
    tie. There the refracted ray exists, with weight 0, and R = 1 (REFR-2): the image is that of total reflection. One
    ulp below, a weight of about 1e-7 goes through; above, nothing does.
    """
    index = 1.25
    for _ in range(abs(int(parameter))):
        index = nextafter(index, 2.0 if parameter > 0 else 1.0)
    size = 50.0 + seed  # another size, other rounding; the angles stay
    return build(
        "At exactly the critical angle all is reflected, and nothing jumps beside it.",
        # In the medium below the plane y = 0 looking up along (4, 3, 0): towards its lower side, so from inside.
        orthographic((-4.0, -3.0, 0.0), (0.0, 0.0, 0.0), 3.0, inside="glass"),
        max_depth=1,
        background={"bottom": (0.9, 0.1, 0.1), "top": (0.1, 0.2, 0.9)},
        materials={"glass": {"dielectric": {"index_of_refraction": index}}},
        objects=[triangle("glass", (-size, 0.0, size), (size, 0.0, size), (0.0, 0.0, -size))],
    )


def camera_inside_glass(parameter: float, seed: int) -> Scene:
    """A camera inside an absorbing glass sphere, at the parameter times its radius from the centre, looks outward.

    The camera's ray is absorbed from its start on (CAM-5, REFR-7), and radiance is larger inside by the square of the
    index (REFR-5); near the surface the rays along it are reflected totally, again and again.
    """
    turned = Rotation(seed)
    glass = {"index_of_refraction": 1.5, "absorption": (0.3, 0.2, 0.1)}
    return build(
        "From inside glass: absorbed from the camera on, brighter by the square of the index.",
        perspective(turned((parameter, 0.0, 0.0)), turned((parameter + 1.0, 0.3, 0.5)), 71.0, inside="glass"),
        max_depth=5,
        background=SKY,
        materials={"glass": {"dielectric": glass}},
        objects=[sphere("glass", (0.0, 0.0, 0.0), 1.0)],
    )


def mirror_corridor(parameter: float, seed: int) -> Scene:
    """Between two facing mirrors that shine a little, with the parameter as depth.

    The image is a series of as many terms as bounces are allowed and one more; where they are used up the mirrors
    still shine (TREE-2), and no term is left out for being small (TREE-3).
    """
    dx, dy, dz = untidy(seed)
    near = [(-9.0, -7.0, 2.0), (9.0, -7.0, 2.0 + 0.1 * dx), (0.0, 11.0, 2.0 + 0.1 * dy)]
    far = [(-9.0, -7.0, -2.0), (9.0, -7.0, -2.0 + 0.1 * dz), (0.0, 11.0, -2.0)]
    mirror = {"mirror": {"reflectance": (0.98, 0.96, 0.94)}}
    return build(
        "A corridor of mirrors has as many images as bounces are allowed.",
        perspective((0.1, 0.2, 1.9), (0.13, 0.17, -2.0), 41.0),
        max_depth=int(parameter),
        background=SKY,
        materials={"near": mirror | emission(0.01, 0.03, 0.02), "far": mirror | emission(0.04, 0.01, 0.02)},
        objects=[triangle("near", *near), triangle("far", *far)],
    )


def nested_dielectrics(parameter: float, seed: int) -> Scene:
    """As many spheres of glass inside each other as the parameter says, each within the one before.

    The surface says which media meet at it (REFR-1), so that nothing has to be remembered on the way; a ray crosses
    2 surfaces a sphere, and its tree is followed through all of them and two bounces more.
    """
    dx, dy, dz = untidy(seed, 0.03)
    indices = (1.5, 1.2, 1.7)
    names = [f"glass {k}" for k in range(int(parameter))]
    media = {
        name: {"dielectric": {"index_of_refraction": indices[k], "outside": names[k - 1] if k else None}}
        for k, name in enumerate(names)
    }
    return build(
        "Glass in glass in glass: at each surface the two media that meet there.",
        perspective((0.2, 0.7, 3.9), (0.0, 0.0, 0.0), 37.0),
        max_depth=2 * len(names) + 2,
        background=SKY,
        materials=media,
        objects=[
            sphere(name, ((k + 1) * dx, (k + 1) * dy, (k + 1) * dz), 1.0 - 0.2 * k) for k, name in enumerate(names)
        ],
    )
