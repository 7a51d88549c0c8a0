"""Materials state only the terms they have; a term that is absent is neither stored nor evaluated."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Discriminator, Field, Tag, model_validator

from raytruth.scenes.features import Feature
from raytruth.scenes.values import SMALLEST_INDEX, Color, Coordinate, Part, Positive

Index = Annotated[float, Field(allow_inf_nan=False, strict=True, ge=SMALLEST_INDEX, le=1 / SMALLEST_INDEX)]


class Checkerboard(Part):
    """Squares in the plane of two axes: `even` where floor((u-u0)/size) + floor((v-v0)/size) is even, else `odd`."""

    even: Color
    odd: Color
    size: Positive = 1.0
    plane: Literal["xy", "xz", "yz"] = "xz"
    offset: tuple[Coordinate, Coordinate] = (0.0, 0.0)


class CheckerboardColor(Part):
    """A colour that is a checkerboard."""

    checkerboard: Checkerboard


def _texture_tag(texture: object) -> str:
    return "<checkerboard>" if isinstance(texture, dict | CheckerboardColor) else "<color>"


# With tags an error names the form that was meant; the brackets keep tags apart from keys.
Texture = Annotated[
    Annotated[Color, Tag("<color>")] | Annotated[CheckerboardColor, Tag("<checkerboard>")],
    Discriminator(_texture_tag),
]


LightSource = Literal["lights", "ambient light", "rays", "itself"]
"""Where the light comes from that a term sends to the viewer: point and directional lights; the scene's ambient light;
further rays that it sends on, reflected or refracted; or the surface itself."""


def colors_of(texture: Texture) -> tuple[Color, ...]:
    """The colours that a texture shows somewhere: one, or the two of a checkerboard."""
    if isinstance(texture, CheckerboardColor):
        return texture.checkerboard.even, texture.checkerboard.odd
    return (texture,)


class Term(Part):
    """One term of a material, with what can be told of it alone."""

    light_from: ClassVar[LightSource]
    is_classical: ClassVar[bool]
    """Whether only the classical equation has it, so that no radiometric scene may state it."""

    def features(self) -> frozenset[Feature]:
        """What a renderer must have to render it."""
        raise NotImplementedError


class Ambient(Term):
    """The ambient term ka·Od: the part of the ambient light that the surface gives back."""

    light_from = "ambient light"
    is_classical = True

    reflectance: Color

    def features(self) -> frozenset[Feature]:
        """What a renderer must have: ambient light."""
        return frozenset({Feature.AMBIENT})


class Diffuse(Term):
    """The diffuse term kd·Od: Lambertian reflectance, ρ."""

    light_from = "lights"
    is_classical = False

    reflectance: Texture

    def features(self) -> frozenset[Feature]:
        """What a renderer must have: diffuse reflection, and checkerboards if its reflectance is one."""
        return _texture_features(self.reflectance) | {Feature.DIFFUSE}


class Specular(Term):
    """The highlight ks·Os with an exponent: Phong's (r·v)^n or Blinn's (n·h)^n."""

    light_from = "lights"
    is_classical = True

    reflectance: Color
    exponent: Positive
    model: Literal["phong", "blinn"]

    def features(self) -> frozenset[Feature]:
        """What a renderer must have: the highlight of this model."""
        return frozenset({Feature.PHONG if self.model == "phong" else Feature.BLINN})


class Mirror(Term):
    """Perfect mirror: the reflected radiance times a constant reflectance."""

    light_from = "rays"
    is_classical = False

    reflectance: Color

    def features(self) -> frozenset[Feature]:
        """What a renderer must have: mirrors."""
        return frozenset({Feature.MIRRORS})


class Dielectric(Term):
    """Smooth transparent interface.

    `index_of_refraction` and `absorption` [1/length] belong to the medium inside, where the surface normal does not
    point; `outside` names the dielectric material on the other side (none: empty space, index 1).
    Reflection and transmission are weighted by Fresnel's equations unless the material states the classical
    constants `reflectance` (ks) and `transmittance` (kt), which belong together.
    """

    light_from = "rays"
    is_classical = False

    index_of_refraction: Index
    absorption: Color | None = None
    outside: str | None = None
    reflectance: Color | None = None
    transmittance: Color | None = None

    def features(self) -> frozenset[Feature]:
        """What a renderer must have: dielectrics, and a constant split if it states one.

        That a medium absorbs light is told by the whole scene: a ray must get into it.
        """
        return frozenset({Feature.DIELECTRICS, *((Feature.CONSTANT_SPLIT,) if self.reflectance else ())})

    @model_validator(mode="after")
    def _both_constants_or_none(self) -> Dielectric:
        if (self.reflectance is None) != (self.transmittance is None):
            raise ValueError("expected both reflectance and transmittance, or neither")
        return self


class Emission(Term):
    """Radiance the surface sends out by itself, the same in all directions and on both sides."""

    light_from = "itself"
    is_classical = False

    radiance: Texture

    def features(self) -> frozenset[Feature]:
        """What a renderer must have: emission, and checkerboards if its radiance is one."""
        return _texture_features(self.radiance) | {Feature.EMISSION}


def _texture_features(texture: Texture) -> frozenset[Feature]:
    return frozenset({Feature.CHECKERBOARD}) if isinstance(texture, CheckerboardColor) else frozenset()


class Material(Part):
    """The terms of one material; at least one."""

    ambient: Ambient | None = None
    diffuse: Diffuse | None = None
    specular: Specular | None = None
    mirror: Mirror | None = None
    dielectric: Dielectric | None = None
    emission: Emission | None = None

    def terms(self) -> dict[str, Term]:
        """The terms that the material states, each by its key."""
        stated = ((key, getattr(self, key)) for key in type(self).model_fields)
        return {key: term for key, term in stated if term is not None}

    def light_from(self) -> frozenset[LightSource]:
        """From where light comes that its terms send to the viewer, such as lights or mirrored rays."""
        return frozenset(term.light_from for term in self.terms().values())

    def features(self) -> frozenset[Feature]:
        """What a renderer must have to render each term, whatever light the scene has."""
        return frozenset[Feature]().union(*(term.features() for term in self.terms().values()))

    @model_validator(mode="after")
    def _states_a_term(self) -> Material:
        if not self.terms():
            *keys, last = type(self).model_fields
            raise ValueError(f"expected at least one term: {', '.join(keys)} or {last}")
        return self
