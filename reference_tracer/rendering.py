"""Images: a scene rendered by the tracer in one of its arithmetics."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from reference_tracer.arithmetic import FLOAT64, Arithmetic, Kernel, make_kernel
from reference_tracer.tables import build_tables, material_number
from scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from reference_tracer.scene_data import SceneData
    from scenes.scene import Scene

# Bands of rows, so that threads stay busy to the end although some rows take longer than others.
ROWS_IN_A_BAND = 8


@dataclass(frozen=True)
class PreparedScene:
    """A scene ready to be rendered: its kernel, its tables, and what all its rays share."""

    scene: Scene
    arithmetic: Arithmetic
    kernel: Kernel
    tables: SceneData
    frame: Any
    medium: int

    def radiance_at(self, x: float, y: float) -> Any:
        """What arrives through the image point (x, y) in pixels: a tuple of three numbers of the arithmetic."""
        number = self.arithmetic.number
        return self.kernel.pixel_radiance(
            self.tables, self.frame, self.medium, self.scene.max_depth, number(x), number(y)
        )


def prepare(
    scene: Scene,
    arithmetic: Arithmetic = FLOAT64,
    overrides: Mapping[str, Callable[..., object]] | None = None,
) -> PreparedScene:
    """Make the kernel that the scene requires, and its tables."""
    features = frozenset(str(feature) for feature in required_features(scene))
    kernel = make_kernel(arithmetic, features, overrides)
    tables = build_tables(scene, features, arithmetic)
    return PreparedScene(
        scene,
        arithmetic,
        kernel,
        tables,
        _frame(scene, arithmetic, kernel),
        material_number(scene, scene.camera.inside),
    )


def _frame(scene: Scene, arithmetic: Arithmetic, kernel: Kernel) -> Any:
    camera = scene.camera
    extent = camera.vertical_field_of_view if camera.projection == "perspective" else camera.view_height
    number = arithmetic.number
    vectors = [tuple(number(value) for value in vector) for vector in (camera.position, camera.look_at, camera.up)]
    return kernel.camera_frame(*vectors, number(extent), number(camera.width), number(camera.height))


def render(
    scene: Scene,
    arithmetic: Arithmetic = FLOAT64,
    overrides: Mapping[str, Callable[..., object]] | None = None,
    samples: int = 1,
) -> NDArray[Any]:
    """An image of shape (height, width, 3), linear RGB, row 0 on top; `samples`² rays a pixel on a regular grid."""
    return render_prepared(prepare(scene, arithmetic, overrides), samples)


def render_prepared(prepared: PreparedScene, samples: int = 1) -> NDArray[Any]:
    """As `render`, for a scene that is rendered more than once."""
    camera = prepared.scene.camera
    image = prepared.arithmetic.image(camera.height, camera.width, 3)

    def render_band(first: int, end: int) -> None:
        prepared.kernel.render_rows(
            prepared.tables, prepared.frame, prepared.medium, prepared.scene.max_depth, samples, first, end, image
        )

    _in_bands(render_band, camera.height, prepared.arithmetic.compiled)
    return image


def first_hits(prepared: PreparedScene) -> tuple[NDArray[Any], NDArray[np.int64]]:
    """Distance (infinity: none) and primitive number (-1: none) that each pixel's ray meets; shape (height, width)."""
    camera = prepared.scene.camera
    depths = prepared.arithmetic.image(camera.height, camera.width)
    primitives = np.empty((camera.height, camera.width), dtype=np.int64)

    def trace_band(first: int, end: int) -> None:
        prepared.kernel.first_hit_rows(prepared.tables, prepared.frame, first, end, depths, primitives)

    _in_bands(trace_band, camera.height, prepared.arithmetic.compiled)
    return depths, primitives


def _in_bands(work: Callable[[int, int], None], rows: int, parallel: bool) -> None:
    """Run the work over all rows: in threads if it releases the interpreter's lock."""
    bands = [(first, min(first + ROWS_IN_A_BAND, rows)) for first in range(0, rows, ROWS_IN_A_BAND)]
    if not parallel:
        for first, end in bands:
            work(first, end)
        return
    work(*bands[0])  # compiles, which only one thread should do
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda band: work(*band), bands[1:]))
