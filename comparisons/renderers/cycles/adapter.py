"""Blender's Cycles through bpy as a renderer, on the processor, where it intersects with Embree in float32."""

from __future__ import annotations

import functools
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.processes.worker_results import read_arrays
from raytruth.comparisons.records.renderings import Rays, RendererError, Rendering
from raytruth.comparisons.renderers.cycles.job import JOB_FILE, RESULT_FILE, Job
from raytruth.comparisons.renderers.cycles.translation import job_of
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.scenes.camera import OrthographicCamera
from raytruth.scenes.exporters.cycles_limits import refuses
from raytruth.scenes.materials import Emission, Material
from raytruth.scenes.requirements import used_materials
from raytruth.scenes.scene import Scene
from raytruth.scenes.shapes import Sphere

# Files and functions below are those of Cycles 5.0.0.
#
# A ray that leaves a triangle starts on it and excludes it by its number (kernel_embree_is_self_intersection in
# src/kernel/device/cpu/bvh.h). Only where the triangle would be missed is the start moved (integrate_surface_ray_offset
# in src/kernel/integrator/shade_surface.h), by ray_offset (src/kernel/bvh/util.h): with the normal's part n in (0, 1],
# a coordinate moves by n·256 units in the last place, each at most 2^-23 of what it was or becomes; or by n/65536, if
# it is under 1/32. The normal is that on the viewer's side, also for a ray that goes through.
SMALL_COORDINATES_OFFSET = 1 / 65536
RELATIVE_OFFSET = 256 * 2.0**-23 * (1 + 256 * 2.0**-23)

# The first sample's place in its pixel is looked up with 0.5 in a table of 1024 (integrate_camera_sample in
# src/kernel/integrator/init_from_camera.h; filter_table in src/scene/film.cpp): halfway between the middle of the
# pixel and the next entry, which is the place for a 511th of the filter. Filters are narrower in the middle than at
# their ends, so that it is less than a 511th of half a filter's width away. The least width is 0.01.
IMAGE_RADIUS = 0.01 / 2 / 511 / 2

# As many samples as Mitsuba's scalar variant draws, whose power is simulated in tests/meta/test_power_on_lobes.py. A
# sample of 64x64 pixels takes 5 ms on 2 cores.
BATCHES = 128
BATCH_SAMPLES = 8

# Starting Blender takes seconds, a picture less than one, a thousand samples some ten; a hang must not stop a run for
# long.
TIME_LIMIT = 300.0
# Of address space. Blender takes 2 GB for a small scene, and each thread of a large machine some 70 MB: this is room
# for these, and still ends a runaway before it takes the machine along.
MEMORY_LIMIT = 16 << 30

PATH = Integrator("path", "ES{{0,{depth}}}(DL|e)", has_depth=True)

# A few pixels, the fewest that Blender has, that look at a shining sphere.
TRIAL_SCENE = Scene(
    purpose="Shows whether Cycles runs here.",
    convention="radiometric",
    camera=OrthographicCamera(
        projection="orthographic", position=(0.0, 0.0, 2.0), look_at=(0.0, 0.0, 0.0), width=4, height=4, view_height=1.0
    ),
    materials={"light": Material(emission=Emission(radiance=(1.0, 1.0, 1.0)))},
    objects=(Sphere(shape="sphere", center=(0.0, 0.0, 0.0), radius=1.0, material="light"),),
)


class Cycles:
    """Cycles, obeying the protocol Renderer. It sums Whitted's own class (translation.py)."""

    name = "cycles"
    integrators = (PATH,)
    error_model = ErrorModel(
        description="float32 with a bit for its own roundings, and rays that start on surfaces (Cycles, Blender 5.0)",
        # The bit is for what Cycles rounds more often than the truth's formulas do: a camera's rays start on its near
        # plane and go through a matrix that is inverted in float32 (Camera::update in src/scene/camera.cpp), all
        # directions are normalised once more, a lamp's strength is a product of colour, power and 1/4π, and its
        # distance is divided out as a density (src/kernel/light/point.h, point_light_sample). And the robust test of
        # Embree needs it (triangle_tests.pluecker_distance), which Cycles asks for (src/bvh/embree.cpp).
        precision_bits=23,
        ray_offset=RayOffset(absolute=SMALL_COORDINATES_OFFSET, relative=RELATIVE_OFFSET, is_bound=True),
        triangle_test="pluecker",
        # triangle_shader_setup in src/kernel/geom/triangle_intersect.h.
        triangle_points="barycentric",
        image_radius=IMAGE_RADIUS,
        random_choices="at dielectrics, to reflect or to refract",
    )
    error_models = (("bpy 5.0.*", error_model),)  # those after 5.0.0 only mend faults
    install = (
        "pip install --no-deps bpy==5.0.1 (Python 3.11 only); apt-get install libgl1 libsm6 libxfixes3 libxi6 "
        "libxkbcommon0 libxrender1"
    )

    def version(self) -> str | None:
        """`bpy` and its version, or None where a trial in a process of its own fails."""
        return _trial()

    def refuses(self, scene: Scene) -> str | None:
        """Why Cycles cannot express this scene, in one clause; None if it can."""
        return refuses(scene)

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Whether there is a dielectric, where rays reflect or refract at random."""
        return any(material.dielectric for material in used_materials(scene))

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - the protocol's signature
        """Render in a process of its own, with Cycles' own camera; `depth` is the number of mirrors and refractions.

        The job, the log, the results and what Blender opens (`*.blend`) stay in `folder`, which must exist. Raises
        RendererError.
        """
        batches = BATCHES if self.is_stochastic(scene, integrator) else 0
        rendering, _ = _run(job_of(scene, depth, batches, BATCH_SAMPLES), folder)
        return rendering


def _run(job: Job, folder: Path) -> tuple[Rendering, str]:
    """The worker's result and Blender's version; a result of an earlier run is not taken for its own."""
    (folder / RESULT_FILE).unlink(missing_ok=True)
    (folder / JOB_FILE).write_text(job.model_dump_json(indent=2), encoding="utf-8")
    command = [sys.executable, "-P", "-m", "raytruth.comparisons.renderers.cycles.worker"]
    run_isolated(command, folder, seconds=TIME_LIMIT, memory_bytes=MEMORY_LIMIT)
    size = (job.camera.height, job.camera.width, 3)
    expected: dict[str, tuple[int, ...]] = {"image": size, "seconds": (), "version": ()}
    if job.batches:
        expected["batch_means"] = (job.batches, *size)
    result = read_arrays(folder / RESULT_FILE, expected, "Cycles")
    rendering = Rendering(
        image=result["image"],
        seconds=float(result["seconds"]),
        samples=max(1, job.batches * job.batch_samples),
        batch_means=result.get("batch_means"),
    )
    return rendering, str(result["version"])


@functools.cache
def _trial() -> str | None:
    """The version of Blender if it renders a trial scene here; tried once a process."""
    with TemporaryDirectory(prefix="raytruth-") as name:
        try:
            _, version = _run(job_of(TRIAL_SCENE, 0, 0, 1), Path(name))
        except RendererError:
            return None
        return f"bpy {version}"
