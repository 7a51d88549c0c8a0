"""Renders a scene by Cycles with a sampling pattern, in 256 images of one sample and as many seeds; prints their mean.

    python tests/meta/found/sampling_pattern.py SCENE PATTERN

The last line is the mean over all pixels and images. The picture that is written on the way is in the current folder.
"""

from __future__ import annotations

import sys

from raytruth.comparisons.renderers.cycles import worker  # first of all, since it loads Blender before NumPy
from raytruth.comparisons.renderers.cycles.translation import job_of
from raytruth.scenes.loading import load_scene

BATCHES, BATCH_SAMPLES = 16, 16


def main(scene_file: str, pattern: str) -> None:
    scene = load_scene(scene_file)
    job = job_of(scene, scene.max_depth, BATCHES, BATCH_SAMPLES)
    mean = 0.0
    for part in job.parts:
        blender_scene = worker.build(job, part)
        blender_scene.cycles.sampling_pattern = pattern
        mean += float(worker.render_batches(blender_scene, job).mean())
    print(f"{mean:.4f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
