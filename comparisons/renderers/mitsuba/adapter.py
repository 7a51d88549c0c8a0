"""Mitsuba 3 as a renderer: `mitsuba` is its variant scalar_rgb, `mitsuba-llvm` its variant llvm_ad_rgb."""

from __future__ import annotations

import functools
import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.processes.worker_results import read_arrays
from raytruth.comparisons.records.renderings import FirstHits, Rays, RendererError, Rendering
from raytruth.comparisons.renderers.mitsuba.job import JOB_FILE, RAYS_FILE, RESULT_FILE, Job
from raytruth.comparisons.renderers.protocol import Integrator, Renderer
from raytruth.scenes.bare_geometry import bare_geometry
from raytruth.scenes.camera import OrthographicCamera
from raytruth.scenes.exporters import mitsuba as exporter
from raytruth.scenes.exporters.mitsuba_limits import refuses, reversed_primitives
from raytruth.scenes.materials import Emission, Material
from raytruth.scenes.requirements import used_materials
from raytruth.scenes.scene import Scene
from raytruth.scenes.shapes import Sphere

# Mitsuba 3.9.1 moves the origin of a secondary ray from p along the geometric normal n, to the side the ray goes to,
# by (1 + max|p|)·RayEpsilon (include/mitsuba/render/interaction.h lines 165-169, `offset_p`, used by `spawn_ray` and
# `spawn_ray_to`). RayEpsilon = 1500·Epsilon of float32 (include/mitsuba/core/math.h line 18), where Dr.Jit's
# Epsilon is half an ulp of 1, 2^-24 (drjit/array_constants.h line 52); the same in all variants with Embree.
RAY_EPSILON = 1500 * 2.0**-24
# A shadow ray ends at (1 - ShadowEpsilon) of the way from its moved origin to the light (interaction.h line 150);
# ShadowEpsilon = 10·RayEpsilon (math.h line 22).
SHADOW_EPSILON = 10 * RAY_EPSILON

# Of both variants, as derived from Mitsuba 3.9.1 and its Embree 3.13.4.
SCALAR_MODEL = ErrorModel(
    description="float32 with rays that start off the surface (Mitsuba 3.9)",
    precision_bits=24,
    # Excluded: the offset is some thousand roundoffs of the coordinates.
    ray_offset=RayOffset(absolute=RAY_EPSILON, relative=RAY_EPSILON),
    shadow_shortening=SHADOW_EPSILON,
    # Embree's robust mode is off (src/render/scene_embree.inl line 226).
    triangle_test="moeller-trumbore",
    # Mesh::compute_surface_interaction in src/render/mesh.cpp line 1566.
    triangle_points="barycentric",
    # Sphere::ray_intersect_preliminary_impl in src/shapes/sphere.cpp line 522. It computes in float64, but for the foot
    # on the ray, which is a point in float32 (line 557); ray_test_impl (line 585) has none.
    sphere_test="from the foot, accurate for shadows",
    # Sphere::compute_surface_interaction in src/shapes/sphere.cpp lines 690-694.
    sphere_points="put back",
    random_choices="at dielectrics, to reflect or to refract; where light goes from a lamp, by ptracer",
)
# Variants that differentiate test spheres in float32 (src/shapes/sphere.cpp lines 528-530), and leave points where they
# are found along the ray (lines 679-688).
LLVM_MODEL = replace(SCALAR_MODEL, sphere_test="from the foot", sphere_points="normalised")

# How many random samples a pixel gets. What decides are two faults in the library's glass scenes, simulated in
# tests/meta/test_power_on_lobes.py: with 1,024 samples a bias of 1 % in what a lobe brings is always found, with 4,096
# also one of 1 % in how often it is chosen. Compiled code draws the latter in the time that scalar code takes for less.
# Many batches rather than few, since the test for biased lobes can gain only so much from each, and a million rays at
# once leave the cache. Measured for a glass sphere at 64x64 and depth 6 on 2 busy cores: 10 s scalar, 2.6 s with LLVM.
BATCHES = 128
BATCH_SAMPLES = {"scalar_rgb": 8, "llvm_ad_rgb": 32}

FIRST_HITS = "first-hits"
LIGHT_TRACER = "ptracer"
# How many light paths it traces for an image, in batches: what is found with so many, is simulated in
# tests/meta/test_power_on_light_paths.py. Measured at 96x72 on 2 busy cores: 10 s with LLVM, and 10 s scalar.
LIGHT_PATH_BATCHES = 64
LIGHT_PATHS = {"scalar_rgb": 1 << 23, "llvm_ad_rgb": 1 << 25}

# A 512x512 scene of some thousand triangles takes seconds; a hang must not stop a run for long.
TIME_LIMIT = 300.0
# Of address space. A 64x64 scene takes 0.5 GB (0.65 GB with LLVM), the largest mesh some more, and each thread of a
# large machine about 70 MB: this is room for all of these, and still ends a runaway before it takes the machine along.
MEMORY_LIMIT = 16 << 30

# Shapes of the worker's arrays after the image's height and width.
RESULT_SHAPES = {"image": (3,), "depth": (), "position": (3,), "normal": (3,), "primitive": ()}

# One pixel that looks at a shining sphere: the least that makes a variant compile and trace.
TRIAL_SCENE = Scene(
    purpose="Shows whether Mitsuba runs here.",
    convention="radiometric",
    camera=OrthographicCamera(
        projection="orthographic", position=(0.0, 0.0, 2.0), look_at=(0.0, 0.0, 0.0), width=1, height=1, view_height=1.0
    ),
    materials={"light": Material(emission=Emission(radiance=(1.0, 1.0, 1.0)))},
    objects=(Sphere(shape="sphere", center=(0.0, 0.0, 0.0), radius=1.0, material="light"),),
)
TRIAL_RAYS = Rays(origins=np.array([[[0.0, 0.0, 2.0]]]), directions=np.array([[[0.0, 0.0, -1.0]]]))


# With `depth` surface vertices before the light, which Mitsuba calls max_depth = depth + 1.
BY_CAMERA_RAYS = (
    Integrator("direct", "E(S?e|D[Le])", gives="image and first hits"),
    Integrator("path", "E[DS]{{0,{depth}}}(L|e)", has_depth=True, gives="image and first hits"),
    Integrator(FIRST_HITS, "E", gives="first hits"),
)
# Traced forward from the light, with max_depth = 2. No mirror or glass leads to a camera without extent.
BY_LIGHT_PATHS = Integrator(LIGHT_TRACER, "E(D?e|DL)", follows="light paths")


def mitsuba_scalar() -> Renderer:
    """Mitsuba's variant that computes one ray at a time, and so too few light paths for a good test of them."""
    return MitsubaRenderer("mitsuba", "scalar_rgb", BY_CAMERA_RAYS, "pip install mitsuba")


def mitsuba_llvm() -> Renderer:
    """Mitsuba's variant that compiles for the processor's vector instructions, in float32 throughout."""
    install = "pip install mitsuba; apt install libllvm19 (16 at least)"
    return MitsubaRenderer("mitsuba-llvm", "llvm_ad_rgb", (*BY_CAMERA_RAYS, BY_LIGHT_PATHS), install)


class MitsubaRenderer:
    """A variant of Mitsuba, obeying the protocol Renderer."""

    def __init__(self, name: str, variant: str, integrators: tuple[Integrator, ...], install: str) -> None:
        self.name = name
        self.variant = variant
        self.error_model = LLVM_MODEL if variant == "llvm_ad_rgb" else SCALAR_MODEL
        # No later one: pull request 1962, merged after this release, replaces the offset above by a bound on how each
        # shape's points are rounded, which is about a hundredth of it.
        self.error_models = (("mitsuba 3.9.1", self.error_model),)
        self.integrators = integrators
        self.install = install

    def version(self) -> str | None:
        """`mitsuba` and its version, or None where a trial in a process of its own fails."""
        return _try_variant(self.variant)

    def refuses(self, scene: Scene) -> str | None:
        """Why Mitsuba cannot express this scene, in one clause; None if it can."""
        return refuses(scene)

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:
        """Whether light paths start at random, or there is a dielectric, where camera rays reflect or refract so."""
        return integrator == LIGHT_TRACER or any(material.dielectric for material in used_materials(scene))

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:
        """Render in a process of its own; `depth` is the number of surface vertices before the light.

        The Mitsuba scene, the log and the results stay in `folder`, which must exist. Deterministic scenes are
        rendered by Mitsuba's own sensor, as is `ptracer`, others along `rays`. First hits are those of `rays`. Raises
        RendererError.
        """
        if integrator == FIRST_HITS:
            return replace(self.render(bare_geometry(scene), "direct", 0, rays, folder), image=None)
        job = self._write_job(scene, integrator, depth, folder)
        np.savez(folder / RAYS_FILE, allow_pickle=False, origins=rays.origins, directions=rays.directions)
        _run(folder)
        return _read_rendering(folder, rays.origins.shape[:2], job)

    def _write_job(self, scene: Scene, integrator: str, depth: int, folder: Path) -> Job:
        stochastic = self.is_stochastic(scene, integrator)
        sources = exporter.light_sources(scene)
        # Mitsuba samples one source of light at random: without random numbers it would be the same one everywhere.
        parts: list[exporter.Source | None] = [None] if stochastic or len(sources) < 2 else list(sources)
        files = [
            exporter.export_mitsuba(
                scene,
                folder,
                integrator=integrator,
                max_depth=depth + 1,
                only_source=part,
                file_name=exporter.SCENE_FILE if part is None else f"scene-{part}.xml",
            ).name
            for part in parts
        ]
        first = exporter.first_primitives_of(scene)
        batches, batch_samples = self._batches(scene, integrator)
        job = Job(
            variant=self.variant,
            scene_files=tuple(files),
            first_primitives={exporter.shape_id(index): number for index, number in enumerate(first)},
            reversed_primitives=tuple(np.flatnonzero(reversed_primitives(scene)).tolist()),
            batches=batches,
            batch_samples=batch_samples,
            traces_light=integrator == LIGHT_TRACER,
        )
        (folder / JOB_FILE).write_text(job.model_dump_json(indent=2), encoding="utf-8")
        return job

    def _batches(self, scene: Scene, integrator: str) -> tuple[int, int]:
        """How many batches, and of how many samples a pixel each; none for a scene without random numbers."""
        if integrator == LIGHT_TRACER:
            pixels = scene.camera.width * scene.camera.height
            return LIGHT_PATH_BATCHES, max(1, round(LIGHT_PATHS[self.variant] / (LIGHT_PATH_BATCHES * pixels)))
        return (BATCHES, BATCH_SAMPLES[self.variant]) if self.is_stochastic(scene, integrator) else (0, 1)


def _run(folder: Path) -> None:
    """Run the worker; a result of an earlier run must not be taken for its own."""
    (folder / RESULT_FILE).unlink(missing_ok=True)
    command = [sys.executable, "-P", "-m", "raytruth.comparisons.renderers.mitsuba.worker"]
    run_isolated(command, folder, seconds=TIME_LIMIT, memory_bytes=MEMORY_LIMIT)


def _read_rendering(folder: Path, size: tuple[int, ...], job: Job) -> Rendering:
    """The worker's result, whose shapes must be those of an image of `size` (height, width)."""
    expected = {name: (*size, *tail) for name, tail in RESULT_SHAPES.items()}
    if job.batches:
        expected["batch_means"] = (job.batches, *size, 3)
    result = read_arrays(folder / RESULT_FILE, expected, "Mitsuba")
    return Rendering(
        image=result["image"],
        seconds=float(result["seconds"]),
        first_hits=FirstHits(**{name: result[name] for name in ("depth", "position", "normal", "primitive")}),
        samples=max(1, job.batches * job.batch_samples) * (size[0] * size[1] if job.traces_light else 1),
        batch_means=result.get("batch_means"),
    )


@functools.cache
def _try_variant(variant: str) -> str | None:
    """The version of Mitsuba if this variant renders a trial scene here; tried once a process.

    Only a trial tells: with an unfit LLVM the variant loads and then aborts its process.
    """
    with TemporaryDirectory(prefix="raytruth-") as name:
        folder = Path(name)
        renderer = MitsubaRenderer("trial", variant, BY_CAMERA_RAYS, "")
        try:
            renderer.render(TRIAL_SCENE, "path", 0, TRIAL_RAYS, folder)
        except RendererError:
            return None
        with np.load(folder / RESULT_FILE, allow_pickle=False) as archive:
            return f"mitsuba {archive['version']}"
