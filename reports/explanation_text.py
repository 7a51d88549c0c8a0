"""An explanation of a pixel as text: the ray tree, indented, with the formulas' names."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from raytruth.reports.wording import plural, printable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from raytruth.reference_tracer.explanation_record import (
        DielectricTerm,
        Explanation,
        Hit,
        LightTerm,
        TracedRay,
        Vector,
    )

INDENT = "    "
COLOUR_UNITS = {"radiometric": "radiance in W/(m²·sr), linear RGB", "whitted": "linear RGB, without a unit"}
ATTENUATIONS = {"none": "1", "inverse_square": "1/d²", "polynomial": "min(1, 1/(a + b·d + c·d²))"}
DIFFUSE_NAMES = {"radiometric": "ρ/π", "whitted": "kd·Od"}
HIGHLIGHTS = {"phong": "(r·v)^n", "blinn": "(n·h)^n"}


def explanation_text(explanation: Explanation, hexadecimal: bool = False) -> str:
    """A ray tree as lines of text; numbers to six digits, or exactly as hexadecimal floats."""
    writer = _Writer(explanation, float.hex if hexadecimal else _six_digits)
    return "\n".join(writer.lines()) + "\n"


def _six_digits(value: float) -> str:
    return f"{value:.6g}"


class _Writer:
    """The lines of one explanation, in one number format."""

    def __init__(self, explanation: Explanation, number: Callable[[float], str]) -> None:
        self.explanation = explanation
        self.number = number

    def vector(self, value: Vector) -> str:
        return f"({', '.join(map(self.number, value))})"

    def lines(self) -> Iterator[str]:
        tree = self.explanation
        yield f"Pixel ({tree.x}, {tree.y}) of {printable(tree.scene)}, in Python floats, {tree.convention} convention."
        yield f"Colours are {COLOUR_UNITS[tree.convention]}; lengths are in scene units."
        levels: list[int] = []
        for ray in tree.rays:
            levels.append(0 if ray.parent is None else levels[ray.parent] + 1)
            yield ""
            first, *rest = self.ray(ray)
            yield levels[-1] * INDENT + first
            for line in rest:
                yield (levels[-1] + 1) * INDENT + line
        yield ""
        count = len(tree.rays)
        yield f"Sum of the {count} {plural('contribution', count)}: the pixel is {self.vector(tree.sum)}"

    def ray(self, ray: TracedRay) -> Iterator[str]:
        parent = "" if ray.parent is None else f" from ray {ray.parent}"
        more = "no more bounces" if ray.depth_left == 0 else f"{ray.depth_left} more {plural('bounce', ray.depth_left)}"
        yield (
            f"ray {ray.number}: {ray.kind}{parent}, weight {self.vector(ray.weight)}, "
            f"in {_medium(ray.medium)}, {more} allowed"
        )
        yield f"o = {self.vector(ray.origin)}, d = {self.vector(ray.direction)}"
        if ray.hit is None:
            yield "meets nothing"
        else:
            hit = ray.hit
            yield (
                f"hits primitive {hit.primitive} (object {hit.object_index}, material {printable(hit.material)}) "
                f"at distance t = {self.number(hit.distance)}, {_side(hit, ray.dielectric)}"
            )
            yield f"point o + t·d = {self.vector(hit.point)}, normal n = {self.vector(hit.normal)}"
        yield from self.terms(ray)
        yield f"contribution: {self.product(ray)} = {self.vector(ray.contribution)}"

    def terms(self, ray: TracedRay) -> Iterator[str]:
        """What is seen at the ray's end, and what the surface does to the ray."""
        if ray.medium_transmittance is not None:
            yield f"medium transmittance exp(−σ·t) = {self.vector(ray.medium_transmittance)}"
        if ray.background is not None:
            yield f"background = {self.vector(ray.background)}"
        if ray.emission is not None:
            yield f"emission Le = {self.vector(ray.emission)}"
        if ray.ambient is not None:
            yield f"ambient ka·Od·Ia = {self.vector(ray.ambient)}"
        for term in ray.lights:
            yield from self.light(term)
        if ray.local is not None:
            yield f"local illumination = {self.vector(ray.local)}"
        if ray.mirror_reflectance is not None:
            unused = "" if ray.depth_left else ", but no more bounces are allowed"
            yield f"mirror reflectance = {self.vector(ray.mirror_reflectance)}{unused}"
        if ray.dielectric is not None:
            yield from self.dielectric(ray.dielectric)

    def light(self, term: LightTerm) -> Iterator[str]:
        toward = f"to it {self.vector(term.to_light)}, n·l = {self.number(term.cosine)}"
        yield f"light {term.light} ({term.kind}): {toward}"
        arriving = f"arriving = {self.vector(term.arriving)}"
        if term.falloff is not None and term.attenuation is not None:
            factor = f"f_att = {ATTENUATIONS[term.falloff]} = {self.number(term.attenuation)}"
            arriving = f"{factor}, {arriving}"
        yield INDENT + arriving
        if term.shadowed is None:
            where = "at this very point" if math.isnan(term.cosine) else "behind the surface (n·l <= 0)"
            yield f"{INDENT}{where}: adds {self.vector(term.radiance)}"
        elif term.shadowed:
            blocker = f"primitive {term.occluder} (object {term.occluder_object})"
            yield f"{INDENT}in the shadow of {blocker}: adds {self.vector(term.radiance)}"
        else:
            yield from self.lit(term)

    def lit(self, term: LightTerm) -> Iterator[str]:
        """The terms of a light that nothing hides."""
        factors = []
        if term.diffuse is not None:
            name = DIFFUSE_NAMES[self.explanation.convention]
            yield f"{INDENT}diffuse {name} = {self.vector(term.diffuse)}"
            factors.append(f"{name}·(n·l)")
        if term.highlight is not None and term.specular_model is not None and term.specular_reflectance is not None:
            name = HIGHLIGHTS[term.specular_model]
            reflectance = self.vector(term.specular_reflectance)
            yield f"{INDENT}specular ks·Os = {reflectance}, {name} = {self.number(term.highlight)}"
            factors.append(f"ks·Os·{name}")
        yield f"{INDENT}not hidden: adds ({' + '.join(factors)}) · arriving = {self.vector(term.radiance)}"

    def dielectric(self, term: DielectricTerm) -> Iterator[str]:
        number = self.number
        yield (
            f"dielectric: index ratio η = {number(term.index_ratio)}, cos θ = c = {number(term.cosine)}, "
            f"g² = η² − 1 + c² = {number(term.discriminant)}"
        )
        if term.transmitted_weight is None:
            yield f"{INDENT}total internal reflection (g² < 0): reflected × {self.vector(term.reflected_weight)}"
            return
        if term.fresnel_reflectance is None:
            names = ("ks", "kt")
        else:
            yield f"{INDENT}Fresnel reflectance R = {number(term.fresnel_reflectance)}"
            names = ("R", "(1 − R)/η²" if self.explanation.convention == "radiometric" else "1 − R")
        yield f"{INDENT}reflected × {names[0]} = {self.vector(term.reflected_weight)}"
        yield f"{INDENT}transmitted × {names[1]} = {self.vector(term.transmitted_weight)}"

    def product(self, ray: TracedRay) -> str:
        seen = "background" if ray.hit is None else "local illumination"
        return f"weight · {seen}" if ray.medium_transmittance is None else f"weight · medium transmittance · {seen}"


def _medium(name: str | None) -> str:
    return "empty space" if name is None else printable(name)


def _side(hit: Hit, dielectric: DielectricTerm | None) -> str:
    """From which side the ray meets the surface; a dielectric's inside is behind its surface."""
    sides = ("from its front", "from behind") if dielectric is None else ("entering it", "leaving it")
    return sides[0] if hit.entering else sides[1]
