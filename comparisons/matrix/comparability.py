"""Whether a renderer's integrator can be held against the truth of a scene, and why not."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.noise.shape_widths import LEAST_WIDTH, narrowest_width
from raytruth.comparisons.noise.splat_bound import has_splat_bound
from raytruth.scenes.bare_geometry import bare_geometry
from raytruth.scenes.light_paths import comparable_depth

if TYPE_CHECKING:
    from raytruth.comparisons.renderers.protocol import Integrator, Renderer
    from raytruth.scenes.scene import Scene


def depth_or_reason(scene: Scene, renderer: Renderer, integrator: Integrator) -> int | str:
    """The depth at which the integrator computes the scene's truth, or in one clause why there is none."""
    if integrator.gives == "first hits":
        return _first_hits_or_reason(scene, renderer)
    refusal = renderer.refuses(scene)
    if refusal is not None:
        return refusal
    depth = comparable_depth(scene, integrator.light_paths, integrator.has_depth)
    if isinstance(depth, str) or not renderer.is_stochastic(scene, integrator.name):
        return depth
    if integrator.follows == "light paths":
        return _reason_against_light_paths(scene) or depth
    if integrator.follows == "camera rays" and radiance_bound(scene) is None:
        return "its samples have no known bound, which the statistical test needs"
    return depth


def _reason_against_light_paths(scene: Scene) -> str | None:
    if not has_splat_bound(scene):
        return (
            "what one light path adds to a pixel has a known bound only for point lights, diffuse surfaces and a "
            "perspective camera"
        )
    width = narrowest_width(scene)
    if width <= LEAST_WIDTH:
        return (
            f"a shape is {width:.2g} pixels wide, and what is narrower than {LEAST_WIDTH:.2g} can hide between the "
            "points by which light paths are bounded"
        )
    return None


def _first_hits_or_reason(scene: Scene, renderer: Renderer) -> int | str:
    """0, unless the renderer cannot express the shapes or the camera, or tells first hits with its images anyway."""
    both = [integrator for integrator in renderer.integrators if integrator.gives == "image and first hits"]
    if any(isinstance(depth_or_reason(scene, renderer, integrator), int) for integrator in both):
        return "its first hits are judged beside its images"
    return renderer.refuses(bare_geometry(scene)) or 0
