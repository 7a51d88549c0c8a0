"""The child process of the Mitsuba adapter: reads `job.json` in the current folder and writes `result.npz` there.

Run as `python -P -m raytruth.comparisons.renderers.mitsuba.worker`. It alone imports Mitsuba, which may abort
its process.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import drjit
import mitsuba
import numpy as np
from numpy.typing import NDArray

from raytruth.comparisons.processes.worker_results import write_arrays
from raytruth.comparisons.renderers.mitsuba.job import JOB_FILE, RAYS_FILE, RESULT_FILE, Job

# Rays that are traced at once in an `llvm` variant. A million keep the processor busy and take some 100 MB.
LARGEST_WAVEFRONT = 1 << 20

Array = NDArray[Any]
MitsubaObject = Any  # Mitsuba ships no types that mypy can follow across variants


def main() -> None:
    """Do the job in the current folder."""
    job = Job.model_validate_json(Path(JOB_FILE).read_bytes())
    mitsuba.set_variant(job.variant)
    # Merging meshes, an optimisation, would lose the shapes' ids.
    scenes = [mitsuba.load_file(name, optimize=False) for name in job.scene_files]
    with np.load(RAYS_FILE, allow_pickle=False) as rays:
        origins, directions = rays["origins"], rays["directions"]
    height, width = origins.shape[:2]
    flat_rays = origins.reshape(-1, 3), directions.reshape(-1, 3)

    result = {"version": np.array(mitsuba.__version__)}
    if job.batches:
        if job.traces_light:
            means, seconds = trace_light(scenes[0], job.batches, job.batch_samples)
        else:
            means, seconds = sample_batches(scenes[0], *flat_rays, job.batches, job.batch_samples)
        result["image"] = means.mean(axis=0).reshape(height, width, 3).astype(np.float32)
        result["batch_means"] = means.reshape(job.batches, height, width, 3).astype(np.float32)
    else:
        image, seconds = render_sum(scenes)
        result["image"] = image.astype(np.float32)
    result["seconds"] = np.array(seconds)
    for name, values in find_first_hits(scenes[0], *flat_rays, job).items():
        result[name] = values.reshape(height, width, *values.shape[1:])
    write_arrays(Path(RESULT_FILE), result)


def is_vectorised() -> bool:
    """Whether the variant works on arrays of rays and compiles its code, as `llvm` variants do."""
    return bool(drjit.is_jit_v(mitsuba.Float))


def render_sum(scenes: list[MitsubaObject]) -> tuple[Array, float]:
    """The sum in float64 of the scenes' images by Mitsuba's own sensor, and the seconds it took.

    Compilation is not counted: variants that compile render each scene once before.
    """
    if is_vectorised():
        for scene in scenes:
            np.array(mitsuba.render(scene))
    start = time.perf_counter()
    images = [np.array(mitsuba.render(scene), dtype=np.float64) for scene in scenes]
    return np.sum(images, axis=0), time.perf_counter() - start


def trace_light(scene: MitsubaObject, batches: int, paths_a_pixel: int) -> tuple[Array, float]:
    """Images of `ptracer` with a seed each, float64 of shape (batches, height, width, 3), and the seconds they took."""
    if is_vectorised():
        np.array(mitsuba.render(scene, spp=paths_a_pixel, seed=mitsuba.UInt32(batches)))  # compiles
    start = time.perf_counter()
    seeds = map(mitsuba.UInt32, range(batches))
    images = [np.array(mitsuba.render(scene, spp=paths_a_pixel, seed=seed)) for seed in seeds]
    return np.array(images, dtype=np.float64), time.perf_counter() - start


def sample_batches(
    scene: MitsubaObject, origins: Array, directions: Array, batches: int, batch_samples: int
) -> tuple[Array, float]:
    """Means of batches along the rays, float64 of shape (batches, rays, 3), and the seconds they took."""
    if is_vectorised():
        return _sample_wavefronts(scene, origins, directions, batches, batch_samples)
    return _sample_one_by_one(scene, origins, directions, batches, batch_samples)


def _sample_one_by_one(
    scene: MitsubaObject, origins: Array, directions: Array, batches: int, batch_samples: int
) -> tuple[Array, float]:
    """Scalar variants. Each batch draws all its pixels from one sequence, seeded by the number of the batch."""
    sampler = mitsuba.load_dict({"type": "independent"})
    sample = scene.integrator().sample
    rays = [
        mitsuba.RayDifferential3f(mitsuba.Ray3f(origin, direction))
        for origin, direction in zip(origins.tolist(), directions.tolist(), strict=True)
    ]
    sums = np.empty((batches, len(rays), 3))
    start = time.perf_counter()
    for batch in range(batches):
        sampler.seed(batch)
        for index, ray in enumerate(rays):
            total = mitsuba.Color3d(0.0)  # in float64, so that the sum adds no rounding error to the samples'
            for _ in range(batch_samples):
                total += sample(scene, sampler, ray)[0]
            sums[batch, index] = tuple(total)
    return sums / batch_samples, time.perf_counter() - start


def _sample_wavefronts(
    scene: MitsubaObject, origins: Array, directions: Array, batches: int, batch_samples: int
) -> tuple[Array, float]:
    """Compiled variants: as many samples of all pixels at once as fit.

    Each launch has a seed of its own, from which Mitsuba hashes an independent sequence for every ray of it.
    """
    at_once = max(1, min(batch_samples, LARGEST_WAVEFRONT // len(origins)))
    counts = [min(at_once, batch_samples - done) for done in range(0, batch_samples, at_once)]
    sampler = mitsuba.load_dict({"type": "independent"})
    integrator = scene.integrator()

    def launch(seed: int, count: int) -> Array:
        sampler.seed(seed, count * len(origins))
        rays = mitsuba.RayDifferential3f(make_rays(np.tile(origins, (count, 1)), np.tile(directions, (count, 1))))
        radiance: Array = np.array(integrator.sample(scene, sampler, rays)[0], dtype=np.float64).T
        # A radiance that is the same for all rays comes back as one value.
        all_radiance = np.broadcast_to(radiance.reshape(-1, 3), (count * len(origins), 3))
        total: Array = all_radiance.reshape(count, len(origins), 3).sum(axis=0)
        return total

    for count in set(counts):
        launch(0, count)  # compiles
    start = time.perf_counter()
    sums = np.zeros((batches, len(origins), 3))
    for batch in range(batches):
        for number, count in enumerate(counts):
            sums[batch] += launch(1 + batch * len(counts) + number, count)
    return sums / batch_samples, time.perf_counter() - start


def make_rays(origins: Array, directions: Array) -> MitsubaObject:
    """Many rays for compiled variants, from arrays of shape (rays, 3)."""
    return mitsuba.Ray3f(
        mitsuba.Point3f(origins.T.astype(np.float32)), mitsuba.Vector3f(directions.T.astype(np.float32))
    )


def find_first_hits(scene: MitsubaObject, origins: Array, directions: Array, job: Job) -> dict[str, Array]:
    """Depth, position, normal and primitive where each ray first meets a surface, in the scene's own conventions."""
    find = _find_in_wavefront if is_vectorised() else _find_one_by_one
    depth, position, normal, primitive = find(scene, origins, directions, job.first_primitives)
    normal[np.isin(primitive, job.reversed_primitives)] *= -1
    missed = primitive < 0
    depth[missed], position[missed], normal[missed] = np.inf, np.nan, np.nan
    return {"depth": depth, "position": position, "normal": normal, "primitive": primitive}


def _find_one_by_one(
    scene: MitsubaObject, origins: Array, directions: Array, first_primitives: dict[str, int]
) -> tuple[Array, Array, Array, Array]:
    depth, primitive = np.full(len(origins), np.inf), np.full(len(origins), -1)
    position, normal = np.full((len(origins), 3), np.nan), np.full((len(origins), 3), np.nan)
    for index, (origin, direction) in enumerate(zip(origins.tolist(), directions.tolist(), strict=True)):
        hit = scene.ray_intersect(mitsuba.Ray3f(origin, direction))
        if hit.is_valid():
            depth[index], position[index], normal[index] = hit.t, hit.p, hit.n
            offset = hit.prim_index if hit.shape.is_mesh() else 0
            primitive[index] = first_primitives[hit.shape.id()] + offset
    return depth, position, normal, primitive


def _find_in_wavefront(
    scene: MitsubaObject, origins: Array, directions: Array, first_primitives: dict[str, int]
) -> tuple[Array, Array, Array, Array]:
    hit = scene.ray_intersect(make_rays(origins, directions))
    found = np.array(drjit.reinterpret_array(mitsuba.UInt32, hit.shape))
    index_in_shape = np.array(hit.prim_index, dtype=np.int64)
    primitive = np.full(len(origins), -1)
    for shape in scene.shapes():
        number = np.array(drjit.reinterpret_array(mitsuba.UInt32, mitsuba.ShapePtr(shape)))[0]
        offset = index_in_shape if shape.is_mesh() else 0
        primitive = np.where(found == number, first_primitives[shape.id()] + offset, primitive)
    return (
        np.array(hit.t, dtype=np.float64),
        np.array(hit.p, dtype=np.float64).T,
        np.array(hit.n, dtype=np.float64).T,
        primitive,
    )


if __name__ == "__main__":
    main()
