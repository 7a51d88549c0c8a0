"""Closed forms of surfaces that lights shine on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mpmath import mp, mpf

from tests.second_opinion import case as make
from tests.second_opinion.paper import (
    Vector,
    by_channel,
    camera_ray,
    combined,
    cross,
    difference,
    dot,
    exact,
    gradient,
    length,
    sphere_normal_seen,
    unit,
)

if TYPE_CHECKING:
    from random import Random

    from tests.second_opinion.case import Case

BLACK = (mpf(0), mpf(0), mpf(0))


def diffuse_sphere(numbers: Random) -> Case:
    """A Lambertian sphere under a point light at distance D from its centre, seen from there at the angle γ from n.

    By the law of cosines d² = D² + r² - 2·D·r·cos γ, and the light stands D·cos γ - r above the tangent plane, so
    L = ρ/π · I · (D·cos γ - r)/d³ (Lambert 1760; Foley, van Dam 1990, eq. 16.2).
    """
    center, radius = make.anywhere(numbers), numbers.uniform(0.7, 1.4)
    light, intensity = make.around(numbers, center, 1.1 * radius, 6), make.color(numbers, 5, 50)
    reflectance, sky = make.color(numbers), make.color(numbers)
    camera = make.perspective(numbers, make.around(numbers, center, 3, 6), center, 37.3)
    scene = make.build(
        camera,
        {"matt": {"diffuse": {"reflectance": reflectance}}},
        [make.sphere(center, radius, "matt")],
        lights=[make.point_light(light, intensity)],
        background={"color": sky},
    )

    def radiance(x: float, y: float) -> Vector:
        normal = sphere_normal_seen(exact(center), mpf(radius), *camera_ray(scene.camera, x, y))
        if normal is None:
            return exact(sky)
        height = dot(normal, difference(exact(light), exact(center))) - radius
        if height <= 0:
            return BLACK
        apart = length(difference(exact(light), exact(center)))
        squared = apart**2 + mpf(radius) ** 2 - 2 * radius * (height + radius)
        factor = height / (mp.pi * mp.sqrt(squared) ** 3)
        return combined((factor, by_channel(exact(reflectance), exact(intensity))))

    return make.case(numbers, scene, radiance)


def phong_sphere(numbers: Random) -> Case:
    """Ambient, diffuse and Phong's highlight: the light is mirrored, not the view: r·v = 2(n·l)(n·v) - l·v.

    Phong 1975, with the attenuation min(1, 1/(a + b·d + c·d²)) of Foley, van Dam 1990, eq. 16.8.
    """
    falloff = {"constant": numbers.uniform(0, 0.4), "linear": numbers.uniform(0, 0.2), "quadratic": 0.03}

    def highlight(normal_light: Any, normal_view: Any, light_view: Any) -> Any:
        return 2 * normal_light * normal_view - light_view

    def attenuation(distance: Any) -> Any:
        divisor = falloff["constant"] + (falloff["linear"] + falloff["quadratic"] * distance) * distance
        return min(mpf(1), 1 / divisor)

    return _shiny_sphere(numbers, "phong", highlight, falloff, attenuation)


def blinn_sphere(numbers: Random) -> Case:
    """As Phong's, with the halfway vector: |l + v|² = 2 + 2·l·v, so n·h = (n·l + n·v)/sqrt(2 + 2·l·v) (Blinn 1977)."""

    def highlight(normal_light: Any, normal_view: Any, light_view: Any) -> Any:
        return (normal_light + normal_view) / mp.sqrt(2 + 2 * light_view)

    return _shiny_sphere(numbers, "blinn", highlight, "none", lambda _: mpf(1))


def _shiny_sphere(numbers: Random, model: str, highlight: Any, falloff: Any, attenuation: Any) -> Case:
    center, radius = make.anywhere(numbers), numbers.uniform(0.7, 1.4)
    light, intensity, ambient_light = make.around(numbers, center, 1.1 * radius, 5), *_colors(numbers, 2)
    ambient, diffuse, specular = _colors(numbers, 3)
    exponent = numbers.uniform(0.5, 60)
    material = {
        "ambient": {"reflectance": ambient},
        "diffuse": {"reflectance": diffuse},
        "specular": {"reflectance": specular, "exponent": exponent, "model": model},
    }
    scene = make.build(
        make.perspective(numbers, make.around(numbers, center, 3, 6), center, 33.7),
        {"shiny": material},
        [make.sphere(center, radius, "shiny")],
        convention="whitted",
        ambient_light=ambient_light,
        lights=[make.point_light(light, intensity, falloff)],
    )

    def radiance(x: float, y: float) -> Vector:
        origin, direction = camera_ray(scene.camera, x, y)
        normal = sphere_normal_seen(exact(center), mpf(radius), origin, direction)
        if normal is None:
            return BLACK
        everywhere = by_channel(exact(ambient), exact(ambient_light))
        to_light = combined((1, exact(light)), (-1, exact(center)), (-mpf(radius), normal))
        toward = unit(to_light)
        cosine = dot(normal, toward)
        if cosine <= 0:
            return everywhere
        shine = max(mpf(0), highlight(cosine, -dot(normal, direction), -dot(toward, direction)))
        reflected = combined((cosine, exact(diffuse)), (shine ** mpf(exponent), exact(specular)))
        return combined((1, everywhere), (attenuation(length(to_light)), by_channel(reflected, exact(intensity))))

    return make.case(numbers, scene, radiance)


def _colors(numbers: Random, count: int) -> list[make.Triple]:
    return [make.color(numbers) for _ in range(count)]


def lit_triangle(numbers: Random) -> Case:
    """A Lambertian triangle under a point light: L = ρ/π · I · h/d³ if light and eye are on one side, h above it.

    The ray passes inside if it passes all three edges on one side: the volumes that it spans with them have one sign
    (Plücker's side test; Shoemake, "Plücker Coordinate Tutorial", Ray Tracing News 11-1, 1998).
    """
    corners = [make.around(numbers, (0.0, 0.0, 0.0), 0.8, 2) for _ in range(3)]
    light, intensity = make.around(numbers, (0.0, 0.0, 0.0), 1, 4), make.color(numbers, 5, 50)
    reflectance, sky = make.color(numbers), make.color(numbers)
    middle = (sum(a for a, _, _ in corners) / 3, sum(b for _, b, _ in corners) / 3, sum(c for _, _, c in corners) / 3)
    scene = make.build(
        make.perspective(numbers, make.around(numbers, (0.0, 0.0, 0.0), 4, 6), middle, 23.1),
        {"matt": {"diffuse": {"reflectance": reflectance}}},
        [{"shape": "triangle", "vertices": corners, "material": "matt"}],
        lights=[make.point_light(light, intensity)],
        background={"color": sky},
    )

    def radiance(x: float, y: float) -> Vector:
        origin, direction = camera_ray(scene.camera, x, y)
        a, b, c = (difference(exact(corner), origin) for corner in corners)
        volumes = [dot(direction, cross(*edge)) for edge in ((a, b), (b, c), (c, a))]
        if min(volumes) < 0 < max(volumes):
            return exact(sky)
        normal = unit(cross(difference(b, a), difference(c, a)))
        eye_above, light_above = -dot(normal, a), dot(normal, difference(difference(exact(light), origin), a))
        distance = -eye_above / dot(normal, direction)
        if distance < 0:
            return exact(sky)
        if eye_above * light_above <= 0:
            return BLACK
        apart = length(combined((1, exact(light)), (-1, origin), (-distance, direction)))
        return combined((abs(light_above) / (mp.pi * apart**3), by_channel(exact(reflectance), exact(intensity))))

    return make.case(numbers, scene, radiance)


def lit_plane(numbers: Random) -> Case:
    """A Lambertian plane in any position under a point light: L = ρ/π · I · h/d³ if light and eye are on one side.

    Of two points at heights h₀ and h₁ the line through them meets the plane at (h₁·P₀ - h₀·P₁)/(h₁ - h₀), which is
    ahead of the eye P₀ if P₁, a step ahead of it, is lower; heights are those above the plane, by its unit normal.
    """
    point, across = make.anywhere(numbers), make.around(numbers, (0.0, 0.0, 0.0), 0.1, 30)
    light, intensity = make.around(numbers, point, 0.5, 4), make.color(numbers, 5, 50)
    reflectance, sky = make.color(numbers), make.sky(numbers)
    eye = make.around(numbers, point, 1, 5)
    scene = make.build(
        make.perspective(numbers, eye, make.around(numbers, point, 0, 2), 61.3),
        {"matt": {"diffuse": {"reflectance": reflectance}}},
        [{"shape": "plane", "point": point, "normal": across, "material": "matt"}],
        lights=[make.point_light(light, intensity)],
        background=sky,
    )

    def height(of: Vector) -> Any:
        return dot(unit(exact(across)), difference(of, exact(point)))

    def radiance(x: float, y: float) -> Vector:
        origin, direction = camera_ray(scene.camera, x, y)
        next_point = combined((1, origin), (1, direction))
        here, ahead = height(origin), height(next_point)
        if abs(here) <= abs(ahead) and here * ahead > 0:
            return gradient(sky["bottom"], sky["top"], direction[1])
        above = height(exact(light))
        if above * here <= 0:
            return BLACK
        met = combined((ahead / (ahead - here), origin), (-here / (ahead - here), next_point))
        apart = length(difference(exact(light), met))
        return combined((abs(above) / (mp.pi * apart**3), by_channel(exact(reflectance), exact(intensity))))

    return make.case(numbers, scene, radiance)


def sphere_in_parallel_projection(numbers: Random) -> Case:
    """Seen along f, the normal at the offset (u, v) from the middle is (u·right + v·up - sqrt(r² - u² - v²)·f)/r.

    Under a directional light of irradiance E along s: L = ρ/π · E · max(0, -n·s).
    """
    center, radius = make.anywhere(numbers), numbers.uniform(0.7, 1.4)
    direction, irradiance, reflectance = make.anywhere(numbers), *_colors(numbers, 2)
    scene = make.build(
        make.orthographic(numbers, make.around(numbers, center, 2, 6), center, numbers.uniform(1.5, 3)),
        {"matt": {"diffuse": {"reflectance": reflectance}}},
        [make.sphere(center, radius, "matt")],
        lights=[make.sun(direction, irradiance)],
    )

    def radiance(x: float, y: float) -> Vector:
        origin, forward = camera_ray(scene.camera, x, y)
        offset = difference(origin, exact(scene.camera.position))
        depth_squared = mpf(radius) ** 2 - dot(offset, offset)
        if depth_squared < 0:
            return BLACK
        normal = combined((1 / mpf(radius), offset), (-mp.sqrt(depth_squared) / radius, forward))
        cosine = max(mpf(0), -dot(normal, unit(exact(direction))))
        return combined((cosine / mp.pi, by_channel(exact(reflectance), exact(irradiance))))

    return make.case(numbers, scene, radiance)


def checkerboard_floor(numbers: Random) -> Case:
    """A Lambertian board z = h under a directional light; its colour changes with the sign of sin(πu)·sin(πv).

    Both sines change sign exactly at whole numbers, so their product is positive on even squares.
    """
    height, size = numbers.uniform(-1, 1), numbers.uniform(0.2, 1)
    offset = (numbers.uniform(-5, 5), numbers.uniform(-5, 5))
    even, odd, irradiance = _colors(numbers, 3)
    direction, sky = make.anywhere(numbers), make.sky(numbers)
    board = {"even": even, "odd": odd, "size": size, "plane": "xy", "offset": offset}
    position = (*make.anywhere(numbers)[:2], height + numbers.choice((-1, 1)) * numbers.uniform(1, 4))
    scene = make.build(
        make.perspective(numbers, position, (numbers.uniform(2, 4), numbers.uniform(-4, -2), height), 50.3),
        {"board": {"diffuse": {"reflectance": {"checkerboard": board}}}},
        [make.plane(height, "board")],
        lights=[make.sun(direction, irradiance)],
        background=sky,
    )

    def radiance(x: float, y: float) -> Vector:
        origin, ray = camera_ray(scene.camera, x, y)
        distance = (height - origin[2]) / ray[2]
        point = combined((1, origin), (distance, ray))
        if distance < 0 or max(abs(point[0]), abs(point[1])) > 100:
            return gradient(sky["bottom"], sky["top"], ray[1])
        if ray[2] * direction[2] < 0:  # the light shines on the other side
            return BLACK
        waves = [mp.sinpi((point[axis] - offset[axis]) / size) for axis in range(2)]
        cosine = abs(unit(exact(direction))[2])
        color = even if waves[0] * waves[1] > 0 else odd
        return combined((cosine / mp.pi, by_channel(exact(color), exact(irradiance))))

    return make.case(numbers, scene, radiance)
