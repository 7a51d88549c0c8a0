"""Where what no known mistake explains shows first: the simplest failing scene, its simplest wrong pixel, its terms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.grading.diagnosis import SAMPLED, spread
from raytruth.comparisons.grading.global_mistakes import rendered_scene
from raytruth.reference_tracer.explanation import ExplanationError, explain
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from raytruth.comparisons.grading.diagnosis import Evidence
    from raytruth.reference_tracer.explanation_record import Explanation, TracedRay
    from raytruth.scenes.scene import Scene


def unexplained(evidence: Sequence[Evidence], *, in_part: bool = False) -> str:
    """Where it shows first: the simplest failing scene, its region, the features that no right scene needs, and the
    bounces and terms of the wrong pixel with the fewest rays. `evidence` holds all pictures, one of them wrong.

    `in_part`: some of it is explained.
    """
    none = "No known mistake explains all of this." if in_part else "None of the known mistakes explains this."
    first = next(it for it in evidence if it.wrong.any())
    columns, rows = region_of(first.wrong)
    told = (
        f"{none} It shows first in {first.scene.name}, in {int(first.wrong.sum())} pixels, "
        f"columns {columns[0]} to {columns[1]}, rows {rows[0]} to {rows[1]}"
    )
    features = features_of_none([it.scene for it in evidence if not it.wrong.any()], first.scene)
    new = f"; of its features no scene that is right needs {', '.join(features)}" if features else ""
    return f"{told}{new}.{simplest_pixel(first)}"


def features_of_none(right: Iterable[Scene], scene: Scene) -> list[str]:
    """The features of a scene that none of the right ones needs, in words."""
    known = frozenset[str]().union(*(required_features(it) for it in right))
    return [name.lower().replace("_", " ") for name in sorted(required_features(scene) - known)]


def region_of(wrong: NDArray[np.bool_]) -> tuple[tuple[int, int], tuple[int, int]]:
    """The first and last column, and the first and last row, of the pixels of a mask that is not empty."""
    rows, columns = np.nonzero(wrong)
    return (int(columns.min()), int(columns.max())), (int(rows.min()), int(rows.max()))


def simplest_pixel(evidence: Evidence) -> str:
    """One sentence on the wrong pixel that takes the fewest bounces, not black if there is one; "" if none is known."""
    scene = rendered_scene(evidence.reading, evidence.scene)
    trees = []
    for column, row in spread(evidence.wrong, SAMPLED):
        try:
            trees.append(explain(scene, column, row))
        except ExplanationError:
            continue
    if not trees:
        return ""
    tree = min(trees, key=lambda it: (bounces_of(it), not _terms(it), len(it.rays)))
    bounces = bounces_of(tree)
    ways = f"{bounces} bounces" if bounces > 1 else "one bounce" if bounces else "no bounce"
    shows = _terms(tree) or "black"
    return f" Its simplest wrong pixel, {tree.x},{tree.y}, takes {ways}, and what it should show is {shows}."


def bounces_of(tree: Explanation) -> int:
    """How many bounces the longest way of the ray tree has."""
    bounces: dict[int, int] = {}
    for ray in tree.rays:  # each after its parent
        bounces[ray.number] = 0 if ray.parent is None else bounces[ray.parent] + 1
    return max(bounces.values())


def _terms(tree: Explanation) -> str:
    names = [name for ray in tree.rays for name in _terms_of(ray)]
    return ", ".join(dict.fromkeys(names))


def _terms_of(ray: TracedRay) -> list[str]:
    """The terms of the lighting equation that are not 0 where a ray ends, in words."""
    terms = {"background": ray.background, "emission": ray.emission, "ambient light": ray.ambient}
    found = [name for name, value in terms.items() if value is not None and any(value)]
    lit = [light for light in ray.lights if any(light.radiance)]
    found += ["diffuse light"] * any(light.diffuse is not None and any(light.diffuse) for light in lit)
    found += ["a highlight"] * any(light.highlight for light in lit)
    found += ["a shadow"] * any(light.shadowed for light in ray.lights)
    found += ["absorption"] * (ray.medium_transmittance is not None)
    return found
