"""A student's program as an assignment runs it, and the picture that it gives of a scene."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.records.renderings import Rays, RendererError
from raytruth.comparisons.renderers.program.conventions import Conventions
from raytruth.comparisons.renderers.program.declaration import Arithmetic, Formulas, Sampling
from raytruth.comparisons.renderers.program.declaration import Rays as DeclaredRays
from raytruth.comparisons.renderers.program.model import Model
from raytruth.reference_tracer.rendering import primary_rays

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True, eq=False)
class Submitted:
    """What a program gave for a scene: a picture, linear RGB of shape (height, width, 3), or why there is none."""

    image: NDArray[np.float64] | None
    seconds: float
    problem: str = ""


def as_graded(program: ProgramRenderer, assignment: Assignment) -> ProgramRenderer:
    """The program with the assignment's limits, and without what a student may not decide.

    Kept are its command, its environment, and the formats that it reads and writes. What its declaration says of
    arithmetic, rays, formulas, conventions and departures is the assignment's to allow, so that it is as if not stated.
    """
    kept = program.declaration.model_copy(
        update={
            "limits": assignment.limits,
            "arithmetic": Arithmetic(),
            "rays": DeclaredRays(),
            "formulas": Formulas(),
            "conventions": Conventions(),
            "model": Model(),
            "sampling": Sampling(),
        }
    )
    return replace(program, declaration=kept)


def submitted(program: ProgramRenderer, scene: Scene) -> Submitted:
    """Run the program on a scene, in a process and a folder of its own; a crash, a hang or garbage is a problem."""
    refused = program.refuses(scene)
    if refused is not None:
        return Submitted(None, 0.0, refused)
    with TemporaryDirectory(prefix="raytruth-") as name:
        try:
            rays = Rays(*primary_rays(scene))
            rendering = program.render(scene, "whitted", scene.max_depth, rays, Path(name))
        except RendererError as error:
            return Submitted(None, 0.0, str(error))
    assert rendering.image is not None, "a program gives an image"
    return Submitted(np.asarray(rendering.image, dtype=np.float64), rendering.seconds)
