"""Materials as POV-Ray's textures and interiors: each term of the lighting equation is a texture of its own.

A texture of POV-Ray has one pigment, which colours its diffuse, ambient and emitted light, and highlights that take
the colour of the light alone. So the textures of a material's terms are averaged. An average is divided by the sum of
the weights: the first term has the weight 1 and each other one the weight `faint` = 2^-30 and 1/faint times its
strength. In the float32 of POV-Ray's colours the sum of the weights is then 1, and a power of two rounds nothing.

What filters a texture lies on it as another layer: the colour of a highlight, and an attenuation that lights lack.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.scenes.exporters.povray_text import block, color, comment, vector
from raytruth.scenes.lights import PointLight, PolynomialFalloff
from raytruth.scenes.materials import CheckerboardColor
from raytruth.scenes.media import relative_index

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.materials import Checkerboard, Dielectric, Material, Texture
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.values import Color

BLACK = "pigment { rgb 0 }"
FADE_DISTANCE = 2.0**-26
"""With this f, 2/(1 + (d/f)²) is 2f²/d² within 2^-52/d²."""
SHORT_FADE = 1e-6
"""In POV-Ray's units: far below what a ray travels in a medium, above 1e-10, below which a fade is ignored."""


@dataclass(frozen=True)
class _Term:
    """A texture: its name, the strength's keyword and what stands before and after it, and filters on top of it."""

    name: str
    body: str
    """`@` stands for a factor of the strength."""
    filters: tuple[str, ...] = ()


def declare_material(scene: Scene, identifier: str, name: str, material: Material) -> str:
    """`#declare` statements for the textures `identifier` and, of a dielectric, `identifier_inside`."""
    lines = [comment(f"material {name}")]
    terms = list(_local_terms(scene, material))
    if material.mirror and scene.max_depth:
        reflectance = color(material.mirror.reflectance)
        terms.append(_Term("mirror", f"{BLACK} finish {{ reflection {{ {reflectance}@ }} }}"))
    if material.dielectric is None or scene.max_depth == 0:
        return "".join([*lines, _declare_average(identifier, identifier, terms or [_Term("black", BLACK)])])
    for side, entering in (("", True), ("_inside", False)):
        split = _Term(f"dielectric{side}", _dielectric(scene, material.dielectric, entering))
        declared = [] if entering else terms
        lines.append(_declare_average(identifier, f"{identifier}{side}", [split, *terms], declared))
    return "".join(lines)


def interior_of(dielectric: Dielectric) -> str:
    """POV-Ray's `interior { ... }` of a dielectric: index, absorption, and the constant weight of total reflection."""
    lines = [f"ior {dielectric.index_of_refraction!r}"]
    if dielectric.absorption and any(dielectric.absorption):
        lines.append(f"media {{ method 1 intervals 1 samples 1, 1 absorption {color(dielectric.absorption)}/unit }}")
    if dielectric.reflectance is not None:
        # What comes from behind the surface, or is totally reflected, is multiplied on its way inside by
        # colour + (1 - colour)/(1 + (way/distance)^power), which is the colour.
        weight = color(dielectric.reflectance)
        lines.append(f"fade_color {weight} fade_distance {SHORT_FADE!r} fade_power 2")
    return block("interior", *lines)


def polynomial_falloff(light: object) -> PolynomialFalloff | None:
    """A light's polynomial attenuation, if it has one that no light of POV-Ray has."""
    falloff = light.falloff if isinstance(light, PointLight) else None
    return falloff if isinstance(falloff, PolynomialFalloff) and fading(falloff) is None else None


def fading(falloff: object) -> tuple[float, float] | None:
    """An intensity's factor and POV-Ray's `fade_distance` f that attenuate like this: factor · 2/(1 + (d/f)²).

    1/(a + c·d²) is (1/(2a)) · 2/(1 + (d/√(a/c))²), if there is no linear term; with a >= 1 it is never above 1, where
    ours is cut off and POV-Ray's is not. None for other attenuations.
    """
    if falloff == "inverse_square":
        return 0.5 / (FADE_DISTANCE * FADE_DISTANCE), FADE_DISTANCE
    if isinstance(falloff, PolynomialFalloff) and falloff.linear == 0 and falloff.constant >= 1 and falloff.quadratic:
        return 0.5 / falloff.constant, math.sqrt(falloff.constant / falloff.quadratic)
    return None


def _declare_average(prefix: str, name: str, terms: list[_Term], declared: list[_Term] | None = None) -> str:
    """The terms that are not declared yet, and their average."""
    weights = ["1", *["faint"] * (len(terms) - 1)]
    lines = []
    for weight, term in zip(weights, terms, strict=True):
        if term not in (declared or []):
            body = term.body.replace("@", "" if weight == "1" else f"/{weight}")
            layers = [body, *term.filters]
            lines.append(f"#declare {prefix}_{term.name} = {' '.join(block('texture', layer) for layer in layers)}\n")
    entries = [f"[{weight} {prefix}_{term.name}]" for weight, term in zip(weights, terms, strict=True)]
    average = f"{prefix}_{terms[0].name}" if len(terms) == 1 else f"average texture_map {{ {' '.join(entries)} }}"
    return "".join([*lines, f"#declare {name} = {block('texture', average)}\n"])


def _local_terms(scene: Scene, material: Material) -> Iterator[_Term]:
    if material.diffuse and scene.lights:
        factor = "1" if scene.convention == "whitted" else "1/pi"
        pigment = _pigment(material.diffuse.reflectance)
        yield _Term("diffuse", f"{pigment} finish {{ diffuse {factor}@ }}", _attenuation(scene))
    if material.specular and scene.lights:
        exponent = material.specular.exponent
        shape = f"phong 1@ phong_size {exponent!r}"
        if material.specular.model == "blinn":
            shape = f"specular 1@ roughness 1/{exponent!r}"
        filters = (_filter(material.specular.reflectance), *_attenuation(scene))
        yield _Term("highlight", f"{BLACK} finish {{ {shape} }}", filters)
    if material.ambient and any(scene.ambient_light):
        yield _Term("ambient", f"pigment {{ {color(material.ambient.reflectance)} }} finish {{ ambient 1@ }}")
    if material.emission:
        yield _Term("emission", f"{_pigment(material.emission.radiance)} finish {{ emission exposure@ }}")


def _dielectric(scene: Scene, dielectric: Dielectric, entering: bool) -> str:
    """What reflects and transmits, as seen from outside or from inside."""
    if dielectric.reflectance is not None and dielectric.transmittance is not None:
        transmitted = dielectric.transmittance
        if not entering:  # on its way inside the ray was multiplied by the reflectance
            pairs = zip(dielectric.transmittance, dielectric.reflectance, strict=True)
            transmitted = tuple(t / r for t, r in pairs)  # type: ignore[assignment]  # three of three
        return f"{_filter(transmitted)} finish {{ reflection {{ {color(dielectric.reflectance)} }} }}"
    scale = 1.0
    if scene.convention == "radiometric":  # radiance changes with the square of the index
        scale = relative_index(scene, dielectric) ** (-2 if entering else 2)
    return f"{_filter((scale, scale, scale))} finish {{ reflection {{ 0, 1 fresnel }} conserve_energy }}"


def _filter(weights: Color) -> str:
    """A pigment that lets these fractions through, and is nothing else."""
    return f"pigment {{ rgbf {vector((*weights, 1.0))} }}"


def _pigment(texture: Texture) -> str:
    if isinstance(texture, CheckerboardColor):
        return _checkerboard(texture.checkerboard)
    return f"pigment {{ {color(texture)} }}"


def _checkerboard(board: Checkerboard) -> str:
    """By a function: POV-Ray's own checker is a pattern of cubes, and shifted by 1e-10."""
    columns = [
        f"floor(({axis}/unit - {offset!r})/{board.size!r})"
        for axis, offset in zip(board.plane, board.offset, strict=True)
    ]
    # 0 or 1/2, so that the map has no end in the middle of a square.
    function = f"function {{ abs(mod({' + '.join(columns)}, 2))/2 }}"
    return f"pigment {{ {function} color_map {{ [0.25 {color(board.even)}] [0.25 {color(board.odd)}] }} }}"


def _attenuation(scene: Scene) -> tuple[str, ...]:
    """The filter that stands for the attenuation of the only light, if POV-Ray's lights have no such attenuation."""
    for light in scene.lights:
        falloff = polynomial_falloff(light)
        if falloff is None or not isinstance(light, PointLight):
            continue
        offsets = [f"({axis}/unit - ({value!r}))" for axis, value in zip("xyz", light.position, strict=True)]
        squared = f"({' + '.join(f'{offset}*{offset}' for offset in offsets)})"
        divisor = f"{falloff.constant!r} + {falloff.linear!r}*sqrt({squared}) + {falloff.quadratic!r}*{squared}"
        # A pattern's value of 1 may be taken for 0, so that half of it is mapped.
        function = f"function {{ 0.5/max(1, {divisor}) }}"
        return (f"pigment {{ {function} color_map {{ [0 rgbf <0, 0, 0, 1>] [0.5 rgbf <1, 1, 1, 1>] }} }}",)
    return ()
