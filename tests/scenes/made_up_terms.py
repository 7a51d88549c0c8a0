"""A term of materials that nobody has heard of, and scenes that have it."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Any, cast

from raytruth.scenes.materials import Material, Term
from raytruth.scenes.scene import Scene
from tests.scenes.exporter_scenes import FLOOR, SUN, build

if TYPE_CHECKING:
    from raytruth.scenes.features import Feature


class MadeUpFeature(StrEnum):
    """What no renderer has."""

    GOLDEN_GLITTER = "GOLDEN_GLITTER"


# A made-up member of the features, which are an enumeration and cannot be added to.
GOLDEN_GLITTER = cast("Feature", MadeUpFeature.GOLDEN_GLITTER)


class MadeUpTerm(Term):
    """Says of itself what a term must say; subclasses say where the light comes from."""

    is_classical = True
    reflectance: tuple[float, float, float]

    def features(self) -> frozenset[Feature]:
        """A feature that is none of those in the code."""
        return frozenset({GOLDEN_GLITTER})


class Glitter(MadeUpTerm):
    """Lit by lights."""

    light_from = "lights"


class Shimmer(MadeUpTerm):
    """Sends on rays."""

    light_from = "rays"


class Glow(MadeUpTerm):
    """Shines by itself."""

    light_from = "itself"


class Gleam(MadeUpTerm):
    """Gives back ambient light."""

    light_from = "ambient light"


class MadeUpMaterial(Material):
    """A material that may have such terms."""

    glitter: Glitter | None = None
    shimmer: Shimmer | None = None
    glow: Glow | None = None
    gleam: Gleam | None = None


class MadeUpScene(Scene):
    """A scene whose materials are such."""

    materials: dict[str, MadeUpMaterial]  # type: ignore[assignment]  # a scene is not changed, so a subclass will do


MADE_UP_TERMS = ("glitter", "shimmer", "glow", "gleam")


def made_up(*terms: str, known: dict[str, Any] | None = None, **changes: Any) -> Scene:
    """A triangle in the sun that has these made-up terms beside the known ones."""
    stated = {term: {"reflectance": (0.2, 0.1, 0.3)} for term in terms}
    base = build(objects=[FLOOR], lights=[SUN]).model_dump(exclude_defaults=True)
    return MadeUpScene.model_validate(base | {"materials": {"m": stated | (known or {})}} | changes)
