"""Lights and what surrounds the scene."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict, Discriminator, Field, Tag, model_validator

from raytruth.scenes.values import Color, Direction, NonNegative, Part, Vector


class PolynomialFalloff(Part):
    """Attenuation min(1, 1/(constant + linear·d + quadratic·d²)) at distance d (Foley, van Dam 1990, eq. 16.8)."""

    model_config = ConfigDict(
        json_schema_extra={
            "anyOf": [{"properties": {key: {"exclusiveMinimum": 0}}} for key in ("constant", "linear", "quadratic")]
        }
    )

    constant: NonNegative
    linear: NonNegative
    quadratic: NonNegative

    @model_validator(mode="after")
    def _attenuates(self) -> PolynomialFalloff:
        if self.constant == self.linear == self.quadratic == 0:
            raise ValueError("expected at least one of constant, linear and quadratic above 0")
        return self


def _falloff_tag(falloff: object) -> str:
    return "<polynomial>" if isinstance(falloff, dict | PolynomialFalloff) else "<named>"


# With tags an error names the form that was meant; the brackets keep tags apart from keys.
Falloff = Annotated[
    Annotated[Literal["none", "inverse_square"], Tag("<named>")] | Annotated[PolynomialFalloff, Tag("<polynomial>")],
    Discriminator(_falloff_tag),
]


class PointLight(Part):
    """Light from one point; intensity per channel in W/sr, or without a unit in the classical convention."""

    kind: Literal["point"]
    position: Vector
    intensity: Color
    falloff: Falloff


class DirectionalLight(Part):
    """Parallel light. `direction` is the way it travels; `irradiance` arrives on a surface that faces it."""

    kind: Literal["directional"]
    direction: Direction
    irradiance: Color


Light = Annotated[PointLight | DirectionalLight, Field(discriminator="kind")]


class ConstantBackground(Part):
    """The same radiance in every direction."""

    color: Color


class GradientBackground(Part):
    """Radiance that goes from `bottom` (straight down, -y) to `top` (straight up, +y), linear in the direction's y."""

    bottom: Color
    top: Color


def _background_tag(background: object) -> str:
    is_gradient = isinstance(background, GradientBackground) or (
        isinstance(background, dict) and ("top" in background or "bottom" in background)
    )
    return "<gradient>" if is_gradient else "<constant>"


Background = Annotated[
    Annotated[ConstantBackground, Tag("<constant>")] | Annotated[GradientBackground, Tag("<gradient>")],
    Discriminator(_background_tag),
]


def shines(background: Background) -> bool:
    """Whether a background brings any light."""
    if isinstance(background, ConstantBackground):
        return any(background.color)
    return any((*background.bottom, *background.top))
