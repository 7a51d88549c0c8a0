"""Departures: models that a renderer has on purpose in place of the specification's, and says so.

A renderer that declares one is held to the tracer with these changes (departure_edits.py): nothing else is feasible for
it. But what one could tell from the truth is as declared, not as due.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Iterator


@dataclass(frozen=True)
class Departures:
    """What a renderer computes otherwise on purpose. Raises ValueError for weights that give back more than they get.

    Each field's first value is what the specification says.
    """

    end_of_depth: Literal["black", "background", "local"] = "black"
    """What a reflected or refracted ray brings that may not be traced any more: nothing (TREE-2); the background in its
    direction; or the local terms of what it meets: emission, ambient, diffuse and specular."""
    fresnel: Literal["exact", "schlick", "schlick on the incident side"] = "exact"
    """How a dielectric splits light: by Fresnel's equations (REFR-4); or by Schlick's approximation, with the cosine on
    the side with the lower index, or always with that of the arriving ray."""
    constant_weights: tuple[float, float] | None = None
    """The reflected and the transmitted fraction of a dielectric whatever the angle, in place of Fresnel's; at total
    reflection all is reflected, as ever. None: as `fresnel` says."""
    lit_from: Literal["surface", "offset point"] = "surface"
    """From where the direction and distance to lights are taken: the point of the surface, or where a ray starts that
    leaves it along its normal, on the side that is seen, by the renderer's ray offset."""
    textured_at: Literal["surface", "offset point"] = "surface"
    """At which of the same two points textures are looked up."""
    highlights: Literal["lit", "shadowed", "everywhere"] = "lit"
    """Where lights have highlights: where they light the surface (ILL-3); in shadows, too; or also on surfaces that are
    turned away from the light."""
    clamped_lambert: bool = False
    """Whether the light that all lights send to a point, each times the cosine, is clamped to 1 in each channel before
    the diffuse reflectance is multiplied with it."""

    def __post_init__(self) -> None:
        weights = self.constant_weights
        if weights is not None and (min(weights) < 0.0 or sum(weights) > 1.0):
            raise ValueError("constant weights of a dielectric are not negative, and add up to at most 1")
        if weights is not None and self.fresnel != "exact":
            raise ValueError("the weights of a dielectric are constant, or follow Schlick's approximation, not both")

    def in_words(self) -> str:
        """All departures as clauses for people, as in `raytruth renderers`."""
        return "; ".join(self._clauses()) or "none"

    def _clauses(self) -> Iterator[str]:
        if self.end_of_depth != "black":
            brought = "background" if self.end_of_depth == "background" else "local terms of what they would meet"
            yield f"paths that end bring the {brought}"
        if self.fresnel != "exact":
            side = " with the cosine of incidence" if self.fresnel != "schlick" else ""
            yield f"Schlick's approximation{side} for Fresnel's equations"
        if self.constant_weights is not None:
            reflected, transmitted = self.constant_weights
            yield f"dielectrics reflect {reflected:.3g} and transmit {transmitted:.3g} at all angles"
        if self.lit_from != "surface":
            yield "surfaces are lit as from where rays leave them"
        if self.textured_at != "surface":
            yield "textures are looked up where rays leave surfaces"
        if self.highlights != "lit":
            where = "in shadows" if self.highlights == "shadowed" else "in shadows and on sides turned away"
            yield f"highlights {where}"
        if self.clamped_lambert:
            yield "the sum of all lights' diffuse light is clamped to 1"


NONE = Departures()
