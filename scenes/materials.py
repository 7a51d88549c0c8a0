"""Materials state only the terms they have; a term that is absent is neither stored nor evaluated."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag, model_validator

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


class Ambient(Part):
    """ka·Od: what the surface gives back of the ambient light."""

    reflectance: Color


class Diffuse(Part):
    """kd·Od, the Lambertian reflectance."""

    reflectance: Texture


class Specular(Part):
    """ks·Os with an exponent: Phong's (r·v)^n or Blinn's (n·h)^n."""

    reflectance: Color
    exponent: Positive
    model: Literal["phong", "blinn"]


class Mirror(Part):
    """Perfect mirror: the reflected radiance times a constant reflectance."""

    reflectance: Color


class Dielectric(Part):
    """Smooth transparent interface.

    `index_of_refraction` and `absorption` [1/length] belong to the medium inside, where the surface normal does not
    point; `outside` names the dielectric material on the other side (none: empty space, index 1).
    Reflection and transmission are weighted by Fresnel's equations unless the material states the classical
    constants `reflectance` (ks) and `transmittance` (kt), which belong together.
    """

    index_of_refraction: Index
    absorption: Color | None = None
    outside: str | None = None
    reflectance: Color | None = None
    transmittance: Color | None = None

    @model_validator(mode="after")
    def _both_constants_or_none(self) -> Dielectric:
        if (self.reflectance is None) != (self.transmittance is None):
            raise ValueError("expected both reflectance and transmittance, or neither")
        return self


class Emission(Part):
    """Radiance the surface sends out by itself, the same in all directions and on both sides."""

    radiance: Texture


class Material(Part):
    """The terms of one material; at least one."""

    ambient: Ambient | None = None
    diffuse: Diffuse | None = None
    specular: Specular | None = None
    mirror: Mirror | None = None
    dielectric: Dielectric | None = None
    emission: Emission | None = None

    @model_validator(mode="after")
    def _states_a_term(self) -> Material:
        if all(getattr(self, term) is None for term in type(self).model_fields):
            raise ValueError("expected at least one term: ambient, diffuse, specular, mirror, dielectric or emission")
        return self
