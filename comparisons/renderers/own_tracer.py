"""The reference tracer itself as a renderer: what the matrix judges of it is its compiled float64 form."""

from __future__ import annotations

import time
from importlib.metadata import version
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.records.renderings import FirstHits, Rendering
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.instantiation import SOURCE_FEATURES
from raytruth.reference_tracer.rendering import first_hits, prepare, render_prepared
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.scenes.features import Feature, missing_features
from raytruth.scenes.light_paths import WHITTED
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rays
    from raytruth.scenes.scene import Scene

EXPRESSES = frozenset(map(Feature, SOURCE_FEATURES))
FLOAT64_BITS = 53
# The order of operations is that of the truth, but tangents, exponentials and powers come from the platform's
# mathematical library, which may err by up to two units in the last place: four roundoffs.
LIBRARY_BITS = 2


class ReferenceTracer:
    """raytruth's own tracer in compiled float64, obeying the protocol Renderer."""

    name = "raytruth"
    integrators = (Integrator("whitted", WHITTED, has_depth=True),)
    error_model = ErrorModel(
        f"float64 with {LIBRARY_BITS} bits for the mathematical library",
        precision_bits=FLOAT64_BITS - LIBRARY_BITS,
    )
    error_models = (("*", error_model),)  # our own code, whatever the package's number
    install = "part of raytruth"

    def version(self) -> str:
        """The version of the package raytruth."""
        return f"raytruth {version('raytruth')}"

    def refuses(self, scene: Scene) -> str | None:
        """Why the tracer cannot express the scene: only if a feature of scenes is unknown to its source."""
        return missing_features("raytruth's tracer", EXPRESSES, required_features(scene))

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Never."""
        return False

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - as above
        """Render in the calling process, since its own source can be trusted; `depth` bounces, whatever the scene says.

        The rays are the tracer's own, for the same camera. The time is without compiling.
        """
        prepared = prepare(scene.model_copy(update={"max_depth": depth}))
        prepared.kernel.render_rows(prepared.data, 1, 0, 1, prepared.arithmetic.image(1, scene.camera.width, 3))
        start = time.perf_counter()
        radiance = render_prepared(prepared)
        seconds = time.perf_counter() - start
        with np.errstate(over="ignore"):  # what float32 cannot hold is infinite there
            image = radiance.astype(np.float32)
        camera = scene.camera
        log = f"{self.version()}: {camera.width}x{camera.height} in {seconds:.3f} s\n"
        (folder / "log.txt").write_text(log, encoding="utf-8")
        return Rendering(image, seconds, _first_hits(prepared.scene, rays))


def _first_hits(scene: Scene, rays: Rays) -> FirstHits:
    """The tracer's own, in Python floats: one pass does not pay for compiling; NaN where nothing is hit."""
    exact = prepare(scene, FLOAT)
    depths, primitives = first_hits(exact)
    position = np.full(rays.origins.shape, np.nan)
    normal = np.full(rays.origins.shape, np.nan)
    for row, column in np.argwhere(primitives != NOTHING).tolist():
        origin = tuple(rays.origins[row, column].tolist())
        direction = tuple(rays.directions[row, column].tolist())
        point = exact.kernel.along(origin, direction, depths[row, column])
        position[row, column] = point
        normal[row, column] = exact.kernel.surface_normal(exact.data, int(primitives[row, column]), point)
    return FirstHits(depths.astype(np.float64), position, normal, primitives)
