"""Places of cells, as the plan of a run makes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.matrix.cell import CellPlace

if TYPE_CHECKING:
    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene


def place_of(scene: Scene, renderer: Renderer, integrator: str, *, source: str = "small") -> CellPlace:
    """The place of the renderer's cell of a scene, which is called `small` there."""
    (chosen,) = (known for known in renderer.integrators if known.name == integrator)
    return CellPlace(scene.model_copy(update={"name": "small"}), renderer, chosen, "abc", source, version="1")
