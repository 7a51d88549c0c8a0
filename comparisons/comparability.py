"""Whether a renderer's integrator can be held against the truth of a scene, and why not."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comparisons.radiance_bound import radiance_bound
from comparisons.splat_bound import has_splat_bound
from scenes.light_paths import comparable_depth

if TYPE_CHECKING:
    from comparisons.renderer import Integrator, Renderer
    from scenes.scene import Scene


def depth_or_reason(scene: Scene, renderer: Renderer, integrator: Integrator) -> int | str:
    """The depth at which the integrator computes the scene's truth, or in one clause why there is none."""
    refusal = renderer.refuses(scene)
    if refusal is not None:
        return refusal
    if integrator.gives == "first hits":
        return 0
    depth = comparable_depth(scene, integrator.light_paths, integrator.has_depth)
    if isinstance(depth, str) or not renderer.is_stochastic(scene, integrator.name):
        return depth
    if integrator.follows == "light paths" and not has_splat_bound(scene):
        return (
            "what one light path adds to a pixel has a known bound only for point lights, diffuse surfaces and a "
            "perspective camera"
        )
    if integrator.follows == "camera rays" and radiance_bound(scene) is None:
        return "its samples have no known bound, which the statistical test needs"
    return depth
