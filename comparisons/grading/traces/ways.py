"""All ways that one ray may go in a declared arithmetic, with what is known of it on each of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flint import arb

from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES
from raytruth.comparisons.feasible_sets.rounded_rays import PlainRays
from raytruth.reference_tracer.arithmetics.balls import every_outcome
from raytruth.reference_tracer.source.traversal import NOTHING

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.rounded_rays import Box, Ray
    from raytruth.scenes.scene import Scene

Given = tuple[float, float, float] | None
WHITE = (arb(1), arb(1), arb(1))
NOTED = (
    "nearest_hit",
    "surface_at",
    "local_illumination",
    "background_radiance",
    "reflected_ray",
    "transmitted_ray",
)
"""Functions of the tracer whose results are noted, where a scene's kernel has them."""


@dataclass(frozen=True)
class Way:
    """What a ray meets and sends on; numbers are balls."""

    primitive: int
    distance: Any
    normal: tuple[Any, Any, Any] | None
    local: Box
    dimmed: Box
    """The same, weakened by the medium that the ray passed."""
    children: dict[str, Ray]
    """The rays that go on, each by its letter, with what it counts of the ray as its weight."""


class Ways:
    """A scene's rays in the arithmetic of one error model."""

    def __init__(self, scene: Scene, model: ErrorModel) -> None:
        self.scene = scene
        self.rays = PlainRays(scene, model)
        self.about_one = arb(1, 2.0**-model.precision_bits)
        self.notes: list[tuple[str, Any]] = []
        functions = self.rays.prepared.kernel.__dict__
        for name in NOTED:
            if name in functions:
                functions[name] = self._noting(name, functions[name])

    def camera_ray(self, column: int, row: int) -> Ray:
        """The ray of a pixel, of weight 1."""
        camera, materials = self.scene.camera, list(self.scene.materials)
        medium = -1 if camera.inside is None else materials.index(camera.inside)
        with self.rays.prepared.arithmetic.in_force():
            return (*self.rays.primary_ray(column, row), WHITE, NOTHING, medium, self.scene.max_depth)

    def restarted(self, ray: Ray, origin: Given, direction: Given) -> Ray:
        """The ray with a start and a direction that a program has printed, each rounded as the model says.

        So what the program has lost on the way is not added up: each ray is held to what the program has of it.
        """
        return (_printed(origin, self.about_one, ray[0]), _printed(direction, self.about_one, ray[1]), *ray[2:])

    def of(self, ray: Ray) -> list[Way]:
        """All ways of a ray, whatever its weight. Raises TooManyOutcomesError where there are too many to tell."""
        alone = (*ray[:2], WHITE, *ray[3:])
        with self.rays.prepared.arithmetic.in_force():
            return list(every_outcome(lambda: self._way(alone), self.rays.decisions, MOST_OUTCOMES, all_or_none=True))

    def brought(self, way: Way, colors: dict[str, tuple[float, float, float]]) -> Box:
        """What a ray brings back whose rays that go on bring these colours."""
        kernel = self.rays.prepared.kernel
        with self.rays.prepared.arithmetic.in_force():
            total: Any = way.dimmed
            for letter, ray in way.children.items():
                red, green, blue = (weight * arb(part) for weight, part in zip(ray[2], colors[letter], strict=True))
                total = kernel.add(total, (red, green, blue))
        red, green, blue = total
        return red, green, blue

    def _way(self, ray: Ray) -> Way:
        self.notes.clear()
        dimmed, sent_on = self.rays.trace(ray)
        last: dict[str, Any] = dict(self.notes)
        distance, primitive = last["nearest_hit"]
        is_hit = primitive != NOTHING
        return Way(
            primitive=primitive,
            distance=distance if is_hit else None,
            normal=last["surface_at"][1] if is_hit else None,
            local=last["local_illumination"] if is_hit else last["background_radiance"],
            dimmed=dimmed,
            children=dict(zip(self._letters(primitive), sent_on, strict=True)),
        )

    def _letters(self, primitive: int) -> list[str]:
        """Of the rays that were sent on: a mirror's comes first, then a dielectric's reflected one."""
        kinds = [name for name, _ in self.notes if name in {"reflected_ray", "transmitted_ray"}]
        letters = ["R" if kind == "reflected_ray" else "T" for kind in kinds]
        if letters and self._is_mirror(primitive):
            letters[0] = "M"
        return letters

    def _is_mirror(self, primitive: int) -> bool:
        kernel: Any = self.rays.prepared.kernel
        materials = list(self.scene.materials.values())
        return materials[kernel.material_of(self.rays.prepared.data, primitive)].mirror is not None

    def _noting(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def noting(*arguments: Any) -> Any:
            result = function(*arguments)
            self.notes.append((name, result))
            return result

        return noting


def _printed(values: Given, about_one: Any, otherwise: Any) -> Any:
    return otherwise if values is None else tuple(arb(value) * about_one for value in values)
