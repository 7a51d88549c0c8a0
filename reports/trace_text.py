"""Where a program's ray tree first differs, in a student's words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reports.wording import plural

if TYPE_CHECKING:
    from raytruth.comparisons.records.ray_tree_results import Comparison, Divergence

KINDS = {"M": "its mirror reflection", "R": "the reflection off glass", "T": "the refracted ray"}
WHAT = {
    "origin": "starts elsewhere",
    "direction": "goes into another direction",
    "primitive": "hits something else",
    "distance": "is of another length",
    "normal": "meets its surface with another normal",
    "local": "sees another colour where it ends, before any reflection or refraction",
    "missing": "is not there",
    "extra": "should not be there",
    "color": "adds up to another colour, although all of its rays are right: look at what each of them counts",
}
CLAUSES = {
    "primitive": "TRAV",
    "distance": "SPH, TRI, PLANE",
    "normal": "ILL-1",
    "local": "ILL, SHAD, BG",
    "missing": "TREE, REFR-5",
    "extra": "TREE, REFR-5",
    "color": "REFL, REFR",
}
CLAUSES_OF_WAYS = {"": "CAM", "M": "REFL", "R": "REFL", "T": "REFR"}
"""Which part of docs/spec.md to read; of rays' starts and directions by the last letter of their paths."""


def comparison_text(comparison: Comparison) -> str:
    """A few lines: how much agrees, and what the first difference is."""
    count = comparison.agreed
    lines = []
    if comparison.divergence is None:
        lines.append(f"All rays ({count}) are what a right tracer may have.")
    else:
        lines.append(f"{count} {plural('ray', count)} as {'it' if count == 1 else 'they'} should be; then:")
        lines += _told(comparison.divergence)
    if comparison.open_paths:
        paths = ", ".join(f"'{path}'" for path in comparison.open_paths)
        lines.append(f"Not compared, since they may go too many ways to tell them apart: {paths}.")
    return "\n".join(lines)


def in_words(path: str) -> str:
    """How a ray came about from the camera's."""
    return "the camera's ray" + "".join(f", then {KINDS[letter]}" for letter in path)


def _told(divergence: Divergence) -> list[str]:
    clause = CLAUSES.get(divergence.what, CLAUSES_OF_WAYS[divergence.path[-1:]])
    lines = [f"  Ray '{divergence.path}' ({in_words(divergence.path)}) {WHAT[divergence.what]}."]
    if divergence.what == "primitive":
        lines.append(f"  Yours: {_primitive(divergence.found)}. Right: {_primitive(divergence.low)}.")
    elif divergence.what not in {"missing", "extra"}:
        lines.append(f"  Yours: {_numbers(divergence.found)}. Right: {_ranges(divergence)}.")
    return [*lines, f"  The specification tells it under {clause}."]


def _primitive(number: tuple[float, ...]) -> str:
    return f"primitive {number[0]:g}" if number else "nothing"


def _numbers(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:.9g}" for value in values) or "it hits nothing"


def _ranges(divergence: Divergence) -> str:
    ends = zip(divergence.low, divergence.high, strict=True)
    return ", ".join(f"{low:.9g} to {high:.9g}" for low, high in ends) or "it hits nothing"
