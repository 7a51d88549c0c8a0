"""The child process of the Embree adapter: reads its job in the current folder and writes `result.npz` there.

Run as `python -P -m raytruth.comparisons.renderers.embree.worker`. It alone imports Embree, which may end its process.
"""

from __future__ import annotations

import time
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from raytruth.comparisons.processes.worker_results import write_arrays
from raytruth.comparisons.renderers.embree.job import JOB_FILE, RESULT_FILE, TASK_FILE, Job, Light

Array = NDArray[Any]


def main() -> None:
    """Do the job in the current folder."""
    job = Job.model_validate_json(Path(JOB_FILE).read_bytes())
    with np.load(TASK_FILE, allow_pickle=False) as task:
        origins, directions, triangles = task["origins"], task["directions"], task["triangles"]
    size = origins.shape[:2]
    origins, directions = origins.reshape(-1, 3), directions.reshape(-1, 3)

    start = time.perf_counter()
    scene = EmbreeScene(robust=job.robust)
    mesh = TriangleMesh(scene, triangles.astype(np.float32))
    hits = find_first_hits(scene, origins, directions, triangles, job)
    lit = [find_lit(scene, hits, directions, light, job.offset) for light in job.lights]
    seconds = time.perf_counter() - start
    del mesh  # it had to live as long as the scene

    result = {name: values.reshape(*size, *values.shape[1:]) for name, values in hits.items()}
    result["lit"] = np.array(lit, dtype=bool).reshape(len(lit), *size)
    result["seconds"] = np.array(seconds)
    result["version"] = np.array(version("embreex"))
    write_arrays(Path(RESULT_FILE), result)


def find_first_hits(
    scene: EmbreeScene, origins: Array, directions: Array, triangles: Array, job: Job
) -> dict[str, Array]:
    """Depth, position, normal and primitive where each ray first meets a triangle."""
    found = scene.run(origins.astype(np.float32), directions.astype(np.float32), output=True)
    primitive = found["primID"].astype(np.int64)
    missed = primitive < 0
    depth = np.where(missed, np.inf, found["tfar"].astype(np.float64))
    normal = found["Ng"].astype(np.float64)
    if job.robust:
        # Embree's robust test subtracts the ray's origin from the corners before it takes the normal from them
        # (kernels/geometry/triangle_intersector_pluecker.h, lines 71-95), which costs bits where a triangle is small
        # and far. So who wants the triangle's normal takes it from the corners, as Mitsuba does, too.
        corners = triangles.astype(np.float32)[primitive]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(np.float64)
    with np.errstate(invalid="ignore"):  # of what missed
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        position = origins + depth[:, None] * directions
    position[missed] = normal[missed] = np.nan
    return {"depth": depth, "position": position, "normal": normal, "primitive": primitive}


def find_lit(scene: EmbreeScene, hits: dict[str, Array], directions: Array, light: Light, offset: float) -> Array:
    """Whether nothing stands between each hit and a light on the viewer's side of the surface; False for no hit."""
    hit = np.flatnonzero(hits["primitive"] >= 0)
    position, normal = hits["position"][hit], hits["normal"][hit]
    away = np.sum(normal * directions[hit], axis=1, keepdims=True) > 0
    to_viewer = np.where(away, -normal, normal)
    start = position + to_viewer * offset * (1 + np.abs(position).max(axis=1, keepdims=True))
    # Unnormalised, a shadow ray reaches a near light at t = 1, with no square root and no rounding of the distance.
    toward = np.subtract(light.vector, start) if light.is_near else np.broadcast_to(light.vector, start.shape)
    end = np.full(len(hit), 1.0 if light.is_near else np.inf, dtype=np.float32)
    # -1 stands for no hit in the answer, too.
    lit = np.zeros(len(directions), dtype=bool)
    lit[hit] = scene.run(start.astype(np.float32), toward.astype(np.float32), end, query="OCCLUDED") < 0
    return lit


if __name__ == "__main__":
    main()
