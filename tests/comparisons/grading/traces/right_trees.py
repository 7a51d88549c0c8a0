"""The ray trees that a right program prints: those of the tracer's own explanations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.comparisons.grading.allowed_models import radiance_model
from raytruth.comparisons.grading.traces.ray_lines import RayLine
from raytruth.reference_tracer.explanation import explain
from tests.comparisons.grading.small_scenes import ASSIGNMENT

if TYPE_CHECKING:
    from raytruth.reference_tracer.explanation_record import TracedRay
    from raytruth.scenes.scene import Scene

MODELS = [radiance_model(model) for model in ASSIGNMENT.models]


def right_tree(scene: Scene, column: int, row: int) -> dict[str, RayLine]:
    """All rays of a pixel with all that can be printed of them, by their paths."""
    rays = explain(scene, column, row).rays
    paths: list[str] = []
    for ray in rays:
        paths.append("" if ray.parent is None else paths[ray.parent] + _letter(ray, rays))
    return {path: _line(path, ray, rays) for path, ray in zip(paths, rays, strict=True)}


def changed(rays: dict[str, RayLine], path: str, **values: Any) -> dict[str, RayLine]:
    """The same tree with other values of one ray."""
    return rays | {path: RayLine.model_validate(rays[path].model_dump() | values)}


def _letter(ray: TracedRay, rays: tuple[TracedRay, ...]) -> str:
    if ray.kind == "transmitted":
        return "T"
    assert ray.parent is not None
    return "M" if rays[ray.parent].mirror_reflectance is not None else "R"


def _line(path: str, ray: TracedRay, rays: tuple[TracedRay, ...]) -> RayLine:
    below = [ray.number]
    for other in rays:
        if other.parent in below:
            below.append(other.number)
    total = [sum(rays[number].contribution[channel] for number in below) for channel in range(3)]
    return RayLine(
        path=path,
        origin=ray.origin,
        direction=ray.direction,
        primitive=ray.hit.primitive if ray.hit else None,
        distance=ray.hit.distance if ray.hit else None,
        normal=ray.hit.normal if ray.hit else None,
        local=ray.local if ray.hit else ray.background,
        color=(total[0] / ray.weight[0], total[1] / ray.weight[1], total[2] / ray.weight[2]),
    )
