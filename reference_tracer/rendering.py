"""Images: a scene rendered by the tracer in one of its arithmetics."""

from __future__ import annotations

import functools
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, FLOAT64, Arithmetic, make_kernel
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL
from raytruth.reference_tracer.camera_rays import CENTRES
from raytruth.reference_tracer.tables import build_tables
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.reference_tracer.arithmetics.kernel import Kernel
    from raytruth.reference_tracer.camera_rays import CameraRays
    from raytruth.reference_tracer.source.scene_data import SceneData
    from raytruth.scenes.scene import Scene

# Bands of rows, so that threads stay busy to the end although some rows take longer than others.
ROWS_IN_A_BAND = 16


@dataclass(frozen=True)
class PreparedScene:
    """A scene ready to be rendered: its kernel and its tables. Who calls the kernel puts its arithmetic in force."""

    scene: Scene
    arithmetic: Arithmetic
    kernel: Kernel
    data: SceneData


def prepare(scene: Scene, arithmetic: Arithmetic = FLOAT64, behaviour: Behaviour = IDEAL) -> PreparedScene:
    """Make the kernel that the scene requires, and its tables. Raises what `make_kernel` raises."""
    features = required_features(scene)
    kernel = make_kernel(arithmetic, features, behaviour)
    with arithmetic.in_force():
        return PreparedScene(scene, arithmetic, kernel, build_tables(scene, features, arithmetic))


def render(
    scene: Scene, arithmetic: Arithmetic = FLOAT64, behaviour: Behaviour = IDEAL, samples: int = 1
) -> NDArray[Any]:
    """An image of shape (height, width, 3), linear RGB, row 0 on top; `samples`² rays a pixel on a regular grid."""
    return render_prepared(prepare(scene, arithmetic, behaviour), samples)


def render_prepared(prepared: PreparedScene, samples: int = 1) -> NDArray[Any]:
    """An image of a prepared scene, as by `render`, which prepares it anew each time."""
    camera = prepared.scene.camera
    image = prepared.arithmetic.image(camera.height, camera.width, 3)
    _in_bands(prepared, lambda first, end: prepared.kernel.render_rows(prepared.data, samples, first, end, image))
    return image


def first_hits(prepared: PreparedScene) -> tuple[NDArray[Any], NDArray[np.int64]]:
    """What the ray of each pixel's centre meets: distances (infinity for none) and primitives (-1), (height, width)."""
    camera = prepared.scene.camera
    depths = prepared.arithmetic.image(camera.height, camera.width)
    primitives = np.empty((camera.height, camera.width), dtype=np.int64)
    _in_bands(
        prepared, lambda first, end: prepared.kernel.first_hit_rows(prepared.data, first, end, depths, primitives)
    )
    return depths, primitives


def primary_rays(scene: Scene, camera_rays: CameraRays = CENTRES) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Origins and unit directions of the pixels' rays, through their centres or others; of shape (height, width, 3)."""
    prepared = prepare(scene, FLOAT, camera_rays.behaviour())
    frame = prepared.kernel.camera_frame(prepared.data)
    rays = [
        [prepared.kernel.primary_ray(frame, column + 0.5, row + 0.5) for column in range(scene.camera.width)]
        for row in range(scene.camera.height)
    ]
    both: NDArray[np.float64] = np.array(rays)
    return both[:, :, 0], both[:, :, 1]


def _in_bands(prepared: PreparedScene, work: Callable[[int, int], None]) -> None:
    """Run the work over all rows: in threads if it releases the interpreter's lock."""
    rows = prepared.scene.camera.height
    bands = [(first, min(first + ROWS_IN_A_BAND, rows)) for first in range(0, rows, ROWS_IN_A_BAND)]
    if not prepared.arithmetic.compiled:
        with prepared.arithmetic.in_force():
            work(0, rows)
        return
    list(_threads().map(lambda band: work(*band), bands))


@functools.cache
def _threads() -> ThreadPoolExecutor:
    """One thread a processor, kept: starting them takes as long as some thousand pixels."""
    return ThreadPoolExecutor(os.cpu_count())
