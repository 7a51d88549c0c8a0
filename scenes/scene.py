"""The scene: everything a renderer needs to know, and nothing a scene does not state."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from raytruth.scenes.camera import Camera
from raytruth.scenes.lights import Background, ConstantBackground, Light
from raytruth.scenes.materials import Material
from raytruth.scenes.shapes import Shape
from raytruth.scenes.values import Color, Part

# A full binary ray tree of this depth has 2^65 rays; corridors of mirrors, which do not branch, stay affordable.
LARGEST_DEPTH = 64


class Scene(Part):
    """A scene in one of two lighting conventions, `whitted` (unitless) or `radiometric` (docs/spec.md)."""

    name: str = ""
    """The name of the scene's file without its ending; no text states it."""
    purpose: Annotated[str, Field(min_length=1)]
    """One sentence: what a renderer that gets this scene wrong has got wrong."""
    convention: Literal["whitted", "radiometric"]
    max_depth: Annotated[int, Field(strict=True, ge=0, le=LARGEST_DEPTH)] = 0
    """How many mirror reflections and refractions a path may have."""
    camera: Camera
    background: Background = ConstantBackground(color=(0.0, 0.0, 0.0))
    ambient_light: Color = (0.0, 0.0, 0.0)
    lights: tuple[Light, ...] = ()
    materials: Annotated[dict[str, Material], Field(min_length=1)]
    objects: Annotated[tuple[Shape, ...], Field(min_length=1)]

    def resized(self, width: int, height: int) -> Scene:
        """The same view with an image of this size in pixels."""
        return self.model_copy(update={"camera": self.camera.model_copy(update={"width": width, "height": height})})
