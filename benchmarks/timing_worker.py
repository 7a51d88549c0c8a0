"""A process that renders one scene each time it is told to, and answers with the seconds it took.

Run as `python -P -m benchmarks.timing_worker RENDERER SCENE_FILE THREADS IMAGE_FILE`, where RENDERER is `raytruth` or a
variant of Mitsuba. For each line on standard input it answers one line of JSON; the first rendering, made before, has
compiled everything and is written to IMAGE_FILE.
"""

from __future__ import annotations

import json
import os
import resource
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Render = Callable[[], NDArray[np.floating]]


def main() -> None:
    """Serve until standard input ends."""
    renderer, scene_file, threads, image_file = sys.argv[1:]
    use_threads(int(threads))
    prepare = prepare_raytruth if renderer == "raytruth" else prepare_mitsuba
    start = time.perf_counter()
    render = prepare(renderer, Path(scene_file))
    image = render()
    answer(seconds=time.perf_counter() - start)
    np.save(image_file, image)
    for _ in sys.stdin:
        start = time.perf_counter()
        render()
        answer(seconds=time.perf_counter() - start)
    # Linux counts the largest resident size in units of 1024 bytes (getrusage(2)).
    answer(peak_bytes=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)


def answer(**values: float) -> None:
    """One line on standard output."""
    print(json.dumps(values), flush=True)


def use_threads(threads: int) -> None:
    """Keep to as many processors, the same ones for all renderers; what is loaded later makes threads for these."""
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:threads])


def prepare_raytruth(_: str, scene_file: Path) -> Render:
    """The compiled tracer in float64, from the scene as it stands in a file of our own."""
    from raytruth.reference_tracer.rendering import prepare, render_prepared  # noqa: PLC0415 - counts as preparation
    from raytruth.scenes.scene import Scene  # noqa: PLC0415 - likewise

    prepared = prepare(Scene.model_validate_json(scene_file.read_bytes()))
    return lambda: render_prepared(prepared)


def prepare_mitsuba(variant: str, scene_file: Path) -> Render:
    """A Mitsuba variant, from a Mitsuba scene file with one sample a pixel."""
    import drjit  # noqa: PLC0415 - may abort the process, and counts as preparation
    import mitsuba  # noqa: PLC0415 - likewise

    mitsuba.set_variant(variant)
    drjit.set_thread_count(len(os.sched_getaffinity(0)))
    scene = mitsuba.load_file(str(scene_file))
    return lambda: np.array(mitsuba.render(scene))


if __name__ == "__main__":
    main()
