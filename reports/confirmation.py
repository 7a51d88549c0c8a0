"""Which projects confirm the truth of each scene, and at which pixels: from the verdicts of a run alone.

Renderers of one family share code and count as one opinion.
"""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.wording import plural

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from raytruth.comparisons.records.results import Cell, Results

Pixel = tuple[int, int]
"""Column and row."""
JUDGED = {Verdict.PASS, Verdict.DECLARED, Verdict.FAIL}


def families(results: Results) -> dict[str, str]:
    """The project of each renderer that is independent of the truth, by the renderer's name."""
    return {record.name: record.family for record in results.renderers if record.family is not None}


def confirming(results: Results) -> dict[str, dict[str, frozenset[Pixel]]]:
    """For each scene the projects that confirm its truth, in alphabetical order, and at which pixels each does not.

    A project confirms a scene if a cell of it passes or is as declared, and none fails. Pixels that are as declared,
    not as due, in all of these are those that it does not confirm.
    """
    known = families(results)
    cells: dict[str, dict[str, list[Cell]]] = {scene.name: {} for scene in results.scenes}
    for cell in results.cells:
        if cell.verdict in JUDGED and cell.renderer in known:
            cells[cell.scene].setdefault(known[cell.renderer], []).append(cell)
    return {
        scene: {name: left for name in sorted(of) if (left := left_open_by(of[name])) is not None}
        for scene, of in cells.items()
    }


def left_open_by(cells: Iterable[Cell]) -> frozenset[Pixel] | None:
    """The pixels that none of these cells confirms; None where they confirm nothing."""
    if any(cell.verdict == Verdict.FAIL for cell in cells):
        return None
    of_each = [pixels for cell in cells if (pixels := _only_as_declared(cell)) is not None]
    return frozenset.intersection(*of_each) if of_each else None


def _only_as_declared(cell: Cell) -> frozenset[Pixel] | None:
    """The pixels that are as declared, not as due, in a cell that does not fail; None where not all are known."""
    if cell.verdict == Verdict.PASS:
        return frozenset()
    declared = cell.judgement.declared if cell.judgement else None
    if declared is None or declared.count > len(declared.pixels) or (cell.first_hits and cell.first_hits.declared):
        return None
    return frozenset(declared.pixels)


def in_one_line(results: Results) -> str | None:
    """How well the truth is confirmed, and who is wrong; None where no reference was judged."""
    known = families(results)
    judged = [cell for cell in results.cells if cell.verdict in JUDGED and cell.renderer in known]
    if not judged:
        return None
    by_scene = confirming(results)
    confirmed = [of for of in by_scene.values() if len(of) > 1]
    scenes = f"{len(confirmed)} of {len(by_scene)} {plural('scene', len(by_scene))}"
    line = f"Independent references: {scenes} confirmed by two or more"
    open_pixels = [_fewer_than_two(of) for of in confirmed]
    if count := sum(open_pixels):
        where = f"{sum(map(bool, open_pixels))} of them"
        line = f"{line}, but for {count} {plural('pixel', count)} in {where}"
    wrong = [f"{cell.renderer} is wrong on {cell.scene}" for cell in judged if cell.verdict == Verdict.FAIL]
    return f"{'; '.join([line, *dict.fromkeys(wrong)])}."


def _fewer_than_two(left_open: Mapping[str, frozenset[Pixel]]) -> int:
    """At how many pixels fewer than two of these projects confirm the truth."""
    not_by = Counter(pixel for pixels in left_open.values() for pixel in pixels)
    return sum(len(left_open) - missing < 2 for missing in not_by.values())
