"""Closed forms of mirrors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mpmath import mp, mpf

from tests.second_opinion import case as make
from tests.second_opinion.paper import (
    Vector,
    by_channel,
    camera_ray,
    closest_to,
    combined,
    exact,
    gradient,
    length,
    unit,
)

if TYPE_CHECKING:
    from random import Random

    from tests.second_opinion.case import Case

CORRIDOR_DEPTH = 50


def mirror_sphere(numbers: Random) -> Case:
    """A mirror sphere under a gradient, by turning the ray in its plane of incidence.

    A ray that passes the centre at distance s meets the sphere at the angle asin(s/r) = i and is turned by π - 2i away
    from the centre (Euclid, Catoptrics; Glassner, "An Introduction to Ray Tracing", 1989, section 4.2).
    """
    center, radius = make.anywhere(numbers), numbers.uniform(0.7, 1.4)
    reflectance, sky = make.color(numbers), make.sky(numbers)
    scene = make.build(
        make.perspective(numbers, make.around(numbers, center, 2, 6), center, 35.7),
        {"silver": {"mirror": {"reflectance": reflectance}}},
        [make.sphere(center, radius, "silver")],
        background=sky,
        max_depth=numbers.randint(0, 3),
    )

    def radiance(x: float, y: float) -> Vector:
        origin, direction = camera_ray(scene.camera, x, y)
        _, aside = closest_to(exact(center), origin, direction)
        if length(aside) > radius:
            return gradient(sky["bottom"], sky["top"], direction[1])
        if scene.max_depth == 0:
            return (mpf(0), mpf(0), mpf(0))
        turned = mp.pi - 2 * mp.asin(length(aside) / radius)
        height = mp.cos(turned) * direction[1] + mp.sin(turned) * unit(aside)[1]
        return by_channel(exact(reflectance), gradient(sky["bottom"], sky["top"], height))

    return make.case(numbers, scene, radiance)


def mirror_corridor(numbers: Random) -> Case:
    """Between mirrors z = 0 and z = w every ray is straight if the corridor is unfolded into its images.

    The k-th image of a mirror stands at k·w; a point Z of the unfolded space is at |Z| folded with period 2w, which is
    acos(cos(πZ/w))·w/π. Each mirror glows, so the ray brings Σ (product of reflectances)·glow over at most 51 mirrors
    (50 reflections), unless it meets the glowing floor y = -h first (method of images; Allen, Berkley 1979).
    """
    width, floor = numbers.uniform(0.8, 1.2), numbers.uniform(-6, -1)
    low, high, low_glow, high_glow = (make.color(numbers, 0.5, 1) for _ in range(4))
    board = {"even": make.color(numbers), "odd": make.color(numbers), "size": numbers.uniform(0.1, 0.7)}
    start = (numbers.uniform(-1, 1), numbers.uniform(-0.5, 0.5), numbers.uniform(0.1, 0.7))
    ahead = (
        start[0] + numbers.uniform(-0.3, 0.3),
        start[1],
        start[2] + numbers.choice((-1, 1)) * numbers.uniform(0.5, 1),
    )
    scene = make.build(
        make.perspective(numbers, start, ahead, 25.3, up=(numbers.uniform(-0.1, 0.1), 1.0, 0.0)),
        {
            "low": {"mirror": {"reflectance": low}, "emission": {"radiance": low_glow}},
            "high": {"mirror": {"reflectance": high}, "emission": {"radiance": high_glow}},
            "floor": {"emission": {"radiance": {"checkerboard": board}}},
        },
        [make.plane(0.0, "low"), make.plane(width, "high"), _strip(floor, width)],
        max_depth=CORRIDOR_DEPTH,
    )

    def radiance(x: float, y: float) -> Vector:
        (ox, oy, oz), (dx, dy, dz) = camera_ray(scene.camera, x, y)
        to_floor = (floor - oy) / dy if dy < 0 else mp.inf
        total, weight = (mpf(0), mpf(0), mpf(0)), (mpf(1), mpf(1), mpf(1))
        for image in range(CORRIDOR_DEPTH + 1):
            mirror = mpf(width) * (image + 1 if dz > 0 else -image)
            if to_floor < (mirror - oz) / dz:
                folded = mp.acos(mp.cospi((oz + to_floor * dz) / width)) * width / mp.pi
                waves = mp.sinpi((ox + to_floor * dx) / board["size"]) * mp.sinpi(folded / board["size"])
                end = board["even"] if waves > 0 else board["odd"]
                return combined((1, total), (1, by_channel(weight, exact(end))))
            is_high = (image % 2 == 0) == (dz > 0)
            total = combined((1, total), (1, by_channel(weight, exact(high_glow if is_high else low_glow))))
            weight = by_channel(weight, exact(high if is_high else low))
        return total

    return make.case(numbers, scene, radiance)


def _strip(height: float, width: float) -> dict[str, object]:
    """The corridor's floor, which goes on behind the mirrors."""
    corners = ((-99.0, height, -1.0), (99.0, height, -1.0), (99.0, height, width + 1), (-99.0, height, width + 1))
    return {"shape": "mesh", "vertices": corners, "faces": ((0, 1, 2), (0, 2, 3)), "material": "floor"}
