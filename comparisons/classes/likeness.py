"""Pictures that are alike where independent programs differ: evidence of copied work, for a person to look at.

A pixel tells something only where it is neither what the truth becomes in the submission's format, nor what the
mistake that is told of the submission gives there: then it shows an unknown mistake, or the order of operations. And
only if few have it: many share a common mistake. Of two submissions those telling pixels are counted that both have
with the same bits.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.grading.faulty_tracers import FaultyTracer, values_of
from raytruth.comparisons.grading.global_mistakes import (
    AS_IT_IS,
    Reading,
    corrected,
    output_of,
    rays_of,
    readings,
    rendered_scene,
    written_values,
)
from raytruth.comparisons.judgement.judged_truth import judged_truth
from raytruth.comparisons.records.class_results import Likeness

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.comparisons.records.grade_results import Grade
    from raytruth.scenes.scene import Scene

# A value that more than one in ten of a class have is a common mistake, or a common way to compute; two always are few.
COMMON_SHARE = 0.1
# More are alike than differ.
LEAST_SHARE = 0.5
# Of two programs that are alike but for rounding, each pixel may fall to either of two sides by chance. That all of 25
# fall alike has a probability of 2^-25, that they do for any of the 20,000 pairs of 200 students of less than 1/1000.
LEAST_PIXELS = 25


@dataclass(frozen=True)
class Explained:
    """What is told of a submission: its global mistakes, and the faults that explain most of the rest."""

    reading: Reading = AS_IT_IS
    faults: tuple[str, ...] = ()


def explained_by(grade: Grade, declared: OutputModel) -> Explained:
    """What a grade tells of a program that writes as is declared."""
    told = tuple(it.name for it in grade.mistakes)
    same = (it for it in readings(declared) if tuple(mistake.name for mistake in it) == told)
    faults = grade.diagnosis[0].fault.split(" + ") if grade.diagnosis else ()
    return Explained(next(same, AS_IT_IS), tuple(faults))


def telling_pixels(
    scene: Scene, image: NDArray[np.float64], declared: OutputModel, told: Explained
) -> NDArray[np.float32]:
    """The picture (height, width, 3), global mistakes undone, with not-a-number at the pixels that tell nothing."""
    reading = told.reading
    output = output_of(reading, declared)
    assert output is not None, "readings are made of mistakes that go together"
    given = np.asarray(corrected(reading, image), dtype=np.float64)

    def is_read_for(radiance: NDArray[np.float64], values: NDArray[np.float64]) -> NDArray[np.bool_]:
        written = written_values(reading, radiance)
        low, high = output.interval_read(written, written)
        return np.asarray(((low <= values) & (values <= high)).all(axis=-1))

    telling = ~is_read_for(judged_truth(rendered_scene(reading, scene), rays_of(reading)), given)
    if told.faults and telling.any():
        rows, columns = np.nonzero(telling)
        pixels = [(int(column), int(row)) for column, row in zip(columns, rows, strict=True)]
        faulty = values_of(FaultyTracer(told.faults), scene, reading, pixels)
        if faulty is not None:
            telling[rows, columns] = ~is_read_for(faulty, given[rows, columns])
    return np.where(telling[..., None], given, np.nan).astype(np.float32)


def likenesses(pictures: Mapping[str, Mapping[str, NDArray[np.float32]]]) -> list[Likeness]:
    """The pairs of submissions more than half of whose telling pixels are alike, the most alike first.

    `pictures` by submission and scene, as `telling_pixels` gives them. Values are compared by their bits.
    """
    alike: Counter[tuple[str, str]] = Counter()
    telling: dict[str, list[NDArray[np.bool_]]] = {name: [] for name in pictures}
    for scene in sorted({scene for own in pictures.values() for scene in own}):
        shape = next(own[scene].shape for own in pictures.values() if scene in own)
        nothing = np.full(shape, np.nan, dtype=np.float32)
        given = [own[scene] if scene in own and own[scene].shape == shape else nothing for own in pictures.values()]
        values = np.stack(given).reshape(len(given), -1, 3)
        few = _held_by_few(list(pictures), values, alike)
        for name, own_pixels in zip(pictures, few, strict=True):
            telling[name].append(own_pixels)
    joined = {name: np.concatenate(own) for name, own in telling.items() if own}
    found = [
        Likeness(first=first, second=second, alike=count, looked_at=int((joined[first] | joined[second]).sum()))
        for (first, second), count in alike.items()
    ]
    found = [it for it in found if it.alike >= LEAST_PIXELS and it.alike > LEAST_SHARE * it.looked_at]
    return sorted(found, key=lambda it: (-it.alike / it.looked_at, -it.alike, it.first, it.second))


def _held_by_few(names: list[str], values: NDArray[np.float32], alike: Counter[tuple[str, str]]) -> NDArray[np.bool_]:
    """Which telling pixels of one scene have a value that few have; counts who shares one.

    `values` has shape (submissions, pixels, 3), the result (submissions, pixels).
    """
    most = max(2, int(COMMON_SHARE * len(names)))
    few = np.zeros(values.shape[:2], dtype=bool)
    is_telling = np.asarray(~np.isnan(values).all(axis=2))
    for pixel in np.flatnonzero(is_telling.any(axis=0)):
        groups: dict[bytes, list[int]] = {}
        for place in np.flatnonzero(is_telling[:, pixel]):
            groups.setdefault(values[place, pixel].tobytes(), []).append(int(place))
        for group in groups.values():
            if len(group) <= most:
                few[group, pixel] = True
                alike.update((names[one], names[other]) for one, other in combinations(group, 2))
    return few
