"""Closed forms of dielectric spheres.

A ray that passes the centre at distance s stays in one plane, so that all there is to follow is by how much it has
turned towards the centre (Descartes, "Les Météores", 1637: the rainbow; Newton, Opticks, 1704, book I, part II).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mpmath import mp, mpf

from tests.second_opinion import case as make
from tests.second_opinion.paper import (
    Vector,
    by_channel,
    camera_ray,
    closest_to,
    combined,
    exact,
    faded,
    fresnel,
    gradient,
    length,
    unit,
)

if TYPE_CHECKING:
    from random import Random

    from tests.second_opinion.case import Case

BLACK = (mpf(0), mpf(0), mpf(0))
WHITE = (mpf(1), mpf(1), mpf(1))


class Turned:
    """What the background sends against a ray that passes a sphere's centre and is turned in its plane."""

    def __init__(self, camera: Any, center: make.Triple, sky: dict[str, make.Triple], x: float, y: float) -> None:
        origin, self.direction = camera_ray(camera, x, y)
        self.foot, aside = closest_to(exact(center), origin, self.direction)
        self.passing = length(aside)
        self.outward = unit(aside)
        self.sky = sky

    def background(self, angle: Any) -> Vector:
        """After a turn by this angle towards the centre, and past it for more than a right angle."""
        height = mp.cos(angle) * self.direction[1] - mp.sin(angle) * self.outward[1]
        return gradient(self.sky["bottom"], self.sky["top"], height)


def glass_sphere(numbers: Random) -> Case:
    """Entering turns the ray by i - t, so does leaving; each of j reflections inside turns it by π - 2t.

    With sin i = s/r and sin t = sin i/n, chords of length 2·r·cos t, and weights (1 - R)²·Rʲ while j + 2 <= max_depth.
    """
    center, radius, index = make.anywhere(numbers), numbers.uniform(0.7, 1.4), numbers.uniform(0.7, 2.4)
    absorption, sky, depth = make.color(numbers, 0, 0.7), make.sky(numbers), numbers.randint(0, 7)
    scene = make.build(
        make.perspective(numbers, make.around(numbers, center, 2, 6), center, 30.7),
        {"glass": {"dielectric": {"index_of_refraction": index, "absorption": absorption}}},
        [make.sphere(center, radius, "glass")],
        background=sky,
        max_depth=depth,
    )

    def radiance(x: float, y: float) -> Vector:
        ray = Turned(scene.camera, center, sky, x, y)
        if ray.passing > radius:
            return ray.background(0)
        if depth == 0:
            return BLACK
        incident = mp.asin(ray.passing / radius)
        outside = ray.background(2 * incident - mp.pi)
        if ray.passing > radius * mpf(index):
            return outside
        refracted = mp.asin(ray.passing / (radius * mpf(index)))
        reflected = fresnel(incident, refracted)
        chord = faded(absorption, 2 * radius * mp.cos(refracted))
        total, weight = combined((reflected, outside)), combined(((1 - reflected) ** 2, chord))
        for inside in range(depth - 1):
            turn = 2 * (incident - refracted) + inside * (mp.pi - 2 * refracted)
            total = combined((1, total), (1, by_channel(weight, ray.background(turn))))
            weight = combined((reflected, by_channel(weight, chord)))
        return total

    return make.case(numbers, scene, radiance)


def glass_sphere_on_its_axis(numbers: Random) -> Case:
    """Through the centre R is ((n - 1)/(n + 1))² everywhere, and each reflection turns the ray round (Fresnel 1823)."""
    center, radius, index = make.anywhere(numbers), numbers.uniform(0.7, 1.4), numbers.uniform(0.7, 2.4)
    absorption, sky, depth = make.color(numbers, 0, 0.7), make.sky(numbers), numbers.randint(1, 7)
    scene = make.build(
        make.orthographic(numbers, make.around(numbers, center, 2, 6), center, 3.0),
        {"glass": {"dielectric": {"index_of_refraction": index, "absorption": absorption}}},
        [make.sphere(center, radius, "glass")],
        background=sky,
        max_depth=depth,
    )

    def radiance(x: float, y: float) -> Vector:
        forward = camera_ray(scene.camera, x, y)[1][1]
        ahead, behind = (gradient(sky["bottom"], sky["top"], height) for height in (forward, -forward))
        reflected = ((mpf(index) - 1) / (mpf(index) + 1)) ** 2
        total = combined((reflected, behind))
        for passes in range(1, depth):
            weight = (1 - reflected) ** 2 * reflected ** (passes - 1)
            through = faded(absorption, 2 * mpf(radius) * passes)
            total = combined((1, total), (weight, by_channel(through, ahead if passes % 2 else behind)))
        return total

    return make.Case(scene, radiance, make.WIDTH / 2, make.HEIGHT / 2)


def absorption_along_a_chord(numbers: Random) -> Case:
    """A sphere of smoke, of index 1, turns no ray: exp(-σ·chord) is left, half the chord more or less from inside.

    The chord at distance s from the centre is 2·sqrt(r² - s²); Bouguer's law.
    """
    center, radius = make.anywhere(numbers), numbers.uniform(0.7, 1.4)
    absorption, sky = make.color(numbers, 0, 3), make.sky(numbers)
    is_inside = numbers.random() < 0.5
    position = make.around(numbers, center, 0.1, 0.6) if is_inside else make.around(numbers, center, 2, 6)
    scene = make.build(
        make.perspective(numbers, position, center, 50.3, inside="smoke" if is_inside else None),
        {"smoke": {"dielectric": {"index_of_refraction": 1.0, "absorption": absorption}}},
        [make.sphere(center, radius, "smoke")],
        background=sky,
        max_depth=numbers.randint(2, 4),
    )

    def radiance(x: float, y: float) -> Vector:
        ray = Turned(scene.camera, center, sky, x, y)
        if ray.passing > radius:
            return ray.background(0)
        half_chord = mp.sqrt(mpf(radius) ** 2 - ray.passing**2)
        smoke = half_chord + (ray.foot if is_inside else half_chord)
        return by_channel(faded(absorption, smoke), ray.background(0))

    return make.case(numbers, scene, radiance)


def bubble_in_glass(numbers: Random) -> Case:
    """Concentric spheres: n·r·sin(angle to the radius) = s all along the ray (Bouguer's theorem of spherical layers).

    Born, Wolf, section 3.2.1, eq. (7). So each sphere is always met at the same angle, and all paths of the ray tree
    follow from whether the next surface is the outer or the inner one.
    """
    center, outer, index = make.anywhere(numbers), numbers.uniform(0.9, 1.4), numbers.uniform(1.2, 2)
    inner, inner_index = outer * numbers.uniform(0.3, 0.9), numbers.uniform(1, 1.9)
    absorption, inner_absorption = make.color(numbers, 0, 0.7), make.color(numbers, 0, 0.7)
    sky = make.sky(numbers)
    bubble = {"index_of_refraction": inner_index, "absorption": inner_absorption, "outside": "glass"}
    scene = make.build(
        make.perspective(numbers, make.around(numbers, center, 2, 6), center, 27.1),
        {
            "glass": {"dielectric": {"index_of_refraction": index, "absorption": absorption}},
            "bubble": {"dielectric": bubble},
        },
        [make.sphere(center, outer, "glass"), make.sphere(center, inner, "bubble")],
        background=sky,
        max_depth=numbers.randint(1, 6),
    )

    def radiance(x: float, y: float) -> Vector:
        ray = Turned(scene.camera, center, sky, x, y)
        if ray.passing > outer:
            return ray.background(0)
        return _Layers(ray, outer, inner, mpf(index), mpf(inner_index), absorption, inner_absorption).seen(
            scene.max_depth
        )

    return make.case(numbers, scene, radiance)


class _Layers:
    """The ray tree in a plane; the square of the index is left out, since every path starts and ends in empty space."""

    def __init__(
        self,
        ray: Turned,
        outer: float,
        inner: float,
        index: Any,
        inner_index: Any,
        absorption: Any,
        inner_absorption: Any,
    ) -> None:
        self.ray = ray
        self.at_outer = (mp.asin(ray.passing / outer), mp.asin(ray.passing / (outer * index)))
        self.meets_inner = ray.passing < inner * index
        across = outer * mp.cos(self.at_outer[1])
        self.chord = faded(absorption, 2 * across)
        if not self.meets_inner:
            return
        sines = [ray.passing / (inner * n) for n in (index, inner_index)]
        self.at_inner = (mp.asin(sines[0]), mp.asin(sines[1]) if sines[1] < 1 else None)
        self.between = faded(absorption, across - inner * mp.cos(self.at_inner[0]))
        if self.at_inner[1] is not None:
            self.inner_chord = faded(inner_absorption, 2 * inner * mp.cos(self.at_inner[1]))

    def seen(self, depth: int) -> Vector:
        """At the outer sphere, from outside."""
        outside, inside = self.at_outer
        reflected = fresnel(outside, inside)
        mirrored = self.ray.background(2 * outside - mp.pi)
        return combined((reflected, mirrored), (1 - reflected, self.inward(outside - inside, depth - 1)))

    def inward(self, turn: Any, depth: int) -> Vector:
        """From the outer sphere into the glass."""
        if not self.meets_inner:
            return by_channel(self.chord, self.outward(turn, depth))
        if depth == 0:
            return BLACK
        outside, inside = self.at_inner
        reflected = mpf(1) if inside is None else fresnel(outside, inside)
        back = by_channel(self.between, self.outward(turn + 2 * outside - mp.pi, depth - 1))
        if inside is None:
            return by_channel(self.between, back)
        on = self.in_bubble(turn + outside - inside, depth - 1)
        return by_channel(self.between, combined((reflected, back), (1 - reflected, on)))

    def in_bubble(self, turn: Any, depth: int) -> Vector:
        """From one side of the inner sphere to the other."""
        if depth == 0:
            return BLACK
        outside, inside = self.at_inner
        reflected = fresnel(outside, inside)
        on = by_channel(self.between, self.outward(turn + outside - inside, depth - 1))
        back = self.in_bubble(turn + mp.pi - 2 * inside, depth - 1)
        return by_channel(self.inner_chord, combined((reflected, back), (1 - reflected, on)))

    def outward(self, turn: Any, depth: int) -> Vector:
        """At the outer sphere, from inside."""
        if depth == 0:
            return BLACK
        outside, inside = self.at_outer
        reflected = fresnel(outside, inside)
        back = self.inward(turn + mp.pi - 2 * inside, depth - 1)
        return combined((reflected, back), (1 - reflected, self.ray.background(turn + outside - inside)))
