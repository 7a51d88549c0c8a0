"""Where a program departs from the specification on purpose: its cells are `declared` where one can see it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from raytruth.comparisons.error_models.departures import Departures
from raytruth.comparisons.renderers.program.declared_part import Part
from raytruth.scenes.requirements import used_materials

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

Weight = Annotated[float, Field(strict=True, ge=0, le=1)]


class Model(Part):
    """Where the program departs from the specification on purpose; it is held to that, and its cells tell it."""

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

    def refuses(self, scene: Scene) -> str | None:
        """Why a scene cannot be judged with these departures, as what follows 'because'; None if it can."""
        reflects = any(material.mirror or material.dielectric for material in used_materials(scene))
        if self.end_of_depth != "black" and scene.max_depth == 0 and reflects:
            return "without any depth the truth has no reflected and refracted rays that could end otherwise"
        return None

    def departures(self) -> Departures:
        """The same as a part of an error model. Raises ValueError for what does not go together."""
        return Departures(**dict(self))
