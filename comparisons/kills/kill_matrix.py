"""The kill matrix: each fault and each legitimate variant on each scene, judged as a renderer is.

Images are small, so that the whole library takes minutes, and are rendered by the interpreted tracer: to compile a
kernel for each fault and scene would take longer than all the rendering. First hits are judged only of those faults
that are about them.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import distances_in_tolerances
from raytruth.comparisons.judgement.first_hit_test import judge_first_hits
from raytruth.comparisons.matrix.quick_suite import small
from raytruth.comparisons.measures.public_gates import gates_that_reject
from raytruth.comparisons.processes.time_limit import TookTooLongError, cpu_seconds
from raytruth.comparisons.records.renderings import FirstHits, Rays
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, INTERPRETED_FLOAT32
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.instantiation import functions_of
from raytruth.reference_tracer.rendering import first_hits, prepare, primary_rays, render_prepared
from raytruth.reference_tracer.source.scene_data import PLANE_MATERIAL, SPHERE_MATERIAL, TRIANGLE_MATERIAL
from raytruth.reference_tracer.source.traversal import NOTHING
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.faults.fault import Subject
    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.scenes.scene import Scene

# What a hundred times the right tracer's time is not enough for will not end; a second, so that noise does not count.
LONGEST_SECONDS, TIMES_AS_LONG = 1.0, 20.0
# What code that is wrong raises: division by zero, roots of negative numbers, complex powers, places that do not exist.
ERRORS = (ArithmeticError, ValueError, TypeError, IndexError, MemoryError, TookTooLongError)


@dataclass(frozen=True)
class KillCell:
    """What came of one subject on one scene."""

    subject: str
    margin: float
    """The largest distance of a pixel in tolerances: up to 1 it passes; infinity where there is no tolerance, or for an
    error. Of first hits infinity if one fails, else 0."""
    error: str = ""
    """What it raised, or that it took too long, or wrote what is not a number; such a renderer fails, too."""
    gates: tuple[str, ...] = ()
    """The gates of public suites that reject the image."""

    @property
    def fails(self) -> bool:
        """Whether the cell counts as a kill: the matrix would say `fail` or `error`."""
        return self.margin > 1


@dataclass(frozen=True)
class SceneKills:
    """The cells of one scene for all subjects that differ from the right tracer there."""

    scene: str
    cells: tuple[KillCell, ...]
    seconds: float
    """What it takes to judge one renderer by this scene: its feasible set, and one rendering."""


def kills_on(scene: Scene, subjects: Iterable[Subject]) -> SceneKills:
    """Judge all subjects that differ from the right tracer in a function which this scene needs."""
    bench = _Bench(scene)
    return SceneKills(
        scene.name, tuple(bench.judge(subject) for subject in subjects if applies(subject, scene)), bench.seconds
    )


def applies(subject: Subject, scene: Scene) -> bool:
    """Whether the kernel of this scene holds any function that the subject replaces."""
    if not subject.overrides:
        return True
    return not functions_of(required_features(scene)).isdisjoint(subject.overrides)


class _Bench:
    """One scene with what subjects are judged by, each feasible set made once."""

    def __init__(self, scene: Scene) -> None:
        self.scene = small(scene)
        self._sets: dict[ErrorModel, FeasibleSet] = {}
        start = time.process_time()
        self.truth = np.asarray(render_prepared(prepare(self.scene, FLOAT)), dtype=np.float64)
        self.longest = LONGEST_SECONDS + TIMES_AS_LONG * (time.process_time() - start)
        self.seconds = 0.0

    def judge(self, subject: Subject) -> KillCell:
        """Render, and compare with the feasible set of what the subject declares."""
        feasible = self._feasible(subject.declares)
        try:
            with cpu_seconds(self.longest), np.errstate(all="ignore"):
                if subject.gives == "first hits":
                    hits = _first_hits_of(self.scene, subject)
                    failing = judge_first_hits(hits, feasible).failing
                    return KillCell(subject.name, np.inf if failing else 0.0)
                image = rendered(self.scene, subject)
        except ERRORS as error:
            return KillCell(subject.name, np.inf, f"{type(error).__name__}: {error}")
        if image.shape != self.truth.shape:
            return KillCell(subject.name, np.inf, f"an image of shape {image.shape}")
        if np.isnan(image).any():
            return KillCell(subject.name, np.inf, "pixels that are not a number", gates_that_reject(image, self.truth))
        margin = float(distances_in_tolerances(image, feasible).max())
        return KillCell(subject.name, margin, "", gates_that_reject(image, self.truth))

    def _feasible(self, model: ErrorModel) -> FeasibleSet:
        """The radiance is enclosed once for all outputs: float64 alters none of it."""
        radiance_model = replace(model, output=OutputModel("float64"))
        if radiance_model not in self._sets:
            start = time.process_time()
            self._sets[radiance_model] = feasible_set(self.scene, radiance_model)
            self.seconds = self.seconds or time.process_time() - start
        radiance = self._sets[radiance_model]
        low, high = model.output.interval_read(radiance.low, radiance.high)
        return replace(radiance, low=low, high=high)


def rendered(scene: Scene, subject: Subject) -> NDArray[np.float64]:
    """What is read from the file that the subject writes. Raises what its code raises."""
    arithmetic = INTERPRETED_FLOAT32 if subject.numbers == "float32" else FLOAT
    radiance: Any = render_prepared(prepare(scene, arithmetic, _behaviour(subject)))
    image = np.asarray(radiance.astype(np.float64))
    if subject.finish is not None:
        image = np.array(subject.finish(image), dtype=np.float64)
    if subject.declares.output.numbers == "float32":
        return image.astype(np.float32).astype(np.float64)
    return image


def _behaviour(subject: Subject) -> Behaviour:
    return Behaviour(subject.overrides, name=subject.name)


def _first_hits_of(scene: Scene, subject: Subject) -> FirstHits:
    """Distances and primitives as the subject tells them; positions and normals follow from these."""
    right = prepare(scene, FLOAT)
    depths, primitives = first_hits(prepare(scene, FLOAT, _behaviour(subject)))
    rays = Rays(*primary_rays(scene))
    position, normal = np.full((2, *rays.origins.shape), np.nan)
    count = sum(
        right.kernel.rows_of(right.data, table) for table in (SPHERE_MATERIAL, TRIANGLE_MATERIAL, PLANE_MATERIAL)
    )
    for row, column in np.argwhere(primitives != NOTHING).tolist():
        origin, direction = rays.origins[row, column].tolist(), rays.directions[row, column].tolist()
        point = right.kernel.along(origin, direction, depths[row, column])
        position[row, column] = point
        if primitives[row, column] < count:
            normal[row, column] = right.kernel.surface_normal(right.data, int(primitives[row, column]), point)
    return FirstHits(depths.astype(np.float64), position, normal, primitives)
