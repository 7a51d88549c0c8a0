"""Where a program departs from the specification on purpose: its cells are `declared` where one can see it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from raytruth.comparisons.error_models.departures import Departures
from raytruth.comparisons.renderers.program.declared_part import Part

Weight = Annotated[float, Field(strict=True, ge=0, le=1)]


class Model(Part):
    """Where the program departs from the specification on purpose; it is held to that, and declared where one sees it."""

    end_of_depth: Literal["black", "background", "local"] = Field(
        "black",
        description="What a ray brings that the depth leaves no room for: nothing, the background in its direction, or "
        "the local terms of what it meets.",
    )
    fresnel: Literal["exact", "schlick", "schlick on the incident side"] = Field(
        "exact",
        description="By which law dielectrics split light: Fresnel's, or Schlick's approximation with the cosine on "
        "the side with the lower index, or always with that of the arriving ray.",
    )
    constant_weights: tuple[Weight, Weight] | None = Field(
        None,
        description="What dielectrics reflect and transmit at all angles; beyond the critical angle they reflect all.",
    )
    lit_from: Literal["surface", "offset point"] = Field(
        "surface", description="Where lights are seen from: the point hit, or where rays leave it by offset."
    )
    textured_at: Literal["surface", "offset point"] = Field(
        "surface", description="At which of these two points textures are looked up."
    )
    highlights: Literal["lit", "shadowed", "everywhere"] = Field(
        "lit",
        description="Where lights have highlights: where they light a surface, in shadows too, or also on sides that "
        "are turned away from them.",
    )
    clamped_lambert: Annotated[bool, Field(strict=True)] = Field(
        False,
        description="The sum of all lights' colours times cosines is clamped to 1 before the diffuse reflectance is "
        "multiplied with it.",
    )

    def departures(self) -> Departures:
        """The same as a part of an error model. Raises ValueError for what does not go together."""
        return Departures(**dict(self))
