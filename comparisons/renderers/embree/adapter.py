"""Embree through embreex: `embree` is its fast mode, `embree-robust` its robust one. Triangles only.

Embree intersects rays and does not shade. So it gives first hits of any scene of triangles, and where no more than
first hits and visibility of lights is needed, an image: its hits and its shadows, with the formulas of `closed_form`.
"""

from __future__ import annotations

import functools
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.processes.worker_results import read_arrays
from raytruth.comparisons.records.renderings import FirstHits, Image, Rays, RendererError, Rendering
from raytruth.comparisons.renderers.closed_form.geometry import Array, Hits, dot
from raytruth.comparisons.renderers.closed_form.shading import background_radiance, surface_radiance
from raytruth.comparisons.renderers.embree.job import JOB_FILE, RESULT_FILE, TASK_FILE, Job
from raytruth.comparisons.renderers.embree.job import Light as ShadowRays
from raytruth.comparisons.renderers.protocol import Integrator, Renderer
from raytruth.scenes.exporters.triangle_soup import material_of_each_triangle, triangles_of_scene
from raytruth.scenes.features import BACKGROUNDS, FURTHER_RAYS, LIGHTS, LOCAL_TERMS, TRIANGLE_GEOMETRY, missing_features
from raytruth.scenes.lights import Light, PointLight
from raytruth.scenes.planes import refuses_planes
from raytruth.scenes.requirements import required_features
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene

# It sends no further rays: where a scene needs them, its light paths tell.
EXPRESSES = TRIANGLE_GEOMETRY | BACKGROUNDS | LIGHTS | LOCAL_TERMS | FURTHER_RAYS
# Our own choice, as that of all who use Embree: 2^11 roundoffs of the largest coordinate, so that no rounding of a hit
# brings a shadow ray back to the surface that it leaves, and yet little beside what a scene shows.
RAY_OFFSET = 2.0**-13

# Some thousand triangles take milliseconds, starting Python a second; a hang must not stop a run for long.
TIME_LIMIT = 60.0
# Of address space. Half a million triangles, the most that a scene may have, take less than 1 GB; Embree's threads
# reserve some 70 MB each.
MEMORY_LIMIT = 8 << 30

FIRST_HITS = Integrator("first-hits", "E", gives="first hits")
DIRECT = Integrator("direct", "E(e|DL)")
# Shapes of the worker's arrays after the image's height and width.
HIT_SHAPES = {"depth": (), "position": (3,), "normal": (3,), "primitive": ()}

TRIAL_TRIANGLE = np.array([[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]]])
TRIAL_RAYS = Rays(origins=np.array([[[0.0, 0.0, 2.0]]]), directions=np.array([[[0.0, 0.0, -1.0]]]))


def embree() -> Renderer:
    """Embree's fast mode."""
    # Each operation is one of float32, or fused with the next, which rounds less.
    model = ErrorModel(
        description="float32 with rays that start off the surface (Embree 4.4, fast)",
        precision_bits=24,
        ray_offset=RayOffset(absolute=RAY_OFFSET, relative=RAY_OFFSET),
        triangle_test="moeller-trumbore",
    )
    return EmbreeRenderer("embree", model, (FIRST_HITS, DIRECT), robust=False)


def embree_robust() -> Renderer:
    """Embree's robust mode (RTC_SCENE_FLAG_ROBUST): first hits only.

    What can be proved of its formula in float32 is so little that some shadows of a fine mesh cannot be judged.
    """
    model = ErrorModel(
        description="float32 with a bit for other edges, and rays that start off the surface (Embree 4.4, robust)",
        precision_bits=23,  # see triangle_tests.pluecker_distance
        ray_offset=RayOffset(absolute=RAY_OFFSET, relative=RAY_OFFSET),
        triangle_test="pluecker",
    )
    return EmbreeRenderer("embree-robust", model, (FIRST_HITS,), robust=True)


class EmbreeRenderer:
    """A mode of Embree, obeying the protocol Renderer."""

    install = "pip install embreex"

    def __init__(
        self, name: str, error_model: ErrorModel, integrators: tuple[Integrator, ...], *, robust: bool
    ) -> None:
        self.name = name
        self.error_model = error_model
        # embreex has the version of the Embree in it; those after 4.4.0 only mend faults.
        self.error_models = (("embreex 4.4.*", error_model),)
        self.integrators = integrators
        self.robust = robust

    def version(self) -> str | None:
        """`embreex` and its version, or None where a trial in a process of its own fails."""
        return _trial(self.robust)

    def refuses(self, scene: Scene) -> str | None:
        """Why the scene is not one of triangles in empty space."""
        if any(isinstance(shape, Sphere) for shape in scene.objects):
            return "Embree as embreex offers it has triangles and no spheres"
        without_planes = refuses_planes("Embree", scene)
        if without_planes:
            return without_planes
        if scene.camera.inside is not None:
            return "its camera is inside a dielectric, and Embree knows no media"
        return missing_features("Embree", EXPRESSES, required_features(scene))

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Never."""
        return False

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - as above
        """First hits, and an image for `direct`, from a process of its own; `depth` does not matter.

        Raises RendererError.
        """
        lights = scene.lights if integrator == DIRECT.name else ()
        job = Job(robust=self.robust, lights=tuple(_shadow_rays(light) for light in lights), offset=RAY_OFFSET)
        result = _run(job, triangles_of_scene(scene), rays, folder)
        hits = FirstHits(**{name: result[name] for name in HIT_SHAPES})
        image = _shaded(scene, hits, result["lit"], rays) if integrator == DIRECT.name else None
        return Rendering(image, float(result["seconds"]), hits)


def _shadow_rays(light: Light) -> ShadowRays:
    if isinstance(light, PointLight):
        return ShadowRays(is_near=True, vector=light.position)
    x, y, z = light.direction
    return ShadowRays(is_near=False, vector=(-x, -y, -z))


def _run(job: Job, triangles: Array, rays: Rays, folder: Path) -> dict[str, NDArray[Any]]:
    """The worker's arrays, of the right shapes; a result of an earlier run is not taken for its own."""
    (folder / RESULT_FILE).unlink(missing_ok=True)
    (folder / JOB_FILE).write_text(job.model_dump_json(indent=2), encoding="utf-8")
    np.savez(
        folder / TASK_FILE, allow_pickle=False, origins=rays.origins, directions=rays.directions, triangles=triangles
    )
    command = [sys.executable, "-P", "-m", "raytruth.comparisons.renderers.embree.worker"]
    run_isolated(command, folder, seconds=TIME_LIMIT, memory_bytes=MEMORY_LIMIT)
    size = rays.origins.shape[:2]
    expected = {name: (*size, *tail) for name, tail in HIT_SHAPES.items()}
    expected |= {"lit": (len(job.lights), *size), "seconds": (), "version": ()}
    return read_arrays(folder / RESULT_FILE, expected, "Embree")


def _shaded(scene: Scene, first: FirstHits, lit: Array, rays: Rays) -> Image:
    """The local terms at the first hits, by the formulas of `closed_form`, in float64."""
    is_hit = first.primitive >= 0
    is_front = dot(rays.directions, first.normal) < 0
    hits = Hits(is_hit, first.depth, first.position, first.normal, is_front)
    radiance = np.array(background_radiance(scene.background, rays.directions))
    materials = np.array(material_of_each_triangle(scene))[first.primitive]
    # A light in the hit point gives 0/0, a subnormal distance gives infinity: both count as no light, as specified.
    # Where nothing is hit, positions are NaN.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
        for name in np.unique(materials[is_hit]):
            material: Material = scene.materials[str(name)]
            shaded = surface_radiance(scene, material, hits, rays.directions, list(lit))
            radiance = np.where((is_hit & (materials == name))[..., None], shaded, radiance)
        return radiance.astype(np.float32)


@functools.cache
def _trial(robust: bool) -> str | None:
    """The version of embreex if it meets a triangle here; tried once a process."""
    with TemporaryDirectory(prefix="raytruth-") as name:
        try:
            result = _run(Job(robust=robust, lights=(), offset=RAY_OFFSET), TRIAL_TRIANGLE, TRIAL_RAYS, Path(name))
        except RendererError:
            return None
        return f"embreex {result['version']}"
