"""Waivers: failures that are known, each with its reason, and with the most that it excuses.

A waived failure stays a failure: it only does not make the run fail. A waiver that matches nothing does.
"""

from __future__ import annotations

import fnmatch
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from pydantic import Field, TypeAdapter, ValidationError

from raytruth.comparisons.records.results import Cell, Link, Record, Verdict, Waived
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.scenes.wording import described, place, quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from raytruth.comparisons.renderers.protocol import Renderer

PACKAGED = Path(__file__).with_name("waivers.json")
"""The failures of renderers on scenes of the library."""

Text = Annotated[str, Field(min_length=1)]


class WaiverError(Exception):
    """A file of waivers cannot be used; the message is one sentence."""


class Waiver(Record):
    """A known failure of a renderer, which does not make a run fail; see docs/how-verdicts-work.md."""

    renderer: Text
    version: Text
    """Pattern of the renderer's version, in which `*` stands for anything."""
    scene: Text
    integrator: Text
    most_failing_pixels: Annotated[int, Field(ge=0)]
    """So many pixels or first hits may fail; if more do, something else is wrong, too."""
    reason: Text
    link: Link

    @property
    def place(self) -> str:
        """The cell that it is about, in words."""
        return f"{self.renderer}/{self.integrator} on {self.scene}"


_WAIVERS = TypeAdapter(tuple[Waiver, ...])


def load_waivers(path: Path = PACKAGED, programs: Iterable[Renderer] = ()) -> tuple[Waiver, ...]:
    """The waivers in a JSON file, a list of objects with the keys of Waiver. Raises WaiverError.

    They may be about renderers that raytruth knows, and about these programs of its user.
    """
    try:
        waivers = _WAIVERS.validate_json(path.read_bytes())
    except OSError as error:
        raise WaiverError(f"{path}: expected a readable file of waivers: {error.strerror}.") from error
    except ValidationError as error:
        raise WaiverError(f"{path}: {_first_problem(error)}") from error
    for number, waiver in enumerate(waivers):
        for key, name, known in _names(waiver, programs):
            if name not in known:
                problem = f"there is none called {quoted(name)}: {suggestion(name, known)}"
                raise WaiverError(f"{path}: [{number}].{key}: {problem}")
    return waivers


def apply_waivers(
    waivers: Iterable[Waiver], cells: Sequence[Cell], versions: Mapping[str, str | None]
) -> tuple[list[Cell], list[str]]:
    """The cells, waived where they fail as a waiver says, and a sentence for each waiver that matches nothing.

    `versions` has each renderer that was run. Waivers of other renderers, versions and scenes are left alone, as are
    those of cells that ended in an error, which fail the run by themselves.
    """
    by_place = {(cell.renderer, cell.scene, cell.integrator): cell for cell in cells}
    unmatched = []
    for waiver in waivers:
        key = (waiver.renderer, waiver.scene, waiver.integrator)
        cell = by_place.get(key)
        if cell is None or not fnmatch.fnmatchcase(versions.get(waiver.renderer) or "", waiver.version):
            continue
        if cell.verdict == Verdict.FAIL and _failing(cell) <= waiver.most_failing_pixels:
            by_place[key] = cell.model_copy(update={"waived": Waived(reason=waiver.reason, link=waiver.link)})
        elif cell.verdict != Verdict.ERROR:
            unmatched.append(f"The waiver of {waiver.place} matches nothing, since {_found(cell, waiver)}.")
    return list(by_place.values()), unmatched


def _failing(cell: Cell) -> int:
    """How many pixels or first hits fail."""
    return sum(part.failing for part in (cell.judgement, cell.first_hits) if part is not None)


def _found(cell: Cell, waiver: Waiver) -> str:
    if cell.verdict == Verdict.FAIL:
        return f"{_failing(cell)} pixels fail, more than the {waiver.most_failing_pixels} that it excuses"
    return f"the verdict is {cell.verdict}: remove it"


def _names(waiver: Waiver, programs: Iterable[Renderer]) -> Iterator[tuple[str, str, list[str]]]:
    """Key, name, and which names there are."""
    renderers = all_renderers() | {program.name: program for program in programs}
    yield "renderer", waiver.renderer, list(renderers)
    if waiver.renderer in renderers:
        yield "integrator", waiver.integrator, [known.name for known in renderers[waiver.renderer].integrators]


def _first_problem(error: ValidationError) -> str:
    first, *others = error.errors(include_url=False)
    more = f" (and {len(others)} more)" if others else ""
    found = "" if first["type"] in {"missing", "json_invalid"} else f", found {described(first['input'])}"
    return f"{place(first['loc'])}: {first['msg']}{found}{more}."
