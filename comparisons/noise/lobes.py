"""What a renderer draws that follows one ray at random: reflected with Fresnel's probability R, refracted with 1 - R.

So do Mitsuba's smooth dielectrics and most path tracers. A sample of a pixel then is one of finitely many values, one
for each path from the camera to the end of a branch of the ray tree, and its expectation is the tree's sum.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import prepare
from raytruth.reference_tracer.source.scene_data import CAMERA_MEDIUM, integer_of
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.scenes.materials import Dielectric, Emission, Mirror
from raytruth.scenes.requirements import used_materials

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class Lobes:
    """All paths of all pixels' rays through mirrors and glass. Arrays' first axis counts paths, pixel by pixel."""

    shape: tuple[int, int]
    """Height and width of the image."""
    pixel: NDArray[np.int64]
    """Which pixel the path belongs to, ascending: row times width plus column."""
    probability: NDArray[np.float64]
    """That a sample follows this path; those of a pixel sum to 1."""
    value: NDArray[np.float64]
    """What such a sample brings back, linear RGB; shape (paths, 3)."""
    mirrors: NDArray[np.int64]
    """How many mirrors are on the path."""
    reflections: NDArray[np.int64]
    """How many dielectric surfaces reflect on the path, total internal reflection included."""
    transmissions: NDArray[np.int64]
    """How many dielectric surfaces refract."""
    split_score: NDArray[np.float64]
    """d log(probability) / d log(R), where the same factor changes every R of the path that is below 1."""

    def expectation(self, of_paths: NDArray[Any]) -> NDArray[np.float64]:
        """The mean over each pixel's paths, by probability, of values (paths, …); shape (height · width, …)."""
        height, width = self.shape
        flat = of_paths.reshape(len(self.pixel), -1)
        columns = [np.bincount(self.pixel, self.probability * column, height * width) for column in flat.T]
        means = np.stack(columns, axis=-1).astype(np.float64, copy=False)
        return means.reshape(height * width, *of_paths.shape[1:])

    def sees_directly(self) -> NDArray[np.bool_]:
        """Whether the pixel's camera ray meets neither mirror nor dielectric; shape (height, width)."""
        surfaces = self.mirrors + self.reflections + self.transmissions
        height, width = self.shape
        seen: NDArray[np.bool_] = np.bincount(self.pixel, surfaces, height * width).reshape(self.shape) == 0
        return seen


def find_lobes(scene: Scene) -> Lobes:
    """All paths of a scene's pixels, found by walking the ray tree of each in Python floats.

    The scene must have a `radiance_bound`: then its dielectrics obey Fresnel's equations, and what is mirror or
    dielectric neither shines nor is lit, so that light comes from the ends of branches alone. Raises ValueError for a
    scene with a term that has no such bound, as all have that are not known here.
    """
    for material in used_materials(scene):
        for key, term in material.terms().items():
            if not isinstance(term, Mirror | Dielectric | Emission):
                raise ValueError(f"the lobes of a surface with the term {key} are not known")
    camera = scene.camera
    walker = _Walker(scene)
    paths = [
        (row * camera.width + column, path)
        for row in range(camera.height)
        for column in range(camera.width)
        for path in walker.paths(column, row)
    ]
    return Lobes(
        shape=(camera.height, camera.width),
        pixel=np.array([pixel for pixel, _ in paths]),
        probability=np.array([path.probability for _, path in paths]),
        value=np.array([path.value for _, path in paths]),
        mirrors=np.array([path.mirrors for _, path in paths]),
        reflections=np.array([path.reflections for _, path in paths]),
        transmissions=np.array([path.transmissions for _, path in paths]),
        split_score=np.array([path.split_score for _, path in paths]),
    )


@dataclass(frozen=True)
class _Path:
    """One path, as in Lobes; it may still go on with `ray`."""

    ray: Any
    probability: float = 1.0
    value: tuple[float, ...] = ()
    mirrors: int = 0
    reflections: int = 0
    transmissions: int = 0
    split_score: float = 0.0


class _Walker:
    """A kernel for one scene that tells the reflectance of the last dielectric surface."""

    def __init__(self, scene: Scene) -> None:
        prepared = prepare(scene, FLOAT)
        self.depth = scene.max_depth
        self.kernel, self.data = prepared.kernel, prepared.data
        self.frame = self.kernel.camera_frame(self.data)
        self.reflectance: float | None = None
        functions = self.kernel.__dict__
        for name in {"fresnel_reflectance", "total_reflection_weight"} & functions.keys():
            functions[name] = self._noting(functions[name])

    def _noting(self, function: Callable[..., Any]) -> Callable[..., Any]:
        def noting(*arguments: Any) -> Any:
            result = function(*arguments)
            self.reflectance = 1.0 if isinstance(result, tuple) else result  # total reflection has a weight a channel
            return result

        return noting

    def paths(self, column: int, row: int) -> Iterator[_Path]:
        """The paths of one pixel, each followed to its end."""
        origin, direction = self.kernel.primary_ray(self.frame, column + 0.5, row + 0.5)
        medium = integer_of(self.data, CAMERA_MEDIUM, 0)
        waiting = [_Path((origin, direction, (1.0, 1.0, 1.0), NOTHING, medium, self.depth))]
        while waiting:
            path = waiting.pop()
            self.reflectance = None
            rays: list[Any] = []
            contribution = self.kernel.trace_ray(self.data, path.ray, rays)
            if rays:
                waiting += _longer_paths(path, rays, self.reflectance)
            else:
                yield replace(path, value=tuple(channel / path.probability for channel in contribution))


def _longer_paths(path: _Path, rays: list[Any], reflectance: float | None) -> list[_Path]:
    """The path with each of the rays that its last surface sends on; those that are never drawn are left out."""
    if reflectance is None:
        return [replace(path, ray=rays[0], mirrors=path.mirrors + 1)]
    paths = []
    if reflectance > 0.0:
        paths.append(
            replace(
                path,
                ray=rays[0],
                probability=path.probability * reflectance,
                reflections=path.reflections + 1,
                split_score=path.split_score + (1.0 if reflectance < 1.0 else 0.0),
            )
        )
    if reflectance < 1.0:
        paths.append(
            replace(
                path,
                ray=rays[1],
                probability=path.probability * (1.0 - reflectance),
                transmissions=path.transmissions + 1,
                split_score=path.split_score - reflectance / (1.0 - reflectance),
            )
        )
    return paths
