"""VTK through pyvista: the pipeline in object order, "for each triangle, for each pixel", with a z-buffer.

It gives first hits, and with its own light an image, where that light is the classical equation's (light.py).
"""

from __future__ import annotations

import functools
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation
from raytruth.comparisons.error_models.rasterisers.view_volume import camera_axes, view_volume
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.processes.worker_results import read_arrays
from raytruth.comparisons.records.renderings import FirstHits, Rays, RendererError, Rendering
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.comparisons.renderers.vtk.job import JOB_FILE, RESULT_FILE, TASK_FILE, Job
from raytruth.comparisons.renderers.vtk.light import lamps_of, refused_light, surfaces_of
from raytruth.scenes.exporters.triangle_soup import triangles_of_scene
from raytruth.scenes.lights import ConstantBackground
from raytruth.scenes.planes import refuses_planes
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

# llvmpipe's positions have FIXED_ORDER = 8 bits behind the point (Mesa, src/gallium/drivers/llvmpipe/lp_rast.h).
SUBPIXEL_BITS = 8
# The least that VTK's framebuffer has (vtkOpenGLRenderWindow::CreateFramebuffers asks for 32, and drivers may give 24).
DEPTH_BITS = 24
# An operation of the lighting equation stands for up to three of VTK's, which squares a distance that it has taken the
# root of, and sums light before it takes the surface's colour times it.
LIGHT_BITS = 22

# Drawing takes milliseconds, starting Python and VTK some seconds; a hang must not stop a run for long.
TIME_LIMIT = 60.0
# Of address space. Half a million triangles, the most that a scene may have, take less than 1 GB; Mesa's threads and
# LLVM's code reserve more than they use.
MEMORY_LIMIT = 8 << 30

FIRST_HITS = Integrator("first-hits", "E", gives="first hits")
LOCAL = Integrator("local", r"E(e|DL)")

TRIAL_TRIANGLE = np.array([[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]]])
TRIAL_JOB = Job(
    width=8,
    height=8,
    position=(0.0, 0.0, 2.0),
    look_at=(0.0, 0.0, 0.0),
    up=(0.0, 1.0, 0.0),
    view_height=2.0,
    near=1.0,
    far=3.0,
)


class Vtk:
    """VTK's first hits and light, obeying the protocol Renderer."""

    name = "vtk"
    integrators = (FIRST_HITS, LOCAL)
    error_model = ErrorModel(
        description="triangles drawn and lit in float32 (VTK 9.7 with Mesa's llvmpipe)",
        precision_bits=24,
        rasterisation=Rasterisation(SUBPIXEL_BITS, DEPTH_BITS, LIGHT_BITS),
    )
    # VTK's releases after 9.7.0 only mend faults. pyvista draws nothing itself, and all that is taken from Mesa, which
    # each system brings along, is the grid of SUBPIXEL_BITS.
    error_models = (("pyvista *, VTK 9.7.*, Mesa *", error_model),)
    install = "pip install pyvista, and Mesa's software renderer: apt-get install libegl1 libgl1-mesa-dri"

    def version(self) -> str | None:
        """Versions of pyvista, VTK and Mesa, or None where a trial in a process of its own fails."""
        return _trial()

    def refuses(self, scene: Scene) -> str | None:
        """Why the scene is not one of triangles in empty space, in front of the camera, in light that VTK has."""
        if any(isinstance(shape, Sphere) for shape in scene.objects):
            return "VTK draws triangles and no spheres"
        without_planes = refuses_planes("VTK", scene)
        if without_planes:
            return without_planes
        if scene.camera.inside is not None:
            return "its camera is inside a dielectric, and VTK knows no media"
        if scene.camera.projection == "perspective" and view_volume(scene).near <= 0.0:
            return "its camera is in a surface, and VTK's near plane must be in front of all that is seen"
        return refused_light(scene)

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Never."""
        return False

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - as above
        """First hits or an image from a process of its own; `depth` does not matter. Raises RendererError."""
        job = _job(scene)
        triangles = triangles_of_scene(scene)
        if integrator == FIRST_HITS.name:
            result = _run(job, triangles, np.zeros(len(triangles), dtype=np.int64), folder)
            return Rendering(None, float(result["seconds"]), _first_hits(scene, rays, result))
        surfaces, surface = surfaces_of(scene)
        assert isinstance(scene.background, ConstantBackground), "others are refused"
        light = {"draws": "light", "surfaces": surfaces, "lamps": lamps_of(scene), "background": scene.background.color}
        result = _run(job.model_copy(update=light), triangles, surface, folder)
        return Rendering(result["image"], float(result["seconds"]))


def _job(scene: Scene) -> Job:
    """What is drawn of the scene's first hits."""
    camera = scene.camera
    volume = view_volume(scene)
    if camera.projection == "perspective":
        extent = {"view_angle": camera.vertical_field_of_view}
    else:
        extent = {"view_height": camera.view_height}
    return Job(
        width=camera.width,
        height=camera.height,
        position=camera.position,
        look_at=camera.look_at,
        up=camera.up,
        near=volume.near,
        far=volume.far,
        **extent,
    )


def _first_hits(scene: Scene, rays: Rays, result: dict[str, NDArray[Any]]) -> FirstHits:
    """The distance along a ray is the depth over the cosine between it and the forward direction.

    VTK draws normals in view coordinates, turned to the viewer. They are put on the side of VTK's normal of the
    triangle that it says it has drawn.
    """
    primitive = result["primitive"]
    missed = primitive < 0
    right, up, forward = camera_axes(scene)
    distance = np.where(missed, np.inf, result["depth"] / (rays.directions @ forward))
    with np.errstate(invalid="ignore"):  # of what missed
        position = rays.origins + distance[..., np.newaxis] * rays.directions
    normal = result["drawn_normal"] @ np.array([right, up, -forward])
    normals = result["normals"]
    outward = normals[np.clip(primitive, -1, len(normals) - 1)]
    normal[(normal * outward).sum(axis=-1) < 0] *= -1
    position[missed] = normal[missed] = np.nan
    return FirstHits(distance, position, normal, primitive)


def _run(job: Job, triangles: NDArray[np.float64], surface: NDArray[np.int64], folder: Path) -> dict[str, NDArray[Any]]:
    """The worker's arrays, of the right shapes; a result of an earlier run is not taken for its own."""
    (folder / RESULT_FILE).unlink(missing_ok=True)
    (folder / JOB_FILE).write_text(job.model_dump_json(indent=2), encoding="utf-8")
    np.savez(folder / TASK_FILE, allow_pickle=False, triangles=triangles, surface=surface)
    command = [sys.executable, "-P", "-m", "raytruth.comparisons.renderers.vtk.worker"]
    run_isolated(command, folder, seconds=TIME_LIMIT, memory_bytes=MEMORY_LIMIT)
    size = (job.height, job.width)
    expected: dict[str, tuple[int, ...]] = {"image": (*size, 3)}
    if job.draws == "first hits":
        expected = {"primitive": size, "depth": size, "drawn_normal": (*size, 3), "normals": triangles.shape[:2]}
    return read_arrays(folder / RESULT_FILE, expected | {"seconds": (), "version": ()}, "VTK")


@functools.cache
def _trial() -> str | None:
    """The versions if VTK draws a triangle here; tried once a process."""
    with TemporaryDirectory(prefix="raytruth-") as name:
        try:
            result = _run(TRIAL_JOB, TRIAL_TRIANGLE, np.zeros(1, dtype=np.int64), Path(name))
        except RendererError:
            return None
        return str(result["version"])
