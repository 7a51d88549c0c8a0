"""Pictures that are alike where independent programs differ: evidence of copied work, for a person to look at.

A pixel tells something only where it is not what the truth becomes in the submission's format: there it shows a
mistake or the order of operations. And only if few have it: many share a common mistake. Of two submissions those
telling pixels are counted that both have with the same bits.
"""

from __future__ import annotations

from collections import Counter
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.judgement.judged_truth import judged_truth
from raytruth.comparisons.records.class_results import Likeness

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from raytruth.comparisons.error_models.output_model import OutputModel
    from raytruth.scenes.scene import Scene

# A value that more than one in ten of a class have is a common mistake, or a common way to compute; two always are few.
COMMON_SHARE = 0.1
# More are alike than differ.
LEAST_SHARE = 0.5


def telling_pixels(scene: Scene, image: NDArray[np.float64], declared: OutputModel) -> NDArray[np.float32]:
    """The picture (height, width, 3) with not-a-number at pixels that are what such a file has for the truth."""
    truth = judged_truth(scene)
    low, high = declared.interval_read(truth, truth)
    as_due = ((low <= image) & (image <= high)).all(axis=2, keepdims=True)
    return np.where(as_due, np.nan, image).astype(np.float32)


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
    found = [it for it in found if it.alike > LEAST_SHARE * it.looked_at]
    return sorted(found, key=lambda it: (-it.alike / it.looked_at, -it.alike, it.first, it.second))


def _held_by_few(names: list[str], values: NDArray[np.float32], alike: Counter[tuple[str, str]]) -> NDArray[np.bool_]:
    """Which telling pixels of one scene have a value that few have; counts who shares one.

    `values` has shape (submissions, pixels, 3), the result (submissions, pixels).
    """
    most = max(2, int(COMMON_SHARE * len(names)))
    few = np.zeros(values.shape[:2], dtype=bool)
    is_telling = ~np.isnan(values).all(axis=2)
    for pixel in np.flatnonzero(is_telling.any(axis=0)):
        groups: dict[bytes, list[int]] = {}
        for place in np.flatnonzero(is_telling[:, pixel]):
            groups.setdefault(values[place, pixel].tobytes(), []).append(int(place))
        for group in groups.values():
            if len(group) <= most:
                few[group, pixel] = True
                alike.update((names[one], names[other]) for one, other in combinations(group, 2))
    return few
