"""A small scene without symmetry, right pictures of it, and an executor that works at once."""

from __future__ import annotations

from concurrent.futures import Executor, Future
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.grading.assignment import Assignment
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
    from raytruth.scenes.scene import Scene

# Each of them is quick to enclose, and shows edges, shadows and colours in all corners.
WIDTH, HEIGHT = 14, 9
# As a program in float64 that may have other formulas.
ASSIGNMENT = Assignment.model_validate(
    {
        "name": "small",
        "title": "Small",
        "models": [{"arithmetic": {"precision": "float64", "slack_bits": 14}}],
        "topics": [{"id": "all", "title": "All", "scenes": ["three-coloured-lights"]}],
    }
)


@cache
def small_scene(name: str = "three-coloured-lights") -> Scene:
    """A scene of the library with a small image, turned a little, so that nothing is symmetrical."""
    scene = open_scene(name).resized(WIDTH, HEIGHT)
    x, y, z = scene.camera.look_at
    camera = scene.camera.model_copy(update={"look_at": (x + 0.31, y + 0.17, z)})
    return scene.model_copy(update={"camera": camera, "name": f"small-{name}"})


def picture(scene: Scene, behaviour: Behaviour = IDEAL) -> NDArray[np.float64]:
    """What is read from a float32 file that a right program has written, or one that does otherwise."""
    image = np.asarray(render(scene, FLOAT, behaviour), dtype=np.float64)
    return image.astype(np.float32).astype(np.float64)


class AtOnce(Executor):
    """Does in this process, and at once, what it is asked for."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """The result, already there."""
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future
