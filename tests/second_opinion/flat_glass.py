"""Closed forms of dielectrics with flat faces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mpmath import mp, mpf

from tests.second_opinion import case as make
from tests.second_opinion.paper import (
    Vector,
    by_channel,
    camera_ray,
    combined,
    exact,
    faded,
    fresnel,
    gradient,
)

if TYPE_CHECKING:
    from random import Random

    from tests.second_opinion.case import Case

WHITE = (mpf(1), mpf(1), mpf(1))


def glass_slab(numbers: Random) -> Case:
    """R at the first face, then Σ (1 - R)²·Rʲ·exp(-σ·(j + 1)·a/cos t), the terms with j + 2 <= max_depth.

    The two-sided series of a plate without interference (Born, Wolf, section 7.6.1, with intensities). The factors
    1/η² and η² of entering and leaving cancel.
    """

    def weights(incident: Any, refracted: Any) -> tuple[Vector, Vector]:
        reflected = fresnel(incident, refracted)
        return combined((reflected, WHITE)), combined((1 - reflected, WHITE))

    return _slab(numbers, {"absorption": make.color(numbers)}, "radiometric", weights)


def half_space_of_water(numbers: Random) -> Case:
    """R·(sky above) + (1 - R)·exp(-σ·a/cos t)·(glow of the ground): the surface z = 0, and a ground z = -a below it.

    The plane's normal points up and has any length, so that the water is below (Whitted's convention, without 1/η²).
    """
    index, depth, absorption = numbers.uniform(1.1, 2.6), numbers.uniform(0.2, 2), make.color(numbers)
    glow, sky = make.color(numbers), make.sky(numbers)
    position = (*make.anywhere(numbers)[:2], numbers.uniform(1, 3))
    look_at = (*(position[axis] + numbers.uniform(-0.7, 0.7) * position[2] for axis in range(2)), 0.0)
    surface = {"shape": "plane", "point": (*make.anywhere(numbers)[:2], 0.0), "material": "water"}
    ground = {"shape": "plane", "point": (*make.anywhere(numbers)[:2], -depth), "material": "ground"}
    scene = make.build(
        make.perspective(numbers, position, look_at, 40.9),
        {
            "water": {"dielectric": {"index_of_refraction": index, "absorption": absorption}},
            "ground": {"emission": {"radiance": glow}},
        },
        [
            surface | {"normal": (0.0, 0.0, numbers.uniform(0.01, 9))},
            ground | {"normal": (0.0, 0.0, numbers.choice((-1, 1)) * numbers.uniform(0.01, 9))},
        ],
        convention="whitted",
        background=sky,
        max_depth=1,
    )

    def radiance(x: float, y: float) -> Vector:
        _, direction = camera_ray(scene.camera, x, y)
        incident = mp.acos(-direction[2])
        refracted = mp.asin(mp.sin(incident) / index)
        reflected = fresnel(incident, refracted)
        below = by_channel(faded(absorption, depth / mp.cos(refracted)), exact(glow))
        return combined((reflected, gradient(sky["bottom"], sky["top"], direction[1])), (1 - reflected, below))

    return make.case(numbers, scene, radiance)


def slab_of_constant_weights(numbers: Random) -> Case:
    """The same plate in Whitted's convention: ks in place of R and kt in place of 1 - R (Whitted 1980, eq. 2)."""
    reflectance, transmittance = make.color(numbers), make.color(numbers)
    stated = {"absorption": make.color(numbers), "reflectance": reflectance, "transmittance": transmittance}
    return _slab(numbers, stated, "whitted", lambda *_: (exact(reflectance), exact(transmittance)))


def _slab(numbers: Random, dielectric: dict[str, Any], convention: str, weights: Any) -> Case:
    """Faces z = 0 and z = -a, a glowing board z = -b below and a gradient above.

    On each way through the plate the ray goes a·tan t to the side, and a/cos t along (Snell: sin t = sin i/n).
    """
    index, thickness, depth = numbers.uniform(1.1, 2.6), numbers.uniform(0.2, 1), numbers.randint(0, 8)
    wall, sky = -thickness - numbers.uniform(0.1, 1), make.sky(numbers)
    board = {"even": make.color(numbers), "odd": make.color(numbers), "size": numbers.uniform(0.2, 1), "plane": "xy"}
    position = (numbers.uniform(-2, 2), numbers.uniform(-2, 2), numbers.uniform(1, 3))
    # At most 45° from the vertical, and 33° more in the image's corners, so that no ray gets to the faces' ends.
    look_at = (*(position[axis] + numbers.uniform(-0.7, 0.7) * position[2] for axis in range(2)), 0.0)
    scene = make.build(
        make.perspective(numbers, position, look_at, 40.9),
        {
            "glass": {"dielectric": dielectric | {"index_of_refraction": index}},
            "board": {"emission": {"radiance": {"checkerboard": board}}},
        },
        [make.plane(0.0, "glass"), make.plane(-thickness, "glass", facing_up=False), make.plane(wall, "board")],
        convention=convention,
        background=sky,
        max_depth=depth,
    )

    def radiance(x: float, y: float) -> Vector:
        origin, direction = camera_ray(scene.camera, x, y)
        above = gradient(sky["bottom"], sky["top"], direction[1])
        incident = mp.acos(-direction[2])
        refracted = mp.asin(mp.sin(incident) / index)
        reflected, transmitted = weights(incident, refracted)
        inside = faded(dielectric["absorption"], thickness / mp.cos(refracted))
        terms = [(1, by_channel(reflected, above))] if depth > 0 else []
        weight = by_channel(transmitted, transmitted, inside)
        for passes in range(1, depth):
            aside = (origin[2] - thickness - wall) * mp.tan(incident) + passes * thickness * mp.tan(refracted)
            terms.append((1, by_channel(weight, below(origin, direction, aside) if passes % 2 else above)))
            weight = by_channel(weight, reflected, inside)
        return combined((0, WHITE), *terms)

    def below(origin: Vector, direction: Vector, aside: Any) -> Vector:
        level = mp.hypot(direction[0], direction[1])
        waves = [mp.sinpi((origin[axis] + aside * direction[axis] / level) / board["size"]) for axis in range(2)]
        return exact(board["even"] if waves[0] * waves[1] > 0 else board["odd"])

    return make.case(numbers, scene, radiance)


def window_of_snell(numbers: Random) -> Case:
    """Under water the whole sky is seen within asin(1/n), n² times as bright but for the surface's reflectance.

    Beyond, all is reflected (Snell's window; Nicodemus 1963, "Radiance": a lossless interface keeps L/n²). Along the
    surface direction vectors times the index do not change, so the sky is seen at n times the ray's y.
    """
    return _window(numbers, {}, "radiometric")


def window_of_constant_weights(numbers: Random) -> Case:
    """The same in Whitted's convention: ks and kt as stated, no n²; beyond the critical angle ks alone (REFR-6)."""
    return _window(numbers, {"reflectance": make.color(numbers), "transmittance": make.color(numbers)}, "whitted")


def _window(numbers: Random, constants: dict[str, make.Triple], convention: str) -> Case:
    index, absorption = numbers.uniform(1.1, 1.8), make.color(numbers)
    below, sky = numbers.uniform(-3, -0.3), make.sky(numbers)
    camera = (numbers.uniform(-2, 2), numbers.uniform(-2, 2), below)
    scene = make.build(
        make.perspective(numbers, camera, (numbers.uniform(-4, 4), numbers.uniform(-4, 4), 0.0), 75.3, inside="water"),
        {"water": {"dielectric": constants | {"index_of_refraction": index, "absorption": absorption}}},
        [make.plane(0.0, "water")],
        convention=convention,
        background=sky,
        max_depth=numbers.randint(1, 3),
    )

    def is_in_window(x: float, y: float) -> bool:
        _, direction = camera_ray(scene.camera, x, y)
        return bool(direction[2] > 0 and index * mp.hypot(direction[0], direction[1]) <= 1)

    def radiance(x: float, y: float) -> Vector:
        _, direction = camera_ray(scene.camera, x, y)
        mirrored = gradient(sky["bottom"], sky["top"], direction[1])
        if direction[2] <= 0:
            return mirrored
        reach = -below / direction[2]
        if any(abs(camera[axis] + reach * direction[axis]) > 100 for axis in (0, 1)):  # past the surface's edge
            return mirrored
        reflected, transmitted = WHITE, None
        if is_in_window(x, y):
            sine = index * mp.hypot(direction[0], direction[1])
            part = fresnel(mp.asin(sine / index), mp.asin(sine))
            reflected, transmitted = combined((part, WHITE)), combined(((1 - part) * mpf(index) ** 2, WHITE))
        if constants:
            reflected, transmitted = exact(constants["reflectance"]), transmitted and exact(constants["transmittance"])
        seen = by_channel(reflected, mirrored)
        if transmitted:
            outside = gradient(sky["bottom"], sky["top"], index * direction[1])
            seen = combined((1, seen), (1, by_channel(transmitted, outside)))
        return by_channel(faded(absorption, reach), seen)

    return make.case(numbers, scene, radiance, is_in_window)


def prism_at_the_critical_angle(numbers: Random) -> Case:
    """A wedge between z = 0 and a face of slope α; the camera looks so that the second face is met near asin(1/n).

    All rays stay in the plane x = 0, where angles add up: i from the vertical outside, sin t = sin i/n inside, t - α at
    the second face, and beyond it asin(n·sin(t - α)) + α from the vertical (Newton, Opticks, 1704, book I).
    Both faces glow, so that the totally reflected ray brings the first one's glow at the depth of 2.
    """
    index, side = numbers.uniform(1.3, 1.8), numbers.choice((-1, 1))
    slope = side * numbers.uniform(0.2, 0.42)
    with mp.workdps(20):  # only where the camera stands depends on these angles
        aimed = mp.asin(index * mp.sin(slope - side * mp.asin(1 / mpf(index))))
        # Beside the origin, where the diagonals of both faces cross the plane.
        position = (0.0, float(0.3 - 2 * mp.sin(aimed)), float(2 * mp.cos(aimed)))
        ends = [(end, float(-4.5 + end * mp.tan(slope))) for end in (-6.0, 6.0)]
    first_glow, second_glow, sky = make.color(numbers), make.color(numbers), make.sky(numbers)
    (y0, z0), (y1, z1) = ends
    corners = ((-9.0, y0, z0), (9.0, y0, z0), (9.0, y1, z1), (-9.0, y1, z1))
    lower = {"shape": "mesh", "vertices": corners, "faces": ((2, 1, 0), (3, 2, 0)), "material": "second"}
    glass = {"index_of_refraction": index}
    scene = make.build(
        make.perspective(numbers, position, (0.0, 0.3, 0.0), 10.0, up=(1.0, 0.0, 0.0)),
        {
            "first": {"dielectric": glass, "emission": {"radiance": first_glow}},
            "second": {"dielectric": glass, "emission": {"radiance": second_glow}},
        },
        [make.plane(0.0, "first"), lower],
        background=sky,
        max_depth=2,
    )

    def angles(x: float, y: float) -> tuple[Any, Any, Any]:
        """From the vertical outside, from it inside, and the slope."""
        assert y == make.HEIGHT / 2, "the plane x = 0 is seen in the middle line only"
        right_of_middle = mp.tan(mp.radians(5)) * (2 * mpf(x) - make.WIDTH) / make.HEIGHT
        incident = mp.atan2(mpf(0.3) - position[1], position[2]) - mp.atan(right_of_middle)
        return incident, mp.asin(mp.sin(incident) / index), mp.atan2(mpf(z1) - z0, mpf(y1) - y0)

    def is_totally_reflected(x: float, y: float) -> bool:
        _, refracted, tilt = angles(x, y)
        return bool(index * abs(mp.sin(refracted - tilt)) > 1)

    def radiance(x: float, y: float) -> Vector:
        incident, refracted, tilt = angles(x, y)
        part = fresnel(incident, refracted)
        terms = [(1, exact(first_glow)), (part, gradient(sky["bottom"], sky["top"], mp.sin(incident)))]
        through = (1 - part) / mpf(index) ** 2
        terms.append((through, exact(second_glow)))
        if is_totally_reflected(x, y):
            terms.append((through, exact(first_glow)))
        else:
            beyond = mp.asin(index * mp.sin(refracted - tilt))
            part = fresnel(refracted - tilt, beyond)
            out = gradient(sky["bottom"], sky["top"], mp.sin(beyond + tilt))
            terms += [(through * part, exact(first_glow)), (through * (1 - part) * mpf(index) ** 2, out)]
        return combined(*terms)

    return make.Case(scene, radiance, numbers.uniform(0, make.WIDTH), make.HEIGHT / 2, is_totally_reflected)
